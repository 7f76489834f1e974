"""The one error that a worksheet raises to its reader."""


class SheetError(ValueError):
    """Input or a result that cannot be used; the message is one line for the person at the worksheet."""
