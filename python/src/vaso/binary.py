"""Where the program is."""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterator
from pathlib import Path

from .errors import BinaryNotFound

NAME = "vaso.exe" if os.name == "nt" else "vaso"


def find_binary(binary: str | os.PathLike[str] | None = None) -> Path:
    """The program, from the first of these that is given or there:

    1. ``binary``,
    2. the environment variable ``VASO_BIN``,
    3. the folders of ``PATH``,
    4. ``target/release`` of a checkout that the working folder or this package lies in.

    Raises :class:`BinaryNotFound`, also where 1 or 2 names a file that is no program: another one is not taken in its place.
    """
    for asked, by in [(binary, "the argument `binary`"), (os.environ.get("VASO_BIN"), "VASO_BIN")]:
        if asked:
            path = Path(asked).expanduser()
            if path.is_file() and os.access(path, os.X_OK):
                return path.resolve()
            raise BinaryNotFound(f"{by} names {path}, which is not a program")
    on_path = shutil.which(NAME)
    if on_path:
        return Path(on_path)
    for built in _beside_checkouts():
        if os.access(built, os.X_OK):
            return built
    raise BinaryNotFound(
        "there is no program `vaso`: build it with `cargo build --release`, then put it on PATH, set VASO_BIN, or give `binary`"
    )


def _beside_checkouts() -> Iterator[Path]:
    for start in [Path.cwd(), Path(__file__).resolve().parent]:
        for folder in [start, *start.parents]:
            if (folder / "crates" / "driver").is_dir():
                yield folder / "target" / "release" / NAME
