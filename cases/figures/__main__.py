"""`python -m figures [CASE ...] [--out FOLDER]`, in the folder `cases`."""

from __future__ import annotations

import argparse
import sys
from importlib import import_module
from pathlib import Path

from . import readme
from .case import Case, NoRun, Skipped

CASES = ["aneurysm", "aorta", "carotid", "common-carotid", "curved-tube", "elastic-stenosis", "elastic-tube", "fda-nozzle", "pipe", "stenosis", "womersley"]


def main() -> int:
    parser = argparse.ArgumentParser(prog="python -m figures", description="Writes tables and pictures of cases from their runs.")
    parser.add_argument("cases", nargs="*", metavar="CASE", help="cases; without any, all that have a run in their folder `out`")
    parser.add_argument("--out", type=Path, help="folder of the run, of one case")
    asked = parser.parse_args()
    unknown = sorted(set(asked.cases) - set(CASES))
    if unknown:
        parser.error(f"no case {', '.join(unknown)}; there are {', '.join(CASES)}")
    if asked.out and len(asked.cases) != 1:
        parser.error("--out is of one case")
    missing = False
    for name in asked.cases or CASES:
        try:
            make(name, asked.out)
            print(f"{name}: written")
        except Skipped as why:
            print(f"{name}: skipped, {why}", file=sys.stderr)
            missing |= isinstance(why, NoRun)
    # Who names a case wants it; without the data of others it is skipped all the same, as tests are.
    return 1 if asked.cases and missing else 0


def make(name: str, out: Path | None) -> None:
    """README, picture and row of a case."""
    root = Path(__file__).parent.parent
    case = Case(root / name, out)
    blocks = import_module(f".{name.replace('-', '_')}", __package__).figures(case)
    readme.put(case.folder / "README.md", {**blocks, "time": readme.time(case)})
    readme.row(root / "README.md", case)


if __name__ == "__main__":
    sys.exit(main())
