"""Memory of arrays that come and go: kept by the process, not given back after each step of a formula."""

import numpy as np

_MOST = 2**25 - 2**16  # bytes: what glibc goes by is less than 32 MB with what it notes of a block


def keep_freed() -> None:
    """Have glibc keep what is freed, up to twice the largest block that was taken from the system and given back.

    By default that is 256 kB: a formula of ten thousand positions gets and gives back each of its steps, page by page,
    which takes several times as long as the steps themselves. Other allocators take no notice.
    """
    np.empty(_MOST, np.uint8)
