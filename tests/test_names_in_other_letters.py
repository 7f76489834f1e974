"""Inputs with Greek and Cyrillic names: given by a scene, an argument or a link, and saved as a scene."""

from __future__ import annotations

import tomllib
from contextlib import chdir
from pathlib import Path
from typing import TYPE_CHECKING, Any
from urllib.parse import unquote

import pytest
from as_script import as_script

from mechsheet import html, load
from mechsheet.page import fields as page_fields
from mechsheet.studies.design import scene_text
from mechsheet.worksheet import scene
from mechsheet.worksheet.errors import SheetError
from mechsheet.worksheet.inputs import declared
from mechsheet.worksheet.scene import Limit

if TYPE_CHECKING:
    from playwright.sync_api import Page
from tests.own_worksheet import written

SHEET = written(
    """
from mechsheet import ask, inputs, read
from mechsheet.units import deg
""",
    """
β_1: float = 20 * deg  # [deg] угол; >= 0
μ: float = 0.1  # [-] friction
угол: float = 5 * deg  # [deg] угол
единый: bool = True  # сварка
марка: str = "09Г2С"  # сталь
""",
    """
γ_1 = 2 * g.β_1 + g.угол  # [deg] угол
q = g.μ * g.единый  # [-] friction
""",
)
GIVEN = {"β_1": "18", "μ": "0.25", "угол": "7,5", "единый": "no", "марка": 'Ст"3 🙂'}
MICRO = "\u00b5"  # of the keyboard, which Python reads as the Greek letter


@pytest.fixture(scope="module")
def joint(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("sheet") / "joint.py"
    path.write_text(SHEET, encoding="utf-8")
    return path


def test_what_a_design_writes_is_read(joint: Path, tmp_path: Path) -> None:
    fields = {field.name: field for field in declared(load(joint).inputs)}
    path = tmp_path / "designed.toml"
    given: dict[str, Any] = {"β_1": 18.0, "μ": 0.25, "марка": 'Ст"3 🙂'}
    path.write_text(scene_text(fields, given, {"γ_1": Limit(min=3.0)}, []), encoding="utf-8")
    read = scene.load(path)
    assert read.inputs == given and read.limits == {"γ_1": Limit(min=3.0)}


@pytest.mark.parametrize("name", ["β_1", "μ", "угол"])
def test_a_name_that_toml_needs_in_quotes_is_told(name: str, tmp_path: Path) -> None:
    path = tmp_path / "typed.toml"
    path.write_text(f'[inputs]\n"P" = 1\n{name} = 18\n', encoding="utf-8")
    with pytest.raises(SheetError) as error:
        scene.load(path)
    assert str(error.value).endswith(f'; a name with other letters than a..z stands in quotes: "{name}"')


def test_the_sign_of_the_keyboard_is_the_letter(joint: Path, tmp_path: Path) -> None:
    path = joint.with_name("rough.toml")
    path.write_text(f'want = ["q"]\n[inputs]\n"{MICRO}" = 0.25\n', encoding="utf-8")
    with chdir(tmp_path):
        for given in (f"--scene={path}", f"--{MICRO}=0.25"):
            assert as_script(joint, given, "--want=q").stdout == "q = 0.25, friction\n"
    (listed,) = page_fields._scenes(load(joint).inputs)
    assert listed["texts"] == {"μ": "0.25"}


def test_links_and_saved_scenes_carry_them(blank: Page) -> None:
    blank.add_script_tag(path=html.__path__[0] + "/given.js")
    kinds = {"единый": "switch", "марка": "text"}
    given = [{"name": name, "text": text, "kind": kinds.get(name, "number")} for name, text in GIVEN.items()]
    address = blank.evaluate("given => addressOf(given)", given)
    assert address.isascii() and unquote(address).startswith("β_1=18&μ=0.25&угол=7,5")
    spelt = {"as written": address, "as a browser tells it": address.replace("%CE%B2", "β"), "μ": f"{MICRO}=0.25"}
    read = {how: dict(blank.evaluate("hash => [...textsIn(hash)]", f"#{text}")) for how, text in spelt.items()}
    assert read["as written"] == read["as a browser tells it"] == GIVEN and read["μ"] == {"μ": "0.25"}
    assert dict(blank.evaluate("() => [...textsIn('#P6=5 %&%=3')]")) == {"P6": "5 %", "%": "3"}, "a sign as it stands"
    assert dict(blank.evaluate("() => [...textsIn('#mu=5%20%')]")) == {"mu": "5 %"}, "as a browser takes what is typed"
    saved = tomllib.loads(blank.evaluate("given => sceneText(given)", given))["inputs"]
    assert saved == {"β_1": 18, "μ": 0.25, "угол": "7,5", "единый": False, "марка": 'Ст"3 🙂'}
