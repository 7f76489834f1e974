"""Run what computes as on a processor without vector extensions: ``python tests/plain_numpy.py [OPTIONS of pytest]``.

numpy and its BLAS pick code by the processor, which rounds differently: a test that passes with all of it and with none
depends on no processor.
"""

import os
import subprocess
import sys

from numpy._core._multiarray_umath import __cpu_dispatch__, __cpu_features__  # what numpy.show_runtime prints

WORDS = (
    "batch", "displayed", "ending", "every_input", "line_edit", "lists", "no_inputs", "texts_in_tables",
    "texts_never_stale", "told_in_a_line", "worksheet",
)  # fmt: skip


def features() -> str:
    """What numpy would choose here beyond the least that it is built for; it warns of others."""
    return " ".join(name for name in __cpu_dispatch__ if __cpu_features__[name])


if __name__ == "__main__":
    disabled = features()
    print(f"disabled: {disabled or 'nothing, this processor has no more than numpy is built for'}", flush=True)
    # Read as numpy starts, in subprocesses as well; the core is the least that the BLAS knows, elsewhere it says so.
    environment = {**os.environ, "NPY_DISABLE_CPU_FEATURES": disabled, "OPENBLAS_CORETYPE": "Prescott"}
    computing = [sys.executable, "-m", "mechsheet", "test", "-m", "numeric and not browser and not office"]
    # What these read was computed by others: words, orders of scenes, numbers of a page, how a process ends.
    computing += [f"--ignore=tests/test_{name}.py" for name in WORDS]
    # It takes a tenth of the time, and its truths are compared in tests of their own.
    computing += ["--deselect=tests/test_accuracy.py::test_what_is_measured_is_shown_and_exported"]
    sys.exit(subprocess.call([*computing, *sys.argv[1:]], env=environment))
