/* fmurt_lu.h - LU factorization of dense matrices with partial pivoting; column-major, thread-safe, no allocation.
 *
 * Results do not depend on the processor: wider registers do the same operations on more elements at once. */
#ifndef FMURT_LU_H
#define FMURT_LU_H

/* Overwrites `a` (n x n) with its factors; `pivot` has n elements. 0 on success, k + 1 if no pivot in column k is
 * larger than `least` times the column's largest element before the elimination. */
int fmurt_lu_factorize(int n, double *a, int *pivot, double least);

/* Scales every row of `a` (n x n) by the power of two next to its largest entry, kept in `scale`: exact, and pivots of rows in
 * different units become comparable. */
void fmurt_lu_scale_rows(int n, double *a, double *scale);

/* Solves A x = b with these factors: b in, x out. */
void fmurt_lu_solve(int n, const double *a, const int *pivot, double *b);

/* b -= factor c, of n elements that do not overlap. */
void fmurt_lu_subtract(int n, double *b, double factor, const double *c);

#endif
