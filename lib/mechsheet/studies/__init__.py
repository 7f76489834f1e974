"""Many runs of one worksheet: sweeps, sensitivity, tolerances, design and its command.

Stands on the run room and those below.
"""
