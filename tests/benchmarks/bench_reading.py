"""Time and memory of reading inputs back from workbooks that are larger than any that the package writes.

Run as ``python tests/benchmarks/bench_reading.py`` on Linux; each file is read in a process of its own, which may
take 2 s and 200 MB. Fails where one takes more.
"""

import io
import re
import subprocess
import sys
import tempfile
import time
import zipfile
from pathlib import Path

from mechsheet.run import arguments, report
from mechsheet.worksheet import inputs
from mechsheet.worksheet.cells import load
from mechsheet.worksheet.errors import SheetError

HITCH = Path(__file__).resolve().parents[2] / "worksheets" / "hitch.py"
INPUTS = "xl/worksheets/sheet2.xml"  # behind the front sheet
SECONDS, MEGABYTES = 2.0, 200.0


def files() -> dict[str, bytes]:
    sheet = load(HITCH)
    book = report.workbook("Hitch", sheet.run(sheet.results, {"g": sheet.inputs()}), {})
    text = zipfile.ZipFile(io.BytesIO(book)).read(INPUTS).decode()
    last = max(map(int, re.findall(r'<row r="(\d+)"', text)))
    million = "".join(f'<row r="{last + 1 + i}" ht="15"/>' for i in range(1_000_000))
    far = '<row r="1048576"><c r="XFD1048576"><v>1</v></c></row>'
    long = f'<row r="{last + 1}"><c r="A{last + 1}" t="inlineStr"><is><t>{"x" * 40_000}</t></is></c></row>'
    shorter = re.sub(rf'<row r="{last}".*?</row>', "", text, flags=re.DOTALL)
    odd = {
        "as exported": text,
        "cell at XFD1048576": _with(text, far),
        "and an input less": _with(shorter, far),
        "a million empty rows": _with(text, million),
        "with an input less": _with(shorter, million),
        "40,000 characters": _with(text, long),
    }
    return {name: _changed(book, sheet) for name, sheet in odd.items()}


def _with(sheet: str, rows: str) -> str:
    return sheet.replace("</sheetData>", rows + "</sheetData>")


def _changed(book: bytes, sheet: str) -> bytes:
    out = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(book)) as old, zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as new:
        for name in old.namelist():
            new.writestr(name, sheet if name == INPUTS else old.read(name))
    return out.getvalue()


def read(path: str) -> None:
    """Print seconds, the greatest memory of the process in MB, and what the file comes to."""
    declared, start = inputs.declared(load(HITCH).inputs), time.perf_counter()
    try:
        told = f"{len(arguments.read([f'--scene={path}'], declared).inputs)} inputs"
    except SheetError as error:
        told = str(error).removeprefix(f"workbook {path}, ")
    taken = time.perf_counter() - start
    status = Path("/proc/self/status").read_text()  # what getrusage tells is also of the process that started this one
    peak = int(re.search(r"VmHWM:\s+(\d+)", status)[1]) / 1024
    print(taken, peak, told, sep="\t")


def main() -> int:
    failed = False
    with tempfile.TemporaryDirectory() as folder:
        for name, data in files().items():
            path = Path(folder) / "scene.xlsx"
            path.write_bytes(data)
            done = subprocess.run([sys.executable, __file__, str(path)], capture_output=True, text=True, check=True)
            seconds, megabytes, told = done.stdout.rstrip().split("\t")
            failed |= float(seconds) > SECONDS or float(megabytes) > MEGABYTES
            print(f"{name:22}{float(seconds):6.2f} s{float(megabytes):6.0f} MB  {told[:90]}")
    return 1 if failed else 0


if __name__ == "__main__":
    if sys.argv[1:]:
        read(sys.argv[1])
    else:
        sys.exit(main())
