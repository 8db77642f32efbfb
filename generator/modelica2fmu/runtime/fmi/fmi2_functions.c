/* fmi2_functions.c - FMI 2.0.4, model exchange and co-simulation, over fmurt_fmu.h. */
#include <stdio.h>
#include <stdlib.h>

#include "fmurt_fmu.h"
#include "fmi2Functions.h"

typedef struct component {
  fmurt_fmu fmu; /* first, so that a pointer to it is one to the component */
  fmi2CallbackFunctions callbacks;
  double last_successful_time;
  fmi2Status step_status;
} component;

/* -- logging -- */

static fmi2Status to_status(fmurt_severity severity) {
  switch (severity) {
    case FMURT_LOG_DEBUG: return fmi2OK;
    case FMURT_LOG_WARNING: return fmi2Warning;
    case FMURT_LOG_DISCARD: return fmi2Discard;
    case FMURT_LOG_ERROR: break;
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

static void log_to_importer(void *receiver, const char *instance_name, fmurt_severity severity,
                            fmurt_log_category category, const char *message) {
  const component *c = receiver;
  if (c->callbacks.logger == NULL) return;
  char format[2200];
  double_special(message, format, sizeof format);
  c->callbacks.logger(c->callbacks.componentEnvironment, instance_name, to_status(severity),
                      fmurt_log_category_name[category], format);
}

/* -- common functions -- */

const char *fmi2GetTypesPlatform(void) { return fmi2TypesPlatform; }

const char *fmi2GetVersion(void) { return fmi2Version; }

fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, size_t count, const fmi2String categories[]) {
  return (fmi2Status)fmurt_fmu_set_logging(c, __func__, on, count, categories);
}

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                              const fmi2CallbackFunctions *functions, fmi2Boolean visible, fmi2Boolean logging_on) {
  (void)resources;
  (void)visible;
  component *c = calloc(1, sizeof *c);
  const char *problem = NULL;
  if (functions == NULL) {
    problem = "the callback functions are missing";
  } else if (c == NULL) {
    problem = "no memory";
  } else {
    c->callbacks = *functions;
    c->fmu.co_simulation = type == fmi2CoSimulation;
    problem = fmurt_fmu_open(&c->fmu, name, guid, logging_on, log_to_importer, c);
  }
  if (problem == NULL) return c;
  free(c);
  if (functions != NULL && functions->logger != NULL) {
    char message[200];
    snprintf(message, sizeof message, "fmi2Instantiate: %s", problem);
    functions->logger(functions->componentEnvironment, name != NULL ? name : "?", fmi2Error,
                      fmurt_log_category_name[FMURT_LOG_STATUS_ERROR], message);
  }
  return NULL;
}

void fmi2FreeInstance(fmi2Component c) {
  if (c == NULL) return;
  fmurt_fmu_close(c);
  free(c);
}

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean tolerance_defined, fmi2Real tolerance, fmi2Real start_time,
                               fmi2Boolean stop_time_defined, fmi2Real stop_time) {
  return (fmi2Status)fmurt_fmu_set_experiment(c, __func__, tolerance_defined, tolerance, start_time, stop_time_defined,
                                              stop_time);
}

fmi2Status fmi2EnterInitializationMode(fmi2Component c) {
  return (fmi2Status)fmurt_fmu_enter_initialization(c, __func__);
}

fmi2Status fmi2ExitInitializationMode(fmi2Component c) {
  return (fmi2Status)fmurt_fmu_exit_initialization(c, __func__);
}

fmi2Status fmi2Terminate(fmi2Component c) { return (fmi2Status)fmurt_fmu_terminate(c, __func__); }

fmi2Status fmi2Reset(fmi2Component c) { return (fmi2Status)fmurt_fmu_reset(c, __func__); }

/* -- values -- */

fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference reference[], size_t count, fmi2Real value[]) {
  return (fmi2Status)fmurt_fmu_get_real(c, __func__, reference, count, value);
}

fmi2Status fmi2GetInteger(fmi2Component c, const fmi2ValueReference reference[], size_t count, fmi2Integer value[]) {
  return (fmi2Status)fmurt_fmu_get_integer(c, __func__, reference, count, value);
}

fmi2Status fmi2GetBoolean(fmi2Component c, const fmi2ValueReference reference[], size_t count, fmi2Boolean value[]) {
  return (fmi2Status)fmurt_fmu_get_boolean(c, __func__, reference, count, value);
}

fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference reference[], size_t count, fmi2String value[]) {
  return (fmi2Status)fmurt_fmu_get_string(c, __func__, reference, count, value);
}

fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference reference[], size_t count, const fmi2Real value[]) {
  return (fmi2Status)fmurt_fmu_set_real(c, __func__, reference, count, value);
}

fmi2Status fmi2SetInteger(fmi2Component c, const fmi2ValueReference reference[], size_t count,
                          const fmi2Integer value[]) {
  return (fmi2Status)fmurt_fmu_set_integer(c, __func__, reference, count, value);
}

fmi2Status fmi2SetBoolean(fmi2Component c, const fmi2ValueReference reference[], size_t count,
                          const fmi2Boolean value[]) {
  return (fmi2Status)fmurt_fmu_set_boolean(c, __func__, reference, count, value);
}

fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference reference[], size_t count,
                         const fmi2String value[]) {
  return (fmi2Status)fmurt_fmu_set_string(c, __func__, reference, count, value);
}

/* -- state of the FMU -- */

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *state) {
  return (fmi2Status)fmurt_fmu_get_state(c, __func__, state);
}

fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate state) {
  return (fmi2Status)fmurt_fmu_set_state(c, __func__, state);
}

fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *state) {
  return (fmi2Status)fmurt_fmu_free_state(c, __func__, state);
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate state, size_t *size) {
  return (fmi2Status)fmurt_fmu_state_size(c, __func__, state, size);
}

fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[], size_t size) {
  return (fmi2Status)fmurt_fmu_write_state(c, __func__, state, bytes, size);
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte bytes[], size_t size, fmi2FMUstate *state) {
  return (fmi2Status)fmurt_fmu_read_state(c, __func__, bytes, size, state);
}

/* -- derivatives -- */

fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference unknown[], size_t unknown_count,
                                        const fmi2ValueReference known[], size_t known_count, const fmi2Real seed[],
                                        fmi2Real sensitivity[]) {
  return (fmi2Status)fmurt_fmu_directional_derivative(c, __func__, unknown, unknown_count, known, known_count, seed,
                                                      sensitivity);
}

/* -- model exchange -- */

fmi2Status fmi2EnterEventMode(fmi2Component c) { return (fmi2Status)fmurt_fmu_enter_event_mode(c, __func__); }

fmi2Status fmi2NewDiscreteStates(fmi2Component c, fmi2EventInfo *info) {
  if (info == NULL && c != NULL) return (fmi2Status)fmurt_fmu_refuse(c, __func__, "null pointer");
  fmurt_event_report report;
  const fmi2Status status = (fmi2Status)fmurt_fmu_update_discrete_states(c, __func__, &report);
  if (c == NULL) return status;
  info->newDiscreteStatesNeeded = fmi2False;
  info->terminateSimulation = report.terminate;
  info->nominalsOfContinuousStatesChanged = fmi2False;
  info->valuesOfContinuousStatesChanged = report.states_changed;
  info->nextEventTimeDefined = report.next_time_defined;
  info->nextEventTime = report.next_time;
  return status;
}

fmi2Status fmi2EnterContinuousTimeMode(fmi2Component c) {
  return (fmi2Status)fmurt_fmu_enter_continuous_time_mode(c, __func__);
}

fmi2Status fmi2CompletedIntegratorStep(fmi2Component c, fmi2Boolean no_rewind, fmi2Boolean *enter_event_mode,
                                       fmi2Boolean *terminate) {
  (void)no_rewind;
  if (!fmurt_fmu_permits(c, __func__, FMURT_PHASE_CONTINUOUS)) return fmi2Error;
  if (enter_event_mode == NULL || terminate == NULL) return (fmi2Status)fmurt_fmu_refuse(c, __func__, "null pointer");
  *enter_event_mode = fmi2False;
  *terminate = fmi2False;
  return (fmi2Status)fmurt_fmu_completed_step(c, __func__);
}

fmi2Status fmi2SetTime(fmi2Component c, fmi2Real time) { return (fmi2Status)fmurt_fmu_set_time(c, __func__, time); }

fmi2Status fmi2SetContinuousStates(fmi2Component c, const fmi2Real x[], size_t count) {
  return (fmi2Status)fmurt_fmu_set_states(c, __func__, x, count);
}

fmi2Status fmi2GetDerivatives(fmi2Component c, fmi2Real derivatives[], size_t count) {
  return (fmi2Status)fmurt_fmu_get_derivatives(c, __func__, derivatives, count);
}

fmi2Status fmi2GetEventIndicators(fmi2Component c, fmi2Real indicators[], size_t count) {
  return (fmi2Status)fmurt_fmu_get_indicators(c, __func__, indicators, count);
}

fmi2Status fmi2GetContinuousStates(fmi2Component c, fmi2Real x[], size_t count) {
  return (fmi2Status)fmurt_fmu_get_states(c, __func__, x, count);
}

fmi2Status fmi2GetNominalsOfContinuousStates(fmi2Component c, fmi2Real nominals[], size_t count) {
  return (fmi2Status)fmurt_fmu_get_nominals(c, __func__, nominals, count);
}

/* -- co-simulation -- */

fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference reference[], size_t count,
                                       const fmi2Integer order[], const fmi2Real value[]) {
  (void)reference;
  (void)order;
  (void)value;
  if (!fmurt_fmu_permits(c, __func__, FMURT_BEFORE_START | FMURT_PHASE_STEP)) return fmi2Error;
  return count == 0 ? fmi2OK : (fmi2Status)fmurt_fmu_refuse(c, __func__, "this FMU does not interpolate its inputs");
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference reference[], size_t count,
                                        const fmi2Integer order[], fmi2Real value[]) {
  (void)reference;
  (void)order;
  (void)value;
  if (!fmurt_fmu_permits(c, __func__, FMURT_CO_SIMULATION | FMURT_AFTER_END)) return fmi2Error;
  return count == 0 ? fmi2OK : (fmi2Status)fmurt_fmu_refuse(c, __func__, "this FMU has no derivatives of outputs");
}

fmi2Status fmi2DoStep(fmi2Component pointer, fmi2Real time, fmi2Real step, fmi2Boolean no_rewind) {
  (void)no_rewind;
  component *c = pointer;
  fmurt_step_report report;
  fmi2Status status = (fmi2Status)fmurt_fmu_do_step(pointer, __func__, time, step, &report);
  if (c == NULL) return status;
  if (report.terminate) { /* FMI 2.0 reports it as a step that could not be carried through */
    status = fmi2Discard;
    fmurt_log(c->fmu.instance, FMURT_LOG_DISCARD, FMURT_LOG_STATUS_DISCARD,
              "The model ends the simulation at time %.15g", report.time);
    c->fmu.instance->situation.phase = FMURT_PHASE_STEP_FAILED;
  }
  c->last_successful_time = c->fmu.instance->values.time;
  c->step_status = status;
  return status;
}

fmi2Status fmi2CancelStep(fmi2Component c) {
  fmurt_fmu_permits(c, __func__, 0); /* no step is ever pending */
  return fmi2Error;
}

/* 1 if a status of this kind can be asked for now, 0 (logged) if not. */
static int has_status(fmi2Component c, const char *function, fmi2StatusKind kind, fmi2StatusKind known,
                      const void *value) {
  if (!fmurt_fmu_permits(c, function, FMURT_CO_SIMULATION | FMURT_AFTER_END)) return 0;
  if (kind == known && value != NULL) return 1;
  fmurt_fmu_refuse(c, function, "unknown kind of status, or null pointer");
  return 0;
}

fmi2Status fmi2GetStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Status *value) {
  if (!has_status(c, __func__, kind, fmi2DoStepStatus, value)) return fmi2Error;
  *value = ((component *)c)->step_status;
  return fmi2OK;
}

fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Real *value) {
  if (!has_status(c, __func__, kind, fmi2LastSuccessfulTime, value)) return fmi2Error;
  *value = ((component *)c)->last_successful_time;
  return fmi2OK;
}

fmi2Status fmi2GetIntegerStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Integer *value) {
  (void)kind;
  (void)value;
  if (!fmurt_fmu_permits(c, __func__, FMURT_CO_SIMULATION | FMURT_AFTER_END)) return fmi2Error;
  return (fmi2Status)fmurt_fmu_refuse(c, __func__, "there is no Integer status");
}

fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Boolean *value) {
  if (!has_status(c, __func__, kind, fmi2Terminated, value)) return fmi2Error;
  *value = ((component *)c)->fmu.instance->situation.terminate_requested;
  return fmi2OK;
}

fmi2Status fmi2GetStringStatus(fmi2Component c, const fmi2StatusKind kind, fmi2String *value) {
  if (!has_status(c, __func__, kind, fmi2PendingStatus, value)) return fmi2Error;
  *value = "";
  return fmi2OK;
}
