"""Time of writing the hitch's workbook with formulas, as a ratio to the workbook of plain numbers.

Run as ``python tests/benchmarks/bench_workbook.py``; both are written in turn, medians are compared.
"""

import statistics
import time
from pathlib import Path
from types import SimpleNamespace

from mechsheet.document import parts
from mechsheet.recording.record import record
from mechsheet.run import report
from mechsheet.workbook import inputs_sheet, writing
from mechsheet.worksheet import cells, inputs
from mechsheet.worksheet.check import Check
from mechsheet.worksheet.table import Figure, Table

ROOT = Path(__file__).resolve().parents[2]
ROUNDS = 15


def main() -> None:
    sheet = cells.load(ROOT / "worksheets" / "hitch.py")
    results = [name for name in sheet.results if name not in ("form", "part")]
    given = {"g": inputs.build(sheet.inputs, {}), "part": SimpleNamespace(value=0.2)}
    namespace = sheet.run(results, given)

    def plain() -> bytes:
        values = parts.values(namespace)
        tables, figures, checks = ([v for v in values if isinstance(v, kind)] for kind in (Table, Figure, Check))
        rows, found = inputs_sheet.rows(namespace["g"]), list(report.solved(namespace))
        return writing.workbook("Hitch", inputs=rows, found=found, tables=tables, figures=figures, checks=checks)

    def live() -> bytes:
        return report.workbook("Hitch", namespace, {})

    ways = {"plain": plain, "live": live, "recording alone": lambda: record(namespace, sheet)}
    sizes = {name: len(write()) / 1e3 for name, write in (("plain", plain), ("live", live))}
    times: dict[str, list[float]] = {name: [] for name in ways}
    for _ in range(ROUNDS):
        for name, way in ways.items():
            start = time.perf_counter()
            way()
            times[name].append(time.perf_counter() - start)
    base = statistics.median(times["plain"])
    print(f"{'':18}{'median':>10}{'ratio':>8}{'least':>10}{'ratio':>8}")
    for name, taken in times.items():
        median, least = statistics.median(taken), min(taken)
        ratios = f"{median / base:8.2f}", f"{least / min(times['plain']):8.2f}"
        print(f"{name:18}{median * 1e3:8.1f}ms{ratios[0]}{least * 1e3:8.1f}ms{ratios[1]}")
    print(", ".join(f"{name} {size:.0f} kB" for name, size in sizes.items()))


if __name__ == "__main__":
    main()
