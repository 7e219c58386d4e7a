/* Friction that comes back after a reversal: Maxwell-slip elements, in shares of the steady friction torque. */
#include "ballscrew_presliding.h"

static const double at_once = @AT_ONCE@;
static const double share[BALLSCREW_PRESLIDING_ELEMENTS] = {@SHARES@};
static const double slip_angle[BALLSCREW_PRESLIDING_ELEMENTS] = {@ANGLES@};

void ballscrew_presliding_start(ballscrew_presliding *state, double direction)
{
    int i;
    for (i = 0; i < BALLSCREW_PRESLIDING_ELEMENTS; i++)
        state->wound[i] = direction > 0.0 ? 1.0 : direction < 0.0 ? -1.0 : 0.0;
}

double ballscrew_presliding_turn(ballscrew_presliding *state, double turned, double screw_torque)
{
    double sum = turned > 0.0 ? at_once : turned < 0.0 ? -at_once : 0.0;
    int i;
    for (i = 0; i < BALLSCREW_PRESLIDING_ELEMENTS; i++) {
        const double wound = state->wound[i] + turned / slip_angle[i];
        state->wound[i] = wound > 1.0 ? 1.0 : wound < -1.0 ? -1.0 : wound;
        sum += share[i] * state->wound[i];
    }
    return screw_torque * sum;
}
