/* fmurt_passage.h - bodies that pass through each other between the ends of an integrator's step.
 *
 * Contacts are compliant and found where the integrator looks. A ball that moves farther than it is thick in a step is before
 * another one at the step's beginning and behind it at its end; the step is accurate as if nothing were there. So the ways of all
 * bodies in the step are looked at, and in between where these may have crossed. */
#ifndef FMURT_PASSAGE_H
#define FMURT_PASSAGE_H

#include "fmurt_instance.h"

typedef struct fmurt_passage fmurt_passage;

/* The states at a share of the step, 0 ... 1; 0 on success. */
typedef int (*fmurt_states_at)(void *context, double share, double *state);

/* Where bodies met that nobody saw. */
typedef struct fmurt_meeting {
  double time;      /* from which on they touch */
  double next_step; /* in which they get into each other by a ten-thousandth of the thickness of the thinner one */
} fmurt_meeting;

/* NULL if memory is short. It belongs to the caller; the instance outlives it. */
fmurt_passage *fmurt_passage_create(fmurt_instance *instance);
/* self may be NULL. */
void fmurt_passage_destroy(fmurt_passage *self);

/* A step begins at the instance's time, at which its values are up to date. */
void fmurt_passage_begin(fmurt_passage *self);
/* The one that was looked at last is to be repeated, from its beginning. */
void fmurt_passage_go_back(fmurt_passage *self);

/* Looks at the step that ends at the instance's time, at which its values are up to date. 1 with the first meeting, or 0, and the
 * next step begins there. */
int fmurt_passage_look(fmurt_passage *self, fmurt_states_at states_at, void *context, fmurt_meeting *meeting);
/* Warns that a step could not be looked through, once: is_told says so from then on. The cause is the instance's message. */
void fmurt_tell_unsearched(fmurt_instance *instance, double begin, double end, int *is_told);
/* The names of those that met last, for messages. */
const char *fmurt_passage_text(const fmurt_passage *self);

/* A state at a share of a step, by the cubic through values and slopes at both ends. */
static inline double fmurt_between(double share, double step, double begin, double first, double end, double last) {
  const double rest = 1.0 - share, change = end - begin;
  return begin + share * (change + rest * (rest * (step * first - change) - share * (step * last - change)));
}

#endif
