/* fmurt_evaluate.c - see fmurt_evaluate.h. */
#include "fmurt_evaluate.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "fmurt_call.h"
#include "fmurt_dead_center.h"
#include "fmurt_nominal.h"
#include "fmurt_solved.h"

enum { MAXIMUM_RELATION_ITERATIONS = 50 };

static void copy_values_to(const fmurt_values *values, double *real, int *integer, int *boolean) {
  memcpy(real, values->real, fmurt_model.real_count * sizeof(double));
  memcpy(integer, values->integer, fmurt_model.integer_count * sizeof(int));
  memcpy(boolean, values->boolean, fmurt_model.boolean_count * sizeof(int));
}

static void copy_start_to_values(fmurt_instance *instance) {
  memcpy(instance->values.real, instance->start_real, fmurt_model.real_count * sizeof(double));
  memcpy(instance->values.integer, instance->start_integer, fmurt_model.integer_count * sizeof(int));
  memcpy(instance->values.boolean, instance->start_boolean, fmurt_model.boolean_count * sizeof(int));
}

/* Text slots go both ways by copying; only those that differ are touched. */
static fmurt_result copy_start_strings(fmurt_instance *instance) {
  for (size_t i = 0; i < fmurt_model.string_count; ++i) {
    if (strcmp(instance->string[i], instance->start_string[i]) == 0) continue;
    if (fmurt_set_string(instance, i, instance->start_string[i]) != FMURT_RESULT_OK) return FMURT_RESULT_ERROR;
  }
  return FMURT_RESULT_OK;
}

/* What the importer set wins over what `parameters` binds to the same slot. */
static void restore_set_values(fmurt_instance *instance) {
  for (size_t i = 0; i < fmurt_model.real_count; ++i) {
    if (instance->real_is_set[i]) instance->values.real[i] = instance->set_real[i];
  }
  for (size_t i = 0; i < fmurt_model.integer_count; ++i) {
    if (instance->integer_is_set[i]) instance->values.integer[i] = instance->set_integer[i];
  }
  for (size_t i = 0; i < fmurt_model.boolean_count; ++i) {
    if (instance->boolean_is_set[i]) instance->values.boolean[i] = instance->set_boolean[i];
  }
}

static int is_parameter(const fmurt_slot_table *table, size_t slot) {
  return slot < table->count && (table->access[slot] & FMURT_IS_PARAMETER) != 0;
}

static fmurt_result update_start_values(fmurt_instance *instance) {
  copy_start_to_values(instance);
  fmurt_result result = copy_start_strings(instance);
  if (result == FMURT_RESULT_OK) result = fmurt_call_model(instance, FMURT_CALL_PARAMETERS, NULL);
  if (result != FMURT_RESULT_OK) return result;
  restore_set_values(instance);
  fmurt_fit_nominals(&instance->values);
  copy_values_to(&instance->values, instance->start_real, instance->start_integer, instance->start_boolean);
  instance->situation.parameters_stale = 0;
  return FMURT_RESULT_OK;
}

fmurt_result fmurt_update_parameters(fmurt_instance *instance) {
  if (!instance->situation.parameters_stale) return FMURT_RESULT_OK;
  if (instance->situation.phase == FMURT_PHASE_INSTANTIATED ||
      instance->situation.phase == FMURT_PHASE_INITIALIZATION) {
    return update_start_values(instance);
  }
  memcpy(instance->scratch, instance->values.real, fmurt_model.real_count * sizeof(double));
  const fmurt_result result = fmurt_call_model(instance, FMURT_CALL_PARAMETERS, NULL);
  for (size_t i = 0; i < fmurt_model.real_count; ++i) {
    if (!is_parameter(&fmurt_interface_tables.real, i)) instance->values.real[i] = instance->scratch[i];
  }
  if (result != FMURT_RESULT_OK) return result;
  fmurt_fit_nominals(&instance->values);
  instance->situation.parameters_stale = 0;
  return FMURT_RESULT_OK;
}

fmurt_result fmurt_update_initialization(fmurt_instance *instance) {
  if (!instance->situation.initialization_stale) return FMURT_RESULT_OK;
  fmurt_values *values = &instance->values;
  instance->situation.parameters_stale = 1;
  fmurt_result result = update_start_values(instance);
  if (result != FMURT_RESULT_OK) return result;

  memset(values->relation, 0, fmurt_model.indicator_count * sizeof(int));
  for (int iteration = 0; iteration < MAXIMUM_RELATION_ITERATIONS; ++iteration) {
    copy_start_to_values(instance);
    copy_values_to(values, values->pre_real, values->pre_integer, values->pre_boolean);
    values->initial = 1;
    values->next_time_event = HUGE_VAL;
    result = fmurt_call_model(instance, FMURT_CALL_INITIALIZE, NULL);
    if (result == FMURT_RESULT_OK) result = fmurt_call_model(instance, FMURT_CALL_INDICATORS, instance->indicator);
    if (result != FMURT_RESULT_OK) return result;
    int changed = 0;
    for (size_t i = 0; i < fmurt_model.indicator_count; ++i) {
      const int relation = instance->indicator[i] > 0.0;
      changed |= relation != values->relation[i];
      values->relation[i] = relation;
    }
    if (!changed) {
      instance->situation.initialization_stale = 0;
      return FMURT_RESULT_OK;
    }
  }
  snprintf(instance->message, sizeof instance->message,
           "The relations of the initialization problem do not settle in %d iterations", MAXIMUM_RELATION_ITERATIONS);
  return FMURT_RESULT_ERROR;
}

fmurt_result fmurt_update_rates(fmurt_instance *instance) {
  if (!instance->situation.continuous_stale) return FMURT_RESULT_OK;
  instance->values.strayed = 0;
  instance->situation.remaining_stale = 1;
  const fmurt_result result = fmurt_call_model(instance, FMURT_CALL_CONTINUOUS, NULL);
  if (result != FMURT_RESULT_OK) return result;
  for (size_t i = 0; i < fmurt_model.state_count; ++i) {
    if (isfinite(instance->values.real[fmurt_model.derivative[i]])) continue;
    snprintf(instance->message, sizeof instance->message, "The derivative of %s is not finite at time %.15g",
             fmurt_slot_name(&fmurt_interface_tables.real, fmurt_model.state[i]), instance->values.time);
    return FMURT_RESULT_DISCARD;
  }
  instance->situation.continuous_stale = 0;
  fmurt_remember_solved(instance);
  return FMURT_RESULT_OK;
}

fmurt_result fmurt_update_continuous(fmurt_instance *instance) {
  fmurt_result result = fmurt_update_rates(instance);
  if (result != FMURT_RESULT_OK || !instance->situation.remaining_stale) return result;
  result = fmurt_call_model(instance, FMURT_CALL_REMAINING, NULL);
  if (result == FMURT_RESULT_OK) instance->situation.remaining_stale = 0;
  return result;
}

static fmurt_result update_by_phase(fmurt_instance *instance, fmurt_result (*update)(fmurt_instance *)) {
  fmurt_result result;
  switch (instance->situation.phase) {
    case FMURT_PHASE_INSTANTIATED: return fmurt_update_parameters(instance);
    case FMURT_PHASE_INITIALIZATION: return fmurt_update_initialization(instance);
    case FMURT_PHASE_EVENT:
    case FMURT_PHASE_CONTINUOUS:
    case FMURT_PHASE_STEP:
      result = fmurt_update_parameters(instance);
      return result == FMURT_RESULT_OK ? update(instance) : result;
    default: return FMURT_RESULT_OK; /* the last values, whatever they are */
  }
}

fmurt_result fmurt_update_values(fmurt_instance *instance) {
  return update_by_phase(instance, fmurt_update_continuous);
}

fmurt_result fmurt_update_for_rates(fmurt_instance *instance) { return update_by_phase(instance, fmurt_update_rates); }

void fmurt_set_point(fmurt_instance *instance, double time, const double *state) {
  int changed = instance->values.time != time;
  instance->values.time = time;
  for (size_t i = 0; i < fmurt_model.state_count; ++i) {
    double *slot = &instance->values.real[fmurt_model.state[i]];
    changed |= *slot != state[i];
    *slot = state[i];
  }
  if (changed) instance->situation.continuous_stale = 1;
}

void fmurt_accept(fmurt_instance *instance) {
  fmurt_history_shift(&instance->values);
  for (size_t i = 0; i < fmurt_model.followed_count; ++i) {
    instance->values.accepted[i] = instance->values.real[fmurt_model.followed[i]];
  }
  fmurt_forget_solved(instance);
  instance->values.accepted[fmurt_model.followed_count] = instance->values.time;
  if (fmurt_model.warnings != NULL) (void)fmurt_call_model(instance, FMURT_CALL_WARNINGS, NULL);
}
