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

/* Some rows at a time, so that their sizes stay in a register while all columns are looked at. */
IN_LINE void scale_rows(int n, double *restrict a, double *restrict scale) {
  const masks without_sign = {LLONG_MAX, LLONG_MAX, LLONG_MAX, LLONG_MAX};
  const size_t rows = (size_t)n;
  int i = 0;
  for (; i + WIDTH <= n; i += WIDTH) {
    double *const first = a + i;
    numbers most = {0.0, 0.0, 0.0, 0.0};
    for (int j = 0; j < n; ++j) {
      const numbers size = (numbers)(*(const masks *)(first + (size_t)j * rows) & without_sign);
      const masks more = size > most;
      most = (numbers)(((masks)size & more) | ((masks)most & ~more));
    }
    for (int lane = 0; lane < WIDTH; ++lane) scale[i + lane] = power_against(most[lane]);
    const numbers by = *(const numbers *)(scale + i);
    for (int j = 0; j < n; ++j) *(numbers *)(first + (size_t)j * rows) *= by;
  }
  for (; i < n; ++i) {
    double most = 0.0;
    for (int j = 0; j < n; ++j) most = larger(most, fabs(a[i + (size_t)j * rows]));
    scale[i] = power_against(most);
    for (int j = 0; j < n; ++j) a[i + (size_t)j * rows] *= scale[i];
  }
}

/* Columns that are eliminated together, so that each waits less for its own last step. */
enum { TOGETHER = 4 };

/* Which blocks of WIDTH rows of a finished column hold anything below its diagonal, as bits: what stays apart while it is
 * eliminated, as the legs of a robot, is passed over. With more rows than bits all count as filled. */
typedef uint64_t blocks;
enum { MOST_ROWS_IN_BLOCKS = 64 * WIDTH };

IN_LINE blocks block_of(int row) { return (blocks)1 << (row / WIDTH); }

/* The blocks behind that of a row. */
IN_LINE blocks blocks_behind(int row) { return ~(blocks)1 << (row / WIDTH); }

/* The end of a row's block. */
IN_LINE int end_of_block(int row, int n) {
  const int end = (row / WIDTH + 1) * WIDTH;
  return end < n ? end : n;
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
  blocks filled = 0;
  for (int i = row + 1; i < n; ++i) {
    if (i % WIDTH == 0 && i + WIDTH <= n) {
      if (are_zero(b[i], b[i + 1], b[i + 2], b[i + 3])) {
        i += WIDTH - 1;
        continue;
      }
      *(numbers *)(b + i) /= divisor;
      filled |= block_of(i);
      i += WIDTH - 1;
    } else if (b[i] != 0.0) {
      b[i] /= divisor;
      filled |= block_of(i);
    }
  }
  return filled;
}

/* b[i] /= divisor for the rows below `row`, where rows are too many for blocks. */
IN_LINE void divide_many(double *b, double divisor, int row, int n) {
  for (int i = row + 1; i < n; ++i) b[i] /= divisor;
}

IN_LINE void exchange(double *column, int i, int j) {
  const double entry = column[i];
  column[i] = column[j];
  column[j] = entry;
}

/* Rows change places in a column as they did where a finished one was eliminated. */
IN_LINE void subtract_finished(int n, const double *finished, int j, int row, blocks filled, double *column) {
  if (row != j) exchange(column, row, j);
  const double factor = column[j];
  if (factor == 0.0) return;
  if (n > MOST_ROWS_IN_BLOCKS) {
    subtract_multiple(column, factor, finished, j + 1, n);
    return;
  }
  if (filled & block_of(j)) {
    for (int i = j + 1; i < end_of_block(j, n); ++i) column[i] -= factor * finished[i];
  }
  for (blocks left = filled & blocks_behind(j); left != 0; left &= left - 1) {
    const int i = __builtin_ctzll(left) * WIDTH;
    if (i + WIDTH <= n) {
      *(numbers *)(column + i) -= factor * *(const numbers *)(finished + i);
    } else {
      for (int k = i; k < n; ++k) column[k] -= factor * finished[k];
    }
  }
}

/* Subtracts from a column what the finished columns before `k` leave of it, from column `first` on. */
IN_LINE void eliminate(int n, const double *a, int first, int k, const int *pivot, const blocks *filled, double *column) {
  for (int j = first; j < k; ++j) {
    subtract_finished(n, a + (size_t)j * (size_t)n, j, pivot[j], n > MOST_ROWS_IN_BLOCKS ? 0 : filled[j], column);
  }
}

/* The same for TOGETHER columns, from the first finished one on; of no more rows than blocks hold. */
IN_LINE void eliminate_together(int n, const double *a, int k, const int *pivot, const blocks *filled, double *column) {
  const size_t rows = (size_t)n;
  double *const b = column, *const c = b + rows, *const d = c + rows, *const e = d + rows;
  for (int j = 0; j < k; ++j) {
    const double *const finished = a + (size_t)j * rows;
    const int row = pivot[j];
    if (row != j) {
      exchange(b, row, j);
      exchange(c, row, j);
      exchange(d, row, j);
      exchange(e, row, j);
    }
    const double of_b = b[j], of_c = c[j], of_d = d[j], of_e = e[j];
    if (are_zero(of_b, of_c, of_d, of_e)) continue;
    int i = j + 1, end = filled[j] & block_of(j) ? end_of_block(j, n) : i;
    blocks left = filled[j] & blocks_behind(j);
    for (;;) {
      for (; i < end; ++i) {
        b[i] -= of_b * finished[i];
        c[i] -= of_c * finished[i];
        d[i] -= of_d * finished[i];
        e[i] -= of_e * finished[i];
      }
      for (; left != 0; left &= left - 1) {
        i = __builtin_ctzll(left) * WIDTH;
        if (i + WIDTH > n) break;
        const numbers of_finished = *(const numbers *)(finished + i);
        *(numbers *)(b + i) -= of_b * of_finished;
        *(numbers *)(c + i) -= of_c * of_finished;
        *(numbers *)(d + i) -= of_d * of_finished;
        *(numbers *)(e + i) -= of_e * of_finished;
      }
      if (left == 0) break;
      left = 0; /* the last block is not whole */
      end = n;
    }
  }
}

/* Left-looking (Golub and Van Loan, Matrix Computations, section 3.4): a column is untouched until its turn, so its own
 * size says what rounding leaves of a pivot that should be zero. Zeros above the diagonal save a column each. Rows of finished
 * columns stay where they are when later ones change places (as LINPACK has it): each column repeats the changes in turn. */
IN_LINE int factorize(int n, double *a, int *pivot, double least) {
  const size_t rows = (size_t)n;
  const int is_large = n > MOST_ROWS_IN_BLOCKS;
  blocks filled[MOST_ROWS_IN_BLOCKS];
  for (int begin = 0; begin < n; begin += TOGETHER) {
    const int end = begin + TOGETHER < n ? begin + TOGETHER : n;
    double size[TOGETHER];
    for (int k = begin; k < end; ++k) size[k - begin] = largest(a + (size_t)k * rows, 0, n);
    if (end - begin == TOGETHER && !is_large) {
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
      if (row != k) exchange(column, k, row);
      if (is_large) {
        divide_many(column, column[k], k, n);
      } else {
        filled[k] = divide(column, column[k], k, n);
      }
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
    for (int j = 0; j < k; ++j) {
      const double *const finished = a + j * n;
      exchange(column, pivot[j], j);
      for (int i = j + 1; column[j] != 0.0 && i < n; ++i) column[i] -= column[j] * finished[i];
    }
    int row = k;
    for (int i = k; i < n; ++i) most = larger(most, fabs(column[i]));
    if (most > fabs(column[k])) {
      while (fabs(column[row]) != most) ++row;
    }
    pivot[k] = row;
    if (!(fabs(column[row]) > least * size) || !isfinite(column[row])) return k + 1;
    if (row != k) exchange(column, k, row);
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
    if (entry != 0.0) subtract_multiple(b, entry, a + (size_t)k * rows, k + 1, n);
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

__attribute__((target("avx2,no-fma"))) static void subtract_wide(int n, double *b, double factor, const double *c) {
  subtract_multiple(b, factor, c, 0, n);
}

void fmurt_lu_subtract(int n, double *b, double factor, const double *c) {
  if (__builtin_cpu_supports("avx2")) {
    subtract_wide(n, b, factor, c);
  } else {
    subtract_multiple(b, factor, c, 0, n);
  }
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

void fmurt_lu_subtract(int n, double *b, double factor, const double *c) { subtract_multiple(b, factor, c, 0, n); }

void fmurt_lu_scale_rows(int n, double *a, double *scale) { scale_rows(n, a, scale); }

int fmurt_lu_factorize(int n, double *a, int *pivot, double least) {
  return n <= FEW ? factorize_few(n, a, pivot, least) : factorize(n, a, pivot, least);
}

void fmurt_lu_solve(int n, const double *a, const int *pivot, double *b) { solve(n, a, pivot, b); }

#endif
