"""A drawing as SVG, in the page's own colours."""

import re
from html import escape
from itertools import groupby

from mechsheet.document.labels import FONT, INDEX, Name, Text
from mechsheet.document.layout import lay_out
from mechsheet.document.picture import Group, Mark
from mechsheet.worksheet.drawing import Drawing
from mechsheet.worksheet.symbol import is_slanted

COLOURS = {"": "currentColor", "blue": "#3b82d0", "red": "#e0483c", "green": "#2c9c5c", "orange": "#cf7a17"}


def svg(drawing: Drawing) -> str:
    """The drawing as one SVG element, without identifiers, style sheets and scripts."""
    low, high, groups, texts = lay_out(drawing)
    size = high - low
    faint = "".join([_group(group) for group in groups if group.faint])
    clear = "".join([_group(group) for group in groups if not group.faint])
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{size.real:.1f}" '
        f'viewBox="{low.real:.1f} {low.imag:.1f} {size.real:.1f} {size.imag:.1f}" '
        'style="max-width:100%;height:auto" fill="none" stroke="currentColor" '
        'stroke-linecap="round" stroke-linejoin="round">'
        f'<g opacity="0.3">{faint}</g>{clear}'
        f'<g fill="currentColor" stroke="none" text-anchor="middle" font-size="{FONT}" '
        f"font-family=\"STIX Two Math,'Times New Roman',serif\">{''.join(map(_text, texts))}</g></svg>"
    )


def _group(group: Group) -> str:
    """One element; successive lines of one style are one path."""
    out = [f'<g data-shape="{group.kind}">']
    if group.tip:
        out.append(f"<title>{_escape(group.tip)}</title>")
    for (style, is_circle), run in groupby(group.marks, lambda mark: (_style(mark), mark.radius > 0)):
        if is_circle:
            out += [
                f'<circle {style} cx="{m.points[0].real:.1f}" cy="{m.points[0].imag:.1f}" r="{m.radius:.1f}"/>'
                for m in run
            ]
        else:
            d = ["M" + "L".join([f"{p.real:.1f} {p.imag:.1f}" for p in m.points]) for m in run]
            out.append(f'<path {style} d="{"".join(d)}"/>')
    return "".join(out) + "</g>"


def _style(mark: Mark) -> str:
    if not mark.width:
        return f'stroke="none" fill="{COLOURS[mark.colour]}" fill-opacity="{mark.opacity}"'
    return f'stroke-width="{mark.width}"' + (f' stroke="{COLOURS[mark.colour]}"' if mark.colour else "")


def _text(text: Text) -> str:
    y = text.centre.imag + 0.33 * FONT
    return f'<text x="{text.centre.real:.1f}" y="{y:.1f}">{_spans(text.name)}</text>'


def _spans(name: Name) -> str:
    """A name: one letter slanted, its index lowered."""
    mark, base, index, rest = map(_escape, name)
    if is_slanted(name.base):
        base = f'<tspan font-style="italic">{base}</tspan>'
    if index:
        index = f'<tspan dy="4" font-size="{INDEX}">{index}</tspan>'
    if rest:
        rest = f'<tspan dy="{-4 if index else 0}">{rest}</tspan>'
    return mark + base + index + rest


def _escape(text: str) -> str:
    """Text for XML, without the characters that XML 1.0 has not."""
    return escape(re.sub("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]", "\ufffd", text))
