"""A part by its name, as a text that inputs choose; and what is recorded by the names that users know."""

import re
from types import FunctionType
from typing import Any

from mechsheet.quantities.graph import current
from mechsheet.quantities.options import Fields, Row, Thing
from mechsheet.quantities.quantity import Listed, Quantity
from mechsheet.quantities.selected import Selected
from mechsheet.quantities.text_column import Texts, among
from mechsheet.quantities.written import Written, text
from mechsheet.recording.choices import element
from mechsheet.recording.each_row import EachRow
from mechsheet.recording.sifted import Sifted
from mechsheet.worksheet.chosen import Chosen

_KNOWN_AS: dict[type, str] = {
    **dict.fromkeys([Quantity, Selected], "recorded number"),
    **dict.fromkeys([Written, Chosen], "recorded text"),
    **dict.fromkeys([Texts, Listed, EachRow, Sifted], "recorded list"),
    **dict.fromkeys([Row, Fields], "recorded row"),
    Thing: "recorded object",
}
_NAMES = {kind.__name__: known for kind, known in _KNOWN_AS.items()}
_NAME = re.compile(rf"\b({'|'.join(_NAMES)})\b")
_ARGUMENT = re.compile(r"^\S+\(\) got an unexpected keyword argument ('\w+')$")  # of what stands for numpy's function
# What Python and numpy say where another array would have to be put for one.
_NOT_SET = "object does not support item assignment", "setting an array element with a sequence."


def in_words(error: BaseException) -> str:
    """What Python says of an error, without the classes of what stands for numbers and texts."""
    if any(isinstance(key, Chosen) for key in error.args):
        return "of an option a table of pandas takes the text, str(..)"
    if isinstance(error, AttributeError) and isinstance(error.obj, FunctionType):
        return f"{error.name} of a function is not followed"
    said = str(error).splitlines()[0] if str(error) else repr(error)
    if said.endswith(_NOT_SET):
        return "an element is set of an array that has no name of its own there"
    return _NAME.sub(lambda match: _NAMES[match[1]], _ARGUMENT.sub(r"its argument \1 is not followed", said))


def attribute(of: Any, name: Any, *otherwise: Any) -> Any:
    """``getattr``, where the name may be one of several texts."""
    name = text(name) if isinstance(name, Chosen) else name
    options = among(current.get(), name) if isinstance(name, Written) else None
    if options is None:
        return getattr(of, str(name) if isinstance(name, Written) else name, *otherwise)
    return element({each: getattr(of, each, *otherwise) for each in options[0] if otherwise or hasattr(of, each)}, name)


CALLS: dict[str, Any] = {"getattr": attribute}
