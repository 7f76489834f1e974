"""What a page is told of its cells while they are computed: middleware of marimo, an entry point of the package.

marimo tells of every cell four times beside its output that it waits, runs, has lost its fields and is done, and the
page draws itself for each. Where the output comes at once, the output and that it is done are enough.
"""

import asyncio
import json
import re
from collections.abc import Mapping
from typing import Any, NamedTuple

from starlette.middleware import Middleware
from starlette.requests import Request
from starlette.responses import PlainTextResponse
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from mechsheet.page import notebook

AT_ONCE = 0.25  # s
_SHORT = 400  # characters of a message that may be a state, and in which a longer one tells its cell and its kind
_CELL = re.compile(r'{"op": ?"cell-op", ?"data": ?{"op": ?"cell-op", ?"cell_id": ?"(\w+)"')
_FIELDS_OF = re.compile(r"object-id=\W{0,6}(\w+)-")


class Fewer:
    """Middleware that keeps back what a served page need not be told; in the editor all is told.

    And all that a page of a server before this one has begun. What an edited page saves while it does not hold yet what
    was written into its file is left: the page saves once more when it does.
    """

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] == "http":
            notebook.leave(scope)
            if scope.get("method") == "POST" and not notebook.is_served(scope["app"]):
                brought = await notebook.take_over(scope)
                if brought and scope["path"].endswith("/api/kernel/save"):
                    body = await Request(scope, receive).body()
                    if _is_before(json.loads(body), brought):
                        await PlainTextResponse("")(scope, receive, send)
                        return
                    receive = _again(body, receive)
        if scope["type"] != "websocket" or not notebook.is_served(scope["app"]):
            await self._app(scope, receive, send)
            return
        told = Told(send)
        try:
            await self._app(scope, receive, told)
        finally:
            told.end()


class _Said(NamedTuple):
    """A message: of which cell, and what."""

    op: str
    cell: str = ""
    state: str = ""
    error: bool = False
    output: bool = False
    printed: bool = False


class Told:
    """What one page is told; the states of its cells once they last, unless an output or another state overtakes them.

    An error, and what was printed, are taken back by the states that follow: of such a cell the next ones are told.
    """

    def __init__(self, send: Send) -> None:
        self._send = send
        self._shown, self._printed, self._with_fields = set[str](), set[str](), set[str]()
        self._held = dict[str, list[Message]]()
        self._later: asyncio.Task[None] | None = None

    async def __call__(self, message: Message) -> None:
        text = message.get("text") if message["type"] == "websocket.send" else None
        said = _read(text) if text else _Said("")
        self._with_fields.update(_FIELDS_OF.findall(text or ""))
        if said.op == "remove-ui-elements" and said.cell not in self._with_fields:
            return
        if said.op == "cell-op":
            held = self._held.pop(said.cell, [])
            if self._waits(said):
                self._held[said.cell] = [*held, message]
                if self._later is None or self._later.done():
                    self._later = asyncio.create_task(self._tell_what_lasts())
                return
            if said.printed:
                for before in held:
                    await self._send(before)
        await self._send(message)

    def end(self) -> None:
        """Tell no more."""
        if self._later:
            self._later.cancel()

    def _waits(self, said: _Said) -> bool:
        """Whether a state is one that its cell's output may overtake; what else is said is taken note of."""
        if said.output:
            (self._shown.discard if said.error else self._shown.add)(said.cell)
        if said.printed:
            self._printed.add(said.cell)
        if said.output or said.printed or said.state not in ("queued", "running"):
            return False
        if said.cell in self._shown - self._printed:
            return True
        if said.state == "running":  # which takes back what was printed
            self._printed.discard(said.cell)
        return False

    async def _tell_what_lasts(self) -> None:
        await asyncio.sleep(AT_ONCE)
        while self._held:
            for message in self._held.pop(next(iter(self._held))):
                await self._send(message)


def _is_before(saved: Any, brought: Mapping[str, str | None]) -> bool:
    """Whether a page saves other texts than those that it is brought."""
    codes = dict(zip(saved["cellIds"], saved["codes"], strict=True))
    return any(codes.get(cell) != code for cell, code in brought.items())


def _again(body: bytes, receive: Receive) -> Receive:
    """What gives the body of a request once more, and then what follows."""
    left = [{"type": "http.request", "body": body, "more_body": False}]

    async def received() -> Message:
        return left.pop() if left else await receive()

    return received


def _read(text: str) -> _Said:
    if len(text) < _SHORT:
        told = json.loads(text)
        data = told.get("data") or {}
        error = (data.get("output") or {}).get("mimetype", "").endswith("+error")
        more = bool(data.get("output")), bool(data.get("console"))
        return _Said(told["op"], data.get("cell_id", ""), data.get("status") or "", error, *more)
    if cell := _CELL.match(text):
        head = text[:_SHORT]
        printed = '"output":null' in head
        return _Said("cell-op", cell[1], "", "application/vnd.marimo+error" in head, not printed, printed)
    return _Said("")


middleware = Middleware(Fewer)
