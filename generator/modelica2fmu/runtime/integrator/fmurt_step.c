/* cmb_step.c - see cmb_step.h. */
#include "cmb_step.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cmb_evaluate.h"
#include "cmb_event.h"
#include "cmb_solver.h"

/* So many state events within so short a time, s, are no physics but a relation that undoes itself. */
enum { CHATTER_EVENTS = 1000 };
static const double chatter_time = 1e-4;

/* Always a fresh start, even if the derivatives do not jump: an event marks at least a kink, which costs the running
 * integrator more rejected steps than starting anew (tried on bouncing bodies). */
static cmb_result carry_out_event(cmb_instance *instance) {
  int states_changed = 0;
  const cmb_result result = cmb_iterate_events(instance, &states_changed);
  cmb_solver_restart(instance->solver);
  return result;
}

static cmb_result report_chatter(cmb_instance *instance, double since) {
  snprintf(instance->message, sizeof instance->message,
           "The model chatters: %d state events between time %.15g and %.15g. A relation undoes the condition under "
           "which it became true; give it a hysteresis or make the change continuous",
           CHATTER_EVENTS, since, instance->values.time);
  return CMB_RESULT_ERROR;
}

/* After a discarded step the other variables belong to some trial point; they can be read, so they shall fit the states.
 * The cause of the discarded step stays the message. */
static void refresh_last_point(cmb_instance *instance) {
  char cause[sizeof instance->message];
  memcpy(cause, instance->message, sizeof cause);
  (void)cmb_update_values(instance);
  memcpy(instance->message, cause, sizeof cause);
}

cmb_result cmb_do_step(cmb_instance *instance, double target, int stop_at_events, int *event_waiting) {
  *event_waiting = 0;
  cmb_values *values = &instance->values;
  cmb_situation *situation = &instance->situation;
  if (instance->solver == NULL) {
    instance->solver = cmb_solver_create(instance);
    if (instance->solver == NULL) {
      snprintf(instance->message, sizeof instance->message, "No memory for the integrator");
      return CMB_RESULT_ERROR;
    }
  }
  cmb_solver_allow_steps(instance->solver, situation->solver_integer[CMB_SOLVER_MAXIMUM_STEPS]);
  cmb_result result = CMB_RESULT_OK;
  if (situation->event_pending) result = carry_out_event(instance);

  const double option = situation->solver_real[CMB_SOLVER_MAXIMUM_STEP];
  const double maximum_step = option > 0.0 ? option : target - values->time;
  int events = 0;
  double chatter_begin = values->time;
  while (result == CMB_RESULT_OK && values->time < target && !situation->terminate_requested) {
    const double stop_time = fmin(target, values->next_time_event);
    cmb_stop stop = CMB_STOP_TARGET;
    if (stop_time > values->time) {
      result = cmb_solver_advance(instance->solver, stop_time, values->next_time_event, maximum_step, &stop);
      if (result != CMB_RESULT_OK) break;
    }
    const int time_event = values->time >= values->next_time_event;
    if (stop != CMB_STOP_ROOT && !time_event) continue;
    ++situation->solver_integer[time_event ? CMB_SOLVER_TIME_EVENTS : CMB_SOLVER_STATE_EVENTS];
    if (stop_at_events) {
      *event_waiting = 1;
      situation->event_pending = 1; /* carried out by the next step if the importer does not do it before */
      break;
    }
    result = carry_out_event(instance);
    if (result != CMB_RESULT_OK) break;
    if (++events < CHATTER_EVENTS) continue;
    if (values->time - chatter_begin < chatter_time) return report_chatter(instance, chatter_begin);
    events = 0;
    chatter_begin = values->time;
  }
  if (result == CMB_RESULT_OK) return cmb_update_values(instance);
  if (result == CMB_RESULT_DISCARD) refresh_last_point(instance);
  return result;
}
