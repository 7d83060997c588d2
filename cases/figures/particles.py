"""Means over particles: on an axis, in slabs."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from .case import Case


def on_axis(case: Case, steps: Iterable[int], z: float, radius: float, field: str = "Velocity", half: float | None = None) -> float:
    """Value on the z axis at a place, the component along it of a vector: the even parabola `a + b r^2` fitted to all particles within
    a radius [m] and half a length [m], one spacing unless told otherwise.

    A kernel mean would smear the profile of a narrow throat, which is what these figures are about.
    """
    half = case.spacing if half is None else half
    r2, values = [], []
    for step in steps:
        frame = case.run.fluid[step]
        x = frame.position.astype(float)
        near = (np.abs(x[:, 2] - z) < half) & (np.hypot(x[:, 0], x[:, 1]) < radius)
        r2.append((x[near, :2] ** 2).sum(axis=1))
        v = frame[field][near].astype(float)
        values.append(v[:, 2] if v.ndim == 2 else v)
    r2, values = np.concatenate(r2), np.concatenate(values)
    if len(values) < 4:
        return float("nan")
    return float(np.linalg.lstsq(np.stack([np.ones_like(r2), r2], axis=1), values, rcond=None)[0][0])


def flow_through(case: Case, step: int, origin: np.ndarray, normal: np.ndarray, length: float) -> float:
    """Flow [m^3/s] along `normal`: momentum of the blood in a slab by its length and density. Particles have the volume of a cell of the lattice."""
    frame = case.run.fluid[step]
    near = np.abs((frame.position.astype(float) - origin) @ normal) < 0.5 * length
    return float((frame["Velocity"][near].astype(float) @ normal).sum() * case.spacing**3 / length)
