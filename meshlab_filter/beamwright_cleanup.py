# SPDX-License-Identifier: MIT OR Apache-2.0
"""The clean-up of a mesh by MeshLab: filter script, labels that must outlive it, two engines."""

from __future__ import annotations

import contextlib
import os
import re
import shutil
import subprocess
import sys
from dataclasses import dataclass
from fnmatch import fnmatchcase
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import Any, Iterator, List, Sequence, Tuple
from xml.sax.saxutils import quoteattr

#: Vertices nearer than this part of the diagonal are one: a hundred roundings of the numbers.
MERGE = 1e-5

#: Loose pieces smaller than this part of the diagonal are dropped.
DROP = 0.03

#: Loose pieces of fewer faces are dropped where the diagonal is not known.
DROP_FACES = 25

#: Holes of at most this many edges are closed.
HOLE_EDGES = 60

#: Steps of smoothing in ``beamwright_prepare.mlx``.
SMOOTH_STEPS = 5

#: Selected faces in the ``flags`` of a PLY file.
SELECTED = 32

#: Names of groups that mean non-design where nothing else is asked for, as the program has them.
NON_DESIGN_NAMES = ("*non_design*", "*nondesign*", "fixed*", "keep*")


class CleanupError(Exception):
    """A mesh cannot be cleaned; the text says why."""


# ---------------------------------------------------------------------------------------------
# the filter script
# ---------------------------------------------------------------------------------------------

#: Name, type and value of a parameter; a length has an upper limit as well.
Parameter = Tuple[str, str, str, str]
Filter = Tuple[str, List[Parameter]]


def prepare_script(diagonal: float | None, smooth: int) -> str:
    """The clean-up as a filter script.

    * ``diagonal``: of the mesh it is for; ``None`` makes a script for meshes of any size
    * ``smooth``: steps of Taubin smoothing of the faces that are *not* selected

    Every parameter is written out: MeshLab 2020.09 aborts where one is missing.
    """
    filters = _merge_and_drop(diagonal)
    filters.append(
        (
            "Close Holes",
            [
                _parameter("MaxHoleSize", "Int", HOLE_EDGES),
                _parameter("Selected", "Bool", "false"),
                _parameter("NewFaceSelected", "Bool", "false"),
                _parameter("SelfIntersection", "Bool", "true"),
            ],
        )
    )
    if smooth:
        filters += _smooth_design(smooth)
    lines = ["<!DOCTYPE FilterScript>", "<FilterScript>"]
    for name, parameters in filters:
        lines.append(f" <filter name={quoteattr(name)}>")
        lines += [
            f'  <Param name="{parameter}" type="{kind}" value="{value}"{limits}'
            ' description="" tooltip=""/>'
            for parameter, kind, value, limits in parameters
        ]
        lines.append(" </filter>")
    return "\n".join([*lines, "</FilterScript>", ""])


def _merge_and_drop(diagonal: float | None) -> list[Filter]:
    """Filters that join what touches and drop what is loose."""
    duplicates: Filter = ("Remove Duplicate Faces", [])
    unreferenced = _parameter("removeUnref", "Bool", "true")
    if diagonal is None:
        size = _parameter("MinComponentSize", "Int", DROP_FACES)
        return [
            ("Remove Duplicate Vertices", []),
            duplicates,
            ("Remove Isolated pieces (wrt Face Num.)", [size, unreferenced]),
        ]
    near = _length("Threshold", diagonal * MERGE, diagonal)
    size = _length("MinComponentDiag", diagonal * DROP, diagonal)
    return [
        ("Merge Close Vertices", [near]),
        duplicates,
        ("Remove Isolated pieces (wrt Diameter)", [size, unreferenced]),
    ]


def _smooth_design(steps: int) -> list[Filter]:
    invert: Filter = (
        "Invert Selection",
        [_parameter("InvFaces", "Bool", "true"), _parameter("InvVerts", "Bool", "false")],
    )
    taubin: Filter = (
        "Taubin Smooth",
        [
            _parameter("lambda", "Float", "0.5"),
            _parameter("mu", "Float", "-0.53"),
            _parameter("stepSmoothNum", "Int", steps),
            _parameter("Selected", "Bool", "true"),
        ],
    )
    return [invert, taubin, invert]


def _parameter(name: str, kind: str, value: object) -> Parameter:
    return (name, f"Rich{kind}", str(value), "")


def _length(name: str, value: float, most: float) -> Parameter:
    return (name, "RichAbsPerc", f"{value:.9g}", f' min="0" max="{most:.9g}"')


# ---------------------------------------------------------------------------------------------
# labels that MeshLab would lose
# ---------------------------------------------------------------------------------------------


@dataclass
class Polygons:
    """What an OBJ file holds: points as text, polygons, and which of them are non-design."""

    points: list[str]
    polygons: list[list[int]]
    non_design: list[bool]


def read_obj(path: str, names: Sequence[str] = NON_DESIGN_NAMES) -> Polygons:
    """Points, polygons and group names of an OBJ file.

    * ``names``: patterns of groups that are non-design

    Raises ``CleanupError`` on a line it cannot read.
    """
    points: list[str] = []
    polygons: list[list[int]] = []
    labels: list[bool] = []
    label = {"g": False, "o": False, "usemtl": False}
    with open(path, encoding="utf-8", errors="replace") as file:
        for number, line in enumerate(file, 1):
            words = line.split()
            if not words:
                continue
            try:
                if words[0] == "v":
                    points.append(" ".join(f"{float(c)!r}" for c in words[1:4]))
                elif words[0] in label:
                    label[words[0]] = any(is_non_design(w, names) for w in words[1:])
                elif words[0] == "f":
                    corners = [int(w.split("/")[0]) for w in words[1:]]
                    polygons.append([c - 1 if c > 0 else len(points) + c for c in corners])
                    labels.append(any(label.values()))
            except ValueError as error:
                raise CleanupError(f"{path}, line {number}: {error}") from error
    return Polygons(points, polygons, labels)


def is_non_design(name: str, patterns: Sequence[str] = NON_DESIGN_NAMES) -> bool:
    """Whether a group name says non-design."""
    return any(fnmatchcase(_plain(name), _plain(pattern)) for pattern in patterns)


def _plain(name: str) -> str:
    """Lower case, with one sign for all the ways to write "non design"."""
    return re.sub(r"[-\s]", "_", name.strip().lower())


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


@contextlib.contextmanager
def undisturbed() -> Iterator[None]:
    """Keeps PyMeshLab from printing what it does and from moving to another folder."""
    sys.stdout.flush()
    sys.stderr.flush()
    kept, folder = [os.dup(stream) for stream in (1, 2)], Path.cwd()
    try:
        with open(os.devnull, "wb") as nowhere:
            for stream in (1, 2):
                os.dup2(nowhere.fileno(), stream)
        yield
    finally:
        for stream, copy in zip((1, 2), kept):
            os.dup2(copy, stream)
            os.close(copy)
        os.chdir(folder)


def clean_with_pymeshlab(path: str, target: str, smooth: int) -> str:
    """Cleans a mesh with PyMeshLab; returns what it says."""
    pymeshlab = import_module("pymeshlab")
    try:
        with undisturbed():
            return _clean(pymeshlab.MeshSet(), path, target, smooth)
    except pymeshlab.PyMeshLabException as error:
        raise CleanupError(f"MeshLab cannot clean {path}: {error}") from error


def _clean(meshes: Any, path: str, target: str, smooth: int) -> str:
    meshes.load_new_mesh(path)
    mesh = meshes.current_mesh()
    before = mesh.face_number()
    script = Path(target).with_suffix(".mlx")
    script.write_text(prepare_script(mesh.bounding_box().diagonal(), smooth), encoding="utf-8")
    meshes.load_filter_script(str(script))
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


#: Prints the diagonal of the bounding box, among much else.
MEASURE_SCRIPT = """<!DOCTYPE FilterScript>
<FilterScript>
 <filter name="Compute Geometric Measures"/>
</FilterScript>
"""


def clean_with_meshlabserver(path: str, target: str, smooth: int) -> str:
    """Cleans a mesh with ``meshlabserver`` of 2020.09, under ``xvfb-run`` without a display."""
    measure = Path(target).with_suffix(".measure.mlx")
    measure.write_text(MEASURE_SCRIPT, encoding="utf-8")
    said = _meshlabserver(["-i", path, "-s", str(measure)])
    found = re.search(r"Bounding Box Diag\w*\D*([\d.eE+-]+)", said)
    if not found:
        raise CleanupError(f"meshlabserver does not say how large {path} is:\n{said[-400:]}")
    script = Path(target).with_suffix(".mlx")
    script.write_text(prepare_script(float(found.group(1)), smooth), encoding="utf-8")
    said = _meshlabserver(["-i", path, "-o", target, "-m", "ff", "fc", "fq", "-s", str(script)])
    if not Path(target).is_file():
        raise CleanupError(f"meshlabserver wrote nothing:\n{said[-400:]}")
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


def clean(engine: str, path: str, target: str, smooth: int) -> str:
    """Cleans a mesh; returns what there is to say.

    * ``engine``: pymeshlab or meshlabserver
    * ``target``: PLY file the cleaned mesh goes to, selected faces kept

    Raises ``CleanupError`` where MeshLab fails.
    """
    run = clean_with_pymeshlab if engine == "pymeshlab" else clean_with_meshlabserver
    return run(path, target, smooth)


def engine_at_hand() -> str:
    """What can run the filter script here: pymeshlab, meshlabserver or none."""
    if find_spec("pymeshlab") is not None:
        return "pymeshlab"
    return "meshlabserver" if shutil.which("meshlabserver") else "none"
