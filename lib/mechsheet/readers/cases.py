"""What runs within tolerances tell of numbers and checks that jump there: slopes tell nothing of them."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mechsheet.quantities.operations import Values
from mechsheet.worksheet import numbers

RESULTS = "results"  # where lines stand
JUMPS = "it jumps"
Key = tuple[str, str]  # where numbers are shown, and their name
_AS_SHOWN = 1.05  # times a deviation: it is shown with two digits
_BENT = 1.5  # times one: what gets no farther off may but bend
_SURE = 0.999  # a greater part of the cases is more than they can tell
_ROUNDING = 1e-9  # of the greatest number


@dataclass(frozen=True, eq=False)
class Cases:
    """Runs of a worksheet within its tolerances: at their ends, and behind these the ``count`` random ones.

    ``spans`` are the least and the greatest numbers of the cases that are within all tolerances, in display units, by
    where they are shown and their name, None of what has other rows in some case; ``holds`` is whether each check does
    in each case. In the ``lost`` ones the worksheet gives no numbers, in the first of them for the ``reason``. What
    recordings of cases do not tell of others, a check at some of its positions, ``alone`` tells by running each.
    """

    count: int
    spans: Mapping[Key, tuple[Values, Values] | None]
    holds: Mapping[str, Values]
    lost: int = 0
    reason: str = ""
    alone: "Callable[[], Cases] | None" = None

    @cached_property
    def ran(self) -> "Cases | None":
        """The same by running each."""
        return self.alone() if self.alone else None

    def sure(self, name: str, passed: bool) -> str:
        """How sure the verdict of a check is."""
        if (holds := self.holds.get(name)) is None:
            if self.ran:
                return self.ran.sure(name, passed)
            return "how sure is not known: not every case has a check of this name"
        if np.all(holds == passed):
            return f"in all of {self.count} random cases"
        return in_cases(float(holds[-self.count :].mean()), passed)

    def outside(self, key: Key, values: Values, worst: Values, unit: str) -> str:
        """Between what numbers lie that are farther off than the worst of a band, both in the unit; else nothing."""
        span = self.spans.get(key)
        if span is None or span[0].size != values.size:
            return "there are others of them"
        (low, high), size = span, values.size
        if not is_outside(values, low, high, worst):
            return ""
        k = int(np.argmax(np.nan_to_num(high - low)))
        ends = numbers.span(numbers.significant(float(end), 6) for end in (low[k], high[k]))
        row = f" in row {k + 1}" if size > 1 else ""
        return f"{ends}{numbers.suffix(unit)}{row} in {self.count} random cases"

    def told(self) -> list[str]:
        """That some cases have no numbers."""
        return [f"{self.lost} cases within the tolerances have no numbers: {self.reason}"] if self.lost else []


def is_outside(values: Values, least: Values, greatest: Values, worst: Values) -> bool:
    """Whether numbers get farther off than by the worst of a band, as it is shown; so they do where that is none.

    An infinite one, as of the slope of a root at 0, tells of nothing either.
    """
    own, low, high = (np.reshape(x, -1) for x in (values, least, greatest))
    known = np.isfinite(own)
    finite = np.where(np.isinf(worst), np.nan, worst)
    within = _AS_SHOWN * np.reshape(finite, -1) + _ROUNDING * np.max(np.abs(own), initial=0.0, where=known)
    return bool(np.any(known & ~((high - own <= within) & (own - low <= within))))


def goes_on(values: Values, least: Values, greatest: Values, worst: Values) -> str:
    """What numbers that are outside do where a line goes another way, as far as slopes tell."""
    return JUMPS if is_outside(values, least, greatest, _BENT * worst) else f"{JUMPS} or bends"


def in_cases(share: float, passed: bool) -> str:
    """How sure a verdict is that is another one in some of the cases, of which the check holds in a part."""
    percent = f"{numbers.significant(100 * share, 3 if share > 0.9 else 2)} %"
    if not 1 - _SURE <= share <= _SURE:
        end = 100 * (_SURE if share > _SURE else 1 - _SURE)
        percent = f"{'more' if share > _SURE else 'less'} than {numbers.fixed(end, 1)} %"
    return f"in {percent} of cases, fails at worst" if passed else f"holds in {percent} of cases"
