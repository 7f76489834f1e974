"""Whether lines of a worksheet mix the variants of a sweep, told by arrays that know what they are made of.

That some variants have the same with each other as alone may not be so of others: whether any position of any of them
is above a limit is true of all where it is true of one. So arrays of many variants are followed by the axis of these:
what is made of one without it holds for none of them, and neither does what is made of that. Nor is what a line makes
of Python's numbers always what it makes of arrays: it may handle an error that is of one alone, or count what holds.
"""

import ast
import builtins
import statistics
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from math import prod
from pathlib import Path
from types import FunctionType, ModuleType
from typing import Any

import numpy as np

from mechsheet.worksheet import inputs
from mechsheet.worksheet.cells import Worksheet, base
from mechsheet.worksheet.find import find
from mechsheet.worksheet.system import minerr
from mechsheet.worksheet.users import is_users
from mechsheet.worksheet.verdict import values_only

COUNT = 43  # variants: hardly a field has as many positions, or a list as many rows
_NUMPY = Path(np.__file__).parent
_PASSED = str(_NUMPY), str(_NUMPY.with_name("scipy")), statistics.__file__, __file__
_FILLED = np.zeros, np.ones, np.full, np.empty  # which give arrays into which others are put
_MADE = np.array, np.asarray, np.ascontiguousarray, np.fromiter, *_FILLED  # which give arrays of no other class
_OF_SHAPES = np.ndim, np.size, np.shape
_PYTHONS = {f.__name__: f for f in (max, min, sum, round, float, int)}  # which look at numbers, and give one
_shape: Callable[[Any], tuple[int, ...]] = vars(np.ndarray)["shape"].__get__


class _Looked(BaseException):
    """Python looks at what is made of all variants at once; no code of a worksheet handles it."""


def mixes(sheet: Worksheet, want: Sequence[str], columns: Mapping[str, Any]) -> bool:
    """Whether a wanted result of so many variants is made of all of them at once."""
    cells = sheet.needed(map(base, want), ["g"])
    lines = (*_shared(sheet), *(line for cell in cells for line in cell.lines))
    if any(_handles(part) for line in lines for part in ast.walk(line)):
        return True
    marked = {name: _several(x, sheet.path) for name, x in columns.items()}
    common = {name: _asking(held, sheet.path) for name, held in {**_PYTHONS, **sheet.common}.items()}
    imported = {"__import__": lambda *of: _asking(__import__(*of), sheet.path)}  # by a cell itself
    common["__builtins__"] = {**vars(builtins), **imported}
    names = [*map(base, want)]
    try:
        g: Any = inputs.instance(sheet.inputs, marked)
        with values_only(), np.errstate(all="ignore"):
            found = replace(sheet, common=common).run(names, {"g": g})
    except _Looked:
        return True
    except Exception:  # of these arrays alone, which tell nothing then, or of others too, which are compared elsewhere
        return _runs(sheet, names, columns)
    mixed = any(_is_mixed(found.get(name)) for name in names)
    found.clear()  # its functions know it, so that its arrays would stay
    return mixed


def _shared(sheet: Worksheet) -> Iterator[ast.stmt]:
    """What cells may call: of the setup, and of the modules of the user's own that lie beside the worksheet."""
    folder, bodies = Path(sheet.path).resolve().parent, [sheet.whole]
    for name in filter(is_users, [*sys.modules]):
        file = Path(str(sys.modules[name].__file__))
        if file.suffix == ".py" and file.is_relative_to(folder):
            bodies.append(tuple(ast.parse(file.read_bytes()).body))
    kinds = ast.FunctionDef | ast.ClassDef | ast.ImportFrom
    yield from (line for body in bodies for line in body if isinstance(line, kinds))


def _handles(part: ast.AST) -> bool:
    """Whether lines go on after an error, which one variant has alone, as of a division by zero."""
    match part:
        case ast.Try(handlers=[_, *_]) | ast.TryStar() | ast.alias("suppress") | ast.Attribute(attr="suppress"):
            return True
    return False


def _runs(sheet: Worksheet, names: Sequence[str], columns: Mapping[str, Any]) -> bool:
    """Whether variants have no error together."""
    try:
        with values_only(), np.errstate(all="ignore"):
            sheet.run(names, {"g": inputs.instance(sheet.inputs, columns)})
    except Exception:
        return False
    return True


class Several(np.ndarray):
    """An array of the worksheet at ``path``: of many variants, or of none, or ``mixed`` of all of them."""

    path: str
    mixed: bool

    def __array_finalize__(self, like: Any) -> None:
        self.path, self.mixed = getattr(like, "path", ""), getattr(like, "mixed", False)
        if isinstance(like, Several) and COUNT in _shape(like) and COUNT not in _shape(self):
            self.mixed = True  # moved by a method of numpy's own

    def __array_ufunc__(self, ufunc: np.ufunc, method: str, *operands: Any, **how: Any) -> Any:
        if ufunc is np.add and all(_is_truth(x) for x in operands):
            self._looked()
        made = getattr(ufunc, method)(*_plain(operands), **_plain(how))
        return self._kept(made, operands, how)

    def __array_function__(self, function: Any, _: Any, operands: Any, how: Any) -> Any:
        if function in _OF_SHAPES and not how and len(operands) == 1 and isinstance(operands[0], Several):
            return getattr(operands[0], function.__name__)
        made = function(*_plain(operands), **_plain(how))
        return made if function in _OF_SHAPES else self._kept(made, operands, how)

    @property  # type: ignore[misc]  # nobody sets it
    def shape(self) -> Any:
        """What is some of all variants, as those above a limit, is as long as these make it."""
        return _shape(self._looked() if self.mixed else self)

    @property
    def size(self) -> int:
        return prod(_shape(self._looked() if self.mixed or COUNT in _shape(self) else self))

    @property
    def flat(self) -> Any:
        return self.reshape(-1)

    def __setitem__(self, key: Any, values: Any) -> None:
        self.view(np.ndarray)[_plain(key)] = _plain(values)
        self.mixed = self.mixed or _is_mixed([key, values])

    def __getitem__(self, key: Any) -> Any:
        return self._kept(self.view(np.ndarray)[_plain(key)], key)

    def __iter__(self) -> Iterator[Any]:
        return (self[i] for i in range(self.shape[0]))

    def __complex__(self) -> complex:
        return complex(self._looked())

    def __bool__(self) -> bool:
        return bool(self._looked())

    def __float__(self) -> float:
        return float(self._looked())

    def __int__(self) -> int:
        return int(self._looked())

    def __index__(self) -> int:
        return int(self._looked().__index__())

    def __len__(self) -> int:
        return len(self._looked() if self.mixed or COUNT in _shape(self)[:1] else self.view(np.ndarray))

    def _looked(self) -> Any:
        """The numbers, at which a line of the worksheet looks, or a function of the library."""
        frame: Any = sys._getframe(2)
        while frame and frame.f_code.co_filename.startswith(_PASSED):
            frame = frame.f_back
        if frame and frame.f_code.co_filename == self.path and (self.mixed or COUNT in _shape(self)):
            raise _Looked
        return self.view(np.ndarray)

    def _kept(self, made: Any, *of: Any) -> Any:
        """What is made of variants, still theirs or mixed of them."""
        if type(made) in (tuple, list):
            return type(made)(self._kept(each, *of) for each in made)
        if not isinstance(made, np.ndarray | np.generic | int | float):
            return made
        marked: Several = np.asarray(made).view(Several)
        lost = COUNT not in _shape(marked) and _is_any([self, *of], lambda x: COUNT in _shape(x))
        marked.path, marked.mixed = self.path, lost or _is_mixed([self, *of])
        return marked


def _by_numpy(name: str) -> Any:
    def method(self: Several, *operands: Any, **how: Any) -> Any:
        return self._kept(getattr(self.view(np.ndarray), name)(*_plain(operands), **_plain(how)), operands, how)

    return method


for _name in ("argmax", "argmin", "astype", "cumsum", "cumprod", "dot", "item", "nonzero", "take", "tolist", "trace"):
    setattr(Several, _name, _by_numpy(_name))


class _Module(ModuleType):
    """Numpy or this library, with functions that keep the marks of what they put together."""

    def __init__(self, module: ModuleType, path: str) -> None:
        super().__init__(module.__name__)
        self._module, self._path = module, path

    def __getattr__(self, name: str) -> Any:
        return _asking(getattr(self._module, name), self._path)


def _asking(held: Any, path: str) -> Any:
    """What a worksheet shares, such that it keeps the marks."""
    if type(held) is ModuleType and held.__name__ in ("numpy", "mechsheet"):
        return _Module(held, path)
    if any(held is each for each in _MADE):
        filled = any(held is each for each in _FILLED)
        return lambda *of, **how: _several(held(*_plain(of), **_plain(how)), path, [*of, how], filled)
    if held is find or held is minerr:
        return lambda *of, **how: held(*map(_unmixed, of), **{name: _unmixed(x) for name, x in how.items()})
    if any(held is each for each in (*_PYTHONS.values(), np.float64)):

        def of_mixed(*of: Any, **how: Any) -> Any:
            if not _is_mixed(of):
                return held(*of, **how)
            single = (x[()] if isinstance(x, np.ndarray) else x for x in _plain(of))
            return _several(np.asarray(held(*single, **how)), path, of)

        of_mixed.held = held  # type: ignore[attr-defined]  # which may be the kind of an array
        return of_mixed
    return held


def _unmixed(given: Any) -> Any:
    """What a Find is given, or a function of it gives, which is not mixed; it tries some of all variants."""
    if isinstance(given, FunctionType):
        return lambda *of, **how: _unmixed(given(*of, **how))
    if _is_mixed(given):
        raise _Looked
    return _plain(given)


def _several(values: Any, path: str, of: Any = None, filled: bool = False) -> Any:
    """An array that is followed, made ``of`` others; those that keep still are not, as their lines take longer."""
    mixed = _is_mixed(of)
    if not isinstance(values, np.ndarray) or not (mixed or filled or COUNT in values.shape):
        return values
    marked = values.view(Several)
    marked.path, marked.mixed = path, mixed
    return marked


def _plain(x: Any) -> Any:
    if isinstance(x, Several):
        return x.view(np.ndarray)
    if type(x) in (tuple, list):
        return type(x)(map(_plain, x))
    if type(x) is FunctionType:
        return getattr(x, "held", x)
    return {name: _plain(each) for name, each in x.items()} if type(x) is dict else x


def _is_truth(x: Any) -> bool:
    """Whether something holds, as a number: two of them are 2 to Python, and true to numpy."""
    return isinstance(x, bool) or (isinstance(x, Several) and x.dtype == bool and _shape(x)[1:] == (1,))


def _is_mixed(x: Any) -> bool:
    return _is_any(x, lambda several: several.mixed)


def _is_any(x: Any, what: Callable[[Several], bool]) -> bool:
    if type(x) in (tuple, list, dict):
        return any(_is_any(each, what) for each in (x.values() if type(x) is dict else x))
    return isinstance(x, Several) and what(x)
