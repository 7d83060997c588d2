"""Means over the wall."""

from __future__ import annotations

import numpy as np

from .case import Case


def points(case: Case) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Places [m], areas [m^2], mean wall shear stress over a cycle [Pa] and its oscillatory index at the points of the wall that have them."""
    series = case.run.wall
    frame, corners = series[-1], series.triangles
    x = frame.position.astype(float)
    a, b, c = (x[corners[:, k]] for k in range(3))
    third = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 6.0
    area = np.bincount(corners.ravel(), np.repeat(third, 3), len(x))
    tawss, osi = frame["TAWSS"].astype(float), frame["OSI"].astype(float)
    valid = np.isfinite(tawss) & np.isfinite(osi)
    return x[valid], area[valid], tawss[valid], osi[valid]
