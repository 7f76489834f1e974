"""What a proof tells of a found value: that there is a root, of which kind, and where another is not excluded."""

from dataclasses import dataclass

from mechsheet.quantities.lines import Solved
from mechsheet.readers import lone_root
from mechsheet.readers.ball_rules import NONE
from mechsheet.readers.balls import Balls, is_least
from mechsheet.worksheet import numbers


@dataclass(frozen=True)
class ProvedRoot:
    """What is proved of a found value: that there is one, of which kind, and where another is not excluded."""

    name: str
    exists: bool
    interval: tuple[float, float] | None
    others: tuple[lone_root.Part, ...] | None
    unit: str
    kind: str = "solution"

    def __str__(self) -> str:
        if not self.exists:
            return f"{self.name}: not proved"
        if self.interval is None or self.others is None:
            return f"{self.name}: proved, one {self.kind} there; others are not looked for"
        alone = f"the only root of its equation in {numbers.extent(self.interval, self.unit)}"
        if not self.others:
            return f"{self.name}: proved, {alone}"
        size = sum(part.high - part.low for part in self.others) / (self.interval[1] - self.interval[0])
        places = ", ".join(numbers.amount(part.low, self.unit, 6) for part in self.others)
        where = f"but for {numbers.significant(size, 1)} of it beside {places}, which is not excluded"
        return f"{self.name}: proved, {alone} {where}"


def proved_root(balls: Balls, name: str, solved: Solved) -> ProvedRoot:
    """What is proved of one that is found, by the balls of what it rests on."""
    node, unit = solved.node, solved.words.unknown_unit
    if node.op != "found":
        return ProvedRoot(name, False, None, None, unit)
    block = node.args[0]
    (found,) = balls.of([node])
    exists = all(x is not NONE and x.is_finite() for x in found.flat)
    if block.least:
        kind = "least sum of squares" if exists and is_least(balls, block) else "level sum of squares"
        return ProvedRoot(name, exists, None, None, unit, kind)
    if not (exists and block.single and block.elementwise and not node.shape and solved.interval):
        return ProvedRoot(name, exists, None, None, unit)
    low, high = balls.of(solved.interval)
    under = {n: balls.known[n] for n in block.under}
    others = lone_root.others(block, under, found[()], low[()], high[()])
    ends = float(low[()]), float(high[()])
    return ProvedRoot(name, exists, ends, None if others is None else tuple(others), unit)
