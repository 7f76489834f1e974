"""The page that ``edit`` and ``serve`` open without a name: every worksheet with title, drawing and last verdict.

It stands in the place of marimo's own list of files, as middleware of its server, and only where ``MECHSHEET_START``
tells which worksheets there are. What was not run since it last changed is run behind the page, one after another; what
searches or measures, for minutes, only once someone asks for it.
"""

import json
import os
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from queue import SimpleQueue
from threading import Thread

from starlette.middleware import Middleware
from starlette.requests import Request
from starlette.responses import HTMLResponse, JSONResponse, Response
from starlette.types import ASGIApp, Receive, Scope, Send

from mechsheet.page import cards
from mechsheet.run import glance

_AT_ONCE = 2  # so that one that takes minutes does not keep the others


class Runs:
    """Runs of worksheets behind the page, and why one could not even be kept."""

    def __init__(self) -> None:
        self.asked, self.failed = set[str](), dict[str, str]()
        self.long = dict[str, str]()  # digests of those that are not run unasked
        self.running, self._queue = set[str](), SimpleQueue[tuple[str, bool]]()
        self._threads = [Thread(target=self._work, daemon=True) for _ in range(_AT_ONCE)]

    def ask(self, worksheet: str, whatever: bool) -> None:
        """Run a worksheet soon, ``whatever`` time it takes; once, however often it is asked for until then."""
        if worksheet in self.asked:
            return
        self.failed.pop(worksheet, None)
        if not self.asked and not self._threads[0].ident:
            for thread in self._threads:
                thread.start()
        self.asked.add(worksheet)
        self._queue.put((worksheet, whatever))

    def _work(self) -> None:
        while True:
            worksheet, whatever = self._queue.get()
            command = [sys.executable, "-m", "mechsheet.run.glance", worksheet, *["--asked"] * whatever]
            # Its input is never written to: it ends with this process, in whatever way that ends.
            pipe, text = subprocess.PIPE, {**os.environ, "PYTHONUTF8": "1"}
            with subprocess.Popen(command, stdin=pipe, stdout=subprocess.DEVNULL, stderr=pipe, env=text) as process:
                assert process.stderr
                self.running.add(worksheet)
                said = process.stderr.read().decode(errors="replace")
                self.running.discard(worksheet)
            if process.returncode == glance.LONG:
                self.long[worksheet] = glance.digest(Path(worksheet))
            elif process.returncode:
                self.failed[worksheet] = "; " + said.strip().rpartition("\n")[2]
            self.asked.discard(worksheet)


class StartPage:
    """Middleware that answers for the list of files, to whom the server lets read, and leaves all else to marimo."""

    def __init__(self, app: ASGIApp) -> None:
        self._app, self._runs = app, Runs()
        self._groups: list[tuple[str, dict[str, str]]] = json.loads(os.environ.get("MECHSHEET_START", "[]"))
        self._left_out: list[str] = json.loads(os.environ.get("MECHSHEET_LEFT_OUT", "[]"))

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        answer = self._answer(Request(scope)) if self._groups and scope["type"] == "http" else None
        await (answer or self._app)(scope, receive, send)

    def _answer(self, request: Request) -> Response | None:
        base = getattr(request.app.state, "base_url", "")
        of_list = request.url.path.removeprefix(base) in ("", "/") and request.method == "GET"
        if not of_list or not set(request.query_params) <= {"verdicts", "run"} or "read" not in request.auth.scopes:
            return None
        asked = request.query_params.get("run")
        if any(asked in of for _, of in self._groups):
            self._runs.ask(str(asked), whatever=True)
        if not request.query_params:
            cards_of = [[self._card(path, title, ask=True) for path, title in of.items()] for _, of in self._groups]
            return HTMLResponse(cards.page(zip((name for name, _ in self._groups), cards_of, strict=True)))
        runs = bool(self._runs.asked)  # before the cards are made: then the last one is not missed
        told = [cards.card(self._card(path, title)) for _, of in self._groups for path, title in of.items()]
        return JSONResponse({"cards": told, "runs": runs})

    def _card(self, path: str, title: str, ask: bool = False) -> cards.Card:
        """A worksheet by its last run; with ``ask`` it is run again where that does not hold."""
        if not Path(path).exists():
            return cards.Card(path, title, "its file is gone", holds=False)
        last, now = glance.kept(Path(path)), glance.digest(Path(path))
        holds, long = last is not None and last.digest == now, self._runs.long.get(path) == now
        if ask and not holds and not long:
            self._runs.ask(path, whatever=False)
        when = f"run {last.when}" if last else "not run yet"
        if not holds:
            when += ", before it or the package changed" if last else ""
            state = "it is being run" if path in self._runs.running else "it waits to be run"
            when += f"; {state}" if path in self._runs.asked else self._runs.failed.get(path, "")
        opens = path not in self._left_out
        if not opens:
            when += "; it opens once this is started anew: it could not be read when it was"
        to_run = long and not holds and path not in self._runs.asked
        card = cards.Card(path, title, when, holds=holds, to_run=to_run, opens=opens)
        return replace(card, kind=last.kind, told=last.told, picture=last.picture) if last else card


middleware = Middleware(StartPage)
