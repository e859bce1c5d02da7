#!/usr/bin/env python3
# SPDX-License-Identifier: MIT OR Apache-2.0
"""From a mesh to a MeshLab project with its skeleton and beams.

    python beamwright_meshlab.py part.ply -o result.mlp --open

    part.ply ──clean-up──► cleaned.ply ──beamwright──► result.mlp  mesh, skeleton, beams
              PyMeshLab                                result.step, result.csv, …
              or meshlabserver

A filter script of MeshLab cannot start a program, so this driver stands around it.  The clean-up
is that of ``beamwright_prepare.mlx`` with its lengths taken from the bounding box of the mesh.
What follows ``--`` goes to ``beamwright reconstruct`` as it is.
"""

from __future__ import annotations

import argparse
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Mapping, Sequence
from xml.sax.saxutils import quoteattr

#: Vertices nearer than this part of the diagonal are one: a hundred roundings of the numbers.
MERGE = 1e-5

#: Loose pieces smaller than this part of the diagonal are dropped.
DROP = 0.03

#: Holes of at most this many edges are closed.
HOLE_EDGES = 60

#: Selected faces in the ``flags`` of a PLY file.
SELECTED = 32

#: Names of groups that mean non-design, as the program has them.
NON_DESIGN = re.compile(r"non_?design|^fixed|^keep")


class DriverError(Exception):
    """The driver cannot go on; the text says why and what to do."""


# ---------------------------------------------------------------------------------------------
# the filter script
# ---------------------------------------------------------------------------------------------


def prepare_script(diagonal: float, smooth: int = 0) -> str:
    """The clean-up as a filter script for a mesh of this diagonal.

    * ``smooth``: steps of Taubin smoothing of the faces that are *not* selected

    Every parameter is written out: MeshLab 2020.09 aborts where one is missing.
    """
    merge, drop = diagonal * MERGE, diagonal * DROP
    filters = [
        ("Merge Close Vertices", [("Threshold", "RichAbsPerc", f"{merge:.9g}", diagonal)]),
        ("Remove Duplicate Faces", []),
        (
            "Remove Isolated pieces (wrt Diameter)",
            [
                ("MinComponentDiag", "RichAbsPerc", f"{drop:.9g}", diagonal),
                ("removeUnref", "RichBool", "true", None),
            ],
        ),
        (
            "Close Holes",
            [
                ("MaxHoleSize", "RichInt", str(HOLE_EDGES), None),
                ("Selected", "RichBool", "false", None),
                ("NewFaceSelected", "RichBool", "false", None),
                ("SelfIntersection", "RichBool", "true", None),
            ],
        ),
    ]
    if smooth:
        invert = (
            "Invert Selection",
            [("InvFaces", "RichBool", "true", None), ("InvVerts", "RichBool", "false", None)],
        )
        taubin = (
            "Taubin Smooth",
            [
                ("lambda", "RichFloat", "0.5", None),
                ("mu", "RichFloat", "-0.53", None),
                ("stepSmoothNum", "RichInt", str(smooth), None),
                ("Selected", "RichBool", "true", None),
            ],
        )
        filters += [invert, taubin, invert]
    lines = ["<!DOCTYPE FilterScript>", "<FilterScript>"]
    for name, parameters in filters:
        lines.append(f" <filter name={quoteattr(name)}>")
        for parameter, kind, value, most in parameters:
            limits = "" if most is None else f' min="0" max="{most:.9g}"'
            lines.append(
                f'  <Param name="{parameter}" type="{kind}" value="{value}"{limits}'
                ' description="" tooltip=""/>'
            )
        lines.append(" </filter>")
    return "\n".join([*lines, "</FilterScript>", ""])


# ---------------------------------------------------------------------------------------------
# labels that MeshLab would lose
# ---------------------------------------------------------------------------------------------


@dataclass
class Polygons:
    """What an OBJ file holds: points as text, polygons, and which of them are non-design."""

    points: list[str]
    polygons: list[list[int]]
    non_design: list[bool]


def read_obj(path: str) -> Polygons:
    """Points, polygons and group names of an OBJ file.  Raises ``DriverError`` on a bad line."""
    points: list[str] = []
    polygons: list[list[int]] = []
    labels: list[bool] = []
    label = False
    with open(path, encoding="utf-8", errors="replace") as file:
        for number, line in enumerate(file, 1):
            words = line.split()
            if not words:
                continue
            try:
                if words[0] == "v":
                    points.append(" ".join(f"{float(c)!r}" for c in words[1:4]))
                elif words[0] in ("g", "o", "usemtl"):
                    label = any(is_non_design(w) for w in words[1:])
                elif words[0] == "f":
                    corners = [int(w.split("/")[0]) for w in words[1:]]
                    polygons.append([c - 1 if c > 0 else len(points) + c for c in corners])
                    labels.append(label)
            except ValueError as error:
                raise DriverError(f"{path}, line {number}: {error}") from error
    return Polygons(points, polygons, labels)


def is_non_design(name: str) -> bool:
    """Whether a group name says non-design."""
    return bool(NON_DESIGN.search(name.lower().replace("-", "_")))


def write_flags(path: str, mesh: Polygons) -> None:
    """ASCII PLY whose non-design faces are selected, as MeshLab saves "select + face flags"."""
    with open(path, "w", encoding="ascii") as out:
        out.write("ply\nformat ascii 1.0\n")
        out.write(f"element vertex {len(mesh.points)}\n")
        out.write("property double x\nproperty double y\nproperty double z\n")
        out.write(f"element face {len(mesh.polygons)}\n")
        out.write("property list uchar int vertex_indices\nproperty int flags\nend_header\n")
        out.writelines(p + "\n" for p in mesh.points)
        for corners, label in zip(mesh.polygons, mesh.non_design):
            flags = SELECTED if label else 0
            out.write(f"{len(corners)} {' '.join(map(str, corners))} {flags}\n")


#: Label sources of the program that a PLY file keeps through MeshLab.
KEPT_IN_PLY = ("selection flags", "face quality", "face colour", "vertex colour")


def labels_survive(source: str | None, path: str) -> bool:
    """Whether MeshLab keeps the labels that the program found in a file."""
    return source is None or (source in KEPT_IN_PLY and path.lower().endswith(".ply"))


# ---------------------------------------------------------------------------------------------
# the clean-up
# ---------------------------------------------------------------------------------------------


def clean_with_pymeshlab(path: str, target: str, smooth: int) -> str:
    """Cleans a mesh with PyMeshLab; returns what it says."""
    import pymeshlab

    meshes = pymeshlab.MeshSet()
    meshes.load_new_mesh(path)
    before = meshes.current_mesh().face_number()
    script = str(Path(target).with_suffix(".mlx"))
    diagonal = meshes.current_mesh().bounding_box().diagonal()
    Path(script).write_text(prepare_script(diagonal, smooth), encoding="utf-8")
    meshes.load_filter_script(script)
    meshes.apply_filter_script()
    mesh = meshes.current_mesh()
    meshes.save_current_mesh(
        target,
        save_face_flag=True,
        save_face_color=mesh.has_face_color(),
        save_face_quality=mesh.has_face_scalar(),
        save_vertex_color=mesh.has_vertex_color(),
    )
    return f"{before} faces before the clean-up, {mesh.face_number()} after it (PyMeshLab)"


def clean_with_meshlabserver(path: str, target: str, smooth: int) -> str:
    """Cleans a mesh with ``meshlabserver`` of 2020.09, under ``xvfb-run`` without a display."""
    measure = Path(target).with_suffix(".measure.mlx")
    measure.write_text(
        '<!DOCTYPE FilterScript>\n<FilterScript>\n <filter name="Compute Geometric Measures"/>\n'
        "</FilterScript>\n",
        encoding="utf-8",
    )
    said = _meshlabserver(["-i", path, "-s", str(measure)])
    found = re.search(r"Bounding Box Diag\w*\D*([\d.eE+-]+)", said)
    if not found:
        raise DriverError(f"meshlabserver does not say how large {path} is:\n{said[-400:]}")
    script = Path(target).with_suffix(".mlx")
    script.write_text(prepare_script(float(found.group(1)), smooth), encoding="utf-8")
    said = _meshlabserver(["-i", path, "-o", target, "-m", "ff", "fc", "fq", "-s", str(script)])
    if not Path(target).is_file():
        raise DriverError(f"meshlabserver wrote nothing:\n{said[-400:]}")
    saved = re.search(r"saved as .*\((\d+) vn (\d+) fn\)", said)
    return f"{saved.group(2) if saved else '?'} faces after the clean-up (meshlabserver)"


def _meshlabserver(arguments: Sequence[str]) -> str:
    command = ["meshlabserver", *arguments]
    if not os.environ.get("DISPLAY") and shutil.which("xvfb-run"):
        command = ["xvfb-run", "-a", *command]
    done = subprocess.run(
        command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False, timeout=600
    )
    return done.stdout.decode("utf-8", "replace")


def engine_at_hand() -> str:
    """What can run the filter script here: pymeshlab, meshlabserver or none."""
    from importlib.util import find_spec

    if find_spec("pymeshlab") is not None:
        return "pymeshlab"
    return "meshlabserver" if shutil.which("meshlabserver") else "none"


# ---------------------------------------------------------------------------------------------
# the program
# ---------------------------------------------------------------------------------------------


def find_program(named: str | None, environment: Mapping[str, str] = os.environ) -> str:
    """The program: as named, then ``$BEAMWRIGHT``, then PATH."""
    for candidate in (named, environment.get("BEAMWRIGHT")):
        if candidate:
            if not Path(candidate).is_file():
                raise DriverError(f"there is no program {candidate}")
            return str(Path(candidate).resolve())
    found = shutil.which("beamwright")
    if not found:
        raise DriverError("beamwright was not found: name it with --beamwright or $BEAMWRIGHT")
    return found


def inspect(program: str, path: str, options: Sequence[str] = ()) -> dict[str, Any] | None:
    """What the program says of a mesh; None if it cannot use it as it is."""
    command = [program, "inspect", path, "--json", "--progress", "none", *options]
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)
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


def knows(program: str, flag: str) -> bool:
    """Whether ``beamwright reconstruct`` lists a flag."""
    done = subprocess.run(
        [program, "reconstruct", "--help"], stdout=subprocess.PIPE, check=False, timeout=60
    )
    return re.search(rf"(?m)^\s.*{re.escape(flag)}\b", done.stdout.decode("utf-8")) is not None


def write_project(path: str, layers: Sequence[tuple[str, str]]) -> None:
    """A project of labelled layers beside it, for a program that cannot write one itself."""
    lines = ["<!DOCTYPE MeshLabDocument>", "<MeshLabProject>", " <MeshGroup>"]
    for label, file in layers:
        lines.append(f"  <MLMesh label={quoteattr(label)} filename={quoteattr(Path(file).name)}>")
        lines.append("   <MLMatrix44>\n1 0 0 0 \n0 1 0 0 \n0 0 1 0 \n0 0 0 1 \n</MLMatrix44>")
        lines.append("  </MLMesh>")
    lines += [" </MeshGroup>", " <RasterGroup/>", "</MeshLabProject>", ""]
    Path(path).write_text("\n".join(lines), encoding="utf-8")


def reconstruct(program: str, mesh: str, project: Path, options: Sequence[str]) -> int:
    """Runs the program on a prepared mesh; returns its exit code."""
    command = [program, "reconstruct", mesh, "-o", str(project.with_suffix(".step"))]
    if knows(program, "--export"):
        return subprocess.run([*command, "--export", str(project), *options], check=False).returncode
    say("this beamwright writes no MeshLab project; the beams are in the STEP file only")
    skeleton = project.with_suffix(".skeleton.ply")
    code = subprocess.run([*command, "--skeleton", str(skeleton), *options], check=False).returncode
    if code == 0:
        copied = project.with_suffix(".input.ply")
        shutil.copy(mesh, copied)
        write_project(str(project), [("mesh", str(copied)), ("skeleton", str(skeleton))])
    return code


# ---------------------------------------------------------------------------------------------
# all of it
# ---------------------------------------------------------------------------------------------


def say(text: str) -> None:
    """One line for the user, beside the results on standard output."""
    print(text, file=sys.stderr, flush=True)


def prepared(arguments: argparse.Namespace, program: str, folder: str) -> str:
    """The mesh for the program: cleaned, or the file itself where cleaning would lose labels."""
    source = str(Path(arguments.input).resolve())
    engine = engine_at_hand() if arguments.engine == "auto" else arguments.engine
    if engine == "none":
        say("no clean-up")
        return source
    before = inspect(program, source, arguments.units)
    given = source
    by = before["labels"]["source"] if before else None
    if source.lower().endswith(".obj"):
        # MeshLab forgets the names of groups; selection flags it keeps.
        mesh = read_obj(source)
        if any(mesh.non_design) and not all(mesh.non_design):
            given = str(Path(folder) / "labelled.ply")
            write_flags(given, mesh)
            by = "selection flags"
    if not labels_survive(by, given):
        say(f"no clean-up: MeshLab would lose the labels by {by}")
        return source
    target = str(Path(folder) / (Path(source).stem + ".ply"))
    clean = clean_with_pymeshlab if engine == "pymeshlab" else clean_with_meshlabserver
    say(clean(given, target, arguments.smooth))
    after = inspect(program, target, arguments.units)
    if before and after and label_line(before).split(",")[1:2] != label_line(after).split(",")[1:2]:
        say(f"before the clean-up: {label_line(before)}")
    if after:
        say(label_line(after))
    return target


def parser() -> argparse.ArgumentParser:
    """What can be typed."""
    doc = (__doc__ or "").split("\n\n")
    made = argparse.ArgumentParser(
        description=doc[0], epilog=doc[-1], formatter_class=argparse.RawDescriptionHelpFormatter
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


def main(typed: Sequence[str] | None = None) -> int:
    """Runs the driver; returns the exit code: that of beamwright, or 2 for wrong usage."""
    words = list(sys.argv[1:] if typed is None else typed)
    at = words.index("--") if "--" in words else len(words)
    arguments = parser().parse_args(words[:at])
    options = words[at + 1 :]
    arguments.units = options[options.index("--unit") :][:2] if "--unit" in options else []
    # PyMeshLab changes the working directory: from here on all paths are absolute.
    project = Path(arguments.output).resolve()
    try:
        if project.suffix.lower() != ".mlp":
            raise DriverError(f"the output {arguments.output} must end in .mlp")
        if not Path(arguments.input).is_file():
            raise DriverError(f"there is no file {arguments.input}")
        program = find_program(arguments.beamwright)
        with tempfile.TemporaryDirectory(prefix="beamwright-") as folder:
            code = reconstruct(program, prepared(arguments, program, folder), project, options)
    except DriverError as error:
        say(f"error: {error}")
        return 2
    if code == 0 and arguments.open:
        subprocess.Popen(["meshlab", str(project)])
    return code


if __name__ == "__main__":
    sys.exit(main())
