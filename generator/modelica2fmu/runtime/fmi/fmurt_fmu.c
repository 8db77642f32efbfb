/* cmb_fmu.c - see cmb_fmu.h. */
#include "cmb_fmu.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cmb_derivative.h"
#include "cmb_evaluate.h"
#include "cmb_event.h"
#include "cmb_solver.h"
#include "cmb_step.h"

/* -- checks and results -- */

cmb_fmu_status cmb_fmu_refuse(cmb_fmu *fmu, const char *call, const char *reason) {
  cmb_log(fmu->instance, CMB_LOG_ERROR, CMB_LOG_STATUS_ERROR, "%s: %s", call, reason);
  return CMB_FMU_ERROR;
}

int cmb_fmu_permits(cmb_fmu *fmu, const char *call, int phases) {
  if (fmu == NULL) return 0;
  if (fmu->instance->situation.phase & phases) return 1;
  cmb_fmu_refuse(fmu, call, "not permitted in the present state of the FMU");
  return 0;
}

/* The call was wrong; the cause is in the instance's message. */
static cmb_fmu_status reject(cmb_fmu *fmu, const char *call) { return cmb_fmu_refuse(fmu, call, fmu->instance->message); }

/* Outcome of an evaluation of the model: an error ends in the error state. */
static cmb_fmu_status finish(cmb_fmu *fmu, const char *call, cmb_result result) {
  switch (result) {
    case CMB_RESULT_OK: return CMB_FMU_OK;
    case CMB_RESULT_DISCARD:
      cmb_log(fmu->instance, CMB_LOG_DISCARD, CMB_LOG_STATUS_DISCARD, "%s: %s", call, fmu->instance->message);
      return CMB_FMU_DISCARD;
    case CMB_RESULT_ERROR: break;
  }
  fmu->instance->situation.phase = CMB_PHASE_ERROR;
  return reject(fmu, call);
}

/* Outcome where no smaller step can help: initialization and events. */
static cmb_fmu_status finish_strictly(cmb_fmu *fmu, const char *call, cmb_result result) {
  return finish(fmu, call, result == CMB_RESULT_DISCARD ? CMB_RESULT_ERROR : result);
}

static cmb_fmu_status finish_read(cmb_fmu *fmu, const char *call, cmb_result result) {
  const int before_start = (fmu->instance->situation.phase & CMB_BEFORE_START) != 0;
  return before_start ? finish_strictly(fmu, call, result) : finish(fmu, call, result);
}

static cmb_fmu_status refuse_null(cmb_fmu *fmu, const char *call) { return cmb_fmu_refuse(fmu, call, "null pointer"); }

static int has_arrays(cmb_fmu *fmu, const char *call, size_t count, const void *reference, const void *value) {
  if (count == 0 || (reference != NULL && value != NULL)) return 1;
  refuse_null(fmu, call);
  return 0;
}

/* -- life -- */

const char *cmb_fmu_open(cmb_fmu *fmu, const char *name, const char *token, int logging, cmb_log_sink sink,
                         void *receiver) {
  if (name == NULL || name[0] == '\0') return "the name of the instance is missing";
  if (token == NULL || strcmp(token, cmb_model.guid) != 0) {
    return "the GUID is not that of this FMU: modelDescription.xml and binary differ";
  }
  cmb_kind kind = CMB_KIND_MODEL_EXCHANGE;
  if (fmu->co_simulation) kind = fmu->event_mode_used ? CMB_KIND_CO_SIMULATION_WITH_EVENTS : CMB_KIND_CO_SIMULATION;
  fmu->instance = cmb_instance_create(name, kind, sink, receiver);
  if (fmu->instance == NULL) return "no memory";
  fmu->instance->logged[CMB_LOG_ALL] = logging;
  return NULL;
}

void cmb_fmu_close(cmb_fmu *fmu) { cmb_instance_destroy(fmu->instance); }

static int log_category(const char *name) {
  int category = 0;
  while (name != NULL && category < CMB_LOG_CATEGORY_COUNT && strcmp(name, cmb_log_category_name[category]) != 0) {
    ++category;
  }
  return name != NULL ? category : CMB_LOG_CATEGORY_COUNT;
}

cmb_fmu_status cmb_fmu_set_logging(cmb_fmu *fmu, const char *call, int on, size_t count,
                                   const char *const *categories) {
  if (!cmb_fmu_permits(fmu, call, CMB_ANY_PHASE)) return CMB_FMU_ERROR;
  if (count > 0 && categories == NULL) return refuse_null(fmu, call);
  int logged[CMB_LOG_CATEGORY_COUNT] = {0};
  if (count == 0) logged[CMB_LOG_ALL] = on;
  for (size_t i = 0; i < count; ++i) {
    const int category = log_category(categories[i]);
    if (category == CMB_LOG_CATEGORY_COUNT) return cmb_fmu_refuse(fmu, call, "unknown log category");
    logged[category] = on;
  }
  memcpy(fmu->instance->logged, logged, sizeof logged);
  return CMB_FMU_OK;
}

cmb_fmu_status cmb_fmu_set_experiment(cmb_fmu *fmu, const char *call, int tolerance_defined, double tolerance,
                                      double start_time, int stop_time_defined, double stop_time) {
  if (!cmb_fmu_permits(fmu, call, CMB_PHASE_INSTANTIATED)) return CMB_FMU_ERROR;
  if (!isfinite(start_time) || (stop_time_defined && !(stop_time >= start_time))) {
    return cmb_fmu_refuse(fmu, call, "start and stop time are not in order");
  }
  if (tolerance_defined && !(tolerance > 0.0 && tolerance < 1.0)) {
    return cmb_fmu_refuse(fmu, call, "the tolerance is not between 0 and 1");
  }
  cmb_settings *settings = &fmu->instance->situation.settings;
  settings->tolerance = tolerance_defined ? tolerance : 0.0;
  settings->start_time = start_time;
  settings->stop_time = stop_time_defined ? stop_time : HUGE_VAL;
  fmu->instance->values.time = start_time;
  return CMB_FMU_OK;
}

cmb_fmu_status cmb_fmu_enter_initialization(cmb_fmu *fmu, const char *call) {
  if (!cmb_fmu_permits(fmu, call, CMB_PHASE_INSTANTIATED)) return CMB_FMU_ERROR;
  fmu->instance->situation.phase = CMB_PHASE_INITIALIZATION;
  fmu->instance->situation.initialization_stale = 1;
  return CMB_FMU_OK;
}

cmb_fmu_status cmb_fmu_exit_initialization(cmb_fmu *fmu, const char *call) {
  if (!cmb_fmu_permits(fmu, call, CMB_PHASE_INITIALIZATION)) return CMB_FMU_ERROR;
  cmb_instance *instance = fmu->instance;
  cmb_result result = cmb_update_initialization(instance);
  if (result == CMB_RESULT_OK) {
    const int events_inside = fmu->co_simulation && !fmu->event_mode_used;
    instance->values.initial = 0;
    instance->situation.continuous_stale = 1;
    instance->situation.phase = events_inside ? CMB_PHASE_STEP : CMB_PHASE_EVENT;
    int states_changed = 0;
    if (events_inside) result = cmb_iterate_events(instance, &states_changed);
  }
  return finish_strictly(fmu, call, result);
}

cmb_fmu_status cmb_fmu_terminate(cmb_fmu *fmu, const char *call) {
  if (!cmb_fmu_permits(fmu, call, CMB_MODEL_EXCHANGE | CMB_CO_SIMULATION)) return CMB_FMU_ERROR;
  cmb_situation *situation = &fmu->instance->situation;
  cmb_result result = CMB_RESULT_OK;
  if (situation->phase != CMB_PHASE_STEP_FAILED || situation->terminate_requested) {
    if (situation->phase == CMB_PHASE_STEP_FAILED) situation->phase = CMB_PHASE_STEP; /* the step was cut short only */
    result = cmb_terminate(fmu->instance);
  }
  situation->phase = CMB_PHASE_TERMINATED;
  return finish(fmu, call, result);
}

cmb_fmu_status cmb_fmu_reset(cmb_fmu *fmu, const char *call) {
  if (!cmb_fmu_permits(fmu, call, CMB_ANY_PHASE)) return CMB_FMU_ERROR;
  return finish(fmu, call, cmb_instance_reset(fmu->instance));
}

/* -- values -- */

/* 1 if these references can be read, 0 (logged) if not. */
static int readable(cmb_fmu *fmu, const char *call, cmb_base_type type, const unsigned *reference, size_t count,
                    const void *value) {
  if (!cmb_fmu_permits(fmu, call, CMB_ANY_PHASE) || !has_arrays(fmu, call, count, reference, value)) return 0;
  if (cmb_check_references(fmu->instance, type, reference, count) == CMB_RESULT_OK) return 1;
  reject(fmu, call);
  return 0;
}

static int writable(cmb_fmu *fmu, const char *call, const unsigned *reference, size_t count, const void *value) {
  return cmb_fmu_permits(fmu, call, CMB_BEFORE_START | CMB_MODEL_EXCHANGE | CMB_PHASE_STEP) &&
         has_arrays(fmu, call, count, reference, value);
}

cmb_fmu_status cmb_fmu_get_real(cmb_fmu *fmu, const char *call, const unsigned *reference, size_t count,
                                double *value) {
  if (!readable(fmu, call, CMB_TYPE_REAL, reference, count, value)) return CMB_FMU_ERROR;
  return finish_read(fmu, call, cmb_get_real(fmu->instance, reference, count, value));
}

cmb_fmu_status cmb_fmu_get_integer(cmb_fmu *fmu, const char *call, const unsigned *reference, size_t count,
                                   int *value) {
  if (!readable(fmu, call, CMB_TYPE_INTEGER, reference, count, value)) return CMB_FMU_ERROR;
  return finish_read(fmu, call, cmb_get_integer(fmu->instance, reference, count, value));
}

cmb_fmu_status cmb_fmu_get_boolean(cmb_fmu *fmu, const char *call, const unsigned *reference, size_t count,
                                   int *value) {
  if (!readable(fmu, call, CMB_TYPE_BOOLEAN, reference, count, value)) return CMB_FMU_ERROR;
  return finish_read(fmu, call, cmb_get_boolean(fmu->instance, reference, count, value));
}

cmb_fmu_status cmb_fmu_get_string(cmb_fmu *fmu, const char *call, const unsigned *reference, size_t count,
                                  const char **value) {
  if (!readable(fmu, call, CMB_TYPE_STRING, reference, count, (const void *)value)) return CMB_FMU_ERROR;
  return finish_read(fmu, call, cmb_get_string(fmu->instance, reference, count, value));
}

static cmb_fmu_status finish_write(cmb_fmu *fmu, const char *call, cmb_result result) {
  return result == CMB_RESULT_OK ? CMB_FMU_OK : reject(fmu, call);
}

cmb_fmu_status cmb_fmu_set_real(cmb_fmu *fmu, const char *call, const unsigned *reference, size_t count,
                                const double *value) {
  if (!writable(fmu, call, reference, count, value)) return CMB_FMU_ERROR;
  return finish_write(fmu, call, cmb_set_reals(fmu->instance, reference, count, value));
}

cmb_fmu_status cmb_fmu_set_integer(cmb_fmu *fmu, const char *call, const unsigned *reference, size_t count,
                                   const int *value) {
  if (!writable(fmu, call, reference, count, value)) return CMB_FMU_ERROR;
  return finish_write(fmu, call, cmb_set_integers(fmu->instance, reference, count, value));
}

cmb_fmu_status cmb_fmu_set_boolean(cmb_fmu *fmu, const char *call, const unsigned *reference, size_t count,
                                   const int *value) {
  if (!writable(fmu, call, reference, count, value)) return CMB_FMU_ERROR;
  return finish_write(fmu, call, cmb_set_booleans(fmu->instance, reference, count, value));
}

cmb_fmu_status cmb_fmu_set_string(cmb_fmu *fmu, const char *call, const unsigned *reference, size_t count,
                                  const char *const *value) {
  if (!writable(fmu, call, reference, count, (const void *)value)) return CMB_FMU_ERROR;
  return finish_write(fmu, call, cmb_set_strings(fmu->instance, reference, count, value));
}

/* -- state of the FMU -- */

cmb_fmu_status cmb_fmu_get_state(cmb_fmu *fmu, const char *call, void **state) {
  if (!cmb_fmu_permits(fmu, call, CMB_ANY_PHASE)) return CMB_FMU_ERROR;
  if (state == NULL) return refuse_null(fmu, call);
  cmb_state *saved = *state;
  if (cmb_state_save(fmu->instance, &saved) != CMB_RESULT_OK) return cmb_fmu_refuse(fmu, call, "no memory");
  *state = saved;
  return CMB_FMU_OK;
}

cmb_fmu_status cmb_fmu_set_state(cmb_fmu *fmu, const char *call, const void *state) {
  if (!cmb_fmu_permits(fmu, call, CMB_ANY_PHASE)) return CMB_FMU_ERROR;
  if (state == NULL) return refuse_null(fmu, call);
  if (!cmb_state_fits(fmu->instance, state)) {
    return cmb_fmu_refuse(fmu, call, "the state is of an instance for another use (model exchange, co-simulation, "
                                     "co-simulation with event mode)");
  }
  if (cmb_state_restore(fmu->instance, state) != CMB_RESULT_OK) return cmb_fmu_refuse(fmu, call, "no memory");
  return CMB_FMU_OK;
}

cmb_fmu_status cmb_fmu_free_state(cmb_fmu *fmu, const char *call, void **state) {
  if (!cmb_fmu_permits(fmu, call, CMB_ANY_PHASE)) return CMB_FMU_ERROR;
  if (state == NULL) return CMB_FMU_OK;
  cmb_state_free(*state);
  *state = NULL;
  return CMB_FMU_OK;
}

cmb_fmu_status cmb_fmu_state_size(cmb_fmu *fmu, const char *call, const void *state, size_t *size) {
  if (!cmb_fmu_permits(fmu, call, CMB_ANY_PHASE)) return CMB_FMU_ERROR;
  if (state == NULL || size == NULL) return refuse_null(fmu, call);
  *size = cmb_state_size(state);
  return CMB_FMU_OK;
}

cmb_fmu_status cmb_fmu_write_state(cmb_fmu *fmu, const char *call, const void *state, char *bytes, size_t size) {
  if (!cmb_fmu_permits(fmu, call, CMB_ANY_PHASE)) return CMB_FMU_ERROR;
  if (state == NULL || bytes == NULL) return refuse_null(fmu, call);
  if (size < cmb_state_size(state)) return cmb_fmu_refuse(fmu, call, "the array is too small");
  cmb_state_write(state, bytes);
  return CMB_FMU_OK;
}

cmb_fmu_status cmb_fmu_read_state(cmb_fmu *fmu, const char *call, const char *bytes, size_t size, void **state) {
  if (!cmb_fmu_permits(fmu, call, CMB_ANY_PHASE)) return CMB_FMU_ERROR;
  if (bytes == NULL || state == NULL) return refuse_null(fmu, call);
  cmb_state *read = cmb_state_read(bytes, size);
  if (read == NULL) return cmb_fmu_refuse(fmu, call, "these bytes are not a state of this FMU");
  *state = read;
  return CMB_FMU_OK;
}

/* -- derivatives -- */

static int are_model_variables(const unsigned *reference, size_t count) {
  for (size_t i = 0; i < count; ++i) {
    if (reference[i] >= cmb_model.real_count) return 0;
  }
  return 1;
}

cmb_fmu_status cmb_fmu_directional_derivative(cmb_fmu *fmu, const char *call, const unsigned *unknown,
                                              size_t unknown_count, const unsigned *known, size_t known_count,
                                              const double *seed, double *sensitivity) {
  if (!cmb_fmu_permits(fmu, call, CMB_PHASE_INITIALIZATION | CMB_MODEL_EXCHANGE | CMB_PHASE_STEP) ||
      !has_arrays(fmu, call, unknown_count, unknown, sensitivity) ||
      !has_arrays(fmu, call, known_count, known, seed)) {
    return CMB_FMU_ERROR;
  }
  if (!are_model_variables(unknown, unknown_count) || !are_model_variables(known, known_count)) {
    return cmb_fmu_refuse(fmu, call, "a value reference is no Real variable of the model");
  }
  return finish(fmu, call,
                cmb_directional_derivative(fmu->instance, unknown, unknown_count, known, known_count, seed,
                                           sensitivity));
}

/* -- modes -- */

cmb_fmu_status cmb_fmu_enter_event_mode(cmb_fmu *fmu, const char *call) {
  if (!cmb_fmu_permits(fmu, call, CMB_MODEL_EXCHANGE | CMB_PHASE_STEP)) return CMB_FMU_ERROR;
  if (fmu->co_simulation && !fmu->event_mode_used) {
    return cmb_fmu_refuse(fmu, call, "this instance handles its events itself");
  }
  fmu->instance->situation.phase = CMB_PHASE_EVENT;
  return CMB_FMU_OK;
}

cmb_fmu_status cmb_fmu_update_discrete_states(cmb_fmu *fmu, const char *call, cmb_event_report *report) {
  memset(report, 0, sizeof *report);
  if (!cmb_fmu_permits(fmu, call, CMB_PHASE_EVENT)) return CMB_FMU_ERROR;
  const cmb_result result = cmb_iterate_events(fmu->instance, &report->states_changed);
  cmb_solver_restart(fmu->instance->solver);
  report->terminate = fmu->instance->situation.terminate_requested;
  report->next_time_defined = isfinite(fmu->instance->values.next_time_event);
  report->next_time = report->next_time_defined ? fmu->instance->values.next_time_event : 0.0;
  return finish_strictly(fmu, call, result);
}

cmb_fmu_status cmb_fmu_enter_continuous_time_mode(cmb_fmu *fmu, const char *call) {
  if (!cmb_fmu_permits(fmu, call, CMB_PHASE_EVENT)) return CMB_FMU_ERROR;
  if (fmu->co_simulation) return cmb_fmu_refuse(fmu, call, "this instance is for co-simulation");
  fmu->instance->situation.phase = CMB_PHASE_CONTINUOUS;
  return CMB_FMU_OK;
}

cmb_fmu_status cmb_fmu_enter_step_mode(cmb_fmu *fmu, const char *call) {
  if (!cmb_fmu_permits(fmu, call, CMB_PHASE_EVENT)) return CMB_FMU_ERROR;
  if (!fmu->co_simulation) return cmb_fmu_refuse(fmu, call, "this instance is for model exchange");
  fmu->instance->situation.phase = CMB_PHASE_STEP;
  return CMB_FMU_OK;
}

/* -- model exchange -- */

enum { EVALUATION_PHASES = CMB_PHASE_INITIALIZATION | CMB_MODEL_EXCHANGE | CMB_AFTER_END };

/* 1 if an array of `count` values, of which there are `expected`, may be passed now. */
static int accepts(cmb_fmu *fmu, const char *call, int phases, const double *array, size_t count, size_t expected) {
  if (!cmb_fmu_permits(fmu, call, phases)) return 0;
  if (count == expected && (count == 0 || array != NULL)) return 1;
  cmb_fmu_refuse(fmu, call, count == expected ? "null pointer" : "wrong number of values");
  return 0;
}

cmb_fmu_status cmb_fmu_set_time(cmb_fmu *fmu, const char *call, double time) {
  if (!cmb_fmu_permits(fmu, call, CMB_MODEL_EXCHANGE)) return CMB_FMU_ERROR;
  if (fmu->co_simulation) return cmb_fmu_refuse(fmu, call, "this instance is for co-simulation");
  if (!isfinite(time)) return cmb_fmu_refuse(fmu, call, "the time is not finite");
  if (fmu->instance->values.time != time) {
    fmu->instance->values.time = time;
    fmu->instance->situation.continuous_stale = 1;
  }
  return CMB_FMU_OK;
}

cmb_fmu_status cmb_fmu_set_states(cmb_fmu *fmu, const char *call, const double *state, size_t count) {
  if (!accepts(fmu, call, CMB_PHASE_CONTINUOUS, state, count, cmb_model.state_count)) return CMB_FMU_ERROR;
  for (size_t i = 0; i < count; ++i) {
    if (isfinite(state[i])) continue;
    cmb_log(fmu->instance, CMB_LOG_DISCARD, CMB_LOG_STATUS_DISCARD, "%s: %s is not finite", call,
            cmb_slot_name(&cmb_interface_tables.real, cmb_model.state[i]));
    return CMB_FMU_DISCARD;
  }
  cmb_set_point(fmu->instance, fmu->instance->values.time, state);
  return CMB_FMU_OK;
}

cmb_fmu_status cmb_fmu_get_states(cmb_fmu *fmu, const char *call, double *state, size_t count) {
  if (!accepts(fmu, call, EVALUATION_PHASES, state, count, cmb_model.state_count)) return CMB_FMU_ERROR;
  cmb_result result = CMB_RESULT_OK;
  if (fmu->instance->situation.phase == CMB_PHASE_INITIALIZATION) result = cmb_update_initialization(fmu->instance);
  for (size_t i = 0; result == CMB_RESULT_OK && i < count; ++i) {
    state[i] = fmu->instance->values.real[cmb_model.state[i]];
  }
  return finish_read(fmu, call, result);
}

cmb_fmu_status cmb_fmu_get_derivatives(cmb_fmu *fmu, const char *call, double *derivative, size_t count) {
  if (!accepts(fmu, call, EVALUATION_PHASES, derivative, count, cmb_model.state_count)) return CMB_FMU_ERROR;
  const cmb_result result = cmb_update_values(fmu->instance);
  for (size_t i = 0; result == CMB_RESULT_OK && i < count; ++i) {
    derivative[i] = fmu->instance->values.real[cmb_model.derivative[i]];
  }
  return finish_read(fmu, call, result);
}

cmb_fmu_status cmb_fmu_get_indicators(cmb_fmu *fmu, const char *call, double *indicator, size_t count) {
  if (!accepts(fmu, call, EVALUATION_PHASES, indicator, count, cmb_model.indicator_count)) return CMB_FMU_ERROR;
  if (count == 0) return CMB_FMU_OK;
  return finish_read(fmu, call, cmb_event_indicators(fmu->instance, indicator));
}

cmb_fmu_status cmb_fmu_get_indicator(cmb_fmu *fmu, const char *call, size_t index, double *indicator) {
  if (!cmb_fmu_permits(fmu, call, CMB_ANY_PHASE)) return CMB_FMU_ERROR;
  if (index >= cmb_model.indicator_count) return cmb_fmu_refuse(fmu, call, "there is no such event indicator");
  *indicator = 0.0;
  if (fmu->instance->situation.phase == CMB_PHASE_INSTANTIATED) return CMB_FMU_OK;
  double *shifted = calloc(cmb_model.indicator_count, sizeof *shifted);
  if (shifted == NULL) return cmb_fmu_refuse(fmu, call, "no memory");
  const cmb_result result = cmb_event_indicators(fmu->instance, shifted);
  *indicator = shifted[index];
  free(shifted);
  return finish_read(fmu, call, result);
}

cmb_fmu_status cmb_fmu_get_nominals(cmb_fmu *fmu, const char *call, double *nominal, size_t count) {
  if (!accepts(fmu, call, EVALUATION_PHASES | CMB_PHASE_INSTANTIATED, nominal, count, cmb_model.state_count)) {
    return CMB_FMU_ERROR;
  }
  if (count > 0) memcpy(nominal, cmb_model.state_nominal, count * sizeof *nominal);
  return CMB_FMU_OK;
}

/* -- co-simulation -- */

cmb_fmu_status cmb_fmu_do_step(cmb_fmu *fmu, const char *call, double time, double step, cmb_step_report *report) {
  memset(report, 0, sizeof *report);
  if (!cmb_fmu_permits(fmu, call, CMB_PHASE_STEP)) return CMB_FMU_ERROR;
  cmb_instance *instance = fmu->instance;
  report->time = instance->values.time;
  if (!isfinite(time) || !isfinite(step) || !(step > 0.0)) {
    return cmb_fmu_refuse(fmu, call, "the step size is not positive");
  }
  if (fabs(time - instance->values.time) > 1e-6 * step + 1e-12 * fabs(time)) {
    return cmb_fmu_refuse(fmu, call, "the communication point is not the time this FMU has reached");
  }
  const double target = time + step;
  /* Masters that add up the step size miss the stop time by the rounding of all their additions. */
  if (target > instance->situation.settings.stop_time + 1e-3 * step) {
    return cmb_fmu_refuse(fmu, call, "the step ends after the stop time");
  }
  const int stop_at_events = fmu->event_mode_used && fmu->early_return_allowed;
  const cmb_result result = cmb_do_step(instance, target, stop_at_events, &report->event_waiting);
  const cmb_fmu_status status = finish(fmu, call, result);
  report->time = instance->values.time;
  report->terminate = status == CMB_FMU_OK && instance->situation.terminate_requested;
  if (status == CMB_FMU_DISCARD) instance->situation.phase = CMB_PHASE_STEP_FAILED;
  return status;
}
