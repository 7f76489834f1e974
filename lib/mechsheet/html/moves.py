"""JavaScript of numpy's functions that move elements, for any lengths of the axes."""

from collections.abc import Callable, Sequence
from operator import getitem
from typing import Any

import numpy as np

from mechsheet.quantities.operations import Moved

_AXES = (np.transpose, np.moveaxis, np.swapaxes)
_SAME_ORDER = (np.ravel, np.expand_dims, np.squeeze, np.atleast_1d, np.atleast_2d)
# How many elements there are after it, of n, and which of them each one is.
_AT = {
    np.roll: "n=>[n,i=>mod(i-({0}),n)]", np.repeat: "n=>[n*{0},i=>floor(i/{0})]", np.tile: "n=>[n*{0},i=>i%n]",
}  # fmt: skip
_PRIMES = (2, 3, 5, 7, 11, 13, 17, 19)


def move(moved: Moved, shape: Sequence[int | None]) -> tuple[str, int] | None:
    """A call's text with places for a field and its shape, and the axes of the result; None where there is none.

    ``shape`` has None for an axis of any length.
    """
    axes, args, named = len(shape), moved.args, dict(moved.named)
    if axes > len(_PRIMES):
        return None
    probe = np.empty([n if n is not None else prime for n, prime in zip(shape, _PRIMES, strict=False)])
    if moved.f is getitem:
        return _index(args[0], axes)
    if moved.f in (np.flip, np.fliplr, np.flipud):
        axis = {np.fliplr: 1, np.flipud: 0}.get(moved.f, named.get("axis", args[0] if args else None))
        flipped = range(axes) if axis is None else [axis % axes] if isinstance(axis, int) else None
        if flipped is not None:
            return _index(tuple(slice(None, None, -1) if k in flipped else slice(None) for k in range(axes)), axes)
    if moved.f in _AXES:
        order = [np.empty(_PRIMES[:axes]).shape.index(n) for n in moved(np.empty(_PRIMES[:axes])).shape]
        return f"turned({{}},{{}},{order})".replace(" ", ""), axes
    if moved.f is np.reshape and not named:
        dims = args[0] if len(args) == 1 and isinstance(args[0], tuple) else args
        if all(isinstance(n, int) for n in dims):
            return _reshaped([str(n) for n in dims])
    if moved.f in _SAME_ORDER:
        after = moved(probe).shape
        if len(after) == 1 and moved.f is np.ravel:
            return _reshaped(["-1"])
        lengths = {n: f"{{1}}[{k}]" for k, n in enumerate(probe.shape) if shape[k] is None}
        return _reshaped([lengths.get(n, str(n)) for n in after])
    if moved.f in _AT and len(args) == 1 and isinstance(args[0], int) and not named and axes == 1:
        return f"moved({{}},{_AT[moved.f].format(args[0])})", 1
    if moved.f is np.take and len(args) == 1 and not named and axes == 1 and np.ndim(args[0]) == 1:
        return _index((np.asarray(args[0]),), axes)
    return None


def counts(moved: Moved) -> bool:
    """Whether elements are picked by numbers, of which there may be too few."""
    if moved.f is not getitem:
        return moved.f is np.take
    keys = moved.args[0] if isinstance(moved.args[0], tuple) else moved.args
    return any(not (k is None or k is Ellipsis or isinstance(k, slice)) for k in keys)


def _reshaped(dims: list[str]) -> tuple[str, int]:
    return f"reshaped({{0}},{{1}},[{','.join(dims)}])", len(dims)


def _index(key: Any, axes: int) -> tuple[str, int] | None:
    keys = list(key) if isinstance(key, tuple) else [key]
    used = sum(k is not None and k is not Ellipsis for k in keys)
    at = next((n for n, k in enumerate(keys) if k is Ellipsis), len(keys))
    keys[at : at + 1] = [slice(None)] * (axes - used)
    several = [k for k in keys if isinstance(k, list | np.ndarray)]
    if several and (len(several) > 1 or any(isinstance(k, int) for k in keys)):
        return None
    texts = [_key(k) for k in keys]
    if None in texts:
        return None
    return f"picked({{}},{{}},[{','.join(map(str, texts))}])", sum(not isinstance(k, int) for k in keys)


def _key(key: Any) -> str | None:
    """A number, a slice, a new axis or positions in one index; None where it is something else."""
    match key:
        case None:
            return "null"
        case bool():
            return None
        case int() | np.integer():
            return str(int(key))
        case slice():
            ends = (key.start, key.stop, key.step)
            if all(end is None or isinstance(end, int | np.integer) for end in ends):
                return f"[{','.join('null' if end is None else str(int(end)) for end in ends)}]"
        case list() | np.ndarray():
            array = np.asarray(key)
            if array.ndim == 1 and array.dtype.kind == "i":
                return f"{{{{these:{array.tolist()}}}}}".replace(" ", "")
    return None


def join(moved: Moved, axes: int) -> tuple[bool, int] | None:
    """Along which axis fields of so many axes are put together, and whether it is a new one; None where it is neither.

    ``moved`` gets one field after the other.
    """
    simple: dict[Callable[..., Any], tuple[bool, int]] = {
        np.vstack: (axes == 1, 0), np.hstack: (False, 0 if axes == 1 else 1), np.column_stack: (axes == 1, 1),
    }  # fmt: skip
    if moved.f in simple and axes and not moved.args and not moved.named:
        return simple[moved.f]
    if moved.f not in (np.stack, np.concatenate) or len(moved.args) > 1 or any(k != "axis" for k, _ in moved.named):
        return None
    axis = moved.args[0] if moved.args else dict(moved.named).get("axis", 0)
    new = moved.f is np.stack
    return (new, axis % (axes + new)) if isinstance(axis, int) else None
