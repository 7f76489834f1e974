"""Runs that say nothing: the worksheet's own run has told what its lines print and warn of."""

import warnings
from collections.abc import Iterator
from contextlib import contextmanager, redirect_stdout
from io import StringIO


@contextmanager
def silently() -> Iterator[None]:
    """What lines print, and warn of, is not shown."""
    with warnings.catch_warnings(), redirect_stdout(StringIO()):
        warnings.simplefilter("ignore")
        yield
