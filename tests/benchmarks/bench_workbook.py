"""Time of writing the hitch's workbook with formulas, as a ratio to the workbook of plain numbers.

Run as ``python tests/benchmarks/bench_workbook.py``; both are written in turn, medians are compared.
"""

import statistics
import time
from pathlib import Path
from types import SimpleNamespace

from mechsheet.run import report
from mechsheet.worksheet import cells, inputs

ROOT = Path(__file__).resolve().parents[2]
ROUNDS = 15


def main() -> None:
    sheet = cells.load(ROOT / "worksheets" / "hitch.py")
    results = [name for name in sheet.results if name not in ("form", "part")]
    given = {"g": inputs.build(sheet.inputs, {}), "part": SimpleNamespace(value=0.2)}
    namespace = sheet.run(results, given)
    whole = report.workbook("Tractor hitch", namespace, {})
    kept, report.record = report.record, lambda namespace: None
    plain = report.workbook("Tractor hitch", namespace, {})
    times: dict[str, list[float]] = {"plain": [], "live": [], "recording alone": []}
    for _ in range(ROUNDS):
        for name, record in (("plain", lambda namespace: None), ("live", kept)):
            report.record = record
            start = time.perf_counter()
            report.workbook("Tractor hitch", namespace, {})
            times[name].append(time.perf_counter() - start)
        start = time.perf_counter()
        kept(namespace)
        times["recording alone"].append(time.perf_counter() - start)
    report.record = kept
    base = statistics.median(times["plain"])
    print(f"{'':18}{'median':>10}{'ratio':>8}{'least':>10}{'ratio':>8}")
    for name, taken in times.items():
        median, least = statistics.median(taken), min(taken)
        ratios = f"{median / base:8.2f}", f"{least / min(times['plain']):8.2f}"
        print(f"{name:18}{median * 1e3:8.1f}ms{ratios[0]}{least * 1e3:8.1f}ms{ratios[1]}")
    print(f"size: plain {len(plain) / 1e3:.0f} kB, live {len(whole) / 1e3:.0f} kB")


if __name__ == "__main__":
    main()
