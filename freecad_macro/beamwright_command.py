# SPDX-License-Identifier: MIT OR Apache-2.0
"""The command line of one run: what the user chose, and where the files go.

Nothing in this module needs FreeCAD.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Sequence

from beamwright_program import Program

#: What the program offers when its help does not list the choices.
PROFILES = (
    "auto",
    "round",
    "tube",
    "rectangle",
    "box",
    "ellipse",
    "i",
    "c",
    "l",
    "freeform",
    "catalogue",
)

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
    def sections(self) -> str:
        """The section at each skeletal point; only where the program can write them."""
        return self.path(".sections.json")

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


def command_line(
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
    for flag, path in (
        ("--sections", outputs.sections),
        ("--report", outputs.report),
        ("--export", outputs.project),
    ):
        if program.knows(flag):
            arguments += [flag, path]
    for region in regions:
        arguments += ["--non-design", region]
    arguments += list(options.extra)
    return arguments, left_out
