"""Error against run time: jobs and all methods for them, 50 digits, printed formulas, extreme scenes, timing.

Stands on all rooms but the studies and the page; a worksheet hands it the studies. Nothing of the product needs it.
"""
