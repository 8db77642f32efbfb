/* cmb_evaluate.h - bringing an instance's values up to date: parameters, initialization, continuous part. */
#ifndef CMB_EVALUATE_H
#define CMB_EVALUATE_H

#include "cmb_instance.h"

/* Computes dependent parameters if a parameter was set. Before initialization ends, start values too; later
 * everything but parameters keeps its value. */
cmb_result cmb_update_parameters(cmb_instance *instance);

/* Solves the initialization problem if anything was set since; the relations follow the indicators. */
cmb_result cmb_update_initialization(cmb_instance *instance);

/* Computes derivatives and algebraic variables if anything was set since. A derivative that is not finite
 * is CMB_RESULT_DISCARD. */
cmb_result cmb_update_continuous(cmb_instance *instance);

/* Whatever of these the instance's phase needs before values are read. */
cmb_result cmb_update_values(cmb_instance *instance);

/* Sets time and states, [state_count], NULL if there are none; marks values out of date only if something differs. */
void cmb_set_point(cmb_instance *instance, double time, const double *state);

#endif
