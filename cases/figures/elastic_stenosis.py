"""Elastic stenosis: the wall filled against a resistance, the pressure that the throat takes, and how far the wall gives way."""

from __future__ import annotations

import numpy as np
from scipy.integrate import solve_ivp

from . import plots, readme, stenosis
from .case import MMHG, Case, mean, quantity
from .elastic_tube import grown, widening
from .plane import Plane

RADIUS, THROAT = 3e-3, 1.5e-3
#: Length of the buffers [spacings], over which the wall is held.
BUFFER = 4.0
#: Length of the cosine, and from where to where the artery goes [m].
NARROWED, START, END = 12e-3, -15e-3, 45e-3


def radius(z):
    """Radius of the lumen at rest [m], as the surface is made."""
    narrowing = 0.5 * (RADIUS - THROAT) * (1.0 + np.cos(2.0 * np.pi * z / NARROWED))
    return RADIUS - np.where(np.abs(z) < 0.5 * NARROWED, narrowing, 0.0)


class Vessel:
    """An artery whose wall gives way at each place as a long tube of its radius there, before a resistance."""

    def __init__(self, case: Case) -> None:
        wall, inlet = case.toml["wall"], case.opening("inlet")
        self.young, self.thickness = quantity(wall["young_modulus"]), quantity(wall["thickness"])
        self.resistance = quantity(case.opening("outlet")["resistance"])
        self.flow, self.ramp = quantity(inlet["value"]), quantity(inlet["ramp"])
        # Next to an edge that is clamped a long tube lacks the widening of a length 1/b, b^4 = 3 (1 - nu^2) / (R t)^2.
        bent = np.sqrt((RADIUS + 0.5 * self.thickness) * self.thickness) / (3.0 * 0.75) ** 0.25
        #: Length at each end that does not widen [m].
        self.held = BUFFER * case.spacing + bent
        #: Density times the square of the sound speed [Pa]: the blood gives way, too.
        self.stiffness = case.density * case.summary["sound_speed_m_s"] ** 2

    def lumen(self, z, pressure: float):
        """Radius of the lumen [m] at places [m] under a pressure [Pa]."""
        at_rest = np.unique(np.round(radius(np.asarray(z)), 7))
        return np.interp(radius(np.asarray(z)), at_rest, [grown(self.young, r, self.thickness, pressure) for r in at_rest])

    def volume(self, pressure: float) -> float:
        """Blood [m^3] at rest density in the artery under a pressure [Pa]."""
        z = np.linspace(START, END, 601)
        widens = (z > START + self.held) & (z < END - self.held)
        inside = float(np.trapezoid(np.pi * np.where(widens, self.lumen(z, pressure), radius(z)) ** 2, z))
        return inside * (1.0 + pressure / self.stiffness)

    def outflow(self, t: np.ndarray) -> np.ndarray:
        """Flow out [m^3/s] at times [s], `R Q` the pressure all along: what comes in goes out or widens the artery."""
        pressures = np.linspace(0.0, 1.2 * self.resistance * self.flow, 25)
        volumes = np.array([self.volume(p) for p in pressures])
        comes_in = lambda t: self.flow * np.where(t < self.ramp, 0.5 - 0.5 * np.cos(np.pi * t / self.ramp), 1.0)  # noqa: E731
        slope = lambda t, v: comes_in(t) - np.interp(v, volumes, pressures) / self.resistance  # noqa: E731
        found = solve_ivp(slope, (0.0, t[-1]), [volumes[0]], t_eval=t, rtol=1e-9, atol=1e-15, max_step=1e-3).y[0]
        return np.interp(found, volumes, pressures) / self.resistance


def figures(case: Case) -> dict[str, str]:
    """Blocks of the README; draws the picture."""
    window, vessel = case.last(0.25), Vessel(case)
    probes, openings = case.run.probes, case.run.openings
    t, out = openings["time_s"], openings["outlet.flow_m3_s"]
    z = {name: float(case.probe(name)[2]) for name in ("before", "throat", "after")}
    pressure = {name: mean(probes["time_s"], probes[f"{name}.pressure_pa"], window) for name in z}
    flow, behind = mean(t, out, window), mean(t, openings["outlet.pressure_pa"], window)
    kpa, ml = (lambda p: f"{1e-3 * p:.3f} kPa"), (lambda q: f"{1e6 * q:.3f} ml/s")
    asked = vessel.resistance * vessel.flow
    widened = lambda place: vessel.lumen(place, asked)  # noqa: E731
    wide, throat = float(widened(np.array([20e-3]))[0]), float(widened(np.array([0.0]))[0])
    friction = stenosis.friction(vessel.flow, case.viscosity, z["before"], z["after"], widened)
    low, high = (friction + loss for loss in stenosis.widening(vessel.flow, case.density, wide, throat))
    drop = pressure["before"] - pressure["after"]
    places, moved = widening(case, case.run.wall[-1], START, END - START)
    expected = vessel.outflow(t)
    half = lambda q: 1e3 * float(np.interp(0.5 * vessel.flow, smooth_rise(q), t))  # noqa: E731
    rows = [
        ["pressure at the outlet", kpa(behind), f"{kpa(asked)}, `R Q`", readme.off(behind / asked)],
        ["flow out", ml(flow), ml(vessel.flow), readme.off(flow / vessel.flow)],
        ["half of it comes out after", f"{half(out):.1f} ms", f"{half(expected):.1f} ms", readme.off(half(out) / half(expected))],
        [f"pressure drop, {1e3 * -z['before']:.0f} mm before to {1e3 * z['after']:.0f} mm behind the throat", f"{drop:.0f} Pa ({drop / MMHG:.1f} mmHg)", f"{low:.0f} to {high:.0f} Pa", ""],
    ]  # fmt: skip
    for name, words in [("before", "before the throat"), ("throat", "in the throat"), ("after", "behind it")]:
        found, value = float(np.interp(z[name], places, moved)), middle(vessel, z[name], pressure[name])
        alone = readme.off(found / value) if name != "throat" else ""
        rows.append([f"widening of the wall {words}", f"{1e3 * found:.4f} mm", f"{1e3 * value:.4f} mm", alone])
    draw(case, vessel, (t, out, expected), (places, moved))
    text = [
        f"Means of {readme.from_to(window)}, {case.across(2.0 * THROAT)} particles across the throat at rest:",
        readme.table(["", "found", "expected", "off by"], rows),
        readme.soundness(case),
    ]
    return {"result": "\n\n".join(text)}


def smooth_rise(flow: np.ndarray) -> np.ndarray:
    """The highest flow so far, which rises."""
    return np.maximum.accumulate(flow)


def middle(vessel: Vessel, z: float, pressure: float) -> float:
    """Displacement [m] of the middle of the wall, which grows by as much in its square as the lumen."""
    at_rest = float(radius(np.array([z]))[0])
    surface = at_rest + 0.5 * vessel.thickness
    return float(np.sqrt(surface**2 + float(vessel.lumen(np.array([z]), pressure)[0]) ** 2 - at_rest**2) - surface)


def draw(case: Case, vessel: Vessel, outflow, wall) -> None:
    """Speed in a plane through the axis, the wall along the artery, and the flow that comes out."""
    fig, (top, left, right) = plots.figure(3, 1, 8.0, 6.4)
    plane = Plane(case, [0.0, 0.0, 0.5 * (START + END)], right=[0.0, 0.0, 1.0], up=[1.0, 0.0, 0.0])
    velocity = plane.mean("Velocity", case.steps(case.last(0.25)))
    plots.show(top, plane, np.linalg.norm(velocity, axis=-1), label="speed, m/s", vmin=0.0)
    z = np.linspace(START, END, 200)
    at_rest = vessel.resistance * vessel.flow
    left.plot(1e3 * z, [1e3 * middle(vessel, place, at_rest) for place in z], color=plots.REFERENCE, label="Rivlin, each place by itself")
    left.plot(1e3 * wall[0], 1e3 * wall[1], "o", color=plots.HERE, markersize=3, label="here")
    left.set(title="widening of the wall, mm", xlabel="along the artery, mm")
    t, out, expected = outflow
    right.plot(1e3 * t, 1e6 * expected, color=plots.REFERENCE, label="formula")
    right.plot(1e3 * t, 1e6 * out, color=plots.HERE, label="here")
    right.set(title="flow out, ml/s", xlabel="time, ms")
    for ax in (left, right):
        ax.grid(True)
        ax.legend()
    plots.save(case, fig)
