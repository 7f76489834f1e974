"""Size of the worksheets' numbers as scripts of a page, and time of an evaluation in Chromium.

Run as ``python tests/benchmarks/bench_html.py [NAME ..]``. Changed inputs are those on which most rests: all are moved
by a millionth from one evaluation to the next, so that whatever is found is found anew; "again" changes none of them.
"""

import gzip
import sys
from pathlib import Path
from shutil import which

from playwright.sync_api import sync_playwright

from mechsheet.html import javascript
from mechsheet.quantities.lines import Recording
from mechsheet.quantities.node import Node
from mechsheet.recording.record import record
from mechsheet.worksheet import cells

ROOT = Path(__file__).resolve().parents[2] / "worksheets"
NAMES = ("hitch", "landing_gear", "slotted_link", "kinetostatics", "joint")
ROUNDS = 200
TIMED = """([rounds, moved]) => {
  %s
  const inputs = k => Object.fromEntries(Object.entries(moved).map(([name, x]) => [name, x * (1 + k * 1e-6)]));
  const timed = change => {
    const times = [];
    for (let k = 0; k < rounds; k++) {
      const start = performance.now();
      evaluate(inputs(change * k));
      times.push(performance.now() - start);
    }
    return times.sort((a, b) => a - b)[rounds >> 1];
  };
  timed(1);
  return [timed(0), timed(1)];
}"""


def main(names: tuple[str, ...] = NAMES) -> None:
    print(f"{'':16}{'kB':>8}{'gzip':>8}{'again, ms':>12}{'changed, ms':>14}")
    with sync_playwright() as playwright:
        chromium = which("chromium") or which("chromium-browser") or which("google-chrome")
        browser = playwright.chromium.launch(executable_path=chromium, args=["--no-sandbox"])
        page = browser.new_page()
        for name in names:
            sheet = cells.load(ROOT / f"{name}.py")
            recording = record({**sheet.run(sheet.results, {"g": sheet.inputs()}), "__file__": sheet.path}, sheet)
            script = javascript.module(recording, shown(recording))
            moved = {
                key: float(node.value)
                for key, node in recording.inputs.items()
                if node.value.dtype.kind == "f" and not node.shape
            }
            again, changed = page.evaluate(TIMED % script, [ROUNDS, moved])
            size = len(script.encode()) / 1e3
            print(f"{name:16}{size:8.1f}{len(gzip.compress(script.encode())) / 1e3:8.1f}{again:12.2f}{changed:14.2f}")
        browser.close()


def shown(recording: Recording) -> dict[str, Node]:
    """Columns of tables and figures, and what checks compare."""
    columns = [column for columns in recording.tables.values() for column in columns if column is not None]
    nodes = [part for column in columns for part in column.parts]
    for check in recording.checks.values():
        nodes += [*check.parts, check.limit]
    return {str(k): node for k, node in enumerate(dict.fromkeys(nodes))}


if __name__ == "__main__":
    main(tuple(sys.argv[1:]) or NAMES)
