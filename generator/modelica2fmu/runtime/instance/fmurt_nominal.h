/* fmurt_nominal.h - sizes of states, which tolerances and difference quotients go by. */
#ifndef FMURT_NOMINAL_H
#define FMURT_NOMINAL_H

#include "fmurt_model.h"

/* Fits nominal values of positions to the thinnest of the bodies that may touch. After parameters have been computed. */
void fmurt_fit_nominals(fmurt_values *values);

#endif
