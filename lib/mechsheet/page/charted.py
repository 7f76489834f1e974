"""A chart of altair in the face of the page's own: on its ground, in its letters, the title as a caption."""

from typing import Any

import marimo as mo

_LETTERS, _FAINT = "PT Sans, sans-serif", "#88888860"


def charted(chart: Any) -> tuple[str, str, str]:
    """HTML of a chart, and the number and title of its caption, "" where it has none."""
    from altair import Undefined  # on use: only such a chart needs it

    chart, place, title = chart.copy(deep=False), "", ""
    if isinstance(chart.title, str):
        place, _, title = chart.title.partition(" – ")
        chart.title = Undefined
    config = {} if chart.config is Undefined else chart.config.to_dict()
    config |= {"background": "transparent", "font": _LETTERS, "view": {**config.get("view", {}), "stroke": _FAINT}}
    faint = dict.fromkeys(("gridColor", "domainColor", "tickColor"), _FAINT)
    chart.config = {**config, "axis": {**config.get("axis", {}), **faint, "titleFontWeight": "normal"}}
    # As a whole once: altair looks all through what it is given as a dictionary.
    return mo.as_html(chart).text, place.removeprefix("Figure "), title
