"""Stenosis: the drop of pressure, the energy of the blood on the axis, and what turns back behind the throat."""

from __future__ import annotations

import numpy as np

from . import particles, plots, readme
from .case import MMHG, Case, halves, mean, quantity
from .plane import Plane

RADIUS, THROAT = 2e-3, 1e-3
#: Length of the cosine [m].
LENGTH = 8e-3
#: What the jet loses as it widens, over `rho U^2 / 2 (A0 / A1 - 1)^2`: Borda and Carnot; blunt plugs after Seeley and Young (1976).
LOSS = [1.0, 1.52]


def radius(z):
    """Radius of the lumen [m], as the surface is made."""
    narrowing = 0.5 * (RADIUS - THROAT) * (1.0 + np.cos(2.0 * np.pi * z / LENGTH))
    return RADIUS - np.where(np.abs(z) < 0.5 * LENGTH, narrowing, 0.0)


def friction(flow: float, viscosity: float, z0: float, z1: float, of=radius) -> float:
    """Drop of pressure [Pa] by Poiseuille's law along a wall whose radius at a place is `of` it."""
    z = np.linspace(z0, z1, 4001)
    return float(np.trapezoid(8.0 * viscosity * flow / (np.pi * of(z) ** 4), z))


def widening(flow: float, density: float, wide: float = RADIUS, throat: float = THROAT) -> list[float]:
    """Bounds of what the jet loses as it widens from one radius [m] to another [Pa]."""
    u = flow / (np.pi * wide**2)
    return [k * 0.5 * density * u**2 * ((wide / throat) ** 2 - 1.0) ** 2 for k in LOSS]


def seeley_young(flow: float, density: float, viscosity: float) -> float:
    """Drop of pressure [Pa] after Seeley and Young, J. Biomech. 9 (1976) 439-448: `K_v mu U / D + K_t rho U^2 / 2 (A0 / A1 - 1)^2`,
    `K_v = 32 (0.83 L + 1.64 D_1) / D (A0 / A1)^2`."""
    u, diameter = flow / (np.pi * RADIUS**2), 2.0 * RADIUS
    k = 32.0 * (0.83 * LENGTH + 1.64 * 2.0 * THROAT) / diameter * (RADIUS / THROAT) ** 4
    return k * viscosity * u / diameter + widening(flow, density)[1]


def figures(case: Case) -> dict[str, str]:
    """Blocks of the README; draws the picture."""
    window = case.last(0.2)
    steps = case.steps(window)
    probes, openings = case.run.probes, case.run.openings
    t = probes["time_s"]
    names = ["before", "throat", "jet", "after"]
    z = {name: float(case.probe(name)[2]) for name in names}
    pressure = {name: mean(t, probes[f"{name}.pressure_pa"], window) for name in names}
    # By a fit, as the kernel of a probe is wide in the throat; pressures are even across it, and probes have them at every moment.
    speed = {name: particles.on_axis(case, steps, z[name], 0.5 * float(radius(z[name]))) for name in names}
    energy = {name: pressure[name] + 0.5 * case.density * speed[name] ** 2 for name in names}

    flow = quantity(case.opening("inlet")["value"])
    mean_speed = flow / (np.pi * RADIUS**2)
    wall = friction(flow, case.viscosity, z["before"], z["after"])
    low, high = (wall + loss for loss in widening(flow, case.density))
    drop = pressure["before"] - pressure["after"]
    turned = back(case, steps)
    place = lambda name: f"{1e3 * abs(z[name]):.0f} mm {'before' if z[name] < 0 else 'behind'}"  # noqa: E731
    mm_s = lambda value: f"{1e3 * value:.0f} mm/s"  # noqa: E731
    plug = mean_speed * (RADIUS / THROAT) ** 2
    rows = [
        [f"pressure drop, {place('before')} to {place('after')} the throat", f"{drop:.0f} Pa ({drop / MMHG:.1f} mmHg)", f"{low:.0f} to {high:.0f} Pa"],
        ["flow out", f"{1e6 * mean(openings['time_s'], openings['outlet.flow_m3_s'], window):.4f} ml/s", f"{1e6 * flow:.4f} ml/s"],
        [f"velocity on the axis, {place('before')}", mm_s(speed["before"]), f"{mm_s(2.0 * mean_speed)}, a parabola"],
        ["velocity on the axis, throat", mm_s(speed["throat"]), f"{mm_s(plug)}, a plug, to {mm_s(2.0 * plug)}, a parabola"],
        [f"the same, {place('jet')} and {place('after')}", f"{mm_s(speed['jet'])} and {mm_s(speed['after'])}", f"at least {mm_s(2.0 * mean_speed)}"],
        [f"`p + rho u^2 / 2` on the axis, {place('before')}, in the throat, {place('jet')}", ", ".join(f"{energy[n]:.0f}" for n in names[:3]) + " Pa", "may not rise (Bernoulli)"],
        ["blood that turns back behind the throat", turned, ""],
    ]  # fmt: skip
    draw(case, steps)
    parts = halves(t, probes["before.pressure_pa"] - probes["after.pressure_pa"], window), halves(t, probes["throat.w_m_s"], window)
    text = [
        f"Means of {readme.from_to(window)}, of which the two halves differ by {abs(parts[0]):.1f} Pa in the drop and {readme.percent(abs(parts[1]) / speed['throat'])}"
        f" in the velocity of the throat, {case.across(2 * THROAT)} particles across the throat:",
        readme.table(["", "found", "expected"], rows),
        verdict(energy, names[:3]) + " " + readme.soundness(case),
    ]
    source = (
        f"Poiseuille's law integrated along the wall gives the friction if the flow followed the wall, {wall:.0f} Pa from {place('before')} the throat to {place('after')} it;"
        f" what the jet loses as it widens is `K/2 rho U^2 (A0/A1 - 1)^2` with K = {LOSS[0]:.0f} after Borda and Carnot ({low - wall:.0f} Pa) or {LOSS[1]} as measured on blunt"
        f" plugs ({high - wall:.0f} Pa; Seeley and Young, J. Biomech. 9 (1976) 439-448). Together {low:.0f} to {high:.0f} Pa. Their formula as a whole, which counts the friction"
        f" of a plug with edges, would say {seeley_young(flow, case.density, case.viscosity):.0f} Pa."
    )
    return {"source": source, "result": "\n\n".join(text)}


def verdict(energy: dict[str, float], names: list[str]) -> str:
    """Whether blood on the axis gains energy, in words: it must not."""
    before, rest = energy[names[0]], [energy[name] for name in names[1:]]
    gain = max(rest) / before - 1.0
    # A twentieth is what such means may be off by, see tests/src/flows/narrowing.rs.
    if gain > 0.05:
        return f"**The core of the jet is too fast:** the energy of the blood on the axis rises by {readme.percent(gain, 0)}, which it cannot."
    return f"On the axis blood gains no energy: `p + rho u^2 / 2` is {readme.percent(max(rest) / before, 0)} of what it was before at most, and means such as these are good to a twentieth."


def back(case: Case, steps: list[int]) -> str:
    """From where to where behind the throat blood at the wall turns back, and how fast: means of the layer next to the wall, one spacing thick."""
    width = case.spacing
    bins = np.arange(0.0, 26e-3, width)
    sums, counts = np.zeros(len(bins)), np.zeros(len(bins))
    for step in steps:
        frame = case.run.fluid[step]
        x, w = frame.position.astype(float), frame["Velocity"][:, 2].astype(float)
        depth = radius(x[:, 2]) - np.hypot(x[:, 0], x[:, 1])
        near = (depth < width) & (x[:, 2] > 0.0) & (x[:, 2] < bins[-1])
        k = (x[near, 2] / width).astype(int)
        sums += np.bincount(k, w[near], len(bins))[: len(bins)]
        counts += np.bincount(k, minlength=len(bins))[: len(bins)]
    along = sums / np.maximum(counts, 1)
    turned = np.flatnonzero((along < 0.0) & (counts > 0))
    if not len(turned):
        return "none"
    return f"from {1e3 * bins[turned[0]]:.0f} to {1e3 * (bins[turned[-1]] + width):.0f} mm, up to {-1e3 * along.min():.0f} mm/s"


def draw(case: Case, steps: list[int]) -> None:
    """Speed and pressure on a plane through the axis."""
    fig, axes = plots.figure(2, 1, 8.0, 2.9, sharex=True)
    plane = Plane(case, [0.0, 0.0, 0.0], right=[0.0, 0.0, 1.0], up=[1.0, 0.0, 0.0])
    velocity, pressure = plane.mean("Velocity", steps), plane.mean("Pressure", steps)
    plots.show(axes[0], plane, np.linalg.norm(velocity, axis=-1), label="speed, m/s", vmin=0.0)
    plots.turning(axes[0], plane, np.where(plane.x > 0.0, velocity[..., 2], np.nan))
    largest = np.nanmax(np.abs(pressure))
    plots.show(axes[1], plane, pressure, label="pressure, Pa", cmap="RdBu_r", vmin=-largest, vmax=largest)
    for ax in axes:
        ax.set_ylabel("mm")
    axes[1].set_xlabel("along the artery, mm")
    plots.save(case, fig)
