"""A proof that takes long says how far it is; one that does not says nothing."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from mechsheet.recording.record import record
from mechsheet.run import progress
from mechsheet.run.proving import proof_of
from mechsheet.worksheet.cells import load

JOINT = Path(__file__).parents[1] / "worksheets" / "joint.py"


@pytest.mark.parametrize("long", [0.0, 1e9])
def test_a_long_proof_has_a_bar_on_the_terminal(
    long: float, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(progress, "_LONG", long)
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True)
    sheet = load(JOINT)
    names = sheet.run(sheet.results, {"g": sheet.inputs()})
    recording, seen = record(names, sheet, exact=True), list[tuple[int, int]]()
    proof_of(names, sheet, recording)
    shown = capsys.readouterr().err
    assert ("proof" in shown) == (long == 0.0)
    if not long:
        *bars, gone = shown.rstrip("\r").split("\r")
        assert "] 1 of " in "".join(bars) and not gone.strip()
    proof_of(names, sheet, recording, done=lambda behind, count: seen.append((behind, count)))
    assert [behind for behind, _ in seen] == list(range(1, seen[-1][1] + 1)) and not capsys.readouterr().err
