# SPDX-License-Identifier: MIT OR Apache-2.0
"""The program ``beamwright`` seen from Python: where it is and what it can do.

====================  =====================================================================
``find_program``      preference, then ``$BEAMWRIGHT``, then PATH
``probe``             version and the flags this version lists in its help
``refusal_of_input``  why it cannot read a file, and what to do instead
====================  =====================================================================

Nothing in this module needs FreeCAD.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Callable, Mapping, Sequence

MINIMUM_VERSION = (0, 1, 0)

EXECUTABLE = "beamwright.exe" if sys.platform == "win32" else "beamwright"


class ProgramError(Exception):
    """The program cannot be used; the text says why and what to do."""


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
            **without_window(),
        )
    except (OSError, subprocess.TimeoutExpired) as error:
        raise ProgramError(f"cannot start {path}: {error}") from error
    said: bytes = done.stdout
    return said.decode("utf-8", "replace")


def without_window() -> dict[str, Any]:
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
    "Open the file in FreeCAD and run the macro on the FEM mesh of the last state: it takes its "
    "surface."
)


def refusal_of_input(program: Program, path: str) -> str | None:
    """Why a file cannot be read, with what to do instead; None if it can."""
    if program.reads(path):
        return None
    name, formats = Path(path).name, " ".join(program.formats)
    if Path(path).suffix.lower() in (".inp", ".frd", ".vtk", ".vtu", ".csv"):
        return BESO_ADVICE.format(name=name, formats=formats)
    return f"this beamwright does not read {name}; it reads {formats}"
