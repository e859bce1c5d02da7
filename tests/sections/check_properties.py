"""Compares section properties with the PyPI package `sectionproperties`.

    python tests/sections/check_properties.py [SECTIONS.json]

Without a file, the sections are computed first (`cargo test --test section_json`). Needs
`pip install -r tests/sections/requirements.txt`. Prints one line for each section and exits with 1
if one is off.

Area and second moments are exact on both sides. The torsion constant is compared with a finite
element solution of quadratic triangles, 500 to a section; formulas of standards for rolled and
hollow shapes are approximations and only have to be near.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any, Dict

from sectionproperties.analysis import Section
from sectionproperties.pre import Geometry
from shapely.geometry import Polygon

#: One section of the file: its contours and what the program found.
Item = Dict[str, Any]

EXACT = 1e-6
TORSION = 0.005
FORMULA = 0.05
TRIANGLES = 500


def reference(item: Item) -> dict[str, float]:
    """Properties of one section by sectionproperties."""
    polygon = Polygon(item["outer"], item["holes"])
    geometry = Geometry(polygon)
    geometry.create_mesh(mesh_sizes=[polygon.area / TRIANGLES])
    section = Section(geometry)
    section.calculate_geometric_properties()
    section.calculate_warping_properties()
    i_xx, i_yy, _ = section.get_ic()
    i_1, i_2 = section.get_ip()
    return {
        "area": section.get_area(),
        "i_xx": i_xx,
        "i_yy": i_yy,
        "i_1": i_1,
        "i_2": i_2,
        "j": section.get_j(),
    }


def faults(item: Item, exact: dict[str, float]) -> list[str]:
    """What is off by more than it may be."""
    found = []
    for key, value in exact.items():
        tolerance = TORSION if key == "j" else EXACT
        off = item[key] / value - 1
        if abs(off) > tolerance:
            found.append(f"{key} off by {100 * off:.3f} %")
    formula = item["j_of_formula"]
    if formula is not None and abs(formula / exact["j"] - 1) > FORMULA:
        found.append(f"formula of J off by {100 * (formula / exact['j'] - 1):.2f} %")
    return found


def sections(path: str | None) -> list[Item]:
    """The sections of a file, or those just computed."""
    if path:
        return read(Path(path))
    with tempfile.TemporaryDirectory() as folder:
        target = Path(folder) / "sections.json"
        environment = {**os.environ, "BEAMWRIGHT_SECTION_JSON": str(target)}
        root = Path(__file__).resolve().parents[2]
        command = ["cargo", "test", "--quiet", "--test", "section_json"]
        subprocess.run(command, cwd=root, env=environment, check=True)
        return read(target)


def read(path: Path) -> list[Item]:
    """The sections of a file."""
    items: list[Item] = json.loads(path.read_text())
    return items


def main() -> int:
    failed = 0
    items = sections(sys.argv[1] if len(sys.argv) > 1 else None)
    for item in items:
        exact = reference(item)
        found = faults(item, exact)
        failed += bool(found)
        formula = item["j_of_formula"]
        of_formula = (
            "" if formula is None else f", formula {100 * (formula / exact['j'] - 1):+.2f} %"
        )
        off = 100 * (item["j"] / exact["j"] - 1)
        print(f"{item['name']:<16} J {off:+.3f} %{of_formula}  {'; '.join(found) or 'ok'}")
    print(f"{len(items) - failed} passed, {failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
