"""Sweeps: every variant as if it were alone, wherever it is computed, and a reason for each that has no value."""

import gc
import subprocess
import sys
import tracemalloc
from concurrent.futures import Executor, Future, ProcessPoolExecutor, ThreadPoolExecutor
from multiprocessing import get_all_start_methods, get_context
from pathlib import Path
from threading import Event

import numpy as np
import pandas as pd
import pytest
from by_cells import by_cells
from own_worksheet import own

from mechsheet.studies import chunks
from mechsheet.studies.sensitivity import sensitivity
from mechsheet.studies.sweep import Sweep, grid, sweep
from mechsheet.studies.tolerance import tolerance
from mechsheet.worksheet.cells import load
from mechsheet.worksheet.errors import SheetError
from mechsheet.worksheet.lines import registry

ROOT = Path(__file__).parents[1]
HITCH = ROOT / "worksheets" / "hitch.py"
SOME = ["L4", "GS6", "R01"]  # a number, a field, a complex field


@pytest.fixture(scope="module")
def numbers() -> list[str]:
    """Every number and field of the hitch that a line declares with its unit."""
    sheet = load(HITCH)
    drawn = ("drawing", "stroke", "position", "workbook", "verdict")
    cells = [cell for cell in sheet.cells if not cell.name.startswith(drawn)]
    names = sheet.run([name for cell in cells for name in cell.gives if name != "form"], {"g": sheet.inputs()})
    given = {name for cell in cells for name in cell.gives}
    return [name for name in registry(names) if name in given and not callable(names[name])]


def table(count: int, width: float, seed: int = 1) -> dict[str, np.ndarray]:
    """Random variants of some inputs that a designer changes."""
    rng = np.random.default_rng(seed)
    default = {"X01": 0.415, "L5": 0.48, "L6": 0.515, "L56": 1.035, "S_min": 0.42, "P6": 27500, "phi_P6": 90}
    return {name: x * (1 + width * rng.uniform(-1, 1, count)) for name, x in default.items()}


def same(a: Sweep, b: Sweep) -> bool:
    """The same to the last bit."""
    return all(a[name].tobytes() == b[name].tobytes() for name in a.names) and list(a.reasons) == list(b.reasons)


# --- values ------------------------------------------------------------------------------------------------------


def test_every_number_of_every_variant_is_the_one_of_the_worksheet_alone_to_the_last_bit(numbers):
    variants = table(6, 0.05)
    swept = sweep(HITCH, numbers, variants)

    assert len(numbers) == 168 and swept.solved.all() and swept.at_once
    for i in range(6):
        alone = by_cells(HITCH, numbers, **{name: float(values[i]) for name, values in variants.items()})
        for name in numbers:
            assert np.array_equal(swept[name][i], alone[name]), (name, i)


def test_chunks_and_neighbours_change_nothing():
    variants = table(14, 0.2)
    whole = sweep(HITCH, SOME, variants)

    assert 1 < whole.solved.sum() < 13, "both kinds are here"
    for chunk in (1, 5, 14):
        assert same(sweep(HITCH, SOME, variants, chunk=chunk), whole)
    order = np.random.default_rng(2).permutation(14)
    mixed = sweep(HITCH, SOME, {name: values[order] for name, values in variants.items()})
    assert np.array_equal(mixed["GS6"], whole["GS6"][order], equal_nan=True)
    assert list(mixed.reasons) == list(whole.reasons[order])


def test_a_grid_has_an_axis_for_each_input():
    swept = sweep(HITCH, ["GS6", "L4"], grid(L5=[0.47, 0.48, 0.49], P6=[20e3, 30e3]))

    assert (swept.shape, swept["GS6"].shape, swept["L4"].shape) == ((3, 2), (3, 2, 10), (3, 2))
    assert np.array_equal(swept["GS6"][2, 1], by_cells(HITCH, ["GS6"], L5=0.49, P6=30e3)["GS6"])
    assert np.array_equal(swept.inputs["P6"], [[20e3, 30e3]] * 3)


def test_one_set_of_numbers_is_one_variant():
    swept = sweep(HITCH, SOME, {"P6": 30e3})
    assert swept.shape == () and swept.reasons[()] == "" and swept["GS6"].shape == (10,)
    assert np.array_equal(swept["GS6"], by_cells(HITCH, ["GS6"], P6=30e3)["GS6"])


def test_texts_and_a_data_frame_are_read_as_the_page_reads_them():
    texts = sweep(HITCH, ["GS6"], {"L5": ["0,48", "0.47"], "phi_P6": ["90", "85"]})
    frame = sweep(HITCH, ["GS6"], pd.DataFrame({"L5": [0.48, 0.47], "phi_P6": [90, 85]}))
    headed = sweep(HITCH, ["GS6"], pd.DataFrame({"L5 [mm]": ["480,0", 470], "phi_P6 [deg]": [90, 85]}))
    assert same(texts, frame) and same(texts, headed)
    for head, why in (("L5 [kN]", "kN does not measure m"), ("L5 [parsec]", "parsec"), (" L5", "input  L5 is unknown")):
        with pytest.raises(SheetError, match=why.replace("[", r"\[")):
            sweep(HITCH, ["GS6"], {head: [0.48]})


def test_values_in_display_units_and_as_a_frame():
    swept = sweep(HITCH, ["L4", "P_gc", "P56_S", "phi3_S"], {"P6": [20e3, 25e3], "X6": [0.8, 9e99]})

    assert np.array_equal(swept.display("P_gc")[0], swept["P_gc"][0] / 1e6)
    frame = swept.frame()
    assert list(frame) == [
        *("variant", "position", "P6 [N]", "X6 [m]", "L4 [m]", "Pgc [MPa]", "X56 [m]", "Y56 [m]", "phi3 [deg]"),
        "reason",
    ]
    assert len(frame) == 20 and list(frame["position"][:11]) == [*range(10), 0]
    assert frame["Y56 [m]"][3] == swept["P56_S"][0, 3].imag
    assert frame["L4 [m]"][9] == swept["L4"][0]
    assert frame["reason"][19].startswith("centre of mass from the suspension axis, along the ground X6 = 9e+99 m")
    assert list(sweep(HITCH, ["L4"], {"P6": [1, 2]}).frame()) == ["variant", "P6 [N]", "L4 [m]", "reason"]


# --- variants without a value ------------------------------------------------------------------------------------


REFUSED = [
    ({"L5": -0.1}, "lower link, to the lifting rod L5 = -0.1 m must be positive"),
    ({"phi_P6": 180}, "angle of the mast to the x axis at work phi_P6 = 180.0 deg must be < 180 deg"),
    ({"S_min": 0.9}, "least length of the cylinder S_min = 0.9 m must be < S_max = 0.67 m"),
    ({"P6": float("nan")}, "weight of the implement P6 = nan N must be a finite number"),
    ({"P6": 1e70}, "weight of the implement P6 = 1e+70 N must be at most 1e+60 in size"),
    ({"k_gc": 1.5}, "number of cylinders k_gc = 1.5 must be a whole number"),
    ({"S_min": 0.2}, "no position closes for cylinder S = 0.2 m: it reaches 0.3732591..0.7732591 m"),
    (
        {"Y56_min": -2},
        "lifting rod L4: height Y56 of the suspension axis reaches -0.555..1.289 m by 97 samples, -2 m is outside",
    ),
    (
        {"Y_P56": 3},
        "working stroke S_p: height Y56 of the suspension axis reaches 0.2..1.043 m by 97 samples, 3 m is outside",
    ),
    ({"S_max": 0.9}, "no position closes for cylinder S = 0.7933333 m: it reaches 0.3732591..0.7732591 m"),
]


@pytest.fixture(scope="module")
def refused() -> Sweep:
    """Each of them among the others, and the worksheet's own inputs before and after."""
    default = {"L5": 0.48, "phi_P6": 90, "S_min": 0.42, "S_max": 0.67, "P6": 27500, "k_gc": 2}
    default |= {"Y56_min": 0.2, "Y_P56": 0.4}
    variants = [default, *(default | given for given, _ in REFUSED), default]
    return sweep(HITCH, SOME, {name: [variant[name] for variant in variants] for name in default})


@pytest.mark.parametrize(("given", "reason"), REFUSED)
def test_a_variant_without_a_value_tells_why(refused, given, reason):
    i = 1 + REFUSED.index((given, reason))
    assert refused.reasons[i] == reason and not refused.solved[i] and np.isnan(refused["GS6"][i]).any()


def test_a_text_that_is_no_number_tells_so():
    swept = sweep(HITCH, ["L4"], {"P6": [27500, "much"]})
    assert list(swept.reasons) == ["", "weight of the implement P6 = 'much' N is no number"]
    assert list(np.isnan(swept["L4"])) == [False, True]


def test_the_neighbours_of_variants_without_a_value_go_on(refused):
    alone = by_cells(HITCH, SOME)
    for i in (0, -1):
        assert refused.reasons[i] == "" and refused.solved[i]
        assert all(np.array_equal(refused[result][i], alone[result]) for result in SOME)


def test_reasons_are_those_with_which_the_worksheet_alone_refuses():
    variants = table(24, 0.4) | {"Y_P56": np.linspace(0.1, 1.5, 24), "Y56_min": np.linspace(-0.6, 0.4, 24)}
    swept = sweep(HITCH, SOME, variants)

    kinds = ("no position closes for cylinder S = ", "lifting rod L4: height", "working stroke S_p: height")
    assert all(any(reason.startswith(kind) for reason in swept.reasons) for kind in kinds)
    refused = 0
    for i in np.flatnonzero(~swept.solved):
        try:
            alone = by_cells(HITCH, SOME, **{name: float(values[i]) for name, values in variants.items()})
        except SheetError as error:
            refused += 1
            assert swept.reasons[i] == str(error)
            assert np.isnan(swept["GS6"][i]).all()
        else:
            assert np.array_equal(np.isnan(swept["GS6"][i]), np.isnan(alone["GS6"]))
            assert swept.reasons[i].startswith("no position closes for ")
    assert refused > 5


def test_all_variants_may_fail_for_a_reason_they_share_in_a_few_runs(monkeypatch):
    runs = []
    monkeypatch.setattr(chunks, "_run", lambda *args, run=chunks._run: runs.append(0) or run(*args))
    swept = sweep(HITCH, ["GS6"], {"P6": np.linspace(1e3, 2e3, 500), "Y_P56": 3})

    assert set(swept.reasons) == {
        "working stroke S_p: height Y56 of the suspension axis reaches 0.2..1.043 m by 97 samples, 3 m is outside"
    }
    assert np.isnan(swept["GS6"]).all() and len(runs) < 50, "not one run for each of them"


def test_nothing_to_compute_is_no_error():
    assert np.isnan(sweep(HITCH, ["L4"], {"L5": [-1, -2]})["L4"]).all()
    none = sweep(HITCH, ["L4"], {"L5": []})
    assert none["L4"].shape == (0,) and none.frame().empty


@pytest.mark.parametrize(
    ("want", "given", "error", "message"),
    [
        (["GS66"], {"P6": [1, 2]}, SheetError, "GS66 is defined by no cell"),
        (["GS6"], {"P66": [1, 2]}, SheetError, "input P66 is unknown; nearest: P6"),
        (
            ["GS6"],
            {"P6": [1, 2], "L5": [1, 2, 3]},
            SheetError,
            r"one shape or broadcast: P6 \(2,\), L5 \(3,\)",
        ),
        (["GS6"], {"N_pol": [10, 20]}, SheetError, r"GS6 has shape \(..,\) in one variant and \(..,\) in"),
        (["table_31"], {"P6": [1, 2]}, TypeError, "table_31 is no number and cannot be swept"),
    ],
)
def test_what_is_wrong_for_all_variants_is_said_at_once(want, given, error, message):
    with pytest.raises(error, match=message):
        sweep(HITCH, want, given)
    with pytest.raises(SheetError, match="chunk = 0 variants must be at least 1 and whole"):
        sweep(HITCH, ["L4"], {"P6": [1, 2]}, chunk=0)


# --- which cells run ---------------------------------------------------------------------------------------------

SHEET = '''
import marimo

app = marimo.App()

with app.setup:
    import os
    import signal
    from pathlib import Path

    import numpy as np

    from mechsheet import typeset
    from mechsheet import inputs

    from collections import UserList
    RUNS = UserList()  # which each run goes on with: a list is as the setup made it

@app.class_definition
@inputs
class Lever:
    F: float = 100.0  # [N] force; > 0
    l: float = 0.5  # [m] length
    n: int = 5  # [-] positions; > 1

    """Inputs."""

@app.cell
def given():
    g = Lever()
    return (g,)

@app.cell
def angles(g):
    RUNS.append("angles")
    phi = np.linspace(0, 1, g.n)  # [deg] angle
    typeset()
    return (phi,)

@app.cell
def moment(g, phi):
    RUNS.append("moment")
    {act}

    def M(phi):
        RUNS.append("M")
        return g.F * g.l * np.sin(phi)  # [N*m] moment

    def twice(phi):
        return M(phi) + M(phi)  # [N*m] two levers

    typeset()
    return M, twice

@app.cell
def results(M, phi, twice):
    M_S = M(phi)  # [kN*cm] moment
    M_2 = twice(phi)  # [N*m] two levers
    M_mean = np.mean(M_S)  # [N*m] mean moment
    M_max = np.max(M_S, axis=-1, keepdims=True)  # [N*m] greatest moment
    W = np.trapezoid(M_S, phi) / 2  # [J] half of the work over the positions
    typeset()
    return M_2, M_S, M_max, M_mean, W

@app.cell
def chart(M_S):
    raise RuntimeError("nobody asked for the chart")
    chart = M_S
    return (chart,)
'''


@pytest.fixture
def lever(tmp_path):
    """A small worksheet whose ``moment`` cell first does what is given, as one or several lines."""

    def write(act: str = "pass") -> Path:
        path = tmp_path / "lever.py"
        path.write_text(SHEET.replace("{act}", act.replace("\n", "\n    ").replace("FOLDER", repr(str(tmp_path)))))
        return path

    return write


def test_only_the_cells_that_the_results_need_are_run_and_their_functions_once_for_the_same_arguments(lever):
    path = lever()
    forces = np.linspace(1, 2, 30)
    sweep(path, ["M_2", "M_max"], {"F": forces})  # found to take arrays
    runs = load(path).common["RUNS"]
    runs.clear()
    swept = sweep(path, ["M_2", "M_max"], {"F": forces}, chunk=10)

    assert runs == ["angles", "moment", "M"] * 3
    assert np.array_equal(swept["M_2"], 2 * forces[:, None] * 0.5 * np.sin(np.linspace(0, 1, 5)))
    assert swept["M_max"].shape == (30,) and swept.units == {"F": "N", "M_2": "N*m", "M_max": "N*m"}


def test_a_worksheet_whose_lines_mix_the_variants_is_run_one_by_one(lever):
    forces = np.array([3.0, -1, 1, 2])
    swept = sweep(lever(), ["M_mean", "M_S"], {"F": forces})

    assert not swept.at_once
    assert list(swept.reasons) == ["", "force F = -1.0 N must be positive", "", ""]
    expected = forces * 0.5 * np.mean(np.sin(np.linspace(0, 1, 5)))
    assert swept["M_mean"] == pytest.approx(np.where(forces > 0, expected, np.nan), rel=1e-15, nan_ok=True)


def test_what_a_chunk_computes_is_gone_with_it(lever):
    """Not when somebody looks for rings, which numpy's arrays do not make happen any sooner."""
    path = lever("import weakref\nRUNS.append(weakref.ref(phi))")
    gc.disable()
    try:
        sweep(path, ["M_S"], {"F": np.linspace(1, 2, 12)}, chunk=3)
        arrays = [ran() for ran in load(path).common["RUNS"] if callable(ran)]
    finally:
        gc.enable()
    assert len(arrays) >= 4 and set(map(type, arrays)) == {type(None)}


@pytest.mark.parametrize("count", [2, 5, 12])  # five are as many as the positions
def test_a_number_over_the_positions_goes_at_once_without_their_axis(lever, count):
    path, forces = lever(), np.linspace(1, 2, count)
    swept = sweep(path, ["W", "M_S"], {"F": forces}, chunk=5)
    assert swept.at_once and swept["W"].shape == (count,) and swept["M_S"].shape == (count, 5)
    assert swept["W"] == pytest.approx([by_cells(path, ["W"], F=F)["W"] for F in forces], rel=1e-14)


def test_kinetostatics_goes_at_once_with_its_work_and_energy():
    path = ROOT / "worksheets" / "kinetostatics.py"
    swept = sweep(path, ["M_mean", "W_1", "driven"], {"l1": [0.09, 0.1]})
    alone = by_cells(path, swept.names, l1=0.09)
    assert swept.at_once and all(swept[name][0] == pytest.approx(alone[name], rel=1e-9) for name in swept.names)


def test_a_number_of_positions_may_vary_where_the_results_are_numbers(lever):
    swept = sweep(lever(), ["M_max"], {"n": [2, 3]})
    assert not swept.at_once and swept["M_max"].shape == (2,)
    with pytest.raises(SheetError, match=r"M_S has shape \(.,\) in one variant and \(.,\) in another"):
        sweep(lever(), ["M_S"], {"n": [2, 3]})


def test_any_worksheet_can_be_swept():
    joint = ROOT / "worksheets" / "joint.py"
    swept = sweep(joint, ["P_k"], {"r": [100, 101]})
    assert not swept.at_once and np.array_equal(swept["P_k"][1], by_cells(joint, ["P_k"], r=101)["P_k"])


def test_an_error_in_a_formula_is_no_reason_but_an_error(lever):
    with pytest.raises(NameError, match="nothing"):
        sweep(lever("nothing"), ["M_S"], {"F": [1, 2]})


def test_what_one_variant_alone_refuses_costs_the_others_nothing(lever):
    """An error that names no variant is traced to those that raise it."""
    path = lever("if 17 in np.array(g.F).view(np.ndarray): raise ValueError('17 is not liked')")
    swept = sweep(path, ["M_S"], {"F": np.arange(1.0, 101)})

    assert list(np.flatnonzero(~swept.solved)) == [16] and swept.reasons[16] == "17 is not liked"
    assert np.isnan(swept["M_S"][16]).all() and np.isfinite(np.delete(swept["M_S"], 16, axis=0)).all()


def test_a_nan_that_nothing_explains_is_named(lever):
    path = lever()
    path.write_text(path.read_text().replace("np.linspace(0, 1, g.n)", "np.linspace(0, 1, g.n) * np.sqrt(g.F - 1.5)"))
    swept = sweep(path, ["M_2"], {"F": [1, 2]})
    assert list(swept.reasons) == ["phi has no value", ""]


def test_a_function_that_changes_what_another_gave_is_stopped(lever):
    with pytest.raises(ValueError, match="read-only"):
        chunks._remembered(lambda x: x + 1)(np.zeros(3))[0] = 1


def test_functions_are_remembered_by_the_very_argument_and_forgotten_with_it():
    calls = []
    f = chunks._remembered(lambda x, k=1: calls.append(k) or np.divide(1, x))
    x = np.array([2.0])
    with np.errstate(divide="ignore"):
        assert f(x) is f(x) and f(0.0) == np.inf and f(-0.0) == -np.inf
        count = len(calls)
        f(x, k=2), f(x.copy()), f(np.array([2.0]))
    assert len(calls) == count + 3
    assert [f(np.array([float(i)]))[0] for i in range(1, 100)] == [1 / i for i in range(1, 100)], "an id is used again"


def test_memory_is_what_the_results_need(lever):
    forces = np.linspace(1, 2, 100_000)
    tracemalloc.start()
    swept = sweep(lever(), ["M_S"], {"F": forces})
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()

    assert peak < swept["M_S"].nbytes + 15 * forces.nbytes, "the inputs in a few forms, and no second copy of a field"


def test_a_sweep_starts_without_pandas_altair_and_scipy():
    code = (
        "import sys; from mechsheet import sweep; sweep('worksheets/hitch.py', ['GS6'], {'P6': [1, 2]});"
        "print(sorted({'pandas', 'altair', 'scipy', 'openpyxl', 'distributed'} & sys.modules.keys()))"
    )
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True)
    assert done.stdout == "[]\n"


# --- executors ---------------------------------------------------------------------------------------------------


def processes() -> ProcessPoolExecutor:
    """A process: where that can be, a copy of one that has loaded what it needs, as some are killed."""
    context = get_context("forkserver" if "forkserver" in get_all_start_methods() else "spawn")
    if context.get_start_method() == "forkserver":
        context.set_forkserver_preload(["pytest", "mechsheet.studies.sweep"])
    return ProcessPoolExecutor(1, mp_context=context)


@pytest.fixture(scope="module")
def serial() -> Sweep:
    return sweep(HITCH, SOME, table(40, 0.2), chunk=6)


def test_threads_give_the_same(serial):
    with ThreadPoolExecutor(2) as executor:
        assert same(sweep(HITCH, SOME, table(40, 0.2), chunk=6, executor=executor), serial)


def test_processes_give_the_same_and_are_left_to_their_owner(serial):
    with processes() as executor:
        assert same(sweep(HITCH, SOME, table(40, 0.2), chunk=6, executor=executor), serial)
        assert executor.submit(abs, -1).result() == 1


KILL_ONCE = """if np.ndim(g.F) and 5 in g.F.view(np.ndarray):
    mark = Path(FOLDER) / "killed"
    if not mark.exists():
        mark.touch()
        os.kill(os.getpid(), getattr(signal, "SIGKILL", signal.SIGTERM))"""
FORCES = np.arange(1.0, 41)  # 5 is none of those that are tried before


def test_the_chunk_of_a_killed_worker_is_computed_again_by_a_new_pool(lever, tmp_path):
    swept = sweep(lever(KILL_ONCE), ["M_S"], {"F": FORCES}, chunk=4, executor=processes)

    assert (tmp_path / "killed").exists()
    assert same(swept, sweep(lever(KILL_ONCE), ["M_S"], {"F": FORCES}, chunk=4))


def test_without_a_new_pool_the_chunks_left_are_computed_here_with_a_warning(lever, tmp_path):
    with processes() as executor, pytest.warns(RuntimeWarning, match="the executor broke, .* chunks are computed here"):
        swept = sweep(lever(KILL_ONCE), ["M_S"], {"F": FORCES}, chunk=4, executor=executor)

    assert (tmp_path / "killed").exists()
    assert same(swept, sweep(lever(KILL_ONCE), ["M_S"], {"F": FORCES}, chunk=4))


def test_a_chunk_that_kills_every_worker_ends_the_sweep(lever):
    path = lever("if np.ndim(g.F) and 5 in g.F.view(np.ndarray): os.kill(os.getpid(), signal.SIGTERM)")
    with pytest.raises(RuntimeError, match="the executor broke 3 times without one chunk done"):
        sweep(path, ["M_S"], {"F": FORCES}, chunk=40, executor=processes)


def test_a_worksheet_that_changes_during_the_sweep_is_noticed(lever):
    path = lever("if np.ndim(g.F) and 5 in g.F.view(np.ndarray): Path(FOLDER, 'lever.py').write_text('changed')")
    with pytest.raises(RuntimeError, match="has changed during the sweep"):
        sweep(path, ["M_S"], {"F": FORCES}, chunk=4)


class Interrupted(Executor):
    """A thread that is busy until it is freed, and Ctrl-C when thirty chunks have been handed out."""

    def __init__(self) -> None:
        self.thread, self.freed, self.futures = ThreadPoolExecutor(1), Event(), list[Future]()
        self.thread.submit(self.freed.wait)

    def submit(self, fn, /, *args, **kwargs):
        if len(self.futures) == 30:
            raise KeyboardInterrupt
        self.futures.append(self.thread.submit(fn, *args, **kwargs))
        return self.futures[-1]


def test_an_interrupt_here_ends_the_sweep(lever):
    path = lever("if np.ndim(g.F) and 5 in g.F.view(np.ndarray): raise KeyboardInterrupt")
    with pytest.raises(KeyboardInterrupt):
        sweep(path, ["M_S"], {"F": FORCES}, chunk=4)


def test_an_interrupt_takes_back_what_was_handed_out(lever):
    executor = Interrupted()
    with pytest.raises(KeyboardInterrupt):
        sweep(lever(), ["M_S"], {"F": FORCES}, chunk=1, executor=executor)
    executor.freed.set()
    executor.thread.shutdown()
    assert [future.cancelled() for future in executor.futures] == [True] * 30


def test_dask_gives_the_same_and_computes_the_chunk_of_a_killed_worker_again(lever, tmp_path):
    from distributed import Client, LocalCluster

    options = {"n_workers": 1, "threads_per_worker": 1, "host": "127.0.0.1", "dashboard_address": None}
    with LocalCluster(**options) as cluster, Client(cluster) as client:
        path = lever(KILL_ONCE)
        swept = sweep(path, ["M_S"], {"F": FORCES}, chunk=4, executor=client.get_executor())
        assert (tmp_path / "killed").exists()
        assert same(swept, sweep(path, ["M_S"], {"F": FORCES}, chunk=4))


SAME_NAMES = """
F = 4 * g.F  # [kN] force, called as a number is
a_S = 2 * x * g.a  # [-] field, whose heading is that of an input"""


def test_a_result_called_as_an_input_has_its_own_unit_and_column(tmp_path):
    sheet = own(tmp_path, SAME_NAMES)
    swept = sweep(sheet.path, ["F", "a_S"], {"F": [1.0, 2.0], "a": [0.5, 0.5]})
    assert (swept.units["F"], swept.input_units["F"]) == ("kN", "-") and swept.display("F").tolist() == [0.004, 0.008]
    frame = swept.frame()
    assert [*frame] == ["variant", "position", "g.F [-]", "a [-]", "F [kN]", "a_S [-]", "reason"]
    assert frame["g.F [-]"].tolist() == [1.0] * 5 + [2.0] * 5 and frame["F [kN]"].iloc[-1] == 0.008
    found = sensitivity(sheet.path, ["F"], ["F"])
    assert found.unit("F", "F") == "kN" and found.slopes["F"].tolist() == pytest.approx([0.004])
    banded = tolerance(sheet.path, ["F"], {"F": 0.5})
    assert float(banded["F"].greatest) == pytest.approx(0.012) and "F ± 0.5 of" not in banded.table("1", "").note


def test_a_variant_for_which_something_is_none_lacks_its_value_and_no_other_does(tmp_path):
    sheet = own(
        tmp_path, "d = next((d for d in [1.0, 2.0, 2.5] if d >= g.F), None)  # [-] taken\nm = 2 * d  # [-] twice"
    )
    found = sweep(sheet.path, ["m"], {"F": [1.5, 3.0, 2.2]})
    np.testing.assert_array_equal(found["m"], [4.0, np.nan, 5.0])
    assert [bool(why) for why in found.reasons] == [False, True, False] and "d is None" in found.reasons[1]
