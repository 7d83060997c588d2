"""Fields on a plane through the blood, within the wall that is cut by it."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from vaso.sampling import kernel_mean

from .case import UNITS, Case

#: Kernel sum [-] below which no blood is near. At a wall it is about a half, and less in corners: the wall, not the sum, says where blood ends.
NEAR = 0.05


def triangles(case: Case) -> np.ndarray:
    """Corners of the surface, (n, 3, 3) [m], of a binary STL."""
    raw = (case.folder / case.toml["geometry"]["surface"]).read_bytes()
    record = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("rest", "<u2")])
    return UNITS[case.toml["geometry"]["unit"]] * np.frombuffer(raw, record, offset=84)["corners"].astype(float)


class Plane:
    """A plane through `origin` [m] with the unit vectors `right` and `up` in it, and pixels of a third of a spacing, finer where the picture would be coarse."""

    def __init__(self, case: Case, origin, right, up) -> None:
        self.case = case
        self.origin = np.asarray(origin, dtype=float)
        self.axes = np.array([right, up], dtype=float)
        #: Where the wall is cut, segments (n, 2, 2) [m] along the axes.
        self.wall = self._cut()
        low, high = self.wall.min(axis=(0, 1)), self.wall.max(axis=(0, 1))
        pixel = min(case.spacing / 3.0, (high - low).max() / 200.0)
        #: Places of the pixels along the axes [m].
        self.x, self.y = (np.arange(a - pixel, b + 1.5 * pixel, pixel) for a, b in zip(low, high))
        self.inside = self._inside()
        self.points = self.origin + self.x[None, :, None] * self.axes[0] + self.y[:, None, None] * self.axes[1]

    def mean(self, field: str, steps: Iterable[int]) -> np.ndarray:
        """Kernel means of a field over frames, (rows, columns) or (rows, columns, 3), NaN outside the wall."""
        run, points = self.case.run, self.points[self.inside]
        sums, counts = 0.0, np.zeros(len(points))
        for step in steps:
            frame = run.fluid[step]
            position = frame.position.astype(float)
            height = (position - self.origin) @ np.cross(*self.axes)
            close = np.abs(height) < 3.0 * self.case.spacing
            mean, total = kernel_mean(position[close], frame[field][close], points, self.case.spacing)
            there = total > NEAR
            mean[~there] = 0.0
            sums, counts = sums + mean, counts + there
        values = np.full((*self.inside.shape, *np.shape(sums)[1:]), np.nan)
        counts = counts.reshape(-1, *[1] * (np.ndim(sums) - 1))
        values[self.inside] = np.where(counts > 0, sums / np.maximum(counts, 1), np.nan)
        return values

    def _cut(self) -> np.ndarray:
        corners = triangles(self.case) - self.origin
        # Moved by a millionth, so that no vertex lies on the plane and each triangle that is cut gives one segment.
        height = corners @ np.cross(*self.axes) - 1.1e-6 * np.ptp(corners)
        side = np.sign(height).sum(axis=1)
        crossed = np.abs(side) == 1
        corners, height, side = corners[crossed], height[crossed], side[crossed]
        # The corner that is alone on its side comes first.
        alone = np.argmax(np.sign(height) != side[:, None], axis=1)
        order = (alone[:, None] + np.arange(3)) % 3
        corners = np.take_along_axis(corners, order[:, :, None], axis=1)
        height = np.take_along_axis(height, order, axis=1)
        part = [(height[:, 0] / (height[:, 0] - height[:, k]))[:, None] for k in (1, 2)]
        ends = [corners[:, 0] + part[k - 1] * (corners[:, k] - corners[:, 0]) for k in (1, 2)]
        return np.stack([end @ self.axes.T for end in ends], axis=1)

    def _inside(self) -> np.ndarray:
        """Pixels from which a ray to the right meets the wall an odd number of times."""
        inside = np.zeros((len(self.y), len(self.x)), dtype=bool)
        (x0, y0), (x1, y1) = self.wall[:, 0].T, self.wall[:, 1].T
        for k, y in enumerate(self.y):
            met = (y0 > y) != (y1 > y)
            at = np.sort(x0[met] + (y - y0[met]) / (y1[met] - y0[met]) * (x1[met] - x0[met]))
            inside[k] = np.searchsorted(at, self.x) % 2 == 1
        return inside
