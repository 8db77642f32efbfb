/* fmurt_explicit.h - explicit steps of third order, for large models that are not stiff beside the steps that their
 * accuracy asks for: scenes of many bodies that collide one after the other. Each collision is a kink. It costs a method of
 * several steps its order, an implicit one its iteration, and these steps an evaluation or two. */
#ifndef FMURT_EXPLICIT_H
#define FMURT_EXPLICIT_H

#include <stddef.h>

#include "fmurt_instance.h"

typedef struct fmurt_explicit fmurt_explicit;

/* The derivatives of the states at a time; DISCARD where they cannot be computed there. */
typedef fmurt_result (*fmurt_derivatives)(void *context, double time, const double *state, double *derivative);
/* Told of each accepted step, the derivatives at whose end were the last that were asked for. */
typedef void (*fmurt_accepted)(void *context);

/* A step by its ends, which the error test permits; states and slopes of all states. */
typedef struct fmurt_explicit_step {
  double time, length;
  const double *begin, *first, *end, *last;
} fmurt_explicit_step;

/* Whether something happened in the step that its ends do not show: 0, or the share of it after which it is to end. The derivatives
 * at its end were the last that were asked for; where `length` is 0, those of the first step's beginning. */
typedef double (*fmurt_unseen)(void *context, const fmurt_explicit_step *step);

typedef struct fmurt_explicit_model {
  fmurt_derivatives derivatives;
  fmurt_accepted accepted;
  fmurt_unseen unseen; /* NULL: nothing can */
  void *context;
  double relative;        /* tolerance of a state by its absolute value, */
  const double *absolute; /* and beside it */
} fmurt_explicit_model;

typedef enum fmurt_explicit_outcome {
  FMURT_EXPLICIT_AT_END,
  FMURT_EXPLICIT_STOPPED, /* the work that was allowed is done */
  FMURT_EXPLICIT_STUCK,   /* no step is short enough */
  FMURT_EXPLICIT_ERROR    /* of the model */
} fmurt_explicit_outcome;

typedef struct fmurt_explicit_work {
  long steps, evaluations, rejected;
} fmurt_explicit_work;

/* NULL if memory is short. It belongs to the caller. */
fmurt_explicit *fmurt_explicit_create(size_t state_count);
/* self may be NULL. */
void fmurt_explicit_destroy(fmurt_explicit *self);

/* The next step starts afresh: the states jumped, or others integrated since. */
void fmurt_explicit_restart(fmurt_explicit *self);

/* Goes on from *time and state to end, with steps of largest_step at most (no bound where it is 0), until so much work as
 * allowed is done: *time and state are those of the last accepted step, `done` is what was done. */
fmurt_explicit_outcome fmurt_explicit_advance(fmurt_explicit *self, const fmurt_explicit_model *model, double *time,
                                              double *state, double end, double largest_step,
                                              fmurt_explicit_work allowed, fmurt_explicit_work *done);

#endif
