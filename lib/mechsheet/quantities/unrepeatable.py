"""What is another number at each run, by the clock or by chance: nothing that a recording could hold."""

import datetime
import random
import sys
import time
from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np

from mechsheet.quantities.graph import NotRecorded, current


class Unrepeatable(NotRecorded):
    """Something that differs from run to run, in words; what rests on it differs too."""


def clock_read() -> None:
    """Raise where a clock is read while a worksheet is recorded."""
    if current.get(None):
        raise Unrepeatable("the clock tells another time at each run")


_NAMES = ("time", "monotonic", "perf_counter", "process_time", "thread_time")
_CLOCKS = {getattr(time, f"{name}{unit}") for name in _NAMES for unit in ("", "_ns")}
_CLOCKS |= {time.localtime, time.gmtime, time.ctime, time.asctime, time.strftime}


def instead_of_chance(value: Any) -> Any:
    """What refuses to read the clock, and to draw numbers without a seed; None in place of anything else."""
    seeded, shared = _generators("numpy.random" in sys.modules)
    try:
        if value in _CLOCKS:
            return lambda *_, **__: clock_read()
        if value in seeded:
            return _with_seed(value)
    except TypeError:  # not hashable: neither a function nor a class
        return None
    if isinstance(value, type) and value in (datetime.date, datetime.datetime):
        return _calendar(value)
    draws = any(getattr(value, "__self__", None) is generator for generator in shared)
    return _draw if (draws and value is not random.seed) or value is random.SystemRandom else None


@cache
def _generators(of_numpy: bool) -> tuple[set[Any], list[Any]]:
    """What takes a seed, and the generators that all of a program draw from.

    Those of numpy, which loads them on use, are none of a worksheet's before they are loaded.
    """
    seeded, drawing = set[Any]([random.Random]), list[Any]([random.random])
    if of_numpy:
        seeded |= {np.random.default_rng, np.random.RandomState, np.random.SeedSequence}
        seeded |= set(np.random.BitGenerator.__subclasses__())
        drawing.append(np.random.rand)
    return seeded, [draw.__self__ for draw in drawing]


def _draw(*_: Any, **__: Any) -> Any:
    raise Unrepeatable("numbers drawn without a seed of their own are others at each run")


@cache
def _with_seed(f: Callable[..., Any]) -> Callable[..., Any]:
    def function(*seed: Any, **named: Any) -> Any:
        return _draw() if all(x is None for x in (*seed, *named.values())) else f(*seed, **named)

    return function


@cache
def _calendar(kind: type) -> type:
    now = staticmethod(lambda *_, **__: clock_read())
    return type(kind.__name__, (kind,), {name: now for name in ("now", "today", "utcnow") if hasattr(kind, name)})
