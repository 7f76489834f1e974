"""Checks from below, such as of a safety: the least value has its limit, with its sign, wherever it is judged."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from as_script import as_script
from own_worksheet import written
from test_recalculation import computed, edit

from mechsheet import Check, SheetError, evaluate, load
from mechsheet.html import write
from mechsheet.units import deg, mm
from mechsheet.worksheet.check import check, checks_of

if TYPE_CHECKING:
    from playwright.sync_api import Page

pytestmark = pytest.mark.filterwarnings("ignore:invalid value encountered in arccos")

SETUP = """
import numpy as np

from mechsheet import ask, check, export, inputs, read, typeset
from mechsheet.units import MPa, deg, kN, mm

@inputs
class Case:
    name: str  # load case
    F: float  # [kN] force
"""
GIVEN = """
cases: list[Case] = [Case("lift", 120 * kN), Case("hold", 90 * kN), Case("shock", 200 * kN)]  # load cases
d: float = 40 * mm  # [mm] diameter; > 0; ± 0.5
R_e: float = 355 * MPa  # [MPa] yield strength; ± 20
S_min: float = 1.5  # [-] least safety
gamma_min: float = 40 * deg  # [deg] least transmission angle
a: float = 120 * mm  # [mm] crank; > 0; ± 3
b: float = 300 * mm  # [mm] link; > 0
"""
LINES = """
sigma = g.cases.F / (np.pi * g.d**2 / 4)  # [MPa] stress
S = g.R_e / sigma  # [-] safety
phi = np.linspace(10 * deg, 170 * deg, 33)  # [deg] crank
gamma = np.arccos(g.a * np.sin(phi) / g.b)  # [deg] transmission angle
play = g.b - 2 * g.a  # [mm] clearance
N = np.where(sigma > 100 * MPa, 1e6, np.inf)  # [-] strokes that are endured
checks = [
    check("safety", S, at_least=g.S_min),
    check("transmission angle", gamma, at_least=g.gamma_min, unit="deg"),
    check("clearance", play, at_least=5 * mm, unit="mm"),
    check("least of all", -play, at_least=-100 * mm, unit="mm"),
    check("endurance", N, at_least=1e5),
    check("endless", N[:1], at_least=1e5, unit="MPa/MPa"),
    check("of several", [S, 2 * S], at_least=1),
    Check("by itself", float(S.min()), 1.5, at_least=True),
]
each = [check(f"{c.name} holds", s, at_least=g.S_min) for c, s in zip(g.cases, S)]
"""
OTHERS: list[dict[str, Any]] = [
    {},
    {"d": 30.0, "a": 190.0},
    {"a": 250.0, "gamma_min": 20.0, "S_min": -2.0},
    {"R_e": -10.0, "d": 200.0, "gamma_min": -5.0},
    {"a": 310.0},
]


@pytest.fixture(scope="module")
def sheet(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("sheet") / "rod.py"
    text = written(SETUP.replace("import ask", "import Check, ask"), GIVEN, LINES, "Rod")
    path.write_text(text.replace("    return sigma", "    typeset(*checks, *each)\n    return sigma"))
    return path


def judged(path: Path, given: dict[str, Any]) -> dict[str, Check]:
    return {check.name: check for check in checks_of(evaluate(path, ("checks", "each"), **given))}


def test_the_least_value_decides_with_its_sign() -> None:
    kept = check("angle", [30 * deg, 50 * deg], at_least=25 * deg, unit="deg")
    assert kept.passed and kept.utilised == "83.3 %" and str(kept) == "pass  angle: 30 >= 25 deg, 83.3 %"
    missed = check("play", np.array([2.0, -3.0]) * mm, at_least=-1 * mm, unit="mm")
    assert not missed.passed and np.isnan(missed.utilisation) and str(missed) == "FAIL  play: -3 >= -1 mm"
    assert not check("negative safety", -2.0, at_least=1.5).passed
    assert check("endless", np.inf, at_least=1e6).passed
    for lost in (np.nan, [1.0, np.nan], []):
        assert not check("nothing", lost, at_least=0).evaluated


@pytest.mark.parametrize(
    ("residual", "given", "told"),
    [
        (1.0, {"limit": 2, "at_least": 1}, "check S: it has at_least= and a limit: give one of them, or two checks"),
        (1.0, {"at_least": 1, "of": 1.0}, "check S: it has at_least= and of=: give one of them, or two checks"),
        (1.0, {}, "check S: it has no limit: give the limit behind the quantity, or at_least="),
        (True, {"limit": 1}, "a condition, which is no number: give a quantity and its limit, or at_least="),
        (1j, {"at_least": 1}, "check S: it has a complex number, of which none is the least"),
        (1.0, {"at_least": ">= 1"}, "check S: its limit must be one number, not '>= 1'"),
        (1.0, {"at_least": np.inf}, ""),
    ],
)
def test_what_cannot_be_judged_is_refused_in_one_line(residual: Any, given: dict[str, Any], told: str) -> None:
    if not told:
        assert check("S", residual, **given).reason == "its limit is infinite"
        return
    with pytest.raises(SheetError, match=re.escape(told)):
        check("S", residual, **given)


@pytest.mark.office
def test_cells_judge_as_the_worksheet_does(sheet: Path, recalculated_all: Any, tmp_path: Path) -> None:
    book = computed(sheet, tmp_path, {})
    edited = [edit(book, given, tmp_path / f"{n}.xlsx") for n, given in enumerate(OTHERS)]
    for given, there in zip(OTHERS, recalculated_all(edited), strict=True):
        rows = {row[0]: row for row in there["Checks"].iter_rows(min_row=3, values_only=True)}
        for name, own in judged(sheet, given).items():
            residual, limit, _, verdict = rows[name][1:5]
            assert verdict == ("PASS" if own.passed else own.verdict), (name, given)
            assert limit == pytest.approx(own.limit)
            if np.isfinite(own.residual):
                assert residual == pytest.approx(own.residual, rel=1e-12), (name, given)


def test_the_page_judges_as_the_worksheet_does(sheet: Path, tmp_path: Path, page: Page) -> None:
    file, declared = tmp_path / "rod.html", load(sheet)
    file.write_text(write.page(declared, declared.inputs()), encoding="utf-8")
    for given in OTHERS:
        page.goto("about:blank")
        page.goto(file.as_uri())
        page.wait_for_selector("body[data-ready]")
        for name, value in given.items():
            page.locator(f"#input-{name}").fill(str(value))
        shown = page.locator(".ms-check").evaluate_all("checks => checks.map(c => c.innerText)")
        own = [*judged(sheet, given).values()]
        assert len(shown) == len(own)
        for text, made in zip(shown, own, strict=True):
            assert text.startswith(("PASS" if made.passed else "FAIL") if made.evaluated else "not evaluated")
            assert made.name in text.replace("\u202f", " ")
            if made.evaluated:
                assert ("≥" if made.passed else "<") in text and (not made.utilised or made.utilised in text)


def test_within_the_tolerances_a_check_is_as_sure_as_plain_runs_say(
    sheet: Path,
) -> None:
    rng, cases = np.random.default_rng(1), 20_000
    d, R_e, a = (x + rng.uniform(-t, t, cases) for x, t in ((31.5, 0.5), (355.0, 20.0), (210.0, 3.0)))
    S = R_e * np.pi * d**2 / 4 / 200e3
    angle = np.degrees(np.arccos(a / 300))
    out = as_script(sheet, "--d=31.5", "--a=210", "--gamma_min=45.5", "--S_min=1.4", "--tolerances").stdout
    for name, share in (("safety", (S >= 1.4).mean()), ("transmission angle", (angle >= 45.5).mean())):
        told = re.search(rf"{name}: .* (?:holds )?in (\S+) % of cases", out)
        assert told and float(told[1]) == pytest.approx(100 * share, abs=2.0), out
    assert re.search(r"by itself: .*of cases", out)


@pytest.mark.parametrize(("at", "told"), [(0.985, "in all the tolerances"), (0.99, r"in 8\d(\.\d)? % of cases")])
def test_at_a_greatest_value_the_ends_of_the_tolerances_tell(at: float, told: str, tmp_path: Path) -> None:
    """By its slope a cosine of 0 keeps still."""
    path, lines = tmp_path / "turned.py", f'c = check("cosine", np.cos(g.beta), at_least={at})'
    path.write_text(written(SETUP, "beta: float = 0 * deg  # [deg] angle; ± 9.9", lines, "Turned"))
    (line,) = [x for x in as_script(path, "--tolerances").stdout.splitlines() if "cosine" in x]
    assert re.search(told, line), line


JUMPING = """
d = next(d for d in (30 * mm, 31 * mm, 32 * mm, 40 * mm) if d >= g.d_0)  # [mm] standard size
S = g.R_e * np.pi * d**2 / 4 / np.array([100 * kN, 200 * kN, 50 * kN])  # [-] safeties, some above and some below
c = check("safety", S, at_least=1.44)
"""


def test_cases_judge_it_as_plain_runs_do(tmp_path: Path) -> None:
    """Where a size jumps within the tolerances recordings tell of many cases."""
    path = tmp_path / "sizes.py"
    given = "d_0: float = 31 * mm  # [mm] least diameter; ± 1\nR_e: float = 355 * MPa  # [MPa] yield strength; ± 5"
    path.write_text(written(SETUP, given, JUMPING, "Sizes"))
    rng = np.random.default_rng(2)
    d_0, R_e = 31 + rng.uniform(-1, 1, 50_000), 355 + rng.uniform(-5, 5, 50_000)
    d = np.where(d_0 <= 31, 31, 32)
    share = (R_e * np.pi * d**2 / 4 / 200e3 >= 1.44).mean()
    assert 0.05 < share < 0.15
    (line,) = [x for x in as_script(path, "--tolerances").stdout.splitlines() if "safety" in x]
    told = re.search(r"in (\S+) % of", line)
    assert told and float(told[1]) == pytest.approx(100 * share, abs=3), line


def test_a_scene_sets_what_must_be_at_least(sheet: Path) -> None:
    for bound, told in (("min = 5.0", "FAIL  safety: 2.2305 >= 5"), ("max = 5.0", r"'safety' must be {min = NUMBER}")):
        scene = sheet.with_name("scene.toml")
        scene.write_text(f'want = ["S"]\n[limits]\n"safety" = {{{bound}}}\n')
        ran = as_script(sheet, f"--scene={scene}")
        assert ran.returncode and told in ran.stdout + ran.stderr
