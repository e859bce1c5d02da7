"""What a run says, and the verdict on it."""

from __future__ import annotations

import json

import pytest
from beamwright_outcome import (
    CANCELLED,
    Progress,
    StderrReader,
    beam_in,
    findings_of,
    overall,
    place_in,
    verdict,
)


def reader(text: str = "") -> StderrReader:
    made = StderrReader()
    made.feed(text.encode())
    made.close()
    return made


def test_progress_and_log_lines_are_told_apart_in_pieces_of_any_size() -> None:
    text = b'{"stage":"skeleton","done":1,"total":2}\nmarching\nerror: no\n'
    whole = StderrReader()
    expected = whole.feed(text)
    pieces = StderrReader()
    events = [e for i in range(len(text)) for e in pieces.feed(text[i : i + 1])]
    assert events == expected
    assert isinstance(events[0], Progress)
    assert events[1:] == ["marching", "error: no"]
    assert pieces.error == "no"


def test_progress_never_goes_back() -> None:
    made = StderrReader()
    made.feed(b'{"stage":"frame","done":1,"total":1}\n')
    high = made.fraction
    made.feed(b'{"stage":"read","done":0,"total":1}\n')
    assert made.fraction == high == pytest.approx(0.95)


def test_a_stage_without_a_total_counts_as_begun() -> None:
    assert overall("skeleton", 5, 0) == overall("skeleton", 0, 10)
    assert overall("unheard of", 1, 2) == 0.0


def test_a_run_that_went_well_has_no_message() -> None:
    good = verdict(0, b'{"frame": {"beams": 3}}', reader())
    assert good.ok
    assert good.beams == 3


def test_a_run_without_a_summary_did_not_go_well() -> None:
    assert not verdict(0, b"", reader()).ok
    assert not verdict(0, b"[1]", reader()).ok


def test_an_error_is_told_in_the_words_of_the_program_with_its_place() -> None:
    bad = verdict(1, b"", reader("error: the surface is open at (1.5, -2, 3e1) mm\n"))
    assert bad.message == "the surface is open at (1.5, -2, 3e1) mm"
    assert bad.findings[0].place == (1.5, -2.0, 30.0)


def test_a_breach_without_an_error_line_is_told_by_its_findings() -> None:
    summary = {
        "findings": [
            {"kind": "note", "text": "merged"},
            {"kind": "outside", "text": "a point is outside", "breach": True, "place": [1, 2, 3]},
        ]
    }
    broken = verdict(3, json.dumps(summary).encode(), reader())
    assert broken.message == "a point is outside"
    assert [f.breach for f in findings_of(summary)] == [True, False]


def test_a_crash_is_told_with_the_last_thing_said() -> None:
    assert verdict(-11, b"", reader("half way\n")).message.endswith("code -11: half way")
    assert verdict(-11, b"", reader()).message.endswith("it said nothing")


def test_cancelling_is_no_failure_of_the_program() -> None:
    assert verdict(-9, b"", reader("error: killed\n"), cancelled=True).message == CANCELLED


def test_places_and_beams_are_found_in_messages() -> None:
    assert place_in("nothing here (see page 2)") is None
    assert beam_in("beam 3 leaves the material") == 2
    assert beam_in("B012 is short") == 11
    assert beam_in("no such thing") is None
