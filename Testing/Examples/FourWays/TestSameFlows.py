"""The same parts of a flow come from all ways to the filters: TestSameFlows.py SURFACE.ply ANSWER.txt ANSWER.txt..."""

import sys

import numpy as np


def read_triangles(path):
    """The corners of those of an ASCII file."""
    with open(path) as file:
        header, body = file.read().split("end_header\n")
    words, numbers = header.split(), np.array(body.split(), float)
    size = 3 * int(words[words.index("vertex") + 1])
    return numbers[:size].reshape(-1, 3)[numbers[size:].reshape(-1, 4).astype(int).T[1:]]


def main():
    a, b, c = read_triangles(sys.argv[1])
    normals = np.cross(b - a, c - a)
    areas = np.linalg.norm(normals, axis=1) / 2
    flow = np.zeros(a.shape)
    flow[0], flow[1000] = (1, 0, 0), (1, 1, 1)
    flow -= normals * ((flow * normals).sum(axis=1) / (2 * areas) ** 2)[:, None]
    energy = areas @ (flow**2).sum(axis=1)
    answers = [np.loadtxt(path) for path in sys.argv[2:]]
    assert len(answers) > 1
    for answer in answers:
        assert answer.shape == (len(areas), 6), answer.shape
        difference = np.abs(answer - answers[0]).max()
        assert difference < 1e-9, difference  # systems are solved to 1e-11
        gradient, rotational = answer[:, :3], answer[:, 3:]
        for one, other in ((gradient, rotational), (gradient, flow - gradient), (rotational, flow - rotational)):
            product = areas @ (one * other).sum(axis=1)
            assert abs(product) < 1e-9 * energy, product / energy  # all parts are orthogonal to each other
        assert 0.05 * energy < areas @ (gradient**2).sum(axis=1) < energy


main()
