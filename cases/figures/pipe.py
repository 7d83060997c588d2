"""Pipe at Reynolds number 100: the parabola of Hagen and Poiseuille."""

from __future__ import annotations

import numpy as np

from . import plots, readme
from .case import Case, mean, quantity

RADIUS, LENGTH = 3.175e-3, 31.75e-3
#: Places in radii, by the names of the probes.
PROBES = {"axis": 0.0, "quarter": 0.25, "half": 0.5, "three-quarters": 0.75}
NAMES = {"axis": "on the axis", "quarter": "at a quarter of the radius", "half": "at half the radius", "three-quarters": "at three quarters"}


def figures(case: Case) -> dict[str, str]:
    """Blocks of the README; draws the picture."""
    window = case.last(0.25)
    steps = case.steps(window)
    speed = quantity(case.opening("inlet")["value"])
    exact = lambda r: 2.0 * speed * (1.0 - r**2)  # noqa: E731
    probes, openings = case.run.probes, case.run.openings
    r, u = middle(case, steps)
    # Even, as the profile is; with a term beyond the parabola, which would show.
    profile = np.polynomial.Polynomial(np.polynomial.polynomial.polyfit(r**2, u, 2))
    rows = []
    for name, at in PROBES.items():
        found, probe = float(profile(at**2)), mean(probes["time_s"], probes[f"{name}.w_m_s"], window)
        rows.append([f"velocity {NAMES[name]}", f"{1e3 * found:.2f} mm/s", f"{1e3 * probe:.2f} mm/s", f"{1e3 * exact(at):.2f} mm/s", readme.off(found / exact(at))])
    flow, imposed = mean(openings["time_s"], openings["outlet.flow_m3_s"], window), speed * np.pi * RADIUS**2
    rows.append(["flow out", f"{1e6 * flow:.4f} ml/s", "", f"{1e6 * imposed:.4f} ml/s", readme.off(flow / imposed)])
    # Sound runs to and fro: at one moment the fall is a tenth off, in the mean of a few frames still some per cent.
    late = case.last(0.5)
    drop = mean(probes["time_s"], probes["third.pressure_pa"] - probes["two-thirds.pressure_pa"], late)
    fall, slope = drop / (LENGTH / 3.0), 8.0 * case.viscosity * speed / RADIUS**2
    rows.append([f"fall of the pressure, {readme.from_to(late)}", "", f"{fall:.1f} Pa/m", f"{slope:.1f} Pa/m", readme.off(fall / slope)])
    rms = np.sqrt(np.mean((u - exact(r)) ** 2)) / (2.0 * speed)
    rows.append(["single particles, off by rms", f"{readme.percent(rms)} of the peak", "", "0", ""])
    draw(case, r, u, exact)
    text = [
        f"Means of {readme.from_to(window)}, {case.across(2.0 * RADIUS)} particles across, of the particles of the middle third:",
        readme.table(["", "found", "probe", "formula", "off by"], rows),
        readme.soundness(case),
    ]
    return {"result": "\n\n".join(text)}


def middle(case: Case, steps: list[int]) -> tuple[np.ndarray, ...]:
    """Distance from the axis (radii) and velocity along it [m/s] of the particles of the middle third."""
    columns = []
    for step in steps:
        frame = case.run.fluid[step]
        x = frame.position.astype(float)
        near = np.abs(x[:, 2] - 0.5 * LENGTH) < LENGTH / 6.0
        columns.append([np.hypot(x[near, 0], x[near, 1]) / RADIUS, frame["Velocity"][near, 2].astype(float)])
    return tuple(np.concatenate(column) for column in zip(*columns))


def draw(case: Case, r: np.ndarray, u: np.ndarray, exact) -> None:
    """The profile of single particles against the parabola."""
    fig, ax = plots.figure(1, 1, 6.5, 3.4)
    few = slice(None, None, max(1, len(r) // 4000))
    ax.plot(r[few], 1e3 * u[few], ".", color=plots.HERE, markersize=1.5, label="particles of the middle third")
    at = np.linspace(0.0, 1.0, 200)
    ax.plot(at, 1e3 * exact(at), color=plots.REFERENCE, label="Hagen and Poiseuille")
    ax.set(xlim=(0.0, 1.02), xlabel="distance from the axis over radius", ylabel="velocity along the pipe, mm/s")
    ax.grid(True)
    ax.legend()
    plots.save(case, fig)
