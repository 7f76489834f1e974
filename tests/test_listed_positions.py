"""Tables that list every so many positions, of whatever field: all workbooks have the rows and numbers of the sheet."""

import io
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import written_cells
from own_worksheet import own, recorded

from mechsheet import units
from mechsheet.readers.numbers import numbers
from mechsheet.run import report
from mechsheet.worksheet import cells
from mechsheet.worksheet.table import Figure, Table

FIELD = "phi = linspace(0, 1, COUNT)  # [-] place\ny = phi * g.F + g.a  # [-] line\n"
LISTED = 'table_2 = table("2", "Listed", phi, y, every=5)\n'
LINES = {
    "the last place is not listed": FIELD.replace("COUNT", "13") + LISTED + 'figure_1 = figure("1", "All", phi, y)',
    "sums over all of them": FIELD.replace("COUNT", "13")
    + LISTED
    + 'q = y / y.max() - y.sum()  # [-] part\ntable_3 = table("3", "Parts", q, every=5)',
    "arange": FIELD.replace("linspace(0, 1, COUNT)", "np.arange(23) * 0.1") + LISTED,
    "an array as it is": FIELD.replace("linspace(0, 1, COUNT)", "np.array([0.1 * k for k in range(13)])") + LISTED,
    "without its end": FIELD.replace("COUNT", "11, endpoint=False") + LISTED + 'figure_1 = figure("1", "All", phi, y)',
    "a group with other steps": FIELD.replace("COUNT", "11")
    + LISTED
    + 'both = (table("3", "All", phi, y), table("4", "Some", phi, y, every=2))',
    "a chart over another field": FIELD.replace("COUNT", "11")
    + LISTED
    + 't = linspace(0, 1, 26)  # [-] time\nz = t * g.a  # [-] way\nfigure_1 = figure("1", "Other", t, z)',
    "two fields": FIELD.replace("COUNT", "11")
    + LISTED
    + 't = linspace(0, 1, 7)  # [-] time\nz = t * y.max()  # [-] way\ntable_3 = table("3", "Other", t, z, every=5)',
    "one field made in two ways": FIELD.replace("COUNT", "11")
    + LISTED
    + 'z = y * np.arange(11) * 0.1  # [-] way\ntable_3 = table("3", "Other", z, every=5)',
    "parts of a field": FIELD.replace("COUNT", "11")
    + LISTED
    + "d = np.diff(y)  # [-] step\nk = y[3:]  # [-] end\nh = y[::2]  # [-] half\n"
    + "\n".join(f'table_{n} = table("{n}", "Part {name}", {name}, every=5)' for n, name in enumerate("dkh", 3)),
    "a step that is an input": FIELD.replace("COUNT", "12") + LISTED.replace("every=5", "every=g.k + 1"),
}


@pytest.mark.parametrize("case", LINES)
def test_its_rows_are_recorded(case: str, tmp_path: Path) -> None:
    """A field that is not thinned out gave as many formulas as it has places: there was no workbook then."""
    sheet = _alone(tmp_path, LINES[case])
    names, recording = recorded(sheet)
    assert not recording.gaps
    assert len(report.workbook("Own", {**names, "__file__": sheet.path}, {})) > 9_000
    for given in ({}, {"F": 3.25}, {"a": 1.5}):
        run = sheet.run(sheet.results, {"g": sheet.inputs(**given)})
        for value in run.values():
            for table in value if isinstance(value, tuple) else (value,):
                if isinstance(table, Table | Figure):
                    _same(table, recording, given)


def _alone(tmp_path: Path, lines: str) -> cells.Worksheet:
    """A worksheet with these fields and tables, and no others."""
    path = Path(own(tmp_path, lines).path)
    text = path.read_text().replace('    table_1 = table("1", "All", x)\n', "")
    path.write_text(text.replace("    x = linspace(0.1, 2, g.n) * g.F  # [-] field\n", ""))
    return cells.load(path)


def _same(shown: Table | Figure, recording: Any, given: dict[str, float]) -> None:
    number, every = (shown.number, 1) if isinstance(shown, Table) else (f"Fig {shown.number}", recording.every)
    columns = shown.columns if isinstance(shown, Table) else (shown.x, *shown.lines)
    for column, quantity in zip(columns, recording.tables[number], strict=True):
        if quantity is not None:  # else it is the same for all inputs
            known = numbers([quantity.re], {recording.inputs[name]: x for name, x in given.items()})[quantity.re]
            expected = column.values[::every] * units.parse(column.unit).factor
            np.testing.assert_allclose(known, expected, rtol=1e-13, atol=1e-15, err_msg=f"{number} {column.symbol}")


OF_ALL = {  # what is shown of all positions, in a worksheet whose tables list some
    "a title": 'table_2 = table("2", f"up to {y.max():.2f}", phi, y, every=5)',
    "a word in a title": 'word = "steep" if np.diff(y).max() > 0.3 else "flat"\n'
    'table_2 = table("2", f"It is {word}", phi, y, every=5)',
    "a note": 'table_2 = table("2", "Listed", phi, y, note=f"{len(y)} places, {y[1]:.2f}", every=5)',
    "a column of texts": 'way = np.where(np.concatenate([[0], np.diff(y)]) > 0.3, "up", "down")\n'
    'table_2 = table("2", "Listed", phi, y, way, every=5)',
    "a list of texts": 'way = ["up" if d > 0.3 else "down" for d in np.diff(y, prepend=0)]\n'
    'table_2 = table("2", "Listed", phi, y, way, every=5)',
    "a list of numbers": "total = [sum(y[: k + 1]) for k in range(len(y))]  # [-] sum\n"
    'table_2 = table("2", "Listed", phi, y, total, every=5)',
    "a mark": LISTED + 'figure_1 = figure("1", "All", phi, y, marks={"second": phi[1], "top": phi[np.argmax(-y)]})',
    "how many": LISTED
    + 'few = check("places", len(y), 20, "-")\nmore = check("half", y.size / 2, at_least=5, unit="-")',
}


@pytest.mark.parametrize("case", OF_ALL)
def test_what_is_shown_of_all_positions_is_so_in_a_workbook(case: str, tmp_path: Path) -> None:
    """It was that of the listed ones, for the exported inputs too: a title said another greatest number."""
    sheet = _alone(tmp_path, "from mechsheet import check\n" + FIELD.replace("COUNT", "11") + OF_ALL[case])
    _, recording = recorded(sheet)
    assert not recording.gaps
    for given in ({}, {"F": 3.25}, {"a": 1.5}):
        names = sheet.run(sheet.results, {"g": sheet.inputs(**given)})
        leaves = {recording.inputs[name]: x for name, x in given.items()}
        table = names["table_2"]
        for part in ("title", "note"):
            if (said := recording.said.get(f"table 2 {part}")) and not given:
                assert said.now == getattr(table, part)
        for (_, n), (texts, at) in recording.labels.items():
            known = numbers([at.re], leaves)[at.re]
            assert [texts[int(k)] for k in known] == table.columns[n].values.tolist()
        for n, column in enumerate(recording.tables["2"]):
            if ("2", n) not in recording.labels:
                known = numbers([column.re], leaves)[column.re]
                np.testing.assert_allclose(known, table.columns[n].values, rtol=1e-13)
        for label, at in names["figure_1"].marks if "figure_1" in names else ():
            node = recording.marks["1"][label]
            assert numbers([node], leaves).get(node, node.value) == pytest.approx(at, rel=1e-13)
        for name in ("few", "more") if "few" in names else ():
            (part,) = recording.checks[names[name].name].parts
            assert numbers([part], leaves).get(part, part.value) == names[name].residual


def test_key_results_of_charts_say_that_they_are_of_the_listed_positions(tmp_path: Path) -> None:
    """The greatest number between them is another one, which the chart of the page shows."""
    sheet = _alone(tmp_path, FIELD.replace("COUNT", "13") + LISTED + 'figure_1 = figure("1", "All", phi, y)')
    names, _ = recorded(sheet)
    book = written_cells.read(io.BytesIO(report.workbook("Own", {**names, "__file__": sheet.path}, {})))
    assert any(value == "line, figure 1, at the listed positions" for _, value in book["Front"].values())
