"""Common carotid artery with an elastic wall, against the finite elements of Xiao et al. (2014)."""

from __future__ import annotations

import numpy as np

from . import particles, plots, pulsatile, readme
from .case import Case, data, mean, quantity, smooth, within

RADIUS, MIDDLE = 3e-3, 63e-3
#: Half of the slab in which the middle is told [m]: three hundredths of the length, as in validation.
HALF = 0.03 * 126e-3
#: Columns of the reference with their factor to SI.
COLUMNS = {"pressure": (1, 1e3), "flow": (2, 1e-6), "radius": (3, 1e-3)}


class Reference:
    """A curve of the reference over its cycle."""

    def __init__(self, rows: np.ndarray, what: str, period: float) -> None:
        column, scale = COLUMNS[what]
        self.t, self.values, self.period = rows[:, 0], scale * rows[:, column], period

    def __call__(self, t):
        return np.interp(t, self.t, self.values, period=self.period)


def figures(case: Case) -> dict[str, str]:
    """Blocks of the README; draws the picture."""
    rows = np.loadtxt(data("reference/boileau2015_cca") / "original_curves/B3D_commoncarotid.txt")
    period = case.period
    reference = {what: Reference(rows, what, period) for what in COLUMNS}
    # The last whole cycle of what was run, which need not begin with the inflow.
    window = (case.end - period, case.end)
    here = middle(case, window)

    # The two start their cycles at different times: ours is moved to where its pressure differs least.
    t, pressure = here["pressure"]
    shifts = np.arange(0.0, period, 1e-3)
    shift = shifts[np.argmin([((pressure - reference["pressure"](t + s)) ** 2).mean() for s in shifts])]
    rms = {what: float(np.sqrt(np.trapezoid((v - reference[what](s + shift)) ** 2, s) / period)) for what, (s, v) in here.items()}
    span = {what: (values.min(), values.max()) for what, (_, values) in here.items()}
    pulse = np.ptp(reference["pressure"].values)
    largest = {what: reference[what].values.max() for what in COLUMNS}

    def pressures(low: float, high: float, whole: float) -> str:
        return f"{1e-3 * low:.2f} to {1e-3 * high:.2f} kPa, mean {1e-3 * whole:.2f}"

    ref, ref_flow = reference["pressure"].values, reference["flow"].values
    compared = [
        ["pressure", pressures(*span["pressure"], mean(t, pressure, window)), pressures(ref.min(), ref.max(), ref.mean()),
         f"{readme.percent(rms['pressure'] / pulse)} of the pulse"],
        ["flow", *(f"{1e6 * a:.2f} to {1e6 * b:.2f} ml/s" for a, b in (span["flow"], (ref_flow.min(), ref_flow.max()))),
         f"{readme.percent(rms['flow'] / largest['flow'])} of the peak"],
        ["radius change since diastole", f"{1e3 * span['radius'][1]:.3f} mm", f"{1e3 * largest['radius']:.3f} mm",
         f"{readme.percent(rms['radius'] / largest['radius'])} of the largest"],
    ]  # fmt: skip

    openings, outlet = case.run.openings, case.opening("outlet")
    time = openings["time_s"]
    q = {name: mean(time, sign * openings[f"{name}.flow_m3_s"], window) for name, sign in (("inlet", -1.0), ("outlet", 1.0))}
    inflow_t, inflow = case.waveform("inlet")
    exact = mean(inflow_t, inflow, (0.0, period))
    elements = [quantity(outlet[f"{part}_resistance"]) for part in ("proximal", "distal")]
    expected = exact * sum(elements)
    first, last = (mean(t, pressure, edge) for edge in ((t[0], t[0] + 0.01 * period), (t[-1] - 0.01 * period, t[-1])))
    balance = [
        ["mean flow out, in", f"{1e6 * q['outlet']:.3f}, {1e6 * q['inlet']:.3f} ml/s", f"{1e6 * exact:.3f} ml/s"],
        ["mean pressure of the outlet", f"{1e-3 * mean(time, openings['outlet.pressure_pa'], window):.2f} kPa",
         f"{1e-3 * expected:.2f} kPa, mean flow times `R_p + R_d`"],
        ["pressure at the end of the cycle, by its start", f"{last - first:+.0f} Pa, {readme.percent(abs(last - first) / pulse)} of the pulse", "0"],
    ]  # fmt: skip
    rigid = pulsatile.windkessel(pulsatile.harmonics(inflow[:-1]), np.linspace(0.0, period, 400), period, *elements, quantity(outlet["compliance"]))
    draw(case, here, reference, shift)
    text = [
        f"The last whole cycle, from {readme.from_to(window)}, a spacing of {readme.spacing(case)}, {case.across(2 * RADIUS)} across, moved by {shift:.3f} s to the reference:",
        readme.table(["in the middle", "here", "finite elements", "difference, rms"], compared),
        readme.table(["", "found", "expected"], balance),
        f"Without the elastic wall the same outlet would swing from {1e-3 * rigid.min():.2f} to {1e-3 * rigid.max():.2f} kPa."
        f" The wall widens by {1e3 * span['radius'][1]:.3f} mm,"
        f" {readme.off(span['radius'][1] / largest['radius'], 0)} against the reference, a membrane on the lumen,"
        f" for which `p r^2 (1 - nu^2) / (E h)` gives {1e3 * membrane(case, pulse):.3f} mm. " + readme.soundness(case),
    ]
    return {"result": "\n\n".join(text)}


def membrane(case: Case, pressure: float) -> float:
    """Radius change [m] of a thin elastic tube held in its length: Laplace's and Hooke's laws, `nu` 1/2 as the reference has it."""
    wall = case.toml["wall"]
    return pressure * RADIUS**2 * (1.0 - 0.5**2) / (quantity(wall["young_modulus"]) * quantity(wall["thickness"]))


def middle(case: Case, window: tuple[float, float]) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """Pressure [Pa], flow [m^3/s] and radius change [m] of the middle over the cycle."""
    probes = case.run.probes
    # Sound of single moments is taken away, by means over a hundredth of the cycle.
    width = 0.01 * (window[1] - window[0])
    found = {"pressure": (probes["time_s"], smooth(probes["time_s"], probes["middle.pressure_pa"], width))}
    origin, axis = np.array([0.0, 0.0, MIDDLE]), np.array([0.0, 0.0, 1.0])
    times = case.run.fluid.times
    # One frame more on each side, so that values at the ends of the window lie between two.
    steps = [k for k in range(len(times)) if window[0] - 0.05 < times[k] < window[1] + 0.05]
    found["flow"] = (times[steps], np.array([particles.flow_through(case, step, origin, axis, 2.0 * HALF) for step in steps]))
    wall = case.run.wall
    found["radius"] = (wall.times, np.array([radius_change(frame) for frame in wall]))
    cut = {what: within(*curve, window) for what, curve in found.items()}
    t, change = cut["radius"]
    # The reference counts from diastole.
    return {**cut, "radius": (t, change - change.min())}


def radius_change(frame) -> float:
    """Mean radial displacement [m] of the wall in the middle."""
    moved = frame["Displacement"].astype(float)
    place = frame.position.astype(float) - moved
    near = np.abs(place[:, 2] - MIDDLE) < HALF
    out = place[near, :2] / np.linalg.norm(place[near, :2], axis=1, keepdims=True)
    return float((moved[near, :2] * out).sum(axis=1).mean())


def draw(case: Case, here, reference, shift: float) -> None:
    """Three curves over the cycle."""
    fig, axes = plots.figure(1, 3, 9.0, 2.7)
    for ax, (what, scale, title) in zip(axes, [("pressure", 1e-3, "pressure, kPa"), ("flow", 1e6, "flow, ml/s"), ("radius", 1e3, "radius change, mm")]):
        t, values = here[what]
        curve = np.linspace(t[0], t[-1], 500)
        ax.plot(curve, scale * reference[what](curve + shift), color=plots.REFERENCE, label="finite elements")
        each = max(1, len(t) // 60)
        ax.plot(t[::each], scale * values[::each], "o", color=plots.HERE, markersize=3, label="here")
        ax.set(title=title, xlabel="time, s")
        ax.grid(True)
    axes[0].legend()
    plots.save(case, fig)
