/* Friction that comes back after a reversal, a hypothesis. SI units; README.txt has the rest. */
#ifndef BALLSCREW_PRESLIDING_H
#define BALLSCREW_PRESLIDING_H

#ifdef __cplusplus
extern "C" {
#endif

enum {
    BALLSCREW_PRESLIDING_ELEMENTS = @COUNT@
};

/* What each element holds over the torque at which it slides, -1 to 1. All zero: nothing is wound up. */
typedef struct {
    double wound[BALLSCREW_PRESLIDING_ELEMENTS];
} ballscrew_presliding;

/* The state after a long way in a direction: 1, -1, or 0 for nothing wound up. */
void ballscrew_presliding_start(ballscrew_presliding *state, double direction);

/* Turns the screw by an angle in rad that does not reverse on its way, and returns the friction torque in N m with its
   sign. screw_torque is the steady friction torque: ballscrew_evaluate has it for a speed in motion. */
double ballscrew_presliding_turn(ballscrew_presliding *state, double turned, double screw_torque);

#ifdef __cplusplus
}
#endif

#endif
