"""Error against run time: errors, places and the front of known methods, and how they are timed and shown."""

import re
import sys
from io import BytesIO
from pathlib import Path
from zipfile import ZipFile

import mpmath as mp
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mechsheet.accuracy import timing
from mechsheet.accuracy.arithmetic import EPS
from mechsheet.accuracy.precision import Comparison, Job, Measured, Method, largest_error
from mechsheet.accuracy.timing import TURNS, Timed, measured_on, time_spread, timed, times_of_one
from mechsheet.run.progress import progress
from mechsheet.studies.sweep import sweep
from mechsheet.workbook import writing

ROOT = Path(__file__).resolve().parents[1]
OWN = Measured("own", "", 3e-16, 1.0)


def job(*rows: Measured) -> Comparison:
    return Comparison("1", "Job", (OWN, *rows))


# Errors


def test_error_counts_from_the_exact_number_and_not_from_its_float():
    tenth = mp.mpf(1) / 10
    off = float(abs(mp.mpf(0.1) - tenth))
    with mp.workdps(50):
        fine = [mp.mpf(1) / 3 + mp.mpf("1e-12")]
    assert largest_error([0.1, 1 + 3e-13], [tenth, mp.mpf(1)]) == pytest.approx(3e-13, rel=1e-3)
    assert off < EPS and largest_error([0.1], [tenth]) == EPS
    assert largest_error([1 / 3], fine) == pytest.approx(3e-12, rel=1e-4)


def test_error_is_relative_to_the_largest_number_and_ends_at_one():
    truth = [mp.mpc(3, 4), mp.mpf(1)]
    assert largest_error([3 + 4j, 1.05], truth) == pytest.approx(0.01)
    assert [largest_error(found, truth) for found in ([30 + 40j, 1], [3 + 4j, np.nan], [np.inf, 1])] == [1, 1, 1]
    assert largest_error(np.array([[3 + 4j], [1]]), truth) == EPS


# Places


@pytest.mark.parametrize(
    ("error", "seconds", "place"),
    [
        (1e-10, 0.1, "faster, fewer digits"),
        (1e-10, 9.0, "slower, fewer digits"),
        (9e-16, 0.1, "faster, the same digits"),  # a few units in the last place are no more digits, nor fewer
        (1.2e-16, 0.1, "faster, the same digits"),
        (1.2e-16, 0.89, "faster, the same digits"),  # beyond a tenth the sign of the difference decides
        (1.2e-16, 0.91, "no difference"),
        (1.2e-16, 1.09, "no difference"),
        (1.2e-16, 1.11, "slower, the same digits"),
        (1e-10, 0.95, "the same time, fewer digits"),
    ],
)
def test_place_beside_the_own_method(error, seconds, place):
    assert job(row := Measured("other", "", error, seconds)).place(row) == place


@pytest.mark.parametrize(
    ("error", "seconds", "low", "high", "runs", "place"),
    [
        (3e-16, 0.7, 0.5, 0.8, 9, "faster, the same digits"),
        (3e-16, 0.7, 0.5, 0.9, 9, "no difference"),
        (3e-16, 0.7, 0.5, 0.9, 4, "faster, the same digits"),  # quartiles of a few runs say nothing
        (3e-16, 1.4, 1.2, 1.6, 9, "slower, the same digits"),
        (3e-16, 1.4, 1.1, 1.6, 9, "no difference"),
        (3e-16, 1.4, 1.1, 1.6, 4, "slower, the same digits"),
        (1e-10, 0.7, 0.5, 1.0, 9, "the same time, fewer digits"),
        (1e-18, 0.7, 0.5, 1.0, 9, "no difference"),  # both are rounding
    ],
)
def test_times_whose_quartiles_overlap_are_no_difference(error, seconds, low, high, runs, place):
    own = Measured("own", "", 3e-16, 1.0, 0.9, 1.1, 9)
    found = Comparison("1", "Job", (own, row := Measured("other", "", error, seconds, low, high, runs)))
    assert found.place(row) == place and found.better == ()
    accurate = Comparison("1", "Job", (Measured("own", "", 1e-9, 1.0, 0.9, 1.1, 9), row))
    assert bool(accurate.better) == place.startswith("faster")


def test_a_table_says_why_a_method_is_not_used_where_it_is_faster_at_no_fewer_digits():
    rows = [Measured("quick", "", 3e-16, 0.5, why="checks nothing"), Measured("rough", "", 1e-3, 0.1, why="rough")]
    rows += [Measured("better", "", 1e-20, 0.6, why="new"), Measured("slow", "", 3e-16, 9.0, why="slow")]
    columns = {column.symbol: column.values.tolist() for column in job(*rows).table().columns}
    assert columns["not used"] == ["", "checks nothing", "", "new", ""]
    worse = Comparison("1", "", (Measured("own", "", 1e-9, 1.0), *rows))
    assert worse.why(rows[2]) == "new" and worse.fastest is rows[0]


def test_errors_are_told_in_roundings_times_the_condition_number():
    found = Comparison("1", "", (OWN, Measured("other", "", 1e-10, 1.0)), condition=50.0).table().columns
    (column,) = (column for column in found if column.symbol == "roundings")
    assert column.values == pytest.approx([3e-16 / 50 / 2**-53, 1e-10 / 50 / 2**-53])
    (column,) = (column for column in job().table().columns if column.symbol == "roundings")
    assert np.isnan(column.values).all(), "a dash where nobody knows"


def test_a_method_that_is_faster_and_more_accurate_is_named_and_the_check_fails():
    better = Measured("better", "1e-14", 1e-14, 0.5)
    bad = Comparison("1", "Job", (Measured("own", "", 1e-12, 1.0), better, Measured("worse", "", 1e-3, 0.1)))
    assert bad.better == (better,)
    assert not bad.check().passed and bad.check().residual == pytest.approx(2)
    assert job(better).check().passed and job(better).better == ()


def test_time_does_not_count_in_the_check():
    assert job(Measured("other", "", 3e-16, 1e-9)).check().passed
    assert not Comparison("1", "", (Measured("own", "", 1e-9, 1e-9), Measured("slow", "", 1e-15, 1e9))).check().passed


exponents = st.tuples(st.integers(-16, 0), st.integers(-6, 3))


@given(st.lists(exponents, min_size=1, max_size=20))
def test_front_holds_those_that_nothing_surpasses_and_no_others(places):
    rows = [Measured(str(i), "", 10.0**e, 10.0**t) for i, (e, t) in enumerate(places)]
    front = Comparison("1", "", tuple(rows)).front
    for row in rows:
        surpassed = any(
            (o.seconds <= row.seconds and o.error < row.error) or (o.seconds < row.seconds and o.error <= row.error)
            for o in rows
        )
        same = any((row.seconds, row.error) == (f.seconds, f.error) for f in front)
        assert same == (not surpassed)


def test_summary_takes_the_fastest_setting_of_the_most_digits_of_each_family():
    newton = [Measured("Newton", f"{k}", 10.0**-k, 1 + k) for k in (3, 8, 15)] + [Measured("Newton", "16", 1e-16, 40)]
    summary, table = job(*newton).summary(), job(*newton).table()
    assert list(summary.columns[1].values) == ["", "15"]
    assert list(table.columns[1].values) == ["", "3", "8", "15", "16"]
    assert np.allclose(table.columns[5].values, [1, 4, 9, 16, 40])


# Timing


class Clock:
    """One that goes on only in runs, each of which takes the next of its times."""

    def __init__(self, monkeypatch):
        self.now, self.calls = 0.0, []
        monkeypatch.setattr(timing, "perf_counter", lambda: self.now)

    def run(self, name, *times):
        left = iter(times)

        def once():
            self.calls.append(name)
            self.now += next(left, times[-1])
            return name

        return once


def test_methods_run_turn_about_warmed_up_and_medians_are_taken(monkeypatch):
    """Turns of a quarter: 'cold' takes half a second the first time and then an eighth, 'slow' more than its turn."""
    clock = Clock(monkeypatch)
    cold, slow = clock.run("cold", 0.5, 0.125), clock.run("slow", 0.9, 0.3, 0.5, 0.4)
    found = timed([cold, slow, clock.run("fast", 0.0625)], 1.25)
    assert [time.result for time in found] == ["cold", "slow", "fast"]
    assert [time.runs for time in found] == [10, TURNS, 20]
    assert [time.seconds for time in found] == pytest.approx([0.125, 0.4, 0.0625]), "the first times do not count"
    assert (found[1].low, found[1].high) == pytest.approx((0.4, 0.4))
    turn = ["cold"] * 2 + ["slow"] + ["fast"] * 4
    assert clock.calls == ["cold", "slow", "fast", *turn * TURNS]


def test_a_bar_counts_turns_whose_time_is_the_same(monkeypatch):
    """After the first round the time that is left is told from that which is behind: a fifth of it after each turn."""
    clock, steps = Clock(monkeypatch), []
    runs = [clock.run("short", 2.0**-8), clock.run("long", 0.5)]
    timed(runs, 1.25, lambda: steps.append(clock.now))
    assert len(steps) == timing.STEPS * len(runs)
    rounds = np.diff([steps[k] for k in range(1, len(steps), 2)])
    assert rounds.tolist() == [0.75] * TURNS, "a quarter of a second of the short one, and one run of the long one"


def test_what_takes_a_second_runs_once(monkeypatch):
    clock = Clock(monkeypatch)
    assert timed([clock.run("long", 100.0)], 6.0) == [("long", 100.0, 100.0, 100.0, 1)] and clock.calls == ["long"]


def test_the_spread_of_a_few_times_is_a_dash():
    spread, runs = time_spread([Timed(None, 2.0, 1.0, 4.0, n) for n in (1, 2, 3, 9)])
    assert spread.texts() == ["–", "–", "75", "75"] and runs.values.tolist() == [1, 2, 3, 9]


def test_times_of_one_have_the_slope_of_their_growth(monkeypatch):
    """'each' takes a time for every one of them, 'all' the same for as many; 'square' stops at 10."""
    now = [0.0]
    monkeypatch.setattr(timing, "perf_counter", lambda: now[0])

    def way(of):
        def once(n):
            now[0] += of(n)

        return once

    ways = {"each": way(lambda n: 0.001 * n), "all": way(lambda n: 0.02), "square": way(lambda n: 1e-4 * n**2)}
    table = times_of_one("1", "Time", (1, 10, 100), int, ways, 0.01, {"square": 10})
    columns = {column.symbol: column.values for column in table.columns}
    assert list(columns) == ["way", "1", "10", "100", "slope", "spread", "runs"]
    assert columns["slope"] == pytest.approx([1, 0, 2])
    assert columns["100"][:2] == pytest.approx([1000, 200]) and np.isnan(columns["100"][2])
    assert columns["1"] == pytest.approx([1000, 20000, 100]) and np.all(columns["runs"] >= TURNS)


def test_the_machine_is_told_by_its_model_its_software_and_its_load():
    told = {column.symbol: column.values[0] for column in measured_on("0.1").columns}
    assert told["scipy"][0].isdigit() and told["numpy"] == np.__version__ and told["cores"] >= 1
    assert told["processor"] and told["load before"] >= 0 and told["load after"] >= 0
    facts = Path("/proc/cpuinfo")
    if facts.exists() and "model name" in (text := facts.read_text()):
        assert f": {told['processor']}\n" in text


def test_compare_returns_errors_and_times_in_order():
    ways = [Method("numpy", "", lambda: [np.pi, np.e]), Method("rough", "2", lambda: [3.14, 2.72])]
    found = Job("7", "Constants", [mp.pi, mp.e], ways).compare(1e-4)
    assert [(row.family, row.setting) for row in found.rows] == [("numpy", ""), ("rough", "2")]
    assert found.rows[0].error == EPS and found.rows[1].error == pytest.approx((2.72 - np.e) / np.pi)
    assert all(row.seconds > 0 for row in found.rows)


# What is shown


def test_table_shows_texts_powers_and_the_workbook_keeps_them():
    table = job(Measured("Newton <5>", "1e-03", 4.2e-12, 2.0)).table()
    page = table._mime_()[1]
    assert "4.2·10⁻¹²" in page and "Newton &lt;5&gt;" in page and "slower, fewer digits" in page
    assert "[]" not in page
    assert list(table.frame().columns) == [
        *("method", "setting", "error [-]", "digits [-]", "time [ms]", "ratio [-]", "place", "not used"),
        *("roundings [-]", "spread [%]", "runs [-]"),
    ]


def test_the_least_time_is_not_shown_as_nothing():
    assert "0.00004" in job(Measured("other", "", 4e-16, 4.1e-5)).table()._mime_()[1]
    assert "2.000<" in job(Measured("other", "", 4e-16, 2.0)).table()._mime_()[1]


def test_chart_of_the_workbook_is_logarithmic_with_a_series_for_each_family():
    found = job(*(Measured("Newton", f"{k}", 10.0**-k, 1 + k) for k in (3, 8, 15)))
    data = writing.workbook("T", inputs=[], found=[], tables=[found.table()], figures=[found.figure()], checks=[])
    with ZipFile(BytesIO(data)) as file:
        chart = file.read("xl/charts/chart1.xml").decode()
    assert chart.count('<c:logBase val="10"/>') == 2
    assert re.findall(r"<c:f>'1 Job'!(\S+)</c:f>", chart) == ["$F$5", "$C$5", "$F$6:$F$8", "$C$6:$C$8"]
    assert re.findall(r"<c:tx><c:v>(.*?)</c:v>", chart) == ["own", "Newton"]


def layers(found):
    spec = found.figure().chart().to_dict()
    return [
        (layer["mark"]["type"], spec["datasets"][layer["data"]["name"]] if "data" in layer else None)
        for layer in spec["layer"]
    ]


def test_figure_marks_the_own_method_and_joins_the_front():
    found = layers(job(Measured("rough", "", 1e-3, 0.01), Measured("slow", "", 1e-10, 5.0)))
    assert [mark for mark, _ in found] == ["rect", "text", "line", "line", "point", "point"]
    assert [(p["x"], p["error"]) for p in found[2][1]][1:-1] == [(0.01, 1e-3), (1.0, 3e-16)]


def test_red_field_holds_what_is_faster_and_more_accurate_beyond_rounding():
    """It ends where errors are rounding: a method there is no better than one of the same digits."""
    own = Measured("own", "", 1e-9, 2.0)
    found = layers(Comparison("1", "Job", (own, Measured("better", "", 1e-15, 1.0))))
    (grey,), (red,) = (data for mark, data in found if mark == "rect")
    assert (red["right"], red["error"], red["high"]) == (1.0, 8 * EPS, 1e-9)
    assert (grey["error"], grey["high"]) == (1e-16, 8 * EPS)


def test_progress_is_drawn_on_a_terminal_only(monkeypatch, capsys):
    with progress(2, "Job") as done:
        done()
    assert capsys.readouterr().err == ""
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True)
    with progress(2, "Job") as done:
        done()
        drawn = capsys.readouterr().err
        assert f"[{'#' * 10}{'.' * 10}] 1 of 2  Job  0 s left" in drawn
    assert len(drawn.split("\r")[-1]) < 80 and capsys.readouterr().err.strip() == ""


def test_progress_of_a_part_has_no_bar_of_its_own(monkeypatch, capsys):
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True)
    with progress(2, "Job") as done:
        capsys.readouterr()
        with progress(3, "Part") as done_part:
            done_part()
        assert capsys.readouterr().err == ""
        done()
        assert "Job" in capsys.readouterr().err


def test_a_sweep_of_several_chunks_has_a_bar_on_a_terminal(monkeypatch, capsys):
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True)
    sweep(ROOT / "worksheets" / "examples" / "bucket.py", ["mu_2"], {"L_DE": [0.42, 0.44, 0.46]}, chunk=1)
    assert "2 of 3" in capsys.readouterr().err
    sweep(ROOT / "worksheets" / "examples" / "bucket.py", ["mu_2"], {"L_DE": [0.42, 0.44, 0.46]})
    assert capsys.readouterr().err == ""
