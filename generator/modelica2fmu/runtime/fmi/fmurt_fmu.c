/* fmurt_fmu.c - see fmurt_fmu.h. */
#include "fmurt_fmu.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fmurt_call.h"
#include "fmurt_chatter.h"
#include "fmurt_derivative.h"
#include "fmurt_evaluate.h"
#include "fmurt_event.h"
#include "fmurt_solver.h"
#include "fmurt_step.h"

/* -- checks and results -- */

fmurt_fmu_status fmurt_fmu_refuse(fmurt_fmu *fmu, const char *call, const char *reason) {
  fmurt_log(fmu->instance, FMURT_LOG_ERROR, FMURT_LOG_STATUS_ERROR, "%s: %s", call, reason);
  return FMURT_FMU_ERROR;
}

int fmurt_fmu_permits(fmurt_fmu *fmu, const char *call, int phases) {
  if (fmu == NULL) return 0;
  if (fmu->instance->situation.phase & phases) return 1;
  fmurt_fmu_refuse(fmu, call, "not permitted in the present state of the FMU");
  return 0;
}

/* The call was wrong; the cause is in the instance's message. */
static fmurt_fmu_status reject(fmurt_fmu *fmu, const char *call) {
  return fmurt_fmu_refuse(fmu, call, fmu->instance->message);
}

/* Outcome of an evaluation of the model: an error ends in the error state. */
static fmurt_fmu_status finish(fmurt_fmu *fmu, const char *call, fmurt_result result) {
  switch (result) {
    case FMURT_RESULT_OK: return FMURT_FMU_OK;
    case FMURT_RESULT_DISCARD:
      fmurt_log(fmu->instance, FMURT_LOG_DISCARD, FMURT_LOG_STATUS_DISCARD, "%s: %s", call, fmu->instance->message);
      return FMURT_FMU_DISCARD;
    case FMURT_RESULT_ERROR: break;
  }
  fmu->instance->situation.phase = FMURT_PHASE_ERROR;
  return reject(fmu, call);
}

/* Outcome where no smaller step can help: initialization and events. */
static fmurt_fmu_status finish_strictly(fmurt_fmu *fmu, const char *call, fmurt_result result) {
  return finish(fmu, call, result == FMURT_RESULT_DISCARD ? FMURT_RESULT_ERROR : result);
}

static fmurt_fmu_status finish_read(fmurt_fmu *fmu, const char *call, fmurt_result result) {
  const int before_start = (fmu->instance->situation.phase & FMURT_BEFORE_START) != 0;
  return before_start ? finish_strictly(fmu, call, result) : finish(fmu, call, result);
}

static fmurt_fmu_status refuse_null(fmurt_fmu *fmu, const char *call) {
  return fmurt_fmu_refuse(fmu, call, "null pointer");
}

static int has_arrays(fmurt_fmu *fmu, const char *call, size_t count, const void *reference, const void *value) {
  if (count == 0 || (reference != NULL && value != NULL)) return 1;
  refuse_null(fmu, call);
  return 0;
}

/* -- life -- */

const char *fmurt_fmu_open(fmurt_fmu *fmu, const char *name, const char *token, int logging, fmurt_log_sink sink,
                           void *receiver) {
  if (name == NULL || name[0] == '\0') return "the name of the instance is missing";
  if (token == NULL || strcmp(token, fmurt_model.guid) != 0) {
    return "the GUID is not that of this FMU: modelDescription.xml and binary differ";
  }
  fmurt_kind kind = FMURT_KIND_MODEL_EXCHANGE;
  if (fmu->co_simulation) kind = fmu->event_mode_used ? FMURT_KIND_CO_SIMULATION_WITH_EVENTS : FMURT_KIND_CO_SIMULATION;
  fmu->instance = fmurt_instance_create(name, kind, sink, receiver);
  if (fmu->instance == NULL) return "no memory";
  fmu->instance->logged[FMURT_LOG_ALL] = logging;
  return NULL;
}

void fmurt_fmu_close(fmurt_fmu *fmu) { fmurt_instance_destroy(fmu->instance); }

static int log_category(const char *name) {
  int category = 0;
  while (name != NULL && category < FMURT_LOG_CATEGORY_COUNT && strcmp(name, fmurt_log_category_name[category]) != 0) {
    ++category;
  }
  return name != NULL ? category : FMURT_LOG_CATEGORY_COUNT;
}

fmurt_fmu_status fmurt_fmu_set_logging(fmurt_fmu *fmu, const char *call, int on, size_t count,
                                       const char *const *categories) {
  if (!fmurt_fmu_permits(fmu, call, FMURT_ANY_PHASE)) return FMURT_FMU_ERROR;
  if (count > 0 && categories == NULL) return refuse_null(fmu, call);
  int logged[FMURT_LOG_CATEGORY_COUNT] = {0};
  if (count == 0) logged[FMURT_LOG_ALL] = on;
  for (size_t i = 0; i < count; ++i) {
    const int category = log_category(categories[i]);
    if (category == FMURT_LOG_CATEGORY_COUNT) return fmurt_fmu_refuse(fmu, call, "unknown log category");
    logged[category] = on;
  }
  memcpy(fmu->instance->logged, logged, sizeof logged);
  return FMURT_FMU_OK;
}

fmurt_fmu_status fmurt_fmu_set_experiment(fmurt_fmu *fmu, const char *call, int tolerance_defined, double tolerance,
                                          double start_time, int stop_time_defined, double stop_time) {
  if (!fmurt_fmu_permits(fmu, call, FMURT_PHASE_INSTANTIATED)) return FMURT_FMU_ERROR;
  if (!isfinite(start_time) || (stop_time_defined && !(stop_time >= start_time))) {
    return fmurt_fmu_refuse(fmu, call, "start and stop time are not in order");
  }
  if (tolerance_defined && !(tolerance > 0.0 && tolerance < 1.0)) {
    return fmurt_fmu_refuse(fmu, call, "the tolerance is not between 0 and 1");
  }
  fmurt_settings *settings = &fmu->instance->situation.settings;
  settings->tolerance = tolerance_defined ? tolerance : 0.0;
  settings->start_time = start_time;
  settings->stop_time = stop_time_defined ? stop_time : HUGE_VAL;
  fmu->instance->values.time = start_time;
  return FMURT_FMU_OK;
}

fmurt_fmu_status fmurt_fmu_enter_initialization(fmurt_fmu *fmu, const char *call) {
  if (!fmurt_fmu_permits(fmu, call, FMURT_PHASE_INSTANTIATED)) return FMURT_FMU_ERROR;
  fmu->instance->situation.phase = FMURT_PHASE_INITIALIZATION;
  fmu->instance->situation.initialization_stale = 1;
  return FMURT_FMU_OK;
}

fmurt_fmu_status fmurt_fmu_exit_initialization(fmurt_fmu *fmu, const char *call) {
  if (!fmurt_fmu_permits(fmu, call, FMURT_PHASE_INITIALIZATION)) return FMURT_FMU_ERROR;
  fmurt_instance *instance = fmu->instance;
  fmurt_result result = fmurt_update_initialization(instance);
  if (result == FMURT_RESULT_OK) {
    const int events_inside = fmu->co_simulation && !fmu->event_mode_used;
    instance->values.initial = 0;
    instance->situation.continuous_stale = 1;
    instance->situation.phase = events_inside ? FMURT_PHASE_STEP : FMURT_PHASE_EVENT;
    fmurt_accept(instance);
    int states_changed = 0;
    if (events_inside) result = fmurt_iterate_events(instance, &states_changed);
  }
  return finish_strictly(fmu, call, result);
}

fmurt_fmu_status fmurt_fmu_terminate(fmurt_fmu *fmu, const char *call) {
  if (!fmurt_fmu_permits(fmu, call, FMURT_MODEL_EXCHANGE | FMURT_CO_SIMULATION)) return FMURT_FMU_ERROR;
  fmurt_situation *situation = &fmu->instance->situation;
  fmurt_result result = FMURT_RESULT_OK;
  if (situation->phase != FMURT_PHASE_STEP_FAILED || situation->terminate_requested) {
    if (situation->phase == FMURT_PHASE_STEP_FAILED)
      situation->phase = FMURT_PHASE_STEP; /* the step was cut short only */
    result = fmurt_terminate(fmu->instance);
  }
  situation->phase = FMURT_PHASE_TERMINATED;
  return finish(fmu, call, result);
}

fmurt_fmu_status fmurt_fmu_reset(fmurt_fmu *fmu, const char *call) {
  if (!fmurt_fmu_permits(fmu, call, FMURT_ANY_PHASE)) return FMURT_FMU_ERROR;
  return finish(fmu, call, fmurt_instance_reset(fmu->instance));
}

/* -- values -- */

/* 1 if these references can be read, 0 (logged) if not. */
static int readable(fmurt_fmu *fmu, const char *call, fmurt_base_type type, const unsigned *reference, size_t count,
                    const void *value) {
  if (!fmurt_fmu_permits(fmu, call, FMURT_ANY_PHASE) || !has_arrays(fmu, call, count, reference, value)) return 0;
  if (fmurt_check_references(fmu->instance, type, reference, count) == FMURT_RESULT_OK) return 1;
  reject(fmu, call);
  return 0;
}

static int writable(fmurt_fmu *fmu, const char *call, const unsigned *reference, size_t count, const void *value) {
  return fmurt_fmu_permits(fmu, call, FMURT_BEFORE_START | FMURT_MODEL_EXCHANGE | FMURT_PHASE_STEP) &&
         has_arrays(fmu, call, count, reference, value);
}

fmurt_fmu_status fmurt_fmu_get_real(fmurt_fmu *fmu, const char *call, const unsigned *reference, size_t count,
                                    double *value) {
  if (!readable(fmu, call, FMURT_TYPE_REAL, reference, count, value)) return FMURT_FMU_ERROR;
  return finish_read(fmu, call, fmurt_get_real(fmu->instance, reference, count, value));
}

fmurt_fmu_status fmurt_fmu_get_integer(fmurt_fmu *fmu, const char *call, const unsigned *reference, size_t count,
                                       int *value) {
  if (!readable(fmu, call, FMURT_TYPE_INTEGER, reference, count, value)) return FMURT_FMU_ERROR;
  return finish_read(fmu, call, fmurt_get_integer(fmu->instance, reference, count, value));
}

fmurt_fmu_status fmurt_fmu_get_boolean(fmurt_fmu *fmu, const char *call, const unsigned *reference, size_t count,
                                       int *value) {
  if (!readable(fmu, call, FMURT_TYPE_BOOLEAN, reference, count, value)) return FMURT_FMU_ERROR;
  return finish_read(fmu, call, fmurt_get_boolean(fmu->instance, reference, count, value));
}

fmurt_fmu_status fmurt_fmu_get_string(fmurt_fmu *fmu, const char *call, const unsigned *reference, size_t count,
                                      const char **value) {
  if (!readable(fmu, call, FMURT_TYPE_STRING, reference, count, (const void *)value)) return FMURT_FMU_ERROR;
  return finish_read(fmu, call, fmurt_get_string(fmu->instance, reference, count, value));
}

static fmurt_fmu_status finish_write(fmurt_fmu *fmu, const char *call, fmurt_result result) {
  return result == FMURT_RESULT_OK ? FMURT_FMU_OK : reject(fmu, call);
}

fmurt_fmu_status fmurt_fmu_set_real(fmurt_fmu *fmu, const char *call, const unsigned *reference, size_t count,
                                    const double *value) {
  if (!writable(fmu, call, reference, count, value)) return FMURT_FMU_ERROR;
  return finish_write(fmu, call, fmurt_set_reals(fmu->instance, reference, count, value));
}

fmurt_fmu_status fmurt_fmu_set_integer(fmurt_fmu *fmu, const char *call, const unsigned *reference, size_t count,
                                       const int *value) {
  if (!writable(fmu, call, reference, count, value)) return FMURT_FMU_ERROR;
  return finish_write(fmu, call, fmurt_set_integers(fmu->instance, reference, count, value));
}

fmurt_fmu_status fmurt_fmu_set_boolean(fmurt_fmu *fmu, const char *call, const unsigned *reference, size_t count,
                                       const int *value) {
  if (!writable(fmu, call, reference, count, value)) return FMURT_FMU_ERROR;
  return finish_write(fmu, call, fmurt_set_booleans(fmu->instance, reference, count, value));
}

fmurt_fmu_status fmurt_fmu_set_string(fmurt_fmu *fmu, const char *call, const unsigned *reference, size_t count,
                                      const char *const *value) {
  if (!writable(fmu, call, reference, count, (const void *)value)) return FMURT_FMU_ERROR;
  return finish_write(fmu, call, fmurt_set_strings(fmu->instance, reference, count, value));
}

/* -- state of the FMU -- */

fmurt_fmu_status fmurt_fmu_get_state(fmurt_fmu *fmu, const char *call, void **state) {
  if (!fmurt_fmu_permits(fmu, call, FMURT_ANY_PHASE)) return FMURT_FMU_ERROR;
  if (state == NULL) return refuse_null(fmu, call);
  fmurt_state *saved = *state;
  if (fmurt_state_save(fmu->instance, &saved) != FMURT_RESULT_OK) return fmurt_fmu_refuse(fmu, call, "no memory");
  *state = saved;
  return FMURT_FMU_OK;
}

fmurt_fmu_status fmurt_fmu_set_state(fmurt_fmu *fmu, const char *call, const void *state) {
  if (!fmurt_fmu_permits(fmu, call, FMURT_ANY_PHASE)) return FMURT_FMU_ERROR;
  if (state == NULL) return refuse_null(fmu, call);
  if (!fmurt_state_fits(fmu->instance, state)) {
    return fmurt_fmu_refuse(fmu, call,
                            "the state is of an instance for another use (model exchange, co-simulation, "
                            "co-simulation with event mode)");
  }
  if (fmurt_state_restore(fmu->instance, state) != FMURT_RESULT_OK) return fmurt_fmu_refuse(fmu, call, "no memory");
  return FMURT_FMU_OK;
}

fmurt_fmu_status fmurt_fmu_free_state(fmurt_fmu *fmu, const char *call, void **state) {
  if (!fmurt_fmu_permits(fmu, call, FMURT_ANY_PHASE)) return FMURT_FMU_ERROR;
  if (state == NULL) return FMURT_FMU_OK;
  fmurt_state_free(*state);
  *state = NULL;
  return FMURT_FMU_OK;
}

fmurt_fmu_status fmurt_fmu_state_size(fmurt_fmu *fmu, const char *call, const void *state, size_t *size) {
  if (!fmurt_fmu_permits(fmu, call, FMURT_ANY_PHASE)) return FMURT_FMU_ERROR;
  if (state == NULL || size == NULL) return refuse_null(fmu, call);
  *size = fmurt_state_size(state);
  return FMURT_FMU_OK;
}

fmurt_fmu_status fmurt_fmu_write_state(fmurt_fmu *fmu, const char *call, const void *state, char *bytes, size_t size) {
  if (!fmurt_fmu_permits(fmu, call, FMURT_ANY_PHASE)) return FMURT_FMU_ERROR;
  if (state == NULL || bytes == NULL) return refuse_null(fmu, call);
  if (size < fmurt_state_size(state)) return fmurt_fmu_refuse(fmu, call, "the array is too small");
  fmurt_state_write(state, bytes);
  return FMURT_FMU_OK;
}

fmurt_fmu_status fmurt_fmu_read_state(fmurt_fmu *fmu, const char *call, const char *bytes, size_t size, void **state) {
  if (!fmurt_fmu_permits(fmu, call, FMURT_ANY_PHASE)) return FMURT_FMU_ERROR;
  if (bytes == NULL || state == NULL) return refuse_null(fmu, call);
  fmurt_state *read = fmurt_state_read(bytes, size);
  if (read == NULL) return fmurt_fmu_refuse(fmu, call, "these bytes are not a state of this FMU");
  *state = read;
  return FMURT_FMU_OK;
}

/* -- derivatives -- */

static int are_model_variables(const unsigned *reference, size_t count) {
  for (size_t i = 0; i < count; ++i) {
    if (reference[i] >= fmurt_model.real_count) return 0;
  }
  return 1;
}

fmurt_fmu_status fmurt_fmu_directional_derivative(fmurt_fmu *fmu, const char *call, const unsigned *unknown,
                                                  size_t unknown_count, const unsigned *known, size_t known_count,
                                                  const double *seed, double *sensitivity) {
  if (!fmurt_fmu_permits(fmu, call, FMURT_PHASE_INITIALIZATION | FMURT_MODEL_EXCHANGE | FMURT_PHASE_STEP) ||
      !has_arrays(fmu, call, unknown_count, unknown, sensitivity) || !has_arrays(fmu, call, known_count, known, seed)) {
    return FMURT_FMU_ERROR;
  }
  if (!are_model_variables(unknown, unknown_count) || !are_model_variables(known, known_count)) {
    return fmurt_fmu_refuse(fmu, call, "a value reference is no Real variable of the model");
  }
  return finish(
      fmu, call,
      fmurt_directional_derivative(fmu->instance, unknown, unknown_count, known, known_count, seed, sensitivity));
}

/* -- modes -- */

fmurt_fmu_status fmurt_fmu_enter_event_mode(fmurt_fmu *fmu, const char *call) {
  if (!fmurt_fmu_permits(fmu, call, FMURT_MODEL_EXCHANGE | FMURT_PHASE_STEP)) return FMURT_FMU_ERROR;
  if (fmu->co_simulation && !fmu->event_mode_used) {
    return fmurt_fmu_refuse(fmu, call, "this instance handles its events itself");
  }
  fmu->instance->situation.phase = FMURT_PHASE_EVENT;
  return FMURT_FMU_OK;
}

fmurt_fmu_status fmurt_fmu_update_discrete_states(fmurt_fmu *fmu, const char *call, fmurt_event_report *report) {
  memset(report, 0, sizeof *report);
  if (!fmurt_fmu_permits(fmu, call, FMURT_PHASE_EVENT)) return FMURT_FMU_ERROR;
  const int time_event = fmu->instance->values.time >= fmu->instance->values.next_time_event;
  const fmurt_result result = fmurt_iterate_events(fmu->instance, &report->states_changed);
  fmurt_solver_restart(fmu->instance->solver);
  const int happened = time_event || fmu->instance->chatter.changed; /* importers may ask at every step */
  if (result == FMURT_RESULT_OK && happened && fmurt_chatter_found(fmu->instance)) { /* for the importer to decide */
    fmurt_log(fmu->instance, FMURT_LOG_WARNING, FMURT_LOG_STATUS_WARNING, "%s: %s", call, fmu->instance->message);
  }
  report->terminate = fmu->instance->situation.terminate_requested;
  report->next_time_defined = isfinite(fmu->instance->values.next_time_event);
  report->next_time = report->next_time_defined ? fmu->instance->values.next_time_event : 0.0;
  return finish_strictly(fmu, call, result);
}

fmurt_fmu_status fmurt_fmu_enter_continuous_time_mode(fmurt_fmu *fmu, const char *call) {
  if (!fmurt_fmu_permits(fmu, call, FMURT_PHASE_EVENT)) return FMURT_FMU_ERROR;
  if (fmu->co_simulation) return fmurt_fmu_refuse(fmu, call, "this instance is for co-simulation");
  fmu->instance->situation.phase = FMURT_PHASE_CONTINUOUS;
  return FMURT_FMU_OK;
}

fmurt_fmu_status fmurt_fmu_enter_step_mode(fmurt_fmu *fmu, const char *call) {
  if (!fmurt_fmu_permits(fmu, call, FMURT_PHASE_EVENT)) return FMURT_FMU_ERROR;
  if (!fmu->co_simulation) return fmurt_fmu_refuse(fmu, call, "this instance is for model exchange");
  fmu->instance->situation.phase = FMURT_PHASE_STEP;
  return FMURT_FMU_OK;
}

/* -- model exchange -- */

enum { EVALUATION_PHASES = FMURT_PHASE_INITIALIZATION | FMURT_MODEL_EXCHANGE | FMURT_AFTER_END };

/* 1 if an array of `count` values, of which there are `expected`, may be passed now. */
static int accepts(fmurt_fmu *fmu, const char *call, int phases, const double *array, size_t count, size_t expected) {
  if (!fmurt_fmu_permits(fmu, call, phases)) return 0;
  if (count == expected && (count == 0 || array != NULL)) return 1;
  fmurt_fmu_refuse(fmu, call, count == expected ? "null pointer" : "wrong number of values");
  return 0;
}

fmurt_fmu_status fmurt_fmu_completed_step(fmurt_fmu *fmu, const char *call) {
  if (!fmurt_fmu_permits(fmu, call, FMURT_PHASE_CONTINUOUS)) return FMURT_FMU_ERROR;
  fmurt_instance *instance = fmu->instance;
  if (fmurt_model.followed_count == 0) {
    /* The importer's last evaluation was of the end of the step, but for a correction that it takes for none: warnings are
     * checked there, without another one. */
    if (fmurt_model.warnings != NULL) (void)fmurt_call_model(instance, FMURT_CALL_WARNINGS, NULL);
    return FMURT_FMU_OK;
  }
  /* What cannot be evaluated is told when it is read. */
  if (fmurt_update_values(instance) != FMURT_RESULT_OK) return FMURT_FMU_OK;
  if (instance->values.strayed) {
    snprintf(instance->message, sizeof instance->message,
             "At time %.9g a nonlinear system cannot be followed from the last completed step: a loop may have come to another "
             "closure than before. Take shorter steps or a smaller tolerance, or choose other states, such as other joints of "
             "the loop",
             instance->values.time);
    return finish(fmu, call, FMURT_RESULT_ERROR);
  }
  fmurt_accept(instance);
  return FMURT_FMU_OK;
}

fmurt_fmu_status fmurt_fmu_set_time(fmurt_fmu *fmu, const char *call, double time) {
  if (!fmurt_fmu_permits(fmu, call, FMURT_MODEL_EXCHANGE)) return FMURT_FMU_ERROR;
  if (fmu->co_simulation) return fmurt_fmu_refuse(fmu, call, "this instance is for co-simulation");
  if (!isfinite(time)) return fmurt_fmu_refuse(fmu, call, "the time is not finite");
  if (fmu->instance->values.time != time) {
    fmu->instance->values.time = time;
    fmu->instance->situation.continuous_stale = 1;
  }
  return FMURT_FMU_OK;
}

fmurt_fmu_status fmurt_fmu_set_states(fmurt_fmu *fmu, const char *call, const double *state, size_t count) {
  if (!accepts(fmu, call, FMURT_PHASE_CONTINUOUS, state, count, fmurt_model.state_count)) return FMURT_FMU_ERROR;
  for (size_t i = 0; i < count; ++i) {
    if (isfinite(state[i])) continue;
    fmurt_log(fmu->instance, FMURT_LOG_DISCARD, FMURT_LOG_STATUS_DISCARD, "%s: %s is not finite", call,
              fmurt_slot_name(&fmurt_interface_tables.real, fmurt_model.state[i]));
    return FMURT_FMU_DISCARD;
  }
  fmurt_set_point(fmu->instance, fmu->instance->values.time, state);
  return FMURT_FMU_OK;
}

fmurt_fmu_status fmurt_fmu_get_states(fmurt_fmu *fmu, const char *call, double *state, size_t count) {
  if (!accepts(fmu, call, EVALUATION_PHASES, state, count, fmurt_model.state_count)) return FMURT_FMU_ERROR;
  fmurt_result result = FMURT_RESULT_OK;
  if (fmu->instance->situation.phase == FMURT_PHASE_INITIALIZATION) result = fmurt_update_initialization(fmu->instance);
  for (size_t i = 0; result == FMURT_RESULT_OK && i < count; ++i) {
    state[i] = fmu->instance->values.real[fmurt_model.state[i]];
  }
  return finish_read(fmu, call, result);
}

fmurt_fmu_status fmurt_fmu_get_derivatives(fmurt_fmu *fmu, const char *call, double *derivative, size_t count) {
  if (!accepts(fmu, call, EVALUATION_PHASES, derivative, count, fmurt_model.state_count)) return FMURT_FMU_ERROR;
  const fmurt_result result = fmurt_update_values(fmu->instance);
  for (size_t i = 0; result == FMURT_RESULT_OK && i < count; ++i) {
    derivative[i] = fmu->instance->values.real[fmurt_model.derivative[i]];
  }
  return finish_read(fmu, call, result);
}

fmurt_fmu_status fmurt_fmu_get_indicators(fmurt_fmu *fmu, const char *call, double *indicator, size_t count) {
  if (!accepts(fmu, call, EVALUATION_PHASES, indicator, count, fmurt_model.indicator_count)) return FMURT_FMU_ERROR;
  if (count == 0) return FMURT_FMU_OK;
  return finish_read(fmu, call, fmurt_event_indicators(fmu->instance, indicator));
}

fmurt_fmu_status fmurt_fmu_get_indicator(fmurt_fmu *fmu, const char *call, size_t index, double *indicator) {
  if (!fmurt_fmu_permits(fmu, call, FMURT_ANY_PHASE)) return FMURT_FMU_ERROR;
  if (index >= fmurt_model.indicator_count) return fmurt_fmu_refuse(fmu, call, "there is no such event indicator");
  *indicator = 0.0;
  if (fmu->instance->situation.phase == FMURT_PHASE_INSTANTIATED) return FMURT_FMU_OK;
  double *shifted = calloc(fmurt_model.indicator_count, sizeof *shifted);
  if (shifted == NULL) return fmurt_fmu_refuse(fmu, call, "no memory");
  const fmurt_result result = fmurt_event_indicators(fmu->instance, shifted);
  *indicator = shifted[index];
  free(shifted);
  return finish_read(fmu, call, result);
}

fmurt_fmu_status fmurt_fmu_get_nominals(fmurt_fmu *fmu, const char *call, double *nominal, size_t count) {
  if (!accepts(fmu, call, EVALUATION_PHASES | FMURT_PHASE_INSTANTIATED, nominal, count, fmurt_model.state_count)) {
    return FMURT_FMU_ERROR;
  }
  if (count > 0) memcpy(nominal, fmurt_model.state_nominal, count * sizeof *nominal);
  return FMURT_FMU_OK;
}

/* -- co-simulation -- */

fmurt_fmu_status fmurt_fmu_do_step(fmurt_fmu *fmu, const char *call, double time, double step,
                                   fmurt_step_report *report) {
  memset(report, 0, sizeof *report);
  if (!fmurt_fmu_permits(fmu, call, FMURT_PHASE_STEP)) return FMURT_FMU_ERROR;
  fmurt_instance *instance = fmu->instance;
  report->time = instance->values.time;
  if (!isfinite(time) || !isfinite(step) || !(step > 0.0)) {
    return fmurt_fmu_refuse(fmu, call, "the step size is not positive");
  }
  if (fabs(time - instance->values.time) > 1e-6 * step + 1e-12 * fabs(time)) {
    return fmurt_fmu_refuse(fmu, call, "the communication point is not the time this FMU has reached");
  }
  const double target = time + step;
  /* Masters that add up the step size miss the stop time by the rounding of all their additions. */
  if (target > instance->situation.settings.stop_time + 1e-3 * step) {
    return fmurt_fmu_refuse(fmu, call, "the step ends after the stop time");
  }
  const int stop_at_events = fmu->event_mode_used && fmu->early_return_allowed;
  const fmurt_result result = fmurt_do_step(instance, target, stop_at_events, &report->event_waiting);
  const fmurt_fmu_status status = finish(fmu, call, result);
  report->time = instance->values.time;
  report->terminate = status == FMURT_FMU_OK && instance->situation.terminate_requested;
  if (status == FMURT_FMU_DISCARD) instance->situation.phase = FMURT_PHASE_STEP_FAILED;
  return status;
}
