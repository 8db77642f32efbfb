/* fmi3_functions.c - FMI 3.0.2, model exchange and co-simulation, over fmurt_fmu.h.
 * Values by reference are in fmi3_values.c, what no FMU of this generator provides is in fmi3_unsupported.c. */
#include <stdlib.h>

#include "fmurt_approach.h"
#include "fmurt_fmu.h"
#include "fmi3Functions.h"

typedef struct component {
  fmurt_fmu fmu; /* first, so that a pointer to it is one to the component */
  fmi3InstanceEnvironment environment;
  fmi3LogMessageCallback log_message;
} component;

/* -- life -- */

static void log_to_importer(void *receiver, const char *instance_name, fmurt_severity severity,
                            fmurt_log_category category, const char *message) {
  static const fmi3Status status[] = {[FMURT_LOG_DEBUG] = fmi3OK,
                                      [FMURT_LOG_WARNING] = fmi3Warning,
                                      [FMURT_LOG_DISCARD] = fmi3Discard,
                                      [FMURT_LOG_ERROR] = fmi3Error};
  const component *c = receiver;
  (void)instance_name;
  if (c->log_message != NULL) {
    c->log_message(c->environment, status[severity], fmurt_log_category_name[category], message);
  }
}

const char *fmi3GetVersion(void) { return fmi3Version; }

fmi3Status fmi3SetDebugLogging(fmi3Instance c, fmi3Boolean on, size_t count, const fmi3String categories[]) {
  return (fmi3Status)fmurt_fmu_set_logging(c, __func__, on, count, categories);
}

static fmi3Instance instantiate(component prototype, fmi3String name, fmi3String token, fmi3Boolean logging_on) {
  component *c = malloc(sizeof *c);
  const char *problem = "no memory";
  if (c != NULL) {
    *c = prototype;
    problem = fmurt_fmu_open(&c->fmu, name, token, logging_on, log_to_importer, c);
  }
  if (problem == NULL) return c;
  free(c);
  if (prototype.log_message != NULL) {
    prototype.log_message(prototype.environment, fmi3Error, fmurt_log_category_name[FMURT_LOG_STATUS_ERROR], problem);
  }
  return NULL;
}

fmi3Instance fmi3InstantiateModelExchange(fmi3String name, fmi3String token, fmi3String resource_path,
                                          fmi3Boolean visible, fmi3Boolean logging_on,
                                          fmi3InstanceEnvironment environment, fmi3LogMessageCallback log_message) {
  (void)resource_path;
  (void)visible;
  const component prototype = {.environment = environment, .log_message = log_message};
  return instantiate(prototype, name, token, logging_on);
}

fmi3Instance fmi3InstantiateCoSimulation(fmi3String name, fmi3String token, fmi3String resource_path,
                                         fmi3Boolean visible, fmi3Boolean logging_on, fmi3Boolean event_mode_used,
                                         fmi3Boolean early_return_allowed,
                                         const fmi3ValueReference intermediate_variables[], size_t intermediate_count,
                                         fmi3InstanceEnvironment environment, fmi3LogMessageCallback log_message,
                                         fmi3IntermediateUpdateCallback intermediate_update) {
  (void)resource_path;
  (void)visible;
  (void)intermediate_variables;
  (void)intermediate_count;
  (void)intermediate_update;
  const component prototype = {
      .fmu = {.co_simulation = 1, .event_mode_used = event_mode_used, .early_return_allowed = early_return_allowed},
      .environment = environment,
      .log_message = log_message};
  return instantiate(prototype, name, token, logging_on);
}

fmi3Instance fmi3InstantiateScheduledExecution(fmi3String name, fmi3String token, fmi3String resource_path,
                                               fmi3Boolean visible, fmi3Boolean logging_on,
                                               fmi3InstanceEnvironment environment, fmi3LogMessageCallback log_message,
                                               fmi3ClockUpdateCallback clock_update, fmi3LockPreemptionCallback lock,
                                               fmi3UnlockPreemptionCallback unlock) {
  (void)name;
  (void)token;
  (void)resource_path;
  (void)visible;
  (void)logging_on;
  (void)clock_update;
  (void)lock;
  (void)unlock;
  if (log_message != NULL) {
    log_message(environment, fmi3Error, fmurt_log_category_name[FMURT_LOG_STATUS_ERROR],
                "this FMU is for model exchange and co-simulation");
  }
  return NULL;
}

void fmi3FreeInstance(fmi3Instance c) {
  if (c == NULL) return;
  fmurt_fmu_close(c);
  free(c);
}

fmi3Status fmi3EnterInitializationMode(fmi3Instance c, fmi3Boolean tolerance_defined, fmi3Float64 tolerance,
                                       fmi3Float64 start_time, fmi3Boolean stop_time_defined, fmi3Float64 stop_time) {
  const fmurt_fmu_status status =
      fmurt_fmu_set_experiment(c, __func__, tolerance_defined, tolerance, start_time, stop_time_defined, stop_time);
  return (fmi3Status)(status == FMURT_FMU_OK ? fmurt_fmu_enter_initialization(c, __func__) : status);
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance c) { return (fmi3Status)fmurt_fmu_exit_initialization(c, __func__); }

fmi3Status fmi3Terminate(fmi3Instance c) { return (fmi3Status)fmurt_fmu_terminate(c, __func__); }

fmi3Status fmi3Reset(fmi3Instance c) { return (fmi3Status)fmurt_fmu_reset(c, __func__); }

/* -- state of the FMU -- */

fmi3Status fmi3GetFMUState(fmi3Instance c, fmi3FMUState *state) {
  return (fmi3Status)fmurt_fmu_get_state(c, __func__, state);
}

fmi3Status fmi3SetFMUState(fmi3Instance c, fmi3FMUState state) {
  return (fmi3Status)fmurt_fmu_set_state(c, __func__, state);
}

fmi3Status fmi3FreeFMUState(fmi3Instance c, fmi3FMUState *state) {
  return (fmi3Status)fmurt_fmu_free_state(c, __func__, state);
}

fmi3Status fmi3SerializedFMUStateSize(fmi3Instance c, fmi3FMUState state, size_t *size) {
  return (fmi3Status)fmurt_fmu_state_size(c, __func__, state, size);
}

fmi3Status fmi3SerializeFMUState(fmi3Instance c, fmi3FMUState state, fmi3Byte bytes[], size_t size) {
  return (fmi3Status)fmurt_fmu_write_state(c, __func__, state, (char *)bytes, size);
}

fmi3Status fmi3DeserializeFMUState(fmi3Instance c, const fmi3Byte bytes[], size_t size, fmi3FMUState *state) {
  return (fmi3Status)fmurt_fmu_read_state(c, __func__, (const char *)bytes, size, state);
}

/* -- modes -- */

fmi3Status fmi3EnterEventMode(fmi3Instance c) { return (fmi3Status)fmurt_fmu_enter_event_mode(c, __func__); }

fmi3Status fmi3UpdateDiscreteStates(fmi3Instance c, fmi3Boolean *need_update, fmi3Boolean *terminate,
                                    fmi3Boolean *nominals_changed, fmi3Boolean *states_changed,
                                    fmi3Boolean *next_time_defined, fmi3Float64 *next_time) {
  if (c != NULL && (need_update == NULL || terminate == NULL || nominals_changed == NULL || states_changed == NULL ||
                    next_time_defined == NULL || next_time == NULL)) {
    return (fmi3Status)fmurt_fmu_refuse(c, __func__, "null pointer");
  }
  fmurt_event_report report;
  const fmi3Status status = (fmi3Status)fmurt_fmu_update_discrete_states(c, __func__, &report);
  if (c == NULL) return status;
  *need_update = fmi3False;
  *terminate = report.terminate != 0;
  *nominals_changed = fmi3False;
  *states_changed = report.states_changed != 0;
  *next_time_defined = report.next_time_defined != 0;
  *next_time = report.next_time;
  return status;
}

fmi3Status fmi3EnterContinuousTimeMode(fmi3Instance c) {
  return (fmi3Status)fmurt_fmu_enter_continuous_time_mode(c, __func__);
}

fmi3Status fmi3EnterStepMode(fmi3Instance c) { return (fmi3Status)fmurt_fmu_enter_step_mode(c, __func__); }

/* -- model exchange -- */

fmi3Status fmi3CompletedIntegratorStep(fmi3Instance c, fmi3Boolean no_rewind, fmi3Boolean *enter_event_mode,
                                       fmi3Boolean *terminate) {
  (void)no_rewind;
  if (!fmurt_fmu_permits(c, __func__, FMURT_PHASE_CONTINUOUS)) return fmi3Error;
  if (enter_event_mode == NULL || terminate == NULL) return (fmi3Status)fmurt_fmu_refuse(c, __func__, "null pointer");
  *enter_event_mode = fmi3False;
  *terminate = fmi3False;
  return (fmi3Status)fmurt_fmu_completed_step(c, __func__);
}

fmi3Status fmi3SetTime(fmi3Instance c, fmi3Float64 time) { return (fmi3Status)fmurt_fmu_set_time(c, __func__, time); }

fmi3Status fmi3SetContinuousStates(fmi3Instance c, const fmi3Float64 state[], size_t count) {
  return (fmi3Status)fmurt_fmu_set_states(c, __func__, state, count);
}

fmi3Status fmi3GetContinuousStateDerivatives(fmi3Instance c, fmi3Float64 derivative[], size_t count) {
  return (fmi3Status)fmurt_fmu_get_derivatives(c, __func__, derivative, count);
}

fmi3Status fmi3GetEventIndicators(fmi3Instance c, fmi3Float64 indicator[], size_t count) {
  return (fmi3Status)fmurt_fmu_get_indicators(c, __func__, indicator, count);
}

fmi3Status fmi3GetContinuousStates(fmi3Instance c, fmi3Float64 state[], size_t count) {
  return (fmi3Status)fmurt_fmu_get_states(c, __func__, state, count);
}

fmi3Status fmi3GetNominalsOfContinuousStates(fmi3Instance c, fmi3Float64 nominal[], size_t count) {
  return (fmi3Status)fmurt_fmu_get_nominals(c, __func__, nominal, count);
}

static fmi3Status tell_number(fmi3Instance c, const char *call, size_t number, size_t *result) {
  if (!fmurt_fmu_permits(c, call, FMURT_ANY_PHASE)) return fmi3Error;
  if (result == NULL) return (fmi3Status)fmurt_fmu_refuse(c, call, "null pointer");
  *result = number;
  return fmi3OK;
}

fmi3Status fmi3GetNumberOfEventIndicators(fmi3Instance c, size_t *count) {
  return tell_number(c, __func__, fmurt_shown_indicator_count(), count);
}

fmi3Status fmi3GetNumberOfContinuousStates(fmi3Instance c, size_t *count) {
  return tell_number(c, __func__, fmurt_model.state_count, count);
}

/* -- co-simulation -- */

fmi3Status fmi3DoStep(fmi3Instance pointer, fmi3Float64 time, fmi3Float64 step, fmi3Boolean no_rewind,
                      fmi3Boolean *event_handling_needed, fmi3Boolean *terminate, fmi3Boolean *early_return,
                      fmi3Float64 *last_successful_time) {
  (void)no_rewind;
  component *c = pointer;
  if (c != NULL &&
      (event_handling_needed == NULL || terminate == NULL || early_return == NULL || last_successful_time == NULL)) {
    return (fmi3Status)fmurt_fmu_refuse(&c->fmu, __func__, "null pointer");
  }
  fmurt_step_report report;
  const fmi3Status status = (fmi3Status)fmurt_fmu_do_step(pointer, __func__, time, step, &report);
  if (c == NULL) return status;
  *event_handling_needed = report.event_waiting != 0;
  *terminate = report.terminate != 0;
  *early_return = status == fmi3OK && report.time < time + step;
  *last_successful_time = report.time;
  /* FMI 3.0 lets the importer go on from the last successful time. */
  if (status == fmi3Discard) c->fmu.instance->situation.phase = FMURT_PHASE_STEP;
  return status;
}
