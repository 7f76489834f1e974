"""The command line: what it makes of its arguments, and when it makes an environment."""

from __future__ import annotations

import ast
import io
import json
import os
import re
import shutil
import socket
import subprocess
import sys
import tomllib
import venv
from contextlib import redirect_stderr
from pathlib import Path

import pytest
from as_script import copied
from marimo._config.manager import get_default_config_manager

from mechsheet import __main__ as launcher

ROOT = Path(__file__).resolve().parents[1]
LAUNCHER = ROOT / "lib" / "mechsheet" / "__main__.py"


@pytest.fixture
def calls(monkeypatch: pytest.MonkeyPatch) -> list[list[str]]:
    """Commands that would have been started."""
    made: list[list[str]] = []

    def record(command: list[str], cwd: Path | None = None, settings: dict[str, str] | None = None) -> int:
        made.append(command)
        return 7

    monkeypatch.setattr(launcher, "call", record)
    monkeypatch.setattr(launcher, "unbound", lambda host, port: "")  # whatever else is served on this computer
    return made


@pytest.fixture
def sheet(tmp_path: Path) -> Path:
    """A worksheet that prints its arguments, which only one that may ask for inputs can take, and exits with 3."""
    path = tmp_path / "sheet.py"
    lines = ("import marimo", "", "app = marimo.App()", "", "@app.cell", "def told():", "    import sys")
    ends = ("    from mechsheet import ask", "    print(*sys.argv[1:], 'φ')", "    sys.exit(3)", "    return", "")
    path.write_text("\n".join((*lines, *ends)), encoding="utf-8")
    return path


def refusal(*argv: str) -> str:
    """The one line with which a command line ends that cannot be carried out."""
    with pytest.raises(SystemExit) as exit_, redirect_stderr(io.StringIO()) as told:
        launcher.main(list(argv))
    assert exit_.value.code == 2
    message, end, rest = told.getvalue().partition("\n")
    assert message.startswith("mechsheet: ") and (end, rest) == ("\n", "")
    return message


def test_help_names_every_command(capsys: pytest.CaptureFixture[str]) -> None:
    assert launcher.main(["--help"]) == 0
    printed = capsys.readouterr().out
    assert re.findall(r"^  (\w+)", printed, re.MULTILINE) == list(launcher.COMMANDS)


def test_help_shows_each_command_by_an_example_that_it_takes(
    calls: list[list[str]], capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    assert launcher.main(["--help"]) == 0
    monkeypatch.setattr(launcher, "new", lambda *given: calls.append(["new", *given]) or 7)
    examples = re.findall(r"^ +such as +(.*)$", capsys.readouterr().out, re.MULTILINE)
    assert [example.split()[0] for example in examples] == list(launcher.COMMANDS)
    for example in examples:
        assert launcher.main(example.split()) == 7, example
    assert len(calls) == len(launcher.COMMANDS)


@pytest.mark.parametrize("command", sorted({*launcher.COMMANDS} - {"edit", "serve", "test"}))
def test_a_command_that_is_asked_for_help_gives_it(command: str, capsys: pytest.CaptureFixture[str]) -> None:
    for options in (["--help"], ["hitch", "-h"]):
        assert launcher.main([command, *options]) == 0
        assert f"\n  {command} NAME" in capsys.readouterr().out


@pytest.mark.parametrize("command", ["edit", "serve"])
def test_the_help_of_the_page_tells_its_own_options_first(
    command: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """There stood marimo's alone, of a command of another name and without the password."""
    monkeypatch.setattr(launcher, "call", lambda *_, **__: 0)
    assert launcher.main([command, "guide", "--help"]) == 0
    told = capsys.readouterr().out
    assert told.startswith(f"  {command} [NAME]") and f"such as                         {command} hitch" in told
    assert ("--password-file" in told) == (command == "serve") and "  index" not in told


def test_ctrl_c_before_a_run_is_watched_is_one_line(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """While modules were loaded, half of the time of a short command, there was a traceback."""
    (tmp_path / "loading.py").write_text("raise KeyboardInterrupt")
    monkeypatch.syspath_prepend(str(tmp_path))
    monkeypatch.setattr(sys, "argv", [])
    monkeypatch.setattr(sys, "excepthook", sys.__excepthook__)
    assert launcher.here("loading") == 130 and capsys.readouterr().err == "interrupted\n"


def test_every_worksheet_stands_in_the_help_with_its_title(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    assert launcher.main(["--help"]) == 0
    helped = capsys.readouterr().out
    assert launcher.main([]) == 2, "no command is given"
    assert capsys.readouterr().out == helped
    listed = dict(re.findall(r"^    (\w+) +(.+)$", helped.partition("usage")[0], re.MULTILINE))
    folders = ROOT / "worksheets", ROOT / "worksheets" / "examples"
    assert list(listed) == [path.stem for folder in folders for path in sorted(folder.glob("*.py"))]
    assert listed["hitch"] == "Tractor hitch"

    monkeypatch.chdir(tmp_path)
    (tmp_path / "lever.py").write_text("import marimo\napp = marimo.App(app_title='A lever')\n")
    (tmp_path / "program.py").write_text("raise SystemExit('run')\n")
    assert launcher.main(["--help"]) == 0
    (added,) = set(capsys.readouterr().out.splitlines()) - set(helped.splitlines())
    assert added.split(maxsplit=1) == ["lever", "A lever"], "a worksheet of the current folder, and no other file"


@pytest.mark.parametrize("argv", [["rn", "hitch"], ["--version"]])
def test_any_other_command_names_them(argv: list[str], calls: list[list[str]]) -> None:
    assert "run, html, design, new, edit, serve, index, compare, rename and test" in refusal(*argv)
    assert not calls


@pytest.mark.parametrize("given", ["hitch", "worksheets/hitch.py"])
def test_a_worksheet_in_the_place_of_a_command_is_told_so(
    given: str, calls: list[list[str]], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(ROOT)
    assert refusal(given) == f"mechsheet: {given} is a worksheet: run {given} computes it, edit {given} opens it"
    assert not calls


@pytest.mark.parametrize(
    ("argv", "meant"),
    [
        (["edti", "hitch"], "did you mean edit?"),
        (["hitsch"], "did you mean run hitch?"),
        (["run", "landing_gaer"], "did you mean landing_gear?"),
        (["edit", "joints"], "did you mean joint?"),
    ],
)
def test_the_nearest_is_told(argv: list[str], meant: str, calls: list[list[str]]) -> None:
    assert meant in refusal(*argv)
    assert "did you mean" not in refusal("quite-another")
    assert not calls


def test_a_name_is_looked_for_here_then_among_the_worksheets_and_examples(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folders = [Path(), Path("worksheets"), Path("worksheets", "examples")]
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(launcher, "ROOT", tmp_path)
    Path("worksheets", "examples").mkdir(parents=True)
    for folder in reversed(folders):
        path = folder / "lever.py"
        path.write_text("")
        assert Path(launcher.worksheet("lever")).resolve() == path.resolve()
    assert launcher.worksheet("worksheets/lever.py") == str(folders[1] / "lever.py"), "a file is that file"


@pytest.mark.parametrize("environment", [{}, {"LC_ALL": "C", "PYTHONCOERCECLOCALE": "0", "PYTHONUTF8": "0"}])
def test_run_passes_the_rest_on_and_the_exit_code_back(sheet: Path, environment: dict[str, str]) -> None:
    """In the process of the command, and in one of its own where that writes no UTF-8."""
    command = [sys.executable, "-m", "mechsheet", "run", sheet, "--P6=30e3", "--phi_BD=-3.5", "--proof"]
    done = subprocess.run(command, capture_output=True, encoding="utf-8", env={**os.environ, **environment})
    assert (done.returncode, done.stderr) == (3, "")
    assert done.stdout.split() == ["--P6=30e3", "--phi_BD=-3.5", "--proof", "φ"]


def test_in_the_process_of_the_command_modules_of_the_current_folder_are_found(tmp_path: Path) -> None:
    """As ``python -m`` finds them, though the command is a program in another folder."""
    (tmp_path / "beside.py").write_text("F = 3")
    text = "import marimo\napp = marimo.App()\n@app.cell\ndef told():\n    import beside, os, sys\n"
    (tmp_path / "sheet.py").write_text(text + "    print(beside.F, len(sys.argv), os.environ['PYTHONUTF8'])\n")
    start = "import sys; del sys.path[0]; from mechsheet.__main__ import main; sys.exit(main())"
    command = [sys.executable, "-c", start, "run", "sheet"]
    done = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.startswith("3 1 1\n")


def test_a_name_stands_for_the_worksheet_of_the_project(
    sheet: Path, calls: list[list[str]], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(launcher, "ROOT", sheet.parent)
    (sheet.parent / "worksheets").mkdir()
    known = shutil.copy(sheet, sheet.parent / "worksheets" / "hitch.py")
    assert launcher.main(["run", "hitch", "--N_pol=21"]) == 7
    assert calls == [[sys.executable, "-m", "mechsheet.run.script", str(known), "--N_pol=21"]]
    assert refusal("run", "hitsch") == "mechsheet: no worksheet hitsch: did you mean hitch? give a file or one of hitch"
    assert refusal("run") == "mechsheet: run needs a worksheet: give a file or one of hitch"


@pytest.mark.parametrize("options", [["a.toml"], ["--out=b", "a.toml", "c.xlsx"]])
def test_run_with_scenes_computes_them_side_by_side(sheet: Path, calls: list[list[str]], options: list[str]) -> None:
    assert launcher.main(["run", str(sheet), *options]) == 7
    assert calls == [[sys.executable, "-m", "mechsheet.run.batch", str(sheet), *options]]


def test_edit_opens_the_worksheet_in_marimo(sheet: Path, calls: list[list[str]]) -> None:
    assert launcher.main(["edit", str(sheet), "--headless"]) == 7
    assert calls == [[sys.executable, "-m", "marimo", "edit", "--watch", "--headless", str(sheet)]]


def test_without_a_name_all_worksheets_are_opened_the_own_ones_first_then_those_to_begin_with(
    sheet: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    made: list[tuple[list[str], dict[str, str]]] = []
    monkeypatch.setattr(launcher, "call", lambda command, settings: made.append((command, settings)) or 7)
    monkeypatch.chdir(sheet.parent)
    assert [launcher.main([command, "--port=1"]) for command in ("edit", "serve")] == [7, 7]
    (edit, settings), (serve, others) = made
    assert settings == {**others, "MECHSHEET_EDIT": "1"}
    groups = json.loads(settings["MECHSHEET_START"])
    assert [title for title, _ in groups] == ["Here", "To begin with", "Documents"]
    assert groups[0][1] == {str(sheet): "sheet"}
    assert next(iter(groups[1][1].values())) == "Guide"
    assert groups[2][1][str(ROOT / "worksheets" / "hitch.py")] == "Tractor hitch"
    paths = [path for _, sheets in groups for path in sheets]
    assert edit[:-1] == [sys.executable, "-m", "marimo", "edit", "--watch", "--port=1"]
    assert all(Path(path).is_relative_to(edit[-1]) for path in paths)
    assert serve == [sys.executable, "-m", "marimo", "run", "--port=1", *paths]

    monkeypatch.setattr(launcher, "folders", list)
    sheet.unlink()
    assert "there is none" in refusal("edit")


def test_serve_shows_a_worksheet_to_who_knows_the_password(sheet: Path, calls: list[list[str]]) -> None:
    start = [sys.executable, "-m", "marimo", "run"]
    assert launcher.main(["serve", str(sheet)]) == 7
    assert calls.pop() == [*start, str(sheet)]
    secret = sheet.with_name("secret")
    secret.write_text("sesame\n")
    for options in ([f"--password-file={secret}"], ["--password-file", str(secret)]):
        assert launcher.main(["serve", str(sheet), *options]) == 7
        handed = [option.replace("--password", "--token-password") for option in options]
        assert calls.pop() == [*start, "--token", *handed, str(sheet)]


@pytest.mark.parametrize("text", [None, "", " \n", "sésame\n"])
def test_a_password_that_nobody_could_give_is_refused(sheet: Path, calls: list[list[str]], text: str | None) -> None:
    """marimo compares ASCII alone: to each visitor it would have answered with an error."""
    secret = sheet.with_name("secret")
    if text is not None:
        secret.write_text(text, encoding="utf-8")
    assert f"password-file = {secret} must be a file" in refusal("serve", str(sheet), f"--password-file={secret}")
    assert calls == []


@pytest.mark.parametrize("command", ["serve", "edit"])
@pytest.mark.parametrize("option", ["--port", "--host", "--password-file"])
def test_an_option_without_its_value_takes_no_worksheet_for_it(
    command: str, option: str, sheet: Path, calls: list[list[str]]
) -> None:
    assert f"{option} needs a value" in refusal(command, str(sheet), option)
    assert f"{option} needs a value" in refusal(command, option)
    assert calls == []


def test_an_address_at_which_nothing_can_be_served_is_refused(sheet: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Else the page of another program is told to be this one, or a traceback is all there is."""
    monkeypatch.setattr(launcher, "call", lambda *_, **__: 7)
    with socket.socket() as other:
        other.bind(("127.0.0.1", 0))
        other.listen()
        taken = other.getsockname()[1]
        for command in ("serve", "edit"):
            assert f"port = {taken} is taken" in refusal(command, str(sheet), f"--port={taken}")
    assert launcher.main(["serve", str(sheet), f"--port={taken}"]) == 7
    for host in ("192.0.2.1", "no.such.host.invalid", "sheet.py"):
        assert f"host = {host}: nothing can be served" in refusal("serve", str(sheet), f"--host={host}", "--no-token")


def test_a_worksheet_runs_as_it_opens_outside_a_clone_too(
    capfd: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    setting = "_MARIMO_CONFIG_OVERLOAD_RUNTIME_AUTO_INSTANTIATE"
    monkeypatch.delenv(setting, raising=False)
    assert launcher.call([sys.executable, "-c", f"import os; print(os.environ['{setting}'])"]) == 0
    monkeypatch.setenv(setting, capfd.readouterr().out.strip())
    assert get_default_config_manager(current_path="/").get_config()["runtime"]["auto_instantiate"] is True


def test_the_editor_runs_what_is_written_in_place_outside_a_clone_too(monkeypatch: pytest.MonkeyPatch) -> None:
    """As marimo enters the package's entry point; beside the worksheet lie no settings that say so."""
    code = (
        "import asyncio\n"
        "from types import SimpleNamespace\n"
        "from marimo._config.manager import get_default_config_manager\n"
        "from mechsheet.page.server import lifespan\n"
        "async def entered():\n"
        "    known = get_default_config_manager(current_path='/')\n"
        "    async with lifespan(SimpleNamespace(state=SimpleNamespace(config_manager=known))):\n"
        "        print(known.get_config()['runtime']['watcher_on_save'])\n"
        "asyncio.run(entered())"
    )
    monkeypatch.setattr(launcher, "interpreter", lambda _extra: sys.executable)
    started = list[dict[str, str]]()
    monkeypatch.setattr(launcher, "call", lambda _, settings: started.append(settings) or 7)
    assert launcher.page("edit", ["lever.py"], []) == 7
    for name, value in started[0].items():
        monkeypatch.setenv(name, value)
    done = copied(lambda: exec(code, {}), ["-c", code])
    assert (done.returncode, done.stdout.strip()) == (0, "autorun"), done.stderr


def test_test_hands_its_arguments_to_pytest(calls: list[list[str]]) -> None:
    """Behind its own, so that ``-n 0`` is one process."""
    assert launcher.main(["test", "-k", "planar", "-n", "0"]) == 7
    own = [f"-n={os.cpu_count()}", "--dist=worksteal", "--durations=10"]
    assert calls == [[sys.executable, "-m", "pytest", *own, "-k", "planar", "-n", "0"]]


def test_test_needs_a_clone(tmp_path: Path, calls: list[list[str]], monkeypatch: pytest.MonkeyPatch) -> None:
    """An installed wheel has no tests, and pytest would look for them wherever it was called."""
    monkeypatch.setattr(launcher, "ROOT", tmp_path)
    assert "clone" in refusal("test")
    assert not calls


def test_an_old_python_is_named_with_the_limit(calls: list[list[str]], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "version_info", (3, 9, 2, "final", 0))
    with pytest.raises(SystemExit, match=r"^mechsheet: Python 3.11 or newer is needed, this is Python 3.9 \("):
        launcher.main(["run", "hitch"])  # the command line is not at fault: a text, which makes the exit code 1
    assert not calls


def test_an_old_python_can_read_the_file_at_all() -> None:
    """Where the syntax is newer than the interpreter, a SyntaxError takes the place of the message."""
    ast.parse(LAUNCHER.read_text(encoding="utf-8"), feature_version=(3, 6))


def test_the_limit_is_the_one_of_the_package() -> None:
    needed = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]["requires-python"]
    assert needed == ">=" + ".".join(map(str, launcher.MINIMUM))


def test_the_modules_of_the_package_shadow_nothing(tmp_path: Path) -> None:
    """Running a folder puts it before the standard library on the path."""
    folder = tmp_path / "lib" / "mechsheet"
    folder.mkdir(parents=True)
    shutil.copy(LAUNCHER, folder)
    for name in ("subprocess", "hashlib", "pathlib", "venv", "signal", "table"):
        (folder / f"{name}.py").write_text("raise ImportError('shadowed')\n")
    run = subprocess.run([sys.executable, folder, "--help"], capture_output=True, text=True)
    assert (run.returncode, run.stdout, run.stderr) == (0, launcher.HELP, "")


@pytest.mark.parametrize("way", [["-m", "mechsheet"], [str(ROOT / "lib" / "mechsheet")]], ids=["module", "folder"])
def test_both_ways_to_start_it_report_an_error_alike(way: list[str]) -> None:
    run = subprocess.run([sys.executable, *way, "rn"], capture_output=True, text=True)
    assert (run.returncode, run.stdout) == (2, "")
    assert run.stderr.startswith("mechsheet: command rn is not known") and run.stderr.count("\n") == 1


class Project:
    """A project's folder whose installations are noted down instead of carried out."""

    def __init__(self, root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
        self.root, self.steps = root, list[str]()
        self.fail: BaseException | None = None
        self.python = root / ".venv" / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
        (root / "pyproject.toml").write_text("[project]\n")
        monkeypatch.setattr(venv, "EnvBuilder", lambda **_: self)
        monkeypatch.setattr(launcher, "install", self.install)

    def create(self, folder: Path) -> None:
        """What ``venv.EnvBuilder`` does."""
        self.steps.append("create")
        self.python.parent.mkdir(parents=True)
        self.python.touch()

    def install(self, root: Path, python: Path, extra: str) -> None:
        assert (root, python) == (self.root, self.python)
        self.steps.append(f"install {extra}".strip())
        if self.fail:
            raise self.fail

    def steps_for(self, extra: str) -> list[str]:
        """Steps taken by a command that needs this extra."""
        self.steps.clear()
        assert launcher.environment(self.root, extra) == str(self.python)
        return self.steps


@pytest.fixture
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Project:
    return Project(tmp_path, monkeypatch)


def test_the_environment_is_made_once(project: Project, capsys: pytest.CaptureFixture[str]) -> None:
    assert project.steps_for("") == ["create", "install"]
    assert "creating .venv and installing mechsheet" in capsys.readouterr().err
    assert project.steps_for("") == []
    assert capsys.readouterr().err == ""


def test_the_test_tools_are_added_to_what_is_there(project: Project) -> None:
    project.steps_for("")
    assert project.steps_for("dev") == ["install dev"]
    assert project.steps_for("") == project.steps_for("dev") == []


def test_a_changed_project_file_makes_it_anew(project: Project) -> None:
    project.steps_for("dev")
    left_over = project.root / ".venv" / "old"
    left_over.touch()
    (project.root / "pyproject.toml").write_text("[project]\ndependencies = []\n")
    assert project.steps_for("") == ["create", "install"]
    assert not left_over.exists()
    assert project.steps_for("dev") == ["install dev"]


def test_another_version_of_python_makes_it_anew(project: Project, monkeypatch: pytest.MonkeyPatch) -> None:
    project.steps_for("")
    monkeypatch.setattr(sys, "version_info", (3, 99, 0, "final", 0))
    assert project.steps_for("") == ["create", "install"]


def test_a_vanished_interpreter_makes_it_anew(project: Project) -> None:
    project.steps_for("")
    project.python.unlink()
    assert project.steps_for("") == ["create", "install"]


def test_a_moved_folder_makes_it_anew(project: Project, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The editable installation would still import the package of the old place."""
    project.steps_for("")
    copy = tmp_path / "copy"
    shutil.copytree(tmp_path, copy)
    assert Project(copy, monkeypatch).steps_for("") == ["create", "install"]


@pytest.mark.parametrize("before", [None, ""], ids=["at first", "while the tools are added"])
@pytest.mark.parametrize(
    ("error", "message"),
    [
        (KeyboardInterrupt(), "interrupted"),
        (OSError(28, "No space left on device"), "No space left on device"),
        (subprocess.CalledProcessError(1, ["python", "-m", "pip"]), "pip ended with 1"),
    ],
    ids=["Ctrl-C", "full disk", "no network"],
)
def test_an_unfinished_installation_is_begun_anew(
    project: Project, before: str | None, error: BaseException, message: str
) -> None:
    if before is not None:
        project.steps_for(before)
    project.fail = error
    with pytest.raises(SystemExit, match=message):
        launcher.environment(project.root, "dev")
    project.fail = None
    assert project.steps_for("dev") == ["create", "install dev"]


def test_one_that_is_half_removed_is_begun_anew(project: Project, monkeypatch: pytest.MonkeyPatch) -> None:
    project.steps_for("")
    (project.root / "pyproject.toml").write_text("[project]\ndependencies = []\n")

    def interrupted(folder: Path) -> None:
        for file in folder.iterdir():
            if file.is_file():
                file.unlink()
        raise KeyboardInterrupt

    with monkeypatch.context() as patched, pytest.raises(SystemExit, match="interrupted"):
        patched.setattr(shutil, "rmtree", interrupted)
        launcher.environment(project.root, "")
    assert project.steps_for("") == ["create", "install"]


def test_an_environment_made_by_other_means_is_left_alone(project: Project) -> None:
    own = project.root / ".venv" / "own.txt"
    own.parent.mkdir()
    own.touch()
    with pytest.raises(SystemExit, match="made by other means"):
        launcher.environment(project.root, "")
    assert own.exists() and not project.steps


def test_an_environment_behind_a_link_is_left_alone(project: Project) -> None:
    """It may be another clone's, with that one's mark in it."""
    others = project.root.parent / "others"
    others.mkdir()
    (others / "mechsheet.installed").write_text("theirs dev")
    (project.root / ".venv").symlink_to(others, target_is_directory=True)
    with pytest.raises(SystemExit, match="made by other means"):
        launcher.environment(project.root, "")
    assert (others / "mechsheet.installed").read_text() == "theirs dev" and not project.steps


def test_the_folder_looks_for_its_environment_and_the_installed_package_does_not(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(launcher, "environment", lambda root, extra: f"{root} {extra}")
    assert launcher.interpreter("dev") == sys.executable
    monkeypatch.setattr(launcher, "__package__", "")
    assert launcher.interpreter("dev") == f"{ROOT} dev"
