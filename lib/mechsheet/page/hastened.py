"""What marimo 0.25.1 works out again in every run although it cannot change, kept after the first time.

It reads the entry points of all installed packages at the start of every run, which is a tenth of a slider's step, and
builds the decoder of its messages for each message, which is a tenth of the time of an input in a large worksheet.
Both stand in private places of marimo: another version runs as it is.
"""

from functools import cache
from typing import Any

VERSION = "0.25.1"


def hasten() -> None:
    """Keep both in this process, once."""
    import marimo

    if marimo.__version__ != VERSION:
        return
    import msgspec
    from marimo._entrypoints import registry
    from marimo._messaging.notification import NotificationMessage
    from marimo._session.state import session_view

    if hasattr(registry.get_entry_points, "cache_info"):
        return
    decoder = msgspec.json.Decoder[Any](NotificationMessage, strict=True)
    kept: list[tuple[Any, str, Any]] = [
        (registry, "get_entry_points", cache(registry.get_entry_points)),
        (session_view, "deserialize_kernel_message", decoder.decode),
    ]
    for module, name, function in kept:
        setattr(module, name, function)
