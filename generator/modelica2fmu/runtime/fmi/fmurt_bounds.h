/* fmurt_bounds.h - bounds of parameters, which values from outside must keep. */
#ifndef FMURT_BOUNDS_H
#define FMURT_BOUNDS_H

#include "fmurt_instance.h"

/* FMURT_RESULT_ERROR, with a message in the instance, if the slot is a bounded parameter and the value lies outside. */
fmurt_result fmurt_check_bounds(fmurt_instance *instance, const fmurt_slot_table *table, unsigned slot, double value);

#endif
