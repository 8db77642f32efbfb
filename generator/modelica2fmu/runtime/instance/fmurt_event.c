/* fmurt_event.c - see fmurt_event.h. */
#include "fmurt_event.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "fmurt_approach.h"
#include "fmurt_call.h"
#include "fmurt_chatter.h"
#include "fmurt_dead_center.h"
#include "fmurt_delay.h"
#include "fmurt_evaluate.h"

/* Zeros that were found count from this share of the hysteresis on. */
static const double share_of_found = 0.5;

enum { MAXIMUM_EVENT_ITERATIONS = 100, MAXIMUM_SETTLING_ITERATIONS = 30 };

static fmurt_result compute_indicators(fmurt_instance *instance) {
  fmurt_result result = fmurt_update_for_rates(instance);
  if (result == FMURT_RESULT_OK) result = fmurt_call_model(instance, FMURT_CALL_INDICATORS, instance->indicator);
  if (result != FMURT_RESULT_OK) return result;
  for (size_t i = 0; i < fmurt_model.indicator_count; ++i) {
    if (isnan(instance->indicator[i])) {
      snprintf(instance->message, sizeof instance->message, "Event indicator %zu is not a number at time %.15g", i + 1,
               instance->values.time);
      return FMURT_RESULT_DISCARD;
    }
  }
  return FMURT_RESULT_OK;
}

static double hysteresis(const fmurt_instance *instance, size_t indicator) {
  const double share = fmax(FMURT_HYSTERESIS, FMURT_HYSTERESIS_BY_TOLERANCE * instance->situation.settings.tolerance);
  return share * (fmurt_model.indicator_nominal != NULL ? fmurt_model.indicator_nominal[indicator] : 1.0);
}

fmurt_result fmurt_event_indicators(fmurt_instance *instance, double *shifted) {
  const fmurt_result result = compute_indicators(instance);
  if (result != FMURT_RESULT_OK) return result;
  for (size_t i = 0; i < fmurt_model.indicator_count; ++i) {
    const double shift = hysteresis(instance, i);
    shifted[i] = instance->indicator[i] + (instance->values.relation[i] ? shift : -shift);
  }
  return FMURT_RESULT_OK;
}

/* What the relation shall be. Where the integrator has found the zero, it does not hang on the rounding with which the indicator is
 * computed anew: unknowns of nonlinear systems are solved from another start than within the step. */
static int follows(const fmurt_instance *instance, size_t i) {
  const double shift = hysteresis(instance, i) * (instance->crossed[i] ? share_of_found : 1.0);
  return instance->values.relation[i] ? instance->indicator[i] > -shift : instance->indicator[i] >= shift;
}

static void change_relation(fmurt_instance *instance, size_t i) {
  const int relation = !instance->values.relation[i];
  fmurt_log(instance, FMURT_LOG_DEBUG, FMURT_LOG_EVENTS, "Time %.15g: event indicator %zu%s%s becomes %s",
            instance->values.time, i + 1, fmurt_model.indicator_text != NULL ? ", " : "",
            fmurt_model.indicator_text != NULL ? fmurt_model.indicator_text[i] : "",
            relation ? "positive" : "negative");
  instance->values.relation[i] = relation;
  fmurt_chatter_count(instance, i);
  instance->situation.continuous_stale = 1;
}

/* Lets the relations follow the indicators; *changed is set to 1 if one did. */
static fmurt_result update_relations(fmurt_instance *instance, int *changed) {
  const fmurt_result result = compute_indicators(instance);
  if (result != FMURT_RESULT_OK) return result;
  for (size_t i = 0; i < fmurt_model.indicator_count; ++i) {
    if (follows(instance, i) == instance->values.relation[i]) continue;
    change_relation(instance, i);
    *changed = 1;
  }
  return FMURT_RESULT_OK;
}

/* The same for some of them: those that become false, or, where there is none, all; or only the first of all. */
static fmurt_result update_some_relations(fmurt_instance *instance, int only_first, int *changed) {
  const fmurt_result result = compute_indicators(instance);
  if (result != FMURT_RESULT_OK) return result;
  for (int value = 1; value >= 0 && (only_first || !*changed); --value) {
    for (size_t i = 0; i < fmurt_model.indicator_count; ++i) {
      const int relation = instance->values.relation[i];
      if (follows(instance, i) == relation || (!only_first && relation != value)) continue;
      change_relation(instance, i);
      *changed = 1;
      if (only_first) return FMURT_RESULT_OK;
    }
  }
  return FMURT_RESULT_OK;
}

static void copy_to_pre(fmurt_values *values) {
  memcpy(values->pre_real, values->real, fmurt_model.real_count * sizeof(double));
  memcpy(values->pre_integer, values->integer, fmurt_model.integer_count * sizeof(int));
  memcpy(values->pre_boolean, values->boolean, fmurt_model.boolean_count * sizeof(int));
}

static int is_discrete(const fmurt_slot_table *table, size_t slot) {
  return slot < table->count && (table->access[slot] & FMURT_IS_DISCRETE) != 0;
}

/* Name of a discrete variable that differs from its pre() value, NULL if none does. */
static const char *changed_variable(const fmurt_values *values) {
  const fmurt_interface *tables = &fmurt_interface_tables;
  for (size_t i = 0; i < fmurt_model.integer_count; ++i) {
    if (values->integer[i] != values->pre_integer[i]) return fmurt_slot_name(&tables->integer, i);
  }
  for (size_t i = 0; i < fmurt_model.boolean_count; ++i) {
    if (values->boolean[i] != values->pre_boolean[i]) return fmurt_slot_name(&tables->boolean, i);
  }
  for (size_t i = 0; i < fmurt_model.real_count; ++i) {
    if (is_discrete(&tables->real, i) && values->real[i] != values->pre_real[i])
      return fmurt_slot_name(&tables->real, i);
  }
  return NULL;
}

static void meet_time_event(fmurt_values *values, fmurt_situation *situation) {
  const double gap = fabs(values->time - values->next_time_event);
  if (gap == 0.0 || !(gap <= 1e-10 * fmax(1.0, fabs(values->time)))) return;
  values->time = values->next_time_event;
  situation->continuous_stale = 1;
}

/* Lets relations and equations agree for the present pre() values: dry friction that may begin to slide has its
 * acceleration, the relations about it and the Booleans of these in one loop. Relations that turn out false are taken
 * back before others are made true: sliding in one direction is followed by sticking, not by sliding in the other.
 * Where that goes round in circles, the first relation that disagrees is changed (least index: Murty 1974). Where they
 * never agree, the next event iteration goes on with other pre() values. */
static fmurt_result settle(fmurt_instance *instance) {
  if (fmurt_model.settle == NULL) return FMURT_RESULT_OK;
  for (int iteration = 0; iteration < MAXIMUM_SETTLING_ITERATIONS; ++iteration) {
    int changed = 0;
    fmurt_result result = update_some_relations(instance, iteration > MAXIMUM_SETTLING_ITERATIONS / 2, &changed);
    if (result == FMURT_RESULT_OK && (changed || iteration == 0)) {
      result = fmurt_call_model(instance, FMURT_CALL_SETTLE, NULL);
      instance->situation.continuous_stale = 1;
    }
    if (result != FMURT_RESULT_OK || (!changed && iteration > 0)) return result;
  }
  return FMURT_RESULT_OK;
}

static fmurt_result iterate_events(fmurt_instance *instance, int *states_changed) {
  fmurt_values *values = &instance->values;
  values->initial = 0;
  meet_time_event(values, &instance->situation);
  fmurt_result result = fmurt_update_parameters(instance);
  if (result == FMURT_RESULT_OK) result = fmurt_update_continuous(instance);
  if (result != FMURT_RESULT_OK) return result;
  fmurt_delay_close(values);
  copy_to_pre(values);

  const char *changing = NULL;
  for (int iteration = 0; iteration < MAXIMUM_EVENT_ITERATIONS; ++iteration) {
    int relations_changed = 0, reinitialized = 0;
    result = settle(instance);
    if (result == FMURT_RESULT_OK) result = update_relations(instance, &relations_changed);
    if (result == FMURT_RESULT_OK) result = fmurt_update_continuous(instance);
    if (result == FMURT_RESULT_OK) result = fmurt_call_model(instance, FMURT_CALL_DISCRETE, &reinitialized);
    if (result != FMURT_RESULT_OK) return result;
    fmurt_delay_event(values);
    instance->situation.continuous_stale = 1;
    if (reinitialized) *states_changed = 1;
    if (values->terminate) instance->situation.terminate_requested = 1;

    changing = changed_variable(values);
    copy_to_pre(values);
    if (changing == NULL && !reinitialized) {
      relations_changed = 0;
      result = update_relations(instance, &relations_changed);
      if (result != FMURT_RESULT_OK) return result;
      if (!relations_changed) {
        instance->situation.event_pending = 0;
        return fmurt_update_continuous(instance);
      }
    }
  }
  snprintf(instance->message, sizeof instance->message,
           "The event iteration at time %.15g does not settle in %d iterations (last changed: %s)", values->time,
           MAXIMUM_EVENT_ITERATIONS, changing != NULL ? changing : "a relation or a reinitialized state");
  return FMURT_RESULT_ERROR;
}

fmurt_result fmurt_iterate_events(fmurt_instance *instance, int *states_changed) {
  fmurt_approach_forget(instance);
  instance->at_event = 1;
  const fmurt_result result = iterate_events(instance, states_changed);
  instance->at_event = 0;
  memset(instance->crossed, 0, fmurt_model.indicator_count * sizeof *instance->crossed);
  if (result == FMURT_RESULT_OK) fmurt_accept(instance);
  fmurt_history_forget(&instance->values);
  return result;
}

fmurt_result fmurt_terminate(fmurt_instance *instance) {
  int states_changed = 0;
  instance->values.terminal = 1;
  return fmurt_iterate_events(instance, &states_changed);
}
