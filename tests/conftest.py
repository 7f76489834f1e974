"""Programs, servers and pages for the tests; a test is marked by the programs that it uses."""

from __future__ import annotations

import gc
import os
import shutil
import socket
import subprocess
import sys
import time
import tomllib
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from functools import cache, partial
from pathlib import Path
from tempfile import mkdtemp
from types import ModuleType
from typing import TYPE_CHECKING, Any
from urllib.parse import quote

import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis.strategies import just
from office import Office

from mechsheet.units import definitions

if TYPE_CHECKING:
    from playwright.sync_api import Browser, BrowserContext, ConsoleMessage, Locator, Page, ViewportSize

ROOT = Path(__file__).resolve().parents[1]
collect_ignore = ["benchmarks"]  # nothing there is a test, and it needs numba
mpmath.mp.dps = 200  # of what the tests compute exactly themselves, no less than of what they compare it with
# What a program has compiled is kept, as for any user: the tests start hundreds.
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
sys.dont_write_bytecode = False
gc.set_threshold(200_000, 20, 20)  # what many tests hold is not waste: to look through it takes a sixth of their time
WITHIN = 300.0  # seconds for whatever is waited for: on a busy machine it comes late

# Random tests take the same examples in every run, and no time is too long for one: a busy machine is no error.
settings.register_profile("repeatable", derandomize=True, deadline=None)
# --hypothesis-profile=search: other examples in every run, and ten times as many.
settings.register_profile("search", max_examples=1000, derandomize=False, deadline=None, database=None, print_blob=True)
settings.load_profile("repeatable")

COMPUTING = ("numpy.", "mpmath.", "mechsheet.mechanics.", "mechsheet.studies.", "mechsheet.accuracy.")
SIZE: ViewportSize = {"width": 1280, "height": 1000}
OPEN = 3  # worksheets left open for other tests
CHROMIUM_FLAGS = [
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
]


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark tests by their fixtures and by what their file takes from where, so that no mark can be forgotten.

    Those of the editor come first: they share one, each goes on where the one before it ended, and what stands at the
    end of a process's tests is taken over by another process.
    """
    items.sort(key=lambda item: item.path.name != "test_editor.py")
    for item in items:
        fixtures = getattr(item, "fixturenames", ())
        for program, mark in {"chromium": "browser", "soffice": "office"}.items():
            if program in fixtures:
                item.add_marker(mark)
        module = getattr(item, "module", None)
        if module is None or computes(module):  # a doctest has none
            item.add_marker("numeric")


@pytest.hookimpl(trylast=True)
def pytest_collection_finish() -> None:
    """What is loaded by now stays, and is not looked through for waste with what the tests make.

    Nor by hypothesis, which looks for what refers to its numbers as its first test begins: that is here, where the
    least is there to look through.
    """
    settings(max_examples=1, database=None)(given(just(None))(lambda _: None))()
    gc.freeze()


@pytest.hookimpl(tryfirst=True)
def pytest_sessionfinish() -> None:
    """What the tests hold ends with the process: to look through it, as pytest does five times, takes seconds."""
    gc.freeze()


@cache
def computes(module: ModuleType) -> bool:
    """Whether something in the file's namespace is of what computes."""
    names = (getattr(value, "__module__", None) or getattr(value, "__name__", "") for value in vars(module).values())
    return any(f"{name}.".startswith(COMPUTING) for name in names if isinstance(name, str))


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    """Print the rows that tests have recorded: a process of pytest-xdist has no terminal."""
    reports = [*terminalreporter.getreports("passed"), *terminalreporter.getreports("failed")]
    for row in sorted(str(text) for report in reports for kind, text in report.user_properties if kind == "table"):
        terminalreporter.write_line(row)


def program(what: str, *names: str) -> str:
    """Path of the first of the programs that is there; without one a test is skipped, in CI it fails."""
    for path in map(shutil.which, names):
        if path:
            return path
    reason = f"{what} is not on the PATH (looked for {', '.join(names)})"
    if os.environ.get("CI"):
        pytest.fail(reason)
    pytest.skip(reason)


@pytest.fixture(scope="session")
def chromium() -> str:
    """Path of a Chromium or Chrome."""
    return program(
        "Chromium",
        "chromium-headless-shell",
        "chromium",
        "chromium-browser",
        "google-chrome",
        "google-chrome-stable",
        "chrome",
    )


@pytest.fixture(scope="session")
def soffice() -> str:
    """Path of LibreOffice."""
    return program("LibreOffice", "soffice", "libreoffice")


@pytest.fixture(scope="session")
def office(soffice: str, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Office]:
    """A LibreOffice for all workbooks of this process."""
    opened = Office(soffice, tmp_path_factory.mktemp("office"), WITHIN)
    yield opened
    opened.close()


@pytest.fixture
def recalculated_files(office: Office, tmp_path: Path) -> Callable[[list[Path]], list[Path]]:
    """Workbooks as LibreOffice saves them, whatever values are stored in them."""
    out = tmp_path / "recalculated"
    out.mkdir()
    return lambda paths: office.computed(paths, out)


@pytest.fixture
def recalculated_all(office: Office, tmp_path: Path) -> Callable[[list[Path]], list[Any]]:
    """The values of workbooks as LibreOffice computes them."""
    out = tmp_path / "values"
    out.mkdir()
    return lambda paths: [office.values(path, out) for path in paths]


@pytest.fixture
def recalculated(recalculated_all: Callable[[list[Path]], list[Any]]) -> Callable[[Path], Any]:
    """Workbook as LibreOffice computes it, whatever values are stored in it."""
    return lambda path: recalculated_all([path])[0]


@pytest.fixture(autouse=True)
def errors_of_numpy(request: pytest.FixtureRequest) -> Iterator[None]:
    """What a worksheet sets numpy to do about errors holds for the tests of a file that imports it, and no others."""
    imported = any(getattr(value, "__package__", "") == "worksheets" for value in vars(request.module).values())
    of_division = "ignore" if imported else "warn"
    with np.errstate(divide=of_division, over="warn", under="ignore", invalid=of_division):
        yield


@pytest.fixture(autouse=True)
def where_modules_are() -> Iterator[None]:
    """A worksheet's folder is looked through for modules as long as its test runs: thousands end at a system's limit.

    Processes of a pool are told all of them in one argument, and where no folder has a module all are gone through.
    """
    before = list(sys.path)
    yield
    sys.path[:] = before


def examples(count: int, **others: Any) -> settings:
    """Settings of a test that takes so many examples, not the usual 100, and as many times more in a search."""
    return settings(max_examples=count * settings.default.max_examples // 100, **others)


def set_up(folder: Path) -> None:
    """Give a folder the project's settings.

    The library stays as it is meanwhile: each editor would take six seconds of a processor to find out what to look at
    for changes.
    """
    settings = (ROOT / "pyproject.toml").read_text("utf-8")
    (folder / "pyproject.toml").write_text(settings.replace('auto_reload = "autorun"', ""), "utf-8")


def placed(worksheet: Path, folder: Path) -> Path:
    """A copy of the worksheet in a folder with the project's settings: what the editor saves stays out of the project.

    Those beside it are there for one that reads them.
    """
    set_up(folder)
    shutil.copytree(ROOT / "worksheets", folder / "worksheets", ignore=shutil.ignore_patterns("__*__"))
    if worksheet.is_relative_to(ROOT / "worksheets"):
        return folder / worksheet.relative_to(ROOT)
    for beside in (*worksheet.parent.glob("*.csv"), *worksheet.parent.glob("*.toml")):
        shutil.copy(beside, folder / "worksheets")
    return Path(shutil.copy(worksheet, folder / "worksheets"))


@contextmanager
def marimo_server(mode: str, shown: Path, folder: Path) -> Iterator[str]:
    """Address of ``marimo run`` or ``marimo edit`` of a worksheet, or of a folder of them, run in a folder."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    options = ["--headless", "--no-token", "--host=127.0.0.1", f"--port={port}"]
    if mode == "edit":
        options += ["--skip-update-check"]
    if mode == "edit" or shown.is_dir():  # as ``mechsheet edit`` does, and to see what comes into a folder later
        options += ["--watch"]
    # A configuration folder of its own: the settings of whoever runs the tests must not change the page.
    environment = {**os.environ, "XDG_CONFIG_HOME": str(folder), "PYTHONUTF8": "1"}
    with (folder / "server.log").open("w+", encoding="utf-8") as log:
        server = subprocess.Popen(
            [sys.executable, "-m", "marimo", mode, *options, shown],
            cwd=folder,
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=log,
            stderr=subprocess.STDOUT,
        )
        try:
            deadline = time.monotonic() + WITHIN
            while not answers(port):
                if server.poll() is not None or time.monotonic() > deadline:
                    log.seek(0)
                    pytest.fail(f"marimo {mode} {shown.name} did not start:\n{log.read()}")
                time.sleep(0.1)
            yield f"http://127.0.0.1:{port}"
        finally:
            server.terminate()
            try:
                server.wait(timeout=15)
            except subprocess.TimeoutExpired:
                server.kill()
                server.wait()


def installed(folder: Path) -> str:
    """Search path of a process for which the package is installed, in a folder, with the entry points it declares."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    told = folder / "mechsheet-0.dist-info"
    told.mkdir(exist_ok=True)
    (told / "METADATA").write_text("Metadata-Version: 2.1\nName: mechsheet\nVersion: 0\n")
    groups = project["entry-points"].items()
    texts = (f"[{group}]\n" + "".join(f"{name} = {at}\n" for name, at in points.items()) for group, points in groups)
    (told / "entry_points.txt").write_text("".join(texts))
    return os.pathsep.join([str(folder), *filter(None, sys.path)])


def answers(port: int) -> bool:
    with socket.socket() as connection:
        return connection.connect_ex(("127.0.0.1", port)) == 0


@pytest.fixture
def own_units() -> Iterator[None]:
    """Units that the test defines are forgotten behind it, and not those of worksheets that are loaded already."""
    before = dict(definitions._own)
    yield
    definitions._own.clear()
    definitions._own.update(before)
    definitions.known.cache_clear()
    definitions._unknown.cache_clear()
    definitions.single.cache_clear()


@pytest.fixture(scope="session")
def serve(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Callable[[str, Path], str]]:
    """``serve("run" or "edit", worksheet)``: its address, at one marimo server for all that run and one for the others.

    All who open an editor see what one of them has typed: there each has a copy of its own.
    """
    with ExitStack() as servers:

        @cache
        def shown(mode: str) -> tuple[Path, str]:
            folder = tmp_path_factory.mktemp(mode)
            set_up(folder)
            return folder, servers.enter_context(marimo_server(mode, folder, folder))

        def copied(mode: str, worksheet: Path) -> str:
            folder, server = shown(mode)
            return f"{server}/?file={quote(str(placed(worksheet, Path(mkdtemp(dir=folder)))))}"

        running = cache(partial(copied, "run"))
        yield lambda mode, worksheet: running(worksheet) if mode == "run" else copied(mode, worksheet)


@pytest.fixture(scope="session")
def browser(chromium: str) -> Iterator[Browser]:
    """A headless browser on a profile of its own."""
    from playwright.sync_api import expect, sync_playwright

    expect.set_options(timeout=WITHIN * 1000)
    with sync_playwright() as playwright:
        started = playwright.chromium.launch(executable_path=chromium, args=CHROMIUM_FLAGS, timeout=WITHIN * 1000)
        yield started
        started.close()


@cache
def profile(browser: Browser) -> BrowserContext:
    """Where all pages of worksheets are: what is compiled for one need not be for the next, a third of its opening."""
    context = browser.new_context(viewport=SIZE, locale="en-US")
    context.set_default_timeout(WITHIN * 1000)
    return context


@cache
def given_back(browser: Browser) -> list[Page]:
    """Pages that nobody uses now: one that has shown a worksheet shows the next for two fifths of the work."""
    return []


@contextmanager
def new_page(browser: Browser) -> Iterator[Page]:
    """A page of which nothing is left of who had it before, wide enough for a worksheet."""
    others = given_back(browser)
    page = others.pop() if others else profile(browser).new_page()
    yield page
    emptied(page)
    others.append(page)


def emptied(page: Page) -> None:
    """Leave nothing of what a page has shown, and has been told."""
    page.unroute_all(behavior="ignoreErrors")
    if page.url.startswith("http"):
        page.evaluate("sessionStorage.clear()")
    page.goto("about:blank")
    page.set_viewport_size(SIZE)
    page.emulate_media(media="null", color_scheme="null")


@pytest.fixture
def page(browser: Browser) -> Iterator[Page]:
    """A page of the test's own."""
    with new_page(browser) as page:
        yield page


@pytest.fixture(scope="session")
def pages(
    browser: Browser, serve: Callable[[str, Path], str]
) -> Iterator[tuple[Callable[[Path, str], Page], list[str]]]:
    """Pages that many tests use in turn, and what they report as errors."""
    known: dict[Path, Page] = {}
    in_the_end = ExitStack()
    fresh: dict[Path, object] = {}
    errors: list[str] = []

    def state(page: Page) -> object:
        of_user = page.locator("input, select, details, [role=slider], .ms-chosen, .ms-told")
        return of_user.evaluate_all("all => all.map(e => [e.value, e.checked, e.ariaValueNow, e.open, e.className])")

    def opened(worksheet: Path, text: str) -> Page:
        if worksheet in known:
            page = known.pop(worksheet)
        elif len(known) < OPEN:
            page = in_the_end.enter_context(new_page(browser))
            report_errors(page, errors)
        else:  # of what was looked at longest ago
            former = next(iter(known))
            page = known.pop(former)
            fresh.pop(former, None)
            emptied(page)
        known[worksheet] = page
        page.bring_to_front()  # one that is behind others may draw nothing
        if worksheet not in fresh or state(page) != fresh[worksheet]:
            page.goto(serve("run", worksheet))
            page.get_by_text(text).first.wait_for()
            alive(page)
            fresh[worksheet] = state(page)
        page.evaluate("scrollTo(0, 0)")
        return page

    with in_the_end:
        yield opened, errors


@pytest.fixture
def left_open(pages: tuple[Callable[[Path, str], Page], list[str]]) -> Iterator[Callable[[Path, str], Page]]:
    """``left_open(worksheet, text)``: a page of ``marimo run`` with that text on it, left open for other tests.

    It is opened again where a test has left something typed, moved, switched or told. An error of it fails the test.
    """
    opened, errors = pages
    yield opened
    said = errors.copy()
    errors.clear()
    assert said == []


@pytest.fixture(scope="module")
def blank(browser: Browser) -> Iterator[Page]:
    """A page with nothing on it, and no network."""
    with browser.new_context(viewport=SIZE, offline=True) as context:
        context.set_default_timeout(WITHIN * 1000)
        yield context.new_page()


def until(page: Page, holds: Callable[[], bool], otherwise: str) -> None:
    """Wait for a state of the page that no locator can wait for."""
    deadline = time.monotonic() + WITHIN
    while not holds():
        assert time.monotonic() < deadline, otherwise
        page.wait_for_timeout(100)


def in_sight(at: Locator) -> None:
    """Scroll to what may be drawn anew meanwhile, which playwright takes for an error."""
    from playwright.sync_api import Error

    def reached() -> bool:
        with suppress(Error):
            at.scroll_into_view_if_needed()
            return True
        return False

    until(at.page, reached, "it does not stay")


def drawn(page: Page) -> None:
    """Wait until the page has nothing left to do and has drawn what was done.

    A second is enough for what is left: now and then Chromium has nothing to do and finds no idle time either.
    """
    page.bring_to_front()  # one that is behind others may draw nothing
    page.wait_for_function(
        "() => new Promise(done => requestIdleCallback("
        "() => requestAnimationFrame(() => setTimeout(done, 0, true)), {timeout: 1000}))"
    )


def alive(page: Page) -> None:
    """Wait until a page of a worksheet answers: its texts are seen before its scripts are there."""
    page.wait_for_function("() => customElements.get('ms-numbers')")
    drawn(page)


@pytest.fixture
def console_errors(page: Page) -> list[str]:
    """What the page has reported as errors so far."""
    errors: list[str] = []
    report_errors(page, errors)
    return errors


def report_errors(page: Page, errors: list[str]) -> None:
    """Let a page add what it reports as errors.

    Not among them: half a minute after it is opened, marimo's editor reports that the language server of a completion
    which is switched off has not answered.
    """

    def reported(message: ConsoleMessage) -> None:
        if message.type == "error" and not message.text.startswith("Language server initialization failed RPCError"):
            errors.append(message.text)

    page.on("console", reported)
    page.on("pageerror", lambda error: errors.append(str(error)))
