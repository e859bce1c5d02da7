"""The macro's modules that need no FreeCAD, for pytest."""

from __future__ import annotations

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "freecad_macro"))

#: These run inside FreeCAD, started by run.py.
collect_ignore = ["headless.py", "gui.py", "inside.py", "scene.py", "run.py"]
