/* fmurt_access.c - see fmurt_access.h. */
#include "fmurt_access.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fmurt_bounds.h"
#include "fmurt_evaluate.h"

static fmurt_result unknown_reference(fmurt_instance *instance, const char *type, unsigned reference) {
  snprintf(instance->message, sizeof instance->message, "There is no %s variable with value reference %u", type,
           reference);
  return FMURT_RESULT_ERROR;
}

static int is_solver_reference(unsigned reference, unsigned count) {
  return reference >= FMURT_SOLVER_FIRST_REFERENCE && reference - FMURT_SOLVER_FIRST_REFERENCE < count;
}

fmurt_result fmurt_check_references(fmurt_instance *instance, fmurt_base_type type, const unsigned *reference,
                                    size_t count) {
  static const char *const names[] = {"Real", "Integer", "Boolean", "String"};
  static const unsigned solver_slots[] = {FMURT_SOLVER_REAL_COUNT, FMURT_SOLVER_INTEGER_COUNT, 0, 0};
  const size_t slots[] = {fmurt_model.real_count, fmurt_model.integer_count, fmurt_model.boolean_count,
                          fmurt_model.string_count};
  for (size_t i = 0; i < count; ++i) {
    if (reference[i] < slots[type] || is_solver_reference(reference[i], solver_slots[type])) continue;
    return unknown_reference(instance, names[type], reference[i]);
  }
  return FMURT_RESULT_OK;
}

/* -- getting -- */

fmurt_result fmurt_get_real(fmurt_instance *instance, const unsigned *reference, size_t count, double *value) {
  if (count == 0) return FMURT_RESULT_OK;
  const fmurt_slot_table *table = &fmurt_interface_tables.real;
  const fmurt_result result = fmurt_update_values(instance);
  if (result != FMURT_RESULT_OK) return result;
  for (size_t i = 0; i < count; ++i) {
    const unsigned slot = reference[i];
    if (slot >= fmurt_model.real_count) {
      value[i] = instance->situation.solver_real[slot - FMURT_SOLVER_FIRST_REFERENCE];
    } else if (slot < table->count && (table->access[slot] & FMURT_IS_INDEPENDENT)) {
      value[i] = instance->values.time;
    } else {
      value[i] = instance->values.real[slot];
    }
  }
  return FMURT_RESULT_OK;
}

fmurt_result fmurt_get_integer(fmurt_instance *instance, const unsigned *reference, size_t count, int *value) {
  if (count == 0) return FMURT_RESULT_OK;
  const fmurt_result result = fmurt_update_values(instance);
  if (result != FMURT_RESULT_OK) return result;
  for (size_t i = 0; i < count; ++i) {
    const unsigned slot = reference[i];
    value[i] = slot < fmurt_model.integer_count
                   ? instance->values.integer[slot]
                   : instance->situation.solver_integer[slot - FMURT_SOLVER_FIRST_REFERENCE];
  }
  return FMURT_RESULT_OK;
}

fmurt_result fmurt_get_boolean(fmurt_instance *instance, const unsigned *reference, size_t count, int *value) {
  if (count == 0) return FMURT_RESULT_OK;
  const fmurt_result result = fmurt_update_values(instance);
  if (result != FMURT_RESULT_OK) return result;
  for (size_t i = 0; i < count; ++i) value[i] = instance->values.boolean[reference[i]] != 0;
  return FMURT_RESULT_OK;
}

fmurt_result fmurt_get_string(fmurt_instance *instance, const unsigned *reference, size_t count, const char **value) {
  if (count == 0) return FMURT_RESULT_OK;
  const fmurt_result result = fmurt_update_values(instance);
  if (result != FMURT_RESULT_OK) return result;
  for (size_t i = 0; i < count; ++i) value[i] = instance->string[reference[i]];
  return FMURT_RESULT_OK;
}

/* -- setting -- */

static int permission(int phase) {
  switch (phase) {
    case FMURT_PHASE_INSTANTIATED: return FMURT_SET_INSTANTIATED;
    case FMURT_PHASE_INITIALIZATION: return FMURT_SET_INITIALIZATION;
    case FMURT_PHASE_CONTINUOUS: return FMURT_SET_CONTINUOUS;
    case FMURT_PHASE_EVENT:
    case FMURT_PHASE_STEP: return FMURT_SET_EVENT;
    default: return 0;
  }
}

static const char *phase_name(int phase) {
  switch (phase) {
    case FMURT_PHASE_INSTANTIATED: return "before initialization";
    case FMURT_PHASE_INITIALIZATION: return "in initialization mode";
    case FMURT_PHASE_EVENT: return "in event mode";
    case FMURT_PHASE_CONTINUOUS: return "in continuous-time mode";
    case FMURT_PHASE_STEP: return "between steps";
    default: return "now";
  }
}

static fmurt_result check_settable(fmurt_instance *instance, const fmurt_slot_table *table, const char *type,
                                   size_t slots, const unsigned *reference, size_t count) {
  for (size_t i = 0; i < count; ++i) {
    const unsigned slot = reference[i];
    if (slot >= slots || slot >= table->count) return unknown_reference(instance, type, slot);
    if ((table->access[slot] & permission(instance->situation.phase)) != 0) continue;
    snprintf(instance->message, sizeof instance->message, "%s variable %s cannot be set %s", type,
             fmurt_slot_name(table, slot), phase_name(instance->situation.phase));
    return FMURT_RESULT_ERROR;
  }
  return FMURT_RESULT_OK;
}

static int before_start(const fmurt_instance *instance) {
  return instance->situation.phase == FMURT_PHASE_INSTANTIATED ||
         instance->situation.phase == FMURT_PHASE_INITIALIZATION;
}

static void mark_set(fmurt_instance *instance, const fmurt_slot_table *table, unsigned slot) {
  fmurt_invalidate(instance, before_start(instance) || (table->access[slot] & FMURT_IS_PARAMETER) != 0);
  if (instance->situation.phase == FMURT_PHASE_STEP) instance->situation.event_pending = 1;
}

static int accepts_solver_options(fmurt_instance *instance) {
  if (before_start(instance)) return 1;
  snprintf(instance->message, sizeof instance->message,
           "Options of the integrator can only be set before initialization ends");
  return 0;
}

static fmurt_result check_solver_option(fmurt_instance *instance, unsigned option, double value) {
  if (!accepts_solver_options(instance)) return FMURT_RESULT_ERROR;
  if (!(value >= 0.0) || (option == FMURT_SOLVER_RELATIVE_TOLERANCE && !(value > 0.0 && value < 1.0))) {
    snprintf(instance->message, sizeof instance->message, "%g is no value for an option of the integrator", value);
    return FMURT_RESULT_ERROR;
  }
  return FMURT_RESULT_OK;
}

fmurt_result fmurt_set_reals(fmurt_instance *instance, const unsigned *reference, size_t count, const double *value) {
  const fmurt_slot_table *table = &fmurt_interface_tables.real;
  for (size_t i = 0; i < count; ++i) {
    const fmurt_result result =
        is_solver_reference(reference[i], FMURT_SOLVER_REAL_COUNT)
            ? check_solver_option(instance, reference[i] - FMURT_SOLVER_FIRST_REFERENCE, value[i])
            : check_settable(instance, table, "Real", fmurt_model.real_count, &reference[i], 1);
    if (result != FMURT_RESULT_OK) return result;
    if (isnan(value[i])) {
      snprintf(instance->message, sizeof instance->message, "%s cannot be set to a value that is not a number",
               fmurt_slot_name(table, reference[i]));
      return FMURT_RESULT_ERROR;
    }
    if (fmurt_check_bounds(instance, table, reference[i], value[i]) != FMURT_RESULT_OK) return FMURT_RESULT_ERROR;
  }
  for (size_t i = 0; i < count; ++i) {
    const unsigned slot = reference[i];
    if (slot >= fmurt_model.real_count) {
      instance->situation.solver_real[slot - FMURT_SOLVER_FIRST_REFERENCE] = value[i];
      continue;
    }
    if (before_start(instance)) {
      instance->start_real[slot] = instance->set_real[slot] = value[i];
      instance->real_is_set[slot] = 1;
    } else if (instance->values.real[slot] == value[i]) {
      continue;
    }
    instance->values.real[slot] = value[i];
    mark_set(instance, table, slot);
  }
  return FMURT_RESULT_OK;
}

static fmurt_result check_maximum_steps(fmurt_instance *instance, int value) {
  if (!accepts_solver_options(instance)) return FMURT_RESULT_ERROR;
  if (value < 1) {
    snprintf(instance->message, sizeof instance->message, "%d is no number of steps for the integrator", value);
    return FMURT_RESULT_ERROR;
  }
  return FMURT_RESULT_OK;
}

fmurt_result fmurt_set_integers(fmurt_instance *instance, const unsigned *reference, size_t count, const int *value) {
  const fmurt_slot_table *table = &fmurt_interface_tables.integer;
  static const unsigned maximum_steps = FMURT_SOLVER_FIRST_REFERENCE + FMURT_SOLVER_MAXIMUM_STEPS;
  for (size_t i = 0; i < count; ++i) {
    const fmurt_result result =
        reference[i] == maximum_steps
            ? check_maximum_steps(instance, value[i])
            : check_settable(instance, table, "Integer", fmurt_model.integer_count, &reference[i], 1);
    if (result != FMURT_RESULT_OK) return result;
    if (fmurt_check_bounds(instance, table, reference[i], value[i]) != FMURT_RESULT_OK) return FMURT_RESULT_ERROR;
  }
  for (size_t i = 0; i < count; ++i) {
    const unsigned slot = reference[i];
    if (slot == maximum_steps) {
      instance->situation.solver_integer[FMURT_SOLVER_MAXIMUM_STEPS] = value[i];
      continue;
    }
    if (before_start(instance)) {
      instance->start_integer[slot] = instance->set_integer[slot] = value[i];
      instance->integer_is_set[slot] = 1;
    } else if (instance->values.integer[slot] == value[i]) {
      continue;
    }
    instance->values.integer[slot] = value[i];
    mark_set(instance, table, slot);
  }
  return FMURT_RESULT_OK;
}

fmurt_result fmurt_set_booleans(fmurt_instance *instance, const unsigned *reference, size_t count, const int *value) {
  const fmurt_slot_table *table = &fmurt_interface_tables.boolean;
  const fmurt_result result = check_settable(instance, table, "Boolean", fmurt_model.boolean_count, reference, count);
  if (result != FMURT_RESULT_OK) return result;
  for (size_t i = 0; i < count; ++i) {
    const unsigned slot = reference[i];
    const int truth = value[i] != 0;
    if (before_start(instance)) {
      instance->start_boolean[slot] = instance->set_boolean[slot] = truth;
      instance->boolean_is_set[slot] = 1;
    } else if (instance->values.boolean[slot] == truth) {
      continue;
    }
    instance->values.boolean[slot] = truth;
    mark_set(instance, table, slot);
  }
  return FMURT_RESULT_OK;
}

static fmurt_result no_memory(fmurt_instance *instance) {
  snprintf(instance->message, sizeof instance->message, "No memory for a text");
  return FMURT_RESULT_ERROR;
}

fmurt_result fmurt_set_strings(fmurt_instance *instance, const unsigned *reference, size_t count,
                               const char *const *value) {
  const fmurt_slot_table *table = &fmurt_interface_tables.string;
  const fmurt_result result = check_settable(instance, table, "String", fmurt_model.string_count, reference, count);
  if (result != FMURT_RESULT_OK) return result;
  for (size_t i = 0; i < count; ++i) {
    if (value[i] == NULL) {
      snprintf(instance->message, sizeof instance->message, "%s cannot be set to a null pointer",
               fmurt_slot_name(table, reference[i]));
      return FMURT_RESULT_ERROR;
    }
  }
  for (size_t i = 0; i < count; ++i) {
    const unsigned slot = reference[i];
    if (before_start(instance)) {
      const size_t size = strlen(value[i]) + 1;
      char *copy = malloc(size);
      if (copy == NULL) return no_memory(instance);
      memcpy(copy, value[i], size);
      free(instance->start_string[slot]);
      instance->start_string[slot] = copy;
    } else if (strcmp(instance->string[slot], value[i]) == 0) {
      continue;
    }
    if (fmurt_set_string(instance, slot, value[i]) != FMURT_RESULT_OK) return no_memory(instance);
    mark_set(instance, table, slot);
  }
  return FMURT_RESULT_OK;
}
