"""A file is written whole or not at all."""

import errno
import os
import re
from dataclasses import dataclass
from pathlib import Path

import pytest

from mechsheet.workbook.save import save
from mechsheet.worksheet.errors import SheetError


def test_save_writes_and_replaces(tmp_path: Path) -> None:
    path = tmp_path / "hitch.xlsx"
    for content in (b"old", b"new"):
        save(content, path)
        assert path.read_bytes() == content
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.skipif(os.name == "nt", reason="Windows has no file modes")
def test_saved_file_is_as_readable_as_any_other(tmp_path: Path) -> None:
    """A temporary file is private by default; the workbook must not be."""
    plain = tmp_path / "plain"
    plain.write_bytes(b"")
    save(b"new", tmp_path / "hitch.xlsx")
    assert (tmp_path / "hitch.xlsx").stat().st_mode == plain.stat().st_mode


def test_folder_that_cannot_be_written_to_is_named(tmp_path: Path) -> None:
    (tmp_path / "file").write_bytes(b"")
    (tmp_path / "taken.xlsx").mkdir()
    before = sorted(tmp_path.iterdir())
    for path in (tmp_path / "missing" / "hitch.xlsx", tmp_path / "file" / "hitch.xlsx", tmp_path / "taken.xlsx"):
        with pytest.raises(SheetError, match=f"^workbook {re.escape(str(path))} cannot be written: [^\n]+$"):
            save(b"new", path)
    assert sorted(tmp_path.iterdir()) == before


@dataclass
class Refusing:
    """A system call that fails."""

    code: int

    def __call__(self, *args: object) -> None:
        raise OSError(self.code, os.strerror(self.code))


@pytest.mark.parametrize(("call", "code"), [("fsync", errno.ENOSPC), ("replace", errno.EACCES)])
def test_failed_save_leaves_the_old_file_and_nothing_else(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, call: str, code: int
) -> None:
    """A full disk is noticed when the data are flushed; a file that Excel holds open when it is replaced."""
    path = tmp_path / "hitch.xlsx"
    path.write_bytes(b"old")
    monkeypatch.setattr(os, call, Refusing(code))
    with pytest.raises(SheetError, match=os.strerror(code)):
        save(b"new", path)
    assert path.read_bytes() == b"old"
    assert list(tmp_path.iterdir()) == [path]


def test_write_cut_short_by_the_system_leaves_the_old_file(tmp_path: Path) -> None:
    """A limit on the size of files refuses the data half way, as a full disk does."""
    resource = pytest.importorskip("resource")
    path = tmp_path / "hitch.xlsx"
    path.write_bytes(b"old")
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (100, limits[1]))
    try:
        with pytest.raises(SheetError, match=os.strerror(errno.EFBIG)):
            save(bytes(1000), path)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)
    assert path.read_bytes() == b"old"
    assert list(tmp_path.iterdir()) == [path]
