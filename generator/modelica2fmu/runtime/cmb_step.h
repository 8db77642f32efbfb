/* cmb_step.h - one communication step of co-simulation. */
#ifndef CMB_STEP_H
#define CMB_STEP_H

#include "cmb_instance.h"

/* Goes from the instance's time to exactly target, through all events between; stops earlier where the model
 * terminates (situation.terminate_requested) or the result is not CMB_RESULT_OK: the instance's time is then
 * the last one reached. */
cmb_result cmb_do_step(cmb_instance *instance, double target);

#endif
