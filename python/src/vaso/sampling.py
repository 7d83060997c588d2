"""Values between particles: kernel means at points and on planes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .series import Array, Frame

#: Smoothing length in spacings; twice that is the radius of the support. As `numerics.smoothing_length` of a case.
SMOOTHING = 1.3
#: Points handled at a time, so that the pairs of all of them need not be held in memory.
CHUNK = 2048


@dataclass(frozen=True)
class Slice:
    """A field on a plane."""

    #: Name of the field, and its unit.
    field: str
    unit: str
    #: Simulated time [s].
    time: float
    #: Values, (rows, columns) or (rows, columns, 3), NaN outside the blood.
    values: NDArray[np.float64]
    #: Places of the values along the two axes of the plane, (columns,) and (rows,) [m], from the origin.
    right: NDArray[np.float64]
    up: NDArray[np.float64]
    #: The point given [m], and the unit vectors along columns and rows, each (3,).
    origin: NDArray[np.float64]
    axes: tuple[NDArray[np.float64], NDArray[np.float64]]

    @property
    def magnitude(self) -> NDArray[np.float64]:
        """The values, or the lengths of vectors, (rows, columns)."""
        length: NDArray[np.float64] = np.linalg.norm(self.values, axis=-1)
        return length if self.values.ndim == 3 else self.values


def kernel_mean(
    position: Array, values: Array, points: ArrayLike, spacing: float
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Means over the particles around points, by the C2 kernel of Wendland (1995) that the program uses, divided by its sum (Shepard).

    ``position`` (n, 3) and ``points`` (m, 3) [m], ``values`` (n,) or (n, 3). Returns the means, (m,) or (m, 3), NaN where no particle
    is near, and the kernel sums (m,) [-], about 1 within the blood and 1/2 on its border.
    """
    at = np.asarray(points, dtype=float)
    if at.ndim != 2 or at.shape[1] != 3:
        raise ValueError(f"points have the shape {at.shape}, expected (m, 3)")
    reach = 2.0 * SMOOTHING * spacing
    place, weighed = np.asarray(position, dtype=float), np.asarray(values, dtype=float)
    mean = np.full((len(at), *weighed.shape[1:]), np.nan)
    total = np.zeros(len(at))
    if not len(place):
        return mean, total
    low = place.min(axis=0) - reach
    cell = np.floor((place - low) / reach).astype(np.int64)
    # Particles are in cells from 1 on, with an empty one beyond the last.
    shape = cell.max(axis=0) + 2
    code = _code(cell, shape)
    order = np.argsort(code, kind="stable")
    place, weighed, code = place[order], weighed[order], code[order]
    for start in range(0, len(at), CHUNK):
        part = slice(start, start + CHUNK)
        i, j = _candidates(np.floor((at[part] - low) / reach).astype(np.int64), shape, code)
        q = np.linalg.norm(at[part][i] - place[j], axis=1) / (SMOOTHING * spacing)
        # 21/16 pi h^3 is the factor at h; times the volume of a particle.
        weight = 21.0 / (16.0 * np.pi * SMOOTHING**3) * np.clip(1.0 - q / 2.0, 0.0, None) ** 4 * (2.0 * q + 1.0)
        count = len(at[part])
        total[part] = np.bincount(i, weight, count)
        columns = weighed.reshape(len(weighed), -1)
        sums = np.stack([np.bincount(i, weight * columns[j, k], count) for k in range(columns.shape[1])], axis=1)
        with np.errstate(invalid="ignore", divide="ignore"):
            mean[part] = (sums / total[part, None]).reshape(mean[part].shape)
    return mean, total


def _code(cell: NDArray[np.int64], shape: NDArray[np.int64]) -> NDArray[np.int64]:
    code: NDArray[np.int64] = (cell[..., 0] * shape[1] + cell[..., 1]) * shape[2] + cell[..., 2]
    return code


def _candidates(
    cell: NDArray[np.int64], shape: NDArray[np.int64], code: NDArray[np.int64]
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Pairs of a point and a particle in its cell or one beside it; `code` are the cells of the particles in order."""
    beside = np.stack(np.meshgrid(*[[-1, 0, 1]] * 3, indexing="ij"), axis=-1).reshape(-1, 3)
    around = cell[:, None, :] + beside
    inside = np.all((around >= 0) & (around < shape), axis=-1)
    wanted = np.where(inside, _code(around, shape), -1).ravel()
    begin, end = np.searchsorted(code, wanted, "left"), np.searchsorted(code, wanted, "right")
    count = end - begin
    point = np.repeat(np.arange(len(cell)), len(beside))
    i = np.repeat(point, count)
    within = np.arange(count.sum()) - np.repeat(np.cumsum(count) - count, count)
    return i, np.repeat(begin, count) + within


def plane(
    frame: Frame,
    field: str,
    unit: str,
    origin: ArrayLike,
    normal: ArrayLike,
    spacing: float,
    pixel: float | None,
    up: Sequence[float] | None,
) -> Slice:
    """What :meth:`vaso.Result.slice` does, of a frame."""
    center, across = np.asarray(origin, dtype=float), np.asarray(normal, dtype=float)
    if center.shape != (3,) or across.shape != (3,) or not np.linalg.norm(across) > 0.0:
        raise ValueError("origin and normal are three numbers each, and the normal has a length")
    step = spacing / 3.0 if pixel is None else pixel
    if not step > 0.0:
        raise ValueError(f"pixel is {step}, expected a length above 0")
    axes = _axes(across / np.linalg.norm(across), up)
    position = np.asarray(frame.position, dtype=float)
    reach = 2.0 * SMOOTHING * spacing
    near = np.abs((position - center) @ (across / np.linalg.norm(across))) < reach
    if not near.any():
        raise ValueError(f"no blood is near the plane through {center.tolist()} across {across.tolist()}")
    position, values = position[near], frame[field][near]
    right, upward = (_places((position - center) @ axis, step) for axis in axes)
    points = center + right[None, :, None] * axes[0] + upward[:, None, None] * axes[1]
    mean, total = kernel_mean(position, values, points.reshape(-1, 3), spacing)
    mean[total < 0.5] = np.nan
    shape = (len(upward), len(right), *mean.shape[1:])
    return Slice(field, unit, frame.time, mean.reshape(shape), right, upward, center, axes)


def _axes(normal: NDArray[np.float64], up: Sequence[float] | None) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Two axes that form a right-handed frame with the normal."""
    # Without a wish, the axis of space that lies most in the plane points upwards.
    wish = np.eye(3)[np.argmin(np.abs(normal))] if up is None else np.asarray(up, dtype=float)
    upward = wish - (wish @ normal) * normal
    length = np.linalg.norm(upward)
    if not length > 1e-9 * np.linalg.norm(wish):
        raise ValueError("`up` points along the normal, expected a direction with a part in the plane")
    upward = upward / length
    return np.cross(upward, normal), upward


def _places(along: NDArray[np.float64], step: float) -> NDArray[np.float64]:
    """Multiples of `step` that cover all of `along`."""
    return step * np.arange(np.floor(along.min() / step), np.ceil(along.max() / step) + 1)
