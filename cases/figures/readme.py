"""What is written into READMEs: blocks between marks, tables, and what every run tells of itself."""

from __future__ import annotations

import re
import textwrap
from collections.abc import Iterable, Mapping
from pathlib import Path

from .case import Case


def table(head: Iterable[str], rows: Iterable[Iterable[str]]) -> str:
    """A table in Markdown."""
    head = list(head)
    lines = [head, ["---"] * len(head), *map(list, rows)]
    return "\n".join("| " + " | ".join(cells) + " |" for cells in lines).replace("|  |", "| |").replace("| --- ", "|---").replace("--- |", "---|")


def put(page: Path, blocks: Mapping[str, str]) -> None:
    """Writes blocks between `<!-- figures: begin NAME -->` and `<!-- figures: end -->`; a block without marks, or marks without one, is an error."""
    text = page.read_text(encoding="utf-8")
    found = re.findall(r"<!-- figures: begin ([\w-]+) -->", text)
    if sorted(found) != sorted(blocks):
        raise ValueError(f"{page}: has marks for {', '.join(found) or 'nothing'}, made were {', '.join(blocks)}")
    for name, block in blocks.items():
        begin, end = f"<!-- figures: begin {name} -->", "<!-- figures: end -->"
        before, rest = text.split(begin, 1)
        text = f"{before}{begin}\n\n{wrapped(block)}\n\n{end}{rest.split(end, 1)[1]}"
    page.write_text(text, encoding="utf-8")


def wrapped(block: str) -> str:
    """Paragraphs in lines as long as those written by hand; tables as they are."""

    def fill(part: str) -> str:
        # No line begins with the sign of per cent.
        lines = textwrap.fill(part.replace(" %", "\0%"), 150, break_long_words=False, break_on_hyphens=False)
        return part if part.startswith("|") else lines.replace("\0", " ")

    return "\n\n".join(fill(part.strip()) for part in block.strip().split("\n\n"))


def row(page: Path, case: Case) -> None:
    """Spacing and time in the row of a case in the table of all cases."""
    lines = page.read_text(encoding="utf-8").split("\n")
    (k,) = [k for k, line in enumerate(lines) if line.startswith(f"| [{case.name}](")]
    cells = lines[k].split(" | ")
    cells[3:5] = [spacing(case), minutes(0.5 * processor_time(case))]
    lines[k] = " | ".join(cells)
    page.write_text("\n".join(lines), encoding="utf-8")


def processor_time(case: Case) -> float:
    """Time of a run on one core [s]: time that went by, times threads. On a machine that does other work it is too long."""
    return float(case.summary["wall_clock_s"]) * int(case.summary["threads"])


def time(case: Case) -> str:
    """The block of the time."""
    whole = processor_time(case)
    return f"**Time.** {whole:.0f} s of processor time, {minutes(0.5 * whole)} of two idle cores."


def minutes(seconds: float) -> str:
    """A duration as a reader says it."""
    return f"{seconds:.0f} s" if seconds < 60.0 else f"{seconds / 60.0:.1f} min"


def spacing(case: Case) -> str:
    """The spacing in mm."""
    return f"{1e3 * case.spacing:.2g} mm"


def soundness(case: Case) -> str:
    """What every run tells of itself: particles lost, density, energy."""
    stability, energy = case.summary["stability"], case.summary.get("energy")
    lost = stability["escaped_particles"]
    said = [
        "No particle was lost" if lost == 0 else f"{lost} particle{'s were' if lost > 1 else ' was'} lost",
        f"the density was {percent(stability['max_density_error'])} off at most",
    ]
    if energy:
        part = percent(abs(energy["relative_residual"]), 0)
        # Below zero is energy that nothing supplied, see docs/theory/metrics.md.
        lost = energy["relative_residual"] >= 0.0
        said.append(f"the energy balance misses {part} of what went through" if lost else f"{part} of the energy that went through came from nothing")
    return ", ".join(said[:-1]) + ", and " + said[-1] + "."


def percent(part: float, digits: int = 1) -> str:
    """A part as per cent."""
    return f"{100.0 * part:.{digits}f} %"


def off(ratio: float, digits: int = 1) -> str:
    """By how much a ratio is off one."""
    return f"{100.0 * (ratio - 1.0):+.{digits}f} %"


def from_to(window: tuple[float, float]) -> str:
    """A window of time."""
    return f"{window[0]:.3g} to {window[1]:.3g} s"
