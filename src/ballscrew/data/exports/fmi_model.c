/* The model behind an FMU: a program, and friction that is continuous through rest.

   The friction torque with its sign is tanh(speed / regularisation speed) times its size, and the drive torque is the
   ideal torque and this. From twenty times the regularisation speed on, both are those of the model to the last digit.
   At a regularisation speed of zero the sign of the speed counts. Friction that is made continuous holds nothing: at
   rest a load creeps. */
#include "fmi_model.h"

#include "ballscrew_program.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct fmi_model {
    ballscrew_program *program;
    double *values;
    size_t inputs, outputs, size;
    size_t speed, size_of_friction, ideal, drive;
    int is_current;
};

static const double REGULARISATION_SPEED = 0.01;

static size_t length(const char *const *names)
{
    size_t n = 0;
    while (names[n] != NULL)
        n++;
    return n;
}

static size_t place(const char *const *names, const char *name)
{
    size_t i = 0;
    while (names[i] != NULL && strcmp(names[i], name) != 0)
        i++;
    return i;
}

int fmi_model_reset(fmi_model *m)
{
    size_t i;
    if (m == NULL)
        return 0;
    for (i = 0; i < m->size; i++)
        m->values[i] = 0.0;
    memcpy(m->values, ballscrew_program_usual(m->program), m->inputs * sizeof *m->values);
    m->values[m->inputs] = REGULARISATION_SPEED;
    m->is_current = 0;
    return 1;
}

fmi_model *fmi_model_of(const char *folder)
{
    static const char name[] = "/program.bin";
    const char *const *inputs, *const *outputs;
    fmi_model *m = calloc(1, sizeof *m);
    char *path = malloc(strlen(folder) + sizeof name);
    if (m != NULL && path != NULL) {
        strcpy(path, folder);
        strcat(path, name);
        m->program = ballscrew_program_read(path);
    }
    free(path);
    if (m == NULL || m->program == NULL) {
        free(m);
        return NULL;
    }
    inputs = ballscrew_program_inputs(m->program);
    outputs = ballscrew_program_outputs(m->program);
    m->inputs = length(inputs);
    m->outputs = length(outputs);
    m->size = m->inputs + m->outputs + 3;
    m->speed = place(inputs, "screw_speed");
    m->size_of_friction = place(outputs, "screw_torque");
    m->ideal = place(outputs, "ideal_torque");
    m->drive = place(outputs, "drive_torque");
    m->values = malloc(m->size * sizeof *m->values);
    if (m->values == NULL || m->speed == m->inputs || m->size_of_friction == m->outputs || m->ideal == m->outputs
        || m->drive == m->outputs) {
        fmi_model_free(m);
        return NULL;
    }
    fmi_model_reset(m);
    return m;
}

void fmi_model_free(fmi_model *m)
{
    if (m == NULL)
        return;
    ballscrew_program_free(m->program);
    free(m->values);
    free(m);
}

int fmi_model_set_time(fmi_model *m, double time)
{
    if (m == NULL || !isfinite(time))
        return 0;
    m->values[m->size - 1] = time;
    return 1;
}

int fmi_model_step(fmi_model *m, double time, double step)
{
    return isfinite(time) && step > 0.0 && fmi_model_set_time(m, time + step);
}

static void evaluate(fmi_model *m)
{
    double *const found = m->values + m->inputs + 1;
    const double speed = m->values[m->speed], width = m->values[m->inputs];
    const double sign = speed > 0.0 ? 1.0 : speed < 0.0 ? -1.0 : 0.0;
    double friction;
    ballscrew_program_evaluate(m->program, m->values, found);
    friction = (width > 0.0 ? tanh(speed / width) : sign) * found[m->size_of_friction];
    found[m->drive] = found[m->ideal] + friction;
    found[m->outputs] = friction;
    m->is_current = 1;
}

int fmi_model_get(fmi_model *m, const unsigned references[], size_t n, double values[])
{
    size_t i;
    if (m == NULL || (n > 0 && (references == NULL || values == NULL)))
        return 0;
    for (i = 0; i < n; i++)
        if (references[i] >= m->size)
            return 0;
    for (i = 0; i < n; i++) {
        if (!m->is_current && references[i] > m->inputs && references[i] < m->size - 1)
            evaluate(m);
        values[i] = m->values[references[i]];
    }
    return 1;
}

int fmi_model_set(fmi_model *m, const unsigned references[], size_t n, const double values[])
{
    size_t i;
    if (m == NULL || (n > 0 && (references == NULL || values == NULL)))
        return 0;
    for (i = 0; i < n; i++)
        if (references[i] > m->inputs)
            return 0;
    for (i = 0; i < n; i++) {
        m->is_current = m->is_current && m->values[references[i]] == values[i];
        m->values[references[i]] = values[i];
    }
    return 1;
}

double *fmi_model_state(const fmi_model *m, double *into)
{
    double *const state = m == NULL ? NULL : into != NULL ? into : malloc(m->size * sizeof *state);
    if (state != NULL)
        memcpy(state, m->values, m->size * sizeof *state);
    return state;
}

int fmi_model_return_to(fmi_model *m, const double *state)
{
    if (m == NULL || state == NULL)
        return 0;
    memcpy(m->values, state, m->size * sizeof *state);
    m->is_current = 0;
    return 1;
}
