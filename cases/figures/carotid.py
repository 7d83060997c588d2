"""Carotid bifurcation: how the flow divides, and where it is slow."""

from __future__ import annotations

import numpy as np

from . import plots, readme
from .case import UNITS, Case, mean, quantity
from .plane import Plane

BRANCHES = {"ica": "internal", "eca": "external"}


def figures(case: Case) -> dict[str, str]:
    """Blocks of the README; draws the picture."""
    window = case.last(0.2)
    steps = case.steps(window)
    openings = case.run.openings
    t = openings["time_s"]
    flow = {name: mean(t, openings[f"{name}.flow_m3_s"], window) for name in ("cca", *BRANCHES)}
    out = sum(flow[name] for name in BRANCHES)
    inlet = next(o for o in case.summary["openings"] if o["name"] == "cca")
    imposed = quantity(case.opening("cca")["value"]) * inlet["area_m2"]
    back, fastest = extremes(case, steps)
    rows = [
        *([f"flow of the {title} artery", f"{1e6 * flow[name]:.2f} ml/s, {readme.percent(flow[name] / out)}", ""] for name, title in BRANCHES.items()),
        ["both, by what came in", f"{-out / flow['cca']:.4f}", "1"],
        ["flow of the common artery", f"{-1e6 * flow['cca']:.2f} ml/s", f"{1e6 * imposed:.2f} ml/s"],
        ["pressure of the common artery, above the outlets", f"{mean(t, openings['cca.pressure_pa'], window):.0f} Pa", ""],
        ["fastest blood", f"{fastest:.2f} m/s", ""],
        ["blood that turns back in the sinus of the internal artery", f"up to {1e3 * back:.0f} mm/s" if back > 0.0 else "none", ""],
    ]  # fmt: skip
    draw(case, steps)
    narrow = min(o["radius_m"] for o in case.summary["openings"])
    text = [
        f"Means of {readme.from_to(window)}, {case.across(2.0 * inlet['radius_m'])} particles across the common artery, {case.across(2.0 * narrow)} across the narrowest branch:",
        readme.table(["", "found", "expected"], rows),
        readme.soundness(case),
    ]
    return {"result": "\n\n".join(text)}


def extremes(case: Case, steps: list[int]) -> tuple[float, float]:
    """Fastest backflow [m/s], upstream along the internal artery where that begins, and fastest blood: what one particle in a thousand exceeds.

    Of means over the frames in cells of one and a half spacings, which takes the noise of single particles away.
    """
    size = 1.5 * case.spacing
    end = UNITS["mm"] * np.array(case.opening("ica")["near"])
    along = end / np.linalg.norm(end)
    places, velocities = [], []
    for step in steps:
        frame = case.run.fluid[step]
        places.append(np.floor(frame.position.astype(float) / size).astype(int))
        velocities.append(frame["Velocity"].astype(float))
    cells, which = np.unique(np.concatenate(places), axis=0, return_inverse=True)
    which, velocities = which.ravel(), np.concatenate(velocities)
    count = np.bincount(which)
    mean_velocity = np.stack([np.bincount(which, velocities[:, k]) / count for k in range(3)], axis=1)
    center = (cells + 0.5) * size
    sinus = (center @ along > 0.0) & (center @ along < 0.6 * np.linalg.norm(end)) & (center[:, 0] > 0.0)
    full = count > 2 * len(steps)
    return -float((mean_velocity @ along)[sinus & full].min()), float(np.quantile(np.linalg.norm(velocities, axis=1), 0.999))


def draw(case: Case, steps: list[int]) -> None:
    """Speed and pressure in the plane of the bifurcation."""
    fig, axes = plots.figure(1, 2, 8.0, 4.6)
    plane = Plane(case, [0.0, 0.0, 0.0], right=[1.0, 0.0, 0.0], up=[0.0, 0.0, 1.0])
    velocity = plane.mean("Velocity", steps)
    plots.show(axes[0], plane, np.linalg.norm(velocity, axis=-1), label="speed, m/s", vmin=0.0)
    plots.directions(axes[0], plane, velocity, 2e-3)
    plots.show(axes[1], plane, plane.mean("Pressure", steps), label="pressure above the outlets, Pa", cmap="cividis")
    for ax in axes:
        ax.set(xlabel="mm")
    plots.save(case, fig)
