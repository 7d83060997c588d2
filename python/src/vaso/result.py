"""The output folder of a run."""

from __future__ import annotations

import json
import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from numpy.typing import ArrayLike

from .errors import OutputError
from .sampling import Slice, kernel_mean, plane
from .series import Array, Frame, Series
from .table import Table


class Result:
    """What a run left in its output folder, each part read when it is asked for.

    A run that is going on, was interrupted or killed can be read like a finished one; ``summary["status"]`` says which it is. Each
    access reads anew, so keep ``result.fluid`` in a variable where frames of one moment belong together.
    """

    def __init__(self, out: str | os.PathLike[str]) -> None:
        self.out = Path(out)
        if not self.out.is_dir():
            raise OutputError(f"{self.out}: there is no such folder")

    @property
    def summary(self) -> dict[str, Any]:
        """``summary.json``: particles, steps, stability, means of the openings, seconds of each effect. SI units, which the names of
        the keys end in; ``None`` where a number is not finite."""
        path = self.out / "summary.json"
        try:
            value = json.loads(path.read_text(encoding="utf-8"))
        except OSError as error:
            raise OutputError(f"{path}: cannot be read: {error.strerror}; is this the output folder of a run?") from error
        except json.JSONDecodeError as error:
            raise OutputError(f"{path}: is no JSON: {error}") from error
        if not isinstance(value, dict):
            raise OutputError(f"{path}: is not the summary of a run")
        return value

    @property
    def openings(self) -> Table:
        """``openings.csv``: ``time_s``, and of each opening ``NAME.flow_m3_s``, positive out of the vessel, and ``NAME.pressure_pa``."""
        return Table(self.out / "openings.csv")

    @property
    def probes(self) -> Table:
        """``probes.csv``: ``time_s``, and of each probe ``NAME.pressure_pa`` and the velocity ``NAME.u_m_s``, ``v_m_s``, ``w_m_s``."""
        path = self.out / "probes.csv"
        if not path.exists():
            raise OutputError(f"{path}: is not there; the case has no [[probe]]")
        return Table(path)

    @property
    def fluid(self) -> Series:
        """``fluid.vtkhdf``: the particles of the blood, whose number changes from frame to frame."""
        return Series(self.out / "fluid.vtkhdf")

    @property
    def wall(self) -> Series:
        """``wall.vtkhdf``: the wall, as triangles that do not move (rigid) or do (shell), or as particles (solid)."""
        path = self.out / "wall.vtkhdf"
        if not path.exists():
            raise OutputError(f"{path}: is not there; a rigid wall has one if `output.fields` asks for \"wss\" or an index of a cycle")
        return Series(path)

    @property
    def lumen(self) -> Series:
        """``lumen.vtkhdf``: the surface of the lumen in a solid wall, with the stress of the blood on it."""
        path = self.out / "lumen.vtkhdf"
        if not path.exists():
            raise OutputError(f"{path}: is not there; a solid wall has one if `output.fields` asks for \"wss\" or an index of a cycle")
        return Series(path)

    @property
    def report(self) -> Path:
        """The page of the run."""
        return self.out / "report.html"

    @property
    def spacing(self) -> float:
        """Distance of the particles [m]."""
        return float(self.summary["spacing_m"])

    def particles(self, step: int = -1) -> Frame:
        """The particles of the blood in one frame, the last one unless told otherwise."""
        return self.fluid[step]

    def sample(self, field: str, points: ArrayLike, step: int = -1) -> Array:
        """Kernel means of a field of the blood at points of shape (m, 3) [m]: shape (m,) or (m, 3), NaN where no blood is near.

        The kernel and its smoothing length of 1.3 spacings are those of the probes, so what varies within a few spacings, as next to
        the wall, is smeared. ``"position"`` is a field, too.
        """
        frame = self.particles(step)
        values = frame.position if field == "position" else frame[field]
        return kernel_mean(frame.position, values, points, self.spacing)[0]

    def slice(
        self,
        field: str,
        origin: ArrayLike,
        normal: ArrayLike = (0.0, 0.0, 1.0),
        *,
        step: int = -1,
        pixel: float | None = None,
        up: Sequence[float] | None = None,
    ) -> Slice:
        """Kernel means of a field of the blood on the plane through ``origin`` [m] across ``normal``, in squares of ``pixel`` [m],
        a third of a spacing unless told otherwise. ``up`` turns the picture: its part in the plane points upwards.

        NaN outside the blood, told by the kernel sum falling below one half, which is where a flat wall is.
        """
        frame = self.particles(step)
        unit = frame.series.fields[field].unit if field in frame else ""
        return plane(frame, field, unit, origin, normal, self.spacing, pixel, up)

    def __repr__(self) -> str:
        return f"<Result {self.out}>"
