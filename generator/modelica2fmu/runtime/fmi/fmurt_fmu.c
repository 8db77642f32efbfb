/* fmurt_fmu.c - life, modes and steps of co-simulation; see fmurt_fmu.h. */
#include "fmurt_approach.h"
#include "fmurt_fmu.h"

#include <math.h>
#include <string.h>

#include "fmurt_chatter.h"
#include "fmurt_evaluate.h"
#include "fmurt_event.h"
#include "fmurt_solver.h"
#include "fmurt_step.h"

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
  if (count > 0 && categories == NULL) return fmurt_fmu_refuse_null(fmu, call);
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
  return fmurt_fmu_finish_strictly(fmu, call, result);
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
  return fmurt_fmu_finish(fmu, call, result);
}

fmurt_fmu_status fmurt_fmu_reset(fmurt_fmu *fmu, const char *call) {
  if (!fmurt_fmu_permits(fmu, call, FMURT_ANY_PHASE)) return FMURT_FMU_ERROR;
  return fmurt_fmu_finish(fmu, call, fmurt_instance_reset(fmu->instance));
}

/* -- modes -- */

fmurt_fmu_status fmurt_fmu_enter_event_mode(fmurt_fmu *fmu, const char *call) {
  if (!fmurt_fmu_permits(fmu, call, FMURT_MODEL_EXCHANGE | FMURT_PHASE_STEP)) return FMURT_FMU_ERROR;
  if (fmu->co_simulation && !fmu->event_mode_used) {
    return fmurt_fmu_refuse(fmu, call, "this instance handles its events itself");
  }
  const fmurt_result passed = fmurt_approach_check(fmu->instance);
  if (passed != FMURT_RESULT_OK) return fmurt_fmu_finish(fmu, call, passed);
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
  return fmurt_fmu_finish_strictly(fmu, call, result);
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
  const fmurt_fmu_status status = fmurt_fmu_finish(fmu, call, result);
  report->time = instance->values.time;
  report->terminate = status == FMURT_FMU_OK && instance->situation.terminate_requested;
  if (status == FMURT_FMU_DISCARD) instance->situation.phase = FMURT_PHASE_STEP_FAILED;
  return status;
}
