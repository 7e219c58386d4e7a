"""Tables of what a torque card holds, from the models that check it."""

from ballscrew.cases.torque_cards.torque_card import json_schema
from ballscrew.questions.shared.text_tables import markdown_table


def tables() -> str:
    """The sections that only a card has, field by field."""
    schema = json_schema()
    parts = {"card": "[card]", "setup": "[setup]", "points": "[[points]]"}
    found = []
    for name, title in parts.items():
        reference = schema["properties"][name]
        reference = reference.get("items", reference)["$ref"].rpartition("/")[2]
        found.append(_table(title, schema["$defs"][reference]))
    return "\n".join(found)


def _table(title, part):
    needed = part.get("required", ())
    rows = [
        (f"`{name}`", "yes" if name in needed else "", _written(field), field.get("description", ""))
        for name, field in part["properties"].items()
    ]
    return f"**`{title}`**\n\n{markdown_table(('field', 'needed', 'written as', 'meaning'), rows)}"


def _written(field):
    if "const" in field:
        return f"`{field['const']}`"
    if "enum" in field:
        return ", ".join(f'`"{value}"`' for value in field["enum"])
    if "x-unit" in field:
        return f'`"… {field["x-unit"]}"`'
    kinds = [one.get("format") or one.get("type") for one in field.get("anyOf", [field])]
    words = {"string": "text", "boolean": "`true`, `false`", "date": "a date", "number": "a number"}
    return ", ".join(words[kind] for kind in kinds if kind in words)
