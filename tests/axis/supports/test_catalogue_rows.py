"""Rows of catalogues as printed: a few numbers against the sources, and what holds for all."""

import pytest

import ballscrew as bs
from ballscrew.axis.supports.element_laws import guide_rows, support_units
from ballscrew.basis.references import bibliography


@pytest.mark.parametrize(
    ("model", "rating", "permissible", "rigidity"),
    [
        ("EK4", 930, 1100, 27e6),
        ("FK15", 7600, 4000, 100e6),
        ("BK20", 12700, 7550, 140e6),
        ("BK40", 44100, 27100, 270e6),
    ],
)
def test_support_units_of_thk513e(model, rating, permissible, rigidity):
    row = support_units()[model]
    assert (row.dynamic_load_rating, row.permissible_load, row.rigidity) == (rating, permissible, rigidity)


def test_seals_of_rollon2020():
    assert {name: row.seal_force for name, row in guide_rows().items()} == {
        "MRS15": 0.15,
        "MRS20": 0.2,
        "MRS25": 0.35,
        "MRS30": 0.7,
        "MRS35": 0.8,
        "MRS45": 0.9,
        "MCS55": 1.0,
    }
    guide = guide_rows()["MRS25"].guide()
    assert (guide.friction_coefficient, guide.seal_force, guide.carriages) == (0.003, 0.35, 4)


def test_larger_units_are_stiffer_and_stronger_and_all_have_a_source():
    for series in ("EK", "FK"):  # BK20 has a lighter series of bearings than BK17
        rows = [row for name, row in support_units().items() if name.startswith(series)]
        rows.sort(key=lambda row: int(row.model[2:]))
        for name in ("dynamic_load_rating", "permissible_load", "rigidity"):
            values = [getattr(row, name) for row in rows]
            assert values == sorted(values), (series, name)
    assert {row.source for row in (*support_units().values(), *guide_rows().values())} <= set(bibliography())


@pytest.mark.parametrize(("rows", "name", "meant"), [(support_units, "EK16", "EK"), (guide_rows, "MRS55", "MRS")])
def test_an_unknown_row_names_the_nearest(rows, name, meant):
    with pytest.raises(bs.InputError, match=f'did you mean "{meant}'):
        rows()[name]
