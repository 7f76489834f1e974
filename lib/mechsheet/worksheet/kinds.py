"""The kinds of inputs: a number, a choice of named options, a switch; a text is `TextLine`.

Each kind reads what is typed, converts it from the display unit and back, and says what it is made of: its leaves are
the numbers by which a recording, a sweep and a workbook know it.
"""

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from math import inf
from typing import Any, NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from mechsheet import units
from mechsheet.worksheet import errors, numbers
from mechsheet.worksheet.chosen import Chosen
from mechsheet.worksheet.deviation import Deviation
from mechsheet.worksheet.errors import SheetError

T = TypeVar("T")
_NUMBER = re.compile(r"([+−-]?(?:\d+(?:[.,]\d*)?|[.,]\d+)(?:[eE][+−-]?\d+)?)(.*)", re.DOTALL)
_THOUSANDS = r"\W?[1-9]\d{0,2},\d{3}(?!\d)"  # elsewhere read as such, here as a number with a decimal comma
_UNIT = 40  # characters of a unit at most


@dataclass(frozen=True)
class Input:
    """One declared input, here a number; a value is held in SI, and shown in the display unit.

    ``limits`` are pairs such as (">", "0"), in the display unit, or ("<", "S_max"); ``tolerance`` is how far the value
    may be off. ``mistake`` tells why the unit is not known, and the value is in SI; ``line`` is where it is declared.
    """

    name: str
    unit: str
    meaning: str
    section: str
    whole: bool
    limits: tuple[tuple[str, str], ...]
    many: bool = False  # whether it stands for a column of numbers
    mistake: str = ""
    line: int = 0
    tolerance: Deviation | None = None

    @property
    def continuous(self) -> bool:
        """Whether it is a number that may be varied a little."""
        return type(self) is Input and not self.whole

    @property
    def is_text(self) -> bool:
        """Whether it is a text, on which no number rests."""
        return False

    @property
    def counted(self) -> bool:
        """Whether it is a whole number in SI too: teeth are, turns a minute are not."""
        return self.whole and units.parse(self.unit).factor == 1

    def display(self, value: Any) -> Any:
        """Value in the display unit, the rounding of the conversion taken back."""
        if self.counted:
            return value
        shown = value / units.parse(self.unit).factor
        if np.ndim(shown):
            return shown
        rounded = float(numbers.significant(shown, 15))
        return int(rounded) if self.whole and rounded.is_integer() else rounded

    def read(self, value: object) -> Any:
        """Number in the display unit, from a number or a text, behind which another unit may stand.

        Raises SheetError naming the input and what cannot be used of it.
        """
        try:
            x, other = number_and_unit(value)
            if other:
                try:
                    x = converted(x, other, self.unit)
                except ValueError as error:
                    given = f"{self.meaning} {self.name} = {errors.as_given(value)}"
                    raise SheetError(f"{given}: {error}", self.name) from None
        except SheetError:
            raise
        except ValueError:
            raise SheetError(f"{self.says(errors.as_given(value))} is no number", self.name) from None
        if self.whole and not x.is_integer():
            raise SheetError(f"{self.says(x)} must be a whole number", self.name)
        return x

    def si(self, value: Any, default: Any) -> Any:
        """SI value of a number or an array in the display unit; the default itself where it is shown as that number."""
        if np.ndim(value):
            return np.where(value == self.display(default), default, value * units.parse(self.unit).factor)
        if value == self.display(default):
            return default
        return int(value) if self.counted else float(value * units.parse(self.unit).factor)

    def written(self, value: Any, default: Any) -> Any:
        """Value in the display unit that is read back as the very same value, where there is one."""
        shown = self.display(value)
        if self.counted or np.ndim(value) or value == default or self.si(shown, default) == value:
            return shown
        x = value / units.parse(self.unit).factor
        near = (x, *(float(np.nextafter(x, end)) for end in (-np.inf, np.inf)))
        return next((y for y in near if self.si(y, default) == value), x)

    def text(self, value: Any) -> str:
        """Value as a field of the page shows it, which is read back."""
        return numbers.significant(self.display(value), 15)

    def brief(self, value: Any) -> str:
        """Value as a list of the inputs shows it."""
        return numbers.significant(self.display(value), 10)

    def says(self, value: object) -> str:
        """The input as an error names it: meaning, symbol, value and unit."""
        return f"{self.meaning} {self.name} = {value}{numbers.suffix(self.unit)}"

    def readings(self, value: object) -> Iterator[str]:
        """How a text is read that could mean thousands elsewhere."""
        if isinstance(value, str) and re.match(_THOUSANDS, value.strip()):
            read = numbers.significant(self.read(value), 15)
            yield f"{self.name} = {read}{numbers.suffix(self.unit)}, read with a decimal comma"

    def array(self, values: Iterable[Any]) -> NDArray[Any]:
        """Several values as an array, of whole ones too: numpy's own integers are cut, and overflow without a word."""
        return np.array([*values], float)

    def same(self, a: Any, b: Any) -> bool:
        """Whether two values are the same."""
        return bool(np.all(a == b))

    def taken(self, value: Any) -> Any:
        """The value that is held where code gives this one, in SI: what is not whole has decimals."""
        whole = type(value) is int or isinstance(value, np.integer)
        return float(value) if whole and not self.whole else value

    def first(self, value: Any) -> Any:
        """The value that is held where the line that declares it gives this one; SheetError where it cannot be."""
        given = f"{self.name} = {errors.as_given(value)}"
        if isinstance(value, list | tuple):
            raise SheetError(f"{given} is several values: a decimal number has a point, not a comma")
        if isinstance(value, bool | np.bool_) or not isinstance(value, int | float | np.integer | np.floating):
            raise SheetError(f"{given} is no number")
        if not self.whole:
            return self.taken(value)
        # 1450 of [rpm] are turns a minute, 1450 * rpm is in SI as whatever is computed
        shown = value if isinstance(value, int | np.integer) else self.display(value)
        if not float(shown).is_integer():
            raise SheetError(f"{self.name} = {shown}{numbers.suffix(self.unit)} must be a whole number")
        return self.si(int(shown), np.nan)

    def leaves(self, value: Any) -> "dict[str, tuple[Input, Any]]":
        """Numbers of which a value is made, by name, each with its declaration; of a text 0."""
        return {self.name: (self, value)}

    def texts(self, value: Any) -> tuple[str, ...]:
        """Texts of which a value is made."""
        return ()

    def leaf(self, column: Any, default: Any) -> Any:
        """What is held of many variants, from an array as it is shown."""
        return self.si(column, default)

    def held(self, leaves: Mapping[str, Any]) -> Any:
        """The value made of its leaves, which may be arrays of variants or quantities of a recording."""
        value = leaves[self.name]
        return int(value) if self.counted and isinstance(value, int | float | np.number) else value


class Offer(NamedTuple):
    """Options with their properties, and which of them is chosen at first."""

    options: Mapping[str, Any]
    name: str


def one_of(options: Mapping[str, T], name: str) -> T:
    """A choice of named options in a class of inputs: the one of that name at first.

    The options are objects of a class of `inputs` without values, which declares their properties::

        @inputs
        class Grade:
            R_m: float  # [MPa] tensile strength; > 0

        GRADES = {"8.8": Grade(800 * MPa), "10.9": Grade(1040 * MPa)}

        @inputs
        class Given:
            bolt: Grade = one_of(GRADES, "8.8")  # grade of the bolts

    ``g.bolt.R_m`` is the property of the chosen one, ``g.bolt == "8.8"`` tells which it is.
    """
    offer: Any = Offer(options, name)
    return offer  # type: ignore[no-any-return]


@dataclass(frozen=True)
class Worded(Input):
    """An input that is typed and shown as a word or a text, not as a number."""

    def display(self, value: Any) -> Any:
        return str(value)

    def written(self, value: Any, default: Any) -> Any:
        return self.display(value)

    def text(self, value: Any) -> str:
        return str(value)

    def brief(self, value: Any) -> str:
        return self.text(value)

    def readings(self, value: object) -> Iterator[str]:
        yield from ()


@dataclass(frozen=True)
class Choice(Worded):
    """A choice of named options; ``table`` has a row of properties for each, numbers in SI or texts."""

    options: tuple[str, ...] = ()
    properties: tuple[Input, ...] = ()
    table: tuple[tuple[Any, ...], ...] = ()

    def read(self, value: object) -> Any:
        """Name of the option; a number is the option that is called so."""
        plain = isinstance(value, int | float) and not isinstance(value, bool)
        name = " ".join((numbers.significant(float(value), 15) if plain else str(value)).split())  # type: ignore[arg-type]
        if name not in self.options and name.replace(",", ".") in self.options:
            name = name.replace(",", ".")
        if name not in self.options:
            near = errors.nearest(name, self.options)
            hint = f"; nearest: {near[0]}" if near and len(self.options) > 5 else ""
            offered = ", ".join(self.options)
            raise SheetError(f"{self.says(errors.as_given(value))} must be one of {offered}{hint}", self.name)
        return name

    def si(self, value: Any, default: Any) -> Any:
        return self.held({self.name: self.options.index(value)})

    def first(self, value: Any) -> Any:
        return self.si(self.read(value.name if isinstance(value, Offer) else value), None)

    def leaf(self, column: Any, default: Any) -> Any:
        return np.array([self.options.index(name) if name in self.options else -1 for name in column])

    def taken(self, value: Any) -> Any:
        return self.si(self.read(value), None) if isinstance(value, str) else value

    def leaves(self, value: Any) -> dict[str, tuple[Input, Any]]:
        at: tuple[Input, Any] = (self, self.options.index(str(value)))
        columns = {f"{self.name}.{p.name}": (p, np.array(own)) for p, own in self.columns() if not p.is_text}
        return {self.name: at, **columns}

    def columns(self) -> Iterator[tuple[Input, tuple[Any, ...]]]:
        """Each property with those of all options."""
        for k, each in enumerate(self.properties):
            yield each, tuple(row[k] for row in self.table)

    def held(self, leaves: Mapping[str, Any]) -> Any:
        at, properties = leaves[self.name], dict[str, Any]()
        for each, column in self.columns():
            held = each.array(column) if isinstance(at, np.ndarray) else column
            own = held[at] if isinstance(at, np.ndarray | int) else None
            properties[each.name] = leaves.get(f"{self.name}.{each.name}", own)
        return Chosen(self.options, at, properties)


@dataclass(frozen=True)
class Switch(Worded):
    """What is so or not."""

    def display(self, value: Any) -> Any:
        return bool(value)

    def read(self, value: object) -> Any:
        """Whether it is so, from a truth value or a text."""
        if isinstance(value, bool | np.bool_):
            return bool(value)
        word = str(value).strip().lower()
        if word not in _SAID:
            raise SheetError(f"{self.says(errors.as_given(value))} must be yes or no", self.name)
        return _SAID[word]

    def si(self, value: Any, default: Any) -> Any:
        return bool(value)

    def first(self, value: Any) -> Any:
        return self.read(value)

    def leaf(self, column: Any, default: Any) -> Any:
        return column.astype(bool)

    def text(self, value: Any) -> str:
        return "yes" if value else "no"

    def taken(self, value: Any) -> Any:
        return self.read(value) if isinstance(value, str) else value


_SAID = dict.fromkeys(("yes", "true", "on", "1"), True) | dict.fromkeys(("no", "false", "off", "0"), False)


def number(text: object) -> float:
    """Number written with a decimal point or comma; ValueError for anything else.

    >>> number("0,415"), number("1.75e7"), number("27,500")
    (0.415, 17500000.0, 27.5)
    """
    x, unit = number_and_unit(text)
    if unit:
        raise ValueError(f"{errors.as_given(text)} is no number")
    return x


def converted(x: float, unit: str, own: str) -> float:
    """A number in one unit in another; ValueError where that cannot be, as of another dimension."""
    ratio = units.conversion(unit, own)
    if units.plain(unit) != own and "degC" in (units.plain(unit), own):
        raise ValueError(f"write it in {numbers.in_text(own)}, for a temperature is not a difference")
    return float(numbers.significant(x * ratio, 15))


def number_and_unit(value: object) -> tuple[float, str]:
    """A number and the unit behind it; ValueError where there is no number."""
    if isinstance(value, int) and not isinstance(value, bool):
        return _float(value), ""
    match = None if isinstance(value, bool | complex) else _NUMBER.fullmatch(str(value).strip())
    unit = match[2].strip() if match else ""
    if not match or (unit and not (len(unit) < _UNIT and re.match(r"[^\W\d_]|[%°]|1/", unit))):
        raise ValueError(f"{errors.as_given(value)} is no number")
    return float(match[1].replace(",", ".").replace("−", "-")), unit


def _float(x: int) -> float:
    """A whole number of any length, which Python would refuse to write."""
    try:
        return float(x)
    except OverflowError:
        return inf if x > 0 else -inf
