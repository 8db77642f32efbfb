/* cmb_evaluate.c - see cmb_evaluate.h. */
#include "cmb_evaluate.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cmb_call.h"

enum { MAXIMUM_RELATION_ITERATIONS = 50 };

static void copy_values_to(const cmb_values *values, double *real, int *integer, int *boolean) {
  memcpy(real, values->real, cmb_model.real_count * sizeof(double));
  memcpy(integer, values->integer, cmb_model.integer_count * sizeof(int));
  memcpy(boolean, values->boolean, cmb_model.boolean_count * sizeof(int));
}

static void copy_start_to_values(cmb_instance *instance) {
  memcpy(instance->values.real, instance->start_real, cmb_model.real_count * sizeof(double));
  memcpy(instance->values.integer, instance->start_integer, cmb_model.integer_count * sizeof(int));
  memcpy(instance->values.boolean, instance->start_boolean, cmb_model.boolean_count * sizeof(int));
}

/* Text slots go both ways by copying; only those that differ are touched. */
static cmb_result copy_start_strings(cmb_instance *instance) {
  for (size_t i = 0; i < cmb_model.string_count; ++i) {
    if (strcmp(instance->string[i], instance->start_string[i]) == 0) continue;
    if (cmb_set_string(instance, i, instance->start_string[i]) != CMB_RESULT_OK) return CMB_RESULT_ERROR;
  }
  return CMB_RESULT_OK;
}

/* What the importer set wins over what `parameters` binds to the same slot. */
static void restore_set_values(cmb_instance *instance) {
  for (size_t i = 0; i < cmb_model.real_count; ++i) {
    if (instance->real_is_set[i]) instance->values.real[i] = instance->set_real[i];
  }
  for (size_t i = 0; i < cmb_model.integer_count; ++i) {
    if (instance->integer_is_set[i]) instance->values.integer[i] = instance->set_integer[i];
  }
  for (size_t i = 0; i < cmb_model.boolean_count; ++i) {
    if (instance->boolean_is_set[i]) instance->values.boolean[i] = instance->set_boolean[i];
  }
}

static int is_parameter(const cmb_slot_table *table, size_t slot) {
  return slot < table->count && (table->access[slot] & CMB_IS_PARAMETER) != 0;
}

static cmb_result update_start_values(cmb_instance *instance) {
  copy_start_to_values(instance);
  cmb_result result = copy_start_strings(instance);
  if (result == CMB_RESULT_OK) result = cmb_call_model(instance, CMB_CALL_PARAMETERS, NULL);
  if (result != CMB_RESULT_OK) return result;
  restore_set_values(instance);
  copy_values_to(&instance->values, instance->start_real, instance->start_integer, instance->start_boolean);
  instance->situation.parameters_stale = 0;
  return CMB_RESULT_OK;
}

cmb_result cmb_update_parameters(cmb_instance *instance) {
  if (!instance->situation.parameters_stale) return CMB_RESULT_OK;
  if (instance->situation.phase == CMB_PHASE_INSTANTIATED || instance->situation.phase == CMB_PHASE_INITIALIZATION) {
    return update_start_values(instance);
  }
  memcpy(instance->scratch, instance->values.real, cmb_model.real_count * sizeof(double));
  const cmb_result result = cmb_call_model(instance, CMB_CALL_PARAMETERS, NULL);
  for (size_t i = 0; i < cmb_model.real_count; ++i) {
    if (!is_parameter(&cmb_interface_tables.real, i)) instance->values.real[i] = instance->scratch[i];
  }
  if (result == CMB_RESULT_OK) instance->situation.parameters_stale = 0;
  return result;
}

cmb_result cmb_update_initialization(cmb_instance *instance) {
  if (!instance->situation.initialization_stale) return CMB_RESULT_OK;
  cmb_values *values = &instance->values;
  instance->situation.parameters_stale = 1;
  cmb_result result = update_start_values(instance);
  if (result != CMB_RESULT_OK) return result;

  memset(values->relation, 0, cmb_model.indicator_count * sizeof(int));
  for (int iteration = 0; iteration < MAXIMUM_RELATION_ITERATIONS; ++iteration) {
    copy_start_to_values(instance);
    copy_values_to(values, values->pre_real, values->pre_integer, values->pre_boolean);
    values->initial = 1;
    values->next_time_event = HUGE_VAL;
    result = cmb_call_model(instance, CMB_CALL_INITIALIZE, NULL);
    if (result == CMB_RESULT_OK) result = cmb_call_model(instance, CMB_CALL_INDICATORS, instance->indicator);
    if (result != CMB_RESULT_OK) return result;
    int changed = 0;
    for (size_t i = 0; i < cmb_model.indicator_count; ++i) {
      const int relation = instance->indicator[i] > 0.0;
      changed |= relation != values->relation[i];
      values->relation[i] = relation;
    }
    if (!changed) {
      instance->situation.initialization_stale = 0;
      return CMB_RESULT_OK;
    }
  }
  snprintf(instance->message, sizeof instance->message,
           "The relations of the initialization problem do not settle in %d iterations", MAXIMUM_RELATION_ITERATIONS);
  return CMB_RESULT_ERROR;
}

cmb_result cmb_update_continuous(cmb_instance *instance) {
  if (!instance->situation.continuous_stale) return CMB_RESULT_OK;
  const cmb_result result = cmb_call_model(instance, CMB_CALL_CONTINUOUS, NULL);
  if (result != CMB_RESULT_OK) return result;
  for (size_t i = 0; i < cmb_model.state_count; ++i) {
    if (isfinite(instance->values.real[cmb_model.derivative[i]])) continue;
    snprintf(instance->message, sizeof instance->message, "The derivative of %s is not finite at time %.15g",
             cmb_slot_name(&cmb_interface_tables.real, cmb_model.state[i]), instance->values.time);
    return CMB_RESULT_DISCARD;
  }
  instance->situation.continuous_stale = 0;
  return CMB_RESULT_OK;
}

cmb_result cmb_update_values(cmb_instance *instance) {
  cmb_result result;
  switch (instance->situation.phase) {
    case CMB_PHASE_INSTANTIATED: return cmb_update_parameters(instance);
    case CMB_PHASE_INITIALIZATION: return cmb_update_initialization(instance);
    case CMB_PHASE_EVENT:
    case CMB_PHASE_CONTINUOUS:
    case CMB_PHASE_STEP:
      result = cmb_update_parameters(instance);
      return result == CMB_RESULT_OK ? cmb_update_continuous(instance) : result;
    default: return CMB_RESULT_OK; /* the last values, whatever they are */
  }
}

void cmb_set_point(cmb_instance *instance, double time, const double *state) {
  int changed = instance->values.time != time;
  instance->values.time = time;
  for (size_t i = 0; i < cmb_model.state_count; ++i) {
    double *slot = &instance->values.real[cmb_model.state[i]];
    changed |= *slot != state[i];
    *slot = state[i];
  }
  if (changed) instance->situation.continuous_stale = 1;
}
