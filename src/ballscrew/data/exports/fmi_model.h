/* The model behind an FMU, the same for versions 2 and 3 of the standard. */
#ifndef BALLSCREW_FMI_MODEL_H
#define BALLSCREW_FMI_MODEL_H

#include <stddef.h>

/* Values by their value references: the inputs of the program, the speed of regularisation, the outputs of the program,
   the friction torque with its sign, and the time. */
typedef struct fmi_model fmi_model;

/* The model of a folder of resources; NULL where its program is missing or damaged. */
fmi_model *fmi_model_of(const char *folder);
void fmi_model_free(fmi_model *model);

/* Those that return a number return 0 for what they refuse, and change nothing then: no model, no values, a time that is
   not finite, a step that is not above zero, a value that is not there or cannot be set. */
int fmi_model_reset(fmi_model *model);
int fmi_model_set_time(fmi_model *model, double time);
int fmi_model_step(fmi_model *model, double time, double step);
int fmi_model_get(fmi_model *model, const unsigned references[], size_t n, double values[]);
int fmi_model_set(fmi_model *model, const unsigned references[], size_t n, const double values[]);

/* A copy of all values, to be given back with free(), and the return to it; no copy without a model or without memory. */
double *fmi_model_state(const fmi_model *model, double *into);
int fmi_model_return_to(fmi_model *model, const double *state);

#endif
