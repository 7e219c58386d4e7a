/* The functions of an FMU, version 2.0 of the standard, for model exchange and for co-simulation. The model has no states. */
#include "fmi_model.h"

#include <stdlib.h>
#include <string.h>

#if defined(_WIN32)
#define FMI2_PUBLIC __declspec(dllexport)
#elif defined(__GNUC__)
#define FMI2_PUBLIC __attribute__((visibility("default")))
#else
#define FMI2_PUBLIC
#endif

typedef void *fmi2Component;
typedef void *fmi2ComponentEnvironment;
typedef void *fmi2FMUstate;
typedef unsigned int fmi2ValueReference;
typedef double fmi2Real;
typedef int fmi2Integer;
typedef int fmi2Boolean;
typedef const char *fmi2String;
typedef char fmi2Byte;
typedef enum { fmi2OK, fmi2Warning, fmi2Discard, fmi2Error, fmi2Fatal, fmi2Pending } fmi2Status;
typedef enum { fmi2ModelExchange, fmi2CoSimulation } fmi2Type;
typedef int fmi2StatusKind;

typedef struct {
    void (*logger)(fmi2ComponentEnvironment, fmi2String, fmi2Status, fmi2String, fmi2String, ...);
    void *(*allocateMemory)(size_t, size_t);
    void (*freeMemory)(void *);
    void (*stepFinished)(fmi2ComponentEnvironment, fmi2Status);
    fmi2ComponentEnvironment componentEnvironment;
} fmi2CallbackFunctions;

typedef struct {
    fmi2Boolean newDiscreteStatesNeeded, terminateSimulation, nominalsOfContinuousStatesChanged;
    fmi2Boolean valuesOfContinuousStatesChanged, nextEventTimeDefined;
    fmi2Real nextEventTime;
} fmi2EventInfo;

FMI2_PUBLIC const char *fmi2GetTypesPlatform(void)
{
    return "default";
}

FMI2_PUBLIC const char *fmi2GetVersion(void)
{
    return "2.0";
}

static int digit(char c)
{
    return c >= '0' && c <= '9' ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10 : c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

/* The path of a URI: file:/x, file:///x, and file:///C:/x; any other text is a path already. */
static char *path_of(const char *uri)
{
    char *const path = malloc(strlen(uri) + 1);
    char *to = path;
    if (path == NULL)
        return NULL;
    if (strncmp(uri, "file:", 5) != 0)
        return strcpy(path, uri);
    uri += 5;
    if (strncmp(uri, "//", 2) == 0) {
        uri += 2;
        while (*uri != '\0' && *uri != '/') /* the name of this machine */
            uri++;
    }
    if (uri[0] == '/' && uri[1] != '\0' && uri[2] == ':')
        uri++;
    while (*uri != '\0') {
        if (*uri == '%' && digit(uri[1]) >= 0 && digit(uri[2]) >= 0) {
            *to++ = (char)(16 * digit(uri[1]) + digit(uri[2]));
            uri += 3;
        } else
            *to++ = *uri++;
    }
    while (to > path + 1 && to[-1] == '/')
        to--;
    *to = '\0';
    return path;
}

FMI2_PUBLIC fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                                          const fmi2CallbackFunctions *functions, fmi2Boolean visible,
                                          fmi2Boolean logging)
{
    char *const path = resources == NULL ? NULL : path_of(resources);
    fmi_model *const model = path == NULL ? NULL : fmi_model_of(path);
    (void)type, (void)guid, (void)visible, (void)logging;
    free(path);
    if (model == NULL && functions != NULL && functions->logger != NULL)
        functions->logger(functions->componentEnvironment, name, fmi2Error, "logStatusError",
                          "resources/program.bin is missing or damaged");
    return model;
}

FMI2_PUBLIC void fmi2FreeInstance(fmi2Component c)
{
    fmi_model_free(c);
}

FMI2_PUBLIC fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, size_t n, const fmi2String categories[])
{
    (void)c, (void)on, (void)n, (void)categories;
    return fmi2OK;
}

FMI2_PUBLIC fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean has_tolerance, fmi2Real tolerance, fmi2Real start,
                                           fmi2Boolean has_stop, fmi2Real stop)
{
    (void)has_tolerance, (void)tolerance, (void)has_stop, (void)stop;
    return fmi_model_set_time(c, start) ? fmi2OK : fmi2Error;
}

#define NOTHING_TO_DO(name)                                                                                            \
    FMI2_PUBLIC fmi2Status name(fmi2Component c)                                                                       \
    {                                                                                                                  \
        return c == NULL ? fmi2Error : fmi2OK;                                                                         \
    }

NOTHING_TO_DO(fmi2EnterInitializationMode)
NOTHING_TO_DO(fmi2ExitInitializationMode)
NOTHING_TO_DO(fmi2Terminate)
NOTHING_TO_DO(fmi2EnterEventMode)
NOTHING_TO_DO(fmi2EnterContinuousTimeMode)
NOTHING_TO_DO(fmi2CancelStep)

FMI2_PUBLIC fmi2Status fmi2Reset(fmi2Component c)
{
    return fmi_model_reset(c) ? fmi2OK : fmi2Error;
}

FMI2_PUBLIC fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference vr[], size_t n, fmi2Real value[])
{
    return fmi_model_get(c, vr, n, value) ? fmi2OK : fmi2Error;
}

FMI2_PUBLIC fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference vr[], size_t n, const fmi2Real value[])
{
    return fmi_model_set(c, vr, n, value) ? fmi2OK : fmi2Error;
}

/* There are no variables of other types. */
#define NO_VARIABLES(name, type)                                                                                       \
    FMI2_PUBLIC fmi2Status name(fmi2Component c, const fmi2ValueReference vr[], size_t n, type value[])                \
    {                                                                                                                  \
        (void)vr, (void)value;                                                                                         \
        return c != NULL && n == 0 ? fmi2OK : fmi2Error;                                                               \
    }

NO_VARIABLES(fmi2GetInteger, fmi2Integer)
NO_VARIABLES(fmi2GetBoolean, fmi2Boolean)
NO_VARIABLES(fmi2GetString, fmi2String)
NO_VARIABLES(fmi2SetInteger, const fmi2Integer)
NO_VARIABLES(fmi2SetBoolean, const fmi2Boolean)
NO_VARIABLES(fmi2SetString, const fmi2String)

FMI2_PUBLIC fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *state)
{
    fmi2FMUstate copy;
    if (state == NULL || (copy = fmi_model_state(c, *state)) == NULL)
        return fmi2Error;
    *state = copy;
    return fmi2OK;
}

FMI2_PUBLIC fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate state)
{
    return fmi_model_return_to(c, state) ? fmi2OK : fmi2Error;
}

FMI2_PUBLIC fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *state)
{
    (void)c;
    if (state == NULL) /* which the standard wants ignored */
        return fmi2OK;
    free(*state);
    *state = NULL;
    return fmi2OK;
}

FMI2_PUBLIC fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate state, size_t *size)
{
    (void)c, (void)state, (void)size;
    return fmi2Error;
}

FMI2_PUBLIC fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[], size_t size)
{
    (void)c, (void)state, (void)bytes, (void)size;
    return fmi2Error;
}

FMI2_PUBLIC fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte bytes[], size_t size, fmi2FMUstate *state)
{
    (void)c, (void)bytes, (void)size, (void)state;
    return fmi2Error;
}

FMI2_PUBLIC fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference unknowns[], size_t n,
                                                    const fmi2ValueReference knowns[], size_t m, const fmi2Real by[],
                                                    fmi2Real found[])
{
    (void)c, (void)unknowns, (void)n, (void)knowns, (void)m, (void)by, (void)found;
    return fmi2Error;
}

/* Model exchange, without states and without events. */

FMI2_PUBLIC fmi2Status fmi2NewDiscreteStates(fmi2Component c, fmi2EventInfo *info)
{
    if (c == NULL || info == NULL)
        return fmi2Error;
    memset(info, 0, sizeof *info);
    return fmi2OK;
}

FMI2_PUBLIC fmi2Status fmi2CompletedIntegratorStep(fmi2Component c, fmi2Boolean final, fmi2Boolean *enter_event_mode,
                                                   fmi2Boolean *terminate)
{
    (void)final;
    if (c == NULL || enter_event_mode == NULL || terminate == NULL)
        return fmi2Error;
    *enter_event_mode = *terminate = 0;
    return fmi2OK;
}

FMI2_PUBLIC fmi2Status fmi2SetTime(fmi2Component c, fmi2Real time)
{
    return fmi_model_set_time(c, time) ? fmi2OK : fmi2Error;
}

#define NO_STATES(name, type)                                                                                          \
    FMI2_PUBLIC fmi2Status name(fmi2Component c, type values[], size_t n)                                              \
    {                                                                                                                  \
        (void)values;                                                                                                  \
        return c != NULL && n == 0 ? fmi2OK : fmi2Error;                                                               \
    }

NO_STATES(fmi2SetContinuousStates, const fmi2Real)
NO_STATES(fmi2GetDerivatives, fmi2Real)
NO_STATES(fmi2GetEventIndicators, fmi2Real)
NO_STATES(fmi2GetContinuousStates, fmi2Real)
NO_STATES(fmi2GetNominalsOfContinuousStates, fmi2Real)

/* Co-simulation. */

FMI2_PUBLIC fmi2Status fmi2DoStep(fmi2Component c, fmi2Real time, fmi2Real step, fmi2Boolean no_return)
{
    (void)no_return;
    return fmi_model_step(c, time, step) ? fmi2OK : fmi2Error;
}

FMI2_PUBLIC fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                                                   const fmi2Integer order[], const fmi2Real value[])
{
    (void)vr, (void)order, (void)value;
    return c != NULL && n == 0 ? fmi2OK : fmi2Error;
}

FMI2_PUBLIC fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                                                    const fmi2Integer order[], fmi2Real value[])
{
    (void)vr, (void)order, (void)value;
    return c != NULL && n == 0 ? fmi2OK : fmi2Error;
}

#define NO_STATUS(name, type)                                                                                          \
    FMI2_PUBLIC fmi2Status name(fmi2Component c, const fmi2StatusKind kind, type *value)                               \
    {                                                                                                                  \
        (void)c, (void)kind, (void)value;                                                                              \
        return fmi2Discard;                                                                                            \
    }

NO_STATUS(fmi2GetStatus, fmi2Status)
NO_STATUS(fmi2GetRealStatus, fmi2Real)
NO_STATUS(fmi2GetIntegerStatus, fmi2Integer)
NO_STATUS(fmi2GetBooleanStatus, fmi2Boolean)
NO_STATUS(fmi2GetStringStatus, fmi2String)
