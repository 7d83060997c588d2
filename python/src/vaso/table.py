"""Tables of numbers over time: ``openings.csv``, ``probes.csv``, ``study.csv``."""

from __future__ import annotations

import csv
import io
import os
from collections.abc import Iterator, Mapping
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from .errors import OutputError

#: Units by the ending of a column's name, longest first.
UNITS = {"_m3_s": "m^3/s", "_m_s": "m/s", "_pa": "Pa", "_m": "m", "_s": "s"}


class Table(Mapping[str, NDArray[np.float64]]):
    """A table as columns by name, in the order and with the names of the file.

    Each column is a float64 array of shape (rows,), NaN where a cell is empty. The unit is the ending of the name, and in
    ``units``. Text columns, which ``study.csv`` has, are in ``texts``.
    """

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self.path = Path(path)
        self.texts: dict[str, list[str]] = {}
        self._columns: dict[str, NDArray[np.float64]] = {}
        header, rows = _read(self.path)
        for k, name in enumerate(header):
            cells = [row[k] for row in rows]
            try:
                self._columns[name] = np.array([float(cell) if cell else np.nan for cell in cells])
            except ValueError:
                self.texts[name] = cells

    @property
    def units(self) -> dict[str, str]:
        """Unit of each column that has one in its name."""
        found = {name: next((unit for end, unit in UNITS.items() if name.endswith(end)), None) for name in self}
        return {name: unit for name, unit in found.items() if unit is not None}

    def of(self, name: str) -> dict[str, NDArray[np.float64]]:
        """The columns of one opening or probe, without its name: ``of("inlet")["flow_m3_s"]``."""
        start = name + "."
        found = {column[len(start) :]: values for column, values in self.items() if column.startswith(start)}
        if not found:
            names = sorted({column.split(".")[0] for column in self if "." in column})
            raise KeyError(f"{self.path.name} has nothing of `{name}`; it has {', '.join(names) or 'no names'}")
        return found

    def array(self) -> NDArray[np.void]:
        """All columns as one structured array of shape (rows,), with the names of the columns as fields."""
        dtype = np.dtype([(name, np.float64) for name in self._columns])
        rows = len(next(iter(self._columns.values()), ()))
        out = np.empty(rows, dtype=dtype)
        for name, values in self._columns.items():
            out[name] = values
        return out

    def __getitem__(self, name: str) -> NDArray[np.float64]:
        try:
            return self._columns[name]
        except KeyError:
            raise KeyError(f"{self.path.name} has no column `{name}`; it has {', '.join(self._columns)}") from None

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    def __repr__(self) -> str:
        rows = len(next(iter(self._columns.values()), ()))
        return f"<Table {self.path}: {rows} rows of {', '.join(self._columns)}>"


def _read(path: Path) -> tuple[list[str], list[list[str]]]:
    try:
        text = path.read_text(encoding="utf-8")
    except OSError as error:
        raise OutputError(f"{path}: cannot be read: {error.strerror}") from error
    # A kill may tear the last line, which then has no end; it is left out.
    lines = list(csv.reader(io.StringIO(text[: text.rfind("\n") + 1], newline="")))
    if not lines or not lines[0]:
        raise OutputError(f"{path}: the header is missing")
    header, rows = lines[0], lines[1:]
    for number, row in enumerate(rows, start=2):
        if len(row) != len(header):
            raise OutputError(f"{path}: row {number} has {len(row)} cells for {len(header)} columns")
    return header, rows
