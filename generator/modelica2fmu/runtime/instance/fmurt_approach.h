/* fmurt_approach.h - an event indicator of model exchange for bodies that pass through each other within a step.
 *
 * Importers ask for event indicators at the ends of their steps. This one is positive as long as no bodies have met unseen since the
 * last event. Where some have, it falls through zero where they touch: the importer goes back there for an event, and its
 * integrator starts afresh. */
#ifndef FMURT_APPROACH_H
#define FMURT_APPROACH_H

#include "fmurt_instance.h"

/* How many event indicators importers see. */
size_t fmurt_shown_indicator_count(void);

/* The indicator at the instance's time, at which its values are up to date. */
double fmurt_approach_indicator(fmurt_instance *instance);

/* Called where an importer completes a step, and before it handles an event: FMURT_RESULT_ERROR with a message where it has left
 * behind bodies that met. */
fmurt_result fmurt_approach_check(fmurt_instance *instance);

/* States jumped: what was seen is forgotten. */
void fmurt_approach_forget(fmurt_instance *instance);

#endif
