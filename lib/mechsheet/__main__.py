"""The command line: ``mechsheet COMMAND``, ``python -m mechsheet COMMAND``, or ``python lib/mechsheet COMMAND``.

The last form needs nothing but Python: it first makes the project's own ``.venv`` with the package in it.
The file uses the standard library alone and the syntax of Python 3.6, so that an older Python reads as far as
the line that tells its user which one is needed.
"""

import sys

if not __package__:  # run as a folder, which heads the path: its modules must not shadow the standard library's
    del sys.path[0]

import errno
import os
import re
from pathlib import Path

MINIMUM = (3, 11)
ROOT = Path(__file__).resolve().parents[2]
COMMANDS = ("run", "html", "design", "new", "edit", "serve", "index", "compare", "rename", "test")
HELP = """\
usage: mechsheet COMMAND              where the package is installed
       python lib/mechsheet COMMAND   in a clone of the project

  run NAME [--INPUT=VALUE ...]        compute the worksheet and write its workbook
      NAME --proof                    prove how many digits of what it shows are right, at least 9 unless =DIGITS
      NAME --tolerances               show how far results are off within the tolerances of the inputs, and how sure
                                      each check is; with --want also by random cases and by guaranteed bounds
      NAME SCENE ...                  compute scenes side by side, and write workbooks where --out=FOLDER says; with
                                      --jobs=N by so many processes at the same time
      NAME --want=RESULT,...          compute some results and what they need, and print them
      such as                         run hitch --P6=25e3 --want=L4,GS6
  html NAME [--INPUT=VALUE ...]       write the document as one page that needs nothing but a browser, and computes
      such as                         html hitch --P6=25e3 --out=exports
  design NAME --vary=.. --best=..     find the inputs within bounds that meet all requirements and are best at a goal;
      NAME --vary=.. --need=..        or the one input that gives a result its value; writes NAME_designed.toml
                                      where run writes the workbook, or where --out=FOLDER says
      such as                         design bucket --vary="L_DE=0.42..0.5" --need="mu_2 >= 30 deg" --best="max F_T"
  new NAME [--like=EXAMPLE]           begin a worksheet from a template, or from another worksheet
      such as                         new loader --like=bucket
  edit [NAME] [OPTIONS]               open the worksheet in the browser; a click on a formula edits its line; without
                                      a name a page with all worksheets, their drawings and verdicts
      such as                         edit hitch
  serve [NAME] [OPTIONS]              show it, or all of them, in the browser without the code: on this computer only
                                      unless --host=0.0.0.0, to who knows the password of --password-file=FILE
      such as                         serve hitch --port=8080
  index NAME                          where the worksheet has the formulas, tables and figures of its document
      such as                         index kinetostatics
  compare NAME OLD NEW [--markdown]   what changed from one scene, workbook, revision of git or worksheet's file to
                                      another
      such as                         compare hitch HEAD worksheets/hitch.py
  rename NAME OLD NEW                 rename a symbol in the worksheet, its comments and texts, and in its scenes
      such as                         rename hitch F_gc F_c
  test [OPTIONS]                      run the project's tests (options of pytest)
      such as                         test -k hitch

NAME is a file, or the name of a worksheet in the current folder, in worksheets/ or in worksheets/examples/.

Exit code: 0 where every check passes; 1 where one does not, a Find has no solution, or the worksheet refuses a value or
does not run; 2 where what is given on the command line or in a scene cannot be used; 130 after Ctrl-C. Of compare 0
where nothing changed, 1 where something did, and 2 where that cannot be told.
"""


def main(argv: "list[str] | None" = None) -> int:
    """Exit code of one command; an error of usage ends in one line on stderr and 2, one of installation in 1."""
    if sys.version_info < MINIMUM:
        needed, found = (".".join(map(str, version[:2])) for version in (MINIMUM, sys.version_info))
        sys.exit(f"mechsheet: Python {needed} or newer is needed, this is Python {found} ({sys.executable})")
    command, *options = (sys.argv[1:] if argv is None else argv) or [""]
    own = command not in ("edit", "serve", "test")  # what marimo and pytest take, they tell themselves
    if command in ("", "-h", "--help") or (own and not {"-h", "--help"}.isdisjoint(options)):
        say(contents() + HELP)
        return 0 if command else 2
    if command in ("edit", "serve"):
        if not {"-h", "--help"}.isdisjoint(options):
            told = "".join(re.findall(rf"^  {command} .*\n(?:    .*\n)*", HELP, re.MULTILINE))
            say(f"{told}\nOPTIONS are those of marimo too, which tells of a command of its own:\n\n")
        name, *options = options if options and not options[0].startswith("-") else ["", *options]
        return page(command, [known(name)] if name else [], options)
    if command in ("run", "html", "design", "index", "compare", "rename"):
        if not options:
            raise refused(f"{command} needs a worksheet: {known_worksheets()}")
        name, *options = options
        sheet = known(name)
        if command in ("html", "index", "compare", "rename"):
            return call([interpreter(""), "-m", f"mechsheet.run.{command}", sheet, *options])
        if command == "design":
            return call([interpreter(""), "-m", "mechsheet.studies.asked_design", sheet, *options])
        scenes = any(not option.startswith("-") for option in options)
        return call([interpreter(""), "-m", f"mechsheet.run.{'batch' if scenes else 'script'}", sheet, *options])
    if command == "new":
        like = [option.partition("=")[2] for option in options if option.startswith("--like=")]
        names = [option for option in options if not option.startswith("-")]
        if len(names) != 1 or len(like) > 1 or len(options) > len(names) + len(like):
            raise refused("new needs the name of the worksheet, such as lever, and takes --like=EXAMPLE")
        return new(names[0], *like)
    if command == "test":
        if not (ROOT / "tests").is_dir():
            raise refused(f"the tests are in a clone of the project, not beside {Path(__file__).parent}")
        # One for each processor: with one more all takes an eighth longer. An option given again is the last word.
        usual = [f"-n={os.cpu_count() or 1}", "--dist=worksteal", "--durations=10"]
        return call([interpreter("dev"), "-m", "pytest", *usual, *options], cwd=ROOT)
    if worksheet(command).endswith(".py"):
        raise refused(f"{command} is a worksheet: run {command} computes it, edit {command} opens it")
    meant = nearest(command, [*COMMANDS, *("run " + name for name in worksheets())])
    there = f"there are {', '.join(COMMANDS[:-1])} and {COMMANDS[-1]}, and --help tells more"
    raise refused(f"command {command} is not known: {meant}{there}")


def refused(why: str) -> SystemExit:
    """The end of a command line that cannot be carried out."""
    print(f"mechsheet: {why}", file=sys.stderr)
    return SystemExit(2)


def nearest(given: str, known: "list[str]") -> str:
    """What may have been meant, by the last word of what is known."""
    import difflib  # on use: only a mistaken name needs it

    near = difflib.get_close_matches(given, [text.split()[-1] for text in known], n=1)
    return next((f"did you mean {text}? " for text in known if near and text.split()[-1] == near[0]), "")


def page(command: str, sheets: "list[str]", options: "list[str]") -> int:
    """Exit code of marimo's server of a worksheet, or of the start page and all worksheets."""
    import json  # on use: only a page needs it

    port, host, password = (setting(options, name) for name in ("--port", "--host", "--password-file"))
    if options[-1:] and options[-1] in ("--port", "--host", "--password-file"):
        raise refused(f"{options[-1]} needs a value behind it")
    if port and not (port.isdecimal() and 0 < int(port) < 65536):
        raise refused(f"port = {port} must be a number from 1 to 65535")
    guarded = any(option.startswith(("--password-file", "--token", "--no-token")) for option in options)
    if command == "serve" and host not in ("", "localhost", "127.0.0.1", "::1") and not guarded:
        raise refused(f"--host={host} shows the pages to whoever is on the network: give --password-file=FILE")
    if password and password != "-" and not is_password(password):
        raise refused(f"password-file = {password} must be a file with a password of ASCII characters, such as sesame")
    unusable = unbound(host or "127.0.0.1", int(port or 0))
    if unusable:
        raise refused(unusable)
    settings = {}
    if not sheets:
        groups = [(title, paths) for title, paths in grouped().items() if paths]
        if not groups:
            raise refused(f"{command} without a name shows all worksheets, and there is none: new begins one")
        settings["MECHSHEET_START"] = json.dumps(groups)
        sheets = [path for _, paths in groups for path in paths]
        if command == "edit":  # marimo edits one file, or what it is asked for in a folder
            sheets = [os.path.commonpath([str(Path(path).parent) for path in sheets])]
    if command == "edit":
        settings["MECHSHEET_EDIT"] = "1"
        return call([interpreter(""), "-m", "marimo", "edit", "--watch", *options, *sheets], settings=settings)
    mistakes = {sheet: unread(sheet) for sheet in sheets}
    for told in filter(None, mistakes.values()):
        print(f"mechsheet: {told}", file=sys.stderr)
    left_out = [sheet for sheet in sheets if mistakes[sheet]]
    sheets = [sheet for sheet in sheets if not mistakes[sheet]]
    if not sheets:
        return 1
    if left_out and settings:
        settings["MECHSHEET_LEFT_OUT"] = json.dumps(left_out)
    options = [re.sub("^--password-file(?==|$)", "--token-password-file", option) for option in options]
    if any(option.startswith("--token-password-file") for option in options):
        options = ["--token", *options]
    return call([interpreter(""), "-m", "marimo", "run", *options, *sheets], settings=settings)


def setting(options: "list[str]", name: str) -> str:
    """What an option is given, behind = or as the next word; "" where it is not."""
    given = [text.partition("=")[2] for text in options if text.startswith(f"{name}=")]
    following = [options[n + 1] for n, text in enumerate(options[:-1]) if text == name]
    return [*given, *following, ""][0]


def is_password(path: str) -> bool:
    """Whether a file has a password that browsers can send: marimo compares no others."""
    try:
        text = Path(path).read_text(encoding="utf-8").strip()
    except (OSError, UnicodeDecodeError):
        return False
    return bool(text) and text.isascii()


def unbound(host: str, port: int) -> str:
    """Why no server can be at an address, of which marimo would tell the visitor's address first, or a traceback."""
    import socket  # on use: only a page needs it

    try:
        family, kind, _, _, address = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM)[0]
        with socket.socket(family, kind) as tried:
            if os.name == "posix":  # as the server will; elsewhere it would share what is taken
                tried.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            tried.bind(address)
        return ""
    except (OSError, UnicodeError) as error:
        if getattr(error, "errno", None) == errno.EADDRINUSE:
            return f"port = {port} is taken by another program: give another one, or none"
        at = f"host = {host}, port = {port}" if port else f"host = {host}"
        return f"{at}: nothing can be served there: {getattr(error, 'strerror', None) or error}"


def unread(sheet: str) -> str:
    """Why Python cannot read a worksheet, of which marimo would serve nothing and no other one beside it."""
    import ast  # on use: only a page needs it

    try:
        ast.parse(Path(sheet).read_bytes())
        return ""
    except SyntaxError as error:
        return f"{Path(sheet).name}, line {error.lineno}, {(error.text or '').strip()}: {error.msg}"


def grouped() -> "dict[str, dict[str, str]]":
    """Titles of all worksheets by their paths, in the groups of the start page."""
    groups = {"Here": {}, "To begin with": {}, "Documents": {}}  # type: dict[str, dict[str, str]]
    for name, (path, title) in worksheets().items():
        path = path.resolve()
        ours = path.parent in map(Path.resolve, folders())
        begins = name == "guide" or path.parent.name == "examples"
        groups["Here" if not ours else "To begin with" if begins else "Documents"][str(path)] = title or name
    first = sorted(groups["To begin with"].items(), key=lambda each: Path(each[0]).stem != "guide")
    return {**groups, "To begin with": dict(first)}


def known(name: str) -> str:
    """Path of the worksheet of that name; without one the command ends."""
    sheet = worksheet(name)
    if not sheet:
        raise refused(f"no worksheet {name}: {nearest(name, list(worksheets()))}{known_worksheets()}")
    return sheet


def worksheet(name: str) -> str:
    """Path of the worksheet given as a file or by its name alone; nothing where there is none."""
    paths = (Path(name), Path(f"{name}.py"), *(folder / f"{name}.py" for folder in folders()))
    return next((str(path) for path in paths if path.is_file()), "")


def folders() -> "list[Path]":
    return [ROOT / "worksheets", ROOT / "worksheets" / "examples", Path(__file__).resolve().parent / "examples"]


def worksheets() -> "dict[str, tuple[Path, str]]":
    """Worksheets that a name alone finds, with the titles in their texts; one found earlier hides a later one."""
    found = {}  # type: dict[str, tuple[Path, str]]
    for folder in (Path(), *folders()):
        for path in sorted(folder.glob("*.py")):
            text = path.read_text(encoding="utf-8", errors="replace") if path.is_file() else ""
            title = re.search(r"""app_title=(["'])(.*?)\1""", text)
            if "marimo.App(" in text or folder.name:  # in the current folder there may be any program
                found.setdefault(path.stem, (path, title.group(2) if title else ""))
    return found


def contents() -> str:
    """The worksheets with their titles."""
    found = worksheets()
    wide = max(map(len, found), default=0)
    lines = [f"    {name:{wide}}  {title}".rstrip() for name, (_, title) in found.items()]
    return "\n".join(["worksheets:", "", *lines, "", ""]) if lines else ""


def new(name: str, like: str = "") -> int:
    """Write a worksheet from the template or like another one, with what it needs: within a clone into worksheets/."""
    import shutil  # on use: to compute a worksheet is what nearly every call is for

    ours, current = ROOT / "worksheets", Path.cwd()
    folder = ours if ours.is_dir() and ROOT in (current, *current.parents) else current
    if not (name.isidentifier() and name[0].isalpha()):
        words = re.findall(r"\w+", re.sub(r".*[/\\]|\.py$", "", name.rstrip("/\\")))  # without a folder
        other = "_".join(words).lstrip("_0123456789") or "lever"
        must = "must be a letter, then letters, digits or _"
        raise refused(f"name of the worksheet = {name!r} {must}: give {other}, which is written into {folder}")
    import keyword  # on use: as above

    others = ["mechsheet", "marimo", "numpy", "scipy", "pandas", "altair", "openpyxl", "xlsxwriter", "mpmath", "flint"]
    if name in (*others, *getattr(sys, "stdlib_module_names", ())) or keyword.iskeyword(name):
        raise refused(f"name of the worksheet = {name!r} is one of Python's, as which it would be read: give {name}_1")
    path, here = folder / f"{name}.py", Path(__file__).resolve().parent
    if path.exists():
        raise refused(f"{path} is there already")
    title = name.replace("_", " ").capitalize()
    if like:
        source = Path(known(like))
        text = source.read_text(encoding="utf-8").replace("../page.css", "page.css")
        named = re.search(r"""app_title=(["'].*?["'])""", text)
        text = text.replace(named.group(1), f'"{title}"') if named else text
        beside = (file for file in source.parent.iterdir() if file.suffix in (".csv", ".xlsx") and file.name in text)
        for file in beside:
            if not (folder / file.name).exists():
                shutil.copy(str(file), str(folder))
    else:
        text = (here / "run" / "new_worksheet.txt").read_text(encoding="utf-8").replace("TITLE", title)
    style = next(path for path in [each / "page.css" for each in (folder, ours, here / "page")] if path.exists())
    if style.parent != folder:
        shutil.copy(str(style), str(folder))
    path.write_text(text, encoding="utf-8")
    command = "mechsheet" if __package__ else f"python {here}"
    say(f"written {path}; {command} edit {name} opens it\n")
    return 0


def known_worksheets() -> str:
    names = sorted(worksheets())
    return f"give a file or one of {', '.join(names)}" if names else "give a file"


def call(command: "list[str]", cwd: "Path | None" = None, settings: "dict[str, str] | None" = None) -> int:
    """Exit code of a program in this terminal, with UTF-8 output also where Windows would encode it otherwise.

    In the editor a worksheet runs as it opens, beside no pyproject.toml that says so either. Where the user has not
    said otherwise, numpy's library of matrices has one thread: those here are small, and to start and to await others
    takes a fifth of a run.
    """
    always = {"PYTHONUTF8": "1", "_MARIMO_CONFIG_OVERLOAD_RUNTIME_AUTO_INSTANTIATE": "true"}
    environ = {"OPENBLAS_NUM_THREADS": "1", **os.environ, **always, **(settings or {})}
    if command[:2] == [sys.executable, "-m"] and command[2].startswith("mechsheet.") and is_utf8():
        os.environ.update(environ)
        return here(*command[2:])
    import signal  # on use: what runs in this process waits for no other
    import subprocess  # on use: as above

    started, ended = list["subprocess.Popen[bytes]"](), list[int]()

    def end(number: int, _: object) -> None:
        ended.append(number)
        for process in started:
            process.terminate()

    ends = {
        signal.SIGTERM: end,  # else a server outlives its command; one may come as the program starts
        # Ctrl-C reaches the program too, and how to end is for it to say; an interruption here could lose its code.
        signal.SIGINT: lambda *_: None,
    }
    kept = {number: signal.signal(number, handler) for number, handler in ends.items()}
    try:
        with subprocess.Popen(command, cwd=cwd, env=environ) as process:
            started.append(process)
            if ended:
                process.terminate()
            code = process.wait()
    finally:
        for number, handler in kept.items():
            signal.signal(number, handler)
    return code if code >= 0 else 128 - code  # of a program that a signal ended, as shells have it


def is_utf8() -> bool:
    """Whether this process has the encoding that it would give to another one."""
    return bool(sys.flags.utf8_mode) or (os.name == "posix" and sys.getfilesystemencoding() == "utf-8")


def here(module: str, *options: str) -> int:
    """Run a module as ``python -m`` does, in this process: another Python would take a fifteenth of a run to start."""
    import runpy  # on use: where another Python is needed, it is not

    sys.argv = [module, *options]
    if not sys.flags.safe_path and sys.path[:1] != [os.getcwd()]:
        sys.path.insert(0, os.getcwd())
    try:
        runpy.run_module(module, run_name="__main__", alter_sys=True)
    except KeyboardInterrupt:
        if sys.excepthook is not sys.__excepthook__:  # the run tells its end itself
            raise
        print("interrupted", file=sys.stderr)
        return 130
    return 0


def say(text: str) -> None:
    """Print at once; where nobody reads any more, or standard output takes nothing, end in silence or in a line."""
    try:
        print(text, end="", flush=True)
    except OSError as error:
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)  # for what Python itself would still write
        sys.exit(141 if isinstance(error, BrokenPipeError) else f"mechsheet: standard output: {error.strerror}")


def interpreter(extra: str) -> str:
    """The Python that has the package: this one where it is installed, else that of the project's .venv."""
    return sys.executable if __package__ else environment(ROOT, extra)


def environment(root: Path, extra: str) -> str:
    """Python of ``root/.venv``, which is made, or made anew, unless it holds the package with that extra.

    ``.venv/mechsheet.installed`` says what a finished installation was made of; it is empty while one goes on,
    so that an interrupted one is never taken for good.
    """
    import hashlib  # on use: an installed package has no environment of its own
    import subprocess  # on use: as above

    folder = root / ".venv"
    mark = folder / "mechsheet.installed"
    python = folder / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
    # An environment is stale where the project's file, its place on the disk or the version of Python has changed.
    source = (root / "pyproject.toml").read_bytes() + f"{root} {sys.version_info[:2]}".encode()
    fingerprint = hashlib.sha256(source).hexdigest()
    installed, _, has = mark.read_text().partition(" ") if mark.exists() else ("", "", "")
    current = installed == fingerprint and python.exists()
    if current and has in (extra, "dev"):
        return str(python)
    # Behind a link stands an environment that others may use: nothing is removed there.
    if folder.exists() and not (mark.exists() and (current or not folder.is_symlink())):
        sys.exit(f"mechsheet: {folder} was made by other means: call mechsheet inside it, or remove it")
    try:
        if current:
            print("mechsheet: adding the tools of the tests to .venv (once, half a minute)", file=sys.stderr)
            mark.write_text("")
        else:
            print("mechsheet: creating .venv and installing mechsheet (once, about a minute)", file=sys.stderr)
            create(folder, mark)
        install(root, python, extra)
        mark.write_text(f"{fingerprint} {extra}")
    except OSError as error:
        sys.exit(f"mechsheet: the installation into {folder} failed: {error}")
    except subprocess.CalledProcessError as error:  # of python -m pip, or of python -m ensurepip while .venv is made
        sys.exit(f"mechsheet: the installation into {folder} failed: {error.cmd[2]} ended with {error.returncode}")
    except KeyboardInterrupt:
        sys.exit("mechsheet: the installation was interrupted; the next command begins it anew")
    return str(python)


def create(folder: Path, mark: Path) -> None:
    """Make an empty environment with the mark of an unfinished one."""
    import shutil  # on use: once for a clone
    import venv  # on use: as above

    folder.mkdir(exist_ok=True)
    mark.write_text("")  # first of all, and it stays: without it what an interruption leaves would be somebody else's
    for part in folder.iterdir():
        if part.is_dir() and not part.is_symlink():
            shutil.rmtree(part)
        elif part != mark:
            part.unlink()
    venv.EnvBuilder(with_pip=True, symlinks=os.name != "nt").create(folder)


def install(root: Path, python: Path, extra: str) -> None:
    """Install the project editable; what pip has to complain of, it says itself."""
    import subprocess  # on use: once for a clone

    target = f".[{extra}]" if extra else "."
    pip = [str(python), "-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--editable", target]
    subprocess.run(pip, cwd=root, check=True)


if __name__ == "__main__":
    sys.exit(main())
