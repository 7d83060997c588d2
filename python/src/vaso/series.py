"""Particles and surfaces over time: ``fluid.vtkhdf``, ``wall.vtkhdf``, ``particles.vtkhdf``.

A frame is found by the offsets in ``VTKHDF/Steps``, as VTK does it: arrays that did not change are stored once, so counts do
not add up to rows. Only what is asked for is read, and the file is open only while it is read. So a run that is going on
writes undisturbed, and a series opened again shows its newer frames.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import h5py
import numpy as np
from numpy.typing import NDArray

from .errors import OutputError

Array = NDArray[Any]


@dataclass(frozen=True)
class Field:
    """What the file says of a field."""

    name: str
    #: Numbers a point: 1 or 3.
    components: int
    #: SI unit, "1" for pure numbers; empty where the file does not say.
    unit: str
    #: How it is computed; empty where the file does not say.
    definition: str
    #: Where the definition stems from; empty where the file does not say.
    citation: str


class Frame(Mapping[str, Array]):
    """One time of a series. Fields by the names they have in the file and in ParaView, each read when it is asked for.

    A field has shape (n,) or (n, 3) and the unit in ``series.fields[name].unit``; float32 as stored, ``Id`` int64. A field of the wall
    is NaN where there is no value yet, or none at a point.
    """

    def __init__(self, series: Series, index: int) -> None:
        self.series = series
        self.index = index
        #: Simulated time [s].
        self.time = float(series.times[index])

    @property
    def position(self) -> Array:
        """Places of the particles, or of the points of the surface, (n, 3) [m], float32."""
        return self.series._rows("Points", "Steps/PointOffsets", self.index)

    def __getitem__(self, name: str) -> Array:
        if name not in self.series.fields:
            raise KeyError(f"{self.series.path.name} has no field `{name}`; it has {', '.join(self.series.fields)}")
        return self.series._rows(f"PointData/{name}", f"Steps/PointDataOffsets/{name}", self.index)

    def __iter__(self) -> Iterator[str]:
        return iter(self.series.fields)

    def __len__(self) -> int:
        return len(self.series.fields)

    def __repr__(self) -> str:
        points = int(self.series.counts[self.index])
        return f"<Frame at {self.time:.6g} s: {points} points, {', '.join(self.series.fields)}>"


class Series:
    """A series of frames, by number from 0, or from -1 backwards: ``series[-1]["Velocity"]``."""

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self.path = Path(path)
        with self._open() as root:
            #: Time of each frame, (frames,) [s].
            self.times: NDArray[np.float64] = root["Steps/Values"][:]
            parts = root["Steps/PartOffsets"][:]
            #: Points of each frame, (frames,).
            self.counts: NDArray[np.int64] = root["NumberOfPoints"][:][parts]
            #: Fields by name.
            self.fields: dict[str, Field] = {name: _field(name, data) for name, data in root["PointData"].items()}

    @property
    def triangles(self) -> NDArray[np.int64]:
        """Corners of the triangles of a surface as point numbers, (m, 3), the same at all times; (0, 3) for particles."""
        with self._open() as root:
            polygons = root["Polygons"]
            cells = int(polygons["NumberOfCells"][0]) if len(polygons["NumberOfCells"]) else 0
            corners: NDArray[np.int64] = polygons["Connectivity"][:]
        if len(corners) != 3 * cells:
            raise OutputError(f"{self.path}: its polygons are not triangles")
        return corners.reshape(-1, 3)

    def at(self, time: float) -> Frame:
        """The frame nearest to a time [s]."""
        if not len(self):
            raise IndexError(f"{self.path.name} has no frames")
        return self[int(np.argmin(np.abs(self.times - time)))]

    def __getitem__(self, index: int) -> Frame:
        count = len(self)
        if not -count <= index < count:
            raise IndexError(f"frame {index} was asked for, {self.path.name} has {count}")
        return Frame(self, index % count)

    def __len__(self) -> int:
        return len(self.times)

    def __iter__(self) -> Iterator[Frame]:
        return (self[index] for index in range(len(self)))

    def __repr__(self) -> str:
        span = f", {self.times[0]:.6g} to {self.times[-1]:.6g} s" if len(self) else ""
        return f"<Series {self.path}: {len(self)} frames{span}, {', '.join(self.fields)}>"

    def _rows(self, data: str, offsets: str, index: int) -> Array:
        with self._open() as root:
            times = root["Steps/Values"]
            if len(times) <= index or times[index] != self.times[index]:
                raise OutputError(f"{self.path}: another run has taken its place since it was opened; open it again")
            start = int(root[offsets][index])
            stop = start + int(self.counts[index])
            if stop > len(root[data]):
                raise OutputError(f"{self.path}: `{data}` has {len(root[data])} rows, frame {index} needs {stop}")
            rows: Array = root[data][start:stop]
            return rows

    def _open(self) -> _Root:
        return _Root(self.path)


class _Root:
    """The group `VTKHDF` of a file, for the length of a `with`."""

    def __init__(self, path: Path) -> None:
        self.path = path

    def __enter__(self) -> Any:
        if not self.path.is_file():
            raise OutputError(f"{self.path}: there is no such file")
        try:
            self.file = h5py.File(self.path, "r")
        except OSError as error:
            raise OutputError(f"{self.path}: cannot be read as HDF5: {error}") from error
        root = self.file.get("VTKHDF")
        if root is None or _text(root.attrs.get("Type")) != "PolyData" or "Steps" not in root:
            self.file.close()
            raise OutputError(f"{self.path}: is no VTKHDF series of PolyData")
        return root

    def __exit__(self, *_: object) -> None:
        self.file.close()


def _field(name: str, data: Any) -> Field:
    notes = (_text(data.attrs.get(note)) for note in ["units", "definition", "citation"])
    return Field(name, 1 if data.ndim == 1 else int(data.shape[1]), *notes)


def _text(value: Any) -> str:
    if value is None:
        return ""
    return value.decode("utf-8") if isinstance(value, bytes) else str(value)
