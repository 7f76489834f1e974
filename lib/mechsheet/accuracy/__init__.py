"""Error against run time: arithmetic of 50 digits, extreme scenes, the printed formulas, timing.

Stands on the worksheet and the mechanics; nothing of the product needs it.
"""
