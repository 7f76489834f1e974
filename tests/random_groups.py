"""Random groups of two links, the same in every run: ordinary ones, stiff ones, and some far from the origin."""

from typing import Any

import numpy as np

SIZE = 100
FAMILIES = ["ordinary", "links spread over 1e12", "near a dead centre", "1e6 links from the origin"]


def triangles(family: str) -> tuple[np.random.Generator, Any, Any, Any]:
    """A random generator and the pins A, B, C of random groups, with the angle mu between CA and CB."""
    rng = np.random.default_rng(FAMILIES.index(family))
    decades = 6.0 if "spread" in family else 0.5
    r_A, r_B = 10 ** rng.uniform(-decades, decades, (2, SIZE))
    mu = rng.uniform(0.2, np.pi - 0.2, SIZE) * rng.choice([-1, 1], SIZE)
    if "dead" in family:
        mu = rng.choice([0, np.pi], SIZE) + 10 ** rng.uniform(-9, -1, SIZE)
    C = vectors(rng) + (1e6 if "origin" in family else 0)
    direction = np.exp(1j * rng.uniform(0, 7, SIZE))
    return rng, C + r_A * direction, C + r_B * direction * np.exp(1j * mu), C


def vectors(rng: np.random.Generator, *shape: int) -> Any:
    return rng.normal(size=(*shape, SIZE)) + 1j * rng.normal(size=(*shape, SIZE))


def numbers(rng: np.random.Generator, *shape: int) -> Any:
    return rng.normal(size=(*shape, SIZE))
