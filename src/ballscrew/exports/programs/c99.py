"""``--to c``: the model as C99, to the last digits, with libm only."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

import numpy as np

from ballscrew.exports.export import Export, Target, filled, readme
from ballscrew.exports.programs.c_source import Body, body_of, number, own_functions
from ballscrew.exports.programs.interpreter import errors_of_program
from ballscrew.exports.programs.presliding import OPTIONS, options_of_case, presliding
from ballscrew.exports.subject import HandOver
from ballscrew.physics.friction.validity import NUT_REASONS

#: Points of the test vector, and of that of a nut with elastic bodies, each of which takes Python milliseconds.
TEST_POINTS, TEST_POINTS_OF_ELASTIC_BODIES = 100, 20

_NOTES = """\
ballscrew.c and ballscrew.h are strict C99 and need libm only:
  cc -std=c99 -O2 -c ballscrew.c
  cc -std=c99 -O2 ballscrew.c main.c -lm && ./a.out && ./a.out test_vector.csv
  cc -shared -fPIC -O2 ballscrew.c -o ballscrew.so -lm
Do not compile with -ffast-math. An evaluation needs {stack} kB of stack and a little, and no other memory. main.c is an
example, and tests the compiled code against test_vector.csv: inputs and outputs of the model in Python. The header can
be included in C++.
"""


def export(job: HandOver) -> Export:
    """The model as C99: source, header, example with a test vector, and a text; with the friction after a reversal,
    where it is asked for.

    Raises :class:`~ballscrew.basis.errors.InputError` as
    :func:`~ballscrew.exports.programs.presliding.presliding` does.
    """
    body, returning = body_of(job), presliding(job)
    load, speed = _example_point(job)
    files = {
        "ballscrew.c": source(job, body),
        "ballscrew.h": header(job),
        "main.c": filled("c99_main.c", load=number(load), speed=number(speed)),
        "test_vector.csv": test_vector(job),
        **({} if returning is None else returning.files),
    }
    errors = errors_of_program(job)
    notes = _NOTES.format(stack=-(-body.room * 8 // 1000)) + _example_at_fault(job)
    notes += "" if returning is None else returning.notes
    files["README.txt"] = readme(job, "C99 source", notes, errors)
    return Export.of(job, "c", files, errors, warnings=[] if returning is None else [returning.warning])


C = Target(export, OPTIONS, options_of_case)


def title(job: HandOver) -> str:
    """A line about the model."""
    return f"Friction of a ball screw, model {job.subject.model.label}, {type(job.subject.nut).__name__}"


def header(job: HandOver) -> str:
    """The header."""
    return filled(
        "c99.h",
        title=title(job),
        inputs=_places(job, job.input_names),
        outputs=_places(job, job.output_names),
        input_count=len(job.input_names),
        output_count=len(job.output_names),
    )


def source(job: HandOver, body: Body | None = None) -> str:
    """The source; of the body of the evaluation, where it is at hand."""
    body = body or body_of(job)
    limits = job.formula_range
    results = {**body.results, "valid": f"inside && {body.results['valid']} != 0.0"}
    return filled(
        "c99.c",
        title=title(job),
        version=job.provenance["version"],
        inputs=", ".join(f'"{name}"' for name in job.input_names),
        outputs=", ".join(f'"{name}"' for name in job.output_names),
        usual=", ".join(number(entry.value) for entry in job.inputs),
        least=", ".join(number(limits[name][0]) for name in job.input_names),
        greatest=", ".join(number(limits[name][1]) for name in job.input_names),
        functions="\n\n".join([*own_functions(body.texts), *body.texts]),
        statements="\n".join(f"    {line}" for line in body.statements),
        results="\n".join(f"    outputs[{k}] = {results[name]};" for k, name in enumerate(job.output_names)),
    )


def _example_point(job: HandOver) -> tuple[float, float]:
    """Load and speed of the example."""
    load, speed = (entry.range[1] for entry in job.inputs[:2])
    return 0.25 * load, 0.5 * speed


def _example_at_fault(job: HandOver) -> str:
    """Reason why ``valid`` is 0 in the example, where it is."""
    load, speed = _example_point(job)
    with np.errstate(all="ignore"):
        friction = job.subject.at({"axial_load": np.array([load]), "screw_speed": np.array([speed])})
    reasons = [NUT_REASONS[name] for name, mask in friction.validity.items() if not np.all(mask)]
    return f"main.c prints valid = 0: {'; '.join(reasons)}.\n" if reasons else ""


def test_vector(job: HandOver) -> str:
    """Inputs and outputs at some points of the working range, to the last digit."""
    points = job.sample(TEST_POINTS_OF_ELASTIC_BODIES if job.has_elastic_bodies else TEST_POINTS)
    exact = job.evaluate(points)
    columns: Mapping[str, np.ndarray] = {**points, **{n: exact[n].astype(float) for n in job.output_names}}
    rows = zip(*(values.tolist() for values in columns.values()), strict=True)
    return "\n".join([",".join(columns), *(",".join(map(repr, row)) for row in rows), ""])


def _places(job: HandOver, names: Sequence[str]) -> str:
    words = [re.sub(r"\W", "_", name).upper() for name in names]
    return "\n".join(
        f"    BALLSCREW_{word} = {k}, /* {job.units[name]}: {job.meanings[name]} */"
        for k, (word, name) in enumerate(zip(words, names, strict=True))
    )
