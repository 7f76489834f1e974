"""Where a new worksheet is written: among those of the clone that one stands in, else where one stands."""

from pathlib import Path

import pytest

from mechsheet import __main__ as launcher


@pytest.mark.parametrize("stands", [".", "worksheets", "exports/light", "../elsewhere"])
def test_a_new_worksheet_is_where_one_stands_or_in_the_clone_around(tmp_path, monkeypatch, capsys, stands):
    clone = tmp_path / "clone"
    where = clone / stands
    for folder in (clone / "worksheets", where):
        folder.mkdir(parents=True, exist_ok=True)
    (clone / "worksheets" / "page.css").write_text("/* of the clone */")
    monkeypatch.setattr(launcher, "ROOT", clone)
    monkeypatch.chdir(where)
    assert launcher.new("lever") == 0
    written = (where if ".." in stands else clone / "worksheets").resolve() / "lever.py"
    assert capsys.readouterr().out.startswith(f"written {written};")
    assert sorted(path.name for path in written.parent.iterdir()) == ["lever.py", "page.css"]
    assert not [path for path in tmp_path.rglob("lever.py") if path != written]


def test_one_that_is_there_stays(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(launcher, "ROOT", tmp_path / "nowhere")
    monkeypatch.chdir(tmp_path)
    Path("lever.py").write_text("mine")
    with pytest.raises(SystemExit):
        launcher.new("lever")
    assert "is there already" in capsys.readouterr().err and Path("lever.py").read_text() == "mine"


def test_a_name_begins_with_a_letter_of_any_alphabet(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(launcher, "ROOT", tmp_path / "nowhere")
    monkeypatch.chdir(tmp_path)
    Path("page.css").write_text("/* mine */")
    assert launcher.new("Übung") == 0 and 'app_title="Übung"' in Path("Übung.py").read_text("utf-8")
    for name, other in (
        ("_lever", "lever"),
        ("1lever", "lever"),
        ("screw jack", "screw_jack"),
        ("../some/lever-2.py", "lever_2"),
        (r"C:\some\lever", "lever"),
        ("lever/", "lever"),
        ("9", "lever"),
        ("", "lever"),
    ):
        with pytest.raises(SystemExit):
            launcher.new(name)
        told = f"must be a letter, then letters, digits or _: give {other}, which is written into {tmp_path}\n"
        assert capsys.readouterr().err.endswith(told)
    with pytest.raises(SystemExit):
        launcher.new("numpy")
    assert "'numpy' is one of Python's, as which it would be read: give numpy_1" in capsys.readouterr().err
