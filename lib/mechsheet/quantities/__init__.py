"""The quantities of a worksheet as a graph of operations, and the rules by which they are made.

`node` is one of them, `operations` what they mean in numpy, `graph` how they are made. `quantity` computes as numbers
do and makes nodes meanwhile, by the rules of `arithmetic`; `numpy_rules` are what numpy's functions make of it, and
`elementary` what functions of the mechanics do. `lines` are what a recording of them holds, by the names of its
worksheet. A drawing made of quantities is a `sketch`, a text with numbers in it is `written`. Stands on the worksheet
room and those below.
"""
