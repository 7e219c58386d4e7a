"""Rules over many subjects as one test, which lists all that break them."""

import functools
import inspect
from collections.abc import Callable, Mapping
from typing import Any


def for_each(**subjects: Mapping[str, Any]) -> Callable[[Callable[..., None]], Callable[..., None]]:
    """Run a test for each value of a mapping, ``for_each(equation=EQUATIONS)``.

    It fails with the names of all offenders. Other arguments of the test are its fixtures.
    """
    ((argument, values),) = subjects.items()

    def decorated(test: Callable[..., None]) -> Callable[..., None]:
        signature = inspect.signature(test)

        @functools.wraps(test)
        def rule(**fixtures: Any) -> None:
            offenders = []
            for name, value in values.items():
                try:
                    test(**fixtures, **{argument: value})
                except Exception as error:  # any: the others are looked at, too
                    offenders.append(f"{name}: {type(error).__name__} {error}")
            assert values
            assert not offenders, "\n\n".join(offenders)

        others = [each for name, each in signature.parameters.items() if name != argument]
        rule.__signature__ = signature.replace(parameters=others)  # type: ignore[attr-defined]  (what pytest reads)
        return rule

    return decorated
