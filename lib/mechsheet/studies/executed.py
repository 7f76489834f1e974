"""Chunks of a sweep computed in this process or on executors, of which some may break."""

import warnings
from collections import deque
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Executor, Future, wait
from contextlib import nullcontext
from typing import Any

import numpy as np
from numpy.typing import NDArray

_AHEAD = 256  # chunks handed to an executor and not yet taken back: bounds the memory of results that wait
_BREAKS = 3  # times that an executor may break in a row without one chunk done


def computed(
    work: Callable[[Mapping[str, Any]], Any],
    at: Callable[[NDArray[np.intp]], Mapping[str, Any]],
    chunks: Sequence[NDArray[np.intp]],
    executor: Executor | Callable[[], Executor] | None,
) -> Iterator[tuple[int, Any]]:
    """Number and result of each chunk of rows, in the order in which they are done; ``at`` gives its inputs."""
    left = deque(range(len(chunks)))
    breaks = 0
    while left and executor is not None:
        with executor() if callable(executor) else nullcontext(executor) as pool:
            running: dict[Future[Any], int] = {}
            try:
                while left or running:
                    while left and len(running) < _AHEAD:
                        future = pool.submit(work, at(chunks[left[0]]))
                        running[future] = left.popleft()
                    for future in wait(running, return_when=FIRST_COMPLETED).done:
                        result = future.result()
                        yield running.pop(future), result
                        breaks = 0
            except BrokenExecutor as error:
                left.extendleft(running.values())
                breaks += 1
                if breaks == _BREAKS:
                    raise RuntimeError(f"the executor broke {breaks} times without one chunk done: {error}") from error
                if not callable(executor):
                    warnings.warn(f"the executor broke, {len(left)} chunks are computed here", RuntimeWarning, 3)
                    executor = None
            finally:
                for future in running:
                    future.cancel()
    for i in left:
        yield i, work(at(chunks[i]))
