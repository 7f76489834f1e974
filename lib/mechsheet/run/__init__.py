"""A worksheet as a script or as scenes: arguments, report, files, exit code; two states compared, a symbol renamed.

Stands on the writers.
"""
