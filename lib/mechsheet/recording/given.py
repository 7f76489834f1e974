"""The inputs of a worksheet as quantities of a recording."""

from typing import Any

from mechsheet.quantities.graph import Graph
from mechsheet.quantities.node import Node
from mechsheet.quantities.quantity import Quantity
from mechsheet.worksheet.inputs import declared
from mechsheet.worksheet.kinds import Choice, TextLine
from mechsheet.worksheet.lists import Rows


def given(graph: Graph, g: Any) -> tuple[Any, dict[str, Node]]:
    """Inputs whose numbers are leaves of the graph, and these by name.

    A choice is the number of its option, whose properties are looked up by it. A text is none: whoever reads it notes
    a guard.
    """
    cls, known, texts, values = type(g), dict[str, Node](), dict[str, Any](), dict[str, Any]()
    for field in declared(cls):
        value = getattr(g, field.name)
        leaves = {name: graph.leaf("input", name, number) for name, (_, number) in field.leaves(value).items()}
        known |= leaves
        match field:
            case TextLine():
                texts[field.name] = _read(graph, leaves[field.name], value)
                continue
            case Rows():
                graph.columns([*leaves.values()])
            case Choice():
                own = leaves[field.name]
                leaves = {name: node if node is own else graph.at(node, own) for name, node in leaves.items()}
        values[field.name] = field.held({name: Quantity(graph, node) for name, node in leaves.items()})
    recorded: Any = object.__new__(type(cls.__name__, (cls,), texts) if texts else cls)
    for name, value in values.items():
        object.__setattr__(recorded, name, value)
    return recorded, known


def _read(graph: Graph, node: Node, text: str) -> property:
    def read(_: Any) -> str:
        graph.see(graph.same(node))
        return text

    return property(read)
