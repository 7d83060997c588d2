"""Womersley flow: flow, velocities and wall shear stress as waves, and the profile."""

from __future__ import annotations

import numpy as np

from . import plots, pulsatile, readme
from .case import Case, harmonic, mean

RADIUS, LENGTH = 5e-3, 30e-3
#: Places in radii, by the names of the probes.
PROBES = {"axis": 0.0, "half": 0.5, "three-quarters": 0.75}
NAMES = {"axis": "velocity on the axis", "half": "velocity at half the radius", "three-quarters": "velocity at three quarters"}

#: Of the seven moments in the picture.
COLORS = ["#1b1b1b", "#4053d3", "#00a6c8", "#00b25d", "#ddb310", "#fb6a2c", "#b51d14"]


def figures(case: Case) -> dict[str, str]:
    """Blocks of the README; draws the picture."""
    window = case.last_cycle()
    period = window[1] - window[0]
    omega = 2.0 * np.pi / period
    pressure = harmonic(*case.waveform("inlet"), (0.0, period))
    gradient = pressure / LENGTH
    alpha = pulsatile.womersley_number(RADIUS, omega, case.density, case.viscosity)
    scale = gradient / (case.density * omega)

    openings, probes = case.run.openings, case.run.probes
    t = openings["time_s"]
    # Into the vessel at the inlet, out of it at the outlet: two measures of the same flow.
    ends = [harmonic(t, sign * openings[f"{name}.flow_m3_s"], window) for name, sign in (("inlet", -1.0), ("outlet", 1.0))]
    flow = pulsatile.mean_velocity(alpha) * scale * np.pi * RADIUS**2
    rows = [compared("flow", flow, 0.5 * sum(ends), pressure, 1e6, "ml/s", 3)]
    for name, r in PROBES.items():
        found = harmonic(probes["time_s"], probes[f"{name}.w_m_s"], window)
        rows.append(compared(NAMES[name], complex(pulsatile.velocity(alpha, r) * scale), found, pressure, 1e3, "mm/s", 1))
    shear = pulsatile.wall_shear(alpha) * gradient * RADIUS
    rows.append(compared("wall shear stress, middle third", shear, wall_shear(case, window), pressure, 1.0, "Pa", 3))

    steps = case.steps(window, closed=False)
    profiles = [(case.run.fluid.times[step], *rings(case, step)) for step in steps]
    exact = lambda time, r: (pulsatile.velocity(alpha, r) * scale * np.exp(1j * omega * time)).real  # noqa: E731
    squares = sum((n * (u - exact(time, r)) ** 2).sum() for time, r, u, n in profiles)
    rms = np.sqrt(squares / sum(n.sum() for _, _, _, n in profiles))
    rows.append(["profile, off by rms over section and period", "", f"{1e3 * rms:.1f} mm/s", f"{readme.percent(rms / abs(scale))} of the amplitude without friction"])
    rows.append(["flow at both ends, amplitudes", "the same", f"{1e6 * abs(ends[0]):.3f}, {1e6 * abs(ends[1]):.3f} ml/s", readme.off(abs(ends[1]) / abs(ends[0]))])
    left = mean(t, openings["outlet.flow_m3_s"], window)
    rows.append(["mean flow, which the start leaves", "0", f"{1e6 * left:.3f} ml/s", f"{readme.percent(left / abs(flow))} of the amplitude"])
    draw(case, profiles, exact, window)

    cycles = round(case.end / period)
    text = [
        f"In the last of {cycles} periods, {case.across(2 * RADIUS)} particles across, at a Womersley number of {alpha:.2f}, out of `openings.csv`,"
        f" `probes.csv` and the frames; phases are behind the pressure, whose amplitude is {abs(pressure):.1f} Pa:",
        readme.table(["", "formula", "found", "off by"], rows),
        f"The layer at the wall, the radius over the Womersley number, is {1e3 * RADIUS / alpha:.2f} mm thick or {RADIUS / alpha / case.spacing:.1f} spacings. "
        + readme.soundness(case),
    ]
    return {"result": "\n\n".join(text)}


def compared(what: str, exact: complex, found: complex, pressure: complex, scale: float, unit: str, digits: int) -> list[str]:
    """A row on a wave: amplitude and phase behind the pressure."""
    wave = lambda c: f"{scale * abs(c):.{digits}f} {unit}, {-np.degrees(np.angle(c / pressure)):.1f}° behind"  # noqa: E731
    late = np.degrees(np.angle(exact / found))
    return [what, wave(exact), wave(found), f"{readme.off(abs(found) / abs(exact))}, {abs(late):.1f}° {'late' if late > 0 else 'early'}"]


def wall_shear(case: Case, window: tuple[float, float]) -> complex:
    """Wave of the axial wall shear stress, mean over the middle third of the wall."""
    wall = case.run.wall
    z = wall[0].position[:, 2]
    middle = np.abs(z - 0.5 * LENGTH) < LENGTH / 6.0
    values = np.array([np.nanmean(frame["WSS"][middle, 2]) if np.isfinite(frame["WSS"][middle]).any() else 0.0 for frame in wall])
    # A frame holds the mean of the last hundredth of a period (docs/theory/metrics.md), which is half of that old.
    times = wall.times - 0.005 * (window[1] - window[0])
    return harmonic(times, values, window)


def rings(case: Case, step: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Mean radius (radii), mean velocity [m/s] and number of the particles in rings of the middle third, one ring a spacing."""
    frame = case.run.fluid[step]
    x = frame.position.astype(float)
    middle = np.abs(x[:, 2] - 0.5 * LENGTH) < LENGTH / 6.0
    r, u = np.hypot(x[middle, 0], x[middle, 1]) / RADIUS, frame["Velocity"][middle, 2].astype(float)
    ring = np.minimum((r * RADIUS / case.spacing).astype(int), int(RADIUS / case.spacing) - 1)
    n = np.bincount(ring)
    sums, velocities, n = np.bincount(ring, r)[n > 0], np.bincount(ring, u)[n > 0], n[n > 0]
    return sums / n, velocities / n, n


def draw(case: Case, profiles, exact, window) -> None:
    """Profiles at seven moments of the period."""
    fig, ax = plots.figure(1, 1, 7.8, 4.0)
    r = np.linspace(0.0, 1.0, 200)
    period = window[1] - window[0]
    for k in range(7):
        time, at, u, _ = profiles[round(k * len(profiles) / 7.0) % len(profiles)]
        color = COLORS[k]
        ax.plot(r, 1e3 * exact(time, r), color=color)
        ax.plot(at, 1e3 * u, "o", color=color, markersize=4.5, label=f"{((time - window[0]) / period) % 1.0:.2f}")
    ax.set(xlim=(0.0, 1.0), xlabel="distance from the axis over radius", ylabel="velocity along the pipe, mm/s", title="formula (lines) and particles (dots, means of rings)")
    ax.grid(True)
    fig.legend(*ax.get_legend_handles_labels(), title="part of the period", loc="outside right center")
    plots.save(case, fig)
