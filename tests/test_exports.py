"""The workbooks in exports/ are what the worksheets write today, whatever the processor rounds."""

from __future__ import annotations

import io
import math
import re
import sys
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

import pytest
import written_cells
from as_script import as_script
from openpyxl.utils.cell import coordinate_to_tuple
from written_cells import Content

from mechsheet.run import report
from mechsheet.studies.design import Design, search
from mechsheet.worksheet.cells import load

ROOT = Path(__file__).resolve().parents[1]
WORKSHEETS = sorted((ROOT / "worksheets").glob("*.py"))
EXPORTS = ROOT / "exports"

ROUNDING = 1e-12  # of the largest number of its column: by so much a result may differ between processors
LEFT = 1e-9  # of the largest number of its unit on a sheet: what is less is left of others
SMALL = 0.1  # of their limit: residuals below are rounding, and may become any others that are as small
FULL = -math.log10(sys.float_info.epsilon)  # digits of a number that is rounded once


LONG = ("accuracy", "hitch_design")  # runs of half a minute, which are compared in the tests of these worksheets


@pytest.mark.parametrize("name", sorted({path.stem for path in WORKSHEETS}.difference(LONG)))
def test_export_is_current(name: str, tmp_path: Path) -> None:
    worksheet = ROOT / "worksheets" / f"{name}.py"
    run = as_script(worksheet, f"--out={tmp_path}")
    assert run.returncode == 0, run.stdout + run.stderr
    assert_current(worksheet, tmp_path)


def assert_current(worksheet: Path, folder: Path) -> None:
    book = f"{worksheet.stem}.xlsx"
    assert [path.name for path in folder.iterdir() if path.suffix != ".toml"] == [book]  # a design writes its scene
    found = list(stale(worksheet, exported(worksheet.stem), read(folder / book)))
    assert not found, f"exports/{book} is not current:\n" + "\n".join(found[:20])


def test_every_export_has_its_worksheet() -> None:
    assert {path.stem for path in EXPORTS.glob("*.xlsx")} == {path.stem for path in WORKSHEETS}


def test_checks_of_the_documents_look_at_all_positions() -> None:
    """Tables list some; a check of these alone may pass where the worksheet's own fails; its name says so."""
    for path in EXPORTS.glob("*.xlsx"):
        names = (cell.value for (_, column), cell in exported(path.stem)["Checks"].items() if column == 1)
        assert not [name for name in names if "listed" in str(name)], path.name


class Cell(NamedTuple):
    """What is written in a cell, which may be a formula, and its value."""

    written: Content
    value: Content


class Scale(NamedTuple):
    """What a difference is held against: the largest number of the column, and the limit where there is one."""

    size: float
    limit: float


Cells = dict[tuple[int, int], Cell]  # by row and column
Book = dict[str, Cells]  # by the name of the sheet
Alike = Callable[[float, float, Scale], bool]


def result(x: float, y: float, scale: Scale) -> bool:
    return abs(x - y) <= ROUNDING * scale.size


def residual(x: float, y: float, scale: Scale) -> bool:
    """A column that is small stays small; a margin, or a residual that is more than rounding, is a result."""
    return max(scale.size, abs(y)) <= SMALL * scale.limit or result(x, y, scale)


def rounding(x: float, y: float, scale: Scale) -> bool:
    """A residual of some roundings, whose limit is not many more."""
    return max(scale.size, abs(y)) <= scale.limit


def error(x: float, y: float, scale: Scale) -> bool:
    """An estimate or a measurement of an error tells its order of magnitude."""
    return x == y or (min(x, y) > 0 and abs(math.log10(x / y)) <= 1)


def digits(x: float, y: float, scale: Scale) -> bool:
    return abs(min(x, FULL) - min(y, FULL)) <= 0.5


def nearly_singular(x: float, y: float, scale: Scale) -> bool:
    """Where rounding alone moves an error by most of its order of magnitude."""
    return abs(min(x, FULL) - min(y, FULL)) <= 1


def cancelled(x: float, y: float, scale: Scale) -> bool:
    """A difference of equal numbers of the size of one to a hundred."""
    return abs(x - y) <= ROUNDING


def duration(x: float, y: float, scale: Scale) -> bool:
    return True


def sometimes(x: float, y: float, scale: Scale) -> bool:
    """What a run time has or has not, as it happens: a spread where it was taken often, words where it is shorter."""
    return True


def counted(x: float, y: float, scale: Scale) -> bool:
    """What rounding moves a little."""
    return abs(x - y) <= max(2, 0.1 * max(x, y))


def steps(x: float, y: float, scale: Scale) -> bool:
    """What an integrator takes: rounding moves it by a third where one stalls."""
    return abs(x - y) <= max(2, 0.5 * max(x, y))


KINDS: tuple[tuple[str, str, str, Alike], ...] = (
    # Numbers that are no results, by the beginning of the sheet's name and of the column's head, and by the row's name,
    # in a list of lines by the row's meaning.
    (r"Checks", r"Residual", r"\bdigits\b", digits),
    (r"Checks|Residuals lines", r"Residual|Value", r"\berrors\b.* in roundings\b", error),
    (r"Checks", r"Residual", r"but for whole turns\b", rounding),
    (r"Checks", r"Residual", r"", residual),
    (r"Checks", r"Limit", r" is (its|the) slope\b", error),  # ten times what the differences say of their error
    (r"Find", r"Residual", r"", residual),
    (r"Residuals lines", r"Value", r"^(step of )?residual: ", residual),
    (r"Residuals fields", r".*_but_for_whole_turns\b", r"", rounding),
    (r"Residuals fields", r"", r"", residual),  # a result where the column is no residual, and so has no limit
    (r".* fields\b", r"[FM]\d+[xy_]? \[", r"", residual),  # what is left of the forces or moments on a body
    (r".* fields\b", r"N_[Fg](_\d+)? \[-?\]", r"", duration),  # evaluations that a Find takes
    (r"Front", r"", r"^error$", error),
    # Rounding chooses which of its results is the worst: the steps of an integrator end elsewhere.
    (r"7\.1 Digits", r"", r"^through dead centre$", duration),
    (r"7\.1 Digits", r"(log κ|expected) \[", r"^(rrr|rrp|rpr|prp|rpp) ", digits),  # in part by differences of floats
    (r"7\.1 Digits", r"(printed|product|margin) \[", r"", nearly_singular),  # of the worst of a scene's results
    (r"Table 7\.4", r"(proved|right) \[", r"", digits),
    (r"Table 7\.5", r".* error \[", r"", error),
    (r"Table 7\.5", r"results \[", r"", counted),  # but for those at the end of their reach
    (r"Table 7\.([6-9]|10)", r"kept digits \[", r"", nearly_singular),  # the worst of three positions
    (r"5 Find against fields", r"r_\d* \[", r"", cancelled),
    (r"4\.2 Reactions", r"digits \[-\]", r"", nearly_singular),  # of one position
    (r"", r"(digits|most) \[-\]", r"", digits),
    (r"", r"error \[-?\]", r"", error),
    (r"1\.8 Steps", r".* \[-\]", r"", steps),
    (r"", r"roundings \[-\]", r"", error),
    (r"", r"(again |arithmetic )?spread \[|not used\b", r"", sometimes),
    (r"", r"(time|again|ratio|place|least time|fastest|better|of whole|of a run) \[", r"", duration),
    (r"", r"((again |arithmetic )?runs|slope|checks) \[|.* \[µs\]", r"", duration),
    (r"0\.2 Machine", r"", r"", duration),
)


@cache
def exported(worksheet: str) -> Book:
    return read(EXPORTS / f"{worksheet}.xlsx")


def read(file: Path | io.BytesIO) -> Book:
    return {
        title: {at: _cell(*cell) for at, cell in cells.items()} for title, cells in written_cells.read(file).items()
    }


def _cell(formula: str, value: Content) -> Cell:
    """A cell; one that shows its value for the exported inputs alone is compared by that."""
    if not formula:
        return Cell(value, value)
    written = formula
    match = re.fullmatch(r"=IF\(inputs_changed=0,(.*),(?:NA\(\)|\"\")\)", written)
    if match and (match[1].strip('"') == str(value) or _number(match[1]) == value):
        written = "=IF(inputs_changed=0,..,NA())"
    guarded = re.fullmatch(r"=IF\((AND\(.*\)|\w+=[^,()]*),([^,()]*),NA\(\)\)", written)
    if guarded and _number(guarded[2]) == value:
        written = f"=IF({guarded[1]},..,NA())"
    return Cell(written, value)


def _number(text: str) -> float | None:
    try:
        return float(text)
    except ValueError:
        return None


def differences(old: Book, new: Book) -> Iterator[str]:
    """Cells of two workbooks that differ by more than rounding, each number compared by what it means."""
    if list(old) != list(new):
        yield f"sheets {list(old)} became {list(new)}"
        return
    limits = _limits(old)
    for title, cells in old.items():
        sizes = _of_units(title, cells, _sizes(cells))
        for at in sorted({*cells, *new[title]}):
            x, y = cells.get(at), new[title].get(at)
            if x == y:
                continue
            alike, limit = _compared(title, cells, at, limits)
            if alike is sometimes:
                continue
            scale = Scale(sizes.get(at, 0.0), limit)
            if not (x and y and _same_formula(x.written, y.written) and _same_value(x.value, y.value, alike, scale)):
                yield f"{title}, row {at[0]}, column {at[1]}: {x} became {y}"


def _listing(cells: Cells) -> bool:
    """Whether a sheet has its heads in row 2 and a unit for each row; a table has symbols and units in rows 3 and 4."""
    return (2, 2) in cells  # in row 2 a table has no more than a note, in the first column


def _sizes(cells: Cells) -> dict[tuple[int, int], float]:
    """Magnitudes of the numbers of a listing, of the largest numbers of their columns in a table."""
    own = {at: abs(cell.value) for at, cell in cells.items() if isinstance(cell.value, float | int)}
    if _listing(cells):
        return own
    largest: dict[int, float] = {}
    for (_, column), size in own.items():
        largest[column] = max(size, largest.get(column, 0.0))
    return {at: largest[at[1]] for at in own}


def _of_units(title: str, cells: Cells, sizes: dict[tuple[int, int], float]) -> dict[tuple[int, int], float]:
    """The same on a sheet of lines, but of what is left of a sum that of the largest which measures the same."""
    if title.startswith("Residuals") or not re.search(r" (lines|fields)\b", title):
        return sizes
    listing = _listing(cells)
    units = {
        at: cells[at[0], 3] if listing else cells.get((4, at[1])) for at in sizes if not listing or (at[0], 3) in cells
    }
    largest: dict[Any, float] = {}
    for at, unit in units.items():
        largest[unit] = max(sizes[at], largest.get(unit, 0.0))
    return {
        at: large if size < LEFT * (large := largest.get(units.get(at), size)) else size for at, size in sizes.items()
    }


def _compared(title: str, cells: Cells, at: tuple[int, int], limits: dict[str, float]) -> tuple[Alike, float]:
    """How a cell is compared, and the limit that it is held against."""
    row, column = at

    def text(*at: int) -> str:
        return str(cells[at].value or "") if at in cells else ""

    name = text(row, 4 if title.endswith(" lines") else 1)
    head = text(2, column) if _listing(cells) else f"{text(3, column)} [{text(4, column)}]"
    if row <= (2 if _listing(cells) else 4):
        return result, 0.0
    of = title if title == "Find" else name
    if re.search(r" fields\b", title):
        of = text(3, column) if title.startswith("Residuals") else f"left of {text(4, column)}"
    alike = kind(title, head, name)
    return alike or result, limits.get(of, 0.0) if alike else 0.0


@cache
def kind(title: str, head: str, name: str) -> Alike | None:
    """How numbers are compared that are no results."""
    for sheet, begin, named, alike in KINDS:
        if re.match(sheet, title) and re.match(begin, head) and re.search(named, name):
            return alike
    return None


def _limits(book: Book) -> dict[str, float]:
    """Limits of residuals: of checks by name, in SI units by what their lines mean and are called, and of Find."""
    limits = {"Find": 1e-9}  # where the cell turns red
    in_si = {}
    checks = book["Checks"]
    for row in range(3, 1 + max(row for row, _ in checks)):
        name = re.sub(", at (the listed|the middle|three of the) positions?$", "", str(checks[row, 1].value))
        limit = checks[row, 3].value
        limits[str(checks[row, 1].value)] = limits[name] = float(limit or 0)
        unit = re.search(r"/(\d[\d.E-]*)$", str(checks[row, 2].written))
        in_si[f"residual: {name}"] = limits[name] * (float(unit[1]) if unit else 1.0)
        if left := re.match("equilibrium of (forces|moments)", name):
            of = "left of " + {"forces": "N", "moments": "N·m"}[left[1]]
            limits[of] = max(limits.get(of, 0.0), in_si[f"residual: {name}"])
    listed = book.get("Residuals lines", {})
    for (row, column), cell in listed.items():
        of = str(cell.value).removeprefix("step of ").replace("limit: ", "residual: ", 1)
        if column == 4 and of in in_si:
            limits[str(cell.value)] = limits[str(listed[row, 1].value)] = in_si[of]
    return limits


def _same_formula(x: Content, y: Content) -> bool:
    """Whether two formulas differ in nothing but the rounding of their constants; what is no formula has none."""
    if x == y:
        return True
    p, q = (z if isinstance(z, str) and z.startswith("=") else "" for z in (x, y))
    constant = r"(?<![\w.$])(\d+(?:\.\d*)?(?:[eE][+-]?\d+)?)"  # not what ends a name or the address of a cell
    parts, others = (re.split(constant, z) for z in (p, q))
    return parts[::2] == others[::2] and all(
        math.isclose(float(a), float(b), rel_tol=ROUNDING) for a, b in zip(parts[1::2], others[1::2], strict=True)
    )


def _same_value(x: Content, y: Content, alike: Alike, scale: Scale) -> bool:
    if alike is duration:
        return type(x) is type(y) or (isinstance(x, float | int) and isinstance(y, float | int))
    if alike is error and isinstance(x, str) and isinstance(y, str):
        x, y = float(x), float(y)
    if isinstance(x, float | int) and isinstance(y, float | int):
        return alike(x, y, scale)
    return x == y


class Searched(NamedTuple):
    """What a search chose, its reserves of capacity and stability, the lead it was asked for and its uncertainty."""

    inputs: dict[str, float]
    reserves: tuple[float, float]
    lead: float
    uncertainty: float

    def goal(self, lead: float) -> float:
        capacity, stability = self.reserves
        return min(capacity - lead / 2, stability + lead / 2)


def searches(book: Book) -> list[Searched]:
    """Results of the searches of a workbook, numbers in percent: the chosen design, then those of the trade-off."""
    if "3.1 Chosen inputs" not in book:
        return []
    chosen, stroke, trade_off = (
        {at: cell.value for at, cell in book[title].items()}
        for title in ("3.1 Chosen inputs", "3.2 The design over the stroke", "4.1 Designs of the trade-off")
    )
    inputs = {chosen[row, 1]: chosen[row, 3] for row, column in chosen if row > 4 and column == 3}
    capacity, stability = (min(x for (row, k), x in stroke.items() if row > 4 and k == column) for column in (4, 5))
    uncertain = re.search(r"uncertain by ([\d.]+) %", chosen[2, 1])
    assert uncertain, "a design whose uncertainty is not known is not for comparison"
    found = [Searched(inputs, (capacity, stability), 0.0, float(uncertain[1]))]
    for row in sorted({row for row, _ in trade_off if row > 4}):
        c_G, c_R, lead, uncertainty, *values = (trade_off[row, column] for column in range(1, 5 + len(inputs)))
        found.append(Searched(dict(zip(inputs, values, strict=True)), (c_G, c_R), lead, uncertainty))
    return found


def stale(worksheet: Path, old: Book, new: Book) -> Iterator[str]:
    """What differs: of searches the goals, by more than their uncertainty; all else as it is for the old designs."""
    before, after = searches(old), searches(new)
    if [found.inputs for found in before] != [found.inputs for found in after]:
        yield from apart(before, after)
        new = designed(worksheet, before, old)
    yield from differences(old, new)


def apart(before: list[Searched], after: list[Searched]) -> Iterator[str]:
    """Which goals the best design of the other searches does not reach, or leaves behind, within their uncertainty."""
    for found, others in [*((found, after) for found in before), *((found, before) for found in after)]:
        best = max(other.goal(found.lead) for other in others)
        if not abs(found.goal(found.lead) - best) <= found.uncertainty:
            yield f"{found}: its goal {found.goal(found.lead)} % became {best} %"


def designed(worksheet: Path, before: list[Searched], old: Book) -> Book:
    """The workbook that the worksheet writes where its searches find these."""
    sheet = load(worksheet)
    g = sheet.inputs()
    names = sheet.run(["judge", "decimals"], {"g": g})
    tried = re.search(r"Best of (\d+) variants", str(old["3.1 Chosen inputs"][2, 1].value))
    assert tried

    def result(found: Searched) -> Design:
        fixed = {x: (value, value) for x, value in found.inputs.items()}
        once = {"seed": 1, "generations": 1, "members": 1}
        at = search(names["judge"](found.lead / 100), fixed, names["decimals"], **once)
        return replace(at, tried=int(tried[1]), uncertainty=found.uncertainty / 100)

    chosen, *others = map(result, before)
    led = [(found.lead / 100, other) for found, other in zip(before[1:], others, strict=True)]
    names = sheet.run(sheet.results, {"g": g, "design": chosen, "led": led, "unbeaten": led})
    book = report.workbook("Design of a tractor hitch", {**names, "__file__": str(worksheet)}, {})
    return read(io.BytesIO(book))


def changed(book: Book, sheet: str, place: str, change: dict) -> Book:
    """A copy of a workbook with a cell changed: what is written or its value, to another or by a function of it."""
    at = coordinate_to_tuple(place)
    old = book[sheet][at]
    new = old._replace(**{k: f(getattr(old, k)) if callable(f) else f for k, f in change.items()})
    assert new != old, "the test changes nothing"
    return {**book, sheet: {**book[sheet], at: new}}


def times(factor: float) -> Callable[[object], object]:
    return lambda x: x * factor if isinstance(x, float | int) else x


@pytest.mark.parametrize("worksheet", WORKSHEETS, ids=lambda path: path.stem)
def test_rounding_of_every_number_is_no_difference(worksheet: Path) -> None:
    def rounded(x: object) -> object:
        if isinstance(x, str) and x.startswith("="):
            return re.sub(r"(?<![\w.$'])\d+\.\d{9,}\b(?!E)", lambda m: repr(float(m[0]) * (1 + 5e-13)), x)
        return times(1 + 5e-13)(x)

    old = exported(worksheet.stem)
    new = {title: {at: Cell(*map(rounded, cell)) for at, cell in cells.items()} for title, cells in old.items()}
    assert new != old
    assert not list(differences(old, new))


def test_a_change_of_any_result_is_seen() -> None:
    """By 1e-11 of the largest number of its column in the tables of the hitch, of itself in its inputs."""
    old = exported("hitch")
    new = {title: dict(cells) for title, cells in old.items()}
    tables = [title for title in old if re.match(r"[2-7](\.\d)? ", title) and not title.endswith(" lines")]
    count = 0
    for title in ("Inputs", *tables):
        for (row, column), cell in old[title].items():
            column_of = (c.value for (r, k), c in old[title].items() if k == column and r > 4 and title != "Inputs")
            step = 1e-11 * max((abs(x) for x in (cell.value, *column_of) if isinstance(x, float)), default=0.0)
            left_over = title.endswith(" fields") and re.match(r"[FM]\d+[xy_]?$", str(old[title][3, column].value))
            if row > 4 and isinstance(cell.value, float) and step and not left_over:
                new[title][row, column] = Cell(cell.written, cell.value + step)
                count += 1
    assert count > 500
    assert len(list(differences(old, new))) == count


@pytest.mark.parametrize(
    ("worksheet", "sheet", "place", "change"),
    [
        ("hitch", "4.1 Lifting capacity", "A3", {"written": "T", "value": "T"}),  # symbol
        ("hitch", "4.1 Lifting capacity", "A4", {"written": "mm", "value": "mm"}),
        ("hitch", "4.1 Lifting capacity", "B7", {"written": lambda x: x.replace("*", "/", 1)}),
        ("hitch", "4.1 Lifting capacity", "B7", {"written": lambda x: f"{x}*2"}),
        ("hitch", "4.1 Lifting capacity", "B7", {"written": 1.0}),  # a number in the place of a formula
        ("hitch", "4.1 Lifting capacity", "B7", {"value": "#N/A"}),
        ("hitch", "Checks", "E3", {"value": "FAIL"}),
        ("hitch", "Checks", "B7", {"value": times(1e6)}),  # a residual that is no longer small
        ("hitch", "Checks", "B23", {"value": times(1 + 1e-11)}),  # a margin, which is a result
        ("hitch", "Checks", "C7", {"value": times(1 + 1e-11)}),
        ("hitch", "Checks", "C13", {"written": times(20), "value": times(20)}),
        ("hitch", "Find", "B3", {"value": times(1 + 1e-11)}),
        ("hitch", "Find", "E3", {"value": 1e-8}),
        ("landing_gear", "Residuals fields", "AW10", {"value": times(1 + 1e-9)}),  # not small against its limit
        ("hitch_design", "Residuals lines", "B12", {"written": lambda x: x.replace("0.159412369", "0.159412368")}),
        ("hitch_design", "3.1 Chosen inputs", "C5", {"written": 0.196, "value": 0.196}),
        ("hitch_design", "5.1 Sensitivity of the capacity", "G10", {"value": "8e-06"}),
        ("accuracy", "1.1 Position of the hitch", "A6", {"written": "hybr", "value": "hybr"}),
        ("accuracy", "1.1 Position of the hitch", "C6", {"written": times(11), "value": times(11)}),
        ("accuracy", "1.1 Position of the hitch", "D7", {"value": lambda x: x - 0.6}),
        ("accuracy", "1.1 Position of the hitch", "E6", {"written": None, "value": None}),
        ("accuracy", "7.1 Digits in stiff and extreme", "G28", {"value": 15.1}),
        ("accuracy", "7.1 Digits in stiff and extreme", "D33", {"value": times(1 + 1e-11)}),
        ("accuracy", "Table 7.5", "E5", {"value": times(11)}),
        ("accuracy", "1.8 Steps of the integrators", "E5", {"value": times(2.2)}),
        ("accuracy", "3.1 Find from the document's", "I6", {"value": times(11)}),
        ("slotted_link", "5 Find against fields", "E21", {"value": 2e-12}),
        ("accuracy", "Table 7.6", "B5", {"value": times(1 + 1e-11)}),
        ("accuracy", "Table 7.6", "D5", {"value": lambda x: x - 1.1}),
        ("accuracy", "Table 7.9", "E5", {"value": "l2"}),
        ("accuracy", "Checks", "E3", {"value": "FAIL"}),
    ],
)
def test_a_changed_cell_is_seen(worksheet: str, sheet: str, place: str, change: dict) -> None:
    old = exported(worksheet)
    assert list(differences(old, changed(old, sheet, place, change)))


@pytest.mark.parametrize(
    ("worksheet", "sheet", "place", "change"),
    [
        ("hitch", "Checks", "B7", {"value": times(3)}),
        ("hitch", "Checks", "B7", {"value": 0.0}),
        ("hitch", "Residuals fields", "A6", {"value": 5e-16}),
        ("hitch_design", "5.1 Sensitivity of the capacity", "G10", {"value": "8e-09"}),
        ("accuracy", "1.1 Position of the hitch", "C6", {"written": times(2), "value": times(2)}),
        ("accuracy", "1.1 Position of the hitch", "D7", {"value": lambda x: x + 0.4}),
        ("accuracy", "1.1 Position of the hitch", "E6", {"value": times(9)}),
        ("accuracy", "1.1 Position of the hitch", "G6", {"value": "slower, the same digits"}),
        ("accuracy", "7.1 Digits in stiff and extreme", "G5", {"value": 15.6}),  # both are all that a number holds
        ("accuracy", "Table 7.5", "E5", {"value": times(3)}),
        ("accuracy", "1.8 Steps of the integrators", "E5", {"value": times(1.4)}),
        ("accuracy", "3.1 Find from the document's", "H6", {"value": None}),
        ("accuracy", "3.1 Find from the document's", "J6", {"value": "#N/A"}),
        ("slotted_link", "5 Find against fields", "E21", {"value": 9e-16}),
        ("accuracy", "Table 7.6", "D5", {"value": lambda x: x - 0.9}),
    ],
)
def test_what_is_rounding_or_time_may_change(worksheet: str, sheet: str, place: str, change: dict) -> None:
    old = exported(worksheet)
    assert not list(differences(old, changed(old, sheet, place, change)))


def test_a_lost_row_and_a_lost_sheet_are_seen() -> None:
    old = exported("hitch")
    last = max(row for row, _ in old["Checks"])
    short = {at: cell for at, cell in old["Checks"].items() if at[0] < last}
    assert list(differences(old, {**old, "Checks": short})) and list(differences({**old, "Checks": short}, old))
    assert list(differences(old, {title: cells for title, cells in old.items() if title != "Marks"}))


def test_no_formula_rests_on_a_run_time() -> None:
    book = exported("accuracy")
    formulas = [str(cell.written) for cells in book.values() for cell in cells.values()]
    assert len(formulas) > 1000 and not [text for text in formulas if re.search(r"seconds.*[<>=]", text)]


DESIGN = ROOT / "worksheets" / "hitch_design.py"


def with_length(design: Searched, L3: float) -> Searched:
    return design._replace(inputs={**design.inputs, "L3": L3})


def test_another_design_is_as_good_within_the_uncertainty_and_all_else_as_it_was() -> None:
    old = exported("hitch_design")
    chosen, *led = searches(old)
    near = designed(DESIGN, [with_length(chosen, chosen.inputs["L3"] + 1e-4), *led], old)
    assert len(list(differences(old, near))) > 100 and not list(stale(DESIGN, old, near))
    wrong = changed(old, "5.1 Sensitivity of the capacity", "D10", {"value": times(1 + 1e-9)})
    assert list(stale(DESIGN, wrong, near)), "a number of the old design that is not its own"


def test_a_worse_design_is_seen() -> None:
    old = exported("hitch_design")
    chosen, *led = searches(old)
    near = with_length(chosen, chosen.inputs["L3"] + 1e-4)
    for by in (chosen.uncertainty * 1.01, -chosen.uncertainty * 1.01):
        capacity, stability = near.reserves
        far = [near._replace(reserves=(capacity + by, stability + by)), *led]
        assert list(apart(searches(old), far)) and list(apart(far, searches(old)))
    assert not list(apart(searches(old), [near, *led]))
