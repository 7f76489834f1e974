"""The package as a whole: its rooms and files, what each loads, and the one namespace of public names."""

from __future__ import annotations

import ast
import builtins
import inspect
import pydoc
import re
import subprocess
import sys
from collections.abc import Callable, Iterable, Iterator
from functools import cache
from importlib import import_module
from pathlib import Path

import pytest

import mechsheet

ROOT = Path(__file__).resolve().parents[1]
PACKAGE = ROOT / "lib" / "mechsheet"
ROOMS = sorted(path.parent.name for path in PACKAGE.glob("*/__init__.py"))
FILES = sorted(PACKAGE.rglob("*.py"))
LONGEST = 450
PUBLIC = sorted(set(mechsheet.__all__) - {"__version__"})


@cache
def trees() -> dict[str, ast.Module]:
    """The library's files, by their places in it."""
    return {path.relative_to(PACKAGE).as_posix(): ast.parse(path.read_text(encoding="utf-8")) for path in FILES}


@cache
def nodes() -> dict[str, list[ast.AST]]:
    """All nodes of each file: to walk through them takes as long as to read them."""
    return {place: list(ast.walk(tree)) for place, tree in trees().items()}


def wrong(look: Callable[[str, list[ast.AST]], Iterable[object]]) -> dict[str, list[object]]:
    """What is wrong in each file, where something is."""
    found = {place: [*look(place, known)] for place, known in nodes().items()}
    return {place: each for place, each in found.items() if each}


def imports(known: Iterable[ast.AST]) -> Iterator[ast.Import | ast.ImportFrom]:
    return (node for node in known if isinstance(node, ast.Import | ast.ImportFrom))


# --- rooms and files ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize("room", ROOMS)
def test_a_room_says_what_lives_there(room: str) -> None:
    assert ast.get_docstring(trees()[f"{room}/__init__.py"])


def test_a_file_can_be_read_in_one_go() -> None:
    lines = {path: len(path.read_text(encoding="utf-8").splitlines()) for path in FILES}
    assert {path: count for path, count in lines.items() if count > LONGEST} == {}


def test_no_two_names_differ_by_an_s() -> None:
    """Of rooms, files, worksheets, tests and what the package gives."""
    others = {path.stem for folder in ("tests", "worksheets") for path in (ROOT / folder).rglob("*.py")}
    names = {path.stem for path in FILES} | set(ROOMS) | set(PUBLIC) | others
    assert {name for name in names if f"{name}s" in names} == set()


def test_an_import_on_use_says_why() -> None:
    """Inside a function, where start-up needs it, and with a comment on its line or above it."""

    def unsaid(place: str, known: list[ast.AST]) -> list[str]:
        lines = (PACKAGE / place).read_text(encoding="utf-8").splitlines()
        inside = [range(f.lineno, f.end_lineno + 1) for f in known if isinstance(f, ast.FunctionDef) and f.end_lineno]
        deferred = {node.lineno for node in imports(known) if any(node.lineno in rows for rows in inside)}
        return [lines[n - 1] for n in sorted(deferred) if "#" not in lines[n - 1] + lines[n - 2]]

    assert wrong(unsaid) == {}


def test_the_library_imports_from_where_a_name_is_defined() -> None:
    """A name taken from the package itself would hide from the order of the rooms."""

    def taken(_: str, known: list[ast.AST]) -> Iterator[str]:
        for node in imports(known):
            names = {name.name for name in node.names}
            if isinstance(node, ast.Import):
                yield from names & {"mechsheet"}
            elif node.module == "mechsheet":
                yield from names - {"units"}

    assert wrong(taken) == {}


# Coordinates of pictures are no numbers for a reader.
_FORMATTING = {"worksheet/numbers.py", "document/chart_svg.py", "document/drawing_svg.py"}


def test_numbers_are_formatted_in_one_place() -> None:
    def formats(place: str, known: list[ast.AST]) -> Iterator[str]:
        for node in known if place not in _FORMATTING else ():
            if isinstance(node, ast.FormattedValue) and node.format_spec:
                yield from re.findall(r"^.*[efgEFG%]'$", ast.unparse(node.format_spec))
            elif isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "format":
                yield ast.unparse(node)

    assert wrong(formats) == {}


_MARKUP = re.compile(r"</\w|<(a|b|i|div|span|su[bp]|svg|t[dhr])\b|\\(cdot|frac|left|math|text|varphi)")


def test_below_the_writers_nothing_is_marked_up() -> None:
    """Values are data: HTML, LaTeX and SVG are made by the rooms of document, html and page."""

    def marked(place: str, known: list[ast.AST]) -> list[str]:
        below = [] if place.startswith(("document/", "html/", "page/")) else known
        told = {id(node.value) for node in below if isinstance(node, ast.Expr)}  # docstrings
        texts = [node.value for node in below if isinstance(node, ast.Constant) and id(node) not in told]
        return [text for text in texts if isinstance(text, str) and _MARKUP.search(text)]

    assert wrong(marked) == {}


# --- what is loaded ----------------------------------------------------------------------------------------------


@cache
def loaded(statement: str) -> set[str]:
    """Packages that a fresh process has loaded after a statement."""
    code = f"import sys\n{statement}\nprint(*{{name.partition('.')[0] for name in sys.modules}})"
    return set(subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.split())


def test_the_package_itself_loads_nothing() -> None:
    assert not loaded("import mechsheet, pydoc; dir(mechsheet), pydoc.render_doc(mechsheet)") & {
        "numpy",
        "marimo",
        "pandas",
        "scipy",
        "altair",
    }


def test_mechanics_load_numpy_alone() -> None:
    files = (PACKAGE / "mechanics").glob("[a-z]*.py")
    mechanics = "; ".join(f"import mechsheet.mechanics.{path.stem}" for path in files)
    others = loaded(f"from mechsheet import rrr, rrr_reactions; {mechanics}") - loaded("import mechsheet")
    assert others - sys.stdlib_module_names == {"numpy"}


def test_a_run_of_a_worksheet_loads_what_it_computes_and_writes_with(tmp_path: Path) -> None:
    sheet = tmp_path / "lever.py"
    template = (PACKAGE / "run" / "new_worksheet.txt").read_text(encoding="utf-8")
    sheet.write_text(template.replace("TITLE", "Lever"), encoding="utf-8")
    run = f"sys.argv = ['', {str(sheet)!r}, {f'--out={tmp_path}'!r}]; from mechsheet.run.script import main; main()"
    others = loaded(run) - loaded("import mechsheet") - sys.stdlib_module_names - {"mechsheet"}
    assert others >= {"numpy", "xlsxwriter"}
    assert not others & {"marimo", "scipy", "pandas", "altair", "openpyxl", "flint", "mpmath"}
    assert (tmp_path / "lever.xlsx").exists()


# --- public names ------------------------------------------------------------------------------------------------


def test_the_stub_lists_the_public_names_where_they_are_defined() -> None:
    stub = ast.parse((PACKAGE / "__init__.pyi").read_text(encoding="utf-8"))
    modules = [node for node in stub.body if isinstance(node, ast.ImportFrom)]
    listed = [(node.module, name.name, name.asname) for node in modules for name in node.names]
    assert sorted(name for _, name, _ in listed) == PUBLIC, "each once"
    for module, name, shown in listed:
        assert shown == name, "type checkers take it as public"
        value = getattr(import_module(str(module)), name)
        assert getattr(mechsheet, name) is value and value.__module__ == module, name
    assert [node.target.id for node in stub.body if isinstance(node, ast.AnnAssign)] == ["__version__"]
    assert re.match(r"\d+\.\d+", mechsheet.__version__)


def test_a_public_name_says_what_it_is() -> None:
    values = {name: getattr(mechsheet, name) for name in PUBLIC}
    assert [name for name, value in values.items() if not (inspect.isclass(value) or callable(value))] == []
    unsaid = {name: value.__doc__ for name, value in values.items() if not value.__doc__}
    signatures = {name: value.__doc__ for name, value in values.items() if str(value.__doc__).startswith(f"{name}(")}
    assert unsaid | signatures == {}, "not the signature that a dataclass makes"


def test_names_are_completed_and_told_apart() -> None:
    assert dir(mechsheet) == mechsheet.__all__ == sorted({*PUBLIC, "__version__"})
    taken = {*ROOMS, *vars(builtins), *(path.stem for path in (ROOT / "worksheets").rglob("*.py"))}
    assert set(PUBLIC) & taken == set()
    with pytest.raises(AttributeError, match="has no attribute 'fnd'"):
        mechsheet.fnd


def test_help_is_a_table_of_contents() -> None:
    contents, _, example = str(mechsheet.__doc__).partition("\n``__version__`` ")
    assert ">>> " in example
    listed = re.findall(r"^    .{16}(.*)$", contents, re.MULTILINE)
    assert sorted(re.findall(r"\w+", " ".join(listed))) == PUBLIC, "each once, behind its subject"
    shown = pydoc.plain(pydoc.render_doc(mechsheet))
    assert re.findall(r"^[A-Z][A-Z ]+$", shown, re.MULTILINE) == [
        "NAME",
        "DESCRIPTION",
        "PACKAGE CONTENTS",
        "VERSION",
        "FILE",
    ]
    assert len(shown.splitlines()) < len(str(mechsheet.__doc__).splitlines()) + 30, "no docstring of a name behind it"


def test_worksheets_and_readme_take_everything_from_the_package_itself() -> None:
    texts = {path.name: path.read_text(encoding="utf-8") for path in (ROOT / "worksheets").rglob("*.py")}
    texts["new_worksheet.txt"] = (PACKAGE / "run" / "new_worksheet.txt").read_text(encoding="utf-8")
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    texts |= {f"README {i}": block for i, block in enumerate(re.findall(r"```python\n(.*?)```", readme, re.DOTALL))}
    for name, text in texts.items():
        modules = {str(node.module) for node in imports(ast.walk(ast.parse(text))) if isinstance(node, ast.ImportFrom)}
        inner = {module for module in modules if module.startswith("mechsheet.")}
        assert inner <= {"mechsheet.units"}, name
