"""Pictures by matplotlib, which the rest of the package does without."""

from __future__ import annotations

from typing import Any

import numpy as np

from .result import Result
from .sampling import Slice


def plot_openings(result: Result, axes: Any = None) -> Any:
    """Flow [ml/s] and pressure [mmHg] of each opening over time [s], in two axes, which are made if none are given.

    Flow is positive out of the vessel, as in the table. Returns the figure.
    """
    if axes is None:
        _, axes = _pyplot().subplots(2, 1, sharex=True, layout="constrained")
    flow, pressure = axes
    table = result.openings
    names = [name.removesuffix(".flow_m3_s") for name in table if name.endswith(".flow_m3_s")]
    for name in names:
        of = table.of(name)
        flow.plot(table["time_s"], of["flow_m3_s"] * 1e6, label=name)
        pressure.plot(table["time_s"], of["pressure_pa"] / MMHG, label=name)
    flow.set_ylabel("flow out [ml/s]")
    pressure.set_ylabel("pressure [mmHg]")
    pressure.set_xlabel("time [s]")
    flow.legend()
    return flow.figure


#: One millimetre of mercury [Pa].
MMHG = 133.322387415


def plot_slice(slice: Slice, ax: Any = None, *, label: str | None = None, **image: Any) -> Any:
    """A slice as a picture, vectors by their length, places in mm. ``image`` goes to ``imshow``. Returns the figure."""
    if ax is None:
        _, ax = _pyplot().subplots(layout="constrained")
    half_right, half_up = (0.5 * (a[1] - a[0]) if len(a) > 1 else 0.0 for a in (slice.right, slice.up))
    border = np.array([slice.right[0] - half_right, slice.right[-1] + half_right, slice.up[0] - half_up, slice.up[-1] + half_up])
    shown = ax.imshow(slice.magnitude, origin="lower", extent=tuple(1e3 * border), aspect="equal", **image)
    ax.set_xlabel("[mm]")
    ax.set_ylabel("[mm]")
    ax.set_title(f"{slice.time:.4g} s")
    ax.figure.colorbar(shown, ax=ax, label=label or f"{slice.field} [{slice.unit}]")
    return ax.figure


def _pyplot() -> Any:
    try:
        import matplotlib.pyplot
    except ImportError as error:
        raise ImportError("pictures need matplotlib: pip install matplotlib") from error
    return matplotlib.pyplot
