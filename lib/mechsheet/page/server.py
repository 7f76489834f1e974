"""What is set right in a process of marimo before it serves the first page: an entry point of the package."""

import gc
import os
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager

from mechsheet.page import failure, notebook, parsing


@asynccontextmanager
async def lifespan(server: object) -> AsyncIterator[None]:
    """What marimo enters before it serves the first page."""
    parsing.again()
    failure.tell()
    notebook.send_as_it_is(server)
    if "MECHSHEET_EDIT" in os.environ:
        notebook.run_what_is_written(server)
    gc.freeze()  # what is loaded stays: it need not be searched for waste after every few inputs
    yield
