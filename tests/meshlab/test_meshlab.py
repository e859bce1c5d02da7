# SPDX-License-Identifier: MIT OR Apache-2.0
"""The MeshLab bridge in PyMeshLab and in ``meshlabserver``; reads as the tutorial of both.

Needs pymeshlab, and the program in ``$BEAMWRIGHT``.  What MeshLab 2020.09 is needed for is left
out where there is none, unless ``CI=true``.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from collections import Counter
from importlib import import_module
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[2]
FILTER = ROOT / "meshlab_filter"
SAMPLES = ROOT / "samples"
sys.path.insert(0, str(FILTER))

import beamwright_cleanup as cleanup  # noqa: E402

#: Where a selected face lies, and everything else about meshes.
pymeshlab = import_module("pymeshlab")

PROGRAM = os.environ["BEAMWRIGHT"]
WITH_SERVER = bool(shutil.which("meshlabserver")) or os.environ.get("CI") == "true"


def load(path: Path) -> Any:
    """A mesh or a project in PyMeshLab, which is kept from moving and printing."""
    meshes = pymeshlab.MeshSet()
    with cleanup.undisturbed():
        if path.suffix == ".mlp":
            meshes.load_project(str(path))
        else:
            meshes.load_new_mesh(str(path))
    return meshes


class InFolder(unittest.TestCase):
    """Tests with a folder of their own."""

    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def drive(self, *words: object) -> subprocess.CompletedProcess[str]:
        """Runs the driver as a user does."""
        command = [sys.executable, str(FILTER / "beamwright_meshlab.py"), *map(str, words)]
        return subprocess.run(
            command, cwd=self.folder, capture_output=True, text=True, check=False, timeout=300
        )

    def succeed(self, *words: object) -> str:
        """Runs the driver; returns what it printed on standard output."""
        done = self.drive(*words)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def selected(self, name: str) -> Path:
        """A sample whose non-design faces were selected in MeshLab, saved with face flags."""
        labelled = self.folder / f"{name}.labelled.ply"
        mesh = cleanup.read_obj(str(SAMPLES / f"{name}.obj"))
        cleanup.write_flags(str(labelled), mesh)
        saved = self.folder / f"{name}.ply"
        load(labelled).save_current_mesh(str(saved), save_face_flag=True)
        return saved


class Loop(InFolder):
    """Select faces, save, run one line, open the project."""

    def test_a_face_selected_in_meshlab_is_non_design(self) -> None:
        # A bar without labels: a user selects the faces of its two ends.
        plain = self.folder / "plain.ply"
        meshes = load(SAMPLES / "single_bar.obj")
        box = meshes.current_mesh().bounding_box()
        low, high = box.min()[0], box.max()[0]
        pads = f"(x0 < {low + 10.5}) || (x0 > {high - 10.5})"
        meshes.compute_selection_by_condition_per_face(condselect=pads)
        meshes.save_current_mesh(str(plain), save_face_flag=True)

        summary = json.loads(self.succeed(plain, "-o", "bar.mlp", "--", "--json"))
        self.assertEqual(summary["labels"]["source"], "selection flags")
        self.assertEqual(summary["labels"]["sets"], 2)
        self.assertEqual(len(summary["labels"]["interfaces"]), 2)

    def test_the_project_has_mesh_skeleton_and_beams(self) -> None:
        for name in ("cantilever", "four_fixings", "y_form"):
            with self.subTest(name):
                project = self.folder / f"{name}.mlp"
                text = self.succeed(self.selected(name), "-o", project, "--", "--json")
                self.layers_are_whole(project, json.loads(text))

    def layers_are_whole(self, project: Path, summary: dict[str, Any]) -> None:
        """The layers hold what the summary counts."""
        meshes = load(project)
        layers = {mesh.label(): mesh for mesh in meshes}
        self.assertEqual(list(layers), ["mesh", "skeleton", "off-centre", "beams"])
        mesh, skeleton, centre, beams = layers.values()
        self.assertEqual([m.is_visible() for m in layers.values()], [True, True, False, True])

        self.assertEqual(mesh.selected_face_number(), summary["labels"]["non_design_faces"])
        self.assertEqual(mesh.face_number(), summary["mesh"]["triangles"])

        lines = json.loads(project.with_suffix(".skeleton.json").read_text())
        segments = sum(len(branch["points"]) - 1 for branch in lines["branches"])
        self.assertEqual(skeleton.edge_number(), segments)
        radii = sorted(point["radius"] for point in lines["points"])
        for found, radius in zip(sorted(skeleton.vertex_scalar_array()), radii):
            self.assertAlmostEqual(found, radius, delta=1e-6 * radius)
        self.assertEqual(centre.edge_number(), segments)
        self.assertTrue(0.0 < max(centre.vertex_scalar_array()) < 1.0)
        self.assertEqual(min(centre.vertex_scalar_array()), 0.0)

        counted = Counter(int(n) for n in beams.face_scalar_array())
        named = {row["mark"] for row in summary["frame"]["table"]}
        self.assertEqual({f"B{n:03}" for n in counted}, named)

    def test_the_clean_up_changes_nothing_on_a_sound_mesh(self) -> None:
        source = self.selected("y_form")
        self.succeed(source, "-o", "cleaned.mlp")
        self.succeed(source, "-o", "as_is.mlp", "--engine", "none")
        topology = [self.topology(name) for name in ("cleaned", "as_is")]
        self.assertEqual(*topology)

    def topology(self, name: str) -> list[int]:
        """The points of each branch."""
        lines = json.loads((self.folder / f"{name}.skeleton.json").read_text())
        return sorted(len(branch["points"]) for branch in lines["branches"])

    @unittest.skipUnless(WITH_SERVER, "no meshlabserver")
    def test_meshlabserver_does_as_well(self) -> None:
        source = self.selected("y_form")
        self.succeed(source, "-o", "new.mlp", "--engine", "pymeshlab")
        self.succeed(source, "-o", "old.mlp", "--engine", "meshlabserver")
        self.assertEqual(self.topology("new"), self.topology("old"))

    def test_group_names_of_obj_outlive_the_clean_up(self) -> None:
        text = self.succeed(SAMPLES / "four_fixings.obj", "-o", "four.mlp", "--", "--json")
        labels = json.loads(text)["labels"]
        self.assertEqual((labels["source"], labels["sets"]), ("selection flags", 5))

    def test_names_of_ones_own_are_heard(self) -> None:
        renamed = self.folder / "renamed.obj"
        text = (SAMPLES / "single_bar.obj").read_text()
        renamed.write_text(text.replace("g non_design", "g Pad-left"))
        options = ("--json", "--non-design-name", "pad*")
        summary = json.loads(self.succeed(renamed, "-o", "out.mlp", "--", *options))
        self.assertEqual(summary["labels"]["sets"], 2)


class CleanUp(InFolder):
    """``beamwright_prepare.mlx`` and the script of the driver on a mesh with faults."""

    def damaged(self) -> Path:
        """A labelled bar with a hole in its shaft, repeated faces, loose corners and a crumb."""
        mesh = cleanup.read_obj(str(SAMPLES / "single_bar.obj"))
        shaft = [i for i, label in enumerate(mesh.non_design) if not label]
        repeated = shaft[len(shaft) // 3]
        mesh.polygons.append(mesh.polygons[repeated])
        mesh.non_design.append(False)
        hole = shaft[len(shaft) // 2]
        del mesh.polygons[hole], mesh.non_design[hole]
        for i in shaft[:40]:
            first = len(mesh.points)
            mesh.points += [mesh.points[corner] for corner in mesh.polygons[i]]
            mesh.polygons[i] = [first, first + 1, first + 2]
        first = len(mesh.points)
        mesh.points += ["0 90 0", "1 90 0", "0 91 0", "0 90 1"]
        crumb = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]
        mesh.polygons += [[first + corner for corner in face] for face in crumb]
        mesh.non_design += [False] * 4
        path = self.folder / "damaged.ply"
        cleanup.write_flags(str(path), mesh)
        return path

    def is_mended(self, path: Path) -> None:
        """One closed body, its labels kept."""
        done = subprocess.run(
            [PROGRAM, "inspect", str(path), "--json"], capture_output=True, text=True, check=True
        )
        summary = json.loads(done.stdout)
        kinds = [finding["kind"] for finding in summary["findings"]]
        self.assertNotIn("mesh_mended", kinds)
        self.assertEqual(summary["labels"]["sets"], 2)
        self.assertEqual(len(summary["labels"]["interfaces"]), 2)
        topology = load(path).get_topological_measures()
        self.assertEqual(topology["connected_components_number"], 1)
        self.assertEqual(topology["boundary_edges"], 0)
        self.assertEqual(topology["genus"], 0)

    def test_the_file_is_what_the_driver_writes_for_any_size(self) -> None:
        script = (FILTER / "beamwright_prepare.mlx").read_text(encoding="utf-8")
        self.assertEqual(script, cleanup.prepare_script(None, cleanup.SMOOTH_STEPS))

    def test_the_file_mends_a_mesh_in_pymeshlab(self) -> None:
        meshes = load(self.damaged())
        with cleanup.undisturbed():
            meshes.load_filter_script(str(FILTER / "beamwright_prepare.mlx"))
            meshes.apply_filter_script()
        mended = self.folder / "mended.ply"
        meshes.save_current_mesh(str(mended), save_face_flag=True)
        self.is_mended(mended)

    @unittest.skipUnless(WITH_SERVER, "no meshlabserver")
    def test_the_file_mends_a_mesh_in_meshlabserver(self) -> None:
        mended = self.folder / "mended.ply"
        script = FILTER / "beamwright_prepare.mlx"
        words = ["-i", self.damaged(), "-o", mended, "-m", "ff", "-s", script]
        subprocess.run(
            ["xvfb-run", "-a", "meshlabserver", *map(str, words)],
            capture_output=True,
            check=True,
            timeout=120,
        )
        self.is_mended(mended)

    def test_both_engines_mend_a_mesh(self) -> None:
        damaged = str(self.damaged())
        for engine in ("pymeshlab", "meshlabserver") if WITH_SERVER else ("pymeshlab",):
            with self.subTest(engine):
                target = self.folder / f"{engine}.ply"
                cleanup.clean(engine, damaged, str(target), smooth=3)
                self.is_mended(target)

    def test_smoothing_leaves_selected_faces_where_they_are(self) -> None:
        source = self.selected("single_bar")
        target = self.folder / "smooth.ply"
        cleanup.clean("pymeshlab", str(source), str(target), smooth=5)
        meshes = [load(path) for path in (source, target)]
        before, after = (m.current_mesh() for m in meshes)
        for mesh in (before, after):
            mesh.compact()
        moved = abs(before.vertex_matrix() - after.vertex_matrix()).max(axis=1)
        pads = before.face_matrix()[before.face_selection_array()]
        shaft = before.face_matrix()[~before.face_selection_array()]
        inner = [v for v in set(pads.flatten()) if v not in set(shaft.flatten())]
        self.assertEqual(moved[inner].max(), 0.0)
        self.assertGreater(moved.max(), 0.0)


class Failures(InFolder):
    """One message, the exit code of the program, and no project."""

    def fails(self, code: int, message: str, *words: object) -> None:
        done = self.drive(*words)
        self.assertEqual(done.returncode, code, done.stderr)
        self.assertIn(message, done.stderr)
        self.assertNotIn("Traceback", done.stderr)
        self.assertFalse(list(self.folder.glob("out.mlp")))

    def test_wrong_usage_is_2(self) -> None:
        bar = SAMPLES / "single_bar.obj"
        self.fails(2, "must end in .mlp", bar, "-o", "out.step")
        self.fails(2, "there is no program", bar, "-o", "out.mlp", "--beamwright", "nowhere")
        self.fails(2, "--no-such-flag", bar, "-o", "out.mlp", "--", "--no-such-flag")

    def test_a_mesh_that_cannot_be_used_is_1(self) -> None:
        self.fails(1, "there is no file", "nothing.ply", "-o", "out.mlp")
        torn = self.folder / "torn.ply"
        torn.write_text("ply\nformat ascii 1.0\nelement vertex 3\nend_header\n")
        self.fails(1, "torn.ply", torn, "-o", "out.mlp")
        flat = self.folder / "flat.obj"
        flat.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        self.fails(1, "kept as", flat, "-o", "out.mlp")

    def test_a_bad_line_of_obj_is_told(self) -> None:
        bad = self.folder / "bad.obj"
        bad.write_text("v 0 0 0\nv 1 0 zero\n")
        self.fails(1, "bad.obj", bad, "-o", "out.mlp")

    def test_a_folder_that_is_not_there_is_told(self) -> None:
        self.fails(1, "folder", SAMPLES / "single_bar.obj", "-o", "nowhere/out.mlp")


if __name__ == "__main__":
    unittest.main(verbosity=2)
