"""The start page: a card for each worksheet, with its drawing, its title and what its last run told."""

from collections.abc import Iterable
from dataclasses import dataclass
from html import escape
from pathlib import Path
from urllib.parse import quote


@dataclass(frozen=True)
class Card:
    """A worksheet by its path; of its last run the kind of verdict, what it told, a drawing as SVG, and when it was.

    ``holds`` is false where that was another worksheet or another package; then ``when`` says what is done about it.
    One that takes minutes waits ``to_run`` until someone asks for it. Where it ``opens`` its card leads to it.
    """

    path: str
    title: str
    when: str
    kind: str = ""
    told: str = ""
    picture: str = ""
    holds: bool = True
    to_run: bool = False
    opens: bool = True


def card(shown: Card) -> str:
    """HTML of a worksheet, which leads to it where it opens."""
    told = f'<span class="{shown.kind}">{escape(shown.told)}</span>' if shown.kind else ""
    leads = f' href="?file={quote(shown.path)}"' if shown.opens else ""
    asks = f'<button data-run="{quote(shown.path)}">run it: it searches or measures, for minutes</button>'
    return (
        f"<div><a{leads}><i{'' if shown.holds else ' class=old'}>{shown.picture}</i>"
        f"<b>{escape(shown.title)}</b><code>{escape(Path(shown.path).stem)}</code>"
        f"{told}<small>{escape(shown.when)}</small></a>{asks if shown.to_run else ''}</div>"
    )


def page(groups: Iterable[tuple[str, Iterable[Card]]]) -> str:
    """The page of all worksheets, group by group; it asks for ``?verdicts`` as long as worksheets are run."""
    texts = [f"<h2>{escape(name)}</h2><div>{''.join(map(card, cards))}</div>" for name, cards in groups]
    template = (Path(__file__).parent / "cards.html").read_text(encoding="utf-8")
    return template.replace("GROUPS", "".join(texts))
