/* fmurt_step.c - see fmurt_step.h. */
#include "fmurt_step.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "fmurt_chatter.h"
#include "fmurt_evaluate.h"
#include "fmurt_event.h"
#include "fmurt_solver.h"

/* Always a fresh start, even if the derivatives do not jump: an event marks at least a kink, which costs the running
 * integrator more rejected steps than starting anew (tried on bouncing bodies). */
static fmurt_result carry_out_event(fmurt_instance *instance) {
  int states_changed = 0;
  const fmurt_result result = fmurt_iterate_events(instance, &states_changed);
  fmurt_solver_restart_after_event(instance->solver);
  return result;
}

/* After a discarded step the other variables belong to some trial point; they can be read, so they shall fit the
 * states. The cause of the discarded step stays the message. */
static void refresh_last_point(fmurt_instance *instance) {
  char cause[sizeof instance->message];
  memcpy(cause, instance->message, sizeof cause);
  (void)fmurt_update_values(instance);
  memcpy(instance->message, cause, sizeof cause);
}

fmurt_result fmurt_do_step(fmurt_instance *instance, double target, int stop_at_events, int *event_waiting) {
  *event_waiting = 0;
  fmurt_values *values = &instance->values;
  fmurt_situation *situation = &instance->situation;
  if (instance->solver == NULL) {
    instance->solver = fmurt_solver_create(instance);
    instance->destroy_solver = fmurt_solver_destroy;
    if (instance->solver == NULL) {
      snprintf(instance->message, sizeof instance->message, "No memory for the integrator");
      return FMURT_RESULT_ERROR;
    }
  }
  fmurt_solver_allow_steps(instance->solver, situation->solver_integer[FMURT_SOLVER_MAXIMUM_STEPS]);
  fmurt_result result = FMURT_RESULT_OK;
  if (situation->event_pending) result = carry_out_event(instance);

  const double option = situation->solver_real[FMURT_SOLVER_MAXIMUM_STEP];
  const double maximum_step = option > 0.0 ? option : target - values->time;
  while (result == FMURT_RESULT_OK && values->time < target && !situation->terminate_requested) {
    const double stop_time = fmin(target, values->next_time_event);
    fmurt_stop stop = FMURT_STOP_TARGET;
    if (stop_time > values->time) {
      result = fmurt_solver_advance(instance->solver, stop_time, values->next_time_event, maximum_step, &stop);
      if (result != FMURT_RESULT_OK) break;
    }
    const int time_event = values->time >= values->next_time_event;
    if (stop != FMURT_STOP_ROOT && !time_event) continue;
    ++situation->solver_integer[time_event ? FMURT_SOLVER_TIME_EVENTS : FMURT_SOLVER_STATE_EVENTS];
    if (stop_at_events) {
      *event_waiting = 1;
      situation->event_pending = 1; /* carried out by the next step if the importer does not do it before */
      break;
    }
    result = fmurt_update_continuous(instance); /* up to here nothing jumps */
    if (result == FMURT_RESULT_OK) result = carry_out_event(instance);
    if (result == FMURT_RESULT_OK && fmurt_chatter_found(instance)) result = FMURT_RESULT_ERROR;
  }
  if (result == FMURT_RESULT_OK) return fmurt_update_values(instance);
  if (result == FMURT_RESULT_DISCARD) refresh_last_point(instance);
  return result;
}
