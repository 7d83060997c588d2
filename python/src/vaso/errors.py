"""What can go wrong, one exception for each thing a caller may want to do about it."""

from __future__ import annotations


class VasoError(Exception):
    """Anything that vaso or this package refuses or fails at; its text is the program's own.

    ``code`` is the exit code of the program, ``None`` where it was not the program that failed.
    """

    def __init__(self, message: str, code: int | None = None) -> None:
        super().__init__(message)
        self.message = message
        self.code = code


class InputError(VasoError):
    """The case, the surface or a flag is wrong (exit code 2). Nothing was computed."""


class RunError(VasoError):
    """The run broke down, or the disk refused (exit code 1). Frames and the summary up to there stay in the output folder."""


class Interrupted(VasoError):
    """The run was stopped from outside (exit code 130, or a signal). ``vaso.resume`` goes on with it."""


class BinaryNotFound(VasoError):
    """There is no program ``vaso`` where it was looked for."""


class OutputError(VasoError):
    """A file of results is not there, is damaged, or is not what it should be."""


def from_exit(code: int, text: str) -> VasoError:
    """The exception for a program that ended with ``code`` and wrote ``text`` to its standard error."""
    at = text.find("error: ")
    message = text[at + len("error: ") :].strip() if at >= 0 else text.strip()
    if code < 0:
        return Interrupted(message or f"vaso was ended by signal {-code}", code)
    kind = {1: RunError, 2: InputError, 130: Interrupted}.get(code, VasoError)
    return kind(message or f"vaso ended with code {code} and said nothing", code)
