"""A page where Python took one way of several: only what rests on that way is empty for inputs that go another one."""

import re
from pathlib import Path

import pytest
from own_worksheet import own
from playwright.sync_api import Page, expect

from mechsheet.html import javascript, write
from mechsheet.page import lines
from mechsheet.recording import left_over
from mechsheet.recording.record import record
from mechsheet.worksheet import inputs
from mechsheet.worksheet.cells import Worksheet, load
from mechsheet.worksheet.errors import SheetError
from mechsheet.worksheet.lines import registry

MASK = """y = x**2  # [-] squares
M = np.stack([y, y])
big = M[M > 5.0]  # [-] some of them
s = np.diff(big).sum()  # [-] rests on them
z = y.sum() + len("ab" if g.a < 1 else "a")  # [-] rests on a
v = 2.0 * g.F  # [-] rests on neither
table_2 = table("2", "Some", big)
word = "much" if g.F > 3 else "little"
letters = len(word)  # [-] counted by Python"""
ENDED = {
    "raise": "if v > 6:\n    raise ValueError('too much')",
    "assert": "assert v < 6",
    "stop": "mo.stop(v > 6)",
}
ENDS = "if(inputs.F>3)throw Error('as of a fault in here');"
READ = """() => {
  dispatchEvent(new Event("beforeprint"));
  return Object.fromEntries([...document.querySelectorAll(".ms-line[id]")].map(line => {
    const value = line.querySelector(".ms-value"), why = value.dataset.reason;
    return [line.id.slice(5), [value.textContent, why ?? ""]];
  }));
}"""


def shown(page: Page, path: Path, sheet: Worksheet, address: str = "", **given: float) -> dict[str, tuple[str, str]]:
    """Values of the lines, and why there is none, on the page of a worksheet."""
    path.write_text(write.page(sheet, inputs.build(sheet.inputs, given)), encoding="utf-8")
    page.goto("about:blank")
    page.goto(f"{path.as_uri()}#{address}")
    page.wait_for_selector("body[data-ready]")
    return {name: (value, why) for name, (value, why) in page.evaluate(READ).items()}


@pytest.mark.parametrize("line", ["math.pi - x", "x - np.pi", "x - units.mm", "math.pi - group.transmission_angle"])
def test_a_sum_with_what_a_module_or_a_group_has_is_written(line: str, tmp_path: Path) -> None:
    """There was no page: the size of it was asked for where nothing is recorded any more."""
    lines = "from mechsheet import RRRGroup, units\ngroup = RRRGroup(0j, x, 4.0, 5.0, 1)\nd = "
    sheet = own(tmp_path, f"{lines}{line}  # [-] knee")
    assert "knee" in write.page(sheet, sheet.inputs())


def test_a_page_that_ends_with_an_error_shows_nothing_of_before(blank: Page, tmp_path: Path, monkeypatch) -> None:
    made, begin = javascript.module, "function evaluate(inputs){"
    monkeypatch.setattr(javascript, "module", lambda *given: made(*given).replace(begin, f"{begin}{ENDS}"))
    sheet = own(tmp_path, "v = 2.0 * g.F  # [-] twice")
    value, why = shown(blank, tmp_path / "a.html", sheet, "F=4")["v"]
    assert not value and why and why in (blank.locator(".ms-state").text_content() or "")
    blank.locator("#input-F").fill("1.5")
    assert blank.evaluate(READ)["v"] == ["3", ""]


def test_only_what_rests_on_a_way_that_python_took_is_empty(blank: Page, tmp_path: Path) -> None:
    """The worksheet has no title, and does not say where its inputs stand: they stand where it reads them."""
    sheet = own(tmp_path, MASK)
    here = shown(blank, tmp_path / "a.html", sheet, "F=4")
    state = blank.locator(".ms-state").text_content() or ""
    there = shown(blank, tmp_path / "b.html", sheet, F=4.0)
    empty = {name for name, (value, why) in here.items() if why}
    assert empty == {"big", "s", "letters"} and here.keys() == there.keys()
    assert {name: here[name] for name in here if name not in empty} == {
        n: x for n, x in there.items() if n not in empty
    }
    assert all(not value and "goes another way" in why for value, why in (here[name] for name in empty))
    assert "not known: big, s (line" in state and "letters (line" in state
    assert shown(blank, tmp_path / "a.html", sheet, "F=2.4") == shown(blank, tmp_path / "b.html", sheet, F=2.4)
    assert {n for n, (_, why) in shown(blank, tmp_path / "a.html", sheet, "a=1.5").items() if why} == {"z"}


def test_a_line_that_reads_what_is_not_known_is_named_once(blank: Page, tmp_path: Path) -> None:
    """Its formula with numbers, which is not asked for, was "a text" that is not known."""
    sheet = own(tmp_path, "o = np.argsort(-x)  # [-] order\nb = x[o]  # [-] in order")
    shown(blank, tmp_path / "a.html", sheet, "F=0")
    assert "not known: o, b (line" in (blank.locator(".ms-state").text_content() or "")


TRUTHS = """def ok(m):
    for v in x:
        if v > m:
            return True
    return False
q = ok(g.a * 3)  # [-] of a function
found = False
for v in x:
    if v > g.a * 3:
        found = True
        break
f = found  # [-] of a loop
r = next((True for v in x if v > g.a * 3), False)  # [-] of the first one
b = g.k == 2 or g.a  # [-] one of two
c = g.a > 1 and g.F  # [-] both
z = 2 * g.a  # [-] twice"""


@pytest.mark.parametrize("a", [0.5, 1.5, 9.0])
def test_a_line_may_be_a_truth(a: float, blank: Page, tmp_path: Path) -> None:
    """Where Python's code sets one to True or False the page ended, and showed the numbers of before."""
    sheet = own(tmp_path, TRUTHS)
    assert shown(blank, tmp_path / "a.html", sheet, f"a={a}") == shown(blank, tmp_path / "b.html", sheet, a=a)


def test_a_limit_is_no_key_of_what_is_not_known(blank: Page, tmp_path: Path) -> None:
    """A check whose limit is a whole number was named where that is the number of something not known."""
    limits = ", ".join(f'check("limit {k}", 2.0, at_least={k})' for k in range(10))
    further = [f"from mechsheet import check\ntypeset({limits})"]
    sheet = own(tmp_path, "w = np.i0(g.F) * 1.0  # [-] not followed", further=further)
    shown(blank, tmp_path / "a.html", sheet, "F=4")
    assert "not known: w (line" in (blank.locator(".ms-state").text_content() or "")
    assert blank.locator(".ms-check").count() == 10


def test_a_check_of_which_nothing_is_recorded_is_named(blank: Page, tmp_path: Path) -> None:
    """Its name was made by Python of a number: it was not known, and nothing said so above."""
    lines = "SIZE = {2: 4.77, 3: 6.47, 5: 8.16}\nd = min((d for d in SIZE if d >= g.F), default=5)\nlbl = 'M' + str(d)"
    further = ["from mechsheet import check\ntypeset(check(f'thread {lbl}', SIZE[d], 100.0))"]
    shown(blank, tmp_path / "a.html", own(tmp_path, lines, further=further), "F=4.5")
    assert "not known: thread M3 (it holds" in (blank.locator(".ms-state").text_content() or "")


def test_a_slope_that_is_looked_at_in_fewer_places_says_so(blank: Page, tmp_path: Path) -> None:
    """Its limit was another one as soon as an input was changed, and nothing said why."""
    further = ["from mechsheet import check_slope\ntypeset(check_slope('cosine', np.cos(x), np.sin, x, 0.0, 9.0))"]
    sheet = own(tmp_path, "v = 2 * g.F  # [-] twice", further=further)
    for address, told in (("", ""), ("F=3", "at three of the positions")):
        shown(blank, tmp_path / "a.html", sheet, address)
        assert blank.locator(".ms-check .ms-note").inner_text() == told


def test_what_a_drawing_refuses_is_told(blank: Page, tmp_path: Path) -> None:
    """The worksheet has an error for it; the page drew on, with numbers beside the drawing."""
    drawn = "from mechsheet import Drawing\nwheel = Drawing().wheel(0j, g.a - 0.3)\ny = wheel and 2 * g.a  # [-] beside"
    sheet = own(tmp_path, drawn)
    with pytest.raises(SheetError, match="radius of the wheel"):
        sheet.run(["y"], {"g": sheet.inputs(a=0.2)})
    value, why = shown(blank, tmp_path / "a.html", sheet, "a=0.2")["y"]
    assert not value and "a drawing has an error for a radius" in why
    assert shown(blank, tmp_path / "a.html", sheet, "a=0.5")["y"] == ("1", "")


@pytest.mark.filterwarnings("ignore:invalid value")
def test_lines_that_have_no_number_any_more_are_named(blank: Page, tmp_path: Path) -> None:
    """Beside what is changed, for they may stand anywhere; what has none for the document's own inputs is no news."""
    lines = "c = 1 / (1 / g.F + 1 / g.a)  # [-] in series\nd = c * x  # [-] field\ne = np.log(x - 1)  # [-] part of it"
    sheet = own(tmp_path, lines)
    for F, told in ((0, "changed: F; no number for these inputs: c, d"), (2, "changed: F")):
        shown(blank, tmp_path / "a.html", sheet, f"F={F}")
        expect(blank.locator(".ms-state")).to_have_text(told)


COUNTED = """k = len("ab" if g.a < 1 else "a")  # [-] counted by Python
z = 3 - k  # [-] of it alone
w = x * k + z  # [-] field with it
picture = Drawing().path([0j, 1, 1j * k], "L")"""
SAID = ['caption("1", f"of {k}")', 'mo.md(f"of {k} and {z:.1f}")', "picture"]
EVERYTHING = """() => {
  document.querySelector(".ms-switch").click();
  dispatchEvent(new Event("beforeprint"));
  return [...document.querySelectorAll("[data-n]")].map(e => [e.innerHTML, e.dataset.reason ?? ""]);
}"""


def test_no_number_stands_where_a_guard_is_broken(blank: Page, tmp_path: Path) -> None:
    """Neither in formulas and texts nor in drawings: also those have none that are plain numbers to Python."""
    sheet = own(tmp_path, COUNTED, further=['title_block("Own", "of numbers")', *SAID])
    path, page = Path(sheet.path), tmp_path / "a.html"
    imports = "from mechsheet import Drawing, caption, title_block, "
    path.write_text(path.read_text().replace("from mechsheet import ", f"import marimo as mo\n    {imports}", 1))
    shown(blank, page, load(path), "a=1.5")
    here = blank.evaluate(EVERYTHING)
    shown(blank, page, load(path), a=1.5)
    there = blank.evaluate(EVERYTHING)
    grey = [text for text, why in here if why]
    assert len(grey) == 8 and not any(grey)
    assert all(each == fresh for each, fresh in zip(here, there, strict=True) if not each[1])


WORDED = """word = "much" if g.F > 3 else "little"
letters = len(word)  # [-] counted by Python
y = x * g.a  # [-] field
table_2 = table("2", f"Forces, {word}", y)
figure_2 = figure("2", f"Forces of {letters} letters", x, y)
picture = caption("3", f"of {letters} letters")"""
TEXTS = """() => [...document.querySelectorAll(".ms-caption, .ms-between")].map(
  e => [e.textContent, e.querySelector("[data-reason]")?.dataset.reason ?? ""])"""


def test_a_text_by_a_choice_stands_while_the_choice_is_the_same(blank: Page, tmp_path: Path) -> None:
    """Titles, captions and texts between lines: any other input had emptied them."""
    path = Path(own(tmp_path, WORDED).path)
    text = path.read_text().replace("from mechsheet import ", "from mechsheet import caption, ", 1)
    path.write_text(text.replace(" typeset()", ' typeset(f"A text of {letters} letters.", picture, table_2, figure_2)'))
    sheet = load(path)
    shown(blank, tmp_path / "a.html", sheet)
    own_texts = blank.evaluate(TEXTS)
    assert len(own_texts) == 4 and all("6 letters" in text or "little" in text for text, _ in own_texts)
    shown(blank, tmp_path / "a.html", sheet, "a=1.5")
    assert blank.evaluate(TEXTS) == own_texts
    shown(blank, tmp_path / "a.html", sheet, "F=4")
    for text, why in blank.evaluate(TEXTS):
        if "Table 2" in text:
            assert text.endswith("Forces, much") and not why
        else:
            assert "letters" not in text and "little" not in text and "another way" in why, text


def test_a_field_tells_where_it_is_least_along_positions_that_no_input_changes(blank: Page, tmp_path: Path) -> None:
    """In each of the forms in which engineers write them: only one of them is a quantity in the recording."""
    lines = """p = np.arange(2.5, 360, 25) * math.pi / 180  # [deg] positions
q = np.radians(np.arange(0, 360, 20))  # [deg] others
u = np.array([v + g.F * np.sin(3 * v) for v in p])  # [-] field
w = np.cos(q) * g.F  # [-] field
table_2, table_3 = table("2", "One", p, u), table("3", "Other", q, w)"""
    sheet = own(tmp_path, lines)
    here = shown(blank, tmp_path / "a.html", sheet, "F=4")
    assert here == shown(blank, tmp_path / "b.html", sheet, F=4.0)
    assert "least at p = " in here["u"][0] and "least at q = " in here["w"][0]


@pytest.mark.parametrize("end", ENDED)
def test_a_cell_that_ends_shows_and_gives_nothing(end: str, blank: Page, tmp_path: Path) -> None:
    sheet = own(tmp_path, f"v = 2.0 * g.F  # [-] before\n{ENDED[end]}\nw = 3.0 * g.F  # [-] behind")
    text = (
        Path(sheet.path)
        .read_text()
        .replace("from mechsheet import ask", "import marimo as mo\n    from mechsheet import ask", 1)
    )
    text = text.replace(
        "    return\n\nif",
        "    return v, w\n\n@app.cell\ndef other(g):\n    u = 4.0 * g.F  # [-] elsewhere\n"
        "    typeset()\n    return (u,)\n\n@app.cell\ndef under(w):\n    t = w + 1  # [-] under\n"
        "    typeset()\n    return (t,)\n\nif",
    )
    Path(sheet.path).write_text(text)
    sheet = load(sheet.path)
    page = tmp_path / "a.html"
    assert {name for name, (_, why) in shown(blank, page, sheet, "F=4").items() if why} == {"v", "w", "t", "x"}
    assert not any(why for _, why in shown(blank, page, sheet, "F=2").values())


def test_a_loop_that_does_not_end_on_the_page_says_so(blank: Page, tmp_path: Path) -> None:
    """The harmonic sum is 30 after 6e12 turns."""
    sheet = own(
        tmp_path, "y, k = 0.0, 0\nwhile y < 3 * g.a:\n    k = k + 1\n    y = y + 1 / k\nN = float(k)  # [-] turns"
    )
    assert "has not ended" in shown(blank, tmp_path / "a.html", sheet, "a=10")["N"][1]
    assert shown(blank, tmp_path / "a.html", sheet, "a=2") == shown(blank, tmp_path / "b.html", sheet, a=2.0)


def test_inputs_under_another_name_are_refused(tmp_path: Path) -> None:
    sheet = own(tmp_path, "y = 2 * g.F  # [-] line")
    text = Path(sheet.path).read_text()
    Path(sheet.path).write_text(text.replace("g = read", "h = read").replace("(g,)", "(h,)").replace("(g)", "(h)"))
    with pytest.raises(SheetError, match="no cell gives g"):
        inputs.build(load(sheet.path).inputs, {})


def test_a_study_that_is_imported_and_not_used_leaves_a_page(tmp_path: Path) -> None:
    sheet = own(tmp_path, "y = 2 * g.F  # [-] line")
    path, text = Path(sheet.path), Path(sheet.path).read_text()
    path.write_text(text.replace("import ask, find", "import ask, sweep, find", 1))
    assert not write.studies(load(path))
    path.write_text(path.read_text().replace("y = 2 * g.F", "y = 2 * len(sweep.__name__)"))
    assert write.studies(load(path)) == "sweep"


def test_what_rounding_leaves_is_about_nothing_also_for_other_inputs(blank: Page, tmp_path: Path) -> None:
    """A sum that is nothing but the rounding of its terms, until another input makes it more."""
    lines = (
        "u = 0.1 * g.F  # [m] first\nv = (u + 0.1) - 0.1 - u + (g.a - 0.75)  # [m] rest\n"
        "w = (1 + 1j) * ((u + 0.1) - 0.1 - u)  # [m] of a point"
    )
    sheet = own(tmp_path, lines)
    for address, rest in (("", "≈ 0"), ("F=1.9", "≈ 0"), ("F=1.9&a=1", "0.25")):
        here = shown(blank, tmp_path / "a.html", sheet, address)
        assert (here["v"][0], here["w"][0]) == (f"{rest}\u00a0m", "≈ (0, 0)\u00a0m"), address
        equals = [blank.locator(f"#line-{name} .ms-equals").text_content() for name in ("u", "v")]
        assert equals == ["=", "" if "≈" in rest else "="]
    blank.locator("#input-F").fill("2.5")
    blank.locator("#input-a").fill("0.75")
    expect(blank.locator("#line-v :is(.ms-equals, .ms-value)")).to_have_text(["", "≈ 0 m"])


LEFT = """f = lambda u, a: (u + 0.1) - 0.1 - u + (a - 0.75)
u = 0.1 * g.F  # [m] first
v = f(u, g.a)  # [m] rest, by a function
w = np.array([f(u, 0.75), f(3 * u, g.a)]).sum()  # [m] of several
s = sin(np.pi * g.k) * u  # [m] by the rounding of pi
t = 1e-12 * f(u, 2.0)  # [m] small, and no rounding
p = [f(1e-9 * u, 0.75 + 1e-9)][0]  # [m] the tenth digit of what it adds
q = 3e-13 * u  # [m] small, and no sum"""
NOTHING = {"u": "0.25", "v": "≈ 0", "w": "≈ 0", "s": "≈ 0", "t": "1.25", "p": "1", "q": "7.5"}


def test_what_a_function_leaves_is_about_nothing_and_a_small_number_is_itself(blank: Page, tmp_path: Path) -> None:
    """On the page of the worksheet, which records for it the cells behind a line, and in one file for other inputs."""
    sheet = own(tmp_path, LEFT)
    names = {**sheet.run_whole(), "__file__": sheet.path}
    declared = registry(names)
    own_page = {name: first_number(lines.valued(declared[name], names[name], names)) for name in NOTHING}
    assert own_page == {name: text.removeprefix("≈ ") for name, text in NOTHING.items()}
    assert all(names[name] != 0 for name in NOTHING)
    for address in ("", "F=2.5", "a=0.75"):
        here = shown(blank, tmp_path / "a.html", sheet, address)
        assert {name: first_number(here[name][0]) for name in NOTHING} == NOTHING, address
    assert shown(blank, tmp_path / "a.html", sheet, "a=1")["v"][0] == "0.25\u00a0m"


def test_for_a_product_of_what_is_no_rounding_nothing_is_recorded(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A page of compliances would be recorded line by line at every input."""
    names = {**(sheet := own(tmp_path, LEFT)).run_whole(), "__file__": sheet.path}
    asked = list[str]()
    monkeypatch.setattr(left_over, "record", lambda *_, want, **__: asked.extend(want) or record(names, want=want))
    for name, line in registry(names).items():
        if name in NOTHING:
            lines.valued(line, names[name], names)
    assert "q" not in asked and {"t", "w", "s"} <= {*asked}


def first_number(text: str) -> str:
    found = re.search(r"(≈ )?\d+(\.\d+)?", re.sub("<[^>]*>", "", text))
    return found[0] if found else text


def test_names_of_lines_and_inputs_are_symbols_in_what_lines_mean(tmp_path: Path) -> None:
    """On both pages alike; what is no name of the worksheet stays as it is."""
    text = "u1 = g.F  # [m] first\nv = u1 - 1  # [m] u1 - 1 with phi, bolt M8"
    says = "<span><i>u</i><sub>1</sub> − 1 with <i>φ</i>, bolt M8</span>"
    sheet = own(tmp_path, f"{text}\nt = typeset()")
    assert says in lines.lines(sheet.run_whole()["t"])
    sheet = own(tmp_path, text)
    assert says in write.page(sheet, inputs.build(sheet.inputs, {}))


WORDS = '''import marimo as mo
mo.md(f"""
## 2 Friction

At a force of {g.F:.2f} it is {"small" if g.F < 3 else "large"}.

### 2.1 Case {g.k}
""")'''
TOLD = [  # what is typed, the text and the last heading then
    ("a", "2", "At a force of 2.50 it is small.", "2.1 Case 2"),
    ("F", "2.75", "At a force of 2.75 it is small.", "2.1 Case 2"),
    ("k", "1", "At a force of 2.75 it is small.", "2.1 Case 1"),
    ("F", "4", "At a force of 4.00 it is large.", "2.1 Case 1"),
]


def test_headings_and_texts_of_one_text_follow_each_by_itself(page: Page, tmp_path: Path) -> None:
    """All of it was gone as soon as any input was changed: a text with headings is shown in pieces."""
    sheet = own(tmp_path, "y = g.F * x  # [-] result", further=[WORDS])
    (tmp_path / "own.html").write_text(write.page(sheet, sheet.inputs()), encoding="utf-8")
    page.goto((tmp_path / "own.html").as_uri())
    for name, number, text, case in TOLD:
        page.locator(f"#input-{name}").fill(number)
        expect(page.locator("main :is(h2, h3)")).to_have_text(["2 Friction", case])
        expect(page.locator(".ms-between")).to_have_text([text])


TRAILING = '''import marimo as mo
mo.md(f"""
    The force is {g.F:.2f}.
    {"It is large." if g.F > 3 else ""}
""")'''


def test_a_text_that_ends_in_what_is_nothing_now_follows(page: Page, tmp_path: Path) -> None:
    """It was gone for all other inputs, and nothing said why: it had the end of a line that the page did not show."""
    sheet = own(tmp_path, "y = g.F * x  # [-] result", further=[TRAILING])
    (tmp_path / "own.html").write_text(write.page(sheet, sheet.inputs()), encoding="utf-8")
    page.goto((tmp_path / "own.html").as_uri())
    for number, text in (("2", "The force is 2.00."), ("4", "The force is 4.00. It is large.")):
        page.locator("#input-F").fill(number)
        expect(page.locator(".ms-between")).to_have_text([text])
