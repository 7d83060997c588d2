"""FDA nozzle: velocities on the axis against what laboratories measured."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from . import particles, plots, readme
from .case import Case, data, mean, quantity
from .plane import Plane

THROAT, CONE = 2e-3, (-62.685e-3, -40e-3)
#: Where they measured on the axis [mm], and what is there.
STATIONS = {-64: "tube", -48: "cone", -42: "cone", -20: "throat", -8: "throat", 0: "expansion", 8: "jet", 16: "jet", 24: "jet", 32: "jet"}
#: What validation asks of a station (docs/validation.md).
ASKED = 0.05


def figures(case: Case) -> dict[str, str]:
    """Blocks of the README; draws the picture."""
    measured = experiments(data("reference/fda_nozzle") / "re0500/sudden_expansion/experiment")
    window = case.last(0.25)
    steps = case.steps(window)
    speed = {z: on_axis(case, steps, 1e-3 * z) for z in STATIONS}
    off = {z: speed[z] / measured[z].mean() - 1.0 for z in STATIONS}
    rows = [
        [f"{place}, {z} mm", f"{speed[z]:.3f} m/s", f"{measured[z].mean():.3f} m/s", f"{measured[z].min():.3f} to {measured[z].max():.3f}", readme.off(1.0 + off[z], 0)]
        for z, place in STATIONS.items()
    ]

    openings, probes = case.run.openings, case.run.probes
    t, flow = openings["time_s"], quantity(case.opening("inlet")["value"])
    energy = [
        mean(probes["time_s"], probes[f"z{z}.pressure_pa"], window) + 0.5 * case.density * speed[z] ** 2 for z in (-48, -20, -8, 0)
    ]
    plug = flow / (np.pi * THROAT**2)
    inlet, outlet = (mean(t, sign * openings[f"{name}.flow_m3_s"], window) for name, sign in (("inlet", -1.0), ("outlet", 1.0)))
    whole = [
        ["flow out", f"{1e6 * outlet:.3f} ml/s", f"{1e6 * flow:.3f} ml/s"],
        ["`p + rho u^2 / 2` on the axis, at -48, -20, -8 and 0 mm", ", ".join(f"{value:.0f}" for value in energy) + " Pa", "may not rise (Bernoulli)"],
        ["velocity on the axis at the end of the throat", f"{speed[0]:.3f} m/s", f"{plug:.3f} m/s, a plug, to {2.0 * plug:.3f} m/s, a parabola"],
        ["pressure, -48 to 0 mm", f"{mean(probes['time_s'], probes['z-48.pressure_pa'] - probes['z0.pressure_pa'], window):.0f} Pa", ""],
    ]  # fmt: skip
    draw(case, steps, measured)
    met = sum(abs(value) <= ASKED for value in off.values())
    spread = sum(measured[z].min() <= speed[z] <= measured[z].max() for z in STATIONS)
    gain = max(energy[1:]) / energy[0] - 1.0
    text = [
        f"Means of {readme.from_to(window)} from rest, {case.across(2.0 * THROAT)} particles across the throat, by a parabola fitted to the particles about the axis:",
        readme.table(["place", "found", "measured, mean", "from, to", "off by"], rows),
        f"**{met} of {len(STATIONS)} places are within {readme.percent(ASKED, 0)} of what was measured, {spread} within its spread**;"
        f" the farthest is {readme.percent(max(map(abs, off.values())), 0)} off.",
        readme.table(["", "found", "expected"], whole),
        (f"On the axis `p + rho u^2 / 2` rises by {readme.percent(gain, 0)}, which it cannot. " if gain > 0.05 else "") + readme.soundness(case),
    ]
    return {"result": "\n\n".join(text)}


def on_axis(case: Case, steps: list[int], z: float) -> float:
    """Velocity on the axis [m/s], from within half the radius of the throat: the jet is hardly wider."""
    return particles.on_axis(case, steps, z, max(0.5 * THROAT, 1.5 * case.spacing))


def experiments(folder: Path) -> dict[int, np.ndarray]:
    """Velocities on the axis [m/s] at each station, of the sets that have it: Hariharan et al., J. Biomech. Eng. 133 (2011) 041002."""
    found: dict[int, list[float]] = {z: [] for z in STATIONS}
    for file in sorted(folder.glob("PIV_Sudden_Expansion_500_*.txt")):
        lines = file.read_text().splitlines()
        start = next(k for k, line in enumerate(lines) if line.startswith("plot-z-distribution-axial-velocity"))
        for line in lines[start + 2 : start + 2 + int(lines[start + 1])]:
            z, u = map(float, line.split()[:2])
            place = round(1e3 * z)
            if place in found and abs(1e3 * z - place) < 1e-3:
                found[place].append(u)
    return {z: np.array(values) for z, values in found.items()}


def draw(case: Case, steps: list[int], measured: dict[int, np.ndarray]) -> None:
    """Velocity in a plane through the axis, and on the axis."""
    fig, axes = plots.figure(2, 1, 8.0, 4.4, height_ratios=[1.0, 2.2], sharex=True)
    plane = Plane(case, [0.0, 0.0, 0.0], right=[0.0, 0.0, 1.0], up=[1.0, 0.0, 0.0])
    along = plane.mean("Velocity", steps)[..., 2]
    plots.show(axes[0], plane, along, label="along the axis, m/s", title="")
    plots.turning(axes[0], plane, np.where(plane.x > 0.0, along, np.nan))
    axes[0].set_ylabel("mm")
    places = np.arange(-75e-3, 39e-3, 1e-3)
    axes[1].plot(1e3 * places, [on_axis(case, steps, z) for z in places], color=plots.HERE, label=f"here, {case.across(2.0 * THROAT)} spacings across the throat")
    middle = [values.mean() for values in measured.values()]
    spread = [[m - values.min() for m, values in zip(middle, measured.values())], [values.max() - m for m, values in zip(middle, measured.values())]]
    axes[1].errorbar(list(measured), middle, yerr=spread, fmt="o", color=plots.REFERENCE, markersize=4, capsize=3, label="measured, mean and range")
    axes[1].set(xlabel="along the axis, mm", ylabel="velocity on the axis, m/s", ylim=(0.0, None))
    axes[1].grid(True)
    axes[1].legend()
    plots.save(case, fig)
