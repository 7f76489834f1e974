"""Each function in elementary steps gives what the library's own gives."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from mechsheet.mechanics import drive, joint, load, planar
from mechsheet.mechanics import rpr as kind_3
from mechsheet.mechanics import rrp as kind_2
from mechsheet.mechanics import rrr as kind_1
from mechsheet.mechanics.load import Load
from mechsheet.recording.elementary import STEPS

COUNT = 40  # random cases
rng = np.random.default_rng(7)


def points() -> Any:
    return rng.uniform(-2, 2, COUNT) + 1j * rng.uniform(-2, 2, COUNT)


def numbers(low: float = 0.3, high: float = 3.0) -> Any:
    return rng.uniform(low, high, COUNT)


def signs() -> Any:
    return rng.choice([-1, 1], COUNT)


def loads() -> list[Load]:
    return [Load(points(), points(), numbers(-1, 1)), Load(points(), points())]


def pins() -> Any:
    """Outer pins 2 to 4 apart, and two lengths that reach each other."""
    A = points()
    return A, A + numbers(2, 4) * np.exp(1j * numbers(-3, 3)), numbers(3, 4), numbers(3, 4)


C = points()
ARGUMENTS: dict[Callable[..., Any], tuple[Any, ...]] = {
    planar.cross: (points(), points()),
    planar.dot: (points(), points()),
    planar.angle: (points(),),
    planar.angle_between: (points(), points()),
    planar.angle_opposite: (numbers(1, 1.9), numbers(1, 1.9), numbers(1, 1.9)),
    planar.link_velocity: (points(), points(), points(), numbers()),
    planar.link_acceleration: (points(), points(), numbers(), points(), numbers()),
    kind_1.rrr: (*pins(), signs()),
    kind_1.rrr_reach: (points(), points(), numbers()),
    kind_1.rrr_velocity: (points(), points(), C, points(), points(), numbers(), numbers()),
    kind_1.rrr_acceleration: (
        *(points(), points(), C, numbers(), numbers(), numbers(), numbers()),
        *(points(), points(), numbers(), numbers()),
    ),
    kind_1.rrr_transmission_angle: (points(), points(), points()),
    kind_1.rrr_condition: (points(), points(), points()),
    kind_2.rrp: (points(), points(), points(), numbers(6, 9), signs(), numbers()),
    kind_2.rrp_reach: (points(), points(), points(), numbers()),
    kind_2.rrp_velocity: (points(), points(), C, points(), points(), points(), numbers(), numbers()),
    kind_2.rrp_acceleration: (
        *(points(), points(), C, points(), numbers(), numbers(), numbers(), numbers()),
        *(points(), points(), numbers(), numbers()),
    ),
    kind_2.rrp_transmission_angle: (points(), points(), points()),
    kind_2.rrp_condition: (points(), points(), points(), points()),
    kind_3.rpr: (points() + 5, points(), signs(), numbers(0.1, 0.5)),
    kind_3.rpr_velocity: (points(), points(), points(), points(), points()),
    kind_3.rpr_acceleration: (points(), points(), points(), numbers(), numbers(), points(), points()),
    kind_3.rpr_transmission_angle: (points(), points(), points()),
    kind_3.rpr_condition: (points(), points(), points()),
    load.inertia: (points(), numbers(), numbers(), points(), numbers()),
    kind_1.rrr_reactions: (points(), points(), points(), loads(), loads()),
    kind_2.rrp_reactions: (points(), points(), points(), loads(), loads()),
    kind_3.rpr_reactions: (points(), points(), points(), loads(), loads()),
    drive.coupling_drive: (points(), loads()),
    drive.gear_drive: (points(), points(), numbers(0, 1), loads()),
    drive.cylinder_drive: (points(), points(), points(), loads()),
    joint.sum_of_elements: (rng.uniform(-1, 1, (COUNT, 6)),),
    joint.bending: (rng.uniform(-1, 1, (COUNT, 6)), rng.uniform(0.1, 1, (COUNT, 6)), numbers(-1, 1), numbers(-1, 1)),
    joint.neutral_axis: (
        *(rng.uniform(-1, 1, (COUNT, 6)), rng.uniform(0.1, 1, (COUNT, 6)), rng.uniform(0.1, 1, (COUNT, 6))),
        *(numbers(-1, 1), numbers(-1, 1)),
    ),
    joint.circular_joint: (
        np.arange(12) * np.pi / 6 + rng.uniform(0, 1, (COUNT, 1)),
        *(numbers(), numbers(-1, 1), numbers(-1, 1)),
    ),
}


def test_every_function_is_tried() -> None:
    assert set(ARGUMENTS) == set(STEPS)


@pytest.mark.parametrize("function", STEPS, ids=lambda f: f.__name__)
def test_the_steps_give_what_the_function_gives(function: Callable[..., Any]) -> None:
    arguments = ARGUMENTS[function]
    own = parts(function(*arguments))
    with np.errstate(all="ignore"):  # what another branch of a formula would give
        steps = parts(STEPS[function](*arguments))
    assert list(own) == list(steps)
    for name, value in own.items():
        size = np.nanmax(np.abs(value), initial=0.0, where=np.isfinite(value)) or 1.0
        np.testing.assert_allclose(steps[name] / size, value / size, rtol=0, atol=1e-9, err_msg=name)


@pytest.mark.parametrize("function", [kind_1.rrr, kind_2.rrp, kind_3.rpr], ids=lambda f: f.__name__)
def test_what_does_not_close_is_no_number(function: Callable[..., Any]) -> None:
    arguments: dict[Any, tuple[Any, ...]] = {
        kind_1.rrr: (0j, 5 + 0j, 1.0, 2.0, 1),
        kind_2.rrp: (0 + 3j, 0j, 1 + 0j, 2.0, 1),
        kind_3.rpr: (1 + 0j, 0j, 1, 2.0),
    }
    with np.errstate(invalid="ignore"):
        assert all(np.isnan(value).all() for value in parts(STEPS[function](*arguments[function])).values())


def parts(result: Any) -> dict[str, Any]:
    """Numbers of a result by name; words such as a state are left out."""
    if hasattr(result, "_asdict"):
        result = result._asdict()
    elif isinstance(result, Load):
        result = vars(result)
    elif isinstance(result, tuple):
        result = dict(enumerate(result))
    else:
        result = {"": result}
    arrays = {name: np.asarray(value) for name, value in result.items()}
    return {name: value for name, value in arrays.items() if value.dtype.kind in "fc"}
