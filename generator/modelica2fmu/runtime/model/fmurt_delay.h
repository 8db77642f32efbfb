/* fmurt_delay.h - Modelica's delay(): what an expression was some time ago.
 *
 * Each delay keeps the last points of its expression in values->delay, so that FMU states hold them. A point that is
 * written again at the same time, or after the time was set back (a rejected step), replaces what was there; an event
 * closes a point, and a jump is two points at one time. Between points the history is the cubic polynomial through up
 * to four points that no jump parts (linear through two). */
#ifndef FMURT_DELAY_H
#define FMURT_DELAY_H

#include "fmurt_model.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Points that one delay keeps; over its longest time they lie no closer together than a thousandth of that. */
enum { FMURT_DELAY_POINTS = 2048, FMURT_DELAY_SIZE = 3 * FMURT_DELAY_POINTS + 4 };

/* Notes the expression's value now and returns what it was `delay` seconds ago, at the earliest when the simulation
 * began. `number` counts the delays of the model from 0; 0 <= delay <= longest, which does not change. */
double fmurt_delay(fmurt_values *values, int number, double expression, double delay, double longest);

/* Before an event: values at this time from now on are those after it. */
void fmurt_delay_close(fmurt_values *values);

/* After an event iteration: jumps that return now have returned, and next_time_event is not after the next that
 * does. */
void fmurt_delay_event(fmurt_values *values);

#ifdef __cplusplus
}
#endif

#endif
