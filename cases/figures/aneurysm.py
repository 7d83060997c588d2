"""Abdominal aortic aneurysm: a beat between an inflow and a Windkessel, and the wall shear stress over it."""

from __future__ import annotations

import numpy as np

from . import particles, plots, pulsatile, readme, wall
from .case import MMHG, Case, quantity
from .plane import Plane

RADIUS, LENGTH = 10e-3, 80e-3
#: Constant viscosity [Pa s] of the formula, which blood comes near to where it is sheared fast.
VISCOSITY = 3.5e-3
#: Moments of the beat that are looked at: systole and diastole.
MOMENTS = {"systole": 0.2, "diastole": 0.6}
#: The developed part of the aorta before the aneurysm [m].
BEFORE = (-60e-3, -42e-3)


def figures(case: Case) -> dict[str, str]:
    """Blocks of the README; draws the picture."""
    window, period = case.last_cycle(), case.period
    index = round(window[0] / period)
    cycle = next(c for c in case.summary["cycles"] if c["index"] == index)
    outlet = next(o for o in cycle["openings"] if o["name"] == "outlet")
    t, inflow = case.waveform("inlet")
    waves = pulsatile.harmonics(inflow[:-1])
    moments = np.linspace(0.0, period, 500, endpoint=False)
    said = case.opening("outlet")
    elements = [quantity(said[key]) for key in ("proximal_resistance", "distal_resistance", "compliance")]
    alone = pulsatile.windkessel(waves, moments, period, *elements) / MMHG

    frames = {what: case.run.fluid.at(window[0] + part * period).index for what, part in MOMENTS.items()}
    when = {what: float(case.run.fluid.times[step]) for what, step in frames.items()}
    middle, axis = np.zeros(3), np.array([0.0, 0.0, 1.0])
    through = {what: particles.flow_through(case, step, middle, axis, 0.25 * LENGTH) for what, step in frames.items()}
    rigid = {what: float(np.interp(when[what] % period, t, inflow)) for what in frames}

    x, area, tawss, osi = wall.points(case)
    z = x[:, 2]
    before, third = (z > BEFORE[0]) & (z < BEFORE[1]), np.abs(z) < LENGTH / 6.0
    over = lambda values, part: float(np.average(values[part], weights=area[part]))  # noqa: E731
    tau = pulsatile.shear_of_flow(waves, moments, period, RADIUS, case.density, VISCOSITY)
    magnitude = np.abs(tau).mean()
    periodic = cycle["periodicity"]
    ml = lambda flow, digits: f"{1e6 * flow:.{digits}f}"  # noqa: E731
    on = {what: 1e3 * particles.on_axis(case, [step], 0.0, 5e-3) for what, step in frames.items()}
    rows = [
        ["pressure of the outlet", f"{outlet['systolic_pressure_pa'] / MMHG:.1f} over {outlet['diastolic_pressure_pa'] / MMHG:.1f} mmHg, mean {outlet['mean_pressure_pa'] / MMHG:.1f}",
         f"{alone.max():.1f} over {alone.min():.1f}, mean {alone.mean():.1f}, by the Windkessel alone"],
        ["mean flow out", f"{ml(outlet['mean_flow_m3_s'], 2)} ml/s, {readme.percent(abs(cycle['mass_balance_error']), 2)} off that in", f"{ml(waves[0].real, 2)} ml/s"],
        [f"flow through the middle at {MOMENTS['systole']} and {MOMENTS['diastole']} s", " and ".join(ml(q, 1) for q in through.values()) + " ml/s",
         " and ".join(ml(q, 1) for q in rigid.values()) + " ml/s, as the wall is rigid"],
        ["blood on the axis in the middle, then", " and ".join(f"{u:.0f}" for u in on.values()) + " mm/s", ""],
        ["beat after beat, of the range", f"flow {readme.percent(periodic['flow'])}, pressure {readme.percent(periodic['pressure'])}, wall shear stress {readme.percent(periodic['wall_shear'])}", "0"],
        ["wall shear stress, mean over the beat: before the aneurysm", f"{over(tawss, before):.2f} Pa", f"{magnitude:.2f} Pa after Womersley, for {1e3 * VISCOSITY} mPa s"],
        ["the same in its middle third", f"{over(tawss, third):.2f} Pa, at least {tawss[third].min():.2f} Pa", ""],
        ["oscillatory shear index: before and in the middle third", f"{over(osi, before):.2f} and {over(osi, third):.2f}", f"{0.5 * (1.0 - abs(tau.mean()) / magnitude):.2f} before, after Womersley"],
        ["wall below 0.4 Pa", readme.percent(case.summary["wall"]["low_tawss_area_fraction"], 0), ""],
    ]  # fmt: skip
    draw(case, frames, window, (z, tawss, osi))
    alpha = pulsatile.womersley_number(RADIUS, 2.0 * np.pi / period, case.density, VISCOSITY)
    text = [
        f"Beat {index + 1} of {len(case.summary['cycles'])}, {case.across(2.0 * RADIUS)} particles across the aorta and {case.across(5.0 * RADIUS)} across the aneurysm:",
        readme.table(["", "found", "expected"], rows),
        f"The wall shear stress before the aneurysm is {readme.off(over(tawss, before) / magnitude, 0)} against the formula: at a Womersley number of {alpha:.1f}"
        f" the layer at the wall is {1e3 * RADIUS / alpha:.1f} mm thick, {RADIUS / alpha / case.spacing:.1f} spacings. The flow has a Reynolds number of"
        f" {case.summary['numbers']['reynolds_peak']:.0f} at its peak. " + readme.soundness(case),
    ]
    return {"result": "\n\n".join(text)}


def draw(case: Case, frames: dict[str, int], window: tuple[float, float], along: tuple[np.ndarray, ...]) -> None:
    """Two moments in a plane through the axis, and the wall along it."""
    fig, axes = plots.figure(2, 2, 9.0, 5.4)
    plane = Plane(case, [0.0, 0.0, 0.0], right=[0.0, 0.0, 1.0], up=[1.0, 0.0, 0.0])
    for ax, (what, step) in zip(axes[0], frames.items()):
        velocity = plane.mean("Velocity", [step])
        title = f"speed at {case.run.fluid.times[step] - window[0]:.2f} s, {what}"
        plots.show(ax, plane, 1e3 * np.linalg.norm(velocity, axis=-1), label="mm/s", title=title, vmin=0.0, bar="bottom")
        plots.directions(ax, plane, velocity, 5e-3)
    z, *values = along
    bins = np.linspace(z.min(), z.max() + 1e-9, 41)
    which = np.digitize(z, bins) - 1
    count = np.bincount(which, minlength=40)
    for ax, value, title in zip(axes[1], values, ["time-averaged wall shear stress, Pa", "oscillatory shear index"]):
        ax.plot(1e3 * z, value, ".", color="0.7", markersize=1, rasterized=True)
        ax.plot(1e3 * 0.5 * (bins[1:] + bins[:-1]), np.bincount(which, value, 40) / np.maximum(count, 1), color=plots.HERE)
        ax.set(title=title, xlabel="along the aorta, mm")
        ax.grid(True)
    plots.save(case, fig)
