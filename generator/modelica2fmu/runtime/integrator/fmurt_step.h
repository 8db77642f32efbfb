/* fmurt_step.h - one communication step of co-simulation. */
#ifndef FMURT_STEP_H
#define FMURT_STEP_H

#include "fmurt_instance.h"

/* Goes from the instance's time to exactly target, through all events between; stops earlier where the model
 * terminates (situation.terminate_requested) or the result is not FMURT_RESULT_OK: the instance's time is then
 * the last one reached. With stop_at_events it stops at the first event too, before carrying it out, and sets
 * *event_waiting to 1 (to 0 otherwise). */
fmurt_result fmurt_do_step(fmurt_instance *instance, double target, int stop_at_events, int *event_waiting);

#endif
