"""Aorta with arch: a beat between an inflow and four Windkessels."""

from __future__ import annotations

import numpy as np

from . import plots, pulsatile, readme, wall
from .case import MMHG, UNITS, Case, quantity
from .plane import Plane

OUTLETS = {"descending": "descending aorta", "brachiocephalic": "brachiocephalic", "left-carotid": "left carotid", "left-subclavian": "left subclavian"}
#: Above this height [m] are the arteries of the arch.
ARTERIES = 50e-3
#: Moments of the beat that are looked at [s].
MOMENTS = {"peak": 0.16, "end of systole": 0.36}


def figures(case: Case) -> dict[str, str]:
    """Blocks of the README; draws the picture."""
    window, period = case.last_cycle(), case.period
    index = round(window[0] / period)
    cycle = next(c for c in case.summary["cycles"] if c["index"] == index)
    found = {o["name"]: o for o in cycle["openings"]}
    t, inflow = case.waveform("ascending")
    waves = pulsatile.harmonics(inflow[:-1])
    elements = np.array([[quantity(case.opening(o)[key]) for key in ("proximal_resistance", "distal_resistance", "compliance")] for o in OUTLETS])
    conductance = 1.0 / elements[:, :2].sum(axis=1)
    expected = conductance / conductance.sum()
    # Outlets side by side behind a vessel without resistance: what the pressure would be if only they counted.
    alone = together(waves, np.linspace(0.0, period, 500, endpoint=False), period, elements) / MMHG
    descending = found["descending"]
    periodic = cycle["periodicity"]
    out = sum(found[o]["mean_flow_m3_s"] for o in OUTLETS)
    fastest, where, aorta = speeds(case, case.steps(window))
    shear = regions(case)
    percents = lambda parts, digits: ", ".join(f"{100.0 * p:.{digits}f}" for p in parts) + " %"  # noqa: E731
    rows = [
        ["flow split: " + ", ".join(OUTLETS.values()), percents([found[o]["flow_split"] for o in OUTLETS], 2), percents(expected, 2) + ", by the resistances"],
        ["mean pressure of the descending aorta", f"{descending['mean_pressure_pa'] / MMHG:.2f} mmHg", f"{alone.mean():.2f} mmHg, mean flow by all resistances"],
        ["its systolic and diastolic pressure", f"{descending['systolic_pressure_pa'] / MMHG:.1f} over {descending['diastolic_pressure_pa'] / MMHG:.1f} mmHg",
         f"{alone.max():.1f} over {alone.min():.1f}, by the Windkessels alone"],
        ["outflow, by inflow", f"{-out / found['ascending']['mean_flow_m3_s']:.4f}", "1"],
        ["beat after beat, of the range", f"flow {readme.percent(periodic['flow'])}, pressure {readme.percent(periodic['pressure'])}, wall shear stress {readme.percent(periodic['wall_shear'])}", "0"],
        ["fastest blood", f"{fastest:.1f} m/s, in the {OUTLETS[where]}; {aorta:.1f} m/s in the aorta", ""],
        ["least flow out of the descending aorta", f"{1e6 * descending['min_flow_m3_s']:.0f} ml/s", ""],
        ["wall shear stress, mean over the beat", ", ".join(f"{value:.2f} Pa {name}" for name, value in shear.items()), ""],
    ]  # fmt: skip
    draw(case, window)
    narrow = [f"{case.across(2.0 * radius(case, o))} the {OUTLETS[o]}" for o in ("left-carotid", "left-subclavian")]
    text = [
        f"Beat {index + 1} of {len(case.summary['cycles'])}, {case.across(2.0 * radius(case, 'ascending'))} particles across the ascending aorta, {narrow[0]} and {narrow[1]} artery:",
        readme.table(["", "found", "expected"], rows),
        f"The peak has a Reynolds number of {case.summary['numbers']['reynolds_peak']:.0f}. " + readme.soundness(case),
    ]
    return {"result": "\n\n".join(text)}


def together(waves: np.ndarray, t: np.ndarray, period: float, elements: np.ndarray) -> np.ndarray:
    """Pressure [Pa] of several Windkessels side by side, each `R_p`, `R_d`, `C`, for the flow of all: their admittances add."""
    omega = 2.0 * np.pi * np.arange(len(waves)) / period
    admittance = sum(1.0 / (proximal + distal / (1.0 + 1j * omega * distal * compliance)) for proximal, distal, compliance in elements)
    return pulsatile.series(waves / admittance, t, period)


def radius(case: Case, opening: str) -> float:
    """Radius of an opening [m]."""
    return next(o["radius_m"] for o in case.summary["openings"] if o["name"] == opening)


def speeds(case: Case, steps: list[int]) -> tuple[float, str, float]:
    """Fastest blood [m/s] of the arteries of the arch and in which, and that of the aorta: what one particle in a thousand exceeds."""
    arteries = [o for o in OUTLETS if o != "descending"]
    # They rise nearly straight: the nearest opening across is that of the artery.
    across = np.array([UNITS["mm"] * case.opening(o)["near"][0] for o in arteries])
    best, aorta = {o: 0.0 for o in arteries}, 0.0
    for step in steps:
        frame = case.run.fluid[step]
        x, speed = frame.position.astype(float), np.linalg.norm(frame["Velocity"].astype(float), axis=1)
        up = x[:, 2] > ARTERIES
        nearest = np.argmin(np.abs(x[:, :1] - across), axis=1)
        for k, name in enumerate(arteries):
            best[name] = max(best[name], float(np.quantile(speed[up & (nearest == k)], 0.999)))
        aorta = max(aorta, float(np.quantile(speed[x[:, 2] < 0.8 * ARTERIES], 0.999)))
    where = max(best, key=lambda name: best[name])
    return best[where], where, aorta


def regions(case: Case) -> dict[str, float]:
    """Mean wall shear stress over the beat [Pa] of the parts of the aorta, without four spacings next to the openings."""
    x, area, tawss, _ = wall.points(case)
    low = [UNITS["mm"] * case.opening(o)["near"][2] + 4.0 * case.spacing for o in ("ascending", "descending")]
    descending = UNITS["mm"] * case.opening("descending")["near"][0]
    left, top = x[:, 0] < 0.5 * descending, x[:, 2]
    parts = {
        "ascending": left & (top < 0.0) & (top > low[0]),
        "arch": (top > 0.0) & (top < 0.8 * ARTERIES),
        "descending": ~left & (top < 0.0) & (top > low[1]),
    }
    return {name: float(np.average(tawss[part], weights=area[part])) for name, part in parts.items()}


def draw(case: Case, window: tuple[float, float]) -> None:
    """Two moments in the plane of the arch, and the flow through all openings."""
    fig, axes = plots.figure(1, 3, 10.0, 4.6)
    plane = Plane(case, [0.0, 0.0, 0.0], right=[1.0, 0.0, 0.0], up=[0.0, 0.0, 1.0])
    for ax, (what, moment) in zip(axes, MOMENTS.items()):
        frame = case.run.fluid.at(window[0] + moment)
        velocity = plane.mean("Velocity", [frame.index])
        title = f"speed at {frame.time - window[0]:.2f} s, {what}"
        plots.show(ax, plane, np.linalg.norm(velocity, axis=-1), label="m/s", title=title, vmin=0.0, bar="bottom")
        plots.directions(ax, plane, velocity, 6e-3)
    table = case.run.openings
    t = table["time_s"]
    inside = (t >= window[0]) & (t <= window[1])
    axes[2].plot(t[inside] - window[0], -1e6 * table["ascending.flow_m3_s"][inside], color="black", label="ascending aorta, in")
    for name, title in OUTLETS.items():
        axes[2].plot(t[inside] - window[0], 1e6 * table[f"{name}.flow_m3_s"][inside], label=title)
    axes[2].set(title="flow, ml/s", xlabel="time in the beat, s")
    axes[2].grid(True)
    axes[2].legend()
    plots.save(case, fig)
