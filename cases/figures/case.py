"""A case with its run: what `case.toml` says, in SI units, and means over the time that counts."""

from __future__ import annotations

import csv
import os
import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import vaso

#: SI units of what the shipped cases write; another unit is an error here, not a guess.
UNITS = {
    "m": 1.0, "mm": 1e-3, "s": 1.0, "ms": 1e-3, "m/s": 1.0, "mm/s": 1e-3, "m^3/s": 1.0, "ml/s": 1e-6, "ml/min": 1e-6 / 60.0,
    "kg/m^3": 1.0, "Pa s": 1.0, "mPa s": 1e-3, "Pa": 1.0, "kPa": 1e3, "mmHg": 133.322387415, "Pa s/m^3": 1.0, "m^3/Pa": 1.0,
}  # fmt: skip
MMHG = UNITS["mmHg"]


class Skipped(Exception):
    """A case whose figures cannot be made, and why."""


class NoRun(Skipped):
    """There is no run, or not one that the figures can be made of."""


def quantity(text: str) -> float:
    """`"0.25 mm"` as 0.00025."""
    number, unit = text.split(" ", 1)
    return float(number) * UNITS[unit]


class Case:
    """A case folder, and the folder its run lies in."""

    def __init__(self, folder: Path, out: Path | None = None) -> None:
        self.folder = folder
        self.name = folder.name
        self.toml: dict[str, Any] = tomllib.loads((folder / "case.toml").read_text(encoding="utf-8"))
        out = out or folder / "out"
        if not (out / "summary.json").is_file():
            raise NoRun(f"there is no run in {out}")
        self.run = vaso.Result(out)
        self.summary = self.run.summary
        if self.summary["status"] != "completed":
            raise NoRun(f"the run in {out} is not completed but {self.summary['status']}")
        #: Where it ended [s]. Not `run.end_time` of the case, which a flag may have changed.
        self.end = float(self.summary["time_s"])
        self.spacing = self.run.spacing
        self.density = quantity(self.toml["blood"]["density"])

    @property
    def viscosity(self) -> float:
        """Viscosity [Pa s] of blood whose viscosity is constant."""
        return quantity(self.toml["blood"]["viscosity"])

    @property
    def period(self) -> float:
        """Length of a cycle [s]."""
        return quantity(self.toml["run"]["period"])

    def opening(self, name: str) -> dict[str, Any]:
        """What the case says of an opening."""
        return next(o for o in self.toml["opening"] if o["name"] == name)

    def probe(self, name: str) -> np.ndarray:
        """Place of a probe [m]."""
        place = next(p["at"] for p in self.toml["probe"] if p["name"] == name)
        return UNITS[self.toml["geometry"]["unit"]] * np.array(place)

    def waveform(self, name: str) -> tuple[np.ndarray, np.ndarray]:
        """Times [s] and values, in SI, of the table of an opening: one cycle with both ends."""
        rows = list(csv.reader((self.folder / self.opening(name)["waveform"]).read_text(encoding="utf-8").splitlines()))
        rows = [row for row in rows if not row[0].startswith("#")]
        units = [UNITS[title[title.index("[") + 1 : title.index("]")]] for title in rows[0]]
        t, values = (np.array([float(row[k]) for row in rows[1:]]) * units[k] for k in (0, 1))
        return t, values

    def last(self, part: float) -> tuple[float, float]:
        """The last part of a run that becomes steady [s]."""
        return (1.0 - part) * self.end, self.end

    def last_cycle(self) -> tuple[float, float]:
        """The last whole cycle of a periodic run [s]."""
        n = int(np.floor(self.end / self.period + 1e-6))
        if n < 1:
            raise NoRun(f"the run ended after {self.end:.3g} s, before the first cycle of {self.period:.3g} s")
        return (n - 1) * self.period, n * self.period

    def steps(self, window: tuple[float, float], *, closed: bool = True) -> list[int]:
        """Numbers of the frames of the blood in a window; of a cycle without its end (`closed=False`), which is its start as well."""
        times = self.run.fluid.times
        # A frame comes with the first step behind its time.
        slack = 0.01 * (window[1] - window[0])
        inside = (times > window[0] - 0.1 * slack) & (times < window[1] + (slack if closed else -slack))
        if not inside.any():
            raise NoRun(f"no frame lies between {window[0]:.3g} and {window[1]:.3g} s")
        return list(np.flatnonzero(inside))

    def across(self, diameter: float) -> str:
        """How many spacings a diameter [m] is wide."""
        n = diameter / self.spacing
        return f"{n:.1f}".removesuffix(".0")


def data(folder: str) -> Path:
    """A folder of validation data."""
    root = os.environ.get("VASO_DATA")
    if not root:
        raise Skipped(f"VASO_DATA is not set; the reference is in its folder {folder}")
    if not (Path(root) / folder).is_dir():
        raise Skipped(f"VASO_DATA has no folder {folder}")
    return Path(root) / folder


def within(t: np.ndarray, values: np.ndarray, window: tuple[float, float]) -> tuple[np.ndarray, np.ndarray]:
    """Samples in a window, with values in between at its ends."""
    inside = (t > window[0]) & (t < window[1])
    ends = np.interp(window, t, values)
    return np.concatenate([window[:1], t[inside], window[1:]]), np.concatenate([ends[:1], values[inside], ends[1:]])


def mean(t: np.ndarray, values: np.ndarray, window: tuple[float, float]) -> float:
    """Mean in time, exact for straight lines between samples."""
    t, values = within(t, values, window)
    return float(np.trapezoid(values, t) / (t[-1] - t[0]))


def halves(t: np.ndarray, values: np.ndarray, window: tuple[float, float]) -> float:
    """By how much the mean of the second half of a window is above that of the first: whether it is steady."""
    middle = 0.5 * sum(window)
    return mean(t, values, (middle, window[1])) - mean(t, values, (window[0], middle))


def harmonic(t: np.ndarray, values: np.ndarray, window: tuple[float, float]) -> complex:
    """First harmonic `c` over a window of one cycle: `Re(c exp(i w t))` with the time of the run."""
    t, values = within(t, values, window)
    period = window[1] - window[0]
    return complex(2.0 / period * np.trapezoid(values * np.exp(-2j * np.pi * t / period), t))


def smooth(t: np.ndarray, values: np.ndarray, width: float) -> np.ndarray:
    """Running means over a time [s], cut off at the ends."""
    integral = np.concatenate([[0.0], np.cumsum(0.5 * (values[1:] + values[:-1]) * np.diff(t))])
    low, high = np.clip(t - 0.5 * width, t[0], t[-1]), np.clip(t + 0.5 * width, t[0], t[-1])
    return (np.interp(high, t, integral) - np.interp(low, t, integral)) / (high - low)
