"""What FreeCAD is started with: finds tests and macro, and runs the script that is asked for.

FreeCAD's window would stay open for ever after an error at import.
"""

from __future__ import annotations

import importlib
import os
import sys
import traceback
from pathlib import Path

ROOT = Path(os.environ["BEAMWRIGHT_ROOT"])
sys.path[:0] = [str(ROOT / "tests" / "freecad"), str(ROOT / "freecad_macro")]

try:
    importlib.import_module(os.environ["BEAMWRIGHT_SCRIPT"])
except BaseException:
    traceback.print_exc()
    sys.stderr.flush()
    os._exit(1)
