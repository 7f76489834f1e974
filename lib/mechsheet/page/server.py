"""What is set right in a process of marimo before it serves the first page: an entry point of the package."""

import os
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager

from mechsheet.page import failure, notebook, parsing


@asynccontextmanager
async def lifespan(server: object) -> AsyncIterator[None]:
    """What marimo enters before it serves the first page."""
    parsing.again()
    failure.tell()
    if "MECHSHEET_EDIT" in os.environ:
        notebook.run_what_is_written(server)
    yield
