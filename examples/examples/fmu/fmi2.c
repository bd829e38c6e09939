/* A machine of `emit { c }` behind the functions of FMI 2.0 for model exchange. What it is made of is in model.h. */
#include <stdlib.h>
#include <string.h>
#include "model.h"

typedef enum { OK, WARNING, DISCARD, ERROR, FATAL, PENDING } Status;
typedef struct {
    int new_discrete_states_needed, terminate, nominals_changed, values_changed, next_event_defined;
    double next_event;
} Events;
typedef struct {
    double t;
    Parameters parameters;
    State state;
    Input input;
} Instance;

#if defined _WIN32
#define EXPORT __declspec(dllexport)
#else
#define EXPORT __attribute__((visibility("default")))
#endif

enum { SET = STATES + INPUTS + PARAMETERS };

/* the place of a variable: states, rates, inputs, parameters, energy; rates and energy have none */
static double *place(Instance *instance, unsigned reference)
{
    double *const places[SET] = PLACES(instance);
    if (reference < STATES)
        return places[reference];
    if (reference < 2 * STATES || reference >= STATES + SET)
        return NULL;
    return places[reference - STATES];
}

static void start(Instance *instance)
{
    double *const places[SET] = PLACES(instance);
    for (int k = 0; k < SET; k++)
        *places[k] = START[k];
    instance->t = 0;
}

static void rates(const Instance *instance, double *values)
{
    State rate;
    DERIVATIVE(&instance->parameters, instance->t, &instance->state, &instance->input, &rate);
    memcpy(values, &rate, sizeof rate);
}

EXPORT const char *fmi2GetTypesPlatform(void) { return "default"; }
EXPORT const char *fmi2GetVersion(void) { return "2.0"; }

EXPORT void *fmi2Instantiate(const char *name, int kind, const char *guid, const char *resources,
                             const void *callbacks, int visible, int logging)
{
    (void)name, (void)resources, (void)callbacks, (void)visible, (void)logging;
    /* model exchange is 0; of another model this knows nothing */
    if (kind != 0 || strcmp(guid, GUID) != 0)
        return NULL;
    Instance *instance = malloc(sizeof *instance);
    if (instance)
        start(instance);
    return instance;
}

EXPORT void fmi2FreeInstance(void *instance) { free(instance); }

EXPORT Status fmi2Reset(void *instance)
{
    start(instance);
    return OK;
}

EXPORT Status fmi2SetupExperiment(void *instance, int has_tolerance, double tolerance, double t, int has_end, double end)
{
    (void)has_tolerance, (void)tolerance, (void)has_end, (void)end;
    ((Instance *)instance)->t = t;
    return OK;
}

EXPORT Status fmi2SetTime(void *instance, double t)
{
    ((Instance *)instance)->t = t;
    return OK;
}

EXPORT Status fmi2SetReal(void *instance, const unsigned *references, size_t count, const double *values)
{
    for (size_t k = 0; k < count; k++) {
        double *at = place(instance, references[k]);
        if (!at)
            return ERROR;
        *at = values[k];
    }
    return OK;
}

EXPORT Status fmi2GetReal(void *instance, const unsigned *references, size_t count, double *values)
{
    const Instance *of = instance;
    double rate[STATES], energy[1];
    rates(of, rate);
    ENERGY(&of->parameters, of->t, &of->state, energy);
    for (size_t k = 0; k < count; k++) {
        const unsigned reference = references[k];
        const double *at = place(instance, reference);
        if (at)
            values[k] = *at;
        else if (reference < 2 * STATES)
            values[k] = rate[reference - STATES];
        else if (reference == STATES + SET)
            values[k] = energy[0];
        else
            return ERROR;
    }
    return OK;
}

EXPORT Status fmi2SetContinuousStates(void *instance, const double *values, size_t count)
{
    if (count != STATES)
        return ERROR;
    memcpy(&((Instance *)instance)->state, values, sizeof(State));
    return OK;
}

EXPORT Status fmi2GetContinuousStates(void *instance, double *values, size_t count)
{
    if (count != STATES)
        return ERROR;
    memcpy(values, &((Instance *)instance)->state, sizeof(State));
    return OK;
}

EXPORT Status fmi2GetDerivatives(void *instance, double *values, size_t count)
{
    if (count != STATES)
        return ERROR;
    rates(instance, values);
    return OK;
}

EXPORT Status fmi2GetNominalsOfContinuousStates(void *instance, double *values, size_t count)
{
    (void)instance;
    for (size_t k = 0; k < count; k++)
        values[k] = 1;
    return OK;
}

EXPORT Status fmi2NewDiscreteStates(void *instance, Events *events)
{
    (void)instance;
    memset(events, 0, sizeof *events);
    return OK;
}

EXPORT Status fmi2CompletedIntegratorStep(void *instance, int no_return, int *enter_events, int *terminate)
{
    (void)instance, (void)no_return;
    *enter_events = *terminate = 0;
    return OK;
}

/* stages that change nothing here */
EXPORT Status fmi2EnterInitializationMode(void *instance) { (void)instance; return OK; }
EXPORT Status fmi2ExitInitializationMode(void *instance) { (void)instance; return OK; }
EXPORT Status fmi2EnterEventMode(void *instance) { (void)instance; return OK; }
EXPORT Status fmi2EnterContinuousTimeMode(void *instance) { (void)instance; return OK; }
EXPORT Status fmi2Terminate(void *instance) { (void)instance; return OK; }

/* what there is nothing of: events, and variables that are no real numbers */
#define NONE(name, ...) EXPORT Status name(void *instance, __VA_ARGS__, size_t count, void *values)
NONE(fmi2GetInteger, const unsigned *references) { (void)instance, (void)references, (void)values; return count ? ERROR : OK; }
NONE(fmi2GetBoolean, const unsigned *references) { (void)instance, (void)references, (void)values; return count ? ERROR : OK; }
NONE(fmi2GetString, const unsigned *references) { (void)instance, (void)references, (void)values; return count ? ERROR : OK; }
NONE(fmi2SetInteger, const unsigned *references) { (void)instance, (void)references, (void)values; return count ? ERROR : OK; }
NONE(fmi2SetBoolean, const unsigned *references) { (void)instance, (void)references, (void)values; return count ? ERROR : OK; }
NONE(fmi2SetString, const unsigned *references) { (void)instance, (void)references, (void)values; return count ? ERROR : OK; }

EXPORT Status fmi2GetEventIndicators(void *instance, double *values, size_t count)
{
    (void)instance, (void)values;
    return count ? ERROR : OK;
}

EXPORT Status fmi2SetDebugLogging(void *instance, int on, size_t count, const void *categories)
{
    (void)instance, (void)on, (void)count, (void)categories;
    return OK;
}

/* copies of an instance, kept by the simulator */
EXPORT Status fmi2GetFMUstate(void *instance, void **copy)
{
    if (!*copy)
        *copy = malloc(sizeof(Instance));
    if (!*copy)
        return ERROR;
    memcpy(*copy, instance, sizeof(Instance));
    return OK;
}

EXPORT Status fmi2SetFMUstate(void *instance, const void *copy)
{
    memcpy(instance, copy, sizeof(Instance));
    return OK;
}

EXPORT Status fmi2FreeFMUstate(void *instance, void **copy)
{
    (void)instance;
    free(*copy);
    *copy = NULL;
    return OK;
}

EXPORT Status fmi2SerializedFMUstateSize(void *instance, const void *copy, size_t *size)
{
    (void)instance, (void)copy;
    *size = sizeof(Instance);
    return OK;
}

EXPORT Status fmi2SerializeFMUstate(void *instance, const void *copy, char *bytes, size_t size)
{
    (void)instance;
    if (size < sizeof(Instance))
        return ERROR;
    memcpy(bytes, copy, sizeof(Instance));
    return OK;
}

EXPORT Status fmi2DeSerializeFMUstate(void *instance, const char *bytes, size_t size, void **copy)
{
    (void)instance;
    return size < sizeof(Instance) ? ERROR : fmi2GetFMUstate((void *)bytes, copy);
}

/* not provided, as the description says */
EXPORT Status fmi2GetDirectionalDerivative(void *instance, const unsigned *of, size_t count, const unsigned *along,
                                           size_t directions, const double *seed, double *values)
{
    (void)instance, (void)of, (void)count, (void)along, (void)directions, (void)seed, (void)values;
    return ERROR;
}
