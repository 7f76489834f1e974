"""What proof and slopes of the five documents take, as multiples of one evaluation of the worksheet.

Run as ``python tests/benchmarks/bench_proof.py``. Times are those of the processor, the least of several rounds in
turn: of an evaluation by the worksheet's cells, its recording, the proof of all its numbers, the gradient of its last
number by all inputs, and slopes of all its numbers by all inputs.
"""

import time
from collections.abc import Callable, Iterable
from pathlib import Path

from mechsheet.quantities.node import Node
from mechsheet.readers.gradients import gradient
from mechsheet.readers.slopes import slopes, unfollowed
from mechsheet.recording.record import record
from mechsheet.run.proving import proof_of
from mechsheet.worksheet.cells import load

WORKSHEETS = Path(__file__).resolve().parents[2] / "worksheets"
DOCUMENTS = ("hitch", "landing_gear", "kinetostatics", "slotted_link", "joint")
ROUNDS = 5


def jobs(stem: str) -> dict[str, Callable[[], object]]:
    sheet = load(WORKSHEETS / f"{stem}.py")
    g = sheet.inputs()
    names = sheet.run(sheet.results, {"g": g})
    recording, exact = record(names, sheet), record(names, sheet, exact=True)
    by = [node for node in recording.inputs.values() if node.value.dtype.kind == "f"]
    columns = [column for columns in recording.tables.values() for column in columns if column is not None]
    nodes: list[Node] = [node for column in columns for node in column.parts if not unfollowed([node], by)]
    return {
        "evaluation": lambda: sheet.run(sheet.results, {"g": g}),
        "recording": lambda: record(names, sheet),
        "proof": lambda: proof_of(names, sheet, exact),
        "gradient": lambda: gradient(nodes[-1], 0, by),
        "all slopes": lambda: slopes(nodes, by),
    }


def least(work: dict[str, Callable[[], object]]) -> dict[str, float]:
    taken = dict.fromkeys(work, float("inf"))
    for _ in range(ROUNDS):
        for name, job in work.items():
            start = time.process_time()
            job()
            taken[name] = min(taken[name], time.process_time() - start)
    return taken


def main(documents: Iterable[str] = DOCUMENTS) -> None:
    for stem in documents:
        seconds = least(jobs(stem))
        one = seconds["evaluation"]
        told = ", ".join(f"{name} {own / one:.1f}" for name, own in seconds.items() if name != "evaluation")
        print(f"{stem:14} evaluation {1e3 * one:.0f} ms, in these: {told}")


if __name__ == "__main__":
    main()
