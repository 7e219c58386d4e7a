/* An engine plugin of MuJoCo: a motor's torque on the shaft of a ball screw, less the friction of the screw.
 *
 * @PROVENANCE@
 *
 * Actuator. Its control is the torque of the motor on the shaft, N m. It drives a slide joint with the gear
 * 2 pi / lead = @ARM@ (or with its negative, where the screw has its motor at the other end), or a hinge joint that
 * is the shaft, with gear 1 or -1. A positive load on the nut is one that a positive turn of the actuator lifts.
 * Limit the control (ctrlrange), not the force (forcerange): the force has the friction in it.
 *
 * Sensor of the same instance, four numbers: the axial load of the nut (N), the friction on the shaft (N m, with the
 * sign of what it acts against), the torque that accelerates the shaft (N m), and 1 where the model holds.
 *
 * Attributes: "inertia" of all that turns (kg m2; it must also be in the armature of the joint, times gear squared),
 * and the inputs of the model in SI, load and speed aside.
 *
 * The screw passes on what friction and inertia leave of the torque T: F lead / 2 pi = T - M - J alpha. Friction M
 * depends on F, so each step solves this equation; the acceleration alpha is that of the step before. While the
 * shaft turns, M is the friction of the model. At rest and while the motion turns round, friction is whatever holds
 * the shaft, up to the friction of the model: a spring that slips where it has that torque. Its
 * stiffness follows from the time step, so that it is stable; a held shaft gives way a little and does not creep.
 */
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <mujoco/mujoco.h>

#include "ballscrew.h"

#define LEAD @LEAD@ /* m a turn */
#define INERTIA @INERTIA@ /* kg m2 */
enum { LOAD, FRICTION, ACCELERATING, HOLDS, SENSED }; /* of the sensor */
enum { TWIST, LAST_LOAD, STATES };                    /* of the spring, rad; in the step before, N */

/* Those of the model, and "inertia" at the end; filled when the library is loaded. */
static const char *attributes[BALLSCREW_INPUT_COUNT + 1];

static const double two_pi = 6.283185307179586;
static const double steps_of_the_spring = 5.0; /* radians of its swing: one step is a fifth of a radian */
static const double close_enough = 1e-10;      /* of the load */
enum { MOST_TURNS = 40 };

typedef struct {
  int actuator, dof;
  double gear, inertia;
  double stiffness; /* of the spring, N m/rad, in this step */
  double limit; /* of friction, in this step */
  double given[BALLSCREW_INPUT_COUNT];
  double sensed[SENSED];
} Screw;

static Screw *screw_of(const mjData *d, int instance) { return (Screw *)d->plugin_data[instance]; }

static double clamped(double value, double limit) { return value > limit ? limit : value < -limit ? -limit : value; }

/* The number of an attribute, or its usual value; NaN for what is no number. */
static double number_of(const mjModel *m, int instance, const char *name, double usual) {
  const char *text = mj_getPluginConfig(m, instance, name);
  char *end;
  if (!text || !*text) return usual;
  double value = strtod(text, &end);
  return *end ? NAN : value;
}

static const char *fill(Screw *s, const mjModel *m, int instance) {
  s->actuator = -1;
  for (int i = 0; i < m->nu; i++)
    if (m->actuator_plugin[i] == instance) s->actuator = i;
  if (s->actuator < 0) return "the instance has no actuator";
  if (m->actuator_trntype[s->actuator] != mjTRN_JOINT) return "its actuator must drive a joint";
  int joint = m->actuator_trnid[2 * s->actuator], slides = m->jnt_type[joint] == mjJNT_SLIDE;
  if (!slides && m->jnt_type[joint] != mjJNT_HINGE) return "its joint must be a slide or a hinge";
  s->dof = m->jnt_dofadr[joint];
  s->gear = m->actuator_gear[6 * s->actuator];
  if (slides && fabs(fabs(s->gear) * LEAD / two_pi - 1) > 1e-6) return "the gear of a slide must be 2 pi / lead = @ARM@";
  if (!slides && fabs(fabs(s->gear) - 1) > 1e-6) return "the gear of a hinge, the shaft, must be 1 or -1";
  s->inertia = number_of(m, instance, "inertia", INERTIA);
  if (!(s->inertia >= 0)) return "inertia must be a number, 0 or more, in kg m2";
  for (int k = 0; k < BALLSCREW_INPUT_COUNT; k++) {
    s->given[k] = number_of(m, instance, ballscrew_inputs[k], ballscrew_usual[k]);
    if (!isfinite(s->given[k])) return "an attribute is no number";
  }
  return NULL;
}

static int create(const mjModel *m, mjData *d, int instance) {
  Screw *s = calloc(1, sizeof *s);
  const char *problem = s ? fill(s, m, instance) : "out of memory";
  if (problem) {
    mju_warning("@PLUGIN@: %s", problem);
    free(s);
    return -1;
  }
  d->plugin_data[instance] = (uintptr_t)s;
  return 0;
}

static void destroy(mjData *d, int instance) {
  free(screw_of(d, instance));
  d->plugin_data[instance] = 0;
}

static void copy(mjData *to, const mjModel *m, const mjData *from, int instance) {
  (void)m;
  *screw_of(to, instance) = *screw_of(from, instance);
}

static int state_size(const mjModel *m, int instance) { return (void)m, (void)instance, STATES; }

static int sensor_size(const mjModel *m, int instance, int sensor) {
  return (void)m, (void)instance, (void)sensor, SENSED;
}

static void reset(const mjModel *m, mjtNum *state, void *data, int instance) {
  (void)m, (void)data, (void)instance;
  state[TWIST] = state[LAST_LOAD] = 0;
}

/* The friction of the model under a load. */
static double model(Screw *s, double load, double speed) {
  double outputs[BALLSCREW_OUTPUT_COUNT];
  s->given[BALLSCREW_AXIAL_LOAD] = load;
  s->given[BALLSCREW_SCREW_SPEED] = speed;
  ballscrew_evaluate(s->given, outputs);
  s->sensed[HOLDS] = outputs[BALLSCREW_VALID] != 0 && isfinite(outputs[BALLSCREW_SCREW_TORQUE]);
  return isfinite(outputs[BALLSCREW_SCREW_TORQUE]) ? outputs[BALLSCREW_SCREW_TORQUE] : 0;
}

static void act(const mjModel *m, mjData *d, int instance) {
  Screw *s = screw_of(d, instance);
  const mjtNum *range = m->actuator_ctrlrange + 2 * s->actuator;
  double torque = d->ctrl[s->actuator];
  if (m->actuator_ctrllimited[s->actuator] && !(m->opt.disableflags & mjDSBL_CLAMPCTRL))
    torque = mju_clip(torque, range[0], range[1]);

  double speed = s->gear * d->qvel[s->dof];
  double accelerating = s->inertia * s->gear * d->qacc_warmstart[s->dof];
  double swings = m->dof_M0[s->dof] / (s->gear * s->gear); /* inertia of all that moves, at the shaft */
  double time = steps_of_the_spring * m->opt.timestep;
  s->stiffness = swings / (time * time);
  const mjtNum *state = d->plugin_state + m->plugin_stateadr[instance];
  double holding = s->stiffness * state[TWIST] + 2 * swings / time * speed;

  /* the root of what the shaft passes on at an assumed load, less that load: a secant, from the load of the last step */
  double arm = two_pi / LEAD, passed = arm * (torque - accelerating), scale = fabs(passed);
  double load = state[LAST_LOAD], friction = 0, before = 0, missed_before = 0;
  int found = 0;
  for (int turn = 0; turn < MOST_TURNS && !found; turn++) {
    s->limit = model(s, load, copysign(speed, holding));
    friction = clamped(holding, s->limit);
    double missed = passed - arm * friction - load;
    found = fabs(missed) <= close_enough * (scale + fabs(load));
    double slope = turn ? (missed - missed_before) / (load - before) : -1;
    before = load;
    missed_before = missed;
    load += slope < -0.1 ? -missed / slope : missed;
  }
  if (!found) s->sensed[HOLDS] = 0;
  s->sensed[LOAD] = passed - arm * friction;
  s->sensed[FRICTION] = friction;
  s->sensed[ACCELERATING] = accelerating;
  d->actuator_force[s->actuator] = torque - friction;
}

static void compute(const mjModel *m, mjData *d, int instance, int capability) {
  if (capability == mjPLUGIN_ACTUATOR) act(m, d, instance);
  if (capability == mjPLUGIN_SENSOR)
    for (int i = 0; i < m->nsensor; i++)
      for (int k = 0; k < SENSED && m->sensor_plugin[i] == instance; k++)
        d->sensordata[m->sensor_adr[i] + k] = screw_of(d, instance)->sensed[k];
}

/* After the velocities of a step: the spring is twisted by the turn, and slips. */
static void advance(const mjModel *m, mjData *d, int instance) {
  const Screw *s = screw_of(d, instance);
  mjtNum *state = d->plugin_state + m->plugin_stateadr[instance];
  double twist = state[TWIST] + s->gear * d->qvel[s->dof] * m->opt.timestep;
  state[TWIST] = clamped(twist, s->limit / s->stiffness);
  state[LAST_LOAD] = s->sensed[LOAD];
}

mjPLUGIN_LIB_INIT(ballscrew) {
  mjpPlugin plugin;
  memcpy(attributes, ballscrew_inputs, BALLSCREW_INPUT_COUNT * sizeof *attributes);
  attributes[BALLSCREW_INPUT_COUNT] = "inertia";
  mjp_defaultPlugin(&plugin);
  plugin.name = "@PLUGIN@";
  plugin.nattribute = BALLSCREW_INPUT_COUNT + 1;
  plugin.attributes = attributes;
  plugin.capabilityflags = mjPLUGIN_ACTUATOR | mjPLUGIN_SENSOR;
  plugin.needstage = mjSTAGE_ACC;
  plugin.nstate = state_size;
  plugin.nsensordata = sensor_size;
  plugin.init = create;
  plugin.destroy = destroy;
  plugin.copy = copy;
  plugin.reset = reset;
  plugin.compute = compute;
  plugin.advance = advance;
  mjp_registerPlugin(&plugin);
}
