#!/usr/bin/env python3
# SPDX-License-Identifier: MIT OR Apache-2.0
"""From a mesh to a MeshLab project with its skeleton and beams.

    python beamwright_meshlab.py part.ply -o result.mlp --open

    part.ply ──clean-up──► cleaned.ply ──beamwright──► result.mlp  mesh, skeleton, beams
              PyMeshLab                                result.step, result.csv, …
              or meshlabserver

A filter script of MeshLab cannot start a program, so this driver stands around it.  The clean-up
is that of ``beamwright_prepare.mlx``, but with lengths taken from the bounding box of the mesh.
What follows ``--`` goes to ``beamwright reconstruct`` as it is:

    python beamwright_meshlab.py part.ply -o result.mlp -- --profile catalogue --strict
"""

from __future__ import annotations

import argparse
import json
import os
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Mapping, Sequence

import beamwright_cleanup as cleanup

#: Exit codes, as the program has them.
FAILED, WRONG_USAGE, INTERRUPTED = 1, 2, 130


class DriverError(Exception):
    """The driver cannot go on; the text says why and what to do."""

    def __init__(self, text: str, code: int = FAILED) -> None:
        super().__init__(text)
        self.code = code


# ---------------------------------------------------------------------------------------------
# the program
# ---------------------------------------------------------------------------------------------


def find_program(named: str | None, environment: Mapping[str, str] = os.environ) -> str:
    """The program: as named, then ``$BEAMWRIGHT``, then PATH."""
    for candidate in (named, environment.get("BEAMWRIGHT")):
        if candidate:
            if not Path(candidate).is_file():
                raise DriverError(f"there is no program {candidate}", WRONG_USAGE)
            return str(Path(candidate).resolve())
    found = shutil.which("beamwright")
    if not found:
        raise DriverError(
            "beamwright was not found: name it with --beamwright or $BEAMWRIGHT", WRONG_USAGE
        )
    return str(Path(found).resolve())


def inspect(program: str, path: str, options: Sequence[str]) -> dict[str, Any] | None:
    """What the program says of a mesh; None if it cannot use it as it is."""
    command = [program, "inspect", path, "--json", "--quiet", *options]
    done = subprocess.run(command, capture_output=True, check=False)
    if done.returncode:
        return None
    summary: dict[str, Any] = json.loads(done.stdout)
    return summary


def label_line(summary: Mapping[str, Any]) -> str:
    """The labels of a mesh in words."""
    labels = summary.get("labels") or {}
    if not labels.get("source"):
        return "no labels: branches start at flat or free ends"
    return (
        f"{labels['non_design_faces']} non-design faces in {labels['sets']} set(s), "
        f"{len(labels['interfaces'])} interface section(s), by {labels['source']}"
    )


def reconstruct(program: str, mesh: str, project: Path, options: Sequence[str]) -> int:
    """Runs the program on a prepared mesh; returns its exit code."""
    step = project.with_suffix(".step")
    command = [program, "reconstruct", mesh, "-o", str(step), "--export", str(project), *options]
    return subprocess.run(command, check=False).returncode


def values_of(flag: str, options: Sequence[str]) -> list[str]:
    """The values of a flag among the options for the program: ``--flag x`` or ``--flag=x``."""
    after = [b for a, b in zip(options, options[1:]) if a == flag]
    return after + [o.split("=", 1)[1] for o in options if o.startswith(flag + "=")]


# ---------------------------------------------------------------------------------------------
# all of it
# ---------------------------------------------------------------------------------------------


def say(text: str) -> None:
    """One line for the user, beside the results on standard output."""
    print(text, file=sys.stderr, flush=True)


@dataclass
class Job:
    """What is to be done."""

    program: str
    source: str
    project: Path
    engine: str
    smooth: int
    options: list[str]

    def input_options(self) -> list[str]:
        """The options that say how the mesh is read and labelled."""
        flags = ("--unit", "--non-design", "--non-design-box", "--non-design-name")
        return [f"{flag}={value}" for flag in flags for value in values_of(flag, self.options)]


def prepared(job: Job, folder: Path) -> str:
    """The mesh for the program: cleaned, or the file itself where cleaning would do harm."""
    if job.engine == "none":
        say("no clean-up")
        return job.source
    if job.source.lower().endswith((".glb", ".gltf")):
        say("no clean-up: glTF is in metres, which the cleaned file would not say")
        return job.source
    before = inspect(job.program, job.source, job.input_options())
    given, by = job.source, before["labels"]["source"] if before else None
    if job.source.lower().endswith(".obj"):
        # MeshLab forgets the names of groups; selection flags it keeps.
        patterns = values_of("--non-design-name", job.options) or cleanup.NON_DESIGN_NAMES
        mesh = cleanup.read_obj(job.source, patterns)
        if any(mesh.non_design) and not all(mesh.non_design):
            given, by = str(folder / "labelled.ply"), "selection flags"
            cleanup.write_flags(given, mesh)
    if not cleanup.labels_survive(by, given):
        say(f"no clean-up: MeshLab would lose the labels by {by}")
        return job.source
    target = str(folder / (Path(job.source).stem + ".ply"))
    say(cleanup.clean(job.engine, given, target, job.smooth))
    after = inspect(job.program, target, job.input_options())
    if before and not after:
        say("the clean-up made it worse; the mesh is used as it is")
        return job.source
    if after:
        say(label_line(after))
    return target


def parser() -> argparse.ArgumentParser:
    """What can be typed."""
    made = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    made.add_argument("input", metavar="IN", help="mesh that MeshLab and beamwright read")
    made.add_argument("-o", "--output", required=True, metavar="OUT.mlp", help="MeshLab project")
    made.add_argument(
        "--engine",
        choices=("auto", "pymeshlab", "meshlabserver", "none"),
        default="auto",
        help="what cleans the mesh; none: nothing does (default: auto)",
    )
    made.add_argument(
        "--smooth",
        type=int,
        default=0,
        metavar="STEPS",
        help="Taubin smoothing of the design faces, for voxel-like meshes (default: 0)",
    )
    made.add_argument("--beamwright", metavar="PATH", help="the program")
    made.add_argument("--open", action="store_true", help="open the project in MeshLab")
    return made


def job_of(words: Sequence[str]) -> tuple[Job, bool]:
    """What was typed as a job, and whether the result is to be opened."""
    at = words.index("--") if "--" in words else len(words)
    arguments = parser().parse_args(words[:at])
    project = Path(arguments.output).resolve()
    if project.suffix.lower() != ".mlp":
        raise DriverError(f"the output {arguments.output} must end in .mlp", WRONG_USAGE)
    if not project.parent.is_dir():
        raise DriverError(f"cannot write {project}: its folder does not exist")
    source = Path(arguments.input)
    if not source.is_file():
        raise DriverError(f"there is no file {source}")
    engine = cleanup.engine_at_hand() if arguments.engine == "auto" else arguments.engine
    program = find_program(arguments.beamwright)
    options = list(words[at + 1 :])
    job = Job(program, str(source.resolve()), project, engine, arguments.smooth, options)
    return job, arguments.open


def open_in_meshlab(project: Path) -> None:
    """Starts MeshLab with a project and does not wait for it."""
    if not shutil.which("meshlab"):
        raise DriverError(f"meshlab was not found: open {project} by hand")
    subprocess.Popen(["meshlab", str(project)], start_new_session=True)


def main(typed: Sequence[str] | None = None) -> int:
    """Runs the driver; returns the exit code: that of beamwright, 2 for wrong usage."""
    try:
        job, is_opened = job_of(sys.argv[1:] if typed is None else typed)
        with tempfile.TemporaryDirectory(prefix="beamwright-") as folder:
            mesh = prepared(job, Path(folder))
            code = reconstruct(job.program, mesh, job.project, job.options)
            if code == FAILED and mesh != job.source:
                kept = shutil.copy(mesh, job.project.with_suffix(".cleaned.ply"))
                say(f"the cleaned mesh this is about is kept as {kept}")
        if code == 0 and is_opened:
            open_in_meshlab(job.project)
    except DriverError as error:
        say(f"error: {error}")
        return error.code
    except cleanup.CleanupError as error:
        say(f"error: {error}")
        return FAILED
    except KeyboardInterrupt:
        return INTERRUPTED
    return code


if __name__ == "__main__":
    sys.exit(main())
