"""Results of a worksheet by name: their values in display units, and the limits that a scene sets on them."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mechsheet import units
from mechsheet.worksheet import numbers
from mechsheet.worksheet.cells import base, is_result, value
from mechsheet.worksheet.check import Check
from mechsheet.worksheet.errors import SheetError
from mechsheet.worksheet.lines import registry
from mechsheet.worksheet.over import over
from mechsheet.worksheet.scene import Limit


class Displayed(NamedTuple):
    """A number or a field of numbers in its display unit; of a longer field ``places`` are where its ends are."""

    name: str
    unit: str
    meaning: str
    values: NDArray[np.float64]
    places: tuple[str, str] | None = None

    @property
    def span(self) -> str:
        """Least..greatest of the values that there are, one number where they are equal, "nan" where there is none."""
        known = self.values[~np.isnan(self.values)] if self._missing < self.values.size else self.values
        return numbers.span(numbers.significant(end, 6) for end in (np.min(known), np.max(known)))

    @property
    def _missing(self) -> int:
        return int(np.count_nonzero(np.isnan(self.values)))

    @property
    def partly(self) -> str:
        """How many of several values are missing, as behind a span; nothing where all are there, or none."""
        return f", {self._missing} of {self.values.size} missing" if 0 < self._missing < self.values.size else ""

    @property
    def gaps(self) -> str:
        """What is missing, in words; nothing where all is there."""
        return f"{self.name} does not exist at {self._missing} of {self.values.size} positions" if self._missing else ""

    def __str__(self) -> str:
        where = ", least at {}, greatest at {}".format(*self.places) if self.places else ""
        return f"{self.name} = {self.span}{numbers.suffix(self.unit)}{self.partly}{where}, {self.meaning}"


def quantities(name: str, namespace: Mapping[str, Any]) -> list[Displayed]:
    """The named result of a run in its display unit; of complex numbers the real and the imaginary part.

    Raises SheetError where the result is no number, an empty field, or no line declares its unit.
    """
    line = registry(namespace).get(base(name))
    if line is None or line.arguments:
        what = f"is a function of {', '.join(line.arguments)}" if line else "is declared by no line with its unit"
        raise SheetError(f"{name} {what}; numbers with a unit, checks and tables can be asked for")
    values = np.asarray(value(name, namespace))
    shown = values / units.parse(line.unit).factor
    if not values.size:
        raise SheetError(f"{name} has no values")
    if np.iscomplexobj(shown):
        parts = {f"{name}.real": shown.real, f"{name}.imag": shown.imag}
        return [Displayed(part, line.unit, line.meaning, x) for part, x in parts.items()]
    field = over(name, namespace)
    places = field.places(values, str, lambda of, x: numbers.value(x, of.unit, numbers.PLAIN)) if field else None
    return [Displayed(name, line.unit, line.meaning, shown, places)]


def limited(values: Iterable[Any], limits: Mapping[str, Limit], namespace: Mapping[str, Any]) -> list[Any]:
    """Results of a run, its checks under the limits of a scene, and a check more for each limit of a result.

    Raises SheetError for a check with a limit on its other side, and for what is no real number.
    """
    judged, more = list(values), list[Check]()
    held = {check.name: check for check in judged if isinstance(check, Check)}
    for name, limit in limits.items():
        if base(name).isidentifier() and (name not in held or is_result(name, namespace)):
            more += _checks(name, limit, namespace)
            continue
        check = held[name] if name in held else value(name, namespace)
        limit = limit.of(f"the check {name!r}", check.unit)
        bound, none, word = (limit.min, limit.max, "min") if check.at_least else (limit.max, limit.min, "max")
        if bound is None or none is not None:
            raise SheetError(f"limit of the check {name!r} must be {{{word} = NUMBER}}")
        judged = [replace(v, limit=bound) if v is check else v for v in judged]
    return judged + more


def _checks(name: str, limit: Limit, namespace: Mapping[str, Any]) -> Iterator[Check]:
    quantity, *more = quantities(name, namespace)
    if more:
        raise SheetError(f"limit of {name}: it is complex; limit {name}.real, {name}.imag or abs({name})")
    limit, unit, values = limit.of(name, quantity.unit), numbers.suffix(quantity.unit), quantity.values
    reason = quantity.gaps or (f"it is {quantity.span}{unit}" if values.size > 1 else "")
    for bound, sign, worst in ((limit.min, ">=", np.min), (limit.max, "<=", np.max)):  # NaN stays NaN and fails
        if bound is not None:
            title = f"{name} {sign} {numbers.significant(bound, 10)}{unit}"
            yield Check(title, float(worst(values)), bound, quantity.unit, reason, at_least=sign == ">=")
