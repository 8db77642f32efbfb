/* fmurt_solved.h - the points of model exchange that were solved since the last completed step.
 *
 * An importer may take many steps before it says that one is completed. Where a point is too far from the accepted one to be
 * followed from there, it is followed from the solved ones, the nearest in time first. */
#ifndef FMURT_SOLVED_H
#define FMURT_SOLVED_H

#include "fmurt_instance.h"

/* Shows values.solved the remembered points, in model exchange between events, else none. */
void fmurt_offer_solved(fmurt_instance *instance);

/* The values at hand were solved: they are remembered, one point for each time, in place of the oldest. */
void fmurt_remember_solved(fmurt_instance *instance);

/* What was remembered belongs to steps that are completed. */
void fmurt_forget_solved(fmurt_instance *instance);

#endif
