"""A file is written whole or not at all."""

import errno
import os
import re
import stat
import subprocess
import sys
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
        with pytest.raises(SheetError, match=f"^{re.escape(str(path))} cannot be written: [^\n]+$"):
            save(b"new", path)
    assert sorted(tmp_path.iterdir()) == before


@pytest.mark.skipif(os.name == "nt", reason="Windows has no file modes")
@pytest.mark.parametrize("mode", [0o600, 0o640, 0o664])
def test_replaced_file_keeps_its_permissions(tmp_path: Path, mode: int) -> None:
    path = tmp_path / "hitch.xlsx"
    path.write_bytes(b"old")
    path.chmod(mode)
    save(b"new", path)
    assert path.read_bytes() == b"new" and stat.S_IMODE(path.stat().st_mode) == mode


def test_read_only_file_is_refused(tmp_path: Path) -> None:
    """Replacing it needs the folder's permission alone, which is not what its owner meant; root may write it even."""
    path = tmp_path / "hitch.xlsx"
    path.write_bytes(b"old")
    path.chmod(0o444)
    with pytest.raises(SheetError, match=r"hitch\.xlsx cannot be written: the file is read-only"):
        save(b"new", path)
    assert path.read_bytes() == b"old"


@pytest.mark.parametrize("there", [True, False])
def test_link_is_followed(tmp_path: Path, there: bool) -> None:
    target, link = tmp_path / "kept" / "hitch.xlsx", tmp_path / "hitch.xlsx"
    target.parent.mkdir()
    if there:
        target.write_bytes(b"old")
    link.symlink_to(target)
    save(b"new", link)
    assert link.is_symlink() and target.read_bytes() == b"new"
    assert sorted(tmp_path.rglob("*")) == sorted([link, target.parent, target])


KILLED = """
import os, signal, sys
from pathlib import Path
from mechsheet.workbook.save import save
os.fsync = lambda _: os.kill(os.getpid(), signal.SIGKILL)
save(b"new", Path(sys.argv[1]))
"""


@pytest.mark.skipif(os.name == "nt", reason="Windows has no SIGKILL")
def test_what_a_killed_run_has_left_goes_with_the_next_and_nothing_else(tmp_path: Path) -> None:
    path = tmp_path / "hitch.xlsx"
    for _ in range(2):
        subprocess.run([sys.executable, "-c", KILLED, path])
    left = list(tmp_path.iterdir())
    assert len(left) == 1, "the second run has removed what the first had left"
    running = left[0].name.replace(f".{left[0].name.split('.')[-2]}.", f".{os.getppid()}.")
    others = {tmp_path / running, tmp_path / ".hitch.xlsx.note", tmp_path / ".other.xlsx"}
    for other in others:
        other.write_bytes(b"")
    save(b"new", path)
    assert set(tmp_path.iterdir()) == {path, *others}


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
