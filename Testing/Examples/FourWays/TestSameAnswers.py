"""The same crosses come from all ways to the filters: TestSameAnswers.py SURFACE.ply ANSWER.txt ANSWER.txt..."""

import sys

import numpy as np


def unit(vectors):
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)


def read_normals(path):
    """Of the triangles of an ASCII file."""
    with open(path) as file:
        header, body = file.read().split("end_header\n")
    words, numbers = header.split(), np.array(body.split(), float)
    size = 3 * int(words[words.index("vertex") + 1])
    a, b, c = numbers[:size].reshape(-1, 3)[numbers[size:].reshape(-1, 4).astype(int).T[1:]]
    return unit(np.cross(b - a, c - a))


def turning(normals, one, other):
    """From cross to cross, in radians, between -pi/4 and pi/4. Which of its four directions is given does not matter."""
    quarter = np.pi / 2
    angles = np.arctan2((np.cross(normals, one) * other).sum(axis=-1), (one * other).sum(axis=-1))
    return (angles + quarter / 2) % quarter - quarter / 2


def main():
    normals = read_normals(sys.argv[1])
    answers = [np.loadtxt(path) for path in sys.argv[2:]]
    assert len(answers) > 1
    for answer in answers:
        assert answer.shape == normals.shape, answer.shape
        assert np.abs(np.linalg.norm(answer, axis=1) - 1).max() < 1e-12  # and not NaN
        assert np.abs((answer * normals).sum(axis=1)).max() < 1e-12
        difference = np.abs(turning(normals, answers[0], answer)).max()
        assert difference < 1e-8, difference  # systems are solved to 1e-10
        # What is prescribed is followed, though not exactly.
        for face, direction in ((0, (1, 0, 0)), (1000, (1, 1, 1))):
            assert np.abs(turning(normals[face], answer[face], np.array(direction))) < np.radians(2)


main()
