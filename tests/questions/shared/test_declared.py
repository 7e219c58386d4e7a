"""Answers declared once: document, units and schema follow from the annotations."""

from collections.abc import Mapping, Sequence
from types import SimpleNamespace
from typing import Annotated, Any, NamedTuple, TypeVar

import numpy as np
import pytest
from numpy.typing import NDArray
from pydantic import ValidationError
from typing_extensions import TypeAliasType

from ballscrew.basis.quantities import Force, Info, Length, Quantity, Torque, Unit
from ballscrew.questions.shared import declared, schemas
from ballscrew.questions.shared.declared import FINITE, LEFT_OUT, Column, Declared, part


class Point(NamedTuple):
    #: Name of the point. More of it.
    name: str
    place: Length


class Path(Declared):
    """A path."""

    def __init__(self, ends=None, motor=None):
        self._ends, self._motor = ends, motor

    @part
    def torque(self) -> Annotated[Torque, Info("M", "torque along the path", "N mm")]:
        """Not read: the meaning is that of the annotation."""
        return np.float64(1.5)

    @part
    def loads(self) -> Mapping[str, Force]:
        """Load of each half. More of it."""
        return {"left": 1.0, "right": np.float64(2.0)}

    @part
    def lives(self) -> Annotated[Mapping[str, float], Unit("1")]:
        """Lives."""
        return {"left": 3.0}

    @part
    def places(self) -> Annotated[Sequence[Length], FINITE]:
        """Places."""
        return np.array([0.0, 0.5])

    @part
    def points(self) -> Sequence[Point]:
        """Points."""
        return [Point("start", 0.0)]

    @part
    def holds(self) -> bool:
        """True where it holds."""
        return np.bool_(True)

    @part
    def ends(self) -> Point | None:
        """Its end, null where there is none."""
        return self._ends

    @part
    def motor(self) -> Annotated[Point | None, LEFT_OUT]:
        """The motor, where there is one."""
        return self._motor


DOCUMENT = {
    "torque": 1.5, "loads": {"left": 1.0, "right": 2.0}, "lives": {"left": 3.0}, "places": [0.0, 0.5],
    "points": [{"name": "start", "place": 0.0}], "holds": True, "ends": None,
}  # fmt: skip
UNITS = {
    "torque": "N m", "loads": {"left": "N", "right": "N"}, "lives": "1", "places": "m", "points": {"place": "m"},
    "ends": {"place": "m"},
}  # fmt: skip


def test_a_document_has_each_part():
    found = declared.document(Path())
    assert found == DOCUMENT
    assert [type(found[name]) for name in ("torque", "holds")] == [float, bool]
    assert declared.document(Path(motor=Point("m", 2.0)))["motor"] == {"name": "m", "place": 2.0}


def test_units_have_the_tables_of_the_document():
    assert declared.units(Path()) == UNITS
    assert declared.units(Path(motor=Point("m", 2.0))) == UNITS | {"motor": {"place": "m"}}


def test_a_schema_describes_each_part():
    schema = schemas.schema(Path).model_json_schema()
    assert schema["description"] == "A path."
    torque = schema["properties"]["torque"]
    assert (torque["description"], torque["x-si-unit"]) == ("torque along the path, SI", "N m")
    assert schema["properties"]["loads"]["description"] == "Load of each half, SI"
    assert schema["properties"]["points"]["items"] == {"$ref": "#/$defs/Point"}
    assert schema["$defs"]["Point"]["properties"]["name"]["description"] == "Name of the point"
    assert schema["required"] == list(DOCUMENT)
    assert schema["properties"]["places"]["items"] == {"type": "number"}
    assert {"type": "null"} in torque["anyOf"]


class Measured(NamedTuple):
    """A torque with its error, and what is known of it."""

    torque: Annotated[Torque, Info("M", "measured torque", "N mm"), Column("")]
    error: Annotated[float | None, Column("error")]
    told: Annotated[bool, Column("told")]
    #: Readings.
    count: int
    means: Annotated[NDArray[np.float64], Unit("N m"), Info("", "means of readings")]


def test_an_answer_has_the_attributes_of_a_value():
    value = SimpleNamespace(torque=1.5, told=True, count=3, means=np.array([1.0, 2.0]))
    found = declared.from_attributes(Measured, value, error=None)
    assert declared.document(found) == {"torque": 1.5, "error": None, "told": True, "count": 3, "means": [1.0, 2.0]}
    assert declared.units(found) == {"torque": "N m", "means": "N m"}
    assert schemas.schema(Measured).model_json_schema()["properties"]["means"]["x-si-unit"] == "N m"
    with pytest.raises(AttributeError):
        declared.from_attributes(Measured, value)


def test_parts_with_a_heading_are_columns():
    newton_metres = Quantity("x", "N m", Info("", ""))
    cells = declared.cells(Measured(1.5, 0.25, True, 3, np.zeros(0)), "nut_torque", newton_metres)
    values = {heading: (value, getattr(quantity, "shown_in", None)) for heading, (value, quantity) in cells.items()}
    assert values == {"nut torque": (1.5, "N mm"), "nut torque error": (0.25, "N m"), "nut torque told": (1, None)}


def test_a_table_of_quantities():
    known = {name: Quantity(name, "m", Info("", f"{name} of it")) for name in ("length", "width")}

    class Sizes(declared.table_of(known, at_times=("width",))):
        """Sizes."""

    class Ends(declared.table_of(known, of=Point)):
        """Points."""

    assert declared.document(Sizes(length=1.0, width=None)) == {"length": 1.0}
    assert declared.units(Sizes(length=1.0, width=None)) == {"length": "m"}
    assert declared.document(Sizes(length=1.0, width=2.0)) == {"length": 1.0, "width": 2.0}
    schema = schemas.schema(Ends).model_json_schema()
    assert schema["properties"]["width"]["description"] == "width of it, SI"
    assert declared.units_of(Ends) == {"length": "m", "width": "m"}
    assert schemas.schema(Sizes).model_json_schema()["required"] == ["length"]


def test_a_document_is_valid_by_its_schema_and_another_is_not():
    model = schemas.schema(Path)
    model.model_validate(DOCUMENT)
    for wrong in ({**DOCUMENT, "more": 1}, {**DOCUMENT, "places": "none"}, {"torque": 1.0}):
        with pytest.raises(ValidationError):
            model.model_validate(wrong)


def test_a_name_of_an_array_is_an_array():
    # numpy.typing.NDArray is one from NumPy 2.5 on; here one that every NumPy has
    number = TypeVar("number", bound=np.generic)
    numbers = TypeAliasType("numbers", np.ndarray[Any, np.dtype[number]], type_params=(number,))

    class Of(Declared):
        """Forces."""

        @part
        def forces(self) -> Annotated[numbers[np.float64], Info("F", "forces", "N")]:
            """Forces."""
            return np.array([1.0])

    assert schemas.schema(Of).model_json_schema()["properties"]["forces"]["type"] == "array"
