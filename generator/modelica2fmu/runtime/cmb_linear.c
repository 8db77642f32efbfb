/* cmb_linear.c - dense linear systems for generated code. */
#include <float.h>
#include <math.h>

#include "cmb_model.h"

/* Comparing instead of fmax(), which the compiler may not put in line and which then costs more than the
 * elimination of a small system. Like fmax(), it passes over NaN. */
static double larger(double x, double y) { return y > x ? y : x; }

/* Scales every row of A by the power of two next to its largest entry: exact, and pivots of rows in different units
 * become comparable. */
static void scale_rows(int n, double *a, double *scale) {
  for (int i = 0; i < n; ++i) {
    double largest = 0.0;
    for (int j = 0; j < n; ++j) largest = larger(largest, fabs(a[i + (size_t)j * (size_t)n]));
    scale[i] = 1.0;
    if (!(largest > 0.0) || !isfinite(largest)) continue;
    int exponent;
    frexp(largest, &exponent);
    scale[i] = ldexp(1.0, exponent > -1000 ? -exponent : 1000); /* finite for subnormal rows too */
    for (int j = 0; j < n; ++j) a[i + (size_t)j * (size_t)n] *= scale[i];
  }
}

/* Left-looking LU with partial pivoting (Golub and Van Loan, Matrix Computations, section 3.4): a column is
 * untouched until its turn, so its own size says what rounding leaves of a pivot that should be zero. */
int cmb_factorize(int n, double *a, double *scale, int *pivot) {
  scale_rows(n, a, scale);
  const size_t rows = (size_t)n;
  for (int k = 0; k < n; ++k) {
    double *column = a + (size_t)k * rows;
    double size = 0.0;
    for (int i = 0; i < n; ++i) size = larger(size, fabs(column[i]));

    for (int j = 0; j < k; ++j) {
      const int row = pivot[j];
      const double entry = column[row];
      column[row] = column[j];
      column[j] = entry;
    }
    for (int j = 0; j < k; ++j) {
      const double entry = column[j];
      if (entry == 0.0) continue;
      const double *factor = a + (size_t)j * rows;
      for (int i = j + 1; i < n; ++i) column[i] -= factor[i] * entry;
    }

    int row = k;
    for (int i = k + 1; i < n; ++i) {
      if (fabs(column[i]) > fabs(column[row])) row = i;
    }
    pivot[k] = row;
    if (!(fabs(column[row]) > n * DBL_EPSILON * size) || !isfinite(column[row])) return k + 1;
    if (row != k) {
      for (int j = 0; j <= k; ++j) {
        double *swapped = a + (size_t)j * rows;
        const double entry = swapped[k];
        swapped[k] = swapped[row];
        swapped[row] = entry;
      }
    }
    for (int i = k + 1; i < n; ++i) column[i] /= column[k];
  }
  return 0;
}

void cmb_substitute(int n, const double *a, const double *scale, const int *pivot, double *b) {
  const size_t rows = (size_t)n;
  for (int k = 0; k < n; ++k) b[k] *= scale[k];
  for (int k = 0; k < n; ++k) {
    const double entry = b[pivot[k]];
    b[pivot[k]] = b[k];
    b[k] = entry;
  }
  for (int k = 0; k < n; ++k) {
    const double *column = a + (size_t)k * rows;
    for (int i = k + 1; i < n; ++i) b[i] -= column[i] * b[k];
  }
  for (int k = n - 1; k >= 0; --k) {
    const double *column = a + (size_t)k * rows;
    b[k] /= column[k];
    for (int i = 0; i < k; ++i) b[i] -= column[i] * b[k];
  }
}

/* b += factor * c on all lanes. */
static void add_lanes(double *restrict b, double factor, const double *restrict c) {
  for (int lane = 0; lane < CMB_LANES; ++lane) b[lane] += factor * c[lane];
}

void cmb_substitute_lanes(int n, const double *a, const double *scale, const int *pivot, double *b) {
  const size_t rows = (size_t)n;
  for (int k = 0; k < n; ++k) {
    for (int lane = 0; lane < CMB_LANES; ++lane) b[k * CMB_LANES + lane] *= scale[k];
  }
  for (int k = 0; k < n; ++k) {
    if (pivot[k] == k) continue;
    for (int lane = 0; lane < CMB_LANES; ++lane) {
      const double entry = b[pivot[k] * CMB_LANES + lane];
      b[pivot[k] * CMB_LANES + lane] = b[k * CMB_LANES + lane];
      b[k * CMB_LANES + lane] = entry;
    }
  }
  for (int k = 0; k < n; ++k) {
    const double *column = a + (size_t)k * rows;
    for (int i = k + 1; i < n; ++i) {
      if (column[i] != 0.0) add_lanes(b + i * CMB_LANES, -column[i], b + k * CMB_LANES);
    }
  }
  for (int k = n - 1; k >= 0; --k) {
    const double *column = a + (size_t)k * rows;
    for (int lane = 0; lane < CMB_LANES; ++lane) b[k * CMB_LANES + lane] /= column[k];
    for (int i = 0; i < k; ++i) {
      if (column[i] != 0.0) add_lanes(b + i * CMB_LANES, -column[i], b + k * CMB_LANES);
    }
  }
}
