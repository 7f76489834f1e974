"""A new worksheet in one command: it passes the checks of a worksheet, runs as a script and writes its workbook."""

import subprocess
import sys
from contextlib import suppress
from io import BytesIO
from pathlib import Path
from types import SimpleNamespace

import pytest
from as_script import as_file, as_script, copied
from conftest import alive
from marimo._cli.cli import main as marimo
from openpyxl import load_workbook
from playwright.sync_api import expect

from mechsheet import __main__ as launcher
from mechsheet.page import messages
from mechsheet.recording.dimensions import mismatches

EXAMPLES = Path(launcher.__file__).parents[2] / "worksheets" / "examples"


@pytest.fixture
def lever(tmp_path, monkeypatch, capsys):
    """A worksheet begun in an empty project."""
    (tmp_path / "worksheets").mkdir()
    css = Path(launcher.__file__).parents[2] / "worksheets" / "page.css"
    (tmp_path / "worksheets" / "page.css").write_text(css.read_text(encoding="utf-8"), encoding="utf-8")
    monkeypatch.setattr(launcher, "ROOT", tmp_path)
    monkeypatch.chdir(tmp_path)
    assert launcher.main(["new", "gear_lever"]) == 0
    path = tmp_path / "worksheets" / "gear_lever.py"
    assert str(path) in capsys.readouterr().out
    return path


def test_runs_and_writes_its_workbook(lever):
    done = as_file(lever)
    assert (done.returncode, done.stderr) == (0, "")
    book = load_workbook(lever.parent / "gear_lever.xlsx")
    assert book.sheetnames[:6] == ["Front", "Inputs", "Input tables", "Find", "1 Moment of the lever", "2 Load cases"]
    assert len(book["1 Moment of the lever"]._charts) == 1
    tables = book["Input tables"]  # of one column, under a title and a note that paper has to hold
    *_, last = tables[tables.print_area.split("!")[-1].replace("$", "")][0]
    printed = sum(tables.column_dimensions[letter].width for letter in "ABCD"[: last.column])
    assert printed > 1.4 * len(tables["A1"].value) and 2 * printed > 0.75 * len(tables["A2"].value)
    assert f"A2:{last.column_letter}2" in tables.merged_cells
    changed = as_script(lever, "--F=-5")
    assert changed.returncode == 1 and "F = -5.0 N must be >= 0 N" in changed.stderr


def test_passes_the_checks_of_a_worksheet(lever):
    ruff = [sys.executable, "-m", "ruff", "check", "--select", "F,F821", str(lever)]
    for done in (
        copied(marimo, ["-m", "marimo"], "check", "--strict", lever),
        subprocess.run(ruff, capture_output=True, encoding="utf-8"),
    ):
        assert done.returncode == 0, done.stdout + done.stderr
    assert mismatches(lever) == []


@pytest.mark.parametrize("example", sorted(EXAMPLES.glob("*.py")), ids=lambda path: path.stem)
def test_begins_like_an_example(example, lever, monkeypatch):
    """With all that it reads, under its own title."""
    monkeypatch.setattr(launcher, "folders", lambda: [EXAMPLES])
    assert launcher.main(["new", "my_own", f"--like={example.stem}"]) == 0
    path = lever.parent / "my_own.py"
    done = as_script(path)
    assert (done.returncode, done.stderr) == (0, "")
    assert "units: 0 <= 0" in done.stdout and "not followed" not in done.stdout
    book = load_workbook(BytesIO(path.with_suffix(".xlsx").read_bytes()), read_only=True)  # not all of its cells
    assert book["Front"]["A1"].value == "My own"
    assert "../page.css" not in path.read_text(encoding="utf-8")


def test_shows_its_page(lever, serve, page, console_errors):
    page.goto(serve("run", lever))
    page.get_by_text("2 of 2 checks pass").wait_for()
    for part, count in (
        (page.get_by_role("heading", name="Gear lever"), 1),
        (page.locator(".ms-table"), 2),
        (page.locator("svg.ms-chart"), 1),
        (page.locator(".ms-inputs select"), 1),
    ):
        expect(part).to_have_count(count)
    assert console_errors == []


def test_a_page_whose_server_was_started_anew_says_so(lever, serve, page):
    """Its numbers stayed those of other inputs than it showed, with the word Unauthorized."""
    page.goto(serve("run", lever))
    page.get_by_text("2 of 2 checks pass").wait_for()
    alive(page)
    page.route("**/api/kernel/**", lambda route: route.fulfill(status=401))
    field = page.locator(".ms-inputs tr:has-text('force on the lever') input")
    field.fill("2400")
    field.press("Enter")
    told = page.locator(".ms-anew")
    expect(told).to_contain_text("the server was started anew: this page computes nothing until it is loaded again")
    page.unroute_all()
    told.get_by_role("button", name="load again").click()
    page.get_by_text("2 of 2 checks pass").wait_for()
    expect(told).to_have_count(0)


def test_what_such_a_page_has_begun_is_closed():
    """The editor's page that was loaded again was given a session of which nothing is computed: code alone."""
    closed = []
    sessions = SimpleNamespace(skew_protection_token="new", close_session=closed.append)
    app = SimpleNamespace(state=SimpleNamespace(session_manager=sessions))

    async def answer(*of):
        pass

    for token in ("old", "new"):
        headers = [(b"marimo-server-token", token.encode()), (b"marimo-session-id", f"s_{token}".encode())]
        with suppress(StopIteration):  # nothing is waited for
            messages.Fewer(answer)({"type": "http", "app": app, "headers": headers}, answer, answer).send(None)
    assert closed == ["s_old"]


def test_elements_that_are_made_anew_take_their_attributes(lever, serve, page):
    """marimo sets what is a property of the element instead: a page of a server started anew had no inputs."""
    page.goto(serve("run", lever))
    page.get_by_text("2 of 2 checks pass").wait_for()
    expect(page.locator("ms-grid table")).to_have_count(1)
    found = page.evaluate("""() => [...document.querySelectorAll("*")].flatMap((each) =>
        [...each.attributes].map(({ name }) => name).filter((name) => each.localName.startsWith("ms-") && name in each
        && !(name in HTMLElement.prototype)).map((name) => `${each.localName} ${name}`))""")
    assert found == []


def test_the_style_comes_without_a_style_sheet_and_the_curve_is_smooth(lever, serve, page, console_errors):
    bare = lever.with_name("bare_lever.py")
    bare.write_text(lever.read_text(encoding="utf-8").replace(', css_file="page.css"', ""), encoding="utf-8")
    page.goto(serve("run", bare))
    page.get_by_text("2 of 2 checks pass").wait_for()
    expect(page.locator(".ms-line").first).to_have_css("display", "flex")
    expect(page.locator(".ms-PASS").first).to_have_css("background-color", "rgb(46, 125, 50)")
    curve = page.locator("svg.ms-chart")
    expect(curve.locator("circle")).to_have_count(7)
    assert curve.locator("svg path[stroke-width='1.8']").get_attribute("d").count("L") >= 120
    assert console_errors == []


@pytest.mark.parametrize(
    ("options", "says"),
    [
        ([], "needs the name"),
        (["9th"], "must be a letter"),
        (["../x"], "must be a letter"),
        (["taken"], "there already"),
        (["a", "b"], "needs the name"),
        (["a", "--like"], "needs the name"),
        (["a", "--like=buckt"], "no worksheet buckt: did you mean bucket"),
    ],
)
def test_refuses_in_one_line(tmp_path, monkeypatch, capsys, options, says):
    (tmp_path / "worksheets").mkdir()
    (tmp_path / "worksheets" / "taken.py").write_text("mine", encoding="utf-8")
    monkeypatch.setattr(launcher, "folders", lambda: [EXAMPLES])
    monkeypatch.setattr(launcher, "ROOT", tmp_path)
    monkeypatch.chdir(tmp_path)
    with pytest.raises(SystemExit, match=r"^2$"):
        launcher.main(["new", *options])
    told = capsys.readouterr().err
    assert says in told and told.count("\n") == 1
    assert (tmp_path / "worksheets" / "taken.py").read_text(encoding="utf-8") == "mine"
    assert len(list((tmp_path / "worksheets").iterdir())) == 1
