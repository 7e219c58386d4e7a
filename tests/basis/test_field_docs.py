"""Docstrings of public classes name their fields, from annotations and comments."""

import dataclasses
import inspect
import pickle
import re
import subprocess
import sys
from typing import Annotated

import ballscrew as bs
from ballscrew.basis.field_docs import show_fields
from ballscrew.basis.quantities import Info, Length, Ratio


@dataclasses.dataclass(frozen=True)
class Part:
    """A part.

    It has a ``colour``.
    """

    width: Annotated[Length, Info("b", "width across", above=0, at_most=2, usual=(0.1, 1.0))]
    colour: str
    #: How many there are,
    #: of all kinds.
    count: int = 1
    depth: Length = 0.0

    @property
    def slenderness(self) -> Annotated[Ratio, Info("s", "depth / width")]:
        """Depth over width."""
        return self.depth / self.width


show_fields(Part)

TEXT = """A part.

It has a ``colour``.

Fields:

* ``width``: width across, :math:`b`; m, above 0, at most 2, usual 0.1 to 1.
* ``count``: How many there are, of all kinds.
* ``depth``: m.

Computed:

* ``slenderness``: depth / width, :math:`s`."""


def test_fields_follow_the_text():
    assert inspect.getdoc(Part) == TEXT


def test_an_instance_has_the_same_text():
    assert Part(1.0, "red").__doc__ == TEXT


def test_every_field_of_a_ball_screw_is_shown():
    text = inspect.getdoc(bs.BallScrew) or ""
    assert "* ``lead``: advance of the nut in one turn, :math:`P_h`; m, above 0" in text
    assert "Annotated" not in str(inspect.signature(bs.BallScrew))


def test_a_signature_has_laws_by_their_names():
    shown = str(inspect.signature(bs.FrictionModel))
    assert "rolling: 'RollingLaw' = olaru_rolling," in shown
    assert " at 0x" not in shown


def test_the_text_of_the_package_has_every_name_by_subject():
    named = set(re.findall(r"\w+", bs.__doc__ or ""))
    assert set(bs.__all__) - named == set()


def test_what_is_shown_changes_no_value():
    nut = bs.DoubleNut(preload=1000.0)
    assert pickle.loads(pickle.dumps(nut)) == nut
    assert dataclasses.replace(nut, spacing=0.01).spacing == 0.01


def test_the_import_loads_nothing_of_it():
    code = "import sys, ballscrew; sys.exit('ballscrew.basis.field_docs' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
