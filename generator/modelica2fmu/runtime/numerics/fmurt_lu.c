/* fmurt_lu.c - see fmurt_lu.h. */
#include "fmurt_lu.h"

#include <math.h>
#include <stddef.h>

enum { WIDTH = 4 };

/* As many doubles as the widest registers hold that are common; others take them in parts. */
typedef double numbers __attribute__((vector_size(WIDTH * sizeof(double)), aligned(sizeof(double)), may_alias));

#define IN_LINE static inline __attribute__((always_inline))

/* b[i] -= factor * c[i] for first <= i < n. */
IN_LINE void subtract_multiple(double *restrict b, double factor, const double *restrict c, int first, int n) {
  int i = first;
  for (; i + WIDTH <= n; i += WIDTH) *(numbers *)(b + i) -= factor * *(const numbers *)(c + i);
  for (; i < n; ++i) b[i] -= factor * c[i];
}

/* Comparing instead of fmax(), which the compiler may not put in line. Like fmax(), it passes over NaN. */
IN_LINE double larger(double x, double y) { return y > x ? y : x; }

/* Left-looking (Golub and Van Loan, Matrix Computations, section 3.4): a column is untouched until its turn, so its own
 * size says what rounding leaves of a pivot that should be zero. Zeros above the diagonal save a column each. */
IN_LINE int factorize(int n, double *a, int *pivot, double least) {
  const size_t rows = (size_t)n;
  for (int k = 0; k < n; ++k) {
    double *const column = a + (size_t)k * rows;
    double size = 0.0;
    for (int i = 0; i < n; ++i) size = larger(size, fabs(column[i]));

    for (int j = 0; j < k; ++j) {
      const int row = pivot[j];
      const double entry = column[row];
      column[row] = column[j];
      column[j] = entry;
    }
    for (int j = 0; j < k; ++j) {
      if (column[j] != 0.0) subtract_multiple(column, column[j], a + (size_t)j * rows, j + 1, n);
    }

    int row = k;
    for (int i = k + 1; i < n; ++i) {
      if (fabs(column[i]) > fabs(column[row])) row = i;
    }
    pivot[k] = row;
    if (!(fabs(column[row]) > least * size) || !isfinite(column[row])) return k + 1;
    if (row != k) {
      for (int j = 0; j <= k; ++j) {
        double *const swapped = a + (size_t)j * rows;
        const double entry = swapped[k];
        swapped[k] = swapped[row];
        swapped[row] = entry;
      }
    }
    const double divisor = column[k];
    for (int i = k + 1; i < n; ++i) column[i] /= divisor;
  }
  return 0;
}

IN_LINE void solve(int n, const double *a, const int *pivot, double *b) {
  const size_t rows = (size_t)n;
  for (int k = 0; k < n; ++k) {
    const double entry = b[pivot[k]];
    b[pivot[k]] = b[k];
    b[k] = entry;
  }
  for (int k = 0; k < n; ++k) {
    if (b[k] != 0.0) subtract_multiple(b, b[k], a + (size_t)k * rows, k + 1, n);
  }
  for (int k = n - 1; k >= 0; --k) {
    const double *const column = a + (size_t)k * rows;
    b[k] /= column[k];
    subtract_multiple(b, b[k], column, 0, k);
  }
}

/* On Windows GCC keeps wide registers on a stack that is not aligned for them. */
#if defined(__x86_64__) && !defined(__AVX2__) && !defined(_WIN32)

/* Without fused multiply-add, which rounds differently. */
__attribute__((target("avx2,no-fma"))) static int factorize_wide(int n, double *a, int *pivot, double least) {
  return factorize(n, a, pivot, least);
}

__attribute__((target("avx2,no-fma"))) static void solve_wide(int n, const double *a, const int *pivot, double *b) {
  solve(n, a, pivot, b);
}

int fmurt_lu_factorize(int n, double *a, int *pivot, double least) {
  if (__builtin_cpu_supports("avx2")) return factorize_wide(n, a, pivot, least);
  return factorize(n, a, pivot, least);
}

void fmurt_lu_solve(int n, const double *a, const int *pivot, double *b) {
  if (__builtin_cpu_supports("avx2")) {
    solve_wide(n, a, pivot, b);
  } else {
    solve(n, a, pivot, b);
  }
}

#else

int fmurt_lu_factorize(int n, double *a, int *pivot, double least) { return factorize(n, a, pivot, least); }

void fmurt_lu_solve(int n, const double *a, const int *pivot, double *b) { solve(n, a, pivot, b); }

#endif
