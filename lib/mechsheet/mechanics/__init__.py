"""Planar mechanisms, joints, roots of functions: numpy arrays in, numpy arrays out.

Knows numpy and nothing else of the package.
"""
