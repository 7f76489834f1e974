"""What is read from a graph of quantities: each reader has a rule for an operation, and keeps its results by itself.

`numbers` are its numbers for other inputs, and the reference for all others, a `plan` such numbers as one function.
`slopes` are derivatives of quantities by others, by the rules of `slope_rules`; `gradients` have all of one number in
one pass backwards, `bends` are second ones along directions. `bands` tell how far quantities are off within tolerances,
`jumps` which of them go another way there, `cases` what runs tell of these, `banded` what of a run has bands, and
`enclosed` guarantees bounds by balls. `proof` tells how many digits of a worksheet's numbers are right, by its
quantities in `balls` under the `ball_rules`, and by a `lone_root` of its equations. What is found is `searched` by
cells of a workbook, or `stepped` to by equations `derived` there, of many `problems` for each by itself; a closed form
is `confirmed` by the equations with it `replaced` in them, whose `terms` tell what is nothing. The `largest` of what a
check puts together is found row by row; what stands behind an `infinite` number, cells have not. Stands on the
quantities.
"""
