"""What arrays that come and go cost beside their numbers."""

import os
import platform
import subprocess
import sys

import pytest

FAULTS = """
import resource
import numpy as np
from mechsheet.mechanics.rrr import rrr

r = np.linspace(0.4, 0.5, 8000)
for _ in range(10):
    rrr(0.3 + 0.9j, 0.1 + 0.4j, r, 0.3, 1)
before = resource.getrusage(resource.RUSAGE_SELF).ru_minflt
for _ in range(100):
    rrr(0.3 + 0.9j, 0.1 + 0.4j, r, 0.3, 1)
print(resource.getrusage(resource.RUSAGE_SELF).ru_minflt - before)
"""


@pytest.mark.skipif(platform.libc_ver()[0] != "glibc", reason="of glibc's allocator")
def test_steps_of_a_formula_of_many_positions_have_their_memory_at_once():
    """Some thousand pages that the system clears took three quarters of the time of a dyad."""
    told = {name: value for name, value in os.environ.items() if not name.startswith("MALLOC_")}  # dask tells its own
    run = subprocess.run([sys.executable, "-c", FAULTS], capture_output=True, text=True, check=True, env=told)
    assert int(run.stdout) < 100
