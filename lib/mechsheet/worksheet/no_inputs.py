"""The inputs of a worksheet that asks for none, in whose cells ``g`` may be any name, such as that of gravity."""

import ast
from collections.abc import Iterable, Mapping
from typing import Any, ClassVar

from mechsheet.worksheet.kinds import Input


class NoInputs:
    """Inputs among which there is none; all of them are equal."""

    __inputs__: ClassVar[tuple[Input, ...]] = ()
    __units__: ClassVar[dict[str, str]] = {}

    def __eq__(self, other: object) -> bool:
        return isinstance(other, NoInputs)

    def __hash__(self) -> int:
        return hash(NoInputs)


def declared_in(namespace: Mapping[str, Any]) -> type | None:
    """The class of inputs among the values of a namespace; none where there is none."""
    found = (value for value in namespace.values() if isinstance(value, type) and hasattr(value, "__inputs__"))
    return next(found, None)


def inputs_of(namespace: Mapping[str, Any]) -> Any:
    """The inputs of a run, from its namespace."""
    g = namespace.get("g")
    return g if hasattr(type(g), "__inputs__") else NoInputs()


def beforehand(g: Any) -> dict[str, Any]:
    """What a run with these inputs knows before its cells: nothing where they are none, for its own g is computed."""
    return {} if isinstance(g, NoInputs) else {"g": g}


def in_a_cell(lines: Iterable[ast.stmt]) -> str:
    """Name of a class of inputs among the lines of a cell, where nobody else finds it; "" where there is none."""
    for line in lines:
        match line:
            case ast.ClassDef(name, decorator_list=[ast.Name("inputs") | ast.Attribute(attr="inputs")], body=body):
                if any(isinstance(each, ast.AnnAssign) and each.value for each in body):
                    return name
    return ""
