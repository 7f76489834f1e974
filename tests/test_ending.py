"""How a run ends that cannot go on: one line, no traceback, and the exit code that a shell expects."""

from __future__ import annotations

import ast
import os
import re
import shlex
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import suppress
from functools import partial
from pathlib import Path
from types import ModuleType
from typing import IO, Any
from unittest.mock import MagicMock

import pytest
from as_script import as_file, as_launched, as_script

from mechsheet import __main__ as launcher
from mechsheet.recording.evaluation import evaluate
from mechsheet.run import batch, compare, html, index, rename, script
from mechsheet.studies import asked_design
from mechsheet.worksheet.caret import caret
from mechsheet.worksheet.errors import SheetError

TEMPLATE = (Path(launcher.__file__).parent / "run" / "new_worksheet.txt").read_text(encoding="utf-8")
LAUNCHED = [sys.executable, "-m", "mechsheet", "run"]
# Two links that do not meet; the cells in front of the check draw and reduce what is not there.
OPEN = TEMPLATE.replace("one_of, read,", "assembled, one_of, read,").replace(
    """@app.cell
def workbook():""",
    """@app.cell
def drawn(g):
    reached = max([x for x in linspace(g.L, g.L, 3) if x < 0])
    return (reached,)


@app.cell
def closing(g, phi):
    closes = assembled("links meet", 0 * phi * float("nan"), phi, (g.L, g.L), "angle phi", "deg")
    return (closes,)


@app.cell
def workbook():""",
)


@pytest.fixture
def lever(tmp_path: Path) -> Callable[..., Path]:
    """A worksheet from the template with some of its text replaced."""

    def written(old: str = "", new: str = "", text: str = TEMPLATE) -> Path:
        path = tmp_path / "lever.py"
        assert old in text
        path.write_text(text.replace(old, new, 1).replace("TITLE", "Lever"), encoding="utf-8")
        return path

    return written


Start = Callable[..., subprocess.CompletedProcess[str]]
Opened = Callable[[], IO[str]]


launched = partial(as_launched, "run")
ways = pytest.mark.parametrize("start", [as_file, launched], ids=["python", "launcher"])


def ends(done: subprocess.CompletedProcess[str], says: str, code: int = 1) -> None:
    assert done.stderr.rstrip("\n") == says and done.returncode == code, done.stderr


@pytest.mark.parametrize(
    ("program", "given", "says", "code"),
    [
        (script, "--FF=5", "input FF is unknown; nearest: F", 2),
        (script, "--F=much", "F = 'much' N is no number", 2),
        (script, "'--F=5 apples'", "F = '5 apples': ", 2),
        (script, "--fast", "argument '--fast' must be --NAME=VALUE", 2),
        (script, "--proof=99", "must be a number of digits, 1..15", 2),
        (script, "--scene=none.toml", "scene none.toml cannot be read", 2),
        (script, "--scene=odd.toml", "input FF is unknown; nearest: F", 2),
        (script, "--scene=limited.toml", "odd is declared by no line with its unit", 2),
        (script, "--want=M_SS", "M_SS is defined by no cell of", 2),
        (script, "--want=M", "M is a function of phi", 2),
        (script, "'--want=no check'", "no check is named 'no check'", 2),
        (script, "--F=-5", "F = -5.0 N must be >= 0 N", 1),
        (script, "--scene=small.toml", "F = -5.0 N must be >= 0 N", 1),
        (script, "--out=odd.toml", "folder odd.toml cannot be made", 1),
        (batch, "--jobs=0 small.toml", "jobs = 0 must be a number of processes", 2),
        (batch, "--fast small.toml", "argument '--fast' must be --NAME=VALUE", 2),
        (batch, "small.toml small.toml", "scene small.toml has the name of small.toml", 2),
        (html, "--want=M_S", "a page in one file holds the whole worksheet", 2),
        (html, "--FF=5", "input FF is unknown; nearest: F", 2),
        (html, "--F=-5", "F = -5.0 N must be >= 0 N", 1),
        (index, "(1.26)", "argument '(1.26)': index takes a worksheet and nothing else", 2),
        (rename, "F", "rename takes a worksheet, a symbol and its new name", 2),
        (rename, "FF G", "'FF' is no symbol of lever.py; nearest: F", 2),
        (compare, "small.toml", "compare takes a worksheet, two states and --markdown", 2),
        (compare, "none.toml none.toml", "scene none.toml cannot be read", 2),
        (asked_design, "--vary=F=1..2", "design takes one --best=", 2),
        (asked_design, "'--need=max sigma <= 9'", "nothing is varied", 2),
        (asked_design, "--vary=F=2..1 --need='max sigma <= 9'", "must be in order", 2),
        (asked_design, "--vary=FF=1..2 --need='max sigma <= 9'", "input FF is unknown; nearest: F", 2),
        (asked_design, "--vary=F=1..2 --need='max sigmas <= 9'", "sigmas is defined by no cell of", 2),
        (asked_design, "--vary=F=1..2 --need='M_S = 9'", "M_S has 7 positions: min or max M_S", 2),
        (asked_design, "--vary=F=1..2 --need='max sigma <= much'", "= 'much' MPa is no number", 2),
        (asked_design, "--vary=F=1..2 --need='max sigma = 1'", "is outside", 1),
    ],
    ids=lambda x: x.__name__.rpartition(".")[2] if hasattr(x, "__name__") else str(x),
)
def test_what_is_given_and_cannot_be_used_ends_in_2_and_what_the_worksheet_refuses_in_1(
    program: ModuleType,
    given: str,
    says: str,
    code: int,
    lever: Callable[..., Path],
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    scenes = {"odd": "[inputs]\nFF = 5", "small": "[inputs]\nF = -5", "limited": "[limits]\nodd = {max = 1}"}
    path = lever()
    monkeypatch.chdir(path.parent)
    for name, text in scenes.items():
        Path(f"{name}.toml").write_text(text, encoding="utf-8")
    monkeypatch.setattr(sys, "argv", ["mechsheet", str(path), *shlex.split(given)])
    monkeypatch.setattr(sys, "excepthook", sys.excepthook)
    monkeypatch.setattr(script, "gc", MagicMock())  # the process goes on
    with pytest.raises(SystemExit) as end:
        try:
            program.main()
        except Exception as error:  # as Python ends then
            sys.excepthook(type(error), error, None)
    told = capsys.readouterr()
    assert end.value.code == code and says in told.err and told.err.count("\n") == 1, told
    assert not list(path.parent.glob("*.xlsx"))


@ways
def test_every_way_to_start_ends_in_the_same_code(start: Start, lever: Callable[..., Path]) -> None:
    ends(start(lever(), "--FF=5"), "error: input FF is unknown; nearest: F", 2)


def test_scenes_that_cannot_be_used_end_in_2_when_the_others_are_computed(
    lever: Callable[..., Path], capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    path = lever()
    monkeypatch.chdir(path.parent)
    texts = {"good": "F = 1000", "odd": "FF = 5", "small": "F = -5"}
    for name, text in texts.items():
        Path(f"{name}.toml").write_text(f"[inputs]\n{text}", encoding="utf-8")
    for names, code in (("good", 0), ("good small", 1), ("good odd", 2), ("good small odd", 2), ("good gone", 2)):
        assert batch.run(str(path), [f"{name}.toml" for name in names.split()]) == code, names
        assert f"1 of {len(names.split())} scenes pass" in capsys.readouterr().out


@ways
@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        (
            "M_S = M(phi)",
            "M_S = M(phii)",
            "line 90, M_S = M(phii): the name phii is not defined in any cell (did you mean phi?)",
        ),
        ("g.F * g.L", "g.F * g.LL", "line 88, return g.F * g.LL * sin(phi): there is no input LL (did you mean L?)"),
        ("M_S = M(phi)", "M_S = 1 / 0", "line 90, M_S = 1 / 0: division by zero"),
        ("0.35", "0.35 * xm", "line 47, L: float = 0.35 * xm: the name xm is not defined in any cell"),
    ],
    ids=["name", "input", "number", "name in the inputs"],
)
def test_a_mistake_is_told_with_its_line_in_the_words_of_the_editor(
    start: Start, old: str, new: str, says: str, lever: Callable[..., Path]
) -> None:
    ends(start(lever(old, new)), f"error: lever.py, {says}")


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        ("M_S = M(phi)", "M_S = M(phi)^2.0", "a power is written **, not ^"),
        ("M_S = M(phi)", "M_S = M(phi) * 10^3", "10 ^ 3: a power is written **, not ^"),
        ("M_S = M(phi)", "_k = 2*10^3\n    M_S = _k * M(phi)", "2 * 10 ^ 3: a power is written **, not ^"),
        ("M_S = M(phi)", "M_S = phi(2)", "is a * missing before the bracket?"),
        ("M_S = M(phi)", "M_S = M(phi) * k\n    k = 2", "k is defined below its use: move its line up"),
        ("M_S = M(phi)", "M_S = M(phi) * _k\n    _k = 2", ": _k is defined below its use: move its line up"),
        ("M_S = M(phi)", "def _f(x): return x\n    M_S = _f()", ": _f is called without x"),
        ("M_S = M(phi)", "M_S = M(phi, g.F)", ": M is called with 2 values, and takes 1\n"),
        ("M_S = M(phi)", "drawn(M)\n    M_S = M(phi)", "the name drawn is not defined in any cell"),
        ("M_S = M(phi)", "k = 1,5\n    M_S = k * g.F", "a decimal number has a point, not a comma"),
        ("M_S = M(phi)", "M_S = 1,5 * g.F", "M_S = 1, 5 * g.F is several values: a decimal number has a point"),
        ("M_S = M(phi)", "M_S = 0,02 * g.F", "a decimal number has a point, not a comma"),
        ("M_S = M(phi)", "M_S = 2 * (1,5 + M(phi))", "a decimal number has a point, not a comma"),
        ("M_S = M(phi)", "M_S = M(sin(0,5))", "a decimal number has a point, not a comma"),
        ("M_S = M(phi)", "M_S = 2 * (1,5)  # [N] wrong\n    typeset()", "M_S = 2 * (1, 5) is several values"),
        (
            "M_S = M(phi)",
            "x = [1, 2]\n    M_S = x * g.F",
            "(x is a list: np.array([..]) is multiplied element by element",
        ),
        ("M_S = M(phi)", "_x = [1, 2]\n    M_S = _x / g.F", "(_x is a list: np.array([..]) is computed element by"),
        ("M_S = M(phi)", "x = [1, 2]\n    M_S = x + 1.5", "(x is a list: np.array([..]) is computed element by"),
        ("M_S = M(phi)", "M_S = [1, 2] * g.F", "([..] is a list: np.array([..]) is multiplied element by element"),
        ("M_S = M(phi)", "k = 1,5\n    M_S = k + 2.0", "(several values stand there: a decimal number has a point"),
        ("M_S = M(phi)", "M_S := M(phi)", "a definition is written =, not :="),
        ("M_S = M(phi)", "if g.F < 0: j = 1\n    M_S = j", "j has no value there: none of the ways"),
        ("M_S = M(phi)", "M_S = 2 M(phi)", "is a * missing?"),
        ("M_S = M(phi)", "M_S = 2M(phi)", "is a * missing? 2 * M"),
        ("M_S = M(phi)", "M_S = {phi: 1}", "an array, a list or a table can be no key"),
        ("M_S = M(phi)", "k = find(sin, 0, 1); M_S = k * M(phi)", "what a Find has found is its .value"),
        ("M_S = M(phi)", "k = find(sin, 0, 1); M_S = sin(k)", "what a Find has found is its .value"),
        ("M_S = M(phi)", "M_S = sum(g)", "inputs are read by their names"),
        ("M_S = M(phi)", "M_S = g[0]", "inputs are read by their names"),
        ("M_S = M(phi)", "M_S = len(g)", "inputs are read by their names"),
        ("M_S = M(phi)", "M_S, k = g", "inputs are read by their names"),
    ],
)
def test_what_mathcad_took_is_told_in_words(old: str, new: str, says: str, lever: Callable[..., Path]) -> None:
    done = as_script(lever(old, new))
    assert done.returncode == 1 and says in done.stderr and done.stderr.count("\n") == 1, done.stderr
    assert re.search(r"line 9[01]\b", done.stderr)


def test_a_class_that_is_not_marked_and_an_argument_twice_are_told_in_words(lever: Callable[..., Path]) -> None:
    done = as_script(lever("@inputs\nclass Given:", "class Given:"))
    assert done.returncode == 1 and "ask takes a class of inputs: write @inputs above Given" in done.stderr
    done = as_script(lever("def M(phi):", "def M(phi, phi):"))
    assert done.returncode == 1 and re.search("duplicate .* 'phi' in function definition\n", done.stderr), done.stderr


def test_a_declaration_is_told_with_its_line(lever: Callable[..., Path]) -> None:
    path = lever("[m] length", "metres, length")
    done = as_script(path)
    says = f"error: {path.name}, line 47: input L needs a comment with its unit, such as # [m] meaning\n"
    assert (done.stderr, done.returncode) == (says, 1)


@pytest.mark.parametrize(
    ("old", "new"),
    [("F: float = 1200.0", "F: float = 2 * 10^3"), ("    STEELS = {", "    K = 2 * 10^3\n    STEELS = {")],
)
def test_a_power_of_whole_numbers_by_a_caret_is_refused_in_inputs_and_setup(
    old: str, new: str, lever: Callable[..., Path]
) -> None:
    """2 * 10^3 was 23, without a word."""
    done = as_script(lever(old, new))
    assert done.returncode == 1 and ", 2 * 10 ^ 3: a power is written **, not ^\n" in done.stderr


@pytest.mark.parametrize("new", ["g.N ^ g.K", "k ^ g.K", "int(g.N) ^ len([1])", "g.N + g.K ^ k"])
def test_a_power_of_whole_inputs_by_a_caret_is_refused(new: str, lever: Callable[..., Path]) -> None:
    """Of 2 and 3 it was 1, without a word."""
    path = lever("    F: float = 1200.0", "    N: int = 2  # [-] n\n    K: int = 3  # [-] k\n    F: float = 1200.0")
    text = path.read_text(encoding="utf-8").replace(
        "    n = 2 if", f"    k = 3\n    m = {new}  # [-] power\n    n = 2 if"
    )
    path.write_text(text, encoding="utf-8")
    done = as_script(path)
    assert done.returncode == 1 and f", {new}: a power is written **, not ^; " in done.stderr


@pytest.mark.parametrize("new", ["(g.F > 2) ^ g.both", "(not g.both) ^ g.both", "isnan(g.F) ^ g.both", "{1} ^ s"])
def test_one_of_two_conditions_is_no_power(new: str) -> None:
    assert caret(ast.parse(f"m = {new}").body[0]) == (0, "")


def test_a_mark_of_byte_order_is_told(lever: Callable[..., Path]) -> None:
    path = lever("", "")
    path.write_text("\ufeff" + path.read_text(encoding="utf-8"), encoding="utf-8")
    why = "the file begins with a byte order mark (BOM), which Python's editors refuse: save it as UTF-8 without one"
    assert as_script(path).stderr == f"error: {path.name}, line 1, import marimo: {why}\n"


def test_what_python_cannot_read_is_told_with_its_line(lever: Callable[..., Path]) -> None:
    path = lever("summary(within, strong)", "summary(within, strong")
    assert as_script(path).stderr == f"error: {path.name}, line 30, summary(within, strong: '(' was never closed\n"


@ways
def test_where_it_does_not_close_nothing_behind_it_speaks(start: Start, lever: Callable[..., Path]) -> None:
    path = lever(text=OPEN)
    says = "links meet: no position closes for angle phi = 0 deg: it reaches 20.05352..20.05352 deg"
    ends(start(path), f"error: {says}")
    with pytest.raises(SheetError, match=says):
        evaluate(path, ["reached"])
    assert not path.with_suffix(".xlsx").exists()


@ways
def test_an_input_in_the_wrong_unit_is_told_where_what_comes_of_it_ends_the_run(
    start: Start, lever: Callable[..., Path]
) -> None:
    """The error alone would send its reader to another line; one that is given is not the one that stands there."""
    text = TEMPLATE.replace("M_max: float = 300.0", "M_max: float = 1e12")
    path = lever("L: float = 0.35  # [m]", "L: float = 350.0  # [mm]", text)
    told = start(path)
    assert "L = 350000 mm; 350.0 is taken in m" in told.stderr.splitlines()[0] and told.stderr.count("\n") == 2
    assert "is outside" in told.stderr.splitlines()[1] and told.returncode == 1
    assert start(path, "--L=350").stderr.count("\n") == 1


def test_an_exception_that_no_check_explains_stays_what_it_is(lever: Callable[..., Path]) -> None:
    with pytest.raises(ValueError, match=r"max\(\)"):
        evaluate(lever(', phi, (g.L, g.L), "', ', phi, (g.L, g.L), "', OPEN.replace('* float("nan")', "")), ["reached"])


def unread() -> IO[str]:
    """A pipe whose reader has gone."""
    end, into = os.pipe()
    os.close(end)
    return open(into, "w", encoding="utf-8")


def full() -> IO[str]:
    return open("/dev/full", "w", encoding="utf-8")


@ways
@pytest.mark.skipif(os.name == "nt", reason="files of Unix")
@pytest.mark.parametrize(
    ("streams", "given", "says", "code"),
    [
        ({"out": unread}, [], "", 141),
        ({"out": full}, [], "error: standard output cannot be written: No space left on device\n", 1),
        ({"out": full, "err": full}, ["--F=-5"], "", 1),
    ],
    ids=["no reader", "full", "all full"],
)
def test_standard_output_that_takes_nothing(
    start: Start, streams: dict[str, Opened], given: list[str], says: str, code: int, lever: Callable[..., Path]
) -> None:
    opened = {name: made() for name, made in streams.items()}
    done = start(lever(), *given, **opened)
    assert (done.returncode, done.stderr) == (code, says)
    for stream in opened.values():
        with suppress(OSError):  # of what the tests themselves have left in it, which is nothing
            stream.close()


def without_reader(command: str) -> tuple[int, str]:
    """How a command ends whose reader has gone before it begins, and what it tells of that."""
    reader, writer = os.pipe()
    os.close(reader)
    try:
        shell = ["bash", "-c", f"{command}; exit $?"]
        done = subprocess.run(shell, stdout=writer, stderr=subprocess.PIPE, encoding="utf-8")
    finally:
        os.close(writer)
    return done.returncode, done.stderr


@pytest.mark.skipif(os.name == "nt", reason="a shell of Unix")
def test_a_process_whose_reader_has_gone_ends_in_silence(lever: Callable[..., Path]) -> None:
    assert without_reader(f"{' '.join(LAUNCHED)} {lever()}") == (141, "")
    assert without_reader(f"{sys.executable} -m mechsheet --help") == (141, "")


@pytest.mark.skipif(os.name == "nt", reason="a shell of Unix")
@pytest.mark.parametrize(
    ("shell", "says", "code"),
    [
        ("{} > /dev/full", "No space left on device", 1),
        ("{} >&-", "", 0),
    ],
)
def test_the_help_needs_no_reader_either(shell: str, says: str, code: int) -> None:
    command = shell.format(f"{sys.executable} -m mechsheet --help")
    done = subprocess.run(["bash", "-c", command], capture_output=True, encoding="utf-8")
    assert (done.returncode, done.stderr) == (code, f"mechsheet: standard output: {says}\n" if says else "")


@pytest.mark.skipif(os.name == "nt", reason="a shell of Unix")
def test_closed_standard_output_is_no_error(lever: Callable[..., Path]) -> None:
    path = lever()
    done = subprocess.run(["bash", "-c", f"{' '.join(LAUNCHED)} {path} >&-"], capture_output=True, encoding="utf-8")
    assert (done.returncode, done.stderr) == (0, "") and path.with_suffix(".xlsx").exists()


@pytest.fixture
def interrupted() -> Iterator[None]:
    """Ctrl-C interrupts, which tests in the background of a shell ignore."""
    kept = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, kept)


@pytest.mark.skipif(os.name == "nt", reason="Windows has no signals")
def test_ctrl_c_ends_a_run_in_a_line(interrupted: None, lever: Callable[..., Path]) -> None:
    path = lever(
        "    M_S = M(phi)", "    print('waits', flush=True)\n    __import__('time').sleep(600)\n    M_S = M(phi)"
    )
    run = subprocess.Popen(
        [*LAUNCHED, path], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True
    )
    with run:
        assert run.stdout and run.stderr and run.stdout.readline() == "waits\n"
        os.killpg(run.pid, signal.SIGINT)  # as a terminal does
        assert (run.wait(), run.stderr.read()) == (130, "interrupted\n")


@pytest.mark.skipif(os.name == "nt", reason="Windows has no signals")
def test_ctrl_c_ends_a_started_worksheet_in_a_line(interrupted: None, lever: Callable[..., Path]) -> None:
    done = as_file(lever("    M_S = M(phi)", "    __import__('signal').raise_signal(2)\n    M_S = M(phi)"))
    assert (done.returncode, done.stdout, done.stderr) == (130, "", "interrupted\n")


@pytest.mark.skipif(os.name == "nt", reason="Windows has no signals")
def test_what_a_command_runs_ends_with_it() -> None:
    """As a server that is ended by the id of its command."""
    runs = "import sys, time; print('there', flush=True); time.sleep(600)"
    command = f"import sys; from mechsheet.__main__ import call; sys.exit(call([sys.executable, '-c', {runs!r}]))"
    with subprocess.Popen([sys.executable, "-c", command], stdout=subprocess.PIPE, text=True) as started:
        assert started.stdout and started.stdout.readline() == "there\n"
        started.terminate()
        assert started.stdout.read() == "", "the pipe is open as long as the program runs"
    assert started.returncode == 128 + signal.SIGTERM


@pytest.mark.skipif(os.name == "nt", reason="Windows has no signals")
def test_a_program_that_is_just_starting_ends_with_its_command(monkeypatch: pytest.MonkeyPatch) -> None:
    """The command ended alone, and the program ran on."""
    start = subprocess.Popen

    def late(*args: Any, **how: Any) -> Any:
        process = start(*args, **how)
        signal.raise_signal(signal.SIGTERM)
        return process

    monkeypatch.setattr(subprocess, "Popen", late)
    before = signal.signal(signal.SIGTERM, lambda *_: None)
    try:
        assert launcher.call([sys.executable, "-c", "import time; time.sleep(5)"]) == 128 + signal.SIGTERM
    finally:
        signal.signal(signal.SIGTERM, before)


@pytest.mark.skipif(os.name == "nt", reason="Windows has no signals")
def test_ctrl_c_as_a_program_ends_keeps_its_code(interrupted: None, monkeypatch: pytest.MonkeyPatch) -> None:
    """Between the system's word that it has ended and whoever waits for that."""
    waitpid = os.waitpid

    def late(*args: int) -> tuple[int, int]:
        ended = waitpid(*args)
        signal.raise_signal(signal.SIGINT)
        return ended

    monkeypatch.setattr(os, "waitpid", late)
    assert launcher.call([sys.executable, "-c", "raise SystemExit(7)"]) == 7


@pytest.mark.skipif(os.name == "nt", reason="Windows has no signals")
def test_a_program_that_a_signal_ended_has_the_code_of_shells() -> None:
    dies = "import os, signal; os.kill(os.getpid(), signal.SIGTERM)"
    assert launcher.call([sys.executable, "-c", dies]) == 128 + signal.SIGTERM


def test_a_worksheet_of_ones_own_writes_beside_itself_and_at_home_where_asked(
    lever: Callable[..., Path], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path, home = lever(), tmp_path / "home"
    monkeypatch.chdir(tmp_path)
    for variable in ("HOME", "USERPROFILE"):
        monkeypatch.setenv(variable, str(home))
    for option, out in (([], tmp_path), (["--out=~/books"], home / "books")):
        done = launched(path.stem, *option)
        assert done.returncode == 0 and f"written {out / 'lever.xlsx'}" in done.stdout, done.stderr
        assert (out / "lever.xlsx").exists()


@pytest.mark.parametrize("folder", ["worksheets", "worksheets/examples"])
def test_a_worksheet_of_a_clone_writes_into_its_exports(
    folder: str, lever: Callable[..., Path], tmp_path: Path
) -> None:
    home = tmp_path / folder / "lever.py"
    home.parent.mkdir(parents=True)
    (tmp_path / "lib" / "mechsheet").mkdir(parents=True)
    lever().rename(home)
    assert as_script(home).returncode == 0
    assert [path.name for path in (tmp_path / "exports").iterdir()] == ["lever.xlsx"]


def test_a_comma_that_could_mean_thousands_and_formulas_that_are_not_shown_are_told_once(
    lever: Callable[..., Path],
) -> None:
    path = lever("    typeset(strong)\n", "    strong\n")
    done = as_script(path, "--F=999,500")
    assert done.stdout.count("read with a decimal comma") == done.stdout.count("F = 999.5 N, read with") == 1
    assert [line for line in done.stdout.splitlines() if "not shown" in line] == [
        "lever.py, line 126, n = 2 if g.both else 1: n, M_n, sigma are not shown: end the cell in typeset()"
    ]
    assert done.returncode == 0
