"""The inputs of a worksheet as quantities of a recording."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from mechsheet.quantities.graph import Graph
from mechsheet.quantities.node import Node
from mechsheet.quantities.quantity import Quantity, lift
from mechsheet.quantities.text_column import Texts
from mechsheet.quantities.written import OneOf, Written
from mechsheet.worksheet.inputs import declared
from mechsheet.worksheet.kinds import Choice
from mechsheet.worksheet.lists import Rows
from mechsheet.worksheet.text_line import TextLine


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
        labels = dict[str, Any]()
        match field:
            case TextLine():
                texts[field.name] = _read(graph, leaves[field.name], value)
                continue
            case Rows():
                graph.columns([*leaves.values()])
                graph.counted.update(leaves[column.name] for column in field.columns if column.counted)
                labels = _texts(graph, field, value, leaves)
            case Choice():
                own = leaves[field.name]
                leaves = {name: node if node is own else graph.at(node, own) for name, node in leaves.items()}
                columns = ((each, column) for each, column in field.columns() if each.is_text)
                at = Quantity(graph, own)
                labels = {f"{field.name}.{each.name}": Written((OneOf(at, column),)) for each, column in columns}
        values[field.name] = field.held({name: Quantity(graph, node) for name, node in leaves.items()} | labels)
    recorded: Any = object.__new__(type(cls.__name__, (cls,), texts) if texts else cls)
    for name, value in values.items():
        object.__setattr__(recorded, name, value)
    return recorded, known


def _texts(graph: Graph, table: Rows, value: Any, leaves: Mapping[str, Node]) -> dict[str, Texts]:
    """The columns of texts of a table, by name."""
    found = dict[str, Texts]()
    for name, (column, texts) in table.held_by(value).items():
        if column.is_text:
            held = Quantity(graph, leaves[name])
            count = held.count(0)
            rows = Quantity(graph, graph.rows(count.re)) if isinstance(count, Quantity) else np.arange(count)
            found[name] = Texts(name, held, tuple(texts), lift(graph, rows))
    return found


def _read(graph: Graph, node: Node, text: str) -> property:
    def read(_: Any) -> str:
        graph.read(node)
        return text

    return property(read)
