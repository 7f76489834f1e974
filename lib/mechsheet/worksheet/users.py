"""Which modules are of the user's own."""

from functools import cache
from sys import modules


@cache
def _installed() -> tuple[str, ...]:
    """Folders of modules that are no user's own."""
    import sysconfig  # on use: only a proof or a sweep asks

    return tuple({sysconfig.get_path(name) for name in ("stdlib", "platstdlib", "purelib", "platlib")})


@cache
def is_users(module: str) -> bool:
    """Whether a module is no installed one, none of the library's and no worksheet."""
    held = vars(modules[module]) if module in modules else {}
    file = str(held.get("__file__") or "")
    is_worksheet = type(held.get("app")).__name__ == "App"
    others = is_worksheet or module.startswith(("mechsheet.", "__main__")) or file.startswith(_installed())
    return bool(file) and not others
