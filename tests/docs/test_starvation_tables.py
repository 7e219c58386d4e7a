"""Claims of the page on starvation, by the table that it shows."""

import math

import starvation_tables as tables
from ballscrew.physics.friction.validity import differs


def test_in_the_cold_every_answer_has_two_torques_and_in_a_warm_hall_one():
    for degrees, starved in ((-10, True), (60, False)):
        found = tables.answers(degrees)
        # of a motor that lifts a weight, friction is a small part of its largest torque
        judged = {head: bool(differs(*cell[:2])) for head, cell in found.items() if head != "duty, torque"}
        assert set(judged.values()) == {starved}, degrees
        assert all(cell.flooded >= cell.given for cell in found.values())


def test_a_starved_screw_rubs_less_in_the_cold_than_warm_and_one_in_a_full_bath_more():
    cold, warm = (tables.of_run(degrees)["run"] for degrees in (-10, 40))
    assert cold.given < warm.given < warm.flooded < cold.flooded
    assert cold.flooded > 5 * cold.given


def test_the_table_has_a_row_for_each_temperature_and_a_column_for_each_answer(monkeypatch):
    monkeypatch.setattr(tables, "TEMPERATURES", (-20, 40))
    monkeypatch.setattr(tables, "QUESTIONS", (tables.of_run, tables.of_warm_up))
    head, _, cold, warm = tables.table().splitlines()
    assert head == "| °C | run | warm-up, start | warm-up, end |"
    run = tables.of_run(-20)["run"]
    assert f"{run.given:.3g} → {run.flooded:.3g} N m" in cold
    assert cold.count("–") == 2  # of which the oil is not known
    assert "→" not in warm
    assert math.isnan(tables.of_warm_up(-20)["warm-up, end"].given)
