"""What is a Greek letter in a name and what a word; what is a name in a sentence and what a grade, a fit or a unit."""

from __future__ import annotations

import re
from html import unescape
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from cells import run
from in_tex import tex

from mechsheet.document.markup import as_written, in_words, limits, meant
from mechsheet.document.mathml import symbol as mathml
from mechsheet.document.names import function
from mechsheet.html.follow import Follower
from mechsheet.html.markdown import formula
from mechsheet.html.values import html
from mechsheet.quantities.graph import Graph
from mechsheet.quantities.lines import Recording
from mechsheet.worksheet import symbol
from mechsheet.worksheet.check import Check
from mechsheet.worksheet.deviation import Deviation
from mechsheet.worksheet.drawing import Drawing
from mechsheet.worksheet.kinds import Input
from mechsheet.worksheet.said import said
from mechsheet.worksheet.symbol import Symbol, read
from mechsheet.worksheet.table import Column, Table
from mechsheet.worksheet.typeset import Numbers

WORDS = [
    "pin",
    "pins",
    "pitch",
    "pinion",
    "pivot",
    "piston",
    "pipe",
    "number",
    "nut",
    "null",
    "multiple",
    "chip",
    "chisel",
    "lamella",
    "detail",
    "detent",
    "details",
]


@pytest.mark.parametrize("word", WORDS)
def test_a_word_that_begins_as_a_greek_one_stays_whole(word: str) -> None:
    assert read(word) == Symbol(word) and symbol.text(word) == word
    assert read(f"{word}_1") == read(f"{word}1") == Symbol(word, "1")
    assert read(f"d_{word}").index == word
    assert function(f"{word}_of") == function("group_of").__class__(f"{word} of"), "a function of that name too"


LETTERS = {
    "pi_1": ("π", "1"), "nu12": ("ν", "12"), "mu": ("μ", ""), "mu_k": ("μ", "k"), "mumax": ("μ", "max"),
    "sigmav": ("σ", "v"), "phiAB": ("φ", "AB"), "etaV": ("η", "V"), "epsmin": ("ε", "min"), "lam": ("λ", ""),
    "lam_1": ("λ", "1"), "lamda": ("λ", ""), "lamda2": ("λ", "2"), "Lamda": ("Λ", ""), "Lambda_k": ("Λ", "k"),
    "lambda_1": ("λ", "1"), "lambda2": ("λ", "2"), "lambda_max": ("λ", "max"), "iota_1": ("ι", "1"),
    "upsilon1": ("υ", "1"), "Upsilon_1": ("Υ", "1"),
    "φ_1": ("φ", "1"), "β1": ("β", "1"), "δ_max": ("δ", "max"), "σmax": ("σ", "max"), "λ": ("λ", ""), "Ω_0": ("Ω", "0"),
    "φ_34_max": ("φ", "34,max"), "Р_1": ("Р", "1"), "Рмакс": ("Р", "макс"), "угол": ("угол", ""),
    "угол_1": ("угол", "1"), "größe": ("größe", ""), "länge_1": ("länge", "1"),
}  # fmt: skip


@pytest.mark.parametrize("name", LETTERS)
def test_a_letter_has_its_index(name: str) -> None:
    base, index = LETTERS[name]
    assert read(name) == Symbol(base, index)
    slanted = base if len(base) > 1 or base in "ΛΥΩ" else f"<i>{base}</i>"  # neither words nor Greek capitals
    assert as_written(name) == slanted + (f"<sub>{index}</sub>" if index else "")
    assert "_1" not in mathml(read(name))


@pytest.mark.parametrize("name", ["Phi_t", "beta_phi", "side23", "R_m", "way", "dphi", "F_Delta", "Psi"])
def test_a_symbol_looks_the_same_in_texts_and_formulas(name: str) -> None:
    formula, text = mathml(read(name)), as_written(name)
    slanted = re.findall(r"<mi>(\w)</mi>", formula)
    assert re.findall("<i>(.+?)</i>", text) == slanted
    drawn = Drawing().link(0j, 1 + 0j, name).svg()
    assert re.findall('<tspan font-style="italic">(.+?)</tspan>', drawn) == re.findall(
        r"<mi>(\w)</mi>", mathml(Symbol(read(name).base))
    )


@pytest.mark.parametrize("path", sorted(Path(__file__).parents[1].glob("worksheets/**/*.py")), ids=lambda p: p.stem)
def test_indices_in_texts_of_the_worksheets_are_upright_as_in_their_lines(path: Path) -> None:
    r"""A symbol is looked for by its look: ``$P_{gr}$`` is not that of the line ``P_gr``, ``$P_\mathrm{gr}$`` is."""
    told = re.findall(r"(?<![$\\])\$(?!\$)([^$\n]+?)\$(?!\$)", path.read_text("utf-8"))
    assert not [x for x in told if re.search(r"_\{[A-Za-z0-9,]*[A-Za-z][A-Za-z0-9,]*\}|_[A-Za-hl-z](?![A-Za-z])", x)]


def test_a_symbol_in_a_text_is_that_of_a_line() -> None:
    assert unescape(formula(r"\varphi_\mathrm{BD}")) == f"<math>{mathml(read('phi_BD'))}</math>"


def test_differences_of_greek_letters() -> None:
    assert [read(name) for name in ("dφ_1", "ΔT_1", "Δφ", "Δ_1", "dphi3", "dlambda_1", "dmax")] == [
        Symbol("φ", "1", "d"), Symbol("T", "1", "Δ"), Symbol("φ", "", "Δ"), Symbol("Δ", "1"), Symbol("φ", "3", "d"),
        Symbol("λ", "1", "d"), Symbol("dmax"),
    ]  # fmt: skip
    assert tex(read("λ_1")) == r"\lambda_{1}" and tex(read("Lamda")) == r"\Lambda"
    assert mathml(read("Р_макс")) == '<msub><mi>Р</mi><mi mathvariant="normal">макс</mi></msub>'


@pytest.mark.parametrize(
    ("sentence", "shown"),
    [
        ("bolt M12 of S235 with H7", "bolt M12 of S235 with H7"),
        ("pressure in psi", "pressure in psi"),
        ("for S235 and H7/g6, M12x1.75", "for S235 and H7/g6, M12x1.75"),
        ("bolt M12 under F12 and omega3", "bolt M12 under <i>F</i><sub>12</sub> and <i>ω</i><sub>3</sub>"),
        ("F_max of M8 -2 m", "<i>F</i><sub>max</sub> of M8 −2 m"),
        ("slope of Y23", "slope of <i>Y</i><sub>23</sub>"),
        ("σ_1 under φ2", "<i>σ</i><sub>1</sub> under <i>φ</i><sub>2</sub>"),
    ],
)
def test_in_a_sentence_only_a_name_of_the_worksheet_is_a_symbol(sentence: str, shown: str, tmp_path: Path) -> None:
    path = tmp_path / "bolt.py"
    path.write_text("import marimo\napp = marimo.App()\n@app.cell\ndef a():\n    F12 = 1\n    P23 = 2j\n    return\n")
    namespace: dict[str, Any] = {"__file__": str(path), "F12": 1, "P23": 2j}
    assert in_words(sentence, known=said(namespace)) == shown
    page = Follower(Recording(Graph(), {}), Numbers(namespace))
    assert shown in html(Check(sentence, 1.0, 2.0), page)
    assert shown in html(Table("1", "Bolt", (Column("x", "m", "", 1, np.ones(2)),), sentence), page)


def test_a_unit_in_what_a_line_means_is_none_of_its_letters() -> None:
    assert meant("pressure in psi, 40 psi at psi_1") == "pressure in psi, 40 psi at <i>ψ</i><sub>1</sub>"
    assert meant("half of psi", {"psi"}) == "half of <i>ψ</i>"
    assert symbol.prose("pressure in psi, phi3") == "pressure in psi, φ3"


def test_a_column_of_an_input_keeps_its_letter() -> None:
    cell = "from mechsheet import inputs\n@inputs\nclass A:\n    mu_k: list[float] = [0.1, 0.2]  # [-] friction\n"
    names = run(cell)
    names |= {"g": names["A"]()}
    run("from mechsheet import table\nt = table('1', 'T', g.mu_k)", names)
    assert read(names["t"].columns[0].name) == Symbol("μ", "k")


def test_a_tolerance_has_the_degrees_of_its_field() -> None:
    told = {
        unit: unescape(re.sub("<.*?>", "", limits(Input("b", unit, "", "", False, (), tolerance=Deviation(0.5)))))
        for unit in ("deg", "deg/s", "mm", "m/s**2")
    }
    assert told == {
        "deg": "±\xa00.5°",
        "deg/s": "±\xa00.5\xa0°/s",
        "mm": "±\xa00.5\xa0mm",
        "m/s**2": "±\xa00.5\xa0m/s2",
    }


def test_a_function_of_one_letter_with_an_index_is_its_symbol() -> None:
    """A Find said "f t(α)" of what stood as a symbol in its own line."""
    for name in ("f_t", "s_k", "h_max", "F_t", "f"):
        assert function(name) == read(name), name
    assert function("half_of") == function("group_of").__class__("half of")
