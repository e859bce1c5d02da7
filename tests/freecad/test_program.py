"""Where the program is, what it can do, and the command line of a run."""

from __future__ import annotations

from pathlib import Path

import pytest
from beamwright_command import Options, Outputs, command_line
from beamwright_program import (
    Program,
    ProgramError,
    find_program,
    input_formats,
    parse_help,
    probe,
    refusal_of_input,
)

HELP = """\
Usage: beamwright reconstruct [OPTIONS] --output <OUT.step> <IN>

Input:
      --unit <mm|cm|m|in>
          Unit of length in the file (default: mm; glTF: m)

  <IN>
          Mesh file: .off .obj .STL

Beams:
      --max-deviation <RADII>
          Farthest a branch may bend away from one straight beam, in section radii

          [default: 0.5]

      --loft <HOW>
          How the shape runs along a beam

          Possible values:
          - constant: The mean section all along
          - taper:    Straight from end section to end section

          [default: constant]

  -o, --output <OUT.step>
          STEP file with one named solid a beam

      --progress <HOW>
          How progress is shown [possible values: auto, json]

      --json
          Print the result as JSON
"""


def program(*flags: str) -> Program:
    return Program("beamwright", (0, 1, 0), frozenset(flags), formats=(".off", ".obj"))


def executable(folder: Path, name: str, says: str = "") -> str:
    path = folder / name
    path.write_text(f"#!/bin/sh\necho '{says}'\n")
    path.chmod(0o755)
    return str(path)


def test_the_preference_comes_before_the_environment_and_that_before_the_path(
    tmp_path: Path,
) -> None:
    first, second = executable(tmp_path, "first"), executable(tmp_path, "second")
    environment = {"BEAMWRIGHT": second}
    assert find_program(first, environment, lambda _: "third") == first
    assert find_program("", environment, lambda _: "third") == second
    assert find_program("", {}, lambda _: "third") == "third"
    assert find_program("", {}, lambda _: None) is None


def test_a_preference_that_is_gone_is_passed_over(tmp_path: Path) -> None:
    assert find_program(str(tmp_path / "gone"), {}, lambda _: "on path") == "on path"


def test_flags_choices_and_defaults_are_read_from_the_help() -> None:
    flags, choices, defaults = parse_help(HELP)
    assert {"--unit", "--loft", "--output", "--json", "--progress"} <= flags
    assert choices["--loft"] == ("constant", "taper")
    assert choices["--progress"] == ("auto", "json")
    assert choices["--unit"] == ("mm", "cm", "m", "in")
    assert defaults == {"--max-deviation": "0.5", "--loft": "constant"}
    assert input_formats(HELP) == (".off", ".obj", ".stl")


@pytest.mark.parametrize(
    ("says", "complaint"),
    [
        ("true (GNU coreutils) 9.1", "is not beamwright"),
        ("beamwright 0.0.9", "needs 0.1.0 or newer"),
        ("beamwright 0.1.0", "reports no progress"),
    ],
)
def test_what_is_no_fitting_beamwright_is_refused(
    tmp_path: Path, says: str, complaint: str
) -> None:
    with pytest.raises(ProgramError, match=complaint):
        probe(executable(tmp_path, "some", says))


def test_a_program_that_is_not_there_is_refused() -> None:
    with pytest.raises(ProgramError, match="cannot start /nowhere"):
        probe("/nowhere")


def test_a_volume_result_of_beso_is_refused_with_what_to_export() -> None:
    assert refusal_of_input(program(), "part.OBJ") is None
    assert "on the FEM mesh of the last state" in (
        refusal_of_input(program(), "file01_state1.frd") or ""
    )
    assert "it reads .off .obj" in (refusal_of_input(program(), "part.3mf") or "")


def test_only_flags_the_program_knows_are_given_to_it() -> None:
    outputs = Outputs("/out", "part")
    options = Options(profile="round", joints="mitre", density=2700.0, strict=True)
    knows = program("--profile", "--density", "--strict", "--sections")
    arguments, left_out = command_line(knows, "part.ply", outputs, options, ["pad.ply"])
    assert arguments[:4] == ["reconstruct", "part.ply", "-o", "/out/part.step"]
    assert arguments[arguments.index("--density") + 1] == "2700"
    assert arguments[arguments.index("--non-design") + 1] == "pad.ply"
    assert arguments[arguments.index("--sections") + 1] == "/out/part.sections.json"
    assert "--strict" in arguments
    assert "--joints" not in arguments
    assert left_out == ["--joints"]
