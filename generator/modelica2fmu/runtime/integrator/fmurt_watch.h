/* fmurt_watch.h - event indicators that change their sign and change it back within one step.
 *
 * An integrator compares signs at the ends of its steps. Where an indicator may have had zeros between them, this looks
 * there, at interpolated states, and shows the indicator to the integrator as if it had kept the sign that it had in
 * between; so the integrator finds the first of the zeros itself. */
#ifndef FMURT_WATCH_H
#define FMURT_WATCH_H

#include <stddef.h>

typedef struct fmurt_watch fmurt_watch;

/* The indicators at a time within the last step. 0 on success; where it fails nothing is looked for. */
typedef int (*fmurt_indicators_at)(void *context, double time, double *indicator);

/* NULL if memory is short. */
fmurt_watch *fmurt_watch_create(size_t indicator_count);
/* watch may be NULL. */
void fmurt_watch_destroy(fmurt_watch *watch);
/* The integrator starts afresh: all that was seen is forgotten. */
void fmurt_watch_restart(fmurt_watch *watch);
/* The indicators as the integrator asks for them, the start and the end of each step or of a part of it before times
 * inside; looks between the last two times. Earlier times do nothing. */
void fmurt_watch_step(fmurt_watch *watch, double time, const double *indicator, fmurt_indicators_at indicators_at,
                      void *context);
/* Changes indicators of a time to what the integrator shall see. */
void fmurt_watch_show(const fmurt_watch *watch, double time, double *indicator);

#endif
