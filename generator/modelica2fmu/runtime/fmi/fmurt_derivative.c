/* fmurt_derivative.c - see fmurt_derivative.h. */
#include "fmurt_derivative.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fmurt_call.h"
#include "fmurt_evaluate.h"

static double nominal(const fmurt_values *values, unsigned slot) {
  for (size_t i = 0; i < fmurt_model.state_count; ++i) {
    if (fmurt_model.state[i] == slot) return values->state_nominal[i];
  }
  return 1.0;
}

static int is_parameter(unsigned slot) {
  const fmurt_slot_table *table = &fmurt_interface_tables.real;
  return slot < table->count && (table->access[slot] & FMURT_IS_PARAMETER) != 0;
}

typedef struct perturbation {
  fmurt_instance *instance;
  const unsigned *known;
  size_t known_count;
  const double *seed;
  double *base;      /* [known_count] values at the present point */
  int *was_set;      /* [known_count] */
  int has_parameter; /* = 1, if one of the knowns is a parameter */
} perturbation;

/* Moves the knowns to base + distance * seed; distance 0 is the present point exactly. */
static fmurt_result move(const perturbation *move, double distance) {
  fmurt_instance *instance = move->instance;
  const int initializing = instance->situation.phase == FMURT_PHASE_INITIALIZATION;
  for (size_t i = 0; i < move->known_count; ++i) {
    const unsigned slot = move->known[i];
    const double value = distance == 0.0 ? move->base[i] : move->base[i] + distance * move->seed[i];
    instance->values.real[slot] = value;
    if (!initializing) continue;
    instance->start_real[slot] = instance->set_real[slot] = value;
    instance->real_is_set[slot] = distance == 0.0 ? move->was_set[i] : 1;
  }
  fmurt_invalidate(instance, move->has_parameter);
  return fmurt_update_values(instance);
}

static fmurt_result differentiate(const perturbation *known, const unsigned *unknown, size_t unknown_count, double step,
                                  double *sensitivity) {
  fmurt_instance *instance = known->instance;
  double from = -step, to = step;
  fmurt_result result = move(known, from);
  if (result == FMURT_RESULT_DISCARD) { /* not computable there: one-sided */
    from = 0.0;
    result = move(known, from);
  }
  if (result != FMURT_RESULT_OK) return result;
  for (size_t i = 0; i < unknown_count; ++i) sensitivity[i] = instance->values.real[unknown[i]];
  result = move(known, to);
  if (result == FMURT_RESULT_DISCARD && from < 0.0) {
    to = 0.0;
    result = move(known, to);
  }
  if (result != FMURT_RESULT_OK) return result;
  for (size_t i = 0; i < unknown_count; ++i) {
    sensitivity[i] = (instance->values.real[unknown[i]] - sensitivity[i]) / (to - from);
  }
  return FMURT_RESULT_OK;
}

/* Position of a slot in a table of the model, the table's size if it is not there; looked for at `likely` first. */
static size_t position(const unsigned *table, unsigned slot, size_t likely) {
  if (likely < fmurt_model.state_count && table[likely] == slot) return likely;
  size_t i = 0;
  while (i < fmurt_model.state_count && table[i] != slot) ++i;
  return i;
}

static int all_in(const unsigned *table, const unsigned *slots, size_t count) {
  for (size_t i = 0; i < count; ++i) {
    if (position(table, slots[i], i) == fmurt_model.state_count) return 0;
  }
  return 1;
}

static fmurt_result no_memory(fmurt_instance *instance) {
  snprintf(instance->message, sizeof instance->message, "No memory for a directional derivative");
  return FMURT_RESULT_ERROR;
}

/* Who wants the whole Jacobian asks for one direction after the other: it is computed once for all of them. */
static fmurt_result update_jacobian(fmurt_instance *instance) {
  if (instance->jacobian_is_current) return FMURT_RESULT_OK;
  const size_t count = fmurt_model.state_count * fmurt_model.state_count;
  if (instance->jacobian == NULL) instance->jacobian = malloc(count * sizeof(double));
  if (instance->jacobian == NULL) return no_memory(instance);
  memset(instance->jacobian, 0, count * sizeof(double));
  const fmurt_result result = fmurt_call_model(instance, FMURT_CALL_JACOBIAN, instance->jacobian);
  instance->jacobian_is_current = result == FMURT_RESULT_OK;
  return result;
}

static fmurt_result multiply_jacobian(fmurt_instance *instance, const unsigned *unknown, size_t unknown_count,
                                      const unsigned *known, size_t known_count, const double *seed,
                                      double *sensitivity) {
  const size_t n = fmurt_model.state_count;
  const fmurt_result result = update_jacobian(instance);
  if (result != FMURT_RESULT_OK) return result;
  for (size_t i = 0; i < unknown_count; ++i) sensitivity[i] = 0.0;
  for (size_t j = 0; j < known_count; ++j) {
    const double *column = instance->jacobian + position(fmurt_model.state, known[j], j) * n;
    for (size_t i = 0; i < unknown_count; ++i) {
      sensitivity[i] += column[position(fmurt_model.derivative, unknown[i], i)] * seed[j];
    }
  }
  return FMURT_RESULT_OK;
}

static int all_finite(const double *numbers, size_t count) {
  for (size_t i = 0; i < count; ++i) {
    if (!isfinite(numbers[i])) return 0;
  }
  return 1;
}

fmurt_result fmurt_directional_derivative(fmurt_instance *instance, const unsigned *unknown, size_t unknown_count,
                                          const unsigned *known, size_t known_count, const double *seed,
                                          double *sensitivity) {
  for (size_t i = 0; i < unknown_count + known_count; ++i) {
    const unsigned slot = i < unknown_count ? unknown[i] : known[i - unknown_count];
    if (slot < fmurt_model.real_count) continue;
    snprintf(instance->message, sizeof instance->message, "Value reference %u is no variable of the model", slot);
    return FMURT_RESULT_ERROR;
  }
  fmurt_result result = fmurt_update_values(instance);
  if (result != FMURT_RESULT_OK) return result;

  if (fmurt_model.jacobian != NULL && instance->situation.phase != FMURT_PHASE_INITIALIZATION && known_count > 0 &&
      all_in(fmurt_model.derivative, unknown, unknown_count) && all_in(fmurt_model.state, known, known_count)) {
    result = multiply_jacobian(instance, unknown, unknown_count, known, known_count, seed, sensitivity);
    if (result == FMURT_RESULT_ERROR || (result == FMURT_RESULT_OK && all_finite(sensitivity, unknown_count)))
      return result;
  }

  /* Central differences are best at the cube root of the rounding error (Nocedal and Wright, section 8.1). */
  double rate = 0.0;
  for (size_t i = 0; i < known_count; ++i) {
    rate = fmax(rate, fabs(seed[i]) / fmax(fabs(instance->values.real[known[i]]), nominal(&instance->values, known[i])));
  }
  if (!(rate > 0.0) || !isfinite(rate)) {
    for (size_t i = 0; i < unknown_count; ++i) sensitivity[i] = 0.0;
    return FMURT_RESULT_OK;
  }

  perturbation knowns = {.instance = instance, .known = known, .known_count = known_count, .seed = seed};
  knowns.base = malloc(known_count * sizeof *knowns.base);
  knowns.was_set = malloc(known_count * sizeof *knowns.was_set);
  const int event_pending = instance->situation.event_pending;
  if (knowns.base == NULL || knowns.was_set == NULL) {
    result = no_memory(instance);
  } else {
    for (size_t i = 0; i < known_count; ++i) {
      knowns.base[i] = instance->values.real[known[i]];
      knowns.was_set[i] = instance->real_is_set[known[i]];
      knowns.has_parameter |= is_parameter(known[i]);
    }
    result = differentiate(&knowns, unknown, unknown_count, cbrt(DBL_EPSILON) / rate, sensitivity);
    char cause[sizeof instance->message];
    memcpy(cause, instance->message, sizeof cause);
    const fmurt_result restored = move(&knowns, 0.0);
    if (result == FMURT_RESULT_OK) {
      result = restored;
    } else {
      memcpy(instance->message, cause, sizeof cause);
    }
  }
  instance->situation.event_pending = event_pending;
  free(knowns.base);
  free(knowns.was_set);
  return result;
}
