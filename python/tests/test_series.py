"""Series, against the reader of VTK, which finds frames by code of its own."""

from __future__ import annotations

from pathlib import Path

import h5py
import numpy as np
import pytest
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOHDF import vtkHDFReader

import vaso


def by_vtk(path: Path, step: int) -> tuple[dict[str, np.ndarray], np.ndarray]:
    """Arrays of a frame by name, positions as `Points`; and corners of triangles."""
    reader = vtkHDFReader()
    reader.SetFileName(str(path))
    reader.UpdateInformation()
    reader.SetStep(step)
    reader.Update()
    output = reader.GetOutput()
    data = output.GetPointData()
    arrays = {data.GetArrayName(k): vtk_to_numpy(data.GetArray(k)) for k in range(data.GetNumberOfArrays())}
    corners = vtk_to_numpy(output.GetPolys().GetConnectivityArray()) if output.GetNumberOfPolys() else np.empty(0, int)
    return {**arrays, "Points": vtk_to_numpy(output.GetPoints().GetData())}, corners.reshape(-1, 3)


@pytest.mark.parametrize("name", ["fluid", "wall"])
def test_every_array_of_every_frame_is_that_of_vtk(pipe: vaso.Result, name: str) -> None:
    series: vaso.Series = getattr(pipe, name)
    assert len(series) == 11
    assert np.all(np.diff(series.times) > 0) and series.times[-1] == pytest.approx(0.2, abs=1e-12)
    for step, frame in enumerate(series):
        arrays, corners = by_vtk(series.path, step)
        assert sorted(arrays) == sorted([*frame, "Points"])
        np.testing.assert_array_equal(frame.position, arrays["Points"])
        for field in frame:
            np.testing.assert_array_equal(frame[field], arrays[field])
        np.testing.assert_array_equal(series.triangles, corners)


def test_frames_are_told_apart_by_more_than_their_length(pipe: vaso.Result) -> None:
    fluid = pipe.fluid
    assert len(set(fluid.counts.tolist())) > 1, "the number of particles changes, so offsets are put to the test"
    assert [len(frame["Id"]) for frame in fluid] == fluid.counts.tolist()
    assert fluid[-1].index == len(fluid) - 1 and fluid[-1].time == fluid.times[-1]
    assert fluid.at(0.1).time == min(fluid.times, key=lambda time: abs(time - 0.1))
    with pytest.raises(IndexError, match="frame 11 was asked for, fluid.vtkhdf has 11"):
        fluid[11]


def test_fields_say_what_they_are(pipe: vaso.Result) -> None:
    fluid, wall = pipe.fluid.fields, pipe.wall.fields
    assert {name: field.unit for name, field in fluid.items()} == {"Id": "1", "Pressure": "Pa", "Velocity": "m/s"}
    assert fluid["Velocity"].components == 3 and fluid["Pressure"].components == 1
    assert wall["WSS"].unit == "Pa" and "grad v" in wall["WSS"].definition and wall["WSS"].citation
    with pytest.raises(KeyError, match="no field `Speed`; it has Id, Pressure, Velocity"):
        pipe.particles()["Speed"]


def test_blood_lies_in_the_pipe_and_the_wall_on_it(pipe: vaso.Result) -> None:
    blood, wall, corners = pipe.particles().position, pipe.wall[0].position, pipe.wall.triangles
    assert np.hypot(blood[:, 0], blood[:, 1]).max() < 3.175e-3
    assert np.hypot(wall[:, 0], wall[:, 1]) == pytest.approx(3.175e-3, rel=2e-3)
    a, b, c = (wall[corners[:, k]].astype(float) for k in range(3))
    area = 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1).sum()
    # Of the cylinder; its facets lie within.
    assert area == pytest.approx(2 * np.pi * 3.175e-3 * 31.75e-3, rel=2e-3)


def test_what_is_no_series_is_said_to_be_none(tmp_path: Path) -> None:
    with pytest.raises(vaso.OutputError, match="there is no such file"):
        vaso.Series(tmp_path / "fluid.vtkhdf")
    text = tmp_path / "text.vtkhdf"
    text.write_text("not a series")
    with pytest.raises(vaso.OutputError, match="cannot be read as HDF5"):
        vaso.Series(text)
    other = tmp_path / "other.vtkhdf"
    with h5py.File(other, "w") as file:
        file.create_group("VTKHDF").attrs["Type"] = "UnstructuredGrid"
    with pytest.raises(vaso.OutputError, match="is no VTKHDF series"):
        vaso.Series(other)


def test_a_series_that_another_run_replaced_is_not_mixed_with_it(pipe: vaso.Result, tmp_path: Path) -> None:
    path = tmp_path / "fluid.vtkhdf"
    path.write_bytes(pipe.fluid.path.read_bytes())
    series = vaso.Series(path)
    assert len(series[3]["Id"]) == series.counts[3]
    with h5py.File(path, "r+") as file:
        file["VTKHDF/Steps/Values"][3] += 1e-6
    with pytest.raises(vaso.OutputError, match="open it again"):
        series[3]["Id"]
    assert len(series[2]["Id"]) == series.counts[2]
