"""The quantities of a worksheet as a graph of operations, and what is read from it.

`graph` has the nodes and how they are made, `quantity` what computes as numbers do and makes nodes meanwhile,
`numpy_rules` what numpy's functions make of it, and `elementary` what functions of the mechanics do. `record` runs the
cells of a worksheet: with the names of `substitutes`, each cell as a `stage`, into the `lines` of a recording; `memory`
tells what a statement has changed in place, under whatever name.
`dimensions` checks units, by the rules of `dimension_rules`; `pinpoint` finds where in the
worksheet a part is written. Stands on the worksheet room and those below.
"""
