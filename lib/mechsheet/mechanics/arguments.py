"""Arguments of the mechanics functions, checked once and turned into arrays.

Two kinds are told apart. A parameter (offset, mass, branch) is given by the user: NaN and infinity are mistakes and
raise ValueError. A field (point, direction, velocity, acceleration, force, moment) may come out of an earlier group,
where NaN marks an element that does not exist: NaN passes through, infinity raises ValueError. A length is a
parameter as a single number, and a field in an array: a Find leaves NaN where it has no length for a variant.
"""

import inspect
from collections.abc import Callable, Iterator, Mapping
from dataclasses import is_dataclass
from functools import wraps
from typing import Any, ParamSpec, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mechsheet.mechanics.memory import keep_freed

Complex = NDArray[np.complex128]
Float = NDArray[np.float64]
_REAL: frozenset[type] = frozenset({int, float, np.float64})
_COMPLEX = _REAL | {complex, np.complex128}
_LARGE = 1e300

keep_freed()  # every function of arrays takes its arguments from here

P = ParamSpec("P")
R = TypeVar("R")


def elementwise(f: Callable[P, R]) -> Callable[P, R]:
    """Function of broadcasting arrays: NaN arises without a warning, and wrong shapes are named."""
    return broadcasting(np.errstate(invalid="ignore", divide="ignore")(f))


def broadcasting(f: Callable[P, R]) -> Callable[P, R]:
    """Function that names the shapes which do not broadcast."""

    @wraps(f)
    def checked(*args: P.args, **kwargs: P.kwargs) -> R:
        try:
            return f(*args, **kwargs)
        except ValueError as error:
            if "broadcast" not in str(error):  # one that names its argument
                raise
            raise shape_error(inspect.signature(f).bind(*args, **kwargs).arguments) or error from None

    return checked


def not_negative(value: ArrayLike, name: str, unit: str) -> Float:
    """Finite numbers that are not negative; a zero length is the end of the interval in which a dyad closes."""
    x = parameter(value, name, unit)
    negative = x < 0
    if np.count_nonzero(negative):
        raise refusal(x[negative], name, unit, "must not be negative")
    return x


def length(value: ArrayLike, name: str) -> Float:
    """Lengths that are not negative, NaN in an array where an earlier step gave none; zero as in `not_negative`."""
    if _plain(value, _REAL) and value >= 0:  # type: ignore[operator]
        return np.asarray(float(value))  # type: ignore[arg-type]
    x: Float = _numbers(value, name, "iuf").astype(np.float64, copy=False)
    if np.count_nonzero((x >= 0) & (x < np.inf)) < x.size:
        not_negative(x[~np.isnan(x)] if x.ndim else x, name, "m")
    return x


def parameter(value: ArrayLike, name: str, unit: str) -> Float:
    """Finite real numbers."""
    if _plain(value, _REAL):
        return np.asarray(float(value))  # type: ignore[arg-type]
    x: Float = _numbers(value, name, "iuf").astype(np.float64, copy=False)
    finite = np.isfinite(x)
    if np.count_nonzero(finite) < x.size:
        raise refusal(x[~finite], name, unit, "must be a finite number")
    return x


def sign(branch: ArrayLike) -> Float:
    """Assembly branches, +1 or -1."""
    if type(branch) is int and branch in (1, -1):
        return np.asarray(float(branch))
    s: Float = _numbers(branch, "branch", "iuf").astype(np.float64, copy=False)
    wrong = np.abs(s) != 1
    if np.count_nonzero(wrong):
        raise refusal(s[wrong], "branch", "", "must be +1 or -1")
    return s


def field(value: ArrayLike, name: str) -> Complex:
    """Points or vectors, NaN where an earlier group gave none."""
    if _plain(value, _COMPLEX):
        return np.asarray(complex(value))  # type: ignore[arg-type]
    z: Complex = _numbers(value, name, "iufc").astype(np.complex128, copy=False)
    return _not_infinite(z, name)


def scalar_field(value: ArrayLike, name: str) -> Float:
    """Real quantities over the positions, NaN where an earlier group gave none."""
    if _plain(value, _REAL):
        return np.asarray(float(value))  # type: ignore[arg-type]
    x: Float = _numbers(value, name, "iuf").astype(np.float64, copy=False)
    return _not_infinite(x, name)


def vector(value: ArrayLike, name: str) -> Complex:
    """Complex numbers of any size, infinite ones too."""
    return _of_any_size(value, name, _COMPLEX, "iufc", "D")


def reals(value: ArrayLike, name: str) -> Float:
    """Real numbers of any size, infinite ones too."""
    return _of_any_size(value, name, _REAL, "iuf", "d")


def _of_any_size(value: ArrayLike, name: str, single: frozenset[type], kinds: str, kind: str) -> NDArray[Any]:
    if _plain(value, single):
        return np.asarray(value, kind)
    if type(value) is np.ndarray and value.dtype.char == kind:
        return value
    return _numbers(value, name, kinds).astype(kind, copy=False)


def direction(value: ArrayLike, name: str) -> tuple[Complex, Float]:
    """Directions as given, and their lengths, which may be any but zero."""
    z = field(value, name)
    size = np.abs(z)
    if np.count_nonzero(size) < size.size:
        raise ValueError(f"direction {name} = 0 must not be zero")
    return z, size


def unit(value: ArrayLike, name: str) -> Complex:
    """Unit vectors along the given directions."""
    z, size = direction(value, name)
    return z / size


Numbers = TypeVar("Numbers", Complex, Float)


def _plain(value: ArrayLike, kinds: frozenset[type]) -> bool:
    """Whether the value is one number in which there is nothing wrong: the short way, as most arguments are."""
    return type(value) in kinds and -_LARGE < value.real < _LARGE and -_LARGE < value.imag < _LARGE  # type: ignore[union-attr]


def refusal(wrong: Numbers, name: str, unit: str, limit: str) -> ValueError:
    """Error that names the first of the wrong numbers with the digits that it was given with."""
    given = str(wrong.flat[0]).removesuffix(".0")
    return ValueError(" ".join(filter(None, (name, "=", given, unit, limit))))


def _not_infinite(x: Numbers, name: str) -> Numbers:
    infinite = np.isinf(x)
    if np.count_nonzero(infinite):  # costs a fifth of infinite.any() for a single number
        raise refusal(x[infinite], name, "", "must be finite")
    return x


def unmasked(value: ArrayLike, kind: type | None = None) -> NDArray[Any]:
    """The array of a value: NaN where it is masked, for what stands under a mask is no number of anything.

    An array of another class stays one of it, but for a matrix, whose product is another one.
    """
    x: NDArray[Any] = np.asarray(value, kind)
    if x is value or not isinstance(value, np.ndarray) or x.dtype.kind not in "iufc":
        return x
    masked = getattr(value, "mask", None)  # numpy loads its masked arrays where they are asked for by name
    if masked is not None:
        return np.where(masked, np.nan, x)
    return x if isinstance(value, np.matrix) else np.asanyarray(value, kind)


def _numbers(value: ArrayLike, name: str, kinds: str) -> NDArray[Any]:
    try:
        x = unmasked(value)
    except ValueError:  # rows of different length
        raise ValueError(f"{name} must be an array with rows of equal length") from None
    if x.dtype.kind not in kinds:
        raise ValueError(f"{name} = {first_of(x)} must be {'numbers' if 'c' in kinds else 'real numbers'}")
    return x


def first_of(x: NDArray[Any]) -> str:
    """The first element of an array, as Python writes it: what is there in the place of a number."""
    return repr(next(iter(x.ravel().tolist()), None))


def _parts(name: str, value: Any) -> Iterator[tuple[str, Any]]:
    """The arrays of an argument by their names: of loads and reactions, also of several bodies, each on its own."""
    if is_dataclass(value):
        yield from ((f"{name}.{key}", x) for key, x in vars(value).items())
    elif _holds_loads(value):
        for i, x in enumerate(value):
            yield from _parts(f"{name}[{i}]", x)
    else:
        yield name, value


def _holds_loads(value: Any) -> bool:
    return isinstance(value, list | tuple) and any(is_dataclass(x) or _holds_loads(x) for x in value)


def shape_error(arguments: Mapping[str, Any]) -> ValueError | None:
    """The error that names the arguments whose shapes do not broadcast; None where all do."""
    values = dict(part for name, value in arguments.items() for part in _parts(name, value))
    try:
        shapes = {name: np.shape(value) for name, value in values.items()}
    except ValueError:  # rows of different length have an error of their own
        return None
    try:
        np.broadcast_shapes(*shapes.values())
    except ValueError:
        named = ", ".join(f"{name} {shape}" for name, shape in shapes.items() if shape)
        return ValueError(f"shapes do not broadcast: {named}")
    return None
