"""The example is what a reader starts from: it runs as it is, and its numbers are right."""

from __future__ import annotations

import runpy
from pathlib import Path

import numpy as np
import pytest

EXAMPLE = Path(__file__).resolve().parents[1] / "examples" / "pipe.py"


def test_the_pipe_of_the_example_has_poiseuilles_flow(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    found = runpy.run_path(str(EXAMPLE))

    assert found["result"].summary["status"] == "completed"
    assert len(found["u"]) > 500
    # The bounds of docs/validation.md at ten particles across; of the stress half of its bound.
    assert found["velocity_error"] < 0.022
    assert abs(found["mass_error"]) < 0.01
    assert abs(found["shear_error"]) < 0.05
    # The pressure of single rows swings by a fifth: over the fifty rows of the mean that leaves 3 %, and 6 % are allowed the gradient.
    assert abs(found["gradient_error"]) < 0.09

    # The fastest blood of the slice is on the axis and a little slower than the peak, as a kernel mean is.
    peak = np.nanmax(found["cut"].magnitude)
    assert 0.9 < peak / (2 * found["mean_velocity"]) < 1.0

    for picture in ["profile.png", "openings.png"]:
        assert (tmp_path / "pipe" / picture).read_bytes().startswith(b"\x89PNG")
