/* cmb_derivative.h - directional derivatives. */
#ifndef CMB_DERIVATIVE_H
#define CMB_DERIVATIVE_H

#include "cmb_instance.h"

/* d(unknown)/d(known) * seed at the present point, relations and discrete variables held; in initialization mode
 * through the initialization problem. State derivatives by states come from the model's Jacobian where it has one,
 * everything else from central differences. All references are Real slots. The instance is afterwards as before.
 * sensitivity receives unknown_count values. */
cmb_result cmb_directional_derivative(cmb_instance *instance, const unsigned *unknown, size_t unknown_count,
                                      const unsigned *known, size_t known_count, const double *seed,
                                      double *sensitivity);

#endif
