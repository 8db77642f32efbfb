/* cmb_access.c - see cmb_access.h. */
#include "cmb_access.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cmb_evaluate.h"

static cmb_result unknown_reference(cmb_instance *instance, const char *type, unsigned reference) {
  snprintf(instance->message, sizeof instance->message, "There is no %s variable with value reference %u", type,
           reference);
  return CMB_RESULT_ERROR;
}

static int is_solver_reference(unsigned reference, unsigned count) {
  return reference >= CMB_SOLVER_FIRST_REFERENCE && reference - CMB_SOLVER_FIRST_REFERENCE < count;
}

cmb_result cmb_check_references(cmb_instance *instance, cmb_base_type type, const unsigned *reference, size_t count) {
  static const char *const names[] = {"Real", "Integer", "Boolean", "String"};
  static const unsigned solver_slots[] = {CMB_SOLVER_REAL_COUNT, CMB_SOLVER_INTEGER_COUNT, 0, 0};
  const size_t slots[] = {cmb_model.real_count, cmb_model.integer_count, cmb_model.boolean_count,
                          cmb_model.string_count};
  for (size_t i = 0; i < count; ++i) {
    if (reference[i] < slots[type] || is_solver_reference(reference[i], solver_slots[type])) continue;
    return unknown_reference(instance, names[type], reference[i]);
  }
  return CMB_RESULT_OK;
}

/* -- getting -- */

cmb_result cmb_get_real(cmb_instance *instance, const unsigned *reference, size_t count, double *value) {
  if (count == 0) return CMB_RESULT_OK;
  const cmb_slot_table *table = &cmb_interface_tables.real;
  const cmb_result result = cmb_update_values(instance);
  if (result != CMB_RESULT_OK) return result;
  for (size_t i = 0; i < count; ++i) {
    const unsigned slot = reference[i];
    if (slot >= cmb_model.real_count) {
      value[i] = instance->situation.solver_real[slot - CMB_SOLVER_FIRST_REFERENCE];
    } else if (slot < table->count && (table->access[slot] & CMB_IS_INDEPENDENT)) {
      value[i] = instance->values.time;
    } else {
      value[i] = instance->values.real[slot];
    }
  }
  return CMB_RESULT_OK;
}

cmb_result cmb_get_integer(cmb_instance *instance, const unsigned *reference, size_t count, int *value) {
  if (count == 0) return CMB_RESULT_OK;
  const cmb_result result = cmb_update_values(instance);
  if (result != CMB_RESULT_OK) return result;
  for (size_t i = 0; i < count; ++i) {
    const unsigned slot = reference[i];
    value[i] = slot < cmb_model.integer_count ? instance->values.integer[slot]
                                              : instance->situation.solver_integer[slot - CMB_SOLVER_FIRST_REFERENCE];
  }
  return CMB_RESULT_OK;
}

cmb_result cmb_get_boolean(cmb_instance *instance, const unsigned *reference, size_t count, int *value) {
  if (count == 0) return CMB_RESULT_OK;
  const cmb_result result = cmb_update_values(instance);
  if (result != CMB_RESULT_OK) return result;
  for (size_t i = 0; i < count; ++i) value[i] = instance->values.boolean[reference[i]] != 0;
  return CMB_RESULT_OK;
}

cmb_result cmb_get_string(cmb_instance *instance, const unsigned *reference, size_t count, const char **value) {
  if (count == 0) return CMB_RESULT_OK;
  const cmb_result result = cmb_update_values(instance);
  if (result != CMB_RESULT_OK) return result;
  for (size_t i = 0; i < count; ++i) value[i] = instance->string[reference[i]];
  return CMB_RESULT_OK;
}

/* -- setting -- */

static int permission(int phase) {
  switch (phase) {
    case CMB_PHASE_INSTANTIATED: return CMB_SET_INSTANTIATED;
    case CMB_PHASE_INITIALIZATION: return CMB_SET_INITIALIZATION;
    case CMB_PHASE_CONTINUOUS: return CMB_SET_CONTINUOUS;
    case CMB_PHASE_EVENT:
    case CMB_PHASE_STEP: return CMB_SET_EVENT;
    default: return 0;
  }
}

static const char *phase_name(int phase) {
  switch (phase) {
    case CMB_PHASE_INSTANTIATED: return "before initialization";
    case CMB_PHASE_INITIALIZATION: return "in initialization mode";
    case CMB_PHASE_EVENT: return "in event mode";
    case CMB_PHASE_CONTINUOUS: return "in continuous-time mode";
    case CMB_PHASE_STEP: return "between steps";
    default: return "now";
  }
}

static cmb_result check_settable(cmb_instance *instance, const cmb_slot_table *table, const char *type, size_t slots,
                                 const unsigned *reference, size_t count) {
  for (size_t i = 0; i < count; ++i) {
    const unsigned slot = reference[i];
    if (slot >= slots || slot >= table->count) return unknown_reference(instance, type, slot);
    if ((table->access[slot] & permission(instance->situation.phase)) != 0) continue;
    snprintf(instance->message, sizeof instance->message, "%s variable %s cannot be set %s", type,
             cmb_slot_name(table, slot), phase_name(instance->situation.phase));
    return CMB_RESULT_ERROR;
  }
  return CMB_RESULT_OK;
}

static int before_start(const cmb_instance *instance) {
  return instance->situation.phase == CMB_PHASE_INSTANTIATED || instance->situation.phase == CMB_PHASE_INITIALIZATION;
}

static void mark_set(cmb_instance *instance, const cmb_slot_table *table, unsigned slot) {
  cmb_invalidate(instance, before_start(instance) || (table->access[slot] & CMB_IS_PARAMETER) != 0);
  if (instance->situation.phase == CMB_PHASE_STEP) instance->situation.event_pending = 1;
}

static int accepts_solver_options(cmb_instance *instance) {
  if (before_start(instance)) return 1;
  snprintf(instance->message, sizeof instance->message,
           "Options of the integrator can only be set before initialization ends");
  return 0;
}

static cmb_result check_solver_option(cmb_instance *instance, unsigned option, double value) {
  if (!accepts_solver_options(instance)) return CMB_RESULT_ERROR;
  if (!(value >= 0.0) || (option == CMB_SOLVER_RELATIVE_TOLERANCE && !(value > 0.0 && value < 1.0))) {
    snprintf(instance->message, sizeof instance->message, "%g is no value for an option of the integrator", value);
    return CMB_RESULT_ERROR;
  }
  return CMB_RESULT_OK;
}

cmb_result cmb_set_reals(cmb_instance *instance, const unsigned *reference, size_t count, const double *value) {
  const cmb_slot_table *table = &cmb_interface_tables.real;
  for (size_t i = 0; i < count; ++i) {
    const cmb_result result =
        is_solver_reference(reference[i], CMB_SOLVER_REAL_COUNT)
            ? check_solver_option(instance, reference[i] - CMB_SOLVER_FIRST_REFERENCE, value[i])
            : check_settable(instance, table, "Real", cmb_model.real_count, &reference[i], 1);
    if (result != CMB_RESULT_OK) return result;
    if (isnan(value[i])) {
      snprintf(instance->message, sizeof instance->message, "%s cannot be set to a value that is not a number",
               cmb_slot_name(table, reference[i]));
      return CMB_RESULT_ERROR;
    }
  }
  for (size_t i = 0; i < count; ++i) {
    const unsigned slot = reference[i];
    if (slot >= cmb_model.real_count) {
      instance->situation.solver_real[slot - CMB_SOLVER_FIRST_REFERENCE] = value[i];
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
  return CMB_RESULT_OK;
}

static cmb_result check_maximum_steps(cmb_instance *instance, int value) {
  if (!accepts_solver_options(instance)) return CMB_RESULT_ERROR;
  if (value < 1) {
    snprintf(instance->message, sizeof instance->message, "%d is no number of steps for the integrator", value);
    return CMB_RESULT_ERROR;
  }
  return CMB_RESULT_OK;
}

cmb_result cmb_set_integers(cmb_instance *instance, const unsigned *reference, size_t count, const int *value) {
  const cmb_slot_table *table = &cmb_interface_tables.integer;
  static const unsigned maximum_steps = CMB_SOLVER_FIRST_REFERENCE + CMB_SOLVER_MAXIMUM_STEPS;
  for (size_t i = 0; i < count; ++i) {
    const cmb_result result =
        reference[i] == maximum_steps
            ? check_maximum_steps(instance, value[i])
            : check_settable(instance, table, "Integer", cmb_model.integer_count, &reference[i], 1);
    if (result != CMB_RESULT_OK) return result;
  }
  for (size_t i = 0; i < count; ++i) {
    const unsigned slot = reference[i];
    if (slot == maximum_steps) {
      instance->situation.solver_integer[CMB_SOLVER_MAXIMUM_STEPS] = value[i];
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
  return CMB_RESULT_OK;
}

cmb_result cmb_set_booleans(cmb_instance *instance, const unsigned *reference, size_t count, const int *value) {
  const cmb_slot_table *table = &cmb_interface_tables.boolean;
  const cmb_result result = check_settable(instance, table, "Boolean", cmb_model.boolean_count, reference, count);
  if (result != CMB_RESULT_OK) return result;
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
  return CMB_RESULT_OK;
}

static cmb_result no_memory(cmb_instance *instance) {
  snprintf(instance->message, sizeof instance->message, "No memory for a text");
  return CMB_RESULT_ERROR;
}

cmb_result cmb_set_strings(cmb_instance *instance, const unsigned *reference, size_t count, const char *const *value) {
  const cmb_slot_table *table = &cmb_interface_tables.string;
  const cmb_result result = check_settable(instance, table, "String", cmb_model.string_count, reference, count);
  if (result != CMB_RESULT_OK) return result;
  for (size_t i = 0; i < count; ++i) {
    if (value[i] == NULL) {
      snprintf(instance->message, sizeof instance->message, "%s cannot be set to a null pointer",
               cmb_slot_name(table, reference[i]));
      return CMB_RESULT_ERROR;
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
    if (cmb_set_string(instance, slot, value[i]) != CMB_RESULT_OK) return no_memory(instance);
    mark_set(instance, table, slot);
  }
  return CMB_RESULT_OK;
}
