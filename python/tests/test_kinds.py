"""Outputs of other kinds than that of a rigid pipe: a wall that moves, and a study."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from conftest import COARSE, PIPE

import vaso


def test_points_of_a_shell_are_where_its_displacement_says(tmp_path: Path) -> None:
    wall = {
        "wall.model": "shell",
        "wall.thickness": "1.2 mm",
        "wall.young_modulus": "0.4 MPa",
        "opening.outlet.value": "2 kPa",
        "opening.outlet.ramp": "1 ms",
        "run.end_time": "4 ms",
        "output.every": "1 ms",
        "output.fields": ["velocity", "pressure", "displacement", "von_mises"],
    }
    result = vaso.run(PIPE, out=tmp_path / "out", threads=1, **{**COARSE, **wall})
    moved, first = result.wall[-1], result.wall[0]
    assert result.wall.fields["Displacement"].unit == "m" and result.wall.fields["VonMises"].unit == "Pa"
    way = moved["Displacement"].astype(float) - first["Displacement"]
    # Positions have 24 bits, of 32 mm at most.
    assert moved.position.astype(float) - first.position == pytest.approx(way, abs=4 * 32e-3 * 2.0**-24)
    # Points of the face and particles of the mid-surface move nearly alike.
    largest = np.linalg.norm(moved["Displacement"], axis=1).max()
    assert 0 < largest and largest == pytest.approx(result.summary["shell"]["max_displacement_m"], rel=0.3)
    assert len(result.wall.triangles) > 1000


def test_a_study_is_a_table_with_words_in_it(tmp_path: Path) -> None:
    spacings = ["--ladders", "spacing", "--spacings", "1.2 mm,1 mm", "--set", "run.end_time=0.02 s", "--threads", "1"]
    vaso.execute(["study", str(PIPE), "--out", str(tmp_path / "study"), *spacings])
    table = vaso.Table(tmp_path / "study" / "study.csv")
    assert table["spacing_m"] == pytest.approx([1.2e-3, 1e-3])
    assert table.texts["status"] == ["completed", "completed"] and table.units["wall_clock_s"] == "s"
    # A run of it is an output folder like any other.
    last = vaso.Result(tmp_path / "study" / "runs" / table.texts["name"][1])
    assert last.fluid.counts[-1] == pytest.approx(table["fluid"][1], rel=0.05) and last.spacing == 1e-3
