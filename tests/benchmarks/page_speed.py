"""Speed of a worksheet's page in headless Chromium: ``python tests/benchmarks/page_speed.py [WORKSHEET]``.

Printed are, for a step of the first slider and for a changed input, the time from the key to the last change of the
page, and the processor time that server and page spend on it, which other work on the machine lengthens less; and the
drawings a second while the slider is dragged. The whole sheet is open. Nothing here passes or fails.
"""

import os
import statistics
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tests"), str(ROOT / "lib")]

from conftest import CHROMIUM_FLAGS, marimo_server, program  # noqa: E402
from playwright.sync_api import CDPSession, Page, sync_playwright  # noqa: E402

QUIET = 500  # ms without a change after which the page has settled
STEPS, INPUTS, DRAG = 20, 10, 4.0  # slider steps, changed inputs, seconds of dragging

WATCH = """() => {
  window.changes = []; window.drawings = null; // counted while the slider is dragged
  const seen = new WeakSet();
  const observer = new MutationObserver((records) => {
    changes.push(performance.now());
    const drawn = (n) => n.nodeType === 1 && (n.closest("svg") || n.querySelector("svg"));
    const isDrawn = (r) => [r.target, ...r.addedNodes].some((n) => n !== document.body && drawn(n));
    if (drawings !== null && records.some(isDrawn)) drawings += 1;
    records.forEach((r) => r.addedNodes.forEach(watchIn));
  });
  const watch = (root) => {
    if (seen.has(root)) return;
    seen.add(root);
    observer.observe(root, { subtree: true, childList: true, characterData: true, attributes: true });
    root.querySelectorAll("*").forEach((e) => e.shadowRoot && watch(e.shadowRoot));
  };
  const watchIn = (node) => {
    if (node.nodeType !== 1) return;
    [node, ...node.querySelectorAll("*")].forEach((e) => e.shadowRoot && watch(e.shadowRoot));
  };
  watch(document.body);
  window.mark = () => { changes = []; window.start = performance.now(); };
  window.addEventListener("keydown", mark, { capture: true });
}"""


def settled(page: Page) -> float:
    """Milliseconds from the key to the last change of the page, once it rests."""
    while True:
        page.wait_for_timeout(QUIET)
        rest, time_taken = page.evaluate(
            "() => [performance.now() - (changes.at(-1) ?? start), (changes.at(-1) ?? start) - start]"
        )
        if rest >= QUIET:
            return float(time_taken)


def server_seconds(port: str) -> float:
    """Processor time of the server that listens on the port, where the system tells it."""
    for process in Path("/proc").glob("[0-9]*"):
        try:
            command = (process / "cmdline").read_text().split("\0")
            if f"--port={port}" in command:
                fields = (process / "stat").read_text().rsplit(")", 1)[1].split()
                return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
        except OSError:
            continue
    return float("nan")


def page_seconds(session: CDPSession) -> float:
    metrics = session.send("Performance.getMetrics")["metrics"]
    return next(float(m["value"]) for m in metrics if m["name"] == "TaskDuration")


def report(what: str, times: list[float], server: float, page: float, limit: str) -> None:
    print(
        f"{what}: quietest {min(times):.0f} ms, median {statistics.median(times):.0f} ms ({limit}); "
        f"processor time of server {1e3 * server / len(times):.0f} ms, of page {1e3 * page / len(times):.0f} ms"
    )


def measure(page: Page, port: str) -> None:
    session = page.context.new_cdp_session(page)
    session.send("Performance.enable", {"timeDomain": "threadTicks"})
    page.get_by_text("Excel workbook").wait_for(timeout=120_000)
    page.wait_for_timeout(3000)
    page.evaluate(WATCH)

    slider = page.get_by_role("slider").first
    slider.focus()
    before, times = (server_seconds(port), page_seconds(session)), []
    for _ in range(STEPS):
        page.keyboard.press("ArrowRight")
        times.append(settled(page))
    spent = server_seconds(port) - before[0], page_seconds(session) - before[1]
    report("slider to last change", times, *spent, "wanted: 50 ms")

    page.evaluate("() => { drawings = 0 }")
    start = time.monotonic()
    while time.monotonic() - start < DRAG:
        page.keyboard.press("ArrowRight")
        page.wait_for_timeout(20)
    drawn = page.evaluate("() => { const n = drawings; drawings = null; return n }") / (time.monotonic() - start)
    print(f"drawings a second while dragging: {drawn:.1f} (wanted: 15)")
    settled(page)

    whole = page.evaluate("() => Math.max(...[...document.querySelectorAll('*')].map((e) => e.scrollHeight))")
    for what, height in (("input, in a window of 1000 px", 1000), ("input, in a window as tall as the sheet", whole)):
        page.set_viewport_size({"width": 1280, "height": height})
        page.wait_for_timeout(2000)
        inputs(page, session, port, what)


def inputs(page: Page, session: CDPSession, port: str, what: str) -> None:
    field = page.locator(".ms-inputs input").first
    field.focus()
    own = float(field.input_value())
    before, times = (server_seconds(port), page_seconds(session)), []
    for i in range(INPUTS):
        field.fill(f"{own * (1 + 1e-3 * (1 + i % 9)):.7g}")  # other digits of most numbers that are shown
        page.keyboard.press("Enter")
        times.append(settled(page))
    spent = server_seconds(port) - before[0], page_seconds(session) - before[1]
    report(f"{what}, to everything settled", times, *spent, "wanted: 200 ms")


def main() -> None:
    worksheet = ROOT / "worksheets" / f"{(sys.argv[1:] or ['hitch'])[0]}.py"
    chromium = program("Chromium", "chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome")
    print(f"{worksheet.stem}, load average {os.getloadavg()[0]:.1f} on {os.cpu_count()} processors")
    with (
        tempfile.TemporaryDirectory() as folder,
        marimo_server("run", worksheet, Path(folder)) as address,
        sync_playwright() as playwright,
    ):
        browser = playwright.chromium.launch(executable_path=chromium, args=CHROMIUM_FLAGS)
        page = browser.new_page(viewport={"width": 1280, "height": 1000})
        page.goto(address)
        measure(page, address.rsplit(":", 1)[1])
        browser.close()
    print(f"load average {os.getloadavg()[0]:.1f}")


if __name__ == "__main__":
    main()
