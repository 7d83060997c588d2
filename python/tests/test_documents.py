"""What the pages show in Python runs as it stands."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest
from conftest import ROOT

import vaso


def shown(page: str) -> list[str]:
    """Blocks of Python of a page."""
    return re.findall(r"^```python\n(.*?)^```", (ROOT / page).read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE)


def test_the_readme_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "cases").symlink_to(ROOT / "cases")
    monkeypatch.chdir(tmp_path)
    names: dict[str, Any] = {}
    (block,) = shown("python/README.md")
    exec(block, names)
    assert names["result"].summary["status"] == "completed"
    assert (tmp_path / "cut.png").stat().st_size > 0 and (tmp_path / "openings.png").stat().st_size > 0


def test_the_page_on_python_runs_with_the_package_and_without(
    pipe: vaso.Result, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "cases").symlink_to(ROOT / "cases")
    monkeypatch.chdir(tmp_path)
    with_package, without = shown("docs/howto/python.md")
    names: dict[str, Any] = {}
    exec(with_package, names)
    assert names["result"].summary["time_s"] == pytest.approx(0.2)

    monkeypatch.chdir(pipe.out.parent)
    exec(without, names)
    assert (names["velocity"] == pipe.particles()["Velocity"]).all()
    assert names["openings"]["inlet.flow_m3_s"][-1] == pipe.openings["inlet.flow_m3_s"][-1]
