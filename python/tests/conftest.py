"""What the tests share: the program, and the output of one run of a pipe."""

from __future__ import annotations

import os
from pathlib import Path

import matplotlib
import pytest

import vaso

matplotlib.use("agg")

ROOT = Path(__file__).resolve().parents[2]
PIPE = ROOT / "cases" / "pipe"

#: Coarse and short: some seconds on one core. Frames of the blood differ in their number of particles.
COARSE = {
    "particles.spacing": "1 mm",
    "particles.relaxation_steps": 50,
    "run.end_time": "0.2 s",
    "output.every": "20 ms",
    "output.fields": ["velocity", "pressure", "wss"],
}


@pytest.fixture(scope="session", autouse=True)
def program() -> Path:
    """Without the program nothing can be tested; in continuous integration it must be there."""
    try:
        return vaso.find_binary()
    except vaso.BinaryNotFound as error:
        if os.environ.get("CI") == "true":
            raise
        pytest.skip(str(error))


@pytest.fixture(scope="session")
def pipe(tmp_path_factory: pytest.TempPathFactory) -> vaso.Result:
    """A finished run of the pipe. Tests do not change its files."""
    return vaso.run(PIPE, out=tmp_path_factory.mktemp("pipe") / "out", threads=1, **COARSE)
