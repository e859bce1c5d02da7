# SPDX-License-Identifier: MIT OR Apache-2.0
"""The program ``beamwright`` seen from Python: where it is, what it can do, what it says.

Nothing in this module needs FreeCAD.  The steps of a run:

====================  =====================================================================
``find_program``      preference, then ``$BEAMWRIGHT``, then PATH
``probe``             version and the flags this version lists in its help
``command``           arguments of one run; only flags that the program lists
``StderrReader``      bytes of standard error to progress, messages and the error line
``outcome``           exit code, summary and findings to one verdict in the program's words
``run``               all of it without an event loop, for scripts and tests
====================  =====================================================================
"""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Callable, Mapping, Sequence, Tuple

#: x, y, z in mm.
Point = Tuple[float, float, float]

MINIMUM_VERSION = (0, 1, 0)
EXECUTABLE = "beamwright.exe" if sys.platform == "win32" else "beamwright"

#: Share of the whole run each stage takes, in the order in which they come.
STAGES = (
    ("read", 0.05),
    ("mesh", 0.10),
    ("skeleton", 0.60),
    ("sections", 0.10),
    ("frame", 0.10),
    ("write", 0.05),
)


class ProgramError(Exception):
    """The program cannot be used; the text says why and what to do."""


# ---------------------------------------------------------------------------------------------
# where it is and what it can do
# ---------------------------------------------------------------------------------------------


def find_program(
    preference: str = "",
    environment: Mapping[str, str] | None = None,
    which: Callable[[str], str | None] = shutil.which,
) -> str | None:
    """Path of the program: preference, then ``$BEAMWRIGHT``, then PATH; None if nowhere."""
    environment = os.environ if environment is None else environment
    for candidate in (preference, environment.get("BEAMWRIGHT", "")):
        if candidate and is_executable(candidate):
            return str(Path(candidate))
    return which(EXECUTABLE)


def is_executable(path: str) -> bool:
    """Whether a file is there that may be started."""
    return Path(path).is_file() and os.access(path, os.X_OK)


NOT_FOUND = (
    "the program beamwright was not found: neither in the preference "
    "Mod/Beamwright/Executable, nor in $BEAMWRIGHT, nor on PATH"
)


@dataclass(frozen=True)
class Program:
    """A program that was asked for its version and its help."""

    path: str
    version: tuple[int, ...]
    flags: frozenset[str]
    choices: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    defaults: Mapping[str, str] = field(default_factory=dict)
    formats: tuple[str, ...] = ()

    @property
    def version_text(self) -> str:
        """The version as it is written: ``0.1.0``."""
        return ".".join(str(n) for n in self.version)

    def knows(self, flag: str) -> bool:
        """Whether ``beamwright reconstruct`` lists a flag."""
        return flag in self.flags

    def reads(self, path: str) -> bool:
        """Whether the help lists the extension of a file; True when it lists none at all."""
        return not self.formats or Path(path).suffix.lower() in self.formats


def probe(path: str, timeout: float = 20.0) -> Program:
    """Asks a program for its version and flags.

    Raises ``ProgramError`` if it cannot be started, is something else, or is too old.
    """
    said = _ask(path, ["--version"], timeout)
    match = re.match(r"beamwright (\d+)\.(\d+)\.(\d+)", said)
    if not match:
        first = said.strip().splitlines()[:1] or ["nothing"]
        raise ProgramError(f"{path} is not beamwright: `--version` says {first[0]!r}")
    version = tuple(int(n) for n in match.groups())
    if version < MINIMUM_VERSION:
        wanted = ".".join(str(n) for n in MINIMUM_VERSION)
        raise ProgramError(f"{path} is {match.group(0)}; this macro needs {wanted} or newer")
    help_text = _ask(path, ["reconstruct", "--help"], timeout)
    flags, choices, defaults = parse_help(help_text)
    if not {"--json", "--progress"} <= flags:
        raise ProgramError(f"{path} reports no progress; this macro needs a newer beamwright")
    return Program(path, version, flags, choices, defaults, input_formats(help_text))


def _ask(path: str, arguments: Sequence[str], timeout: float) -> str:
    try:
        done = subprocess.run(
            [path, *arguments],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            timeout=timeout,
            check=False,
            **_without_window(),
        )
    except (OSError, subprocess.TimeoutExpired) as error:
        raise ProgramError(f"cannot start {path}: {error}") from error
    said: bytes = done.stdout
    return said.decode("utf-8", "replace")


def _without_window() -> dict[str, Any]:
    """On Windows a console program would flash up a black window."""
    flag = getattr(subprocess, "CREATE_NO_WINDOW", None)
    return {} if flag is None else {"creationflags": flag}


def parse_help(text: str) -> tuple[frozenset[str], dict[str, tuple[str, ...]], dict[str, str]]:
    """Flags, their choices and their defaults from the text of ``--help``."""
    choices: dict[str, tuple[str, ...]] = {}
    defaults: dict[str, str] = {}
    flags: list[str] = []
    blocks = re.split(r"(?m)^(?=\s+(?:-\w, )?--[a-z])", text)
    for block in blocks[1:]:
        head = block.splitlines()[0]
        match = re.search(r"--([a-z][a-z0-9-]*)", head)
        if not match:
            continue
        flag = "--" + match.group(1)
        flags.append(flag)
        found = re.search(r"\[possible values: ([^\]]+)\]", block)
        listed = re.findall(r"(?m)^\s+- ([\w-]+)(?::|$)", block.split("Possible values:")[-1])
        bracket = re.search(r"<([\w-]+(?:\|[\w-]+)+)>", head)
        if found:
            choices[flag] = tuple(v.strip() for v in found.group(1).split(","))
        elif "Possible values:" in block and listed:
            choices[flag] = tuple(listed)
        elif bracket:
            choices[flag] = tuple(bracket.group(1).split("|"))
        default = re.search(r"\[default: ([^\]]+)\]", block)
        if default:
            defaults[flag] = default.group(1).strip()
    return frozenset(flags), choices, defaults


def input_formats(text: str) -> tuple[str, ...]:
    """Extensions of the input files that the help lists: ``('.off', '.obj', …)``."""
    for line in text.splitlines():
        if re.search(r"(?i)\b(mesh|input)\b.*\.\w+ \.\w+", line):
            return tuple(e.lower() for e in re.findall(r"(?<!\w)\.[A-Za-z0-9]+", line))
    return ()


BESO_ADVICE = (
    "{name} holds a volume result, which this beamwright does not read (it reads {formats}). "
    "Export the surface: open the file in FreeCAD, select the FEM mesh of the last state, "
    "FEM > Mesh > FEM mesh to mesh, and run the macro on the mesh it makes."
)


def refusal_of_input(program: Program, path: str) -> str | None:
    """Why a file cannot be read, with what to do instead; None if it can."""
    if program.reads(path):
        return None
    name, formats = Path(path).name, " ".join(program.formats)
    if Path(path).suffix.lower() in (".inp", ".frd", ".vtk", ".vtu", ".csv"):
        return BESO_ADVICE.format(name=name, formats=formats)
    return f"this beamwright does not read {name}; it reads {formats}"


# ---------------------------------------------------------------------------------------------
# one run
# ---------------------------------------------------------------------------------------------

#: What the program offers when its help does not list the choices.
PROFILES = ("auto", "round", "tube", "rectangle", "box", "ellipse", "freeform", "catalogue")
LOFTS = ("constant", "taper", "multi")
JOINTS = ("none", "sphere", "mitre", "trim")


@dataclass(frozen=True)
class Options:
    """What the user chose; None or "" leaves the choice to the program.

    * ``density``: kg/m³
    * ``max_deviation``: in section radii
    * ``unit``: of length in the input file: mm, cm, m or in
    """

    profile: str = ""
    loft: str = ""
    joints: str = ""
    density: float | None = None
    max_deviation: float | None = None
    unit: str = ""
    strict: bool = False
    extra: tuple[str, ...] = ()

    def arguments(self) -> list[tuple[str, str | None]]:
        """Flag and value of each choice that was made."""
        chosen: list[tuple[str, str | None]] = [
            ("--profile", self.profile or None),
            ("--loft", self.loft or None),
            ("--joints", self.joints or None),
            ("--density", None if self.density is None else f"{self.density:g}"),
            ("--max-deviation", None if self.max_deviation is None else f"{self.max_deviation:g}"),
            ("--unit", self.unit or None),
        ]
        if self.strict:
            return [*(c for c in chosen if c[1] is not None), ("--strict", None)]
        return [c for c in chosen if c[1] is not None]

    def chosen(self) -> list[str]:
        """The choices as they would be typed."""
        return [part for pair in self.arguments() for part in pair if part] + list(self.extra)


@dataclass(frozen=True)
class Outputs:
    """Files that a run writes, all in one folder that belongs to the run."""

    folder: str
    stem: str

    def path(self, ending: str) -> str:
        """Path of the file with an ending such as ``.step``."""
        return str(Path(self.folder) / (self.stem + ending))

    @property
    def step(self) -> str:
        """The solids."""
        return self.path(".step")

    @property
    def cut_list(self) -> str:
        """The cut list."""
        return self.path(".csv")

    @property
    def skeleton(self) -> str:
        """The skeleton."""
        return self.path(".skeleton.json")

    @property
    def report(self) -> str:
        """The report; only where the program can write one."""
        return self.path(".report.html")

    @property
    def project(self) -> str:
        """The MeshLab project, with the beams as a mesh; only where the program can write one."""
        return self.path(".mlp")

    @property
    def beams_mesh(self) -> str:
        """The beams as a coloured mesh, a layer of the project."""
        return self.path(".beams.ply")


def command(
    program: Program,
    mesh: str,
    outputs: Outputs,
    options: Options,
    regions: Sequence[str] = (),
) -> tuple[list[str], list[str]]:
    """Arguments of ``beamwright reconstruct``, and the flags left out as unknown to it.

    * ``mesh``: the input file
    * ``regions``: files with closed non-design meshes
    """
    arguments = ["reconstruct", mesh, "-o", outputs.step]
    arguments += ["--cut-list", outputs.cut_list, "--skeleton", outputs.skeleton]
    arguments += ["--json", "--progress", "json"]
    left_out = []
    for flag, value in options.arguments():
        if program.knows(flag):
            arguments += [flag] if value is None else [flag, value]
        else:
            left_out.append(flag)
    for flag, path in (("--report", outputs.report), ("--export", outputs.project)):
        if program.knows(flag):
            arguments += [flag, path]
    for region in regions:
        arguments += ["--non-design", region]
    arguments += list(options.extra)
    return arguments, left_out


@dataclass(frozen=True)
class Progress:
    """How far the run is: ``stage``, ``done`` of ``total``, and ``fraction`` 0..1 of the run."""

    stage: str
    done: int
    total: int
    fraction: float


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


def overall(stage: str, done: int, total: int) -> float:
    """Part 0..1 of the whole run that is done; 0 for a stage that is not known."""
    before = 0.0
    for name, share in STAGES:
        if name == stage:
            part = min(max(done / total, 0.0), 1.0) if total > 0 else 0.0
            return before + share * part
        before += share
    return 0.0


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


CANCELLED = "cancelled; nothing was changed"


def outcome(
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
            findings = (Finding("error", message, True, place),)
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


def run(
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
                **_without_window(),
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
        return outcome(code, stdout.read(), reader)
