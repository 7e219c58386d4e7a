"""``--to c``: the model as C99, to the last digits, with libm only."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

import numpy as np

from ballscrew.basis.records import Record
from ballscrew.exports.export import Export
from ballscrew.exports.presliding import OPTIONS, options_of_case, presliding
from ballscrew.exports.programs import c_presliding, c_source, c_two_levels
from ballscrew.exports.programs.c_source import Body, number
from ballscrew.exports.programs.interpreter import errors_of_program
from ballscrew.exports.programs.two_levels import two_levels
from ballscrew.exports.readme import readme
from ballscrew.exports.subject import HandOver
from ballscrew.physics.friction.validity import NUT_REASONS

__all__ = ["OPTIONS", "export", "options_of_case"]

#: Points of the test vector, and of that of a nut with elastic bodies, each of which takes Python milliseconds.
TEST_POINTS, TEST_POINTS_OF_ELASTIC_BODIES = 100, 20

_HEADER = """\
/* {title}. SI units; README.txt has the rest. */
#ifndef BALLSCREW_H
#define BALLSCREW_H

#ifdef __cplusplus
extern "C" {{
#endif

/* The places of the inputs and of the outputs. */
enum {{
{inputs}
    BALLSCREW_INPUT_COUNT = {input_count}
}};
enum {{
{outputs}
    BALLSCREW_OUTPUT_COUNT = {output_count}
}};

/* Names in the order of the places, and NULL at the end. */
extern const char *const ballscrew_inputs[];
extern const char *const ballscrew_outputs[];

/* The usual value of each input, and its range: beyond it the nearest value counts, and valid is 0. */
extern const double ballscrew_usual[];
extern const double ballscrew_least[];
extern const double ballscrew_greatest[];

/* Evaluates the model at one point. It keeps nothing between calls, and may be called from several threads. */
void ballscrew_evaluate(const double *inputs, double *outputs);

#ifdef __cplusplus
}}
#endif

#endif
"""

_SOURCE = """\
/* {title}. Made by ballscrew {version}; README.txt says of what.
   Do not compile with -ffast-math: limits at rest and without load need infinities and numbers that are none. */
#include "ballscrew.h"

#include <math.h>
#include <stddef.h>

const char *const ballscrew_inputs[] = {{{inputs}, NULL}};
const char *const ballscrew_outputs[] = {{{outputs}, NULL}};
const double ballscrew_usual[] = {{{usual}}};
const double ballscrew_least[] = {{{least}}};
const double ballscrew_greatest[] = {{{greatest}}};

{functions}

void ballscrew_evaluate(const double *inputs, double *outputs)
{{
    double x[BALLSCREW_INPUT_COUNT];
    int inside = 1;
    int i;
    for (i = 0; i < BALLSCREW_INPUT_COUNT; i++) {{
        const double least = ballscrew_least[i], greatest = ballscrew_greatest[i], given = inputs[i];
        inside = inside && given >= least && given <= greatest;
        x[i] = given < least ? least : given > greatest ? greatest : given;
    }}
{statements}
{results}
}}
"""

_MAIN = """\
/* An example, and the test of the vector: cc -std=c99 -O2 ballscrew.c main.c -lm && ./a.out test_vector.csv */
#include "ballscrew.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static int tested(const char *path)
{
    double inputs[BALLSCREW_INPUT_COUNT], outputs[BALLSCREW_OUTPUT_COUNT], worst = 0.0;
    char line[8192];
    int rows = 0;
    FILE *file = fopen(path, "r");
    if (file == NULL || fgets(line, sizeof line, file) == NULL) {
        fprintf(stderr, "%s: cannot be read\\n", path);
        return 2;
    }
    while (fgets(line, sizeof line, file) != NULL) {
        char *at = line;
        int i;
        for (i = 0; i < BALLSCREW_INPUT_COUNT; i++, at++)
            inputs[i] = strtod(at, &at);
        ballscrew_evaluate(inputs, outputs);
        for (i = 0; i < BALLSCREW_OUTPUT_COUNT; i++, at++) {
            const double wanted = strtod(at, &at), found = outputs[i];
            const double off = fabs(found - wanted) / (fabs(wanted) > 0.0 ? fabs(wanted) : 1.0);
            if (isnan(found) != isnan(wanted) || off > worst)
                worst = isnan(found) != isnan(wanted) ? HUGE_VAL : off;
        }
        rows++;
    }
    fclose(file);
    printf("%d rows, largest relative difference %.2g\\n", rows, worst);
    return worst <= 1e-9 ? 0 : 1;
}

int main(int count, char **arguments)
{
    double inputs[BALLSCREW_INPUT_COUNT], outputs[BALLSCREW_OUTPUT_COUNT];
    int i;
    if (count > 1)
        return tested(arguments[1]);
    for (i = 0; i < BALLSCREW_INPUT_COUNT; i++)
        inputs[i] = ballscrew_usual[i];
    inputs[BALLSCREW_AXIAL_LOAD] = {load};
    inputs[BALLSCREW_SCREW_SPEED] = {speed};
    ballscrew_evaluate(inputs, outputs);
    for (i = 0; i < BALLSCREW_INPUT_COUNT; i++)
        printf("%s = %.9g\\n", ballscrew_inputs[i], inputs[i]);
    for (i = 0; i < BALLSCREW_OUTPUT_COUNT; i++)
        printf("%s = %.9g\\n", ballscrew_outputs[i], outputs[i]);
    return 0;
}
"""

_NOTES = """\
ballscrew.c and ballscrew.h are strict C99 and need libm only:
  cc -std=c99 -O2 -c ballscrew.c
  cc -std=c99 -O2 ballscrew.c main.c -lm && ./a.out && ./a.out test_vector.csv
  cc -shared -fPIC -O2 ballscrew.c -o ballscrew.so -lm
Do not compile with -ffast-math. An evaluation needs {stack} kB of stack and a little, and no other memory. main.c is an
example, and tests the compiled code against test_vector.csv: inputs and outputs of the model in Python. The header can
be included in C++.
"""


def export(handed: HandOver) -> Export:
    """The model as C99: source, header, example with a test vector, and a text; with the friction after a reversal,
    where it is asked for.

    Raises :class:`~ballscrew.basis.errors.InputError` as :func:`~ballscrew.exports.presliding.presliding` does.
    """
    limits, returning = handed.formula_range, presliding(handed)
    files = {
        "ballscrew.c": source(handed, body := body_of(handed)),
        "ballscrew.h": header(handed),
        "main.c": _example(handed),
        "test_vector.csv": test_vector(handed),
    }
    errors = errors_of_program(handed)
    notes = _NOTES.format(stack=-(-body.room * 8 // 1000)) + _example_at_fault(handed)
    warnings: list[Record] = []
    if returning is not None:
        files |= c_presliding.files(returning)
        notes += f"{c_presliding.NOTES}\n{returning.notes}"
        warnings.append(returning.warning)
    files["README.txt"] = readme(handed, "C99 source", notes, errors)
    content = {name: text.encode() for name, text in files.items()}
    return Export.of(handed, "c", content, valid_range=limits, worst_error=errors, warnings=warnings)


def title(handed: HandOver) -> str:
    """A line about the model."""
    return f"Friction of a ball screw, model {handed.subject.model.label}, {type(handed.subject.nut).__name__}"


def header(handed: HandOver) -> str:
    """The header."""
    return _HEADER.format(
        title=title(handed),
        inputs=_places(handed, handed.input_names),
        outputs=_places(handed, handed.output_names),
        input_count=len(handed.input_names),
        output_count=len(handed.output_names),
    )


def source(handed: HandOver, body: Body | None = None) -> str:
    """The source; of the body of the evaluation, where it is at hand."""
    body = body or body_of(handed)
    limits = handed.formula_range
    results = {**body.results, "valid": f"inside && {body.results['valid']} != 0.0"}
    return _SOURCE.format(
        title=title(handed),
        version=handed.provenance["version"],
        inputs=_strings(handed.input_names),
        outputs=_strings(handed.output_names),
        usual=_numbers([one.value for one in handed.inputs]),
        least=_numbers([limits[name][0] for name in handed.input_names]),
        greatest=_numbers([limits[name][1] for name in handed.input_names]),
        functions="\n\n".join([*c_source.own_functions(body.texts), *body.texts]),
        statements="\n".join(f"    {line}" for line in body.statements),
        results="\n".join(f"    outputs[{k}] = {results[name]};" for k, name in enumerate(handed.output_names)),
    )


def body_of(handed: HandOver) -> Body:
    """The evaluation of the model in C."""
    if handed.has_elastic_bodies:
        return c_two_levels.body(two_levels(handed))
    made = c_source.functions(handed.program)
    return Body(made.texts, (f"double v[{made.room}];", *made.calls), made.results, made.room)


def _example(handed: HandOver) -> str:
    load, speed = _example_point(handed)
    return _MAIN.replace("{load}", number(load)).replace("{speed}", number(speed))


def _example_point(handed: HandOver) -> tuple[float, float]:
    """Load and speed of the example."""
    load, speed = (one.range[1] for one in handed.inputs[:2])
    return 0.25 * load, 0.5 * speed


def _example_at_fault(handed: HandOver) -> str:
    """Why ``valid`` is 0 in the example, where it is."""
    load, speed = _example_point(handed)
    with np.errstate(all="ignore"):
        found = handed.subject.at({"axial_load": np.array([load]), "screw_speed": np.array([speed])})
    reasons = [NUT_REASONS[name] for name, mask in found.validity.items() if not np.all(mask)]
    return f"main.c prints valid = 0: {'; '.join(reasons)}.\n" if reasons else ""


def test_vector(handed: HandOver) -> str:
    """Inputs and outputs at some points of the working range, to the last digit."""
    points = handed.sample(TEST_POINTS_OF_ELASTIC_BODIES if handed.has_elastic_bodies else TEST_POINTS)
    found = handed.evaluate(points)
    columns: Mapping[str, np.ndarray] = {**points, **{n: found[n].astype(float) for n in handed.output_names}}
    rows = zip(*(values.tolist() for values in columns.values()), strict=True)
    return "\n".join([",".join(columns), *(",".join(map(repr, row)) for row in rows), ""])


def _places(handed: HandOver, names: Sequence[str]) -> str:
    words = [re.sub(r"\W", "_", name).upper() for name in names]
    return "\n".join(
        f"    BALLSCREW_{word} = {k}, /* {handed.units[name]}: {handed.meanings[name]} */"
        for k, (word, name) in enumerate(zip(words, names, strict=True))
    )


def _strings(names: Sequence[str]) -> str:
    return ", ".join(f'"{name}"' for name in names)


def _numbers(values: Sequence[float]) -> str:
    return ", ".join(map(number, values))
