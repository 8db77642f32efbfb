/* fmurt_apart.h - explicit steps of third order, of a length of its own for each part of the model that is out of the others'
 * reach: scenes of many bodies, a few of which collide at a time. Steps that are common to all bodies are as short as the one
 * needs whose impact is the hardest just then. */
#ifndef FMURT_APART_H
#define FMURT_APART_H

#include "fmurt_explicit.h"

typedef struct fmurt_apart fmurt_apart;

/* For fmurt_model.parts, which must be there. NULL if memory is short. It belongs to the caller. */
fmurt_apart *fmurt_apart_create(fmurt_instance *instance);
/* self may be NULL. */
void fmurt_apart_destroy(fmurt_apart *self);

/* The next step starts afresh: states or parameters changed, or others integrated since. */
void fmurt_apart_restart(fmurt_apart *self);

/* As fmurt_explicit_advance. An evaluation of some parts counts as their share of an evaluation of all, a step as well. What is
 * told of accepted steps is told where all parts are at one time. */
fmurt_explicit_outcome fmurt_apart_advance(fmurt_apart *self, const fmurt_explicit_model *model, double *time, double *state,
                                           double end, double largest_step, fmurt_explicit_work allowed,
                                           fmurt_explicit_work *done);

#endif
