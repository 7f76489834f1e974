"""Planar mechanisms and joints: numpy arrays in, numpy arrays out. Knows numpy and nothing else of the package."""
