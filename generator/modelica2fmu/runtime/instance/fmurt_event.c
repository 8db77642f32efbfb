/* cmb_event.c - see cmb_event.h. */
#include "cmb_event.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cmb_call.h"
#include "cmb_delay.h"
#include "cmb_evaluate.h"

enum { MAXIMUM_EVENT_ITERATIONS = 100, MAXIMUM_SETTLING_ITERATIONS = 30 };

static cmb_result compute_indicators(cmb_instance *instance) {
  cmb_result result = cmb_update_values(instance);
  if (result == CMB_RESULT_OK) result = cmb_call_model(instance, CMB_CALL_INDICATORS, instance->indicator);
  if (result != CMB_RESULT_OK) return result;
  for (size_t i = 0; i < cmb_model.indicator_count; ++i) {
    if (isnan(instance->indicator[i])) {
      snprintf(instance->message, sizeof instance->message, "Event indicator %zu is not a number at time %.15g", i + 1,
               instance->values.time);
      return CMB_RESULT_DISCARD;
    }
  }
  return CMB_RESULT_OK;
}

static double hysteresis(size_t indicator) {
  return CMB_HYSTERESIS * (cmb_model.indicator_nominal != NULL ? cmb_model.indicator_nominal[indicator] : 1.0);
}

cmb_result cmb_event_indicators(cmb_instance *instance, double *shifted) {
  const cmb_result result = compute_indicators(instance);
  if (result != CMB_RESULT_OK) return result;
  for (size_t i = 0; i < cmb_model.indicator_count; ++i) {
    const double shift = hysteresis(i);
    shifted[i] = instance->indicator[i] + (instance->values.relation[i] ? shift : -shift);
  }
  return CMB_RESULT_OK;
}

static int follows(const cmb_instance *instance, size_t i) {
  const double shift = hysteresis(i);
  return instance->values.relation[i] ? instance->indicator[i] > -shift : instance->indicator[i] >= shift;
}

static void change_relation(cmb_instance *instance, size_t i) {
  const int relation = !instance->values.relation[i];
  cmb_log(instance, CMB_LOG_DEBUG, CMB_LOG_EVENTS, "Time %.15g: event indicator %zu%s%s becomes %s",
          instance->values.time, i + 1, cmb_model.indicator_text != NULL ? ", " : "",
          cmb_model.indicator_text != NULL ? cmb_model.indicator_text[i] : "", relation ? "positive" : "negative");
  instance->values.relation[i] = relation;
  instance->situation.continuous_stale = 1;
}

/* Lets the relations follow the indicators; *changed is set to 1 if one did. */
static cmb_result update_relations(cmb_instance *instance, int *changed) {
  const cmb_result result = compute_indicators(instance);
  if (result != CMB_RESULT_OK) return result;
  for (size_t i = 0; i < cmb_model.indicator_count; ++i) {
    if (follows(instance, i) == instance->values.relation[i]) continue;
    change_relation(instance, i);
    *changed = 1;
  }
  return CMB_RESULT_OK;
}

/* The same for some of them: those that become false, or, where there is none, all; or only the first of all. */
static cmb_result update_some_relations(cmb_instance *instance, int only_first, int *changed) {
  const cmb_result result = compute_indicators(instance);
  if (result != CMB_RESULT_OK) return result;
  for (int value = 1; value >= 0 && (only_first || !*changed); --value) {
    for (size_t i = 0; i < cmb_model.indicator_count; ++i) {
      const int relation = instance->values.relation[i];
      if (follows(instance, i) == relation || (!only_first && relation != value)) continue;
      change_relation(instance, i);
      *changed = 1;
      if (only_first) return CMB_RESULT_OK;
    }
  }
  return CMB_RESULT_OK;
}

static void copy_to_pre(cmb_values *values) {
  memcpy(values->pre_real, values->real, cmb_model.real_count * sizeof(double));
  memcpy(values->pre_integer, values->integer, cmb_model.integer_count * sizeof(int));
  memcpy(values->pre_boolean, values->boolean, cmb_model.boolean_count * sizeof(int));
}

static int is_discrete(const cmb_slot_table *table, size_t slot) {
  return slot < table->count && (table->access[slot] & CMB_IS_DISCRETE) != 0;
}

/* Name of a discrete variable that differs from its pre() value, NULL if none does. */
static const char *changed_variable(const cmb_values *values) {
  const cmb_interface *tables = &cmb_interface_tables;
  for (size_t i = 0; i < cmb_model.integer_count; ++i) {
    if (values->integer[i] != values->pre_integer[i]) return cmb_slot_name(&tables->integer, i);
  }
  for (size_t i = 0; i < cmb_model.boolean_count; ++i) {
    if (values->boolean[i] != values->pre_boolean[i]) return cmb_slot_name(&tables->boolean, i);
  }
  for (size_t i = 0; i < cmb_model.real_count; ++i) {
    if (is_discrete(&tables->real, i) && values->real[i] != values->pre_real[i]) return cmb_slot_name(&tables->real, i);
  }
  return NULL;
}

static void meet_time_event(cmb_values *values, cmb_situation *situation) {
  const double gap = fabs(values->time - values->next_time_event);
  if (gap == 0.0 || !(gap <= 1e-10 * fmax(1.0, fabs(values->time)))) return;
  values->time = values->next_time_event;
  situation->continuous_stale = 1;
}

/* Lets relations and equations agree for the present pre() values: dry friction that may begin to slide has its
 * acceleration, the relations about it and the Booleans of these in one loop. Relations that turn out false are taken
 * back before others are made true: sliding in one direction is followed by sticking, not by sliding in the other. Where
 * that goes round in circles, the first relation that disagrees is changed (least index: Murty 1974). Where they never
 * agree, the next event iteration goes on with other pre() values. */
static cmb_result settle(cmb_instance *instance) {
  if (cmb_model.settle == NULL) return CMB_RESULT_OK;
  for (int iteration = 0; iteration < MAXIMUM_SETTLING_ITERATIONS; ++iteration) {
    int changed = 0;
    cmb_result result = update_some_relations(instance, iteration > MAXIMUM_SETTLING_ITERATIONS / 2, &changed);
    if (result == CMB_RESULT_OK && (changed || iteration == 0)) {
      result = cmb_call_model(instance, CMB_CALL_SETTLE, NULL);
      instance->situation.continuous_stale = 1;
    }
    if (result != CMB_RESULT_OK || (!changed && iteration > 0)) return result;
  }
  return CMB_RESULT_OK;
}

cmb_result cmb_iterate_events(cmb_instance *instance, int *states_changed) {
  cmb_values *values = &instance->values;
  values->initial = 0;
  meet_time_event(values, &instance->situation);
  cmb_result result = cmb_update_parameters(instance);
  if (result == CMB_RESULT_OK) result = cmb_update_continuous(instance);
  if (result != CMB_RESULT_OK) return result;
  cmb_delay_close(values);
  copy_to_pre(values);

  const char *changing = NULL;
  for (int iteration = 0; iteration < MAXIMUM_EVENT_ITERATIONS; ++iteration) {
    int relations_changed = 0, reinitialized = 0;
    result = settle(instance);
    if (result == CMB_RESULT_OK) result = update_relations(instance, &relations_changed);
    if (result == CMB_RESULT_OK) result = cmb_update_continuous(instance);
    if (result == CMB_RESULT_OK) result = cmb_call_model(instance, CMB_CALL_DISCRETE, &reinitialized);
    if (result != CMB_RESULT_OK) return result;
    cmb_delay_event(values);
    instance->situation.continuous_stale = 1;
    if (reinitialized) *states_changed = 1;
    if (values->terminate) instance->situation.terminate_requested = 1;

    changing = changed_variable(values);
    copy_to_pre(values);
    if (changing == NULL && !reinitialized) {
      relations_changed = 0;
      result = update_relations(instance, &relations_changed);
      if (result != CMB_RESULT_OK) return result;
      if (!relations_changed) {
        instance->situation.event_pending = 0;
        return cmb_update_continuous(instance);
      }
    }
  }
  snprintf(instance->message, sizeof instance->message,
           "The event iteration at time %.15g does not settle in %d iterations (last changed: %s)", values->time,
           MAXIMUM_EVENT_ITERATIONS, changing != NULL ? changing : "a relation or a reinitialized state");
  return CMB_RESULT_ERROR;
}

cmb_result cmb_terminate(cmb_instance *instance) {
  int states_changed = 0;
  instance->values.terminal = 1;
  return cmb_iterate_events(instance, &states_changed);
}
