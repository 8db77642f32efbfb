/* fmurt_fmu_exchange.c - model exchange: the integrator outside sets time and states and asks for the rest. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fmurt_approach.h"
#include "fmurt_call.h"
#include "fmurt_evaluate.h"
#include "fmurt_event.h"
#include "fmurt_fmu.h"

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
  const fmurt_result passed = fmurt_approach_check(instance);
  if (passed != FMURT_RESULT_OK) return fmurt_fmu_finish(fmu, call, passed);
  if (fmurt_model.followed_count == 0) {
    /* The importer's last evaluation was of the end of the step, but for a correction that it takes for none: warnings are
     * checked there, without another one. */
    if (fmurt_model.warnings != NULL) (void)fmurt_call_model(instance, FMURT_CALL_WARNINGS, NULL);
    return FMURT_FMU_OK;
  }
  /* What cannot be evaluated is told when it is read. */
  if (fmurt_update_for_rates(instance) != FMURT_RESULT_OK) return FMURT_FMU_OK;
  if (instance->values.strayed) {
    snprintf(instance->message, sizeof instance->message,
             "At time %.9g a nonlinear system cannot be followed from the last completed step: a loop may have come to another "
             "closure than before. Take shorter steps or a smaller tolerance, or choose other states, such as other joints of "
             "the loop",
             instance->values.time);
    return fmurt_fmu_finish(fmu, call, FMURT_RESULT_ERROR);
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
  return fmurt_fmu_finish_read(fmu, call, result);
}

fmurt_fmu_status fmurt_fmu_get_derivatives(fmurt_fmu *fmu, const char *call, double *derivative, size_t count) {
  if (!accepts(fmu, call, EVALUATION_PHASES, derivative, count, fmurt_model.state_count)) return FMURT_FMU_ERROR;
  const fmurt_result result = fmurt_update_for_rates(fmu->instance);
  for (size_t i = 0; result == FMURT_RESULT_OK && i < count; ++i) {
    derivative[i] = fmu->instance->values.real[fmurt_model.derivative[i]];
  }
  return fmurt_fmu_finish_read(fmu, call, result);
}

/* Those of the model's relations, and the one of bodies that meet. */
static fmurt_result all_indicators(fmurt_instance *instance, double *indicator) {
  const fmurt_result result = fmurt_event_indicators(instance, indicator);
  if (result == FMURT_RESULT_OK && fmurt_model.scene_count > 0) {
    indicator[fmurt_model.indicator_count] = fmurt_approach_indicator(instance);
  }
  return result;
}

fmurt_fmu_status fmurt_fmu_get_indicators(fmurt_fmu *fmu, const char *call, double *indicator, size_t count) {
  if (!accepts(fmu, call, EVALUATION_PHASES, indicator, count, fmurt_shown_indicator_count())) return FMURT_FMU_ERROR;
  if (count == 0) return FMURT_FMU_OK;
  return fmurt_fmu_finish_read(fmu, call, all_indicators(fmu->instance, indicator));
}

fmurt_fmu_status fmurt_fmu_get_indicator(fmurt_fmu *fmu, const char *call, size_t index, double *indicator) {
  if (!fmurt_fmu_permits(fmu, call, FMURT_ANY_PHASE)) return FMURT_FMU_ERROR;
  if (index >= fmurt_shown_indicator_count()) return fmurt_fmu_refuse(fmu, call, "there is no such event indicator");
  *indicator = 0.0;
  if (fmu->instance->situation.phase == FMURT_PHASE_INSTANTIATED) return FMURT_FMU_OK;
  double *shifted = calloc(fmurt_shown_indicator_count(), sizeof *shifted);
  if (shifted == NULL) return fmurt_fmu_refuse(fmu, call, "no memory");
  const fmurt_result result = all_indicators(fmu->instance, shifted);
  *indicator = shifted[index];
  free(shifted);
  return fmurt_fmu_finish_read(fmu, call, result);
}

fmurt_fmu_status fmurt_fmu_get_nominals(fmurt_fmu *fmu, const char *call, double *nominal, size_t count) {
  if (!accepts(fmu, call, EVALUATION_PHASES | FMURT_PHASE_INSTANTIATED, nominal, count, fmurt_model.state_count)) {
    return FMURT_FMU_ERROR;
  }
  if (count > 0) memcpy(nominal, fmu->instance->values.state_nominal, count * sizeof *nominal);
  return FMURT_FMU_OK;
}
