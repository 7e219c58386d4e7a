"""Friction that comes back after a reversal as C99: a structure for the state, and a function that turns it."""

from __future__ import annotations

from collections.abc import Sequence

from ballscrew.exports.presliding import Presliding
from ballscrew.exports.programs.c_source import number

#: The names of the two files.
SOURCE, HEADER = "ballscrew_presliding.c", "ballscrew_presliding.h"

_HEADER = """\
/* Friction that comes back after a reversal, a hypothesis. SI units; README.txt has the rest. */
#ifndef BALLSCREW_PRESLIDING_H
#define BALLSCREW_PRESLIDING_H

#ifdef __cplusplus
extern "C" {{
#endif

enum {{
    BALLSCREW_PRESLIDING_ELEMENTS = {count}
}};

/* What each element holds over the torque at which it slides, -1 to 1. All zero: nothing is wound up. */
typedef struct {{
    double wound[BALLSCREW_PRESLIDING_ELEMENTS];
}} ballscrew_presliding;

/* The state after a long way in a direction: 1, -1, or 0 for nothing wound up. */
void ballscrew_presliding_start(ballscrew_presliding *state, double direction);

/* Turns the screw by an angle in rad that does not reverse on its way, and returns the friction torque in N m with its
   sign. screw_torque is the steady friction torque: ballscrew_evaluate has it for a speed in motion. */
double ballscrew_presliding_turn(ballscrew_presliding *state, double turned, double screw_torque);

#ifdef __cplusplus
}}
#endif

#endif
"""

_SOURCE = """\
/* Friction that comes back after a reversal: Maxwell-slip elements, in shares of the steady friction torque. */
#include "ballscrew_presliding.h"

static const double at_once = {at_once};
static const double share[BALLSCREW_PRESLIDING_ELEMENTS] = {{{shares}}};
static const double slip_angle[BALLSCREW_PRESLIDING_ELEMENTS] = {{{angles}}};

void ballscrew_presliding_start(ballscrew_presliding *state, double direction)
{{
    int i;
    for (i = 0; i < BALLSCREW_PRESLIDING_ELEMENTS; i++)
        state->wound[i] = direction > 0.0 ? 1.0 : direction < 0.0 ? -1.0 : 0.0;
}}

double ballscrew_presliding_turn(ballscrew_presliding *state, double turned, double screw_torque)
{{
    double sum = turned > 0.0 ? at_once : turned < 0.0 ? -at_once : 0.0;
    int i;
    for (i = 0; i < BALLSCREW_PRESLIDING_ELEMENTS; i++) {{
        const double wound = state->wound[i] + turned / slip_angle[i];
        state->wound[i] = wound > 1.0 ? 1.0 : wound < -1.0 ? -1.0 : wound;
        sum += share[i] * state->wound[i];
    }}
    return screw_torque * sum;
}}
"""

NOTES = """
ballscrew_presliding.c and ballscrew_presliding.h have the friction after a reversal, with a state that is yours:
  ballscrew_presliding state;
  ballscrew_presliding_start(&state, 0.0);
  ballscrew_evaluate(inputs, outputs);  /* in each step, with the speed of the screw */
  torque = outputs[BALLSCREW_IDEAL_TORQUE]
      + ballscrew_presliding_turn(&state, turned, outputs[BALLSCREW_SCREW_TORQUE]);
In a step without a turn the part that is at once is left out, as is all friction at rest in ballscrew_evaluate.
"""


def files(found: Presliding) -> dict[str, str]:
    """The header and the source."""
    return {
        SOURCE: _SOURCE.format(
            at_once=number(found.at_once),
            shares=_numbers([one.share for one in found.elements]),
            angles=_numbers([one.slip_angle for one in found.elements]),
        ),
        HEADER: _HEADER.format(count=len(found.elements)),
    }


def _numbers(values: Sequence[float]) -> str:
    return ", ".join(map(number, values))
