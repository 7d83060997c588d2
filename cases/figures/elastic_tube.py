"""Steady flow in an elastic tube: Poiseuille's law in a tube whose radius follows the pressure."""

from __future__ import annotations

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from . import plots, readme
from .case import Case, mean, quantity

RADIUS, LENGTH = 3e-3, 36e-3
#: Distances from the axis [m], by the names of the probes.
PROBES = {"axis": 0.0, "half": 1.5e-3, "outer": 2.25e-3}
NAMES = {"axis": "on the axis", "half": "at 1.5 mm", "outer": "at 2.25 mm"}


def grown(young: float, inner: float, thickness: float, pressure: float) -> float:
    """Radius of the lumen [m] of a thick neo-Hookean tube in plane strain, `inner` at rest, whose wall keeps its volume (Rivlin 1949)."""
    outer = inner + thickness

    def load(square: float) -> float:
        a, b = np.sqrt(1.0 + square / inner**2), np.sqrt(1.0 + square / outer**2)
        return young / 3.0 * (np.log(a / b) + 0.5 * (b**-2 - a**-2)) - pressure

    return float(np.sqrt(inner**2 + brentq(load, 0.0, 3.0 * inner**2)))


class Tube:
    """A tube of incompressible rubber, held in its length, with a creeping flow [m^3/s] through it."""

    def __init__(self, young: float, thickness: float, viscosity: float, flow: float, outlet: float) -> None:
        self.young, self.thickness, self.viscosity, self.flow, self.outlet = young, thickness, viscosity, flow, outlet

    def lumen(self, pressure: float) -> float:
        """Radius of the lumen [m] under a pressure [Pa], far from the ends.

        It is that of a tube in plane strain, with what a tube of finite length widens more: next to ends that are held the wall widens less, as much as over a length `1/b` not at all, `b^4 = 3 (1 - nu^2) / (R t)^2` (Timoshenko and
        Woinowsky-Krieger 1959, chapter 15). There it contracts less along the axis, and so more in between.
        """
        plane = grown(self.young, RADIUS, self.thickness, pressure) - RADIUS
        held = np.sqrt((RADIUS + 0.5 * self.thickness) * self.thickness) / (3.0 * 0.75) ** 0.25
        return float(RADIUS + plane / (1.0 - 0.25 * 2.0 * held / LENGTH))

    def pressure(self, z: np.ndarray) -> np.ndarray:
        """Pressure [Pa] along the axis, from that at the outlet: `dp/dz = -8 mu Q / (pi a^4)` (Fung, Biomechanics: Circulation, 1997, section 3.4)."""
        slope = lambda _, p: -8.0 * self.viscosity * self.flow / (np.pi * self.lumen(p[0]) ** 4)  # noqa: E731
        places = np.sort(z)[::-1]
        found = solve_ivp(slope, (LENGTH, 0.0), [self.outlet], t_eval=places, rtol=1e-9, atol=1e-9).y[0]
        return np.interp(z, places[::-1], found[::-1])

    def velocity(self, r: np.ndarray | float) -> np.ndarray | float:
        """Velocity along the tube [m/s] in its middle: a parabola up to the wall."""
        a = self.lumen(float(self.pressure(np.array([0.5 * LENGTH]))[0]))
        return 2.0 * self.flow / (np.pi * a**2) * (1.0 - (r / a) ** 2)


def tube(toml: dict) -> Tube:
    """That of the case."""
    opening = {o["name"]: quantity(o["value"]) for o in toml["opening"]}
    wall = toml["wall"]
    return Tube(quantity(wall["young_modulus"]), quantity(wall["thickness"]), quantity(toml["blood"]["viscosity"]), opening["inlet"], opening["outlet"])


def figures(case: Case) -> dict[str, str]:
    """Blocks of the README; draws the picture."""
    exact, window = tube(case.toml), case.last(0.25)
    probes, openings = case.run.probes, case.run.openings
    rows = []
    for name, r in PROBES.items():
        found, value = mean(probes["time_s"], probes[f"{name}.w_m_s"], window), float(exact.velocity(r))
        rigid = 2.0 * exact.flow / (np.pi * RADIUS**2) * (1.0 - (r / RADIUS) ** 2)
        rows.append([f"velocity {NAMES[name]} of the middle", f"{1e3 * found:.2f} mm/s", f"{1e3 * value:.2f} mm/s", readme.off(found / value), f"{1e3 * rigid:.2f} mm/s"])
    pressure, middle = mean(probes["time_s"], probes["axis.pressure_pa"], window), float(exact.pressure(np.array([0.5 * LENGTH]))[0])
    rigid = exact.outlet + 8.0 * exact.viscosity * exact.flow / (np.pi * RADIUS**4) * 0.5 * LENGTH
    rows.append(["pressure of the middle", f"{pressure:.1f} Pa", f"{middle:.1f} Pa", readme.off(pressure / middle), f"{rigid:.1f} Pa"])
    z, widened = widening(case, case.run.wall[-1])
    found, value = float(np.interp(0.5 * LENGTH, z, widened)), surface(exact, middle)
    rows.append(["widening of the middle of the wall", f"{1e3 * found:.4f} mm", f"{1e3 * value:.4f} mm", readme.off(found / value), "0"])
    flow = mean(openings["time_s"], openings["outlet.flow_m3_s"], window)
    rows.append(["flow out", f"{1e6 * flow:.4f} ml/s", f"{1e6 * exact.flow:.4f} ml/s", readme.off(flow / exact.flow), ""])
    draw(case, exact, z, widened)
    text = [
        f"Means of {readme.from_to(window)}, {case.across(2.0 * RADIUS)} particles across before it widens:",
        readme.table(["", "found", "formula", "off by", "rigid tube"], rows),
        readme.soundness(case),
    ]
    return {"result": "\n\n".join(text)}


def surface(exact: Tube, pressure: float) -> float:
    """Displacement [m] of the middle of the wall, which grows by as much in its square as the lumen."""
    middle = RADIUS + 0.5 * exact.thickness
    return float(np.sqrt(middle**2 + exact.lumen(pressure) ** 2 - RADIUS**2) - middle)


def widening(case: Case, frame, start: float = 0.0, length: float = LENGTH) -> tuple[np.ndarray, np.ndarray]:
    """Places along the axis [m], one a spacing from `start` over a `length`, and mean displacement away from it [m]."""
    moved = frame["Displacement"].astype(float)
    place = frame.position.astype(float) - moved
    out = place[:, :2] / np.linalg.norm(place[:, :2], axis=1, keepdims=True)
    ring = np.clip(((place[:, 2] - start) / case.spacing).astype(int), 0, int(length / case.spacing) - 1)
    n = np.bincount(ring)
    sums, places = np.bincount(ring, (moved[:, :2] * out).sum(axis=1)), np.bincount(ring, place[:, 2])
    return places[n > 0] / n[n > 0], sums[n > 0] / n[n > 0]


def draw(case: Case, exact: Tube, z: np.ndarray, widened: np.ndarray) -> None:
    """The wall along the tube, and the profile in its middle."""
    fig, (left, right) = plots.figure(1, 2, 9.0, 3.0)
    along = np.linspace(0.0, LENGTH, 100)
    expected = [surface(exact, p) for p in exact.pressure(along)]
    left.plot(1e3 * along, 1e3 * np.array(expected), color=plots.REFERENCE, label="Rivlin, without ends")
    left.plot(1e3 * z, 1e3 * widened, "o", color=plots.HERE, markersize=3, label="here")
    left.set(title="widening of the wall, mm", xlabel="along the tube, mm")
    x, v = case.run.fluid[-1].position.astype(float), case.run.fluid[-1]["Velocity"].astype(float)
    near = np.abs(x[:, 2] - 0.5 * LENGTH) < case.spacing
    right.plot(1e3 * np.hypot(x[near, 0], x[near, 1]), 1e3 * v[near, 2], ".", color=plots.HERE, markersize=3, label="particles")
    r = np.linspace(0.0, exact.lumen(float(exact.pressure(np.array([0.5 * LENGTH]))[0])), 100)
    right.plot(1e3 * r, 1e3 * exact.velocity(r), color=plots.REFERENCE, label="formula")
    right.axvline(1e3 * RADIUS, color="0.6", linewidth=0.8)
    right.set(title="velocity in the middle, mm/s", xlabel="distance from the axis, mm")
    for ax in (left, right):
        ax.grid(True)
        ax.legend()
    plots.save(case, fig)
