/* The functions of an FMU, version 3.0 of the standard, for model exchange and for co-simulation. The model has no states.

   What this model has nothing of (other types, clocks, events, states) is answered in one way: nothing asked for is
   fine, anything else an error. Pointers to values of other types are declared as pointers to anything. */
#include "fmi_model.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>

#if defined(_WIN32)
#define FMI3_PUBLIC __declspec(dllexport)
#elif defined(__GNUC__)
#define FMI3_PUBLIC __attribute__((visibility("default")))
#else
#define FMI3_PUBLIC
#endif

typedef void *fmi3Instance;
typedef void *fmi3InstanceEnvironment;
typedef void *fmi3FMUState;
typedef uint32_t fmi3ValueReference;
typedef double fmi3Float64;
typedef int32_t fmi3Int32;
typedef bool fmi3Boolean;
typedef const char *fmi3String;
typedef uint8_t fmi3Byte;
typedef enum { fmi3OK, fmi3Warning, fmi3Discard, fmi3Error, fmi3Fatal } fmi3Status;
typedef void (*fmi3LogMessageCallback)(fmi3InstanceEnvironment, fmi3Status, fmi3String, fmi3String);
typedef void (*fmi3Callback)(void);

FMI3_PUBLIC const char *fmi3GetVersion(void)
{
    return "3.0";
}

static fmi3Instance instance_of(fmi3String resources, fmi3InstanceEnvironment environment, fmi3LogMessageCallback log)
{
    fmi_model *const model = resources == NULL ? NULL : fmi_model_of(resources);
    if (model == NULL && log != NULL)
        log(environment, fmi3Error, "logStatusError", "resources/program.bin is missing or damaged");
    return model;
}

FMI3_PUBLIC fmi3Instance fmi3InstantiateModelExchange(fmi3String name, fmi3String token, fmi3String resources,
                                                      fmi3Boolean visible, fmi3Boolean logging,
                                                      fmi3InstanceEnvironment environment, fmi3LogMessageCallback log)
{
    (void)name, (void)token, (void)visible, (void)logging;
    return instance_of(resources, environment, log);
}

FMI3_PUBLIC fmi3Instance fmi3InstantiateCoSimulation(fmi3String name, fmi3String token, fmi3String resources,
                                                     fmi3Boolean visible, fmi3Boolean logging, fmi3Boolean event_mode,
                                                     fmi3Boolean early_return, const fmi3ValueReference intermediate[],
                                                     size_t n, fmi3InstanceEnvironment environment,
                                                     fmi3LogMessageCallback log, fmi3Callback intermediate_update)
{
    (void)name, (void)token, (void)visible, (void)logging, (void)event_mode, (void)early_return, (void)intermediate;
    (void)n, (void)intermediate_update;
    return instance_of(resources, environment, log);
}

FMI3_PUBLIC fmi3Instance fmi3InstantiateScheduledExecution(fmi3String name, fmi3String token, fmi3String resources,
                                                           fmi3Boolean visible, fmi3Boolean logging,
                                                           fmi3InstanceEnvironment environment,
                                                           fmi3LogMessageCallback log, fmi3Callback clock_update,
                                                           fmi3Callback lock, fmi3Callback unlock)
{
    (void)name, (void)token, (void)resources, (void)visible, (void)logging, (void)environment, (void)log;
    (void)clock_update, (void)lock, (void)unlock;
    return NULL;
}

FMI3_PUBLIC void fmi3FreeInstance(fmi3Instance c)
{
    fmi_model_free(c);
}

FMI3_PUBLIC fmi3Status fmi3SetDebugLogging(fmi3Instance c, fmi3Boolean on, size_t n, const fmi3String categories[])
{
    (void)c, (void)on, (void)n, (void)categories;
    return fmi3OK;
}

FMI3_PUBLIC fmi3Status fmi3EnterInitializationMode(fmi3Instance c, fmi3Boolean has_tolerance, fmi3Float64 tolerance,
                                                   fmi3Float64 start, fmi3Boolean has_stop, fmi3Float64 stop)
{
    (void)has_tolerance, (void)tolerance, (void)has_stop, (void)stop;
    return fmi_model_set_time(c, start) ? fmi3OK : fmi3Error;
}

#define NOTHING_TO_DO(name)                                                                                            \
    FMI3_PUBLIC fmi3Status name(fmi3Instance c)                                                                        \
    {                                                                                                                  \
        return c == NULL ? fmi3Error : fmi3OK;                                                                         \
    }

NOTHING_TO_DO(fmi3ExitInitializationMode)
NOTHING_TO_DO(fmi3EnterEventMode)
NOTHING_TO_DO(fmi3Terminate)
NOTHING_TO_DO(fmi3EnterConfigurationMode)
NOTHING_TO_DO(fmi3ExitConfigurationMode)
NOTHING_TO_DO(fmi3EvaluateDiscreteStates)
NOTHING_TO_DO(fmi3EnterContinuousTimeMode)
NOTHING_TO_DO(fmi3EnterStepMode)

FMI3_PUBLIC fmi3Status fmi3Reset(fmi3Instance c)
{
    return fmi_model_reset(c) ? fmi3OK : fmi3Error;
}

FMI3_PUBLIC fmi3Status fmi3GetFloat64(fmi3Instance c, const fmi3ValueReference vr[], size_t n, fmi3Float64 values[],
                                      size_t m)
{
    return n == m && fmi_model_get(c, vr, n, values) ? fmi3OK : fmi3Error;
}

FMI3_PUBLIC fmi3Status fmi3SetFloat64(fmi3Instance c, const fmi3ValueReference vr[], size_t n,
                                      const fmi3Float64 values[], size_t m)
{
    return n == m && fmi_model_set(c, vr, n, values) ? fmi3OK : fmi3Error;
}

#define NO_VARIABLES(name)                                                                                             \
    FMI3_PUBLIC fmi3Status name(fmi3Instance c, const fmi3ValueReference vr[], size_t n, const void *values, size_t m) \
    {                                                                                                                  \
        (void)vr, (void)values;                                                                                        \
        return c != NULL && n == 0 && m == 0 ? fmi3OK : fmi3Error;                                                     \
    }

NO_VARIABLES(fmi3GetFloat32)
NO_VARIABLES(fmi3GetInt8)
NO_VARIABLES(fmi3GetUInt8)
NO_VARIABLES(fmi3GetInt16)
NO_VARIABLES(fmi3GetUInt16)
NO_VARIABLES(fmi3GetInt32)
NO_VARIABLES(fmi3GetUInt32)
NO_VARIABLES(fmi3GetInt64)
NO_VARIABLES(fmi3GetUInt64)
NO_VARIABLES(fmi3GetBoolean)
NO_VARIABLES(fmi3GetString)
NO_VARIABLES(fmi3SetFloat32)
NO_VARIABLES(fmi3SetInt8)
NO_VARIABLES(fmi3SetUInt8)
NO_VARIABLES(fmi3SetInt16)
NO_VARIABLES(fmi3SetUInt16)
NO_VARIABLES(fmi3SetInt32)
NO_VARIABLES(fmi3SetUInt32)
NO_VARIABLES(fmi3SetInt64)
NO_VARIABLES(fmi3SetUInt64)
NO_VARIABLES(fmi3SetBoolean)
NO_VARIABLES(fmi3SetString)

#define NO_BINARIES(name)                                                                                              \
    FMI3_PUBLIC fmi3Status name(fmi3Instance c, const fmi3ValueReference vr[], size_t n, const size_t *sizes,          \
                                const void *values, size_t m)                                                          \
    {                                                                                                                  \
        (void)vr, (void)sizes, (void)values;                                                                           \
        return c != NULL && n == 0 && m == 0 ? fmi3OK : fmi3Error;                                                     \
    }

NO_BINARIES(fmi3GetBinary)
NO_BINARIES(fmi3SetBinary)

/* Clocks, their intervals and shifts. */
#define NO_CLOCKS(name)                                                                                                \
    FMI3_PUBLIC fmi3Status name(fmi3Instance c, const fmi3ValueReference vr[], size_t n, const void *values)           \
    {                                                                                                                  \
        (void)vr, (void)values;                                                                                        \
        return c != NULL && n == 0 ? fmi3OK : fmi3Error;                                                               \
    }
#define NO_CLOCKS_OF_TWO(name)                                                                                         \
    FMI3_PUBLIC fmi3Status name(fmi3Instance c, const fmi3ValueReference vr[], size_t n, const void *values,           \
                                const void *others)                                                                    \
    {                                                                                                                  \
        (void)vr, (void)values, (void)others;                                                                          \
        return c != NULL && n == 0 ? fmi3OK : fmi3Error;                                                               \
    }

NO_CLOCKS(fmi3GetClock)
NO_CLOCKS(fmi3SetClock)
NO_CLOCKS(fmi3GetShiftDecimal)
NO_CLOCKS(fmi3SetShiftDecimal)
NO_CLOCKS(fmi3SetIntervalDecimal)
NO_CLOCKS_OF_TWO(fmi3GetIntervalDecimal)
NO_CLOCKS_OF_TWO(fmi3GetShiftFraction)
NO_CLOCKS_OF_TWO(fmi3SetIntervalFraction)
NO_CLOCKS_OF_TWO(fmi3SetShiftFraction)

FMI3_PUBLIC fmi3Status fmi3GetIntervalFraction(fmi3Instance c, const fmi3ValueReference vr[], size_t n,
                                               const void *counters, const void *resolutions, const void *qualifiers)
{
    (void)vr, (void)counters, (void)resolutions, (void)qualifiers;
    return c != NULL && n == 0 ? fmi3OK : fmi3Error;
}

FMI3_PUBLIC fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance c, fmi3ValueReference vr, size_t *n)
{
    (void)c, (void)vr, (void)n;
    return fmi3Error;
}

FMI3_PUBLIC fmi3Status fmi3GetVariableDependencies(fmi3Instance c, fmi3ValueReference dependent, const size_t *elements,
                                                   const fmi3ValueReference *independents, const size_t *others,
                                                   const void *kinds, size_t n)
{
    (void)c, (void)dependent, (void)elements, (void)independents, (void)others, (void)kinds, (void)n;
    return fmi3Error;
}

FMI3_PUBLIC fmi3Status fmi3GetFMUState(fmi3Instance c, fmi3FMUState *state)
{
    fmi3FMUState copy;
    if (state == NULL || (copy = fmi_model_state(c, *state)) == NULL)
        return fmi3Error;
    *state = copy;
    return fmi3OK;
}

FMI3_PUBLIC fmi3Status fmi3SetFMUState(fmi3Instance c, fmi3FMUState state)
{
    return fmi_model_return_to(c, state) ? fmi3OK : fmi3Error;
}

FMI3_PUBLIC fmi3Status fmi3FreeFMUState(fmi3Instance c, fmi3FMUState *state)
{
    (void)c;
    if (state == NULL) /* which the standard wants ignored */
        return fmi3OK;
    free(*state);
    *state = NULL;
    return fmi3OK;
}

FMI3_PUBLIC fmi3Status fmi3SerializedFMUStateSize(fmi3Instance c, fmi3FMUState state, size_t *size)
{
    (void)c, (void)state, (void)size;
    return fmi3Error;
}

FMI3_PUBLIC fmi3Status fmi3SerializeFMUState(fmi3Instance c, fmi3FMUState state, fmi3Byte bytes[], size_t size)
{
    (void)c, (void)state, (void)bytes, (void)size;
    return fmi3Error;
}

FMI3_PUBLIC fmi3Status fmi3DeserializeFMUState(fmi3Instance c, const fmi3Byte bytes[], size_t size, fmi3FMUState *state)
{
    (void)c, (void)bytes, (void)size, (void)state;
    return fmi3Error;
}

#define NO_DERIVATIVES(name)                                                                                           \
    FMI3_PUBLIC fmi3Status name(fmi3Instance c, const fmi3ValueReference unknowns[], size_t n_unknowns,                \
                                const fmi3ValueReference knowns[], size_t n_knowns, const fmi3Float64 seed[],          \
                                size_t n_seed, fmi3Float64 found[], size_t n_found)                                    \
    {                                                                                                                  \
        (void)c, (void)unknowns, (void)n_unknowns, (void)knowns, (void)n_knowns, (void)seed, (void)n_seed;             \
        (void)found, (void)n_found;                                                                                    \
        return fmi3Error;                                                                                              \
    }

NO_DERIVATIVES(fmi3GetDirectionalDerivative)
NO_DERIVATIVES(fmi3GetAdjointDerivative)

/* Model exchange, without states and without events. */

FMI3_PUBLIC fmi3Status fmi3UpdateDiscreteStates(fmi3Instance c, fmi3Boolean *update, fmi3Boolean *terminate,
                                                fmi3Boolean *nominals_changed, fmi3Boolean *values_changed,
                                                fmi3Boolean *has_next_event, fmi3Float64 *next_event)
{
    if (c == NULL || update == NULL || terminate == NULL || nominals_changed == NULL || values_changed == NULL
        || has_next_event == NULL || next_event == NULL)
        return fmi3Error;
    *update = *terminate = *nominals_changed = *values_changed = *has_next_event = false;
    *next_event = 0.0;
    return fmi3OK;
}

FMI3_PUBLIC fmi3Status fmi3CompletedIntegratorStep(fmi3Instance c, fmi3Boolean final, fmi3Boolean *enter_event_mode,
                                                   fmi3Boolean *terminate)
{
    (void)final;
    if (c == NULL || enter_event_mode == NULL || terminate == NULL)
        return fmi3Error;
    *enter_event_mode = *terminate = false;
    return fmi3OK;
}

FMI3_PUBLIC fmi3Status fmi3SetTime(fmi3Instance c, fmi3Float64 time)
{
    return fmi_model_set_time(c, time) ? fmi3OK : fmi3Error;
}

#define NO_STATES(name)                                                                                                \
    FMI3_PUBLIC fmi3Status name(fmi3Instance c, const fmi3Float64 *values, size_t n)                                   \
    {                                                                                                                  \
        (void)values;                                                                                                  \
        return c != NULL && n == 0 ? fmi3OK : fmi3Error;                                                               \
    }

NO_STATES(fmi3SetContinuousStates)
NO_STATES(fmi3GetContinuousStateDerivatives)
NO_STATES(fmi3GetEventIndicators)
NO_STATES(fmi3GetContinuousStates)
NO_STATES(fmi3GetNominalsOfContinuousStates)

#define NONE(name)                                                                                                     \
    FMI3_PUBLIC fmi3Status name(fmi3Instance c, size_t *n)                                                             \
    {                                                                                                                  \
        if (c == NULL || n == NULL)                                                                                    \
            return fmi3Error;                                                                                          \
        *n = 0;                                                                                                        \
        return fmi3OK;                                                                                                 \
    }

NONE(fmi3GetNumberOfEventIndicators)
NONE(fmi3GetNumberOfContinuousStates)

/* Co-simulation. */

FMI3_PUBLIC fmi3Status fmi3GetOutputDerivatives(fmi3Instance c, const fmi3ValueReference vr[], size_t n,
                                                const fmi3Int32 orders[], fmi3Float64 values[], size_t m)
{
    (void)vr, (void)orders, (void)values;
    return c != NULL && n == 0 && m == 0 ? fmi3OK : fmi3Error;
}

FMI3_PUBLIC fmi3Status fmi3DoStep(fmi3Instance c, fmi3Float64 time, fmi3Float64 step, fmi3Boolean final,
                                  fmi3Boolean *event, fmi3Boolean *terminate, fmi3Boolean *early_return,
                                  fmi3Float64 *last_time)
{
    (void)final;
    if (event == NULL || terminate == NULL || early_return == NULL || last_time == NULL || !fmi_model_step(c, time, step))
        return fmi3Error;
    *event = *terminate = *early_return = false;
    *last_time = time + step;
    return fmi3OK;
}

FMI3_PUBLIC fmi3Status fmi3ActivateModelPartition(fmi3Instance c, fmi3ValueReference clock, fmi3Float64 time)
{
    (void)c, (void)clock, (void)time;
    return fmi3Error;
}
