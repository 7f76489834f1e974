"""The quantities of a worksheet as a graph of operations, and what is read from it. Stands on the worksheet room."""
