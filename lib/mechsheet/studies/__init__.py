"""Many runs of one worksheet: sweeps, sensitivity, tolerances, design. Stands on the run room and those below."""
