"""Recorded texts as the page must know them: their pieces, with the keys of the numbers that stand in them."""

import re
from collections.abc import Callable
from html import unescape
from typing import Any

from mechsheet.quantities.node import Node
from mechsheet.quantities.written import Either, Number, OneOf, Piece, Written

Key = Callable[[Node], str]
_PLACE, _HELD = "\ue000", re.compile("\ue000(\\d+)\ue001")
_FORMULA = re.compile(r"(\${1,2})(?:[^$\\]|\\.)+?\1")
_IN_FORMULA = re.compile(r"<mn>9071(\d{4})9071</mn>")
_NEGATIVE = re.compile(r"<mo(?: [^>]*)?>−</mo><mn>")
_END = re.compile(r"\s+(?=</p>)")  # of a line with nothing but a piece that is empty now
_MOST_WAYS = 16  # of a text: four choices between two
_MARKUP = re.compile(r"[*_`$\\\[\]<>|#\n]|&[\w#]|^\s*([-+]|\d+[.)])\s")  # in a text that stands for another one


def piece(part: Piece, key: Key) -> Any:
    """A text as it stands; of a number its key, its format and what signs stand for others; one of several by a key."""
    match part:
        case Number(value, spec, instead, blanks):
            spec = spec or ("d" if value.dtype.kind in "iu" else "r")
            return [key(value.re), blanks + spec, *instead]
        case Either(holds, then, otherwise):
            return {"if": key(holds.re), "then": written(then, key), "else": written(otherwise, key)}
        case OneOf(at, texts, column, name):
            return {"of": key(at.re)} | ({"texts": texts} if column is None else {"column": name})
    return part


def texts(own: str | tuple[str | Written, ...], key: Key) -> Any:
    """The name of an input, or texts: each as it stands or its pieces."""
    return own if isinstance(own, str) else [each if isinstance(each, str) else written(each, key) for each in own]


def written(text: Written, key: Key) -> list[Any]:
    return [piece(part, key) for part in text.parts]


def pieces(text: Written, shown: Callable[[str], str], key: Key, ways: int = _MOST_WAYS) -> list[Any]:
    """Pieces of the HTML that ``shown`` makes of a text, and between them those with numbers; none where one of these
    is more than a text there, or than a number in a formula.

    Of a choice with markup in it the whole HTML has so many ``ways``, each with pieces of its own.
    """
    places = [part for part in text.parts if not isinstance(part, str)]
    for n, part in enumerate(text.parts):
        if isinstance(part, Either) and _is_markup(part) and ways > 1:
            by = (Written((*text.parts[:n], *way.parts, *text.parts[n + 1 :])) for way in (part.then, part.otherwise))
            each = [pieces(way, shown, key, ways // 2) for way in by]
            return [{"by": key(part.holds.re), "ways": each}] if all(each) else []
    numbers = iter(range(len(places)))
    marked = "".join(p if isinstance(p, str) else f"{_PLACE}{next(numbers)}\ue001" for p in text.parts)
    html = shown(marked)
    if "<math" in html:
        html = _IN_FORMULA.sub(f"<mn>{_PLACE}\\1\ue001</mn>", shown(_FORMULA.sub(_in_formula, marked)))
        for n in map(int, re.findall(f"<mn>{_PLACE}(\\d+)", html)):
            if isinstance(place := places[n], Number):
                places[n] = place._replace(instead=(*place.instead, ("-", "−")))
    outside = re.sub(r"<[^>]*>", "", re.sub(r"<math>(?:(?!<math).)*?</math>", _told, html, flags=re.DOTALL))
    if [int(n) for n in _HELD.findall(outside)] != [*range(len(places))] or any(map(_is_markup, places)):
        return []
    split = _HELD.split(html)
    now = (Written((places[int(x)],)).now if n % 2 else unescape(x) for n, x in enumerate(split))
    alike = (_END.sub("", _NEGATIVE.sub("<mn>−", each)) for each in ("".join(now), unescape(shown(text.now))))
    if len({*alike}) > 1:  # such as 2. at the beginning, which makes a list
        return []
    return [piece(places[int(x)], key) if n % 2 else x for n, x in enumerate(split)]


def _in_formula(formula: re.Match[str]) -> str:
    """A formula with numbers in its places, which are then those of no other text."""
    return _HELD.sub(lambda place: f"9071{int(place[1]):04d}9071", formula[0])


def _told(formula: re.Match[str]) -> str:
    """The places in a formula that are numbers of their own."""
    return "".join(re.findall(f"<mn>({_PLACE}\\d+\ue001)</mn>", formula[0]))


def of_name(name: Written, shown: Callable[[str], str], key: Key, holds: str) -> list[Any]:
    """Pieces of a name, with the keys without which each is not known, of all the one of whether it ``holds``."""
    found = list[Any]()
    for part in name.parts:
        asked = [holds]

        def noted(node: Node, asked: list[str] = asked) -> str:
            asked.append(key(node))
            return asked[-1]

        found.append(shown(part) if isinstance(part, str) else {"piece": piece(part, noted), "keys": asked})
    return found


def _is_markup(part: Piece) -> bool:
    match part:
        case Either(_, then, otherwise):
            return any(map(_is_markup, (*then.parts, *otherwise.parts)))
        case Number(_, _, instead):
            return any(_MARKUP.search(sign) for _, sign in instead)
        case OneOf(_, texts):
            return any(map(_MARKUP.search, texts))
        case str():
            return bool(_MARKUP.search(part))
    return False
