"""On two ranks, a reader that does not know of pieces delivers its whole file to both: the field is that of one rank, without a word.

    TestFileOfTwo.py FILE.ply
"""

import sys

import paraview.simple as simple

field = simple.DirectionalField(Input=simple.PLYReader(FileNames=[sys.argv[1]]))
field.UpdatePipeline()
cells = field.SMProxy.GetDataInformation(0).GetNumberOfCells()
with open(sys.argv[1]) as file:
    expected = next(int(line.split()[2]) for line in file if line.startswith("element face"))
assert cells == expected, (cells, expected)
