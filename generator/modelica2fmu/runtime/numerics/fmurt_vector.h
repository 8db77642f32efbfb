/* fmurt_vector.h - operations on CVODE's vectors and matrices.
 *
 * Debian's static SUNDIALS library is compiled without optimization; for a mechanism with 50 states its vectors and
 * matrices would take a fifth of the time. */
#ifndef FMURT_VECTOR_H
#define FMURT_VECTOR_H

#include <sundials/sundials_matrix.h>
#include <sundials/sundials_nvector.h>

/* Gives a serial vector, and all that are cloned from it, the operations that CVODE uses most. */
void fmurt_speed_up_vector(N_Vector vector);

/* The same for a SUNDenseMatrix. */
void fmurt_speed_up_matrix(SUNMatrix matrix);

#endif
