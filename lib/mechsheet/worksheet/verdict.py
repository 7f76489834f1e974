"""What a solve block tells, of one unknown or of several: a value, or why there is none."""

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechsheet.worksheet.errors import SheetError, Waits, refuse
from mechsheet.worksheet.shown import Shown

_values_only: ContextVar[bool] = ContextVar("values_only", default=False)
_told: ContextVar["list[Verdict | NDArray[np.object_]] | None"] = ContextVar("told", default=None)


@contextmanager
def values_only() -> Iterator[None]:
    """Within it `find` computes values alone; what else a verdict tells is computed when it is read."""
    token = _values_only.set(True)
    try:
        yield
    finally:
        _values_only.reset(token)


def asks_values_only() -> bool:
    return _values_only.get()


@contextmanager
def listen() -> Iterator["list[Verdict | NDArray[np.object_]]"]:
    """List to which what is computed within adds solve blocks whose values are read and some of which are none.

    And for each variant, in a row of its own, why a group does not close; "" where it does.
    """
    told = list[Verdict | NDArray[np.object_]]()
    token = _told.set(told)
    try:
        yield told
    finally:
        _told.reset(token)


def is_heard() -> bool:
    """Whether anybody listens to reasons."""
    return _told.get() is not None


def tell(lacking: "Verdict | NDArray[np.object_]") -> None:
    """Add a verdict or reasons to the list of who listens."""
    if (told := _told.get()) is not None:
        told.append(lacking)


def lacking(values: Iterable[Any]) -> "list[Verdict]":
    """The solve blocks with a problem that has no value, among ``values`` and those that nobody has kept by a name."""
    verdicts = dict.fromkeys(x for x in (*values, *(_told.get() or [])) if isinstance(x, Verdict))
    return [verdict for verdict in verdicts if verdict.failures()]


class Verdict(Shown):
    """The verdict of a solve block: what it found, how well, and where it found nothing, why."""

    @property
    def solved(self) -> Any:
        """Where the equations hold."""
        raise NotImplementedError

    @property
    def valued(self) -> Any:
        """Where there is a value: where the equations hold, or their squares are least if that is what was asked."""
        return self.solved

    @property
    def waits(self) -> Any:
        """Where there was nothing to solve, because a number that it was given is NaN itself."""
        raise NotImplementedError

    @property
    def reason(self) -> Any:
        """Why there is no value; "" where there is one."""
        raise NotImplementedError

    def give(self) -> None:
        """Stop where a value is read that is none; of an array tell which are none, and why."""
        if np.ndim(self.valued):
            if is_heard() and not np.all(self.valued):
                tell(self)
        elif not self.valued:
            refuse((Waits if self.waits else SheetError)(self.reason), self)

    @property
    def names(self) -> tuple[str, ...]:
        """Names of unknowns that stand in headline and details."""
        raise NotImplementedError

    def headline(self) -> str:
        """The unknowns and their values, or how many problems are solved."""
        raise NotImplementedError

    def details(self) -> list[tuple[str, str]]:
        """How the value was found: what is said of it, and in words and numbers what it is."""
        raise NotImplementedError

    def word(self) -> str:
        """The verdict in a word or two."""
        return "not evaluated" if np.all(self.waits) else "not found" if self.failures() else "found"

    def failures(self) -> list[str]:
        """Why there is no value, of the first problems without one."""
        reasons = np.atleast_1d(np.asarray(self.reason, dtype=object))
        failed = np.argwhere(reasons != "").tolist()
        where = [f"problem {', '.join(str(k + 1) for k in i)}: " if np.ndim(self.reason) else "" for i in failed]
        texts = [w + reasons[tuple(i)] for w, i in zip(where[:3], failed[:3], strict=True)]
        return texts + [f"and {len(failed) - 3} more"] * (len(failed) > 3)

    def __str__(self) -> str:
        if isinstance(self.reason, str) and self.reason:
            return self.reason
        told = f"{self.headline()}: " + ", ".join(f"{k} {v}" for k, v in self.details())
        return "; ".join([told, *self.failures()])
