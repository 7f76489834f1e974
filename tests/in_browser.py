"""Scripts of recordings run in a blank page of a browser."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

if TYPE_CHECKING:
    from playwright.sync_api import Page

_RUN = """([all, verdicts, words]) => {
  %s
  const plain = v => (v instanceof Float64Array ? [Array.from(v), v.shape ?? [v.length]] : v === undefined ? null : v);
  const told = v => (v instanceof Float64Array ? Array.from(v) : Array.isArray(v) ? v.map(told)
    : v && typeof v == "object" ? Object.fromEntries(Object.keys(v).map(key => [key, told(v[key])])) : v);
  return all.map(given => {
    const out = evaluate(given);
    const values = Object.fromEntries(Object.entries(out.values).map(([key, v]) => [key, plain(v)]));
    const text = words && foundHTML(words, Object.values(out.found)[0]);
    return {values, gaps: out.gaps, guards: out.guards, found: verdicts && told(out.found), text};
  });
}"""


def evaluated(
    page: Page,
    script: str,
    given: Iterable[Mapping[str, Any]],
    verdicts: bool = False,
    words: Mapping[str, Any] | None = None,
) -> list[dict[str, Any]]:
    """What a script gives for several sets of inputs; a value that it knows nothing of is None.

    With ``verdicts`` all that is told of found values, for which other solutions are searched, and with ``words`` its
    text, which is that of the page.
    """
    inputs = [{name: np.asarray(x, float).tolist() for name, x in each.items()} for each in given]
    found: list[dict[str, Any]] = page.evaluate(_RUN % script, [inputs, verdicts, words])
    for each in found:
        each["values"] = {key: _array(value) for key, value in each["values"].items()}
    return found


def faults(page: Page) -> list[str]:
    """What keeps someone from reading or using a page, light or dark."""
    found = list[str]()
    schemes: list[Literal["light", "dark"]] = ["light", "dark"]
    for scheme in schemes:
        page.emulate_media(color_scheme=scheme)
        found += (f"{scheme}: {fault}" for fault in page.evaluate(_AUDIT))
    return found


_AUDIT = Path(__file__).with_name("audit.js").read_text(encoding="utf-8")


def _array(value: Any) -> Any:
    if value is None:
        return None
    return np.reshape(np.array(value[0], float), value[1]) if isinstance(value, list) else np.array(float(value))
