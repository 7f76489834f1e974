"""Worksheets with some lines of one's own, recorded, and what is read from the recording for other inputs."""

import re
from collections.abc import Iterable, Sequence
from pathlib import Path
from textwrap import indent
from typing import Any

import numpy as np
from by_cells import by_cells

from mechsheet.quantities.lines import Recording
from mechsheet.readers.numbers import numbers
from mechsheet.recording.record import record
from mechsheet.worksheet import cells

IMPORTS = """import math
from math import sqrt, sin, hypot
import numpy as np
from numpy import cos, exp, interp, linspace
from mechsheet import export, figure, rrr, table, typeset""".replace("\n", "\n    ")
SHEET = '''
import marimo
app = marimo.App()

with app.setup:
    IMPORTS
    from mechsheet import ask, find, read, inputs

@app.class_definition
@inputs
class Own:
    F: float = 2.5  # [-] number
    a: float = 0.75  # [-] part
    n: int = 5  # [-] positions; > 1
    k: int = 2  # [-] choice; >= 0 < 4

    """Inputs."""

@app.cell
def given():
    form = ask(Own)
    return (form,)

@app.cell
def machine(form):
    g = read(Own, form)
    return (g,)

@app.cell
def lines(g):
    IMPORTS
    x = linspace(0.1, 2, g.n) * g.F  # [-] field
    LINES
    table_1 = table("1", "All", x)
    typeset()
    return

if __name__ == "__main__":
    app.run()
'''
OTHER: list[dict[str, Any]] = [{"F": 3.25}, {"F": 1.75, "a": 1.5}, {"a": 0.2, "k": 3}]


def own(tmp_path: Path, lines: str, inside: bool = False, further: Sequence[str] = ()) -> cells.Worksheet:
    """A worksheet with some lines in a cell, which imports what they need itself where it is ``inside``.

    The ``further`` ones are cells of their own behind it.
    """
    path = tmp_path / "own.py"
    setup, cell = ("", IMPORTS) if inside else (IMPORTS, "")
    text = SHEET.replace("IMPORTS", setup, 1).replace("IMPORTS", cell, 1)
    text = text.replace("LINES", lines.replace("\n", "\n    "))
    others = (f"@app.cell\ndef _():\n    {each.replace(chr(10), chr(10) + '    ')}\n    return\n\n" for each in further)
    path.write_text(text.replace("if __name__", "".join([*others, "if __name__"])))
    return cells.load(path)


def recorded(sheet: cells.Worksheet, **given: Any) -> tuple[dict[str, Any], Recording]:
    names = sheet.run(sheet.results, {"g": sheet.inputs(**given)})
    return names, record({**names, "__file__": sheet.path})


def value_of(recording: Recording, name: str, given: dict[str, Any]) -> Any:
    """A recorded line for other inputs: its parts by their names in the recording."""
    nodes = {known: node for node, known in recording.names.items()}
    found = [nodes[n] for n in (name, f"{name}x", f"{name}y") if n in nodes]
    assert found, f"{name} is not in the recording"
    known = numbers(found, {recording.inputs[key]: float(x) for key, x in given.items()})
    values = [known[node] for node in found]
    return values[0] if len(values) == 1 else values[0] + 1j * values[1]


def assert_followed(sheet: cells.Worksheet, recording: Recording, others: Iterable[dict[str, Any]]) -> None:
    """The recorded ``result`` for other inputs is what the cells of the worksheet give for them."""
    for given in others:
        own_value = by_cells(sheet.path, ["result"], **given)["result"]
        np.testing.assert_allclose(value_of(recording, "result", given), own_value, rtol=1e-12, err_msg=str(given))


ELSEWHERE: list[dict[str, Any]] = [{}, *OTHER, {"F": 4.0, "a": 1.0}, {"F": 2.5000001}, {"n": 3}, {"n": 8, "F": 3.25}]


def written(setup: str, given: str, lines: str, title: str = "") -> str:
    """A worksheet by the lines of its setup, of its inputs and of its cell; it is exported where it has a title."""
    names = [line.split(" = ")[0] for line in lines.splitlines() if re.match(r"\w+ = ", line)]
    gives = f"({names[0]},)" if len(names) == 1 else ", ".join(names)
    end = f'@app.cell\ndef workbook():\n    export("{title}", globals())\n    return\n\n\n' if title else ""
    return f"""import marimo

app = marimo.App()

with app.setup:
{indent(setup.strip(), "    ")}


@app.class_definition
@inputs
class Given:
{indent(given.strip(), "    ")}

    \"\"\"Inputs.\"\"\"


@app.cell
def form():
    form = ask(Given)
    return (form,)


@app.cell
def given(form):
    g = read(Given, form)
    return (g,)


@app.cell
def lines(g):
{indent(lines.strip(), "    ")}
    return {gives}


{end}if __name__ == "__main__":
    app.run()
"""
