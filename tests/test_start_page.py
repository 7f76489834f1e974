"""The page of all worksheets that opens without a name: what it tells of each, and since when."""

from __future__ import annotations

import json
import os
import re
import socket
import subprocess
import sys
import time
import urllib.request
from collections.abc import Iterator
from http.cookiejar import CookieJar
from pathlib import Path
from urllib.parse import quote

import pytest
from conftest import WITHIN, answers, installed

from mechsheet import __main__ as launcher
from mechsheet.page import cards
from mechsheet.run import glance, start_page
from tests.own_worksheet import own

TEMPLATE = (Path(launcher.__file__).parent / "run" / "new_worksheet.txt").read_text(encoding="utf-8")


class Server:
    """A server of three worksheets, of which one does not run and one takes long."""

    def __init__(self, folder: Path, port: int) -> None:
        self.lever, self.broken, self.port = folder / "lever.py", folder / "broken.py", port
        self.long = folder / "long.py"
        self.browser = urllib.request.build_opener(urllib.request.HTTPCookieProcessor(CookieJar()))

    def get(self, query: str = "") -> str:
        with self.browser.open(f"http://127.0.0.1:{self.port}/{query}", timeout=WITHIN) as answer:
            return str(answer.read().decode())

    def at_rest(self) -> list[str]:
        """The worksheets as they are told once nothing is run any more."""
        deadline = time.monotonic() + WITHIN
        while (told := json.loads(self.get("?verdicts")))["runs"]:
            assert time.monotonic() < deadline
            time.sleep(0.5)  # each look takes longer than it seems: all of the package is looked through
        return list(told["cards"])


@pytest.fixture
def server(tmp_path: Path) -> Iterator[Server]:
    folder = tmp_path / "start"
    folder.mkdir()
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        made = Server(folder, free.getsockname()[1])
    made.lever.write_text(TEMPLATE.replace("TITLE", "A lever"), encoding="utf-8")
    made.broken.write_text(TEMPLATE.replace("TITLE", "Broken").replace("pi / 2", "pie / 2"), encoding="utf-8")
    assert "pie / 2" in made.broken.read_text(encoding="utf-8")
    measuring = TEMPLATE.replace("TITLE", "Long").replace(
        "import linspace, pi, sin", "import linspace, pi, sin\n    from mechsheet import sweep"
    )
    measuring = measuring.replace("pi / 2", "pi / (2 if sweep else 1)")
    assert "if sweep" in measuring
    made.long.write_text(measuring, encoding="utf-8")
    groups = [["Here", {str(made.lever): "A <lever>", str(made.broken): "Broken", str(made.long): "Long"}]]
    environment = {
        **os.environ,
        "PYTHONPATH": installed(folder),
        "PYTHONUTF8": "1",
        "XDG_CACHE_HOME": str(folder / "cache"),
        "MECHSHEET_START": json.dumps(groups),
    }
    options = ["--headless", "--token", "--token-password=sesame", "--host=127.0.0.1", f"--port={made.port}"]
    quiet = {"stdin": subprocess.DEVNULL, "stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    command = [sys.executable, "-m", "marimo", "run", *options, str(made.lever), str(made.broken)]
    with subprocess.Popen(command, env=environment, **quiet) as process:
        try:
            deadline = time.monotonic() + WITHIN
            while not answers(made.port):
                assert process.poll() is None and time.monotonic() < deadline
                time.sleep(0.1)
            yield made
        finally:
            process.terminate()


def test_each_worksheet_is_told_with_its_last_run(server: Server) -> None:
    assert "Worksheets</title>" not in server.get(), "the password is asked for first"
    first = server.get("?access_token=sesame")
    assert "A &lt;lever&gt;" in first and first.count("not run yet") == 3
    lever, broken, _ = server.at_rest()
    assert f'href="?file={quote(str(server.lever))}"' in lever
    assert "<svg" in lever and 'class="PASS">' in lever and "checks pass" in lever
    assert "run 20" in lever and "changed" not in lever
    assert 'class="FAIL">it does not run: broken.py, line' in broken and "pie is not defined" in broken
    assert "lever.py" in server.get(f"?file={quote(str(server.lever))}"), "all else is marimo's"


def test_what_searches_or_measures_is_run_once_someone_asks_for_it(server: Server) -> None:
    server.get("?access_token=sesame")
    *_, long = server.at_rest()
    assert "not run yet</small>" in long and "for minutes</button>" in long
    server.get(f"?verdicts&run={quote(str(server.long))}")
    *_, long = server.at_rest()
    assert "run 20" in long and 'class="PASS">' in long and "<button" not in long


DRAWN = """
from mechsheet import Drawing
still = Drawing(frame=[0, 2 + 1j]).path([0j, 1 + 1j])
bars = still.support(0j, "O").link(0j, 1j, "1").link(1j, 2 + 1j, "2")
shown = bars.hinge(1j, "A").hinge(2 + 1j, "B")"""


def test_the_picture_is_a_whole_drawing(tmp_path: Path) -> None:
    picture = glance.computed(Path(own(tmp_path, DRAWN).path)).picture
    assert ">A<" in picture or ">2<" in picture, "not the path that drawings share"


def test_a_verdict_of_before_a_change_says_so_until_the_worksheet_is_run_again(server: Server) -> None:
    server.get("?access_token=sesame")
    server.at_rest()
    text = server.lever.read_text(encoding="utf-8")
    server.lever.write_text(text + "\n# one more line\n", encoding="utf-8")
    lever, *_ = server.at_rest()
    assert "class=old" in lever and "before it or the package changed" in lever
    assert re.search("it (is being|waits to be) run", server.get())
    lever, *_ = server.at_rest()
    assert "class=old" not in lever and "changed" not in lever
    server.lever.unlink()
    assert "its file is gone" in server.at_rest()[0]
    server.lever.write_text(text, encoding="utf-8")


def test_the_card_of_a_worksheet_that_could_not_be_read_leads_nowhere(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """marimo would serve none beside it, so it is left out, and says that it does not know the file."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(launcher, "folders", list)
    started = list[dict[str, str]]()
    monkeypatch.setattr(launcher, "call", lambda _, settings: started.append(settings) or 7)
    Path("lever.py").write_text(TEMPLATE.replace("TITLE", "Lever"), encoding="utf-8")
    Path("unread.py").write_text(TEMPLATE.replace("TITLE", "Unread").replace("W: float = ", "W: float = = "), "utf-8")
    assert launcher.page("serve", [], []) == 7
    assert "unread.py, line " in capsys.readouterr().err
    for name, value in started[0].items():
        monkeypatch.setenv(name, value)
    page = start_page.StartPage(None)  # type: ignore[arg-type]  # no server behind it
    lever, unread = (cards.card(page._card(str(tmp_path / name), "")) for name in ("lever.py", "unread.py"))
    assert "href=" in lever and "could not be read" not in lever
    assert "href=" not in unread and "could not be read" in unread
