/* fmi2_functions.c - the functions of FMI 2.0 (model exchange and co-simulation) over the instance.
 *
 * Conventions of this layer: a call that the state machine forbids, a null pointer, a wrong count or reference
 * is answered with fmi2Error and leaves the instance as it was; a failure of the model itself ends in the error
 * state, from which fmi2Reset, fmi2SetFMUstate and fmi2FreeInstance lead out. Nothing here ends the process. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cmb_access.h"
#include "cmb_derivative.h"
#include "cmb_evaluate.h"
#include "cmb_event.h"
#include "cmb_instance.h"
#include "cmb_solver.h"
#include "cmb_state.h"
#include "cmb_step.h"
#include "fmi2Functions.h"

typedef struct component {
  cmb_instance *instance;
  fmi2CallbackFunctions callbacks;
  fmi2Type type;
  double last_successful_time; /* of a discarded step */
  fmi2Status step_status;
} component;

enum {
  BEFORE_START = CMB_PHASE_INSTANTIATED | CMB_PHASE_INITIALIZATION,
  MODEL_EXCHANGE = CMB_PHASE_EVENT | CMB_PHASE_CONTINUOUS,
  CO_SIMULATION = CMB_PHASE_STEP | CMB_PHASE_STEP_FAILED,
  AFTER_END = CMB_PHASE_TERMINATED | CMB_PHASE_ERROR,
  ANY_PHASE = BEFORE_START | MODEL_EXCHANGE | CO_SIMULATION | AFTER_END
};

/* -- logging -- */

static fmi2Status to_status(cmb_severity severity) {
  switch (severity) {
    case CMB_LOG_DEBUG: return fmi2OK;
    case CMB_LOG_WARNING: return fmi2Warning;
    case CMB_LOG_DISCARD: return fmi2Discard;
    case CMB_LOG_ERROR: return fmi2Error;
  }
  return fmi2Error;
}

/* The message is the format itself, without arguments, so that importers whose logger cannot read variable
 * arguments show it too. In it "%" is doubled, and "#", which introduces a value reference (section 2.1.5). */
static void double_special(const char *message, char *format, size_t size) {
  size_t length = 0;
  for (; *message != '\0' && length + 2 < size; ++message) {
    if (*message == '#' || *message == '%') format[length++] = *message;
    format[length++] = *message;
  }
  format[length] = '\0';
}

static void log_to_importer(void *receiver, const char *instance_name, cmb_severity severity,
                            cmb_log_category category, const char *message) {
  const component *c = receiver;
  if (c->callbacks.logger == NULL) return;
  char format[2200];
  double_special(message, format, sizeof format);
  c->callbacks.logger(c->callbacks.componentEnvironment, instance_name, to_status(severity),
                      cmb_log_category_name[category], format);
}

/* -- checks and results -- */

static fmi2Status refuse(component *c, const char *function, const char *reason) {
  cmb_log(c->instance, CMB_LOG_ERROR, CMB_LOG_STATUS_ERROR, "%s: %s", function, reason);
  return fmi2Error;
}

/* The component if the call is permitted now, NULL if not (logged). */
static component *permitted(fmi2Component pointer, const char *function, int phases) {
  component *c = pointer;
  if (c == NULL) return NULL;
  if (c->instance->situation.phase & phases) return c;
  refuse(c, function, "not permitted in the present state of the FMU");
  return NULL;
}

static fmi2Status reject_call(component *c, const char *function) { return refuse(c, function, c->instance->message); }

/* Outcome of an evaluation of the model: an error ends in the error state. */
static fmi2Status finish(component *c, const char *function, cmb_result result) {
  switch (result) {
    case CMB_RESULT_OK: return fmi2OK;
    case CMB_RESULT_DISCARD:
      cmb_log(c->instance, CMB_LOG_DISCARD, CMB_LOG_STATUS_DISCARD, "%s: %s", function, c->instance->message);
      return fmi2Discard;
    case CMB_RESULT_ERROR: break;
  }
  c->instance->situation.phase = CMB_PHASE_ERROR;
  return reject_call(c, function);
}

/* Outcome where no smaller step can help: initialization and events. */
static fmi2Status finish_strictly(component *c, const char *function, cmb_result result) {
  return finish(c, function, result == CMB_RESULT_DISCARD ? CMB_RESULT_ERROR : result);
}

static fmi2Status finish_read(component *c, const char *function, cmb_result result) {
  return c->instance->situation.phase & BEFORE_START ? finish_strictly(c, function, result) : finish(c, function, result);
}

/* -- common functions -- */

const char *fmi2GetTypesPlatform(void) { return fmi2TypesPlatform; }

const char *fmi2GetVersion(void) { return fmi2Version; }

static int set_logging(component *c, fmi2Boolean on, size_t count, const fmi2String *categories) {
  int logged[CMB_LOG_CATEGORY_COUNT] = {0};
  if (on && count == 0) logged[CMB_LOG_ALL] = 1;
  for (size_t i = 0; on && i < count; ++i) {
    int category = 0;
    while (category < CMB_LOG_CATEGORY_COUNT &&
           (categories == NULL || categories[i] == NULL || strcmp(categories[i], cmb_log_category_name[category]) != 0)) {
      ++category;
    }
    if (category == CMB_LOG_CATEGORY_COUNT) return 0;
    logged[category] = 1;
  }
  memcpy(c->instance->logged, logged, sizeof logged);
  return 1;
}

fmi2Status fmi2SetDebugLogging(fmi2Component pointer, fmi2Boolean on, size_t count, const fmi2String categories[]) {
  component *c = permitted(pointer, "fmi2SetDebugLogging", ANY_PHASE);
  if (c == NULL) return fmi2Error;
  return set_logging(c, on, count, categories) ? fmi2OK : refuse(c, "fmi2SetDebugLogging", "unknown log category");
}

static fmi2Component refuse_instance(const fmi2CallbackFunctions *functions, fmi2String name, const char *reason) {
  if (functions != NULL && functions->logger != NULL) {
    functions->logger(functions->componentEnvironment, name != NULL ? name : "?", fmi2Error,
                      cmb_log_category_name[CMB_LOG_STATUS_ERROR], reason);
  }
  return NULL;
}

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                              const fmi2CallbackFunctions *functions, fmi2Boolean visible, fmi2Boolean logging_on) {
  (void)resources;
  (void)visible;
  if (functions == NULL || name == NULL || name[0] == '\0') {
    return refuse_instance(functions, name, "fmi2Instantiate: instance name or callbacks missing");
  }
  if (guid == NULL || strcmp(guid, cmb_model.guid) != 0) {
    return refuse_instance(functions, name, "fmi2Instantiate: the GUID is not that of this FMU: modelDescription.xml and binary differ");
  }
  if (type != fmi2ModelExchange && type != fmi2CoSimulation) {
    return refuse_instance(functions, name, "fmi2Instantiate: unknown FMU type");
  }
  component *c = calloc(1, sizeof *c);
  if (c == NULL) return refuse_instance(functions, name, "fmi2Instantiate: no memory");
  c->callbacks = *functions;
  c->type = type;
  c->instance = cmb_instance_create(name, log_to_importer, c);
  if (c->instance == NULL) {
    free(c);
    return refuse_instance(functions, name, "fmi2Instantiate: no memory");
  }
  set_logging(c, logging_on, 0, NULL);
  return c;
}

void fmi2FreeInstance(fmi2Component pointer) {
  component *c = pointer;
  if (c == NULL) return;
  cmb_instance_destroy(c->instance);
  free(c);
}

fmi2Status fmi2SetupExperiment(fmi2Component pointer, fmi2Boolean tolerance_defined, fmi2Real tolerance,
                               fmi2Real start_time, fmi2Boolean stop_time_defined, fmi2Real stop_time) {
  component *c = permitted(pointer, "fmi2SetupExperiment", CMB_PHASE_INSTANTIATED);
  if (c == NULL) return fmi2Error;
  if (!isfinite(start_time) || (stop_time_defined && !(stop_time >= start_time))) {
    return refuse(c, "fmi2SetupExperiment", "start and stop time are not in order");
  }
  if (tolerance_defined && !(tolerance > 0.0 && tolerance < 1.0)) {
    return refuse(c, "fmi2SetupExperiment", "the tolerance is not between 0 and 1");
  }
  cmb_settings *settings = &c->instance->situation.settings;
  settings->tolerance = tolerance_defined ? tolerance : 0.0;
  settings->start_time = start_time;
  settings->stop_time = stop_time_defined ? stop_time : HUGE_VAL;
  c->instance->values.time = start_time;
  return fmi2OK;
}

fmi2Status fmi2EnterInitializationMode(fmi2Component pointer) {
  component *c = permitted(pointer, "fmi2EnterInitializationMode", CMB_PHASE_INSTANTIATED);
  if (c == NULL) return fmi2Error;
  c->instance->situation.phase = CMB_PHASE_INITIALIZATION;
  c->instance->situation.initialization_stale = 1;
  return fmi2OK;
}

fmi2Status fmi2ExitInitializationMode(fmi2Component pointer) {
  component *c = permitted(pointer, "fmi2ExitInitializationMode", CMB_PHASE_INITIALIZATION);
  if (c == NULL) return fmi2Error;
  cmb_result result = cmb_update_initialization(c->instance);
  if (result == CMB_RESULT_OK) {
    c->instance->values.initial = 0;
    c->instance->situation.continuous_stale = 1;
    c->instance->situation.phase = c->type == fmi2CoSimulation ? CMB_PHASE_STEP : CMB_PHASE_EVENT;
    int states_changed = 0;
    if (c->type == fmi2CoSimulation) result = cmb_iterate_events(c->instance, &states_changed);
  }
  return finish_strictly(c, "fmi2ExitInitializationMode", result);
}

fmi2Status fmi2Terminate(fmi2Component pointer) {
  component *c = permitted(pointer, "fmi2Terminate", MODEL_EXCHANGE | CO_SIMULATION);
  if (c == NULL) return fmi2Error;
  const cmb_result result = cmb_terminate(c->instance);
  c->instance->situation.phase = CMB_PHASE_TERMINATED;
  return finish(c, "fmi2Terminate", result);
}

fmi2Status fmi2Reset(fmi2Component pointer) {
  component *c = permitted(pointer, "fmi2Reset", ANY_PHASE);
  if (c == NULL) return fmi2Error;
  return finish(c, "fmi2Reset", cmb_instance_reset(c->instance));
}

/* -- values -- */

enum { READ_PHASES = ANY_PHASE };
enum { WRITE_PHASES = BEFORE_START | MODEL_EXCHANGE | CMB_PHASE_STEP };

static int has_array(component *c, const char *function, size_t count, const void *reference, const void *value) {
  if (count == 0 || (reference != NULL && value != NULL)) return 1;
  refuse(c, function, "null pointer");
  return 0;
}

/* The component if these references can be read, NULL if not (logged). */
static component *readable(fmi2Component pointer, const char *function, cmb_base_type type,
                           const fmi2ValueReference *reference, size_t count, const void *value) {
  component *c = permitted(pointer, function, READ_PHASES);
  if (c == NULL || !has_array(c, function, count, reference, value)) return NULL;
  if (cmb_check_references(c->instance, type, reference, count) == CMB_RESULT_OK) return c;
  reject_call(c, function);
  return NULL;
}

fmi2Status fmi2GetReal(fmi2Component pointer, const fmi2ValueReference reference[], size_t count, fmi2Real value[]) {
  component *c = readable(pointer, "fmi2GetReal", CMB_TYPE_REAL, reference, count, value);
  if (c == NULL) return fmi2Error;
  return finish_read(c, "fmi2GetReal", cmb_get_real(c->instance, reference, count, value));
}

fmi2Status fmi2GetInteger(fmi2Component pointer, const fmi2ValueReference reference[], size_t count, fmi2Integer value[]) {
  component *c = readable(pointer, "fmi2GetInteger", CMB_TYPE_INTEGER, reference, count, value);
  if (c == NULL) return fmi2Error;
  return finish_read(c, "fmi2GetInteger", cmb_get_integer(c->instance, reference, count, value));
}

fmi2Status fmi2GetBoolean(fmi2Component pointer, const fmi2ValueReference reference[], size_t count, fmi2Boolean value[]) {
  component *c = readable(pointer, "fmi2GetBoolean", CMB_TYPE_BOOLEAN, reference, count, value);
  if (c == NULL) return fmi2Error;
  return finish_read(c, "fmi2GetBoolean", cmb_get_boolean(c->instance, reference, count, value));
}

fmi2Status fmi2GetString(fmi2Component pointer, const fmi2ValueReference reference[], size_t count, fmi2String value[]) {
  component *c = readable(pointer, "fmi2GetString", CMB_TYPE_STRING, reference, count, value);
  if (c == NULL) return fmi2Error;
  return finish_read(c, "fmi2GetString", cmb_get_string(c->instance, reference, count, value));
}

fmi2Status fmi2SetReal(fmi2Component pointer, const fmi2ValueReference reference[], size_t count,
                       const fmi2Real value[]) {
  component *c = permitted(pointer, "fmi2SetReal", WRITE_PHASES);
  if (c == NULL || !has_array(c, "fmi2SetReal", count, reference, value)) return fmi2Error;
  if (cmb_set_reals(c->instance, reference, count, value) != CMB_RESULT_OK) return reject_call(c, "fmi2SetReal");
  return fmi2OK;
}

fmi2Status fmi2SetInteger(fmi2Component pointer, const fmi2ValueReference reference[], size_t count,
                          const fmi2Integer value[]) {
  component *c = permitted(pointer, "fmi2SetInteger", WRITE_PHASES);
  if (c == NULL || !has_array(c, "fmi2SetInteger", count, reference, value)) return fmi2Error;
  if (cmb_set_integers(c->instance, reference, count, value) != CMB_RESULT_OK) return reject_call(c, "fmi2SetInteger");
  return fmi2OK;
}

fmi2Status fmi2SetBoolean(fmi2Component pointer, const fmi2ValueReference reference[], size_t count,
                          const fmi2Boolean value[]) {
  component *c = permitted(pointer, "fmi2SetBoolean", WRITE_PHASES);
  if (c == NULL || !has_array(c, "fmi2SetBoolean", count, reference, value)) return fmi2Error;
  if (cmb_set_booleans(c->instance, reference, count, value) != CMB_RESULT_OK) return reject_call(c, "fmi2SetBoolean");
  return fmi2OK;
}

fmi2Status fmi2SetString(fmi2Component pointer, const fmi2ValueReference reference[], size_t count,
                         const fmi2String value[]) {
  component *c = permitted(pointer, "fmi2SetString", WRITE_PHASES);
  if (c == NULL || !has_array(c, "fmi2SetString", count, reference, value)) return fmi2Error;
  if (cmb_set_strings(c->instance, reference, count, value) != CMB_RESULT_OK) return reject_call(c, "fmi2SetString");
  return fmi2OK;
}

/* -- FMU state -- */

fmi2Status fmi2GetFMUstate(fmi2Component pointer, fmi2FMUstate *state) {
  component *c = permitted(pointer, "fmi2GetFMUstate", ANY_PHASE);
  if (c == NULL) return fmi2Error;
  if (state == NULL) return refuse(c, "fmi2GetFMUstate", "null pointer");
  cmb_state *saved = *state;
  if (cmb_state_save(c->instance, &saved) != CMB_RESULT_OK) return refuse(c, "fmi2GetFMUstate", "no memory");
  *state = saved;
  return fmi2OK;
}

fmi2Status fmi2SetFMUstate(fmi2Component pointer, fmi2FMUstate state) {
  component *c = permitted(pointer, "fmi2SetFMUstate", ANY_PHASE);
  if (c == NULL) return fmi2Error;
  if (state == NULL) return refuse(c, "fmi2SetFMUstate", "null pointer");
  if (cmb_state_restore(c->instance, state) != CMB_RESULT_OK) return refuse(c, "fmi2SetFMUstate", "no memory");
  return fmi2OK;
}

fmi2Status fmi2FreeFMUstate(fmi2Component pointer, fmi2FMUstate *state) {
  component *c = permitted(pointer, "fmi2FreeFMUstate", ANY_PHASE);
  if (c == NULL) return fmi2Error;
  if (state == NULL) return fmi2OK;
  cmb_state_free(*state);
  *state = NULL;
  return fmi2OK;
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component pointer, fmi2FMUstate state, size_t *size) {
  component *c = permitted(pointer, "fmi2SerializedFMUstateSize", ANY_PHASE);
  if (c == NULL) return fmi2Error;
  if (state == NULL || size == NULL) return refuse(c, "fmi2SerializedFMUstateSize", "null pointer");
  *size = cmb_state_size(state);
  return fmi2OK;
}

fmi2Status fmi2SerializeFMUstate(fmi2Component pointer, fmi2FMUstate state, fmi2Byte bytes[], size_t size) {
  component *c = permitted(pointer, "fmi2SerializeFMUstate", ANY_PHASE);
  if (c == NULL) return fmi2Error;
  if (state == NULL || bytes == NULL) return refuse(c, "fmi2SerializeFMUstate", "null pointer");
  if (size < cmb_state_size(state)) return refuse(c, "fmi2SerializeFMUstate", "the array is too small");
  cmb_state_write(state, bytes);
  return fmi2OK;
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component pointer, const fmi2Byte bytes[], size_t size, fmi2FMUstate *state) {
  component *c = permitted(pointer, "fmi2DeSerializeFMUstate", ANY_PHASE);
  if (c == NULL) return fmi2Error;
  if (bytes == NULL || state == NULL) return refuse(c, "fmi2DeSerializeFMUstate", "null pointer");
  cmb_state *read = cmb_state_read(bytes, size);
  if (read == NULL) return refuse(c, "fmi2DeSerializeFMUstate", "these bytes are not a state of this FMU");
  *state = read;
  return fmi2OK;
}

/* -- derivatives -- */

fmi2Status fmi2GetDirectionalDerivative(fmi2Component pointer, const fmi2ValueReference unknown[], size_t unknown_count,
                                        const fmi2ValueReference known[], size_t known_count, const fmi2Real seed[],
                                        fmi2Real sensitivity[]) {
  static const char function[] = "fmi2GetDirectionalDerivative";
  component *c = permitted(pointer, function, CMB_PHASE_INITIALIZATION | MODEL_EXCHANGE | CMB_PHASE_STEP);
  if (c == NULL || !has_array(c, function, unknown_count, unknown, sensitivity) ||
      !has_array(c, function, known_count, known, seed)) {
    return fmi2Error;
  }
  if (cmb_check_references(c->instance, CMB_TYPE_REAL, unknown, unknown_count) != CMB_RESULT_OK ||
      cmb_check_references(c->instance, CMB_TYPE_REAL, known, known_count) != CMB_RESULT_OK) {
    return reject_call(c, function);
  }
  return finish(c, function, cmb_directional_derivative(c->instance, unknown, unknown_count, known, known_count, seed,
                                                        sensitivity));
}

/* -- model exchange -- */

fmi2Status fmi2EnterEventMode(fmi2Component pointer) {
  component *c = permitted(pointer, "fmi2EnterEventMode", MODEL_EXCHANGE);
  if (c == NULL) return fmi2Error;
  c->instance->situation.phase = CMB_PHASE_EVENT;
  return fmi2OK;
}

fmi2Status fmi2NewDiscreteStates(fmi2Component pointer, fmi2EventInfo *info) {
  component *c = permitted(pointer, "fmi2NewDiscreteStates", CMB_PHASE_EVENT);
  if (c == NULL) return fmi2Error;
  if (info == NULL) return refuse(c, "fmi2NewDiscreteStates", "null pointer");
  int states_changed = 0;
  const cmb_result result = cmb_iterate_events(c->instance, &states_changed);
  info->newDiscreteStatesNeeded = fmi2False; /* the iteration is carried through inside */
  info->terminateSimulation = c->instance->situation.terminate_requested ? fmi2True : fmi2False;
  info->nominalsOfContinuousStatesChanged = fmi2False;
  info->valuesOfContinuousStatesChanged = states_changed ? fmi2True : fmi2False;
  info->nextEventTimeDefined = isfinite(c->instance->values.next_time_event) ? fmi2True : fmi2False;
  info->nextEventTime = info->nextEventTimeDefined ? c->instance->values.next_time_event : 0.0;
  return finish_strictly(c, "fmi2NewDiscreteStates", result);
}

fmi2Status fmi2EnterContinuousTimeMode(fmi2Component pointer) {
  component *c = permitted(pointer, "fmi2EnterContinuousTimeMode", CMB_PHASE_EVENT);
  if (c == NULL) return fmi2Error;
  c->instance->situation.phase = CMB_PHASE_CONTINUOUS;
  return fmi2OK;
}

fmi2Status fmi2CompletedIntegratorStep(fmi2Component pointer, fmi2Boolean no_rewind, fmi2Boolean *enter_event_mode,
                                       fmi2Boolean *terminate) {
  component *c = permitted(pointer, "fmi2CompletedIntegratorStep", CMB_PHASE_CONTINUOUS);
  (void)no_rewind;
  if (c == NULL) return fmi2Error;
  if (enter_event_mode == NULL || terminate == NULL) return refuse(c, "fmi2CompletedIntegratorStep", "null pointer");
  *enter_event_mode = fmi2False;
  *terminate = fmi2False;
  return fmi2OK;
}

fmi2Status fmi2SetTime(fmi2Component pointer, fmi2Real time) {
  component *c = permitted(pointer, "fmi2SetTime", MODEL_EXCHANGE);
  if (c == NULL) return fmi2Error;
  if (!isfinite(time)) return refuse(c, "fmi2SetTime", "the time is not finite");
  if (c->instance->values.time != time) {
    c->instance->values.time = time;
    c->instance->situation.continuous_stale = 1;
  }
  return fmi2OK;
}

static fmi2Status check_states(component *c, const char *function, const fmi2Real *x, size_t count) {
  if (count != cmb_model.state_count) return refuse(c, function, "wrong number of continuous states");
  return count > 0 && x == NULL ? refuse(c, function, "null pointer") : fmi2OK;
}

fmi2Status fmi2SetContinuousStates(fmi2Component pointer, const fmi2Real x[], size_t count) {
  component *c = permitted(pointer, "fmi2SetContinuousStates", CMB_PHASE_CONTINUOUS);
  if (c == NULL || check_states(c, "fmi2SetContinuousStates", x, count) != fmi2OK) return fmi2Error;
  for (size_t i = 0; i < count; ++i) {
    if (isfinite(x[i])) continue;
    cmb_log(c->instance, CMB_LOG_DISCARD, CMB_LOG_STATUS_DISCARD, "fmi2SetContinuousStates: %s is not finite",
            cmb_slot_name(&cmb_interface_tables.real, cmb_model.state[i]));
    return fmi2Discard;
  }
  cmb_set_point(c->instance, c->instance->values.time, x);
  return fmi2OK;
}

enum { EVALUATION_PHASES = CMB_PHASE_INITIALIZATION | MODEL_EXCHANGE | AFTER_END };

fmi2Status fmi2GetDerivatives(fmi2Component pointer, fmi2Real derivatives[], size_t count) {
  component *c = permitted(pointer, "fmi2GetDerivatives", EVALUATION_PHASES);
  if (c == NULL || check_states(c, "fmi2GetDerivatives", derivatives, count) != fmi2OK) return fmi2Error;
  const cmb_result result = cmb_update_values(c->instance);
  for (size_t i = 0; result == CMB_RESULT_OK && i < count; ++i) {
    derivatives[i] = c->instance->values.real[cmb_model.derivative[i]];
  }
  return finish_read(c, "fmi2GetDerivatives", result);
}

fmi2Status fmi2GetEventIndicators(fmi2Component pointer, fmi2Real indicators[], size_t count) {
  component *c = permitted(pointer, "fmi2GetEventIndicators", EVALUATION_PHASES);
  if (c == NULL) return fmi2Error;
  if (count != cmb_model.indicator_count) {
    return refuse(c, "fmi2GetEventIndicators", "wrong number of event indicators");
  }
  if (count == 0) return fmi2OK;
  if (indicators == NULL) return refuse(c, "fmi2GetEventIndicators", "null pointer");
  return finish_read(c, "fmi2GetEventIndicators", cmb_event_indicators(c->instance, indicators));
}

fmi2Status fmi2GetContinuousStates(fmi2Component pointer, fmi2Real x[], size_t count) {
  component *c = permitted(pointer, "fmi2GetContinuousStates", EVALUATION_PHASES);
  if (c == NULL || check_states(c, "fmi2GetContinuousStates", x, count) != fmi2OK) return fmi2Error;
  cmb_result result = CMB_RESULT_OK;
  if (c->instance->situation.phase == CMB_PHASE_INITIALIZATION) result = cmb_update_initialization(c->instance);
  for (size_t i = 0; result == CMB_RESULT_OK && i < count; ++i) x[i] = c->instance->values.real[cmb_model.state[i]];
  return finish_read(c, "fmi2GetContinuousStates", result);
}

fmi2Status fmi2GetNominalsOfContinuousStates(fmi2Component pointer, fmi2Real nominal[], size_t count) {
  component *c = permitted(pointer, "fmi2GetNominalsOfContinuousStates", EVALUATION_PHASES | CMB_PHASE_INSTANTIATED);
  if (c == NULL || check_states(c, "fmi2GetNominalsOfContinuousStates", nominal, count) != fmi2OK) return fmi2Error;
  if (count > 0) memcpy(nominal, cmb_model.state_nominal, count * sizeof *nominal);
  return fmi2OK;
}

/* -- co-simulation -- */

fmi2Status fmi2SetRealInputDerivatives(fmi2Component pointer, const fmi2ValueReference reference[], size_t count,
                                       const fmi2Integer order[], const fmi2Real value[]) {
  component *c = permitted(pointer, "fmi2SetRealInputDerivatives", BEFORE_START | CMB_PHASE_STEP);
  (void)reference;
  (void)order;
  (void)value;
  if (c == NULL) return fmi2Error;
  return count == 0 ? fmi2OK : refuse(c, "fmi2SetRealInputDerivatives", "inputs are not interpolated by this FMU");
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component pointer, const fmi2ValueReference reference[], size_t count,
                                        const fmi2Integer order[], fmi2Real value[]) {
  component *c = permitted(pointer, "fmi2GetRealOutputDerivatives", CO_SIMULATION | AFTER_END);
  (void)reference;
  (void)order;
  (void)value;
  if (c == NULL) return fmi2Error;
  return count == 0 ? fmi2OK : refuse(c, "fmi2GetRealOutputDerivatives", "this FMU has no derivatives of outputs");
}

fmi2Status fmi2DoStep(fmi2Component pointer, fmi2Real time, fmi2Real step, fmi2Boolean no_rewind) {
  component *c = permitted(pointer, "fmi2DoStep", CMB_PHASE_STEP);
  (void)no_rewind;
  if (c == NULL) return fmi2Error;
  if (c->type != fmi2CoSimulation) return refuse(c, "fmi2DoStep", "this instance is for model exchange");
  cmb_instance *instance = c->instance;
  if (!isfinite(time) || !isfinite(step) || !(step > 0.0)) {
    return refuse(c, "fmi2DoStep", "the step size is not positive");
  }
  if (fabs(time - instance->values.time) > 1e-6 * step + 1e-12 * fabs(time)) {
    return refuse(c, "fmi2DoStep", "the communication point is not the time this FMU has reached");
  }
  const double target = time + step;
  const double tolerance = 1e-9 * step + 1e-12 * fabs(target);
  if (target > instance->situation.settings.stop_time + tolerance) {
    return refuse(c, "fmi2DoStep", "the step ends after the stop time");
  }
  const cmb_result result = cmb_do_step(instance, target);
  fmi2Status status = finish(c, "fmi2DoStep", result);
  c->last_successful_time = instance->values.time;
  if (status == fmi2Discard) {
    instance->situation.phase = CMB_PHASE_STEP_FAILED;
  } else if (status == fmi2OK && instance->situation.terminate_requested) {
    status = fmi2Discard;
    cmb_log(instance, CMB_LOG_DISCARD, CMB_LOG_STATUS_DISCARD, "The model ends the simulation at time %.15g",
            instance->values.time);
    instance->situation.phase = CMB_PHASE_STEP_FAILED;
  }
  c->step_status = status;
  return status;
}

fmi2Status fmi2CancelStep(fmi2Component pointer) {
  component *c = permitted(pointer, "fmi2CancelStep", 0);
  (void)c;
  return fmi2Error; /* no step is ever pending */
}

fmi2Status fmi2GetStatus(fmi2Component pointer, const fmi2StatusKind kind, fmi2Status *value) {
  component *c = permitted(pointer, "fmi2GetStatus", CO_SIMULATION | AFTER_END);
  if (c == NULL) return fmi2Error;
  if (value == NULL || kind != fmi2DoStepStatus) return refuse(c, "fmi2GetStatus", "unknown status kind or null pointer");
  *value = c->step_status;
  return fmi2OK;
}

fmi2Status fmi2GetRealStatus(fmi2Component pointer, const fmi2StatusKind kind, fmi2Real *value) {
  component *c = permitted(pointer, "fmi2GetRealStatus", CO_SIMULATION | AFTER_END);
  if (c == NULL) return fmi2Error;
  if (value == NULL || kind != fmi2LastSuccessfulTime) {
    return refuse(c, "fmi2GetRealStatus", "unknown status kind or null pointer");
  }
  *value = c->last_successful_time;
  return fmi2OK;
}

fmi2Status fmi2GetIntegerStatus(fmi2Component pointer, const fmi2StatusKind kind, fmi2Integer *value) {
  component *c = permitted(pointer, "fmi2GetIntegerStatus", CO_SIMULATION | AFTER_END);
  (void)kind;
  (void)value;
  return c == NULL ? fmi2Error : refuse(c, "fmi2GetIntegerStatus", "there is no Integer status");
}

fmi2Status fmi2GetBooleanStatus(fmi2Component pointer, const fmi2StatusKind kind, fmi2Boolean *value) {
  component *c = permitted(pointer, "fmi2GetBooleanStatus", CO_SIMULATION | AFTER_END);
  if (c == NULL) return fmi2Error;
  if (value == NULL || kind != fmi2Terminated) {
    return refuse(c, "fmi2GetBooleanStatus", "unknown status kind or null pointer");
  }
  *value = c->instance->situation.terminate_requested ? fmi2True : fmi2False;
  return fmi2OK;
}

fmi2Status fmi2GetStringStatus(fmi2Component pointer, const fmi2StatusKind kind, fmi2String *value) {
  component *c = permitted(pointer, "fmi2GetStringStatus", CO_SIMULATION | AFTER_END);
  if (c == NULL) return fmi2Error;
  if (value == NULL || kind != fmi2PendingStatus) {
    return refuse(c, "fmi2GetStringStatus", "unknown status kind or null pointer");
  }
  *value = "";
  return fmi2OK;
}
