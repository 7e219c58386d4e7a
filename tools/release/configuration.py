"""TOML and YAML files that cannot be read, or in which a key stands twice: ``configuration.py FILE…``."""

from __future__ import annotations

import sys
import tomllib
from collections.abc import Hashable, Iterable
from pathlib import Path
from typing import Any

import yaml


class Strict(yaml.SafeLoader):
    """YAML in which no key of a mapping may stand twice: the last of them would count, silently."""

    def construct_mapping(self, node: yaml.MappingNode, deep: bool = False) -> dict[Hashable, Any]:
        """The mapping of a node. Raises ``ConstructorError`` for a key that stands twice."""
        seen: set[Hashable] = set()
        for written, _ in node.value:
            key = self.construct_object(written, deep=True)
            if key in seen:
                raise yaml.constructor.ConstructorError(None, None, f"{key} stands twice", written.start_mark)
            seen.add(key)
        return super().construct_mapping(node, deep)


def fault(path: Path) -> str:
    """What is wrong with a file, in one line; nothing where it can be read."""
    try:
        text = path.read_text(encoding="utf-8")
        if path.suffix == ".toml":
            tomllib.loads(text)
        else:
            yaml.load(text, Loader=Strict)
    except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError, yaml.YAMLError) as error:
        return f"{path}: {' '.join(str(error).split())}"
    return ""


def main(paths: Iterable[str]) -> int:
    """Say what is wrong with each file."""
    faults = [found for path in paths if (found := fault(Path(path)))]
    print(*faults, sep="\n", end="\n" if faults else "", file=sys.stderr)
    return int(bool(faults))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
