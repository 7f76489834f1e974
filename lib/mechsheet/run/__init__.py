"""A worksheet as a script or as scenes: arguments, report, files, exit code. Stands on the writers."""
