"""Curved tube: velocities in a section, friction along the bend, against Dean's equations."""

from __future__ import annotations

import numpy as np

from . import dean, plots, readme
from .case import Case, halves, mean, quantity
from .plane import Plane

RADIUS, BEND = 2e-3, 16e-3
#: Where the flow is looked at [rad], and how far on each side particles count.
SECTION, WEDGE = np.radians(120.0), np.radians(5.0)
#: Behind this angle sections are taken to be alike, up to some diameters before the outlet [rad].
ALIKE = np.radians([80.0, 150.0])


def coordinates(x: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Angle of the bend [rad], and places in its section, outwards and across the plane of the bend, in radii."""
    across, along = BEND - x[:, 0], x[:, 2]
    return np.arctan2(along, across), (np.hypot(across, along) - BEND) / RADIUS, x[:, 1] / RADIUS


def components(velocity: np.ndarray, angle: np.ndarray) -> np.ndarray:
    """Velocity along the tube, outwards and across, (n, 3)."""
    u, v, w = velocity.T
    return np.stack([u * np.sin(angle) + w * np.cos(angle), -u * np.cos(angle) + w * np.sin(angle), v], axis=1)


class Section:
    """The blood of a wedge about the section, over frames."""

    def __init__(self, case: Case, steps: list[int], mean_speed: float) -> None:
        places, values = [], []
        for step in steps:
            frame = case.run.fluid[step]
            angle, outwards, across = coordinates(frame.position.astype(float))
            near = np.abs(angle - SECTION) < WEDGE
            places.append(np.stack([outwards[near], across[near]], axis=1))
            values.append(components(frame["Velocity"][near].astype(float), angle[near]) / mean_speed)
        self.places, self.values = np.concatenate(places), np.concatenate(values)
        self.reach = 1.5 * case.spacing / RADIUS

    def at(self, outwards: float, across: float) -> np.ndarray:
        """The three components at a place: a paraboloid fitted to what is near, as a kernel would smear the profile."""
        d = self.places - (outwards, across)
        near = (d**2).sum(axis=1) < self.reach**2
        x, y = d[near].T
        terms = np.stack([np.ones_like(x), x, y, x * x, x * y, y * y], axis=1)
        return np.linalg.lstsq(terms, self.values[near], rcond=None)[0][0]


def gradient(case: Case, steps: list[int]) -> float:
    """Fall of the pressure [Pa/rad], by a fit of its fall, even along the bend, and of its course over the section to all particles between."""
    falls = []
    for step in steps:
        frame = case.run.fluid[step]
        angle, outwards, across = coordinates(frame.position.astype(float))
        near = (angle > ALIKE[0]) & (angle < ALIKE[1])
        x, y = outwards[near], across[near]
        terms = np.stack([angle[near], np.ones_like(x), x, x * x, y * y, x**3, x * y * y], axis=1)
        falls.append(-np.linalg.lstsq(terms, frame["Pressure"][near].astype(float), rcond=None)[0][0])
    return float(np.mean(falls))


def figures(case: Case) -> dict[str, str]:
    """Blocks of the README; draws the picture."""
    window = case.last(1.0 / 3.0)
    steps = case.steps(window)
    speed = quantity(case.opening("inlet")["value"])
    reynolds = case.density * speed * 2.0 * RADIUS / case.viscosity
    number = reynolds * np.sqrt(RADIUS / BEND)
    exact = dean.Flow(number)
    line, reach = exact.disc.diameter(exact.along), np.linspace(-1.0, 1.0, 401)
    # Across the tube velocities are told in nu / R there.
    across = exact.across.max() * case.viscosity / (case.density * RADIUS * speed)

    section = Section(case, steps, speed)
    grid = np.linspace(-0.9, 0.9, 37)
    along = max(section.at(x, 0.0)[0] for x in grid)
    turned = max(np.hypot(*section.at(x, y)[1:]) for x in grid for y in grid if np.hypot(x, y) < 0.92)
    velocities = [
        ["velocity on the axis, of the mean", section.at(0.0, 0.0)[0], line(0.0)],
        ["half a radius outwards", section.at(0.5, 0.0)[0], line(0.5)],
        ["half a radius inwards", section.at(-0.5, 0.0)[0], line(-0.5)],
        ["fastest, along the tube", along, line(reach).max()],
        ["fastest, across it", turned, across],
    ]  # fmt: skip

    probes, openings = case.run.probes, case.run.openings
    t = probes["time_s"]
    drop = probes["axis-90.pressure_pa"] - probes["axis-150.pressure_pa"]
    straight = 8.0 * case.viscosity * speed * BEND / RADIUS**2
    flow = [mean(openings["time_s"], sign * openings[f"{name}.flow_m3_s"], window) for name, sign in (("outlet", 1.0), ("inlet", -1.0))]
    shear = case.summary["wall"]["wss_pa"]["mean"] / (4.0 * case.viscosity * speed / RADIUS)
    expected = f"{exact.friction:.2f}"
    others = f"{expected}; White {dean.white(number):.2f}, Ito {dean.ito(number):.2f}"
    whole = [
        ["pressure drop from 90° to 150°, over that of a straight tube, on the axis", f"{mean(t, drop, window) / (straight * np.pi / 3.0):.2f}", others],
        ["the same by a fit to all particles from 80° to 150°", f"{gradient(case, steps) / straight:.2f}", expected],
        ["flow out, by flow in", f"{flow[0] / flow[1]:.4f}", "1"],
        ["wall shear stress, mean of the whole wall, by that of a straight tube", f"{shear:.2f}", f"{expected} where it no longer changes"],
    ]  # fmt: skip
    draw(case, steps, speed)
    unsteady = [abs(halves(t, drop, window)) / mean(t, drop, window), abs(halves(t, probes["outer.u_m_s"], window) / mean(t, probes["outer.u_m_s"], window))]
    text = [
        f"Means of {readme.from_to(window)}, which halves differ by {readme.percent(unsteady[0])} in the drop and {readme.percent(unsteady[1])} in the velocity half a radius"
        f" outwards, {case.across(2.0 * RADIUS)} particles across, at a Reynolds number of {reynolds:.0f} and a Dean number of {number:.1f}:",
        readme.table(["after 120° of the bend", "found", "Dean's equations"], [[what, f"{found:.2f}", f"{value:.2f}"] for what, found, value in velocities]),
        readme.table(["", "found", "expected"], whole),
        readme.soundness(case),
    ]
    return {"result": "\n\n".join(text)}


def draw(case: Case, steps: list[int], speed: float) -> None:
    """Speed in the plane of the bend, and the section with what turns."""
    fig, axes = plots.figure(1, 2, 9.0, 3.5, width_ratios=[1.5, 1.0])
    plane = Plane(case, [0.0, 0.0, 0.0], right=[1.0, 0.0, 0.0], up=[0.0, 0.0, 1.0])
    plots.show(axes[0], plane, np.linalg.norm(plane.mean("Velocity", steps), axis=-1) / speed, label="speed, of the mean", title="in the plane of the bend", vmin=0.0, bar="bottom")
    axes[0].set(xlabel="mm")
    outwards = np.array([-np.cos(SECTION), 0.0, np.sin(SECTION)])
    origin = np.array([BEND, 0.0, 0.0]) + BEND * outwards
    plane = Plane(case, origin, right=outwards, up=[0.0, 1.0, 0.0])
    velocity = plane.mean("Velocity", steps) / speed
    along = velocity @ np.array([np.sin(SECTION), 0.0, np.cos(SECTION)])
    plots.show(axes[1], plane, along, label="along the tube, of the mean", title="after 120°: along the tube, and across it (arrows)", vmin=0.0, bar="bottom")
    axes[1].contour(1e3 * plane.x, 1e3 * plane.y, along, levels=10, colors="black", linewidths=0.3)
    plots.directions(axes[1], plane, velocity, RADIUS / 6.0, scaled=True)
    axes[1].set(xlabel="mm, outwards to the right")
    plots.save(case, fig)
