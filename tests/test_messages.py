"""What a served page is told of its cells while they are computed."""

import asyncio
import json
import os
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from types import SimpleNamespace
from typing import Any

import pytest
from conftest import until
from test_page import HITCH, ready

from mechsheet.page import messages

ERROR = {"channel": "marimo-error", "mimetype": "application/vnd.marimo+error", "data": [{"type": "exception"}]}
SHOWN = {"channel": "output", "mimetype": "text/html", "data": "<p>1</p>"}
LONG = SHOWN | {"data": "<p>1</p>" * 100}
PRINTED = {"channel": "stdout", "mimetype": "text/plain", "data": "1"}
PAUSE = object()


def told(*sent: Any) -> list[str]:
    """What a page is told of what is sent, states by their names; it waits where it says so."""
    said: list[str] = []

    async def send(message: dict[str, Any]) -> None:
        data = json.loads(message["text"])
        cell = data["data"].get("cell_id", "")
        content = "output" if data["data"].get("output") else "printed" if data["data"].get("console") else ""
        said.append(f"{cell} {content or data['data'].get('status') or data['op']}".strip())

    async def run() -> None:
        page = messages.Told(send)
        for each in sent:
            if each is PAUSE:
                await asyncio.sleep(messages.AT_ONCE * 2)
            else:
                data = json.dumps(each["data"], separators=(",", ":"))  # as marimo writes them
                await page({"type": "websocket.send", "text": f'{{"op": "{each["op"]}", "data": {data}}}'})
        page.end()

    with ThreadPoolExecutor(1) as thread:  # in this one a browser's loop may run
        thread.submit(lambda: asyncio.run(run())).result()
    return said


def cell(name: str, status: str | None = None, output: Any = None, console: Any = None) -> dict[str, Any]:
    data = {"op": "cell-op", "cell_id": name, "output": output, "console": console, "status": status}
    return {"op": "cell-op", "data": data}


def run(name: str, output: Any = SHOWN, *within: Any) -> Iterator[Any]:
    """All that marimo says of a cell that is run."""
    yield cell(name, "queued")
    yield {"op": "remove-ui-elements", "data": {"op": "remove-ui-elements", "cell_id": name}}
    yield cell(name, "running", console=[])
    yield from within
    yield cell(name, output=output)
    yield cell(name, "idle")


@pytest.mark.parametrize("output", [SHOWN, LONG])
def test_of_a_cell_that_is_computed_at_once_the_output_is_told(output) -> None:
    first, again = told(*run("A", output)), told(*run("A", output), *run("A", output), *run("A", output))
    assert first == ["A queued", "A running", "A output", "A idle"]
    assert again == [*first, "A output", "A idle", "A output", "A idle"]


def test_a_state_that_lasts_is_told() -> None:
    """In their order, and once: what was overtaken until then is not."""
    begun = [*run("A"), *run("B")]
    waiting = [
        cell("A", "queued"),
        cell("B", "queued"),
        cell("A", "running"),
        cell("A", output=SHOWN),
        cell("A", "idle"),
    ]
    more = [cell("B", "running"), PAUSE, cell("B", output=SHOWN), cell("B", "idle")]
    assert told(*begun, *waiting, PAUSE, *more)[8:] == [
        *["A output", "A idle", "B queued", "B running", "B output", "B idle"],
    ]


@pytest.mark.parametrize("error", [ERROR, ERROR | {"data": [{"type": "exception", "msg": "x" * 900}]}])
def test_the_states_that_take_an_error_back_are_told(error) -> None:
    """marimo's page leaves out what a cell shows until its states say that it is no error any more."""
    after = told(*run("A"), *run("A", error), *run("A"), *run("A"))[4:]
    assert after == ["A output", "A idle", "A queued", "A running", "A output", "A idle", "A output", "A idle"]


@pytest.mark.parametrize("printed", [PRINTED, PRINTED | {"data": "1" * 900}])
def test_what_was_printed_is_taken_back(printed) -> None:
    """By the state that comes before it: else it would clear what has just been printed, or never go."""
    after = told(*run("A"), *run("A", SHOWN, cell("A", console=printed)), *run("A"), *run("A"))[4:]
    assert after == [
        *["A queued", "A running", "A printed", "A output", "A idle"],
        *["A queued", "A running", "A output", "A idle", "A output", "A idle"],
    ]


@pytest.mark.parametrize("quote", ['"', "'", '\\"'])
def test_fields_of_a_cell_are_told_to_go_only_where_it_had_some(quote) -> None:
    """Wherever they were shown: a cell may show the fields that another one makes."""
    fields = LONG | {"data": f"<marimo-ui-element object-id={quote}A-0{quote}></marimo-ui-element>" * 20}
    after = told(*run("A"), *run("B", fields), *run("A"), *run("B"))
    assert [each for each in after if "remove" in each] == ["A remove-ui-elements"]


def test_what_is_no_state_of_a_cell_is_told() -> None:
    others = [{"op": op, "data": {"op": op, "variables": []}} for op in ("variable-values", "completed-run", "alert")]
    assert told(*others) == ["variable-values", "completed-run", "alert"]


def test_an_input_brings_two_messages_a_cell(serve, page, console_errors) -> None:
    """And one for the run itself, one for what the fields are."""
    received: list[str] = []
    page.on("websocket", lambda socket: socket.on("framereceived", lambda data: received.append(str(data))))
    done = partial(until, page, lambda: any('"completed-run"' in each[:40] for each in received), "no run is completed")
    page.goto(serve("run", HITCH))
    ready(page)
    done()
    received.clear()
    field = page.locator(".ms-inputs tr:has-text('weight of the implement') input")
    field.fill("30000")
    field.press("Enter")
    done()
    page.wait_for_timeout(1000)  # an input right behind the opening is told twice by marimo, and run twice
    read = [json.loads(each) for each in received]
    outputs = {each["data"]["cell_id"] for each in read if each["data"].get("output")}
    assert len(outputs) > 20
    states = [each["data"]["status"] for each in read if each["op"] == "cell-op"]
    assert states.count("idle") == states.count(None) >= len(outputs)
    assert "remove-ui-elements" not in {each["op"] for each in read}
    assert console_errors == []


def asked(app: SimpleNamespace, path: str, body: object) -> list[str]:
    """What the editor hears of a request, and whether it answers itself."""
    heard: list[str] = []

    async def marimo(scope: Any, receive: Any, send: Any) -> None:
        heard.append((await receive())["body"].decode())

    async def receive() -> Any:
        return {"type": "http.request", "body": json.dumps(body).encode(), "more_body": False}

    async def send(message: Any) -> None:
        heard.append(str(message.get("status", "")))

    headers = [(b"marimo-session-id", b"s_1")]
    scope = {"type": "http", "method": "POST", "app": app, "headers": headers, "path": path}
    with ThreadPoolExecutor(1) as thread:
        thread.submit(lambda: asyncio.run(messages.Fewer(marimo)(scope, receive, send))).result()
    return heard


def test_an_edited_page_saves_nothing_over_what_was_written_into_its_file(tmp_path) -> None:
    """A line that was written in place was gone, and said to be written, where a text beside it was saved at once."""
    file, cells = tmp_path / "own.py", [SimpleNamespace(id="A", code="a = 1"), SimpleNamespace(id="B", code="b = 1")]
    file.write_text("a = 1")
    manager = SimpleNamespace(path=str(file), file_content_matches_last_save=lambda: file.read_text() == cells[0].code)
    session = type("Session", (), {"app_file_manager": manager, "document": SimpleNamespace(cells=cells)})()

    async def changed(path: str) -> None:
        if file.read_text() == "b = 3":
            cells[:] = [SimpleNamespace(id="B", code="b = 3"), SimpleNamespace(id="C", code="c = 3")]
        else:
            cells[0].code = file.read_text()

    sessions = SimpleNamespace(mode="edit", watch=True, get_session={"s_1": session}.get, trigger_file_change=changed)
    app = SimpleNamespace(state=SimpleNamespace(session_manager=sessions))

    def saved(**cells: str) -> list[str]:
        body = {"cellIds": list(cells), "codes": list(cells.values())}
        return [each for each in asked(app, "/api/kernel/save", body) if each != json.dumps(body)]

    assert saved(A="a = 1", B="b = 1") == []
    file.write_text("a = 2")
    os.utime(file, ns=(0, 0))
    assert saved(A="a = 1", B="b = 2") == ["200", ""], "of before"
    assert saved(A="a = 1", B="b = 2") == ["200", ""], "it is still"
    assert saved(A="a = 2", B="b = 2") == []
    asked(app, "/api/document/transaction", {})
    assert saved(A="a = 1", B="b = 2") == [], "typed since"

    file.write_text("b = 3")
    os.utime(file, ns=(0, 1))
    assert saved(A="a = 1", B="b = 3", C="c = 3") == ["200", ""], "one cell is no more"
    assert saved(B="b = 3") == ["200", ""], "one is new"
    assert saved(B="b = 3", C="c = 3") == []

    manager.path = None
    assert saved(B="b = 4") == [], "a new notebook has no file"
