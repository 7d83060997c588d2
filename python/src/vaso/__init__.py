"""Runs vaso, blood flow from a vessel surface, and reads what it leaves as numpy arrays.

    import vaso
    result = vaso.run("cases/carotid", particles__spacing="0.8 mm")
    result.summary["status"], result.openings["ica.flow_m3_s"]
    velocity = result.particles()["Velocity"]          # (n, 3) in m/s

Names are those of the files, values in SI units. What the program refuses is raised with its message (:class:`VasoError`).
"""

from importlib.metadata import version

from .binary import find_binary
from .command import check, execute, new, resume, run
from .errors import BinaryNotFound, InputError, Interrupted, OutputError, RunError, VasoError
from .plots import plot_openings, plot_slice
from .result import Result
from .sampling import Slice, kernel_mean
from .series import Field, Frame, Series
from .table import Table

__version__ = version("vaso")

__all__ = [
    "BinaryNotFound",
    "Field",
    "Frame",
    "InputError",
    "Interrupted",
    "OutputError",
    "Result",
    "RunError",
    "Series",
    "Slice",
    "Table",
    "VasoError",
    "check",
    "execute",
    "find_binary",
    "kernel_mean",
    "new",
    "plot_openings",
    "plot_slice",
    "resume",
    "run",
]
