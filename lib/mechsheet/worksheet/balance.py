"""The check that loads and reactions hold each body in equilibrium."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from mechsheet.mechanics.equilibrium import Reaction, left_over
from mechsheet.mechanics.load import Load
from mechsheet.worksheet.check import Check, check


def balance(
    what: str,
    loads: Sequence[Sequence[Load]],
    reactions: Sequence[Reaction],
    limit: float,
    force: ArrayLike,
    length: ArrayLike,
) -> tuple[Check, Check]:
    """Check that loads and reactions hold each body in equilibrium: what is left of forces [N] and of moments [N m].

    ``loads`` and ``reactions`` are those of `left_over`; ``limit`` is the part of the ``force`` [N], and of it with an
    arm of the ``length`` [m], that may be left; ``what`` names the bodies.
    """
    left = left_over(loads, reactions)
    return (
        check(f"equilibrium of forces, {what}", left.F, limit, "N", of=force),
        check(f"equilibrium of moments, {what}", left.M, limit, "N*m", of=np.multiply(force, length)),
    )
