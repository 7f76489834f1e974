"""Tables, figures and checks that a worksheet shows under no name are in its workbook like the others, or named there.

They stood there with the exported numbers, whatever the inputs were, and their checks passed.
"""

from io import BytesIO
from pathlib import Path
from typing import Any

import pytest
from openpyxl import load_workbook
from own_worksheet import own, recorded

from mechsheet.run import report
from mechsheet.worksheet import cells

FIELD = "from mechsheet import check, summary\nimport marimo as mo\nphi = linspace(0, 1, 11)  # [-] place\n"
FIELD += "y = phi * g.F  # [-] line\n"
TABLE = 'table("3", "Shown", phi, y)'
SHOWN = {
    "by typeset": (f'typeset({TABLE}, figure("7", "Curve", phi, y), check("ok", y.max(), 3.0))', ["3", "Fig 7"]),
    "alone": (TABLE, ["3"]),
    "some at once": (f'typeset({TABLE}, *[table(str(k), "More", phi, y) for k in (4, 5)])', ["3", "4", "5"]),
    "a generator": ('typeset(*(table(str(k), "More", phi, y) for k in (4, 5)))', ["4", "5"]),
    "by a function": ('def of(k):\n    return table(str(k), "Mine", phi, y)\ntypeset(of(4), of(5))', ["4", "5"]),
    "by a choice": (f'typeset({TABLE} if g.F > 2 else "none")', ["3"]),
    "in a dictionary": (f'shown = {{"a": {TABLE}}}\ntypeset(*shown.values())', ["3"]),
    "private ones": (f'_t = {TABLE}\n_c = check("ok", y.max(), 3.0)\ntypeset(_t, _c)', ["3"]),
    "arranged by marimo": (f'mo.vstack([mo.hstack([{TABLE}]), check("ok", y.max(), 3.0)])', ["3"]),
    "arranged under a name": (f"both = mo.hstack([{TABLE}])\nboth", ["3"]),
    "a summary": ('summary(check("ok", y.max(), 3.0))', []),
}
BY_A_METHOD = """class Shown:
    def rows(self):
        return TABLE
    def ok(self):
        return check("ok", y.max(), 3.0)
typeset(Shown().rows(), Shown().ok())""".replace("TABLE", TABLE)


def made(tmp_path: Path, lines: str) -> tuple[Any, Any, dict[str, Any]]:
    path = Path(own(tmp_path, FIELD + lines).path)
    text = path.read_text()
    start = text.index("    table_1 =")
    path.write_text(text[:start] + text[text.index("    return\n", start) :])
    sheet = cells.load(path)
    names, recording = recorded(sheet)
    return sheet, recording, {**names, "__file__": sheet.path}


@pytest.mark.parametrize("case", SHOWN)
def test_it_is_recorded(case: str, tmp_path: Path) -> None:
    lines, tables = SHOWN[case]
    _, recording, names = made(tmp_path, lines)
    assert not recording.gaps and [*recording.tables] == tables
    assert bool(recording.checks) is ("check(" in lines)
    book = load_workbook(BytesIO(report.workbook("Own", names, {})))
    titles = {sheet.title.partition(" ")[0] for sheet in book}
    assert titles.issuperset(number for number in tables if number.isdecimal())
    for sheet in book:
        if sheet.title.partition(" ")[0] in tables:
            assert str(sheet["B6"].value).startswith("="), sheet.title
    checks = {row[0]: row[1] for row in book["Checks"].iter_rows(min_row=3, values_only=True)}
    assert "ok" not in checks or checks["ok"] == "=MAX(ok)"


def test_what_no_name_tells_is_grey_and_named(tmp_path: Path) -> None:
    _, _, names = made(tmp_path, BY_A_METHOD)
    book = load_workbook(BytesIO(report.workbook("Own", names, {})))
    (sheet,) = (sheet for sheet in book if sheet.title.startswith("3 "))
    assert sheet["B6"].value == "=IF(inputs_changed=0,0.25,NA())"
    checks = {row[0]: row[1] for row in book["Checks"].iter_rows(min_row=3, values_only=True)}
    assert checks["ok"] == "=IF(inputs_changed=0,2.5,NA())"
    told = [str(row[1]) for row in book["Front"].iter_rows(values_only=True) if "table 3" in str(row[0])]
    assert told == ["it is shown under no name, by what is not recorded"]


def script(sheet: Any, tmp_path: Path) -> int:
    """Exit code of the worksheet as a script that exports."""
    path = Path(sheet.path)
    text = path.read_text()
    export = '@app.cell\ndef workbook():\n    export("Own", globals())\n    return\n\nif __name__'
    path.write_text(text.replace("if __name__", export, 1))
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr("sys.argv", [str(path), f"--out={tmp_path / 'out'}"])
        try:
            report._script("Own", {**sheet.run_whole(), "__file__": str(path)}, path)
        except SystemExit as ended:
            return int(ended.code or 0)
    return 0


FAILS = "check('ok', y.max(), 2.0)"
LATER = "@app.cell\ndef later(box):\n    box\n    return\n\n\n"


@pytest.mark.parametrize(
    ("lines", "later"),
    [
        (f'mo.accordion({{"more": {FAILS}}})', ""),
        (f'mo.md(f"so it is: {{mo.as_html({FAILS})}}")', ""),
        (f"both = mo.hstack([{FAILS}])\nboth", ""),
        (f"box = mo.vstack([{FAILS}])", LATER),
    ],
)
def test_a_check_that_marimo_has_arranged_fails_the_script(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], lines: str, later: str
) -> None:
    """It failed on the page while the script passed: all that was left of it is a text of the page."""
    sheet, _, _ = made(tmp_path, lines)
    path = Path(sheet.path)
    path.write_text(path.read_text().replace("if __name__", f"{later}if __name__", 1))
    assert script(cells.load(path), tmp_path) == 1
    assert capsys.readouterr().out.count("FAIL  ok") == 1


def test_what_the_workbook_has_not_is_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Tabs of marimo that have a name are an element of the page; a table or a check in them needs a name too."""
    sheet, _, _ = made(tmp_path, f'tabs = mo.ui.tabs({{"a": {TABLE}, "b": check("ok", y.max(), 3.0)}})\ntabs')
    assert script(sheet, tmp_path) == 0
    told = capsys.readouterr().out
    assert "not there: table 3, which has no name" in told
    assert "not there: check ok, which has no name" in told
