"""Every number that a worksheet shows is read back with its unit and compared with the value computed.

The reader of this test shares nothing with what writes: its units stand here.
"""

import ast
import html
import json
import re
from decimal import Decimal
from math import inf, pi
from pathlib import Path
from types import FunctionType

import numpy as np
import pytest

from mechsheet.document import chart, chart_svg
from mechsheet.document.markup import in_words, named
from mechsheet.page.values import html as html_of
from mechsheet.worksheet import inputs
from mechsheet.worksheet.cells import load
from mechsheet.worksheet.check import Check, Summary
from mechsheet.worksheet.errors import raised
from mechsheet.worksheet.find import Found
from mechsheet.worksheet.inputs import Used
from mechsheet.worksheet.lines import Formula
from mechsheet.worksheet.numbers import on_page
from mechsheet.worksheet.symbol import plain, read
from mechsheet.worksheet.table import Column, Figure, Table
from mechsheet.worksheet.typeset import Typeset

WORKSHEETS = sorted(p for p in (Path(__file__).parents[1] / "worksheets").rglob("*.py") if p.stem != "accuracy")
THROUGH_OTHERS = {"accuracy", "hitch_design"}  # they compute through other worksheets and declare few formulas
SI = {
    "m": 1, "cm": 1e-2, "mm": 1e-3, "N": 1, "kN": 1e3, "kgf": 9.80665, "Pa": 1, "MPa": 1e6, "J": 1, "W": 1, "kW": 1e3,
    "s": 1, "kg": 1, "rad": 1, "deg": pi / 180, "°": pi / 180, "%": 0.01, "": 1, "-": 1, "ms": 1e-3, "µs": 1e-6,
    "us": 1e-6, "rpm": 2 * pi / 60, "bar": 1e5, "L": 1e-3, "in": 0.0254, "mil": 2.54e-5, "lbf": 4.4482216152605,
    "ft": 0.3048, "ksi": 6894757.293168361,
}  # fmt: skip
RAISED = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")


def factor(unit: str) -> float:
    """SI value of a unit as it is printed: ``kgf/cm²``, ``N·m``, ``1/(m·s)``, or ``kgf/cm<sup>2</sup>``."""
    unit = re.sub(r"<sup>(.*?)</sup>", r"^\1", unit).replace("−", "-").replace(" ", "")
    unit = re.sub(r"[⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+", lambda m: f"^{m[0].translate(RAISED)}", unit)
    value, sign, inner = 1.0, 1, 0
    for part in re.findall(r"[·/()]|[^·/()]+", unit):
        if part == "/":
            sign = -1
        elif part == "(":
            inner = sign
        elif part == ")":
            sign, inner = 1, 0
        elif part == "·":
            sign = inner or 1
        else:
            name, _, power = part.partition("^")
            value *= (1.0 if name == "1" else SI[name]) ** (sign * float(power or 1))
    return value


RAISED = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")


def as_python(text: str) -> str:
    """A text whose powers of ten are as Python reads them, and the spaces before units as any others."""
    text = re.sub(r"\s·\s10<sup>(.*?)</sup>", r"e\1", text.strip().replace("−", "-").replace("\u00a0", " "))
    return re.sub(r"·10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)", lambda match: f"e{match[1].translate(RAISED)}", text)


def number(text: str) -> tuple[float, float]:
    """Number of a text and half of its last digit."""
    text = as_python(text)
    if text in ("none", "–", "nan"):
        return float("nan"), 0.0
    if "∞" in text:
        return -inf if "-" in text else inf, 0.0
    return float(text), 0.5 * 10.0 ** Decimal(text).as_tuple().exponent


def same(text: str, value: float, unit: str, digits: int = 0) -> bool:
    """Whether a text with a unit says a value in SI, to half its last digit; or to ``digits``, of which zeros at the
    end were left out."""
    read, half = number(text)
    if np.isnan(read) or np.isnan(value):
        return bool(np.isnan(read) and np.isnan(value))
    if np.isinf(read):
        return bool(read == value)
    if digits and value:
        shown = abs(value / factor(unit))
        half = (
            min(half, 0.5 * 10.0 ** (np.floor(np.log10(shown)) - digits + 1)) if shown < 1e5 or shown >= 1e6 else half
        )
    return bool(abs(read * factor(unit) - value) <= (1 + 1e-6) * half * factor(unit) + 1e-12 * abs(value))


VALUE = r"(?:−?[\d.]+(?:\s·\s10<sup>−?\d+</sup>)?|none|−?∞|≈ 0)"
WHERE = r' <span class="ms-where">least at (.*?), greatest at (.*?)</span>'
PLACE = rf"(?:^|, )(\S+) = ({VALUE})(.*?)(?=, \S+ = |$)"


def numbers_in(text: str) -> tuple[list[str], str]:
    """Numbers of the value that ends a formula, all of a few or the ends of many, and their unit."""
    part = rf"{VALUE}(?: … {VALUE})?"
    item = rf"(?:{VALUE}|\({part}, {part}\))"
    match = re.fullmatch(rf"(\[?{item}(?:(?: … |, |; ){item})*\]?)((?:°|\s.*?)?)(?: \(\d+ of \d+ none\))?", text)
    assert match, text
    return re.findall(VALUE, match[1]), match[2].strip()


def shown_of(field: np.ndarray) -> list[complex]:
    """What a line shows of its value: a few numbers, or the ends of many."""
    points = np.iscomplexobj(field)
    if field.size <= (4 if points else 10) or (field.ndim == 2 and max(field.shape) <= 4):
        return field.ravel().tolist()
    if points:
        parts = [part[~np.isnan(part)] for part in (field.real, field.imag)]
        return [end for part in parts for end in (dict.fromkeys((part.min(), part.max())) if part.size else [np.nan])]
    known = field[~np.isnan(field)]
    return list(dict.fromkeys([known.min(), known.max()])) if known.size else [np.nan]


def assert_where(field: np.ndarray, shown: tuple[str, str], names: dict[str, object]) -> None:
    """Where the quantities that are named have those values, and the elements these numbers, is an end of a field.

    Or what differs from it by roundings alone, as at another turn.
    """
    least, greatest = (field[at(field, place, names)] for place in shown)
    known = field[np.isfinite(field)]
    off = 1e-9 * np.ptp(known) if known.size else 0.0
    np.testing.assert_allclose([least.min(), greatest.max()], [np.nanmin(field), np.nanmax(field)], rtol=0, atol=off)


def at(field: np.ndarray, place: str, names: dict[str, object]) -> np.ndarray:
    told, _, elements = place.partition("element ")
    holds, free = np.ones(field.shape, bool), [k for k, n in enumerate(field.shape) if n > 1]
    for name, value, unit in re.findall(PLACE, told.removesuffix(", ")):
        arrays = (np.asarray(x) for key, x in names.items() if named(key) == name)
        (axis,) = (x for x in arrays if x.size > 1 and x.size == max(x.shape) and lies(x, field))
        holds &= np.array([same(value, x, unit.strip(), digits=5) for x in axis.ravel()]).reshape(axis.shape)
        free.remove(field.ndim - axis.ndim + axis.shape.index(axis.size))
    if elements:
        numbers, of = (ast.literal_eval(f"({text.strip('()')},)") for text in elements.split(" of "))
        assert [field.shape[k] for k in free] == [*of]
        for k, number in zip(free, numbers, strict=True):
            holds &= np.moveaxis((np.arange(field.shape[k]) == number - 1)[(...,) + (None,) * (field.ndim - 1)], 0, k)
    return holds


def lies(axis: np.ndarray, field: np.ndarray) -> bool:
    return axis.ndim <= field.ndim and np.broadcast_shapes(axis.shape, field.shape) == field.shape


def product_of_two(row: Formula, names: dict[str, object]) -> float:
    """The largest number that a line may add: of those that it reads the largest, by the next if that is above 1.

    What it has of a function of the worksheet may be of any of its numbers.
    """
    parts = [*ast.walk(row.expression)]
    read = [names.get(node.id) for node in parts if isinstance(node, ast.Name)]
    read += [getattr(names["g"], n.attr, None) for n in parts if isinstance(n, ast.Attribute)]
    called = [names.get(n.func.id) for n in parts if isinstance(n, ast.Call) and isinstance(n.func, ast.Name)]
    if any(isinstance(f, FunctionType) for f in called):
        read = [*names.values()]
    read = [x for x in read if isinstance(x, int | float | complex | np.ndarray)]
    known = [x for x in map(np.asarray, read) if x.dtype.kind in "iufc" and np.isfinite(x).any()]
    sizes = sorted(float(np.nanmax(np.abs(x))) for x in known)
    return sizes[-1] * max([1.0, *sizes[-2:-1]])


def assert_formula(row: Formula, value: object, line: str, names: dict[str, object]) -> int:
    line = re.sub("</?ms-unit[^>]*>", "", re.sub("<ms-value [^>]*><span>(.*?)</span></ms-value>", r"\1", line))
    for where in re.findall(WHERE, line):
        assert_where(np.asarray(value), where, names)
    (shown_value,) = re.findall(r'<span class="ms-value">(.*?)</span>', re.sub(WHERE, "", line))
    texts, unit = numbers_in(shown_value)
    field = np.asarray(value)
    if ">≈<" in line:
        assert set(texts) == {"0"} and 0 < np.abs(field).max() < 4e-15 * product_of_two(row, names), line
        return len(texts)
    shown = shown_of(field)
    values = [p for z in shown for p in ((z.real, z.imag) if np.iscomplexobj(z) else (float(z),))]
    if len(texts) == 1 < len(values):  # which are alike as shown
        values = values[:1]
    assert len(texts) == len(values), line
    for text, x in zip(texts, values, strict=True):
        if text == "≈ 0":
            assert 0 < abs(x) < 4e-15 * np.nanmax(abs(field)), f"{row.name}: {x} is more than its roundings"
            continue
        assert same(text, x, unit, digits=5), f"{row.name}: {text} {unit} is not {x}"
    return len(texts)


def assert_typeset(shown: Typeset) -> int:
    rows = list(zip(shown.rows, shown.values, strict=True))
    lines = html_of(shown).split("ms-line")[1 : len(rows) + 1]
    count = 0
    for (row, value), line in zip(rows, lines, strict=True):
        if isinstance(row, Formula) and not row.arguments:
            assert shown.numbers
            count += assert_formula(row, value, line, dict(shown.numbers.namespace))
    return count


def cells(text: str, tag: str) -> list[str]:
    return [html.unescape(re.sub("<[^>]*>", "", t)) for t in re.findall(rf"<{tag}\b[^>]*>(.*?)</{tag}>", text)]


def assert_table(table: Table, names: dict[str, object]) -> int:
    """Cells against the columns' values, whose unit is the one in the heading; columns against the names' SI values."""
    text, count = table._mime_()[1], 0
    columns = {re.sub("[^A-Za-z0-9±]", "", c.symbol): c for c in table.columns}
    for block in re.findall(r"<table>(.*?)</table>", text):
        head, units_row = re.findall(r"<tr.*?</tr>", block)[:2]
        heads, units_shown = cells(head, "th"), [u.strip("[]") for u in cells(units_row, "th")]
        rows = [cells(row, "td") for row in re.findall(r"<tr>((?:<td).*?)</tr>", block)]
        for i, (name, unit) in enumerate(zip(heads, units_shown, strict=True)):
            greek = {"Φ": "Phi", "φ": "phi", "ω": "omega", "ε": "eps", "Δ": "d", "β": "beta", "α": "alpha",
                     "γ": "gamma", "μ": "mu", "σ": "sigma", "ψ": "psi", "δ": "delta", "θ": "theta", "η": "eta",
                     "λ": "lambda"}  # fmt: skip
            ascii_name = re.sub("[^A-Za-z0-9±]", "", "".join(greek.get(c, c) for c in name))
            column = columns.get(ascii_name) or columns[ascii_name.replace("eps", "epsilon", 1)]
            assert_column(column, unit, names)
            assert abs(factor(unit) / factor(column.unit.replace("**", "^").replace("*", "·")) - 1) < 1e-12
            for row, value in zip(rows, column.values.tolist(), strict=True):
                if column.names:
                    symbol = read(value)
                    said = row[i] == symbol.mark + symbol.base + symbol.index
                elif isinstance(value, str):
                    said = row[i] == on_page(value)
                else:
                    said = same(row[i], value * factor(unit), unit)
                assert said, f"table {table.number}, {name}: {row[i]} is not {value}"
                count += 1
    return count


def assert_column(column: Column, unit: str, names: dict[str, object]) -> None:
    """The whole column against the name of that symbol in SI, where it is shown as it stands."""
    for name, value in names.items():
        if plain(name) == column.symbol and isinstance(value, np.ndarray) and value.size == column.values.size:
            si = np.abs(value.ravel()) if np.iscomplexobj(value) else value.ravel()
            assert np.allclose(column.values * factor(unit), si, rtol=1e-12, atol=0, equal_nan=True), name


def assert_used(used: Used) -> int:
    (told,) = re.findall("<ms-used told='(.*?)'>", used._mime_()[1])
    shown = json.loads(html.unescape(told))
    rows = used.rows()
    for each, (field, _) in zip(shown, rows, strict=True):
        held = getattr(used.g, field.name)
        if isinstance(held, int | float) and not isinstance(held, bool):
            assert same(each["text"], float(held), each["unit"]), field.name
        else:
            assert each["text"] == field.text(held), field.name
    return len(shown)


def assert_check(check: Check) -> int:
    text = html.unescape(re.sub("<[^>]*>", "", as_python(re.sub("texts='[^']*'", "", check._mime_()[1]))))
    if check.agrees:
        within = re.search(r": within (\S+)", text)
        assert within and "PASS" in text
        assert float(within[1].rstrip("°")) == pytest.approx(check.limit, rel=0.051, abs=1e-300)
        return 1
    match = re.search(rf": (\S+) [{'≥<' if check.at_least else '≤>'}] (\S+?)[,;]?(?: |$)", text)
    if not check.evaluated:
        assert "not evaluated" in text
        return 0
    kept = check.residual >= check.limit if check.at_least else check.residual <= check.limit
    assert match and ("PASS" if kept else "FAIL") in text
    compared = [float(t.rstrip("°")) for t in match.groups()]
    assert compared == pytest.approx([check.residual, check.limit], rel=0.051, abs=1e-300)
    return 2


def assert_found(found: Found) -> int:
    text = html.unescape(re.sub("<[^>]*>", "", as_python(found._mime_()[1])))
    unknown = html.unescape(re.sub("<[^>]*>", "", in_words(found.words.unknown, found.names)))
    match = re.search(rf"{re.escape(unknown)} = ([^\s°]+)((?: [^\d\s]+?|°)?)condition", text)
    assert match, text
    digits = match[1].rstrip("0").lstrip("-0.").replace(".", "")
    value = float(match[1]) * factor(match[2].strip())
    assert abs(value / found.value - 1) < 0.51 * 10.0 ** (1 - max(5, len(digits)))
    return 1


def outputs(path: Path, given: dict[str, object]) -> tuple[list[object], dict[str, object]]:
    """What the cells of a worksheet show, each in its last line, and the names of that run of its file.

    Inputs that are given are read in no cell.
    """
    sheet = load(path)
    own = {"g": inputs.build(sheet.inputs, given)} if given else {}
    order = sheet.needed((name for cell in sheet.cells for name in cell.gives if name not in own), own)
    rest = [cell for cell in sheet.cells if cell not in order and own.keys().isdisjoint(cell.gives)]
    shown, names = list[object](), {**sheet.common, **own}
    with raised(), np.errstate(**sheet.errors):
        for cell in [*order, *rest]:
            match cell.lines:
                case (*lines, ast.Expr(last)):
                    exec(compile(ast.Module(lines, []), path, "exec"), names)
                    shown.append(eval(compile(ast.Expression(last), path, "eval"), names))
                case _:
                    exec(cell.code, names)
    return shown, names


BRIEF = {"hitch_design": {"generations": 1, "n_t": 2, "n_mc": 20}}  # a search, whatever it finds, is shown alike


@pytest.mark.parametrize("worksheet", WORKSHEETS, ids=lambda path: path.stem)
def test_every_number_shown_is_the_one_computed(worksheet):
    assert_shown(worksheet, *outputs(worksheet, BRIEF.get(worksheet.stem, {})))


def assert_shown(worksheet: Path, shown: list[object], names: dict[str, object]) -> None:
    """Every number that the cells of a worksheet show is that of its name."""
    counted = dict.fromkeys(["formulas", "tables", "inputs", "checks", "found", "charts"], 0)
    more = [x for o in shown if isinstance(o, Typeset) for x in o.shown]
    for output in [*shown, *more]:
        match output:
            case Typeset():
                counted["formulas"] += assert_typeset(output)
            case Table():
                counted["tables"] += assert_table(output, names)
            case Used():
                counted["inputs"] += assert_used(output)
            case Check():
                counted["checks"] += assert_check(output)
            case Summary():
                counted["checks"] += sum(assert_check(check) for check in output.checks)
            case Found():
                counted["found"] += assert_found(output)
            case Figure():
                counted["charts"] += assert_chart(output)
    least = 0 if worksheet.stem in THROUGH_OTHERS else 15
    assert counted["formulas"] >= least and counted["tables"] > 30 and counted["checks"] >= 5
    assert counted["inputs"] >= 5 or worksheet.stem in BRIEF


def assert_chart(figure: Figure) -> int:
    """What hovering shows, against the columns."""
    svg = chart_svg.svg(chart.line_chart(figure.x, figure.lines, figure.marks, figure.every))
    values = json.loads(html.unescape(re.search("data-values='(.*?)'", svg)[1]))
    columns = [figure.x, *figure.lines]
    for column, texts, unit in zip(columns, values["texts"], values["units"], strict=True):
        for text, value in zip(texts, column.values.tolist(), strict=True):
            assert same(text, value * factor(unit), unit) or not np.isfinite(value)
    return sum(map(len, values["texts"]))


@pytest.mark.parametrize(
    ("text", "si"),
    [("kN", 1e3), ("N·m", 1), ("kgf/cm²", 98066.5), ("rad/s²", 1), ("1/(m·s)", 1), (" cm<sup>2</sup>", 1e-4),
     ("°", pi / 180), (" %", 0.01), (" rad·m<sup>−2</sup>", 1), ("mm⁴", 1e-12)],
)  # fmt: skip
def test_reader_of_units(text, si):
    assert factor(text) == pytest.approx(si, rel=1e-14)


@pytest.mark.parametrize(
    ("unit", "power"),
    [(" mm", 1), (" m", 10)],
)
def test_wrong_unit_or_power_is_found(unit, power):
    assert same("0.25", 0.25, " m", digits=5)
    assert not same("0.25", 0.25 * power, unit, digits=5)
