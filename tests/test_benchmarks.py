"""The benchmarks run, whatever has changed under them; what they measure is for who runs them to judge."""

import importlib
from pathlib import Path

import pytest

FOLDER = Path(__file__).parent / "benchmarks"
WITHOUT = {"compiled_hitch"}  # needs a compiler that is none of the project's tools


@pytest.fixture
def benchmark(monkeypatch):
    monkeypatch.syspath_prepend(FOLDER)
    return importlib.import_module


@pytest.mark.parametrize("name", sorted({path.stem for path in FOLDER.glob("*.py")} - WITHOUT))
def test_everything_that_a_benchmark_imports_is_there(benchmark, name):
    benchmark(name)


def test_workbooks_are_timed(benchmark, monkeypatch, capsys):
    bench = benchmark("bench_workbook")
    monkeypatch.setattr(bench, "ROUNDS", 1)
    bench.main()
    assert [line.split()[0] for line in capsys.readouterr().out.splitlines()[1:4]] == ["plain", "live", "recording"]


def test_a_sweep_is_timed_and_a_missing_rival_takes_one_line(benchmark, monkeypatch, capsys):
    bench = benchmark("bench_sweep")

    def absent(*_):
        raise ModuleNotFoundError("No module named 'numba'", name="numba")

    monkeypatch.setattr(bench, "compiled", absent)
    medians = bench.medians
    monkeypatch.setattr(bench, "medians", lambda *jobs, rounds: medians(*jobs, rounds=1))
    bench.whole_document([1000], rounds=1)
    said = capsys.readouterr().out.splitlines()
    assert [line for line in said if "numba" in line] == [
        "the compiled loop is not compared: numba is not installed (extra bench)"
    ]
    assert said[-1].split()[0] == "1,000"


def test_what_a_proof_takes_is_told_in_evaluations(benchmark, monkeypatch, capsys):
    bench = benchmark("bench_proof")
    monkeypatch.setattr(bench, "ROUNDS", 1)
    bench.main(["hitch", "slotted_link"])
    said = capsys.readouterr().out.splitlines()
    assert [line.split()[0] for line in said] == ["hitch", "slotted_link"]
    assert all("proof" in line and "gradient" in line for line in said)
