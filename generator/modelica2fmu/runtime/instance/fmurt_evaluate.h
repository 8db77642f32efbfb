/* fmurt_evaluate.h - bringing an instance's values up to date: parameters, initialization, continuous part. */
#ifndef FMURT_EVALUATE_H
#define FMURT_EVALUATE_H

#include "fmurt_instance.h"

/* Computes dependent parameters if a parameter was set. Before initialization ends, start values too; later
 * everything but parameters keeps its value. */
fmurt_result fmurt_update_parameters(fmurt_instance *instance);

/* Solves the initialization problem if anything was set since; the relations follow the indicators. */
fmurt_result fmurt_update_initialization(fmurt_instance *instance);

/* Computes derivatives, and what of the algebraic variables they and the event indicators need, if anything was set since.
 * A derivative that is not finite is FMURT_RESULT_DISCARD. */
fmurt_result fmurt_update_rates(fmurt_instance *instance);

/* The same with all algebraic variables. */
fmurt_result fmurt_update_continuous(fmurt_instance *instance);

/* Whatever of these the instance's phase needs before values are read; `..._for_rates`, before derivatives and indicators
 * are. */
fmurt_result fmurt_update_values(fmurt_instance *instance);
fmurt_result fmurt_update_for_rates(fmurt_instance *instance);

/* The values at hand are those of an accepted step: nonlinear systems are followed from them, and assertions at level
 * warning are checked. */
void fmurt_accept(fmurt_instance *instance);

/* Sets time and states, [state_count], NULL if there are none; marks values out of date only if something differs. */
void fmurt_set_point(fmurt_instance *instance, double time, const double *state);

#endif
