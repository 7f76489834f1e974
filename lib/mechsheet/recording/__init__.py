"""A worksheet recorded: its cells run with quantities, and what is asked of the recording as a whole.

`record` has the cells run, as one `recorded_run` or two: each cell a `stage`, with the names of `substitutes`, over the
`positions` that tables list. A `statement` is looked at before: what Python decides by itself is `rewritten`, so that
all ways are known (`choices`, `loops`, `forms`, elements that are `kept` or set `in_place`). `memory` tells what has
changed, under whatever name. What a worksheet finds is `solving`, an `integral` is a sum over fixed places, a root of
scipy's `guessed` is Newton's, others and tables follow the `scipy_rules`, splines the `spline_rules`. Where a cell ends
in `showing` a drawing, or a table under no name, that is recorded too; `every_line` is, where all are asked for.

In the `evaluation` of a worksheet as a function, what is asked for again is `planned`, `variants` are many at once.
`dimensions` checks units, by the rules of `dimension_rules`; `pinpoint` finds where in the worksheet a part is written;
a number may be `left_over` by rounding alone, and a place be taken `by_size` of none else. Stands on the readers.
"""
