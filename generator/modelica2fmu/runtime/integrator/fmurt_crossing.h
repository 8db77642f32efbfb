/* fmurt_crossing.h - where within a step event indicators change their signs first.
 *
 * CVODE's own search follows the indicator whose straight line crosses zero first. One that jumps, as the speed of an impact does
 * where a distance vanishes, leads it astray: forty evaluations of the model an event. This search follows the one that is
 * straightest, in about ten, and tells CVODE what it found. */
#ifndef FMURT_CROSSING_H
#define FMURT_CROSSING_H

#include <stddef.h>

#include "fmurt_watch.h"

typedef struct fmurt_crossing fmurt_crossing;

/* NULL if memory is short. */
fmurt_crossing *fmurt_crossing_create(size_t indicator_count);
/* crossing may be NULL. */
void fmurt_crossing_destroy(fmurt_crossing *crossing);
/* The integrator starts afresh: all that was seen is forgotten. */
void fmurt_crossing_restart(fmurt_crossing *crossing);
/* The indicators as the integrator sees them, at the start and the end of each step or of a part of it; looks between the last two
 * times where signs differ. Earlier times do nothing. */
void fmurt_crossing_look(fmurt_crossing *crossing, double time, const double *indicator, fmurt_indicators_at indicators_at,
                         void *context);
/* 1 if it is known on which side of the crossing a time before the last one is; `indicator` has the signs of that side then. */
int fmurt_crossing_tell(const fmurt_crossing *crossing, double time, double *indicator);

#endif
