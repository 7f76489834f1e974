"""A worksheet recorded: its statements run one by one with quantities that remember what is done with them."""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np

from mechsheet.quantities.graph import Graph, current
from mechsheet.quantities.lines import Recording
from mechsheet.recording.every_line import add_lines
from mechsheet.recording.exactly import Unmoved
from mechsheet.recording.own_values import shown
from mechsheet.recording.positions import lacking, rows_of, step_of
from mechsheet.recording.recorded_run import Run
from mechsheet.worksheet.cells import Worksheet, load
from mechsheet.worksheet.check import stating
from mechsheet.worksheet.lines import Formula, registry


def record(
    namespace: Mapping[str, Any],
    sheet: Worksheet | None = None,
    whole: bool = False,
    known: Mapping[str, Formula] | None = None,
    every: int = 0,
    draws: bool = False,
    lists: bool = False,
    bodies: bool = False,
    want: Sequence[str] = (),
    exact: bool = False,
) -> Recording:
    """Run the cells behind the tables, found values and checks of ``namespace`` with recorded quantities.

    ``sheet`` has the cells where they are not those of the file, and ``known`` the lines that declare a unit where the
    namespace does not tell; with ``whole`` all cells are run, with ``want`` those behind these names. What a recording
    does not hold keeps the numbers of the worksheet's own run, as nodes ``exported`` that know what they rest on;
    `Recording.gaps` says where and why. Where all tables list every so many positions, or ``every`` so many are asked
    for, only those are recorded, and all of them only for numbers that rest on all, such as an integral, and for checks
    that take little more for it; the others are `Residual.where`. Where it ``draws``, sliders are inputs too, named
    ``slider part``, and the drawings that cells show are recorded. With ``lists`` those among the inputs may have any
    length, with ``bodies`` the functions of the mechanics are in all their steps. Where it is ``exact``, numbers that
    are computed of numbers alone are operations too.
    """
    return _run(namespace, sheet, whole, known, every, draws, lists, bodies, want, exact).recording


@np.errstate(all="ignore")  # the worksheet's own run has warned
@stating()  # and has stated its checks
def record_every_line(namespace: Mapping[str, Any], sheet: Worksheet, exact: bool = False) -> Recording:
    """The recording of what is shown, and of the lines on which nothing of that rests too."""
    run = _run(namespace, sheet, exact=exact)
    with continued(run.recording):
        add_lines(run)
    return run.recording


@contextmanager
def continued(recording: Recording) -> Iterator[None]:
    """What is computed within of recorded quantities, and of the modules of their worksheet, is recorded too."""
    token = current.set(recording.graph)
    try:
        yield
    finally:
        current.reset(token)


@np.errstate(all="ignore")  # as above
@stating()
def _run(
    namespace: Mapping[str, Any],
    sheet: Worksheet | None,
    whole: bool = False,
    known: Mapping[str, Formula] | None = None,
    every: int = 0,
    draws: bool = False,
    lists: bool = False,
    bodies: bool = False,
    want: Sequence[str] = (),
    exact: bool = False,
) -> Run:
    sheet = load(Path(namespace["__file__"])) if sheet is None else sheet
    asked = want or [name for name in sheet.results if whole or shown(namespace.get(name))]
    token, runs = current.set(Graph()), list[Run]()
    try:
        for thin in dict.fromkeys((every or step_of(namespace), 1)):
            graph = Graph(thin, draws, lists, bodies)
            graph.listed, graph.unmoved = rows_of(namespace), Unmoved() if exact else None
            current.set(graph)
            lines = registry(namespace) if known is None else known
            runs.append(Run(sheet, graph, namespace, asked, lines, unnamed=not (want or bodies)))
            if not any(lacking(runs[0], namespace)):  # else all positions may tell more
                break
        return min(runs, key=lambda run: lacking(run, namespace))
    finally:
        current.reset(token)
