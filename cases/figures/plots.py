"""Pictures by matplotlib: planes through the blood with the wall, and curves."""

from __future__ import annotations

import io

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection
from PIL import Image

from .case import Case
from .plane import Plane

plt.rcParams.update({
    "figure.dpi": 110, "font.size": 9, "axes.titlesize": 9, "grid.alpha": 0.3, "legend.fontsize": 8,
    "figure.constrained_layout.use": True,
})  # fmt: skip

#: Ours, and what it is compared with.
HERE, REFERENCE = "#d62728", "black"


def figure(rows: int, columns: int, width: float, height: float, **keywords):
    """A figure of a size in inches."""
    return plt.subplots(rows, columns, figsize=(width, height), **keywords)


def save(case: Case, fig) -> None:
    """Writes `result.png` of a case."""
    # Written without the transparency and the version of matplotlib, the same picture is a fifth smaller, and the same bytes.
    drawn = io.BytesIO()
    fig.savefig(drawn, format="png")
    plt.close(fig)
    Image.open(drawn).convert("RGB").save(case.folder / "result.png", optimize=True)


def show(ax, plane: Plane, values: np.ndarray, *, label: str, title: str = "", bar: str = "right", **image) -> None:
    """Values on a plane [mm] with the wall and a bar of colours."""
    half = 0.5 * (plane.x[1] - plane.x[0])
    extent = [1e3 * v for v in (plane.x[0] - half, plane.x[-1] + half, plane.y[0] - half, plane.y[-1] + half)]
    shown = ax.imshow(values, origin="lower", extent=extent, aspect="equal", **image)
    ax.add_collection(LineCollection(1e3 * plane.wall, colors="black", linewidths=0.8))
    ax.set(xlim=extent[:2], ylim=extent[2:], title=title)
    for side in ax.spines.values():
        side.set_visible(False)
    ax.figure.colorbar(shown, ax=ax, location=bar, label=label, shrink=0.9, aspect=30 if bar == "bottom" else 12)


def directions(ax, plane: Plane, velocity: np.ndarray, apart: float, *, scaled: bool = False) -> None:
    """Arrows at a distance [m], of equal length, or as long as the velocity is great."""
    step = max(1, round(apart / (plane.x[1] - plane.x[0])))
    at = slice(step // 2, None, step)
    u, v = (velocity[at, at] @ axis for axis in plane.axes)
    size = np.hypot(u, v)
    unit = np.nanmax(size) if scaled else np.maximum(size, 1e-12)
    x, y = np.meshgrid(1e3 * plane.x[at], 1e3 * plane.y[at])
    longest = 1.6 if scaled else 0.75
    ax.quiver(x, y, u / unit, v / unit, color="white", pivot="mid", angles="xy", scale_units="xy", scale=1.0 / (longest * 1e3 * apart), width=0.0022, headwidth=4)


def turning(ax, plane: Plane, along: np.ndarray) -> None:
    """A line where the velocity along the vessel changes its sign."""
    if np.nanmin(along) < 0.0:
        ax.contour(1e3 * plane.x, 1e3 * plane.y, along, levels=[0.0], colors="white", linewidths=0.9)
