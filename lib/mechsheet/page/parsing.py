"""Texts are parsed again where Python failed at it, which is no fault of theirs.

Threads that parse at once fail now and then before 3.11.8, and in 3.12 before 3.12.2: they count the depth of their
trees together (issue 106905 of python/cpython). Pages that are served are threads of one process.
"""

import __future__

import ast
import builtins
import sys
from contextlib import suppress
from typing import Any

_TRIES = 100  # one in some thousands fails
_FUTURE = sum({getattr(__future__, name).compiler_flag for name in __future__.all_feature_names})
_compile = builtins.compile


def again() -> None:
    """Let this process parse a text again where it failed; nothing where Python does not."""
    if sys.version_info < (3, 11, 8) or (3, 12) <= sys.version_info < (3, 12, 2):
        builtins.compile = _again


def _again(
    source: Any, filename: Any, mode: str, flags: int = 0, dont_inherit: bool = False, optimize: int = -1, **more: Any
) -> Any:
    if not dont_inherit:  # what the caller has from the future would not be seen from here
        flags |= sys._getframe(1).f_code.co_flags & _FUTURE
    if flags & ast.PyCF_ONLY_AST:
        for _ in range(_TRIES - 1):
            with suppress(SystemError):
                return _compile(source, filename, mode, flags, True, optimize, **more)
    return _compile(source, filename, mode, flags, True, optimize, **more)
