"""Makes a PLY file, which ParaView reads, of an OFF file of points and polygons:

    python3 off_to_ply.py SURFACE.off SURFACE.ply
"""

import pathlib
import sys

HEADER = """ply
format ascii 1.0
element vertex {}
property double x
property double y
property double z
element face {}
property list uchar int vertex_indices
end_header
"""


def convert(off, ply):
    lines = [line.split("#")[0].split() for line in open(off)]
    lines = [line for line in lines if line]
    if lines[0][0] != "OFF":
        raise SystemExit(f"{off} is no OFF file of points alone (its first word is {lines[0][0]})")
    if len(lines[0]) == 1:
        lines.pop(0)
    vertices, faces = map(int, lines[0][-3:-1])
    places, polygons = lines[1:1 + vertices], lines[1 + vertices:1 + vertices + faces]
    rows = [place[:3] for place in places] + [polygon[:1 + int(polygon[0])] for polygon in polygons]
    pathlib.Path(ply).write_text(
        HEADER.format(vertices, faces) + "".join(" ".join(row) + "\n" for row in rows))


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    convert(*sys.argv[1:])
