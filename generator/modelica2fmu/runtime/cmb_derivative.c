/* cmb_derivative.c - see cmb_derivative.h. */
#include "cmb_derivative.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cmb_evaluate.h"

static double nominal(unsigned slot) {
  for (size_t i = 0; i < cmb_model.state_count; ++i) {
    if (cmb_model.state[i] == slot) return cmb_model.state_nominal[i];
  }
  return 1.0;
}

static int is_parameter(unsigned slot) {
  const cmb_slot_table *table = &cmb_interface_tables.real;
  return slot < table->count && (table->access[slot] & CMB_IS_PARAMETER) != 0;
}

typedef struct perturbation {
  cmb_instance *instance;
  const unsigned *known;
  size_t known_count;
  const double *seed;
  double *base;      /* [known_count] values at the present point */
  int *was_set;      /* [known_count] */
  int has_parameter; /* = 1, if one of the knowns is a parameter */
} perturbation;

/* Moves the knowns to base + distance * seed; distance 0 is the present point exactly. */
static cmb_result move(const perturbation *move, double distance) {
  cmb_instance *instance = move->instance;
  const int initializing = instance->situation.phase == CMB_PHASE_INITIALIZATION;
  for (size_t i = 0; i < move->known_count; ++i) {
    const unsigned slot = move->known[i];
    const double value = distance == 0.0 ? move->base[i] : move->base[i] + distance * move->seed[i];
    instance->values.real[slot] = value;
    if (!initializing) continue;
    instance->start_real[slot] = instance->set_real[slot] = value;
    instance->real_is_set[slot] = distance == 0.0 ? move->was_set[i] : 1;
  }
  cmb_invalidate(instance, move->has_parameter);
  return cmb_update_values(instance);
}

static cmb_result differentiate(const perturbation *known, const unsigned *unknown, size_t unknown_count, double step,
                                double *sensitivity) {
  cmb_instance *instance = known->instance;
  double from = -step, to = step;
  cmb_result result = move(known, from);
  if (result == CMB_RESULT_DISCARD) { /* not computable there: one-sided */
    from = 0.0;
    result = move(known, from);
  }
  if (result != CMB_RESULT_OK) return result;
  for (size_t i = 0; i < unknown_count; ++i) sensitivity[i] = instance->values.real[unknown[i]];
  result = move(known, to);
  if (result == CMB_RESULT_DISCARD && from < 0.0) {
    to = 0.0;
    result = move(known, to);
  }
  if (result != CMB_RESULT_OK) return result;
  for (size_t i = 0; i < unknown_count; ++i) {
    sensitivity[i] = (instance->values.real[unknown[i]] - sensitivity[i]) / (to - from);
  }
  return CMB_RESULT_OK;
}

cmb_result cmb_directional_derivative(cmb_instance *instance, const unsigned *unknown, size_t unknown_count,
                                      const unsigned *known, size_t known_count, const double *seed,
                                      double *sensitivity) {
  for (size_t i = 0; i < unknown_count + known_count; ++i) {
    const unsigned slot = i < unknown_count ? unknown[i] : known[i - unknown_count];
    if (slot < cmb_model.real_count) continue;
    snprintf(instance->message, sizeof instance->message, "Value reference %u is no variable of the model", slot);
    return CMB_RESULT_ERROR;
  }
  cmb_result result = cmb_update_values(instance);
  if (result != CMB_RESULT_OK) return result;

  /* Central differences are best at the cube root of the rounding error (Nocedal and Wright, section 8.1). */
  double rate = 0.0;
  for (size_t i = 0; i < known_count; ++i) {
    rate = fmax(rate, fabs(seed[i]) / fmax(fabs(instance->values.real[known[i]]), nominal(known[i])));
  }
  if (!(rate > 0.0) || !isfinite(rate)) {
    for (size_t i = 0; i < unknown_count; ++i) sensitivity[i] = 0.0;
    return CMB_RESULT_OK;
  }

  perturbation knowns = {.instance = instance, .known = known, .known_count = known_count, .seed = seed};
  knowns.base = malloc(known_count * sizeof *knowns.base);
  knowns.was_set = malloc(known_count * sizeof *knowns.was_set);
  const int event_pending = instance->situation.event_pending;
  if (knowns.base == NULL || knowns.was_set == NULL) {
    snprintf(instance->message, sizeof instance->message, "No memory for a directional derivative");
    result = CMB_RESULT_ERROR;
  } else {
    for (size_t i = 0; i < known_count; ++i) {
      knowns.base[i] = instance->values.real[known[i]];
      knowns.was_set[i] = instance->real_is_set[known[i]];
      knowns.has_parameter |= is_parameter(known[i]);
    }
    result = differentiate(&knowns, unknown, unknown_count, cbrt(DBL_EPSILON) / rate, sensitivity);
    char cause[sizeof instance->message];
    memcpy(cause, instance->message, sizeof cause);
    const cmb_result restored = move(&knowns, 0.0);
    if (result == CMB_RESULT_OK) {
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
