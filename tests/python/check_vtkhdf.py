"""Opens a series with VTK's own reader and compares every number with what was written.

usage: check_vtkhdf.py SERIES.vtkhdf EXPECTED.json

EXPECTED.json: {"frames": [{"time": t, "points": [[x, y, z], ...], "fields": {name: [...], ...}}, ...]}
A frame of a surface has "triangles": [[a, b, c], ...] as well. "null" among values stands for NaN.
Values are compared in single precision, bit for bit; ids as integers. Exit code 1 and one line a
contradiction when something differs.
"""

import json
import sys

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkObject
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Pipeline
from vtkmodules.vtkIOHDF import vtkHDFReader


def main(series, expected_path):
    with open(expected_path) as file:
        expected = json.load(file)["frames"]

    complaints = []
    reader = vtkHDFReader()
    reader.AddObserver("ErrorEvent", lambda *_: complaints.append("VTK reports an error"))
    reader.SetFileName(series)
    reader.UpdateInformation()

    information = reader.GetOutputInformation(0)
    times = list(information.Get(Pipeline.TIME_STEPS()) or [])
    # VTK lists times only where there are at least two.
    if len(expected) > 1 and times != [frame["time"] for frame in expected]:
        complaints.append(f"times {times} differ from those written")

    for frame in expected:
        reader.UpdateTimeStep(frame["time"])
        compare(frame, reader.GetOutputDataObject(0), complaints)

    # Once more backwards: the offsets must not depend on the order in which frames are read.
    for frame in reversed(expected):
        reader.UpdateTimeStep(frame["time"])
        compare(frame, reader.GetOutputDataObject(0), complaints)

    for line in complaints:
        print(line)
    if not complaints:
        print(f"{series}: {len(expected)} frames, every value as written")
    return 1 if complaints else 0


def compare(frame, output, complaints):
    where = f"t = {frame['time']}"
    points = np.asarray(frame["points"], dtype=np.float32).reshape(-1, 3)
    if output.GetNumberOfPoints() != len(points):
        complaints.append(f"{where}: {output.GetNumberOfPoints()} points, expected {len(points)}")
        return
    if not np.array_equal(vtk_to_numpy(output.GetPoints().GetData()), points):
        complaints.append(f"{where}: points differ")

    if "triangles" in frame:
        compare_triangles(where, frame["triangles"], output, complaints)
    # One cell that uses every point once, else a mapper draws nothing or the wrong ones.
    elif output.GetNumberOfVerts() != 1 or output.GetNumberOfCells() != 1:
        complaints.append(f"{where}: {output.GetNumberOfVerts()} vertex cells of {output.GetNumberOfCells()}, expected 1 of 1")
    elif not np.array_equal(vtk_to_numpy(output.GetVerts().GetConnectivityArray()), np.arange(len(points))):
        complaints.append(f"{where}: the cell does not list every point")

    data = output.GetPointData()
    names = sorted(data.GetArrayName(i) for i in range(data.GetNumberOfArrays()))
    if names != sorted(frame["fields"]):
        complaints.append(f"{where}: fields {names}, expected {sorted(frame['fields'])}")
        return
    for name, values in frame["fields"].items():
        read = vtk_to_numpy(data.GetArray(name))
        wanted = np.asarray(values, dtype=np.int64 if name == "Id" else np.float32)
        has_nan = wanted.dtype.kind == "f"
        if read.dtype.itemsize != wanted.dtype.itemsize or not np.array_equal(read, wanted, equal_nan=has_nan):
            complaints.append(f"{where}: field {name} differs")


def compare_triangles(where, triangles, output, complaints):
    if output.GetNumberOfCells() != len(triangles) or output.GetNumberOfPolys() != len(triangles):
        complaints.append(f"{where}: {output.GetNumberOfPolys()} polygons of {output.GetNumberOfCells()} cells, expected {len(triangles)}")
        return
    polygons = output.GetPolys()
    corners = vtk_to_numpy(polygons.GetConnectivityArray()).reshape(-1, 3)
    if not np.array_equal(corners, np.asarray(triangles)):
        complaints.append(f"{where}: triangles differ")
    if not np.array_equal(vtk_to_numpy(polygons.GetOffsetsArray()), np.arange(len(triangles) + 1) * 3):
        complaints.append(f"{where}: polygons are not triangles")


if __name__ == "__main__":
    vtkObject.GlobalWarningDisplayOff()
    sys.exit(main(*sys.argv[1:3]))
