"""A text that is chosen by an input names numbers of these inputs alone: with others there is no number under it."""

from collections.abc import Mapping
from itertools import chain
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from by_cells import by_cells
from own_worksheet import own, recorded

from mechsheet.html import write
from mechsheet.quantities.lines import Recording
from mechsheet.quantities.node import Node
from mechsheet.quantities.quantity import Quantity
from mechsheet.quantities.written import Either, Number, Written
from mechsheet.readers.numbers import numbers
from mechsheet.recording.record import record
from mechsheet.worksheet import cells

CHOSEN = {  # how a text comes from the inputs; other inputs of OTHER give another one, and some the same
    "expression": "said = 'low' if g.F < 3 else 'high'",
    "seen": "said = ('low' if g.F < 3 else 'high').lower()",
    "statement": "said = 'low'\nif g.F > 3:\n    said = 'high'",
    "list": "said = ['low', 'high'][int(g.F > 3)]",
    "dictionary": "said = {0: 'zero', 1: 'one', 2: 'low', 3: 'high'}[g.k]",
    "number": "said = f'{np.round(g.F, 0):.0f}'",
    "match": "match int(g.F):\n    case 3:\n        said = 'high'\n    case _:\n        said = 'low'",
    "function": "def word():\n    return 'low' if g.F < 3 else 'high'\nsaid = word()",
    "pair": "pair = ('low', 'd') if g.F < 3 else ('high', 'u')\nsaid = pair[0]",
    "method": "said = 'low high'.split()[int(g.F // 3)]",
    "loop": "said = ''\nfor v in (1.0, 3.0):\n    if g.F > v:\n        said += 'i'",
    "array": "said = 'all' if np.all(x < 6) else 'some'",
}
SHOWN = {  # where it stands
    "check": "check_2 = check(f'stress at {said}', y, 9.0)",
    "Check": "check_2 = Check(said, float(np.max(y)), 9.0)",
    "check of a constant": "check_2 = check(said, 1.0, 9.0)",
    "checks of a list": "checks_2 = tuple(check(f'{part}: {said}', y, 9.0) for part in ('a', 'b'))",
    "title of a table": "table_2 = table('2', f'Forces, {said}', y)",
    "number of a table": "table_2 = table(said, 'Forces', y)",
    "note of a table": "table_2 = table('2', 'Forces', y, note=said)",
    "title of a figure": "figure_2 = figure('2', said, x, y)",
    "mark of a figure": "figure_2 = figure('2', 'Forces', x, y, marks={said: x[1]})",
    "quantity of a find": "t_found = find(lambda t: t * g.a - g.F, 0, 99, unknown='t', quantity=said)",
    "unknown of a find": "t_found = find(lambda t: t * g.a - g.F, 0, 99, unknown=said)",
    "closed form of a find": (
        "t_found = find(lambda t: t * g.a - g.F, 0, 99, unknown=said)\ncheck_2 = closed_form(t_found, g.F / g.a)"
    ),
    "a function of its own": "def shown(word):\n    return check(word, y, 9.0)\ncheck_2 = shown(said)",
}
OTHER: list[dict[str, Any]] = [{"F": 2.6}, {"F": 3.25, "k": 3}, {"F": 3.5, "k": 0}, {"F": 1.75, "a": 1.5, "k": 1}]


def held(recording: Recording) -> list[Node]:
    """The quantities that stand under a text: those of the last table, figure, check or found value."""
    columns = [c for number, table in recording.tables.items() if number != "1" for c in table if c is not None]
    nodes = [part for column in columns for part in column.parts]
    nodes += [part for check in recording.checks.values() for part in check.parts]
    nodes += [node for marks in recording.marks.values() for node in marks.values()]
    for solved in recording.found.values():
        nodes += [n for n in (solved.residual, solved.inverse, solved.target, *(solved.interval or ())) if n]
    return nodes


def text_at(text: Written, known: Mapping[Node, Any]) -> str:
    """A text by the numbers that are known."""
    told = ""
    for part in text.parts:
        match part:
            case Number(value, spec):
                told += format(known[value.re].item(), spec)
            case Either(holds, then, otherwise):
                told += text_at(then if known[holds.re] else otherwise, known)
            case str():
                told += part
    return told


def sheet_of(tmp_path: Path, chosen: str, shown: str) -> cells.Worksheet:
    lines = f"y = np.sin(x) * g.a  # [-] result\n{CHOSEN[chosen]}\n{SHOWN[shown]}"
    sheet = own(tmp_path, lines)
    path = Path(sheet.path)
    text = path.read_text().replace("import ask, find", "import Check, ask, check, closed_form, find", 1)
    path.write_text(text.replace("    table_1 = table", "    said_now = said\n    table_1 = table"))
    return cells.load(path)


@pytest.mark.parametrize(
    ("chosen", "shown"),
    [
        (c, s)
        for n, c in enumerate(CHOSEN)
        for k, s in enumerate(SHOWN)
        if (n - k) % 5 == 0 or c in ("expression", "seen")
    ],
)
def test_no_number_stands_under_the_text_of_other_inputs(chosen: str, shown: str, tmp_path: Path) -> None:
    sheet = sheet_of(tmp_path, chosen, shown)
    names, recording = recorded(sheet)
    nodes, same = held(recording), set[bool]()
    named = {text.now: text for text in recording.said.values()}
    assert nodes and not recording.gaps
    for given in ({}, *OTHER):
        inputs = {recording.inputs[name]: float(x) for name, x in given.items()}
        known = numbers([*nodes, *recording.guards, *chain(*(text.nodes for text in named.values()))], inputs)
        now = by_cells(sheet.path, ["said_now"], **given)["said_now"]
        as_it_was = now == names["said"]
        guarded = not all(known[guard].all() for guard in recording.guards)
        numbered = [bool(np.isfinite(known[node]).all()) for node in nodes]
        if named:  # which follow: then all is of these inputs
            said = {name.replace(names["said"], now) for name in named}
            assert {text_at(text, known) for text in named.values()} == said and all(numbered) and not guarded
            same.add(as_it_was)
            continue
        assert as_it_was or (guarded and not any(numbered)), given
        assert given or (not guarded and all(numbered))
        same.add(as_it_was)
    assert same == {True, False}


@pytest.mark.parametrize(
    "shown",
    [
        "check_2 = check('stress', y, 9.0, 'N' if False else unit)",
        "check_2 = Check('stress', float(np.max(y)), 9.0, reason=said)",
        "check_2 = Check('stress', float(np.max(y)), 9.0, unit, said)",
        "table_2 = table('2', 'Forces', y, show={'y': unit})",
    ],
)
def test_units_and_reasons_leave_a_number_as_it_is(shown: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A number in the unit that was chosen is right beside that unit, and a reason goes with other inputs."""
    monkeypatch.setitem(SHOWN, "beside", f"unit = 'deg' if g.F < 3 else 'rad'\n{shown}")
    sheet = sheet_of(tmp_path, "expression", "beside")
    _, recording = recorded(sheet)
    nodes = held(recording)
    assert nodes and all(guard.rows for guard in recording.guards.values())
    known = numbers(nodes, {recording.inputs["F"]: 3.25})
    assert all(np.isfinite(known[node]).all() for node in nodes)


@pytest.mark.parametrize(
    ("text", "follows"),
    [
        ("mo.md('plain words')", False),
        ("caption('2', 'plain words')", False),
        ("caption('2', title='plain words')", False),
        ("{2.5: mo.md('plain words')}[g.F]", True),
        ("[mo.md('plain words') for _ in (0,) if g.F < 3]", True),
        ("mo.md('plain words' if g.F < 3 else 'other words')", True),
        ("mo.md(['plain words', 'other words'][int(g.F // 3)])", True),
        ("mo.md((g.F < 3 and 'plain words') or 'other words')", True),
        ("mo.md('### plain words' if g.F < 3 else '### other words')", True),
        ("caption('2', 'plain words' if g.F < 3 else 'other words')", True),
        ("caption('2', {0: 'other words'}.get(g.k, 'plain words'))", True),
        ("title_block('Machine', 'plain words' if g.F < 3 else 'other words')", True),
    ],
)
def test_a_page_takes_away_the_text_of_other_inputs(text: str, follows: bool, tmp_path: Path) -> None:
    path = Path(own(tmp_path, "y = g.F * x  # [-] result").path)
    cell = f"    return\n\n@app.cell\ndef words(g):\n    {text}\n    return\n\nif __name__"
    source = path.read_text().replace("import ask, find", "import ask, caption, find, title_block", 1)
    source = source.replace("    from mechsheet import", "    import marimo as mo\n    from mechsheet import", 1)
    path.write_text(source.replace("    return\n\nif __name__", cell))
    sheet = cells.load(path)
    page = write.page(sheet, sheet.inputs())
    before = page[: page.index("plain words", page.index("</nav>"))]
    last = max(before.rfind(f"<{kind}") for kind in ("span data-n", "div", "h1", "b>Figure"))
    assert before[last:].startswith("<span data-n") == follows


def test_a_text_that_is_looked_up_says_what_would_follow(tmp_path: Path) -> None:
    """It follows for its own text alone, and nothing told that a choice among texts follows for all of them."""
    path = Path(own(tmp_path, "y = g.F * {'A': 1.0, 'B': 2.0}[g.s]  # [-] result").path)
    path.write_text(path.read_text().replace("    k: int", '    s: str = "A"  # kind\n    k: int', 1))
    sheet = cells.load(path)
    assert "of the type Literal[..] all options may follow" in write.page(sheet, sheet.inputs())


TOGETHER = """y = np.sin(x) * g.a  # [-] result
kind = ('low' if g.F < 3 else 'high').lower()
checks_2 = (
    check('plain', y, 9.0),
    check(f'of a {kind} force', y, 9.0),
    Check('with a reason', float(np.max(y)), 9.0, '-', f'too much by {g.F - 1:.3g}' if g.F > 2 else ''),
    *[check(f'part {k}', y * k, 9.0) for k in (1, 2)],
)"""


def test_of_checks_that_stand_together_each_rests_on_what_was_seen_for_it(tmp_path: Path) -> None:
    path = Path(own(tmp_path, TOGETHER).path)
    path.write_text(path.read_text().replace("import ask, find", "import Check, ask, check, find", 1))
    names, recording = recorded(cells.load(path))
    assert list(recording.checks) == [check.name for check in names["checks_2"]]
    residuals = {name: check.parts[0] for name, check in recording.checks.items()}
    known = numbers(residuals.values(), {recording.inputs["F"]: 3.25})
    numbered = {name: bool(np.isfinite(known[node]).all()) for name, node in residuals.items()}
    assert [name for name, there in numbered.items() if not there] == ["of a low force"]
    assert not any(name.startswith("_part") for name in recording.values)


def test_checks_that_stand_together_are_named_once_where_one_is_not_recorded(tmp_path: Path) -> None:
    lines = TOGETHER.replace("check('plain', y, 9.0)", "check('plain', np.linalg.eigvals([[g.F, 1], [1, g.a]]), 9.0)")
    path = Path(own(tmp_path, lines).path)
    path.write_text(path.read_text().replace("import ask, find", "import Check, ask, check, find", 1))
    names, recording = recorded(cells.load(path))
    assert [gap.names for gap in recording.gaps] == [("checks_2",)]
    assert {*recording.checks} == {check.name for check in names["checks_2"]}
    parts = [check.parts[0] for check in recording.checks.values()]
    known = numbers(parts, {recording.inputs["F"]: 3.25})
    assert not any(np.isfinite(known[part]).any() for part in parts)


def test_a_position_that_is_marked_rests_on_what_was_seen(tmp_path: Path) -> None:
    lines = "kind = ('low' if g.F < 3 else 'high').lower()\nm = mark(F=g.F if kind == 'low' else 7.0)"
    path = Path(own(tmp_path, lines).path)
    text = path.read_text().replace("import ask, find", "import ask, find, mark", 1)
    path.write_text(text.replace("    typeset()\n", "    typeset(m)\n", 1))
    sheet = cells.load(path)
    names = sheet.run(sheet.results, {"g": sheet.inputs()})
    recording = record(names, sheet, whole=True, every=1, draws=True)
    at = recording.positions["F"]
    there = [float(numbers([at], {recording.inputs["F"]: F})[at]) for F in (2.75, 4.0)]
    np.testing.assert_equal(there, [2.75, np.nan])


def test_a_column_rests_on_what_was_seen_for_it_alone(tmp_path: Path) -> None:
    """Beside one that holds for the exported inputs alone the others follow; a title is that of all."""
    lines = (
        "from scipy.optimize import minimize_scalar\nwide = np.linspace(0.0, g.F, 3)  # [-] follows\n"
        "least = minimize_scalar(lambda v: (v - g.F) ** 2)\nfar = wide * least.x  # [-] does not\n"
        "table_2 = table('2', 'Beside', wide, far)\ntable_3 = table('3', f'Least {least.x}', wide)"
    )
    _, recording = recorded(own(tmp_path, lines))
    columns = [column for number in "23" for column in recording.tables[number] if column is not None]
    known = numbers([column.re for column in columns], {recording.inputs["F"]: 3.25})
    numbered = [bool(np.isfinite(known[column.re]).all()) for column in columns]
    assert numbered == [True, False, False]


@pytest.mark.parametrize(
    "read",
    [
        "float(f'{g.F:.0f}') + 1",
        "float(f'{g.F}')",
        "float(f'{g.F:.0f}' + '5')",
        "float(f'{g.F:.0f}'.replace('2', '1'))",
        "int(f'{g.F:.0f}') + 1.0",
        "complex(f'{g.F:.1f}').real",
        "np.float64(f'{g.F:.1f}') * 1",
        "np.array([f'{g.F:.1f}']).astype(float)[0]",
        "sum(float(sign) for sign in f'{10 * g.F:.0f}')",
        "len(f'{10**g.F:.0f}') * 1.0",
        "eval(f'{g.F:.1f} + 1')",
        "{'2.5': 4.0}.get(f'{g.F:.1f}', 3.0)",
        "float(f'{g.F:.1f}'.split('.')[0])",
        "float(('%.1f' % g.F))",
    ],
)
def test_a_number_read_out_of_a_text_holds_while_the_text_is_the_same(read: str, tmp_path: Path) -> None:
    """On the page too, which writes texts anew for other inputs, but reads none."""
    sheet = own(tmp_path, f"q = {read}  # [-] read")
    names = sheet.run(["q", "table_1"], {"g": sheet.inputs()})
    assert isinstance(names["q"], float)
    recording = record(names, sheet, whole=True, every=1, draws=True)
    value, guards = recording.values["q"], [guard.holds for guard in recording.looked["q"]]
    parts = [*value.parts] if isinstance(value, Quantity) else []
    assert parts or isinstance(value, int | float)
    for F, same in ((2.5, True), (3.5, False), (1.25, False)):
        known = numbers([*parts, *guards], {recording.inputs["F"]: F})
        shown = all(known[guard] for guard in guards) and not any(np.isnan(known[part]).any() for part in parts)
        assert shown is same, F


@pytest.mark.parametrize(
    ("text", "pieces"),
    [
        ('"%.2f N of %d, %g %%" % (g.F, g.F, g.a)', [Number, str, Number, str, Number, str]),
        ('"F = %s" % g.F', [str, Number]),
        ('{1: "one", 2: "two"}.get(g.k, "many")', [Either]),
        ('"%5.2f" % g.a', []),  # which Python writes, seen
    ],
)
def test_numbers_put_in_by_a_percent_sign_and_texts_by_a_number_are_followed(
    text: str, pieces: list[type], tmp_path: Path
) -> None:
    sheet = own(tmp_path, f"said = {text}")
    names, recording = recorded(sheet)
    said = recording.values["said"]
    assert str(names["said"]) == str(getattr(said, "now", said))
    assert [type(part) for part in getattr(said, "parts", ())] == pieces
    assert pieces or recording.looked["said"]
