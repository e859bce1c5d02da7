# SPDX-License-Identifier: MIT OR Apache-2.0
"""What a run says while it lasts, and the verdict on it in the program's own words.

====================  =====================================================================
``StderrReader``      bytes of standard error to progress, messages and the error line
``verdict``            exit code, summary and findings to one verdict
``run_to_end``        a whole run without an event loop, for scripts and tests
====================  =====================================================================

Nothing in this module needs FreeCAD.
"""

from __future__ import annotations

import json
import re
import subprocess
import tempfile
from dataclasses import dataclass
from typing import Any, Callable, Mapping, Sequence, Tuple

from beamwright_program import Program, ProgramError, without_window

#: x, y, z in mm.
Point = Tuple[float, float, float]

#: Share of the whole run each stage takes, in the order in which they come.
STAGES = (
    ("read", 0.05),
    ("mesh", 0.10),
    ("skeleton", 0.60),
    ("sections", 0.10),
    ("frame", 0.10),
    ("write", 0.05),
)


@dataclass(frozen=True)
class Progress:
    """How far the run is: ``stage``, ``done`` of ``total``, and ``fraction`` 0..1 of the run."""

    stage: str
    done: int
    total: int
    fraction: float


def overall(stage: str, done: int, total: int) -> float:
    """Part 0..1 of the whole run that is done; 0 for a stage that is not known."""
    before = 0.0
    for name, share in STAGES:
        if name == stage:
            part = min(max(done / total, 0.0), 1.0) if total > 0 else 0.0
            return before + share * part
        before += share
    return 0.0


class StderrReader:
    """Turns the bytes of standard error into progress and lines for the log."""

    def __init__(self) -> None:
        self.fraction = 0.0
        self.error = ""
        self.lines: list[str] = []
        self._rest = b""

    def feed(self, data: bytes) -> list[Progress | str]:
        """Progress and log lines completed by ``data``; a half line is kept for later."""
        *lines, self._rest = (self._rest + data).split(b"\n")
        return [event for line in lines for event in self._line(line)]

    def close(self) -> list[Progress | str]:
        """What the last line without an end says."""
        line, self._rest = self._rest, b""
        return self._line(line)

    def _line(self, raw: bytes) -> list[Progress | str]:
        text = raw.decode("utf-8", "replace").strip()
        if not text:
            return []
        if text.startswith("{"):
            progress = self._progress(text)
            if progress:
                return [progress]
        if text.startswith("error:"):
            self.error = text[len("error:") :].strip()
        self.lines.append(text)
        return [text]

    def _progress(self, text: str) -> Progress | None:
        try:
            line = json.loads(text)
            stage, done, total = str(line["stage"]), int(line["done"]), int(line["total"])
        except (ValueError, KeyError, TypeError):
            return None
        self.fraction = max(self.fraction, overall(stage, done, total))
        return Progress(stage, done, total, self.fraction)


@dataclass(frozen=True)
class Finding:
    """Something the program found odd.

    * ``breach``: whether a promise is broken
    * ``place``: where, mm; None if nowhere in particular
    """

    kind: str
    text: str
    breach: bool = False
    place: Point | None = None


@dataclass(frozen=True)
class Outcome:
    """How a run ended; ``message`` is "" when all is well."""

    exit_code: int
    message: str
    summary: Mapping[str, Any]
    findings: tuple[Finding, ...] = ()

    @property
    def ok(self) -> bool:
        """Whether there are files to take in."""
        return not self.message

    @property
    def beams(self) -> int:
        """Number of beams the program says it wrote."""
        return int((self.summary.get("frame") or {}).get("beams", 0))


#: Kind of the finding that is made of an error line with a place in it.
ERROR = "error"

CANCELLED = "cancelled; nothing was changed"


def verdict(
    exit_code: int, stdout: bytes, reader: StderrReader, cancelled: bool = False
) -> Outcome:
    """The verdict on a run, in the program's own words.

    * ``exit_code``: of the program; negative for a signal
    """
    try:
        summary = json.loads(stdout.decode("utf-8", "replace") or "{}")
    except ValueError:
        summary = {}
    if not isinstance(summary, dict):
        summary = {}
    findings = findings_of(summary)
    if cancelled:
        return Outcome(exit_code, CANCELLED, summary, findings)
    if exit_code == 0:
        message = "" if summary.get("frame") else "the program ended without a summary"
    elif exit_code == 3:
        broken = [f.text for f in findings if f.breach]
        message = reader.error or "; ".join(broken) or "a promise does not hold (--strict)"
    elif reader.error:
        message = reader.error
    else:
        last = reader.lines[-1] if reader.lines else "it said nothing"
        message = f"the program ended with code {exit_code}: {last}"
    if message and exit_code != 3 and not findings:
        place = place_in(message)
        if place:
            findings = (Finding(ERROR, message, True, place),)
    return Outcome(exit_code, message, summary, findings)


def findings_of(summary: Mapping[str, Any]) -> tuple[Finding, ...]:
    """The findings of a summary, breaches first."""
    findings = []
    for entry in summary.get("findings") or ():
        place = entry.get("place")
        findings.append(
            Finding(
                str(entry.get("kind", "")),
                str(entry.get("text", "")),
                bool(entry.get("breach")),
                _point(place) if place else None,
            )
        )
    return tuple(sorted(findings, key=lambda f: not f.breach))


_NUMBER = r"(-?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?)"

_PLACE = re.compile(rf"\(\s*{_NUMBER},\s*{_NUMBER},\s*{_NUMBER}\s*\)")


def place_in(message: str) -> Point | None:
    """The first place ``(x, y, z)`` in a message, mm."""
    match = _PLACE.search(message)
    return _point(match.groups()) if match else None


def _point(numbers: Sequence[Any]) -> Point:
    x, y, z = numbers
    return (float(x), float(y), float(z))


def beam_in(message: str) -> int | None:
    """The beam a message is about, counted from 0: "beam 3 leaves …" and "B003 …" give 2."""
    match = re.search(r"\b(?:beam |B)0*(\d+)\b", message)
    return int(match.group(1)) - 1 if match else None


def run_to_end(
    program: Program,
    arguments: Sequence[str],
    on_event: Callable[[Progress | str], None] = lambda event: None,
) -> Outcome:
    """Runs the program to its end and hands each progress and log line to ``on_event``."""
    reader = StderrReader()
    with tempfile.TemporaryFile() as stdout:
        try:
            process = subprocess.Popen(
                [program.path, *arguments],
                stdin=subprocess.DEVNULL,
                stdout=stdout,
                stderr=subprocess.PIPE,
                **without_window(),
            )
        except OSError as error:
            raise ProgramError(f"cannot start {program.path}: {error}") from error
        with process:
            assert process.stderr is not None
            for line in process.stderr:
                for event in reader.feed(line):
                    on_event(event)
            code = process.wait()
        for event in reader.close():
            on_event(event)
        stdout.seek(0)
        return verdict(code, stdout.read(), reader)
