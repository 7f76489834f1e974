"""Stiff and extreme scenes: how many digits a result can keep, and how many it keeps.

Inputs are rounded to 16 digits, so 16 - log10(kappa) digits of a result with the condition number kappa (`conditions`)
can be expected, whatever the method. A result holds where it keeps them, less at most one.

A scene is a TOML file in the folder ``scenes`` beside this one: ``[inputs]`` in display units, as for a script, and a
table ``[extreme]``:

===========  ======================================================================================================
``about``    what the scene is, in words
``job``      which job of `JOBS` it is run through: a worksheet's name, a group's, ``ring`` or ``through_dead_centre``
``over``     the inputs that take one of the ``values`` after the other; left out where there is one case
``values``   these values, in display units: one for all of these inputs, or a list with one for each
``at``       the position of the table that is measured: 0 is the first, -1 the last
``says``     words that must be said, of what cannot exist; then no digits are measured
===========  ======================================================================================================
"""

import tomllib
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import lru_cache, partial
from itertools import chain
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np

from mechsheet.accuracy import arithmetic, exact, printed, rivals, sections
from mechsheet.accuracy.arithmetic import Numbers, mpf
from mechsheet.accuracy.assur import KINDS
from mechsheet.accuracy.chains import crank_chain
from mechsheet.accuracy.pump import FORCES
from mechsheet.accuracy.truths import TRUTHS
from mechsheet.document.error_chart import FULL, SPARE
from mechsheet.mechanics.joint import circular_joint
from mechsheet.mechanics.planar import angle
from mechsheet.run.progress import progress
from mechsheet.worksheet import inputs
from mechsheet.worksheet.cells import Worksheet, load
from mechsheet.worksheet.check import Check, assembled
from mechsheet.worksheet.verdict import listen

SCENES = Path(__file__).parent / "scenes"


@dataclass(frozen=True)
class Scene:
    """What a scene file says."""

    name: str
    about: str
    job: str
    inputs: Mapping[str, Any]
    over: Sequence[str] = ()
    values: Sequence[Any] = (None,)
    at: int = -1
    says: str = ""

    def cases(self) -> list[dict[str, Any]]:
        """Inputs in display units, case by case."""
        each = (value if isinstance(value, list) else [value] * len(self.over) for value in self.values)
        return [{**self.inputs, **dict(zip(self.over, values, strict=True))} for values in each]


@dataclass(frozen=True)
class Outcome:
    """One result of one case: condition number, digits expected, digits kept by the printed formulas and the product.

    ``printed`` is NaN where the documents have no formula. ``words`` is what the product said instead of a result.
    """

    scene: str
    case: str
    result: str
    condition: float
    expected: float
    printed: float
    product: float
    words: str = ""
    wanted: str = ""

    @property
    def holds(self) -> bool:
        """Whether the product keeps the expected digits, less `SPARE`, or says the words that are wanted."""
        if self.wanted:
            return self.wanted in self.words
        return self.product >= self.expected - SPARE


@dataclass(frozen=True)
class Case:
    """One case: what the product said, and how its results, the true and the printed ones of inputs x are computed.

    ``product`` and ``printed`` get the true results, whose names they need. The true results are those of x with the
    factors of ``rounding`` in it, of numbers found that are rounded before they are used. ``changes`` are those of
    results by relative changes of other such numbers.
    """

    words: str
    true: Callable[..., Numbers]
    x: Mapping[str, Any]
    product: Callable[[Numbers], Mapping[str, Any]]
    printed: Callable[[Numbers], Mapping[str, Any]]
    changes: Mapping[str, Any] = field(default_factory=dict)
    rounding: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True, kw_only=True)
class MeasuredScene(Scene):
    """A scene with all its outcomes."""

    outcomes: Sequence[Outcome]

    @property
    def words(self) -> str:
        """Its name."""
        return self.name.replace("_", " ")

    @property
    def margin(self) -> float:
        """Digits kept less digits expected, the least of all results."""
        return min(o.product - o.expected for o in self.outcomes)

    @property
    def hardest(self) -> Outcome:
        """The result whose printed formula loses most beyond its condition; else that of the greatest one."""
        told = [o for o in self.outcomes if o.expected > SPARE and np.isfinite(o.condition)]
        return max(told, key=lambda o: (o.expected - o.printed if np.isfinite(o.printed) else -99, o.condition))


def scenes() -> list[Scene]:
    """The listed scenes: files that come with the package."""
    return [read(path) for path in sorted(SCENES.glob("*.toml"))]


def read(path: Path) -> Scene:
    """Scene from a file."""
    facts = tomllib.loads(path.read_text(encoding="utf-8"))
    extreme: dict[str, Any] = facts["extreme"]
    return Scene(name=path.stem, inputs=facts.get("inputs", {}), **extreme)


def measured_scenes(worksheets: Path, short: bool) -> list[MeasuredScene]:
    """Every listed scene with all results of its cases; see `measure`."""
    listed, found = scenes(), list[MeasuredScene]()
    with progress(len(listed), "scenes") as done:
        for scene in listed:
            found.append(MeasuredScene(**vars(scene), outcomes=measured(scene.name, worksheets, short)))
            done()
    return found


def measured(name: str, worksheets: Path, short: bool) -> Sequence[Outcome]:
    """Every result of every case of a listed scene; the same worksheets are measured once."""
    texts = tuple(path.read_bytes() for path in sorted(worksheets.glob("*.py")))
    return _measured(name, worksheets, texts, short)


@lru_cache(maxsize=256)  # a cell runs again where it is recorded
def _measured(name: str, worksheets: Path, texts: tuple[bytes, ...], short: bool) -> tuple[Outcome, ...]:
    with listen():  # what a scene's worksheet does not find is no news of the run that measures it
        return tuple(measure(read(SCENES / f"{name}.toml"), worksheets, short))


def measure(scene: Scene, worksheets: Path, short: bool = False) -> list[Outcome]:
    """Every result of every case of a scene; ``worksheets`` is their folder.

    In the short form the first case, the last and the one in the middle.
    """
    found: list[Outcome] = []
    last, cases = len(scene.values) - 1, scene.cases()
    for k in sorted({0, last // 2, last}) if short else range(last + 1):
        given, value = cases[k], scene.values[k]
        case = ", ".join(map(_written, value)) if isinstance(value, list) else _written(value)
        run = partial(JOBS[scene.job], worksheets, given, scene.at)
        if scene.says:
            found.append(Outcome(scene.name, case, "", np.nan, np.nan, np.nan, np.nan, _words(run), scene.says))
        else:
            found += outcomes(run(), scene.name, case)
    return found


def _written(value: Any) -> str:
    return "" if value is None else str(value)


@np.errstate(over="ignore")  # beside a result that is next to nothing any change is infinite
def outcomes(job: Case, scene: str = "", case: str = "") -> list[Outcome]:
    """Digits of all results of a case.

    One that does not exist must be NaN or infinite, unless the rounding of an input decides whether it exists.
    """
    found, true = list[Outcome](), job.true(**{**job.x, **job.rounding})
    conditions, product, formulas = arithmetic.conditions(job.true, job.x), job.product(true), job.printed(true)
    exist = {name: arithmetic.exist(y) for name, y in true.items()}
    told = {name: bool(np.all(np.isfinite(product[name]))) for name in true}
    undecided = arithmetic.undecided(job.true, job.x) if exist != told else set()
    for name, y in true.items():
        exists, given = exist[name], told[name]
        kappa, kept, by_formula = 1.0, 0.0 if given else FULL, np.nan
        if exists:
            more = float(np.nan_to_num(job.changes.get(name, 0.0)) / abs(complex(y))) if job.changes and y else 0.0
            kappa, kept = max(1.0, float(conditions[name] + more)), digits(name, product[name], y)
            by_formula = digits(name, formulas[name], y) if name in formulas else np.nan
        if exists != given and name in undecided:
            kappa = np.inf
        expected = float(np.clip(FULL - np.log10(kappa), 0.0, FULL))
        found.append(Outcome(scene, case, name, kappa, expected, by_formula, kept, job.words))
    return found


def digits(name: str, value: Any, true: Any) -> float:
    """Digits that a value keeps of the true one, from 0 to 16; an angle may be counted in any turn."""
    if not np.all(np.isfinite(value)):
        return 0.0
    error = arithmetic.relative_error(value, true, 2 * np.pi if name.startswith(("phi", "psi")) else None)
    return float(np.clip(-np.log10(error), 0.0, FULL)) if error else FULL


def _words(run: Callable[[], Case]) -> str:
    """What is said where something cannot be computed: an error, or the reasons of the checks that fail."""
    try:
        return run().words
    except ValueError as error:
        return str(error)


def _reasons(checks: Iterable[Check]) -> str:
    return "; ".join(check.reason for check in checks if not check.passed and check.reason)


def _worksheet(path: Path, given: Mapping[str, Any]) -> tuple[Worksheet, Any]:
    sheet = load(path)
    return sheet, inputs.build(sheet.inputs, given)


def _row(names: Mapping[str, Any], wanted: Iterable[str], at: int) -> dict[str, Any]:
    """The results at one position of the table."""
    return {name: names[name][at] if np.ndim(names[name]) else names[name] for name in wanted}


def hitch(worksheets: Path, given: Mapping[str, Any], at: int = -1) -> Case:
    """The hitch worksheet; the printed formulas get the true lengths, as the document's Find is another matter."""
    sheet, g = _worksheet(worksheets / "hitch.py", given)
    names = sheet.run(["S", "checks_closing"], {"g": g})
    S = float(names["S"][at])
    rounding = {name: mpf(float(x)) / x for name, x in exact.finds(g).items()}

    def true(S: Any, L4: Any, S_p: Any, L7: Any, **inputs: Any) -> Numbers:
        x, rounded = SimpleNamespace(**inputs), {"L4": L4, "S_p": S_p, "L7": L7}
        results = exact.hitch(x, S, **{name: length * rounded[name] for name, length in exact.finds(x).items()})
        # section 7 finds I56 and IS6 again, as products of numbers that are worse conditioned than they are
        return {name: result for name, result in results.items() if name not in ("Imp", "Isp")}

    return Case(
        words=_reasons(names["checks_closing"]),
        true=true,
        x={"S": S, **dict.fromkeys(rounding, 1.0), **exact.numbers(g)},
        rounding=rounding,
        product=lambda true: _row(sheet.run(true, names), true, at),
        printed=lambda true: printed.hitch(sheet, g, S, **{name: float(true[name]) for name in rounding}),
    )


def document(stem: str, worksheets: Path, given: Mapping[str, Any], at: int = -1) -> Case:
    """A worksheet at one of its positions, which counts as an input of what follows."""
    sheet, g = _worksheet(worksheets / f"{stem}.py", given)
    truth = TRUTHS[stem]
    names = sheet.run([truth.field], {"g": g})
    position = float(names[truth.field][at])

    def true(position: Any, **g: Any) -> Numbers:
        found = truth.results(SimpleNamespace(**g), position)
        return {name: found[name] for name in _OF_SCENES.get(stem, found)}

    def as_printed(true: Numbers) -> Mapping[str, Any]:
        if stem == "landing_gear":
            return printed.landing_gear(g, position)
        made = _row(sheet.run(chain(*_AS_PRINTED[stem].values()), names), chain(*_AS_PRINTED[stem].values()), at)
        return {name: _polar(*map(made.__getitem__, of)) for name, of in _AS_PRINTED[stem].items()}

    return Case(
        words="",
        true=true,
        x={"position": position, **exact.numbers(g)},
        product=lambda true: _row(sheet.run(true, names), true, at),
        printed=as_printed,
    )


# What scenes look at of a document with many results: all reactions, and the motion that they come from.
_OF_SCENES = {
    "kinetostatics": (
        *("B", "E", "K", "omega3", "omega4", "omega6", "v5", "v6", "eps2", "eps3", "eps4", "eps6", "a_E"),
        *(*FORCES, "M_76", "M_b"),
    ),
}
# Which lines of a worksheet are the printed way to a result: a root that Find has, magnitude and angle of a force.
_AS_PRINTED: Mapping[str, Mapping[str, Sequence[str]]] = {
    "slotted_link": {"SAB_k": ("SAB_F",), "VAB_k": ("VAB_F",), "WAB_k": ("WAB_F",), "phi3_k": ("phi3_F",)}
    | {"omega_BC_k": ("omega3_F",), "eps_BC_k": ("eps3_F",)},
    "kinetostatics": {
        "R_A": ("R12", "gamma12"),
        "R_B": ("R23", "gamma23"),
        "R_C": ("R03", "gamma03"),
        "R_D": ("R34", "gamma34"),
        "R_E": ("R45", "gamma45"),
        "R_05": ("R05", "gamma05"),
        "R_K": ("R36", "gamma36"),
        "R_H": ("R07", "gamma07"),
        "R_76": ("R76", "gamma76"),
        "M_b": ("M_b",),
    },
}


def _polar(size: Any, direction: Any = None) -> Any:
    return size if direction is None else size * np.exp(1j * direction)


def joint(worksheets: Path, given: Mapping[str, Any], at: int = -1) -> Case:
    """The rectangular joint of the joint worksheet in the plane ``at`` under one load case, M and N."""
    load = {"M": 3e5, "N": -13e3} | {name: given[name] for name in ("M", "N") if name in given}
    others = {name: value for name, value in given.items() if name not in load}
    sheet, g = _worksheet(worksheets / "joint.py", {**others, "loads": [{**load, "M_w": 0}]})
    names = sheet.run(["sigma", "P", "y_no", "axes", "steps", "checks_joint"], {"g": g})
    p = range(2)[at]
    product = {f"sigma_{i}": value for i, value in enumerate(names["sigma"][p, 0])} | {"P": names["P"][p, 0]}
    step = names["steps"][p, 0, 0]
    formulas = {"y_0": names["axes"][step - 1, p, 0, 0] if step else np.nan}
    return Case(
        words=_reasons(names["checks_joint"]),
        true=lambda **x: sections.joint(g, x, p + 1),
        x=sections.factors(g),
        product=lambda _: product | {"y_0": names["y_no"][p, 0, 0]},
        printed=lambda _: formulas,
    )


_LENGTHS = {"RRR": "r_B", "RRP": "r_A", "RPR": "e"}  # whose reach a group of the library tells


def group(name: str, _worksheets: Path, given: Mapping[str, Any], _at: int = -1) -> Case:
    """Position, velocities, accelerations and reactions of one of the `KINDS` of groups by the library.

    Inputs are the real numbers that it is given (`Kind.numbers`); what is left out is 0.
    """
    kind = KINDS[name]
    x = {part: float(value) for part, value in given.items()}
    z = kind.joined(x, float, complex)
    found, group = kind.by_library(z), kind.group(z)
    checks = []
    if name in _LENGTHS:
        length = _LENGTHS[name]
        at = next(iter(found.values()))
        checks = [assembled(f"{name} closes", at, z[length], group.reach, f"length {length}", "m")]
    formulas = (
        printed.dyad(branch=1, **{key: z[key] for key in _PRINTED}) if name == "RRR" and _lengthens_alone(x) else {}
    )
    moved = kind.changes_by_rounding(z)
    return Case(_reasons(checks), kind.exact_of, x, lambda _: found, lambda _: formulas, moved)


_PRINTED = ("A", "B", "r_A", "r_B", "P_A", "P_B", "F_A", "F_B")


def _lengthens_alone(x: Mapping[str, float]) -> bool:
    """Whether a group moves as the cylinder of the printed formulas does: by the length of AC, 1 m for each second."""
    return x.get("dr_A") == 1 and not any(name.startswith(("v_", "a_", "dr_B", "ddr_", "T_")) for name in x)


def ring(_worksheets: Path, given: Mapping[str, Any], _at: int = -1) -> Case:
    """Circular joint of 24 even bolts by the library. Inputs: its radius r, moment M, normal force N."""
    phi = 2 * np.pi * np.arange(24) / 24
    found = circular_joint(phi=phi, **given)
    return Case(
        words="",
        true=lambda **x: sections.ring(phi.tolist(), **x),
        x=given,
        product=lambda true: {name: getattr(found, name) for name in true},
        printed=lambda _: printed.ring(phi=phi, **given),
    )


def through_dead_centre(_worksheets: Path, given: Mapping[str, Any], _at: int = -1) -> Case:
    """Four-bar linkage whose crank passes a near-dead centre of coupler and rocker.

    The product assembles it at the end; in the place of ``printed`` formulas the velocity equations are integrated from
    start to end by DOP853. Inputs: links a (crank), b, c, frame b + c - a - gap, angles of the crank theta_0, theta_1.
    """
    a, b, c, gap, *turn = (float(given[name]) for name in ("a", "b", "c", "gap", "theta_0", "theta_1"))
    d = b + c - a - gap
    linkage = crank_chain(a, d, b, c)
    (start,), (end,) = map(linkage.groups, turn)

    def integrated(_: Numbers) -> Mapping[str, Any]:
        first = angle([start.AC, start.BC])
        phi2, phi3 = rivals.integrated(linkage, turn, first, "DOP853", 1e-12, 1e-12)[:, -1]
        return {"C": d + c * np.exp(1j * phi3), "phi2": phi2, "phi3": phi3}

    return Case(
        words="",
        true=exact.four_bar,
        x={"a": a, "b": b, "c": c, "d": d, "theta": turn[-1]},
        product=lambda _: {"C": end.C, "phi2": angle(end.AC), "phi3": angle(end.BC)},
        printed=integrated,
    )


JOBS: Mapping[str, Callable[[Path, Mapping[str, Any], int], Case]] = {
    "hitch": hitch,
    **{stem: partial(document, stem) for stem in ("landing_gear", "slotted_link", "kinetostatics")},
    "joint": joint,
    "ring": ring,
    **{name: partial(group, name) for name in KINDS},
    "through_dead_centre": through_dead_centre,
}
