"""Planar mechanisms, joints, roots of functions: numpy arrays in, numpy arrays out.

Knows numpy and nothing else of the package. All functions and records take what they have in common in one order:
bodies, forces and points, outer ones first; directions; lengths, branch, offset; first derivatives, those found before
those given; second derivatives; loads. What is mostly zero comes last and may be left out.
"""
