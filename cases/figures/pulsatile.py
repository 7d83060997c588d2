"""Formulas of pulsatile flow: Womersley's profile, and what a Windkessel makes of a flow."""

from __future__ import annotations

import numpy as np
from scipy.special import jv

#: The argument of Womersley's Bessel functions is this times his number.
I32 = np.exp(0.75j * np.pi)


def womersley_number(radius: float, omega: float, density: float, viscosity: float) -> float:
    """`R sqrt(w rho / mu)`."""
    return radius * np.sqrt(omega * density / viscosity)


def velocity(alpha: float, r) -> np.ndarray:
    """Velocity at `r` (radii) over `G / (rho w)` of a gradient `Re(G exp(i w t))`: Womersley, J. Physiol. 127 (1955) 553."""
    z = I32 * alpha
    return (1.0 - jv(0, z * np.asarray(r)) / jv(0, z)) / 1j


def mean_velocity(alpha: float) -> complex:
    """Its mean over the section."""
    z = I32 * alpha
    return complex((1.0 - 2.0 * jv(1, z) / (z * jv(0, z))) / 1j)


def wall_shear(alpha: float) -> complex:
    """Wall shear stress over `G R`, by the balance of forces `rho dU/dt = G - 2 tau / R`."""
    return 0.5 * (1.0 - 1j * mean_velocity(alpha))


def harmonics(values: np.ndarray) -> np.ndarray:
    """Harmonics 0, 1, ... of a cycle at equal steps without its end: `sum Re(c_k exp(i k w t))`, as far as they are not rounding."""
    c = np.fft.rfft(values) / len(values)
    c[1:] *= 2.0
    return c[: 1 + np.flatnonzero(np.abs(c) > 1e-3 * np.abs(c).max())[-1]]


def series(c: np.ndarray, t, period: float) -> np.ndarray:
    """The sum of harmonics at times [s]."""
    k = np.arange(len(c))[:, None]
    return (c[:, None] * np.exp(2j * np.pi * k * np.atleast_1d(t) / period)).real.sum(axis=0)


def shear_of_flow(c: np.ndarray, t, period: float, radius: float, density: float, viscosity: float) -> np.ndarray:
    """Wall shear stress [Pa] of a developed flow with the harmonics `c` [m^3/s] in a long tube: Poiseuille's of the mean, and Womersley's of each wave."""
    tau = [4.0 * viscosity * c[0] / (np.pi * radius**3)]
    for k in range(1, len(c)):
        omega = 2.0 * np.pi * k / period
        alpha = womersley_number(radius, omega, density, viscosity)
        gradient = density * omega * c[k] / (np.pi * radius**2) / mean_velocity(alpha)
        tau.append(wall_shear(alpha) * gradient * radius)
    return series(np.array(tau), t, period)


def windkessel(c: np.ndarray, t, period: float, proximal: float, distal: float, compliance: float) -> np.ndarray:
    """Pressure [Pa] of a three-element Windkessel in periodic flow: `Z = R_p + R_d / (1 + i w R_d C)` (Westerhof, Lankhaar and Westerhof,
    Med. Biol. Eng. Comput. 47 (2009) 131)."""
    omega = 2.0 * np.pi * np.arange(len(c)) / period
    return series(c * (proximal + distal / (1.0 + 1j * omega * distal * compliance)), t, period)
