"""Error against run time: jobs and all methods for them, 50 digits, printed formulas, extreme scenes, timing.

Stands on the mechanics, the worksheet and the bar of a long run; nothing of the product needs it.
"""
