"""``ballscrew card check``: faults of torque cards, and what they do not state; as a document and as text."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ballscrew.basis import units
from ballscrew.basis.errors import Fault, InputError
from ballscrew.basis.output.text import wrapped
from ballscrew.basis.quantities import Info, Quantity, fields_of
from ballscrew.cases.case_files import descriptions
from ballscrew.cases.case_files.named_calibration import subject_of
from ballscrew.cases.torque_cards import torque_card
from ballscrew.cases.torque_cards.torque_card import TorqueCard, TorquePoint
from ballscrew.evidence.validation.entries import Band, Conditions, Entry, Point, ValidationSet, Values
from ballscrew.physics.friction.calibrations import Calibration, calibrated
from ballscrew.physics.friction.model import FrictionModel
from ballscrew.physics.sizing.rules import drags
from ballscrew.physics.solvers.load_distribution import preload_of

_TORQUE = Quantity("torque", "N m", Info("T", "torque", "N m"))


def evaluate(
    paths: Sequence[Path], model: FrictionModel, calibration: Calibration | None
) -> Iterator[tuple[list[Entry], list[str]]]:
    """The entries of each card, uncalibrated first, and notes on it.

    Raises :class:`~ballscrew.basis.errors.InputError` with the faults of all cards, and for a nut that the model
    cannot do.
    """
    cards = torque_card.read_all(paths)
    for card in cards:
        if not model.knows(card.case.screw.nut):
            problem = f"model {model.name} knows no balls with four contacts"
            raise InputError(Fault(card.name, problem, "", "take the model reference"))
    models: list[tuple[FrictionModel, str | None]] = [(model, None)]
    if calibration is not None:
        models.append((calibrated(model, calibration), calibration.name))
    for card in cards:
        data = set_of(card)
        entries = [Entry(data=data, model=one, calibration=name, points=points(card, one)) for one, name in models]
        yield entries, [f"{card.name}: {note}" for note in card.notes]


def set_of(card: TorqueCard) -> ValidationSet:
    """The card as a set of data."""
    about = card.about

    def no_rows(model: FrictionModel, values: Values, conditions: Conditions) -> list[Point]:
        raise NotImplementedError("a card has points, no rows")

    return ValidationSet(
        name=card.name,
        title=card.title,
        details="torque without load over the speed",
        reference="against the mean of both directions and the uncertainty of the instrument",
        maker=str(about["who"]),
        source=f"{about['who']}, {about['when'].isoformat()}, {about['licence']}",
        file="",
        quantity=_TORQUE,
        columns={},
        required=(),
        evaluate=no_rows,
        axes=("speed", "film_parameter"),
        of_screws=False,
        calibratable=True,
        four_contacts=card.case.screw.nut.contacts_per_ball > 2,
        card=document(card),
    )


def document(card: TorqueCard) -> dict[str, Any]:
    """Origin of the measurement, the set-up, and what is not stated; SI."""
    about = {name: value.isoformat() if name == "when" else value for name, value in card.about.items()}
    setup = {name: getattr(card.setup, name) for name in fields_of(card.setup)}
    return {**about, "setup": {**setup, **card.remarks}, "preload": _preload(card), "notes_of_reader": card.notes}


def _preload(card: TorqueCard) -> float:
    return float(preload_of(card.case.screw, card.case.screw.nut))


def points(card: TorqueCard, model: FrictionModel) -> list[Point]:
    """The torque of a model at each speed of a card."""
    by_rules = drags(subject_of(card.case))
    return [_point(card, point, model, by_rules) for point in card.points]


def _point(card: TorqueCard, point: TorquePoint, model: FrictionModel, by_rules: dict[str, float]) -> Point:
    screw, uncertainty = card.case.screw, float(card.setup.torque_uncertainty)
    result = model(
        screw, card.case.lubricant, axial_load=0.0, screw_speed=point.screw_speed, temperature=point.temperature
    )
    readings = point.readings
    return Point(
        name=f"{float(point.screw_speed) * 30 / np.pi:.6g} rpm",
        value=float(result.screw_torque),
        band=Band(point.torque, min(readings) - uncertainty, max(readings) + uncertainty),
        descriptors={
            "speed": float(point.screw_speed),
            "film_parameter": float(np.min([np.min(pair.screw.film_parameter) for pair in result.pairs])),
        },
        laws={name: drag / point.torque for name, drag in by_rules.items()},
        warnings=result.warning_records,
    )


def documents(cards: Sequence[TorqueCard]) -> list[dict[str, Any]]:
    """A document for each card."""
    return [
        {
            "name": card.name,
            "synthetic": card.synthetic,
            **document(card),
            "points": [{name: getattr(point, name) for name in fields_of(TorquePoint)} for point in card.points],
        }
        for card in cards
    ]


_KNOWN = fields_of(TorquePoint)


def text_of(cards: Sequence[TorqueCard]) -> str:
    """Contents of the cards, and what they do not state."""
    return "\n\n".join(_block(card) for card in cards)


def _block(card: TorqueCard) -> str:
    speeds, torques = [point.screw_speed for point in card.points], [point.torque for point in card.points]
    lines = [
        f"{card.name}: {card.title}",
        f"  {card.about['who']}, {card.about['when'].isoformat()}, {card.about['licence']}",
        f"  {descriptions.design(card.case, plain_text=True)}",
        f"  {len(card.points)} points, {_range(speeds, 'screw_speed')}, {_range(torques, 'torque_forward')}",
        *(f"  beware: {note}" for note in card.notes),
    ]
    return "\n".join(map(wrapped, lines))


def _range(values: Sequence[float], name: str) -> str:
    ends = [units.shown(float(end), _KNOWN[name]) for end in (min(values), max(values))]
    return " to ".join(ends)
