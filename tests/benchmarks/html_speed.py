"""Speed of pages in one file in headless Chromium: ``python tests/benchmarks/html_speed.py [NAME ..]``.

Printed are, for a changed input and for a step of the first slider, the time until the browser has painted it, and what
its main thread spends on it: in all, and of this in scripts, styles and layout; of the slider also in a window as high
as the page. A frame that changes one text alone is the measure of the machine, which paints without a graphics card.
Sixty frames a second have 16 ms each. Nothing here passes or fails.
"""

import os
import statistics
import sys
import tempfile
from pathlib import Path
from shutil import which

from playwright.sync_api import CDPSession, Page, sync_playwright

from mechsheet.html import write
from mechsheet.worksheet import cells

ROOT = Path(__file__).resolve().parents[2] / "worksheets"
MOVED = {"hitch": "P6", "landing_gear": "theta", "slotted_link": "L0", "kinetostatics": "Y_H", "joint": "psi"}
STEPS = 30
PAINTED = """async ([steps, own, name]) => {
  const input = document.getElementById(`input-${name}`), slider = document.querySelector("[data-control]");
  const output = document.querySelector(".ms-state"), times = [];
  const told = element => element.dispatchEvent(new Event("input", {bubbles: true}));
  for (let k = 1; k <= steps; k++) {
    const start = performance.now();
    if (name === "text") output.textContent = k;
    else if (name) told(Object.assign(input, {value: (own * (1 + k * 1e-3)).toPrecision(7)}));
    else told(Object.assign(slider, {value: +slider.min + (slider.max - slider.min) * ((7 * k) % 90) / 89}));
    await new Promise(done => requestAnimationFrame(() => setTimeout(done)));
    times.push(performance.now() - start);
  }
  return times;
}"""
SPENT = ("TaskDuration", "ScriptDuration", "RecalcStyleDuration", "LayoutDuration")


def spent(session: CDPSession) -> list[float]:
    metrics = {m["name"]: float(m["value"]) for m in session.send("Performance.getMetrics")["metrics"]}
    return [metrics[name] for name in SPENT]


def report(page: Page, session: CDPSession, what: str, own: float, name: str) -> None:
    page.evaluate(PAINTED, [3, own * 1.01, name])
    before = spent(session)
    times = page.evaluate(PAINTED, [STEPS, own, name])
    parts = "".join(f"{1e3 * (b - a) / STEPS:8.1f}" for a, b in zip(before, spent(session), strict=True))
    print(f"{what:40}{statistics.median(times):10.1f}{parts}", flush=True)


def main(names: tuple[str, ...] = tuple(MOVED)) -> None:
    print(f"load average {os.getloadavg()[0]:.1f} on {os.cpu_count()} processors")
    print(f"{'ms':40}{'painted':>10}{'thread':>8}{'script':>8}{'style':>8}{'layout':>8}")
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        chromium = which("chromium") or which("chromium-browser") or which("google-chrome")
        browser = playwright.chromium.launch(executable_path=chromium, args=["--no-sandbox", "--disable-gpu"])
        for name in names:
            sheet, path = cells.load(ROOT / f"{name}.py"), Path(folder) / f"{name}.html"
            path.write_text(write.page(sheet, sheet.inputs()), encoding="utf-8")
            page = browser.new_page(viewport={"width": 1280, "height": 1000})
            page.goto(path.as_uri())
            page.wait_for_selector("body[data-ready]")
            session = page.context.new_cdp_session(page)
            session.send("Performance.enable", {"timeDomain": "threadTicks"})
            own = float(page.locator(f"#input-{MOVED[name]}").input_value())
            report(page, session, f"{name}: one text", own, "text")
            report(page, session, f"{name}: input {MOVED[name]}", own, MOVED[name])
            if page.locator("[data-control]").count():
                page.locator("[data-control]").first.scroll_into_view_if_needed()
                report(page, session, f"{name}: slider", own, "")
                page.set_viewport_size({"width": 1280, "height": page.evaluate("document.body.scrollHeight")})
                page.wait_for_timeout(500)
                report(page, session, f"{name}: one text, all in view", own, "text")
                report(page, session, f"{name}: slider, all in view", own, "")
            page.close()
        browser.close()


if __name__ == "__main__":
    main(tuple(sys.argv[1:]) or tuple(MOVED))
