/* fmurt_lu.c - see fmurt_lu.h. */
#include "fmurt_lu.h"

#include <limits.h>
#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

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

typedef long long masks __attribute__((vector_size(WIDTH * sizeof(double)), aligned(sizeof(double)), may_alias));

/* Comparing instead of fmax(), which the compiler may not put in line. Like fmax(), it passes over NaN. */
IN_LINE double larger(double x, double y) { return y > x ? y : x; }

/* The largest |b[i]| of first <= i < n, at least 0: several maxima at once, as each waits for the one before. */
IN_LINE double largest(const double *b, int first, int n) {
  const masks without_sign = {LLONG_MAX, LLONG_MAX, LLONG_MAX, LLONG_MAX};
  numbers most = {0.0, 0.0, 0.0, 0.0};
  int i = first;
  for (; i + WIDTH <= n; i += WIDTH) {
    const numbers size = (numbers)(*(const masks *)(b + i) & without_sign);
    const masks more = size > most;
    most = (numbers)(((masks)size & more) | ((masks)most & ~more));
  }
  double result = larger(larger(most[0], most[1]), larger(most[2], most[3]));
  for (; i < n; ++i) result = larger(result, fabs(b[i]));
  return result;
}

/* b[i] /= divisor for first <= i < n. */
IN_LINE void divide(double *b, double divisor, int first, int n) {
  int i = first;
  for (; i + WIDTH <= n; i += WIDTH) *(numbers *)(b + i) /= divisor;
  for (; i < n; ++i) b[i] /= divisor;
}

/* The power of two by which a number of this size comes next to 1, as frexp() counts; 1 for zero, infinity and NaN. */
IN_LINE double power_against(double size) {
  if (!(size > 0.0) || !isfinite(size)) return 1.0;
  uint64_t bits;
  memcpy(&bits, &size, sizeof bits);
  int exponent = (int)(bits >> 52) - 1022;
  if (exponent > -1000 && exponent < 1000) { /* the power is a normal number: it has no digits but its exponent */
    const uint64_t power = (uint64_t)(1023 - exponent) << 52;
    double scale;
    memcpy(&scale, &power, sizeof scale);
    return scale;
  }
  frexp(size, &exponent);
  return ldexp(1.0, exponent > -1000 ? -exponent : 1000); /* finite for subnormal rows too */
}

/* scale[i] becomes the larger of it and |b[i]|. */
IN_LINE void enlarge(int n, double *restrict scale, const double *restrict b) {
  const masks without_sign = {LLONG_MAX, LLONG_MAX, LLONG_MAX, LLONG_MAX};
  int i = 0;
  for (; i + WIDTH <= n; i += WIDTH) {
    const numbers size = (numbers)(*(const masks *)(b + i) & without_sign), before = *(const numbers *)(scale + i);
    const masks more = size > before;
    *(numbers *)(scale + i) = (numbers)(((masks)size & more) | ((masks)before & ~more));
  }
  for (; i < n; ++i) scale[i] = larger(scale[i], fabs(b[i]));
}

IN_LINE void scale_rows(int n, double *restrict a, double *restrict scale) {
  const size_t rows = (size_t)n;
  for (int i = 0; i < n; ++i) scale[i] = 0.0;
  for (int j = 0; j < n; ++j) enlarge(n, scale, a + (size_t)j * rows);
  for (int i = 0; i < n; ++i) scale[i] = power_against(scale[i]);
  for (int j = 0; j < n; ++j) {
    double *const column = a + (size_t)j * rows;
    int i = 0;
    for (; i + WIDTH <= n; i += WIDTH) *(numbers *)(column + i) *= *(const numbers *)(scale + i);
    for (; i < n; ++i) column[i] *= scale[i];
  }
}

/* Columns that are eliminated together, so that each waits less for its own last step. */
enum { TOGETHER = 4 };

IN_LINE void exchange(double *column, int i, int j) {
  const double entry = column[i];
  column[i] = column[j];
  column[j] = entry;
}

/* Subtracts from `count` columns, at `column`, what the finished columns before `k` leave of them. */
IN_LINE void eliminate(int n, const double *a, int k, const int *pivot, double *column, int count) {
  const size_t rows = (size_t)n;
  for (int j = 0; j < k; ++j) {
    if (pivot[j] == j) continue;
    for (int c = 0; c < count; ++c) exchange(column + (size_t)c * rows, pivot[j], j);
  }
  for (int j = 0; j < k; ++j) {
    const double *const finished = a + (size_t)j * rows;
    double factor[TOGETHER];
    int is_any = 0;
    for (int c = 0; c < count; ++c) {
      factor[c] = column[(size_t)c * rows + (size_t)j];
      is_any |= factor[c] != 0.0;
    }
    if (!is_any) continue;
    int i = j + 1;
    for (; i + WIDTH <= n; i += WIDTH) {
      const numbers of_finished = *(const numbers *)(finished + i);
      for (int c = 0; c < count; ++c) *(numbers *)(column + (size_t)c * rows + i) -= factor[c] * of_finished;
    }
    for (; i < n; ++i) {
      for (int c = 0; c < count; ++c) column[(size_t)c * rows + (size_t)i] -= factor[c] * finished[i];
    }
  }
}

/* Left-looking (Golub and Van Loan, Matrix Computations, section 3.4): a column is untouched until its turn, so its own
 * size says what rounding leaves of a pivot that should be zero. Zeros above the diagonal save a column each. */
IN_LINE int factorize(int n, double *a, int *pivot, double least) {
  const size_t rows = (size_t)n;
  for (int begin = 0; begin < n; begin += TOGETHER) {
    const int end = begin + TOGETHER < n ? begin + TOGETHER : n;
    double size[TOGETHER];
    for (int k = begin; k < end; ++k) size[k - begin] = largest(a + (size_t)k * rows, 0, n);
    if (end - begin == TOGETHER) {
      eliminate(n, a, begin, pivot, a + (size_t)begin * rows, TOGETHER);
    } else {
      for (int k = begin; k < end; ++k) eliminate(n, a, begin, pivot, a + (size_t)k * rows, 1);
    }
    for (int k = begin; k < end; ++k) {
      double *const column = a + (size_t)k * rows;
      for (int j = begin; j < k; ++j) exchange(column, pivot[j], j);
      for (int j = begin; j < k; ++j) {
        if (column[j] != 0.0) subtract_multiple(column, column[j], a + (size_t)j * rows, j + 1, n);
      }
      int row = k;
      const double most = largest(column, k, n);
      if (most > fabs(column[k])) {
        while (fabs(column[row]) != most) ++row;
      }
      pivot[k] = row;
      if (!(fabs(column[row]) > least * size[k - begin]) || !isfinite(column[row])) return k + 1;
      if (row != k) {
        for (int j = 0; j <= k; ++j) exchange(a + (size_t)j * rows, k, row);
      }
      divide(column, column[k], k + 1, n);
    }
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

__attribute__((target("avx2,no-fma"))) static void scale_rows_wide(int n, double *a, double *scale) {
  scale_rows(n, a, scale);
}

void fmurt_lu_scale_rows(int n, double *a, double *scale) {
  if (__builtin_cpu_supports("avx2")) {
    scale_rows_wide(n, a, scale);
  } else {
    scale_rows(n, a, scale);
  }
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

void fmurt_lu_scale_rows(int n, double *a, double *scale) { scale_rows(n, a, scale); }

int fmurt_lu_factorize(int n, double *a, int *pivot, double least) { return factorize(n, a, pivot, least); }

void fmurt_lu_solve(int n, const double *a, const int *pivot, double *b) { solve(n, a, pivot, b); }

#endif
