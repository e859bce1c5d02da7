# SPDX-License-Identifier: MIT OR Apache-2.0
"""Opens a project in MeshLab's window and looks at it.

Runs under a display of 1400 × 900 (``xvfb-run``), with the program in ``$BEAMWRIGHT``.  The
pictures go to ``$BEAMWRIGHT_PICTURES``, or nowhere.
"""

from __future__ import annotations

import os
import subprocess
import tempfile
import time
import unittest
from importlib import import_module
from pathlib import Path
from typing import Any, Callable

np = import_module("numpy")

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = os.environ["BEAMWRIGHT"]
PICTURES = os.environ.get("BEAMWRIGHT_PICTURES")

#: Seconds MeshLab has for starting, opening and drawing.
PATIENCE = 60.0

#: Red, green, blue of every pixel, 0–255.
Picture = Any


def wait_for(what: str, happened: Callable[[], bool]) -> None:
    """Waits until something has happened; fails when it does not."""
    end = time.monotonic() + PATIENCE
    while not happened():
        if time.monotonic() > end:
            raise AssertionError(f"MeshLab: {what} did not happen")
        time.sleep(0.1)


def xdotool(*words: object) -> str:
    """Moves mouse and windows."""
    done = subprocess.run(
        ["xdotool", *map(str, words)], capture_output=True, text=True, check=False
    )
    return done.stdout


class MeshLab:
    """A running MeshLab with a project; ends with the ``with`` block."""

    def __init__(self, project: Path, layers: int) -> None:
        self.log = project.with_suffix(".log")
        with self.log.open("wb") as log:
            self.process = subprocess.Popen(["meshlab", str(project)], stdout=log, stderr=log)
        self.layers = layers

    def __enter__(self) -> MeshLab:
        wait_for("opening", self.has_opened)
        return self

    def __exit__(self, *_: object) -> None:
        self.process.kill()
        self.process.wait()

    def has_opened(self) -> bool:
        """Whether all layers are in."""
        self.is_alive()
        return self.log.read_text(errors="replace").count("Opened mesh") == self.layers

    def is_alive(self) -> None:
        """Fails if MeshLab is gone."""
        if self.process.poll() is not None:
            raise AssertionError(f"MeshLab ended: {self.log.read_text(errors='replace')}")

    def fills_the_screen(self) -> bool:
        """Asks the window to grow; whether it has. One that is just coming up does not listen."""
        self.is_alive()
        # The name matches helper windows as well: the last one is the one with the title.
        windows = xdotool("search", "--onlyvisible", "--name", "MeshLab").split()
        for window in windows[-1:]:
            xdotool("windowmove", window, 0, 0, "windowsize", window, 1400, 900)
        time.sleep(0.3)
        # The corner is black until the window reaches it.
        return bool(shot()[40, 1390].any())

    def turn(self) -> None:
        """Turns the view, so that nothing is seen end on."""
        wait_for("growing", self.fills_the_screen)
        wait_for("drawing", lambda: coloured(shot()) > 1000)
        xdotool("mousemove", 500, 450, "mousedown", 1)
        for _ in range(12):
            xdotool("mousemove_relative", "--", -12, 9)
            time.sleep(0.03)
        xdotool("mouseup", 1)

    def look(self, name: str) -> Picture:
        """The picture once there are beams in it and it no longer changes."""
        last = shot()
        wait_for("a still picture", lambda: is_still(last) and coloured(last) > 1000)
        self.is_alive()
        if PICTURES:
            folder = Path(PICTURES)
            folder.mkdir(parents=True, exist_ok=True)
            subprocess.run(["import", "-window", "root", str(folder / f"{name}.png")], check=True)
        return shot()


def is_still(last: Picture) -> bool:
    """Whether two looks are alike; the later one is kept in ``last``."""
    time.sleep(0.5)
    now = shot()
    # The frame rate is written into the view.
    alike = (now != last).any(axis=2).mean() < 0.001
    last[:] = now
    return bool(alike)


def shot() -> Picture:
    """The screen."""
    done = subprocess.run(
        ["import", "-window", "root", "-depth", "8", "ppm:-"], capture_output=True, check=True
    )
    head, rest = done.stdout.split(b"\n255\n", 1)
    width, height = map(int, head.split()[1:3])
    return np.frombuffer(rest, dtype=np.uint8).reshape(height, width, 3).copy()


def view(picture: Picture) -> Picture:
    """The part with the 3D view, above the strip of numbers."""
    return picture[80:740, 5:960].astype(int)


def red(picture: Picture) -> int:
    """Pixels of non-design faces, lit from bright to dark."""
    r, g, b = (view(picture)[..., i] for i in range(3))
    return int(((r > 100) & (g < r // 4) & (b < r // 4)).sum())


def grey(picture: Picture) -> int:
    """Pixels of design faces."""
    pixels = view(picture)
    spread = pixels.max(axis=2) - pixels.min(axis=2)
    return int(((spread < 12) & (pixels.min(axis=2) > 90)).sum())


def coloured(picture: Picture) -> int:
    """Pixels of beams, in whatever colours their profiles have.

    Left out are the red of non-design faces and the blue of the ground, as much red as green.
    """
    pixels = view(picture)
    r, g, b = (pixels[..., i] for i in range(3))
    strong = pixels.max(axis=2) - pixels.min(axis=2) > 60
    is_red = (g < r // 4) & (b < r // 4)
    is_ground = (abs(r - g) < 25) & (b > r)
    return int((strong & ~is_red & ~is_ground).sum())


class Window(unittest.TestCase):
    """The layers of a project as a user sees them."""

    def test_the_project_opens_with_its_layers(self) -> None:
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            project = self.project(folder)
            with MeshLab(project, layers=4) as meshlab:
                meshlab.turn()
                both = meshlab.look("mesh_and_beams")
            hidden = folder / "beams_only.mlp"
            hidden.write_text(project.read_text().replace('visible="1"', 'visible="0"', 1))
            with MeshLab(hidden, layers=4) as meshlab:
                meshlab.turn()
                beams = meshlab.look("beams")
        self.assertGreater(red(both), 5000, "non-design faces are red")
        self.assertGreater(grey(both), 5000, "design faces are grey")
        self.assertGreater(coloured(both), 5000, "beams lie on the mesh")
        more = "beams come out when the mesh is hidden"
        self.assertGreater(coloured(beams), coloured(both), more)
        self.assertLess(grey(beams), grey(both) // 10, "a layer can be hidden")
        self.assertLess(red(beams), red(both) // 10, "a layer can be hidden")

    def project(self, folder: Path) -> Path:
        """The project of a sample."""
        project = folder / "four_fixings.mlp"
        command = [PROGRAM, "reconstruct", str(ROOT / "samples/four_fixings.obj")]
        out = ["-o", str(folder / "out.step"), "--export", str(project)]
        subprocess.run([*command, *out], check=True, capture_output=True)
        return project


if __name__ == "__main__":
    unittest.main(verbosity=2)
