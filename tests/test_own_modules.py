"""A module of the user's own beside the worksheet is followed in a proof, as the setup of the worksheet is."""

import sys
from pathlib import Path
from textwrap import indent

import pytest
from own_worksheet import own

from mechsheet import load
from mechsheet.recording.record import record
from mechsheet.run.proving import proof_of

MODULE = """
from math import cos
STEP = 1 - 0.9999999
PART = 0.125
def lost(x):
    return x * (1 - cos(3e-8)) * (0.3 // 0.1)
class Bar:
    share = 1 - 0.9999999
    def of(self, x):
        return x * self.share
"""


@pytest.mark.parametrize("shared", [False, True])
@pytest.mark.parametrize(
    "line, least, most",
    [
        ("lost(g.F)", 0, 1),
        ("beside_it.lost(g.F)", 0, 1),
        ("g.F * lost(2.0)", 0, 1),
        ("Bar().of(g.F)", 9, 10),
        ("STEP * g.F", 9, 10),
        ("beside_it.STEP * g.F", 9, 10),
        ("PART * g.F / 3", 15, 17),
    ],
)
def test_a_proof_follows_what_a_module_makes_of_numbers_alone(
    line: str, least: float, most: float, shared: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of x * (1 - cos(3e-8)) * (0.3 // 0.1) in such a module 15 digits were claimed, of which it has none."""
    (tmp_path / "beside_it.py").write_text(MODULE)
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.delitem(sys.modules, "beside_it", raising=False)
    imports = "import beside_it\nfrom beside_it import PART, STEP, Bar, lost\n"
    sheet = own(tmp_path, f"{'' if shared else imports}y = {line}  # [-] number")
    if shared:
        path = tmp_path / "shared.py"
        text, within = Path(sheet.path).read_text(), indent(imports, "    ")
        path.write_text(text.replace("    from mechsheet import ask", f"{within}    from mechsheet import ask", 1))
        sheet = load(path)
    names = sheet.run(sheet.results, {"g": sheet.inputs()})
    proof = proof_of(names, sheet, record(names, sheet, exact=True))
    (digits,) = (column.least for column in proof.columns if column.name == "y")
    assert least <= digits <= most or (digits == 0 and not shared)  # what a cell imports is no number of its own
