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

/* Which blocks of WIDTH rows of a finished column hold anything below its diagonal, as bits: what stays apart while it is
 * eliminated, as the legs of a robot, is passed over. With more rows than bits all count as filled. */
typedef uint64_t blocks;
enum { MOST_ROWS_IN_BLOCKS = 64 * WIDTH };
static const blocks all_blocks = ~(blocks)0;

IN_LINE blocks block_of(int row) { return (blocks)1 << (row / WIDTH); }

/* The next rows below `row` that are filled, of those in `left`: first <= i < end; takes them out. 0 if there are none. */
IN_LINE int next_rows(blocks *left, int row, int n, int *first, int *end) {
  if (n > MOST_ROWS_IN_BLOCKS) {
    *first = row + 1;
    *end = n;
    const int is_there = *left != 0;
    *left = 0;
    return is_there;
  }
  if (*left == 0) return 0;
  const int begin = __builtin_ctzll(*left);
  const blocks gap = ~(*left >> begin);
  const int count = gap != 0 ? __builtin_ctzll(gap) : 64;
  *left = begin + count < 64 ? *left & (all_blocks << (begin + count)) : 0;
  *first = begin * WIDTH > row ? begin * WIDTH : row + 1;
  *end = (begin + count) * WIDTH < n ? (begin + count) * WIDTH : n;
  return 1;
}

/* Whether all are zero, of either sign; without a jump for each. */
IN_LINE int are_zero(double x, double y, double z, double w) {
  uint64_t of_x, of_y, of_z, of_w;
  memcpy(&of_x, &x, sizeof of_x);
  memcpy(&of_y, &y, sizeof of_y);
  memcpy(&of_z, &z, sizeof of_z);
  memcpy(&of_w, &w, sizeof of_w);
  return (of_x | of_y | of_z | of_w) << 1 == 0;
}

/* b[i] /= divisor for the rows below `row`; which of their blocks are filled. */
IN_LINE blocks divide(double *b, double divisor, int row, int n) {
  const int is_masked = n <= MOST_ROWS_IN_BLOCKS;
  blocks filled = 0;
  int i = row + 1;
  for (; i < n && (i % WIDTH != 0 || i + WIDTH > n); ++i) {
    if (b[i] != 0.0 && is_masked) filled |= block_of(i);
    b[i] /= divisor;
  }
  for (; i + WIDTH <= n; i += WIDTH) {
    if (are_zero(b[i], b[i + 1], b[i + 2], b[i + 3])) continue;
    if (is_masked) filled |= block_of(i);
    *(numbers *)(b + i) /= divisor;
  }
  for (; i < n; ++i) {
    if (b[i] != 0.0 && is_masked) filled |= block_of(i);
    b[i] /= divisor;
  }
  return filled;
}

IN_LINE void exchange(double *column, int i, int j) {
  const double entry = column[i];
  column[i] = column[j];
  column[j] = entry;
}

/* Subtracts from a column what the finished columns before `k` leave of it, from column `first` on. */
IN_LINE void eliminate(int n, const double *a, int first, int k, const int *pivot, const blocks *filled, double *column) {
  for (int j = first; j < k; ++j) exchange(column, pivot[j], j);
  for (int j = first; j < k; ++j) {
    const double factor = column[j];
    if (factor == 0.0) continue;
    blocks left = n > MOST_ROWS_IN_BLOCKS ? all_blocks : filled[j];
    int begin, end;
    while (next_rows(&left, j, n, &begin, &end)) subtract_multiple(column, factor, a + (size_t)j * (size_t)n, begin, end);
  }
}

/* The same for TOGETHER columns, from the first finished one on. */
IN_LINE void eliminate_together(int n, const double *a, int k, const int *pivot, const blocks *filled, double *column) {
  const size_t rows = (size_t)n;
  double *const b = column, *const c = b + rows, *const d = c + rows, *const e = d + rows;
  for (int j = 0; j < k; ++j) {
    if (pivot[j] == j) continue;
    exchange(b, pivot[j], j);
    exchange(c, pivot[j], j);
    exchange(d, pivot[j], j);
    exchange(e, pivot[j], j);
  }
  for (int j = 0; j < k; ++j) {
    const double *const finished = a + (size_t)j * rows;
    const double of_b = b[j], of_c = c[j], of_d = d[j], of_e = e[j];
    if (are_zero(of_b, of_c, of_d, of_e)) continue;
    blocks left = n > MOST_ROWS_IN_BLOCKS ? all_blocks : filled[j];
    int begin, end;
    while (next_rows(&left, j, n, &begin, &end)) {
      int i = begin;
      for (; i < end && i + WIDTH <= n; i += WIDTH) { /* beyond a block's end the finished column is zero */
        const numbers of_finished = *(const numbers *)(finished + i);
        *(numbers *)(b + i) -= of_b * of_finished;
        *(numbers *)(c + i) -= of_c * of_finished;
        *(numbers *)(d + i) -= of_d * of_finished;
        *(numbers *)(e + i) -= of_e * of_finished;
      }
      for (; i < end; ++i) {
        b[i] -= of_b * finished[i];
        c[i] -= of_c * finished[i];
        d[i] -= of_d * finished[i];
        e[i] -= of_e * finished[i];
      }
    }
  }
}

/* Rows change places in finished columns. */
IN_LINE void exchange_rows(int n, double *a, blocks *filled, int finished, int i, int j) {
  const int is_masked = n <= MOST_ROWS_IN_BLOCKS;
  const blocks of_i = is_masked ? block_of(i) : 0, of_j = is_masked ? block_of(j) : 0;
  for (int c = 0; c < finished; ++c) {
    if (is_masked && (filled[c] & (of_i | of_j)) == 0) continue;
    double *const column = a + (size_t)c * (size_t)n;
    exchange(column, i, j);
    if (is_masked && column[i] != 0.0) filled[c] |= of_i;
    if (is_masked && column[j] != 0.0) filled[c] |= of_j;
  }
}

/* Left-looking (Golub and Van Loan, Matrix Computations, section 3.4): a column is untouched until its turn, so its own
 * size says what rounding leaves of a pivot that should be zero. Zeros above the diagonal save a column each. */
IN_LINE int factorize(int n, double *a, int *pivot, double least) {
  const size_t rows = (size_t)n;
  blocks filled[MOST_ROWS_IN_BLOCKS];
  for (int begin = 0; begin < n; begin += TOGETHER) {
    const int end = begin + TOGETHER < n ? begin + TOGETHER : n;
    double size[TOGETHER];
    for (int k = begin; k < end; ++k) size[k - begin] = largest(a + (size_t)k * rows, 0, n);
    if (end - begin == TOGETHER) {
      eliminate_together(n, a, begin, pivot, filled, a + (size_t)begin * rows);
    } else {
      for (int k = begin; k < end; ++k) eliminate(n, a, 0, begin, pivot, filled, a + (size_t)k * rows);
    }
    for (int k = begin; k < end; ++k) {
      double *const column = a + (size_t)k * rows;
      eliminate(n, a, begin, k, pivot, filled, column);
      int row = k;
      const double most = largest(column, k, n);
      if (most > fabs(column[k])) {
        while (fabs(column[row]) != most) ++row;
      }
      pivot[k] = row;
      if (!(fabs(column[row]) > least * size[k - begin]) || !isfinite(column[row])) return k + 1;
      if (row != k) {
        exchange(column, k, row);
        exchange_rows(n, a, filled, k, k, row);
      }
      const blocks below = divide(column, column[k], k, n);
      if (n <= MOST_ROWS_IN_BLOCKS) filled[k] = below;
    }
  }
  return 0;
}

/* So many equations have no use for registers of several numbers: the same, one by one. */
enum { FEW = 4 };

static int factorize_few(int n, double *a, int *pivot, double least) {
  for (int k = 0; k < n; ++k) {
    double *const column = a + k * n;
    double size = 0.0, most = 0.0;
    for (int i = 0; i < n; ++i) size = larger(size, fabs(column[i]));
    for (int j = 0; j < k; ++j) exchange(column, pivot[j], j);
    for (int j = 0; j < k; ++j) {
      const double *const finished = a + j * n;
      for (int i = j + 1; column[j] != 0.0 && i < n; ++i) column[i] -= column[j] * finished[i];
    }
    int row = k;
    for (int i = k; i < n; ++i) most = larger(most, fabs(column[i]));
    if (most > fabs(column[k])) {
      while (fabs(column[row]) != most) ++row;
    }
    pivot[k] = row;
    if (!(fabs(column[row]) > least * size) || !isfinite(column[row])) return k + 1;
    if (row != k) {
      for (int j = 0; j <= k; ++j) exchange(a + j * n, k, row);
    }
    for (int i = k + 1; i < n; ++i) column[i] /= column[k];
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
  if (n <= FEW) return factorize_few(n, a, pivot, least);
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

int fmurt_lu_factorize(int n, double *a, int *pivot, double least) {
  return n <= FEW ? factorize_few(n, a, pivot, least) : factorize(n, a, pivot, least);
}

void fmurt_lu_solve(int n, const double *a, const int *pivot, double *b) { solve(n, a, pivot, b); }

#endif
