"""Serving with a password, as the README writes it."""

import re
import shutil
import socket
import subprocess
import sys
import time
import urllib.request
from http.cookiejar import CookieJar
from pathlib import Path

import pytest
from conftest import WITHIN, answers

ROOT = Path(__file__).parents[1]


@pytest.fixture
def served(tmp_path):
    """Port of the README's own command, but for the host and the port."""
    shutil.copytree(ROOT / "worksheets", tmp_path / "worksheets")
    (tmp_path / "password.txt").write_text("sesame\n", encoding="utf-8")
    command = re.search(r"^    marimo (run .*--token-password-file.*)$", (ROOT / "README.md").read_text("utf-8"), re.M)
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    options = command[1].replace("0.0.0.0", "127.0.0.1").replace("8080", str(port)).split()
    quiet = {"stdin": subprocess.DEVNULL, "stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    with subprocess.Popen([sys.executable, "-m", "marimo", *options], cwd=tmp_path, **quiet) as server:
        try:
            deadline = time.monotonic() + WITHIN
            while not answers(port):
                assert server.poll() is None and time.monotonic() < deadline
                time.sleep(0.2)
            yield port
        finally:
            server.terminate()


def test_only_the_password_opens_the_page(served):
    def ends_at(password: str) -> str:
        browser = urllib.request.build_opener(urllib.request.HTTPCookieProcessor(CookieJar()))
        with browser.open(f"http://127.0.0.1:{served}/?access_token={password}", timeout=WITHIN) as answer:
            return answer.url

    assert ends_at("sesame").endswith(f":{served}/")
    assert all("/auth/login" in ends_at(wrong) for wrong in ("", "Sesame", "sesame1"))
