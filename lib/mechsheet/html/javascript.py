"""What the page computes by itself."""

from collections.abc import Mapping

from mechsheet.recording.lines import Recording
from mechsheet.recording.node import Node


def module(recording: Recording, wanted: Mapping[str, Node]) -> str:
    """A script that defines ``evaluate(inputs)``, which gives the ``wanted`` quantities by their keys: as yet none."""
    return "const evaluate = () => ({values: {}, gaps: {}, guards: [], found: {}});"
