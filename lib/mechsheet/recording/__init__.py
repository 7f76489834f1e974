"""The quantities of a worksheet as a graph of operations, and what is read from it.

`node` is one of them, `operations` what they mean in numpy, `graph` how they are made. `quantity` computes as numbers
do and makes nodes meanwhile, by the rules of `arithmetic`; `numpy_rules` are what numpy's functions make of it, and
`elementary` what functions of the mechanics do. `record` has the cells of a worksheet run, each a `recorded_run`: with
the names of `substitutes`, each cell as a `stage`, into the `lines` of a recording, over the `positions` that tables
list; `memory` tells what a statement has changed in place, under whatever name. A drawing is recorded as a `sketch`,
where a cell ends in `showing` it, and a text with numbers in it as it is `written`.

`numbers` reads a recording for other inputs; in the `evaluation` of a worksheet as a function, what is asked for again
is `planned`, a `plan` being such numbers as one function, `variants` many at once. `dimensions` checks units, by the
rules of `dimension_rules`; `pinpoint` finds where in the worksheet a part is written; `slopes` are derivatives of
quantities by others, by the rules of `slope_rules`; `gradients` have all of one number in one pass backwards, `bends`
are second ones along directions. `bands` tell how far quantities are off within tolerances, `banded` what of a run has
them, and `enclosed` guarantees bounds by balls. `proof` tells how many digits of a worksheet's numbers are right, by
its quantities in `balls` under the `ball_rules`, and by a `lone_root` of its equations. What is found is `searched` by
cells of a workbook, or `stepped` to by equations `derived` there, of many `problems` for each by itself; a closed form
is `confirmed` by the equations with it `replaced` in them, whose `terms` tell what is nothing. The `largest` of what a
check puts together is found row by row. Stands on the worksheet room and those below.
"""
