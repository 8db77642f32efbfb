/* fmurt_chatter.h - notices events that come so fast that no physics is behind them.
 *
 * A relation that undoes the condition under which it became true, as in der(x) = if x > 0 then -1 else 1, changes at
 * every step of the integrator: time goes on by the hysteresis of its indicator, and a run takes for ever. */
#ifndef FMURT_CHATTER_H
#define FMURT_CHATTER_H

#include "fmurt_instance.h"

/* So many events within so short a time, s, are chattering. */
#define FMURT_CHATTER_EVENTS 1000
#define FMURT_CHATTER_TIME 1e-4

/* Counts a change of a relation. */
void fmurt_chatter_count(fmurt_instance *instance, size_t indicator);

/* Counts an event at the present time. 1, once in FMURT_CHATTER_TIME, if the model chatters: the instance's message
 * then says when, which relation changes most often and what helps. */
int fmurt_chatter_found(fmurt_instance *instance);

#endif
