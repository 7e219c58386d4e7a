"""A torque card as a log and a case file, as a fit takes them."""

from __future__ import annotations

import math
from pathlib import Path

from ballscrew.basis import units
from ballscrew.basis.atomic_files import atomic_write
from ballscrew.basis.quantities import fields_of
from ballscrew.cases.case_files.named_files import moved
from ballscrew.cases.torque_cards.torque_card import TorqueCard, TorquePoint, case_tables, log_rows
from ballscrew.physics.components.materials import TEMPERATURE

_HEADINGS = ("speed [rpm]", "axial load [N]", "torque [N m]", "temperature [degC]")


def write(card: TorqueCard, folder: Path, log: Path, case: Path) -> None:
    """Write the log and the case file of a card from a folder."""
    import tomlkit

    tables = moved(case_tables(card.tables), folder, case.parent)
    head = f"# Of the torque card {card.name}: {card.title}\n"
    with atomic_write("--case", case) as path:
        path.write_text(f"{head}\n{tomlkit.dumps(tables)}", encoding="utf-8")
    speed, torque = (fields_of(TorquePoint)[name] for name in ("screw_speed", "torque_forward"))
    lines = [",".join(_HEADINGS)]
    for row in log_rows(card):
        temperature = row["temperature"]
        cells = (
            units.from_si(row["screw_speed"], speed),
            row["axial_load"],
            units.from_si(row["torque"], torque),
            "" if math.isnan(temperature) else units.from_si(temperature, TEMPERATURE),
        )
        lines.append(",".join(cell if isinstance(cell, str) else f"{cell:.9g}" for cell in cells))
    with atomic_write("--to", log) as path:
        path.write_text(head + "\n".join(lines) + "\n", encoding="utf-8")
