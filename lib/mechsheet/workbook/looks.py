"""How a workbook looks: formats of cells, colours, fonts of charts, and measures."""

from collections.abc import Mapping

Look = Mapping[str, object]  # properties of a format, as XlsxWriter takes them
INK, RULE = "#1F3864", "#7F7F7F"
HEAD: Look = {"bold": True, "font_color": INK, "bg_color": "#E9EDF4"}
TOP: Look = {"top": 1, "top_color": RULE}
BOTTOM: Look = {"bottom": 1, "bottom_color": RULE}
SECTION: Look = {"bold": True, "font_color": INK, "valign": "bottom", "indent": 1}
NOTE: Look = {"italic": True, "font_size": 9}
KEY: Look = {"font_color": INK}
CELL: Look = {"bottom": 4, "bottom_color": "#C8C8C8"}
TEXT: Look = {"align": "left", "indent": 1, "text_wrap": True}
NUMBER: Look = {"align": "right"}
TYPED_IN: Look = {"num_format": "General;-General"}  # 85% stays 0.85 as it counts; in General it would look like 85%
FIELD: Look = {**NUMBER, **TYPED_IN, "bg_color": "#FFF8D6", "border": 4, "border_color": RULE}
VALUE_DECIMALS = 6
VALUE: Look = {**NUMBER, "num_format": f"0.{'0' * VALUE_DECIMALS}"}
SMALL: Look = {**NUMBER, "num_format": "0.0E+00;-0.0E+00;0"}
QUANTITY: Look = {**NUMBER, "num_format": "[>=100]0;[>=0.01]0.000;General"}  # of any size
FROM = '"≥ "'
AT_LEAST: Look = {**NUMBER, "num_format": f"[>=100]{FROM}0;[>=0.01]{FROM}0.000;{FROM}General"}
SI: Look = {**NUMBER, "num_format": '[>=1E+307]"∞";[<=-1E+307]"-∞";General', "font_color": "#595959"}
INFINITE: Look = {"num_format": '"∞"'}
SI_DECIMALS = 6
EXPORTED: Look = {"bg_color": "#E4E4E4", "font_color": "#595959"}  # does not follow other inputs
BEHIND = "#A6A6A6"  # tabs of sheets behind the tables
TYPED: Look = {"num_format": "@", "text_wrap": False, "shrink": True}  # stays a text, and has room at any length
LINK: Look = {"align": "left", "indent": 1, "font_color": "#0563C1", "underline": 1}
VERDICT: Look = {"align": "center", "bold": True}
PASS: Look = {"font_color": "#2F6B2F"}
FAIL: Look = {"font_color": "#FFFFFF", "bg_color": "#A61C1C"}  # stands out on black-and-white paper too
OPEN: Look = {"font_color": "#7A4B00", "bg_color": "#FCE4B8"}  # not evaluated

# Pixels at 96 dpi: a character, a cell's padding, a row; the printable part of A4 upright and on its side.
CHAR, PAD, ROW = 7, 18, 21
UPRIGHT, SIDEWAYS = (680, 980), (1000, 650)
TYPED_ROOM = 20  # characters of a column of texts that may be typed, at least
WIDEST, WRAP = 48, 58  # digits that the widest column holds, letters that fill a line of it
FIRST = 4  # rows over the numbers of a table: title, note, symbols, units
EMPTY = 64  # a column of no width of its own, in the last of which a chart may end
LONG = 40  # rows; a longer table has its charts beside it, not below
ONE, MANY, GAP = (590, 330), (455, 300), 14  # a chart alone, a chart among others, between charts

CHART = {"name": "Arial", "size": 9, "color": "#262626"}
AXIS = {
    "name_font": {**CHART, "bold": False},
    "num_font": CHART,
    "label_position": "low",
    "line": {"color": RULE},
    "major_gridlines": {"visible": True, "line": {"color": "#D9D9D9", "width": 0.5}},
}
COLORS = ("#1F4E79", "#C55A11", "#548235", "#7030A0", "#000000", "#A61C1C", "#2E8B8B", "#806000")
MARKERS = ("circle", "square", "triangle", "diamond", "x", "plus", "star", "short_dash")
DASHES = ("solid", "dash", "long_dash_dot", "round_dot")


def side(look: Look) -> Look:
    """To which side a look aligns, for the heading over it."""
    return {key: look[key] for key in ("align", "indent") if key in look}
