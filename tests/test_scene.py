"""Scenes from arguments and files."""

from pathlib import Path

import pytest

from mechsheet import scene
from mechsheet.errors import SheetError


def test_arguments_replace_inputs_in_their_order(tmp_path):
    file = tmp_path / "heavy.toml"
    file.write_text("[inputs]\nP6 = 40e3\nphi_P6 = 85\n")
    found = scene.read([f"--scene={file}", "--P6=30e3", "--out=somewhere"])
    assert found == scene.Scene({"P6": "30e3", "phi_P6": 85}, Path("somewhere"))


@pytest.mark.parametrize("argument", ["P6=3", "--P6", "--=3", "-P6=3", "--scene", ""])
def test_other_forms_are_refused(argument):
    with pytest.raises(SheetError, match="must be --NAME=VALUE"):
        scene.read([argument])


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("[inputs\n", "is no valid TOML"),
        ("P6 = 3\n", r"must hold a table \[inputs\] and nothing else; it has \['P6'\]"),
        ("", r"must hold a table \[inputs\]"),
        ("inputs = 3\n", r"must hold a table \[inputs\]"),
    ],
)
def test_bad_scene_file_is_named(tmp_path, text, message):
    file = tmp_path / "bad.toml"
    file.write_text(text)
    with pytest.raises(SheetError, match=message) as error:
        scene.read([f"--scene={file}"])
    assert str(file) in str(error.value)


def test_missing_scene_file_is_named(tmp_path):
    with pytest.raises(SheetError, match=r"none\.toml cannot be read: No such file"):
        scene.read([f"--scene={tmp_path / 'none.toml'}"])
