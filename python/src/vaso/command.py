"""The commands of the program, as functions. They run the program and wait for it; nothing is computed in Python."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import tempfile
from collections.abc import Mapping
from numbers import Integral
from pathlib import Path
from typing import Any, Union

from .binary import find_binary
from .errors import RunError, from_exit
from .result import Result

PathLike = Union[str, "os.PathLike[str]"]


def run(
    case: PathLike,
    *,
    out: PathLike | None = None,
    threads: int | None = None,
    force: bool = False,
    quiet: bool = True,
    binary: PathLike | None = None,
    **overrides: Any,
) -> Result:
    """Runs a case to its end (``vaso run``) and opens what it left.

    ``case`` is a case folder or a ``case.toml``; ``out`` the output folder, ``out`` in the case folder without it; ``force``
    writes over a finished run. Unless ``quiet``, what the program says goes to standard error while it runs.

    ``overrides`` are keys of the case, as for ``--set``, with two underscores for each dot, or with dots by ``**``::

        vaso.run("cases/pipe", particles__spacing="0.5 mm", run__end_time="0.4 s")
        vaso.run("cases/pipe", **{"opening.inlet.value": "40 mm/s"})

    Raises :class:`~vaso.InputError`, :class:`~vaso.RunError` or :class:`~vaso.Interrupted` with the program's message. Ctrl-C
    lets the program write its checkpoint, then raises ``KeyboardInterrupt``; :func:`resume` goes on from there.
    """
    arguments = ["run", os.fspath(case), *_settings("run", overrides)]
    arguments += ["--out", os.fspath(out)] if out is not None else []
    arguments += ["--force"] if force else []
    execute([*arguments, *_threads(threads)], quiet=quiet, binary=binary)
    return Result(out if out is not None else _case_folder(case) / "out")


def resume(
    out: PathLike, *, threads: int | None = None, quiet: bool = True, binary: PathLike | None = None
) -> Result:
    """Goes on with a run that was interrupted or killed (``vaso resume``), to the same bits as an unbroken one.

    A finished run stays as it is. Raises as :func:`run`.
    """
    execute(["resume", os.fspath(out), *_threads(threads)], quiet=quiet, binary=binary)
    return Result(out)


def check(case: PathLike, *, unit: str | None = None, binary: PathLike | None = None, **overrides: Any) -> dict[str, Any]:
    """What would run, why, and at what cost (``vaso check --json``), without running it: audit of the surface, openings, effects
    with their reasons, predicted particles, memory [bytes] and time [s]. SI units, which the names of the keys end in.

    ``case`` may be a bare surface, whose ``unit`` is then "m", "cm", "mm" or "um". Raises :class:`~vaso.InputError`.
    """
    arguments = ["check", os.fspath(case), *_settings("check", overrides)]
    arguments += ["--unit", unit] if unit is not None else []
    return _object(execute(arguments, binary=binary))


def new(
    folder: PathLike, surface: PathLike, *, unit: str | None = None, binary: PathLike | None = None
) -> dict[str, Any]:
    """Makes a case that runs as it is from a surface (``vaso new --json``) in ``folder``; tells the files made, the unit with its reason,
    inlet, mean inflow, spacing, and under ``"check"`` what :func:`check` tells of the case.

    What was guessed stands in ``folder/case.toml``, marked ASSUMED. Raises :class:`~vaso.InputError`; nothing is written over.
    """
    arguments = ["new", os.fspath(folder), "--surface", os.fspath(surface)]
    arguments += ["--unit", unit] if unit is not None else []
    return _object(execute(arguments, binary=binary))


def execute(arguments: list[str], *, quiet: bool = True, binary: PathLike | None = None) -> str:
    """Runs the program with these arguments and ``--json``, and returns what it printed: the way of all functions here, for
    commands that have none.

    Raises a :class:`~vaso.VasoError` with the message of the program where it ends with another code than 0.
    """
    command = [os.fspath(find_binary(binary)), *arguments, "--json"]
    with tempfile.TemporaryFile("w+", encoding="utf-8") as printed:
        # A session of its own: Ctrl-C in a terminal must reach the program once, through us. Twice would end it on the spot.
        process = subprocess.Popen(
            command,
            stdin=subprocess.DEVNULL,
            stdout=printed,
            stderr=subprocess.PIPE,
            text=True,
            encoding="utf-8",
            start_new_session=True,
        )
        said = _listen(process, quiet)
        if process.returncode != 0:
            raise from_exit(process.returncode, said)
        printed.seek(0)
        return printed.read()


def _listen(process: subprocess.Popen[str], quiet: bool) -> str:
    """What the program says until it ends, shown on the way unless `quiet`."""
    assert process.stderr is not None, "it was opened as a pipe"
    lines = []
    try:
        for line in process.stderr:
            lines.append(line)
            if not quiet:
                sys.stderr.write(line)
        process.wait()
    except KeyboardInterrupt:
        # It writes its checkpoint and ends, and is read from until then, as it could not speak otherwise.
        process.send_signal(signal.SIGINT)
        process.stderr.read()
        process.wait()
        raise
    finally:
        # Where anything else is raised, a second Ctrl-C above all, nothing is waited for.
        if process.poll() is None:
            process.kill()
            process.wait()
        process.stderr.close()
    return "".join(lines)


def _settings(function: str, overrides: Mapping[str, Any]) -> list[str]:
    """Overrides as flags `--set key=value`."""
    flags = []
    for name, value in overrides.items():
        key = name if "." in name else name.replace("__", ".")
        if "." not in key:
            hint = "keys of a case are written as `particles__spacing`, or as `**{'particles.spacing': ...}`"
            raise TypeError(f"{function}() has no argument `{name}`; {hint}")
        flags += ["--set", f"{key}={_toml(value)}"]
    return flags


def _toml(value: Any) -> str:
    """A value as `--set` takes it: strings bare, the rest as TOML."""
    if isinstance(value, str):
        return value
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (list, tuple)):
        items = (json.dumps(item) if isinstance(item, str) else _toml(item) for item in value)
        return "[" + ", ".join(items) + "]"
    # Integers and numbers of numpy, too; of the latter the shortest digits that give the same double.
    return str(int(value)) if isinstance(value, Integral) else repr(float(value))


def _threads(threads: int | None) -> list[str]:
    return ["--threads", str(threads)] if threads is not None else []


def _case_folder(case: PathLike) -> Path:
    path = Path(case)
    return path if path.is_dir() else path.parent


def _object(text: str) -> dict[str, Any]:
    try:
        value = json.loads(text)
    except json.JSONDecodeError as error:
        raise RunError(f"vaso printed no JSON ({error}): {text[:200]!r}") from error
    if not isinstance(value, dict):
        raise RunError(f"vaso printed no JSON object: {text[:200]!r}")
    return value
