/* fmurt_derivative.h - directional derivatives. */
#ifndef FMURT_DERIVATIVE_H
#define FMURT_DERIVATIVE_H

#include "fmurt_instance.h"

/* d(unknown)/d(known) * seed at the present point, relations and discrete variables held; in initialization mode
 * through the initialization problem. State derivatives by states come from the model's Jacobian where it has one,
 * everything else from central differences. All references are Real slots. The instance is afterwards as before.
 * sensitivity receives unknown_count values. */
fmurt_result fmurt_directional_derivative(fmurt_instance *instance, const unsigned *unknown, size_t unknown_count,
                                          const unsigned *known, size_t known_count, const double *seed,
                                          double *sensitivity);

#endif
