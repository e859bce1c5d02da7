"""The macro in FreeCAD's console: documents in, documents out, and what is said when it fails."""

from __future__ import annotations

import json
import os
import re
import subprocess
import time
from pathlib import Path
from typing import Any, Callable

import Fem
import FreeCAD as App
import Mesh
import ObjectsFem
from beamwright_command import Options
from beamwright_input import (
    FACES,
    FEM,
    NONE,
    REGIONS,
    InputError,
    NonDesign,
    Source,
    is_mesh,
    triangles_of,
)
from beamwright_macro import reconstruct
from beamwright_mesh import FlatRegions
from beamwright_program import ProgramError
from beamwright_result import ResultError
from beamwright_step import mark_of
from scene import (
    ARTEFACTS,
    MACRO,
    PROGRAM,
    SAMPLES,
    document,
    equal,
    main,
    names,
    samples,
    say,
    stand_in,
    temporary_folders,
)


def meshes(doc: Any) -> list[Any]:
    """The mesh objects of a document."""
    return [o for o in doc.Objects if is_mesh(o)]


def summary_of(group: Any) -> Any:
    """What the program said of the run that made a group."""
    return json.loads(group.Summary)


def marks(group: Any) -> list[str]:
    """Marks of the beams in the program's summary, as ``B001``."""
    return [row["mark"] for row in summary_of(group)["frame"]["table"]]


def solids(group: Any) -> list[Any]:
    """The beams of a group, wherever they stand in it."""
    objects = group.OutListRecursive
    found = [o for o in objects if o.TypeId == "Part::Feature" and o.Shape.Solids]
    return sorted((o for o in found if mark_of(o.Label)), key=lambda o: o.Label)


def sheet_of(group: Any) -> Any:
    """The cut list of a group."""
    return next(o for o in group.Group if o.TypeId == "Spreadsheet::Sheet")


def names_in_sheet(sheet: Any) -> list[str]:
    """All beams the cut list names, in its order."""
    listed: list[str] = []
    row = 2
    while sheet.get(f"B{row}") != "Total":
        listed += sheet.get(f"B{row}").split(", ")
        row += 1
    return listed


def refused(what: Callable[[], Any], *kinds: type[Exception]) -> str:
    """The message with which something is refused."""
    try:
        what()
    except kinds as error:
        return str(error)
    raise AssertionError("it was not refused")


# -- what comes out --------------------------------------------------------------------------------


def every_beam_arrives_named_as_in_the_cut_list_and_survives_saving() -> None:
    for sample in samples():
        doc = document(sample)
        inserted = reconstruct(doc, Source(meshes(doc)))
        check_group(inserted.group)
        path = str(ARTEFACTS / (Path(sample).stem + ".FCStd"))
        doc.saveAs(path)
        App.closeDocument(doc.Name)
        again = App.openDocument(path)
        group = next(o for o in again.Objects if "BeamwrightSource" in o.PropertiesList)
        check_group(group)
        say(f"       {sample}: {len(marks(group))} beams")
        App.closeDocument(again.Name)


def check_group(group: Any) -> None:
    """Beams as many as in the summary, valid, named as in the cut list; the rest beside them."""
    beams = solids(group)
    equal([b.Label.split()[0] for b in beams], marks(group), "marks")
    equal([b.Label for b in beams if not b.Shape.isValid()], [], "invalid shapes")
    equal(sorted(names_in_sheet(sheet_of(group))), sorted(b.Label for b in beams), "cut list")
    equal(Path(group.Report).is_file(), True, "the report is in the document")
    kinds = {o.TypeId for o in group.Group}
    for kind in ("App::Part", "Part::Feature", "Spreadsheet::Sheet", "App::TextDocument"):
        equal(kind in kinds, True, f"{kind} in the group")


def every_kind_of_joint_arrives_as_valid_solids() -> None:
    for joint in ("none", "sphere", "mitre", "trim"):
        doc = document("cantilever.obj")
        group = reconstruct(doc, Source(meshes(doc)), options=Options("round", joints=joint)).group
        check_group(group)
        angles = [sheet_of(group).get(f"{c}{row}").Value for c in "GH" for row in (2, 3, 4)]
        if joint in ("none", "trim"):
            equal(max(angles) > 0.0, joint == "trim", f"angles of the cuts with {joint}")
        App.closeDocument(doc.Name)


def beams_stand_where_the_program_put_them() -> None:
    doc = document("cantilever.obj")
    group = reconstruct(doc, Source(meshes(doc))).group
    for beam, row in zip(solids(group), summary_of(group)["frame"]["table"]):
        middle = [(a + b) / 2.0 for a, b in zip(row["start"], row["end"])]
        inside = beam.Shape.isInside(App.Vector(*middle), 1e-3, True)
        equal(inside, True, f"middle of the axis in {beam.Label}")


def one_undo_brings_back_what_was_there() -> None:
    doc = document("y_form.obj")
    before = names(doc)
    reconstruct(doc, Source(meshes(doc)))
    after = names(doc)
    equal(doc.UndoNames, ["Beamwright"], "undo steps")
    doc.undo()
    equal(names(doc), before, "objects after undo")
    doc.redo()
    equal(names(doc), after, "objects after redo")


def a_second_run_replaces_the_first() -> None:
    doc = document("four_fixings.obj")
    source = Source(meshes(doc))
    first = reconstruct(doc, source)
    labels = sorted(o.Label for o in first.group.OutListRecursive)
    count = len(doc.Objects)
    second = reconstruct(doc, source, options=Options(profile="round"))
    equal(second.group.Name, first.group.Name, "group")
    equal(len(doc.Objects), count, "objects after the second run")
    equal(all(" Round " in b.Label for b in solids(second.group)), True, "round beams")
    doc.undo()
    equal(sorted(o.Label for o in first.group.OutListRecursive), labels, "objects after undo")


def the_skeleton_is_coloured_by_how_well_it_is_centred() -> None:
    from beamwright_skeleton import read_skeleton

    doc = document("cantilever.obj")
    kept = ARTEFACTS / "kept"
    kept.mkdir(exist_ok=True)
    reconstruct(doc, Source(meshes(doc)), keep=str(kept))
    skeleton = read_skeleton(str(kept / "design.skeleton.json"), str(kept / "design.sections.json"))
    known = [p.off_centre for p in skeleton.points if p.off_centre is not None]
    equal(len(known) > len(skeleton.points) // 2, True, "points that know their centre")
    equal(max(known) < 1.0, True, "points within a radius of their centre")


def a_fused_solid_is_sound_or_is_not_there() -> None:
    doc = document("y_form.obj")
    inserted = reconstruct(doc, Source(meshes(doc)), options=Options(profile="round"), fuse=True)
    fused = doc.getObject("Fused")
    say(f"       {inserted.notes[0]}")
    if fused is None:
        equal("separate solids" in " ".join(inserted.notes), True, "the reason is given")
        return
    volumes = [b.Shape.Volume for b in inserted.beams]
    equal(max(volumes) < fused.Shape.Volume <= sum(volumes) * 1.01, True, "volume of the union")


def hostile_names_stay_text() -> None:
    """Labels, profiles and cells that would be a script or a formula, through saving and back."""
    doc = document("single_bar.obj")
    for obj in meshes(doc):
        kept = "non_design " if obj.Label.startswith("non_design") else ""
        obj.Label = f"{kept}{HOSTILE}"
    profiles = ARTEFACTS / "hostile.csv"
    head = "# family: +mine\n# standard: -2+3\nname,shape,d\n"
    profiles.write_text(f"{head}=1+1{HOSTILE},round,10\n")
    extra = ("--catalogue", str(profiles), "--material=@SUM(A1)")
    options = Options("catalogue:+mine", extra=extra)
    reconstruct(doc, Source(meshes(doc)), options=options)
    path = str(ARTEFACTS / "hostile.FCStd")
    doc.saveAs(path)
    App.closeDocument(doc.Name)
    again = App.openDocument(path)
    group = next(o for o in again.Objects if "BeamwrightSource" in o.PropertiesList)
    check_group(group)
    equal(group.Label, f"Beamwright {HOSTILE}", "label of the group")
    (beam,) = solids(group)
    equal(beam.Label, f"B001 =1+1{HOSTILE}", "label of the beam")
    sheet = sheet_of(group)
    cells = [sheet.get(f"{c}2") for c in "ABEL"]
    equal(cells, [HOSTILE, beam.Label, "@SUM(A1)", "-2+3"], "cells of the cut list")


#: Part of every name: an element of a page, the end of a string and of a section in a STEP file.
HOSTILE = "<img src=x onerror=alert(1)>');ENDSEC;"


# -- where non-design comes from -------------------------------------------------------------------


def every_way_to_say_non_design_finds_the_same_sets() -> None:
    expected = interfaces(lambda doc: (Source(meshes(doc)), NonDesign()))
    equal(
        interfaces(lambda doc: (Source(file=str(SAMPLES / SAMPLE)), NonDesign())), expected, "file"
    )
    for how in (by_picked_faces, by_regions, by_open_meshes, by_fem):
        equal(interfaces(how), expected, how.__name__)
    without = interfaces(lambda doc: (Source([whole(doc)]), NonDesign(NONE)))
    equal(without == expected, False, "without labels")


SAMPLE = "cantilever.obj"


def interfaces(how: Callable[[Any], tuple[Source, NonDesign]]) -> tuple[int, list[list[float]]]:
    """Number of non-design sets, and the interface centroids the program found, rounded."""
    doc = document(SAMPLE)
    source, non_design = how(doc)
    labels = summary_of(reconstruct(doc, source, non_design).group)["labels"]
    centroids = sorted([round(c, 2) + 0.0 for c in i["centroid"]] for i in labels["interfaces"])
    return labels["sets"], centroids


def whole(doc: Any) -> Any:
    """Both meshes of a sample as one without labels, in place of them."""
    mesh = Mesh.Mesh()
    for obj in meshes(doc):
        mesh.addMesh(obj.Mesh)
        doc.removeObject(obj.Name)
    mesh.removeDuplicatedPoints()
    feature = doc.addObject("Mesh::Feature", "Whole")
    feature.Mesh = mesh
    return feature


def boxes(doc: Any) -> list[Any]:
    """The boxes the non-design parts of a sample fill, one for each."""
    found = []
    for part in next(
        o for o in meshes(doc) if o.Label == "non_design"
    ).Mesh.getSeparateComponents():
        b = part.BoundBox
        box = doc.addObject("Part::Box", "Keep")
        box.Length, box.Width, box.Height = b.XLength, b.YLength, b.ZLength
        box.Placement.Base = App.Vector(b.XMin, b.YMin, b.ZMin)
        found.append(box)
    doc.recompute()
    return found


def by_picked_faces(doc: Any) -> tuple[Source, NonDesign]:
    keep = boxes(doc)
    mesh = whole(doc)
    triangles = triangles_of(mesh)
    regions = FlatRegions(triangles)
    picked: set[int] = set()
    for box in keep:
        of_box: set[int] = set()
        for i, place in enumerate(clicks_on(box)):
            # The two largest sides first; the small ones may be flush with a strut.
            of_box |= regions.around(triangles.facet_at(place), of_box if i > 1 else None)
        picked |= of_box
    return Source([mesh]), NonDesign(FACES, {mesh.Name: sorted(picked)})


def clicks_on(box: Any) -> list[tuple[float, float, float]]:
    """A place near the edge of each side of a box: struts leave from the middle or the corner."""
    places = []
    for face in sorted(box.Shape.Faces, key=lambda f: -f.Area):
        u0, u1, v0, v1 = face.ParameterRange
        point = face.valueAt(u0 + 0.23 * (u1 - u0), v0 + 0.31 * (v1 - v0))
        places.append((point.x, point.y, point.z))
    return places


def by_regions(doc: Any) -> tuple[Source, NonDesign]:
    return Source([keep_whole(doc)]), NonDesign(REGIONS, objects=_kept)


_kept: list[Any] = []


def keep_whole(doc: Any) -> Any:
    """As ``whole``, after the boxes of its non-design parts have been set up in ``_kept``."""
    _kept[:] = boxes(doc)
    return whole(doc)


def by_open_meshes(doc: Any) -> tuple[Source, NonDesign]:
    design, non_design = meshes(doc)
    return Source([design]), NonDesign(REGIONS, objects=[non_design])


def by_fem(doc: Any) -> tuple[Source, NonDesign]:
    keep = boxes(doc)
    fixed = ObjectsFem.makeConstraintFixed(doc)
    fixed.References = [(b, f"Face{i + 1}") for b in keep for i in range(6)]
    return Source([whole(doc)]), NonDesign(FEM)


def a_fem_mesh_is_taken_by_its_surface() -> None:
    doc = document()
    fem = doc.addObject("Fem::FemMeshObject", "Voxels")
    fem.FemMesh = bar_of_hexahedra(4, 24)
    surface = triangles_of(fem)
    equal(surface.is_closed(), True, "the surface is closed")
    equal(len(surface.facets), 2 * (2 * 4 * 4 + 4 * 4 * 24), "triangles of the surface")
    group = reconstruct(doc, Source([fem])).group
    check_group(group)


def bar_of_hexahedra(wide: int, long: int) -> Any:
    """A square bar along x, 1 mm to the edge of an element."""
    mesh = Fem.FemMesh()
    number = {}
    for x in range(long + 1):
        for y in range(wide + 1):
            for z in range(wide + 1):
                number[x, y, z] = mesh.addNode(float(x), float(y), float(z))
    corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
    for x in range(long):
        for y in range(wide):
            for z in range(wide):
                nodes = [number[x + i, y + j, z + k + up] for up in (0, 1) for i, j, k in corners]
                mesh.addVolume(nodes)
    return mesh


# -- what is said when it fails --------------------------------------------------------------------


def a_refusal_leaves_the_document_alone() -> None:
    doc = document("y_form.obj")
    before = names(doc)
    source = Source(meshes(doc))
    breach = stand_in("breach", 'echo "error: a point is outside at (1, 2, 3) mm" >&2; exit 3\n')
    cases = (
        (lambda: reconstruct(doc, source, program="/nowhere/beamwright"), "cannot start"),
        (lambda: reconstruct(doc, source, program="/bin/true"), "is not beamwright"),
        (lambda: reconstruct(doc, Source([])), "nothing to work on"),
        (lambda: reconstruct(doc, Source(file="/nowhere.stl")), "there is no file"),
        (lambda: reconstruct(doc, Source([open_mesh(doc)])), "hole"),
        (lambda: reconstruct(doc, source, program=breach), "a point is outside"),
        (lambda: reconstruct(doc, source, NonDesign(FEM)), "no FEM constraint"),
        (lambda: reconstruct(doc, source, NonDesign(FACES)), "no face is picked"),
        (lambda: reconstruct(doc, source, NonDesign(REGIONS)), "no region is chosen"),
    )
    for what, expected in cases:
        message = refused(what, ProgramError, InputError)
        say(f"       {message}")
        equal(expected in message, True, f"{expected!r} in {message!r}")
        if doc.getObject("Open"):
            doc.removeObject("Open")
        equal(names(doc), before, f"objects after: {message}")
    equal(temporary_folders(), set(), "folders left behind")


def open_mesh(doc: Any) -> Any:
    """A sample with a part of its surface missing."""
    mesh = Mesh.Mesh(str(SAMPLES / "single_bar.obj"))
    mesh.removeFacets(list(range(0, mesh.CountFacets // 3)))
    feature = doc.addObject("Mesh::Feature", "Open")
    feature.Mesh = mesh
    return feature


def a_result_that_cannot_be_read_is_not_taken_in() -> None:
    doc = document("y_form.obj")
    before = names(doc)
    spoiled = stand_in(
        "spoiled", '"$REAL" "$@" || exit $?\nfor f in "$6"; do echo x > "$f"; done\n'
    )
    message = refused(lambda: reconstruct(doc, Source(meshes(doc)), program=spoiled), ResultError)
    equal("cut list" in message, True, message)
    equal(names(doc), before, "objects")


def a_missing_program_is_named_with_what_was_searched() -> None:
    doc = document("y_form.obj")
    kept = {k: os.environ.pop(k) for k in ("BEAMWRIGHT", "PATH")}
    os.environ["PATH"] = "/nowhere"
    try:
        message = refused(lambda: reconstruct(doc, Source(meshes(doc))), ProgramError)
    finally:
        os.environ.update(kept)
    equal("$BEAMWRIGHT" in message and "PATH" in message, True, message)


# -- the macro file --------------------------------------------------------------------------------


def the_macro_file_runs_without_a_window() -> None:
    saved = ARTEFACTS / "macro.FCStd"
    environment = {
        **os.environ,
        "BEAMWRIGHT_MESH": str(SAMPLES / "cantilever.obj"),
        "BEAMWRIGHT_SAVE": str(saved),
    }
    alone = timed(
        [
            PROGRAM,
            "reconstruct",
            environment["BEAMWRIGHT_MESH"],
            "-q",
            "-o",
            str(ARTEFACTS / "alone.step"),
            "--report",
            str(ARTEFACTS / "alone.html"),
            "--sections",
            str(ARTEFACTS / "alone.sections.json"),
            "--export",
            str(ARTEFACTS / "alone.mlp"),
        ],
        environment,
    )
    whole_run = timed(["freecadcmd", str(MACRO / "Beamwright.FCMacro")], environment)
    doc = App.openDocument(str(saved))
    group = next(o for o in doc.Objects if "BeamwrightSource" in o.PropertiesList)
    check_group(group)
    say(f"       the program {alone:.2f} s, FreeCAD with the macro {whole_run:.2f} s")
    equal(whole_run - alone < BEYOND, True, f"{whole_run - alone:.1f} s beyond the program's time")


#: Seconds a run in FreeCAD may take beyond the program's own.  On a free machine 5 are plenty; most
#: of it is OCCT reading the STEP file, which takes its time on a machine busy with other things.
BEYOND = 20.0


def timed(command: list[str], environment: dict[str, str]) -> float:
    """Seconds a command takes; fails unless it ends with 0."""
    begin = time.monotonic()
    done = subprocess.run(command, env=environment, capture_output=True, timeout=120, check=False)
    equal(done.returncode, 0, f"exit code of {command[0]}: {done.stderr.decode()[-500:]}")
    return time.monotonic() - begin


def the_macro_file_ends_with_1_when_it_fails() -> None:
    environment = {**os.environ, "BEAMWRIGHT_MESH": "", "BEAMWRIGHT_SAVE": ""}
    done = subprocess.run(
        ["freecadcmd", str(MACRO / "Beamwright.FCMacro")],
        env=environment,
        capture_output=True,
        timeout=120,
        check=False,
    )
    equal(done.returncode, 1, "exit code")
    equal(b"nothing to work on" in done.stderr + done.stdout, True, "message")


def the_addon_manager_can_read_what_it_lists() -> None:
    package = App.Metadata(str(MACRO / "package.xml"))
    (macro,) = package.Content["macro"]
    equal((package.Name, macro.Name), ("Beamwright", "Beamwright"), "names")
    files = [*macro.File, macro.Icon]
    equal([p for p in files if not (MACRO / p).is_file()], [], "missing files")
    text = (MACRO / "Beamwright.FCMacro").read_text()
    found = dict(re.findall(r'(?m)^__(\w+)__ = "(.*)"$', text))
    for name in ("Name", "Comment", "Author", "Date", "Version", "License", "Icon", "Files"):
        equal(bool(found.get(name)), True, f"__{name}__ on one line")
    equal(found["Version"], package.Version, "version")


def every_module_of_the_macro_is_listed_for_the_addon_manager() -> None:
    text = (MACRO / "Beamwright.FCMacro").read_text()
    line = next(x for x in text.splitlines() if x.startswith("__Files__"))
    listed = sorted(line.split('"')[1].split(","))
    there = sorted(p.name for p in MACRO.iterdir() if p.suffix in (".py", ".svg"))
    equal(listed, there, "__Files__")


main(
    every_beam_arrives_named_as_in_the_cut_list_and_survives_saving,
    every_kind_of_joint_arrives_as_valid_solids,
    beams_stand_where_the_program_put_them,
    one_undo_brings_back_what_was_there,
    a_second_run_replaces_the_first,
    the_skeleton_is_coloured_by_how_well_it_is_centred,
    a_fused_solid_is_sound_or_is_not_there,
    hostile_names_stay_text,
    every_way_to_say_non_design_finds_the_same_sets,
    a_fem_mesh_is_taken_by_its_surface,
    a_refusal_leaves_the_document_alone,
    a_result_that_cannot_be_read_is_not_taken_in,
    a_missing_program_is_named_with_what_was_searched,
    the_macro_file_runs_without_a_window,
    the_macro_file_ends_with_1_when_it_fails,
    the_addon_manager_can_read_what_it_lists,
    every_module_of_the_macro_is_listed_for_the_addon_manager,
)
