"""What is counted in a row of a table: a float, as its column is one of floats, that counts and has no decimals."""

from collections.abc import Callable
from typing import Any


class Count(float):
    """A whole number that is a float in arrays, where numpy's own whole numbers are cut and overflow without a word.

    >>> teeth = Count(20)
    >>> f"{teeth} teeth", f"{2 * teeth + 1}", [10, 20, 30][Count(2)], len(range(teeth // 2)), teeth / 8
    ('20 teeth', '41', 30, 10, 2.5)
    """

    def __index__(self) -> int:
        return int(self)

    def __repr__(self) -> str:
        return repr(int(self))

    __str__ = __repr__

    def __format__(self, form: str) -> str:
        return (float(self) if form[-1:] in tuple("eEfFgG%n") else int(self)).__format__(form)


def _counts(name: str) -> Callable[..., Any]:
    """An operation whose result is counted where the other one is too."""
    own = getattr(float, name)

    def made(self: Count, *other: Any) -> Any:
        x = own(self, *other)
        return Count(x) if isinstance(x, float) and all(isinstance(y, int | Count) for y in other) else x

    return made


_OF_TWO = "add", "sub", "mul", "mod", "floordiv"
for _name in (*_OF_TWO, *(f"r{name}" for name in _OF_TWO), "neg", "abs"):
    setattr(Count, f"__{_name}__", _counts(f"__{_name}__"))
