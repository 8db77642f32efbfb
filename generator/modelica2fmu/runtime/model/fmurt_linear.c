/* fmurt_linear.c - dense linear systems for generated code. */
#include <float.h>
#include <string.h>

#include "fmurt_lu.h"
#include "fmurt_model.h"

int fmurt_factorize(int n, double *a, double *scale, int *pivot) {
  fmurt_lu_scale_rows(n, a, scale);
  return fmurt_lu_factorize(n, a, pivot, n * DBL_EPSILON);
}

void fmurt_substitute(int n, const double *a, const double *scale, const int *pivot, double *b) {
  for (int k = 0; k < n; ++k) b[k] *= scale[k];
  fmurt_lu_solve(n, a, pivot, b);
}

/* b += factor * c on all lanes. */
static void add_lanes(double *restrict b, double factor, const double *restrict c) {
  for (int lane = 0; lane < FMURT_LANES; ++lane) b[lane] += factor * c[lane];
}

void fmurt_substitute_lanes(int n, const double *a, const double *scale, const int *pivot, double *b) {
  const size_t rows = (size_t)n;
  for (int k = 0; k < n; ++k) {
    for (int lane = 0; lane < FMURT_LANES; ++lane) b[k * FMURT_LANES + lane] *= scale[k];
  }
  for (int k = 0; k < n; ++k) {
    const double *column = a + (size_t)k * rows;
    for (int lane = 0; pivot[k] != k && lane < FMURT_LANES; ++lane) {
      const double entry = b[pivot[k] * FMURT_LANES + lane];
      b[pivot[k] * FMURT_LANES + lane] = b[k * FMURT_LANES + lane];
      b[k * FMURT_LANES + lane] = entry;
    }
    for (int i = k + 1; i < n; ++i) {
      if (column[i] != 0.0) add_lanes(b + i * FMURT_LANES, -column[i], b + k * FMURT_LANES);
    }
  }
  for (int k = n - 1; k >= 0; --k) {
    const double *column = a + (size_t)k * rows;
    for (int lane = 0; lane < FMURT_LANES; ++lane) b[k * FMURT_LANES + lane] /= column[k];
    for (int i = 0; i < k; ++i) {
      if (column[i] != 0.0) add_lanes(b + i * FMURT_LANES, -column[i], b + k * FMURT_LANES);
    }
  }
}

/* Fills the matrix, FMURT_LANES columns at a time. */
static int evaluate_matrix(fmurt_values *values, const fmurt_linear_system *system) {
  const int n = system->size;
  double *const work = values->work, *const seed = work + system->seeds;
  const double *const derivative = work + system->columns;
  int result = system->evaluate_numbers(values);
  memset(seed, 0, (size_t)n * FMURT_LANES * sizeof(double));
  for (int first = 0; first < n && result == FMURT_RESULT_OK; first += FMURT_LANES) {
    const int lanes = n - first < FMURT_LANES ? n - first : FMURT_LANES;
    for (int lane = 0; lane < lanes; ++lane) seed[(first + lane) * FMURT_LANES + lane] = 1.0;
    result = system->evaluate_columns(values);
    for (int lane = 0; lane < lanes; ++lane) {
      double *const column = work + system->matrix + (size_t)(first + lane) * (size_t)n;
      for (int i = 0; i < n; ++i) column[i] = derivative[i * FMURT_LANES + lane];
      seed[(first + lane) * FMURT_LANES + lane] = 0.0;
    }
  }
  return result;
}

fmurt_result fmurt_solve_linear(fmurt_values *values, const fmurt_linear_system *system) {
  const int n = system->size;
  double *const matrix = values->work + system->matrix, *const scale = values->work + system->scale;
  double *const solution = values->work + system->solution;
  int *const pivot = values->integer_work + system->pivot;
  memset(solution, 0, (size_t)n * sizeof(double));
  int result = system->evaluate_inner(values);
  if (result == FMURT_RESULT_OK) result = system->evaluate_residuals(values);
  if (result == FMURT_RESULT_OK) result = evaluate_matrix(values, system);
  if (result != FMURT_RESULT_OK) return (fmurt_result)result;
  if (fmurt_factorize(n, matrix, scale, pivot) != 0) {
    fmurt_report_error(values, system->singular);
    return FMURT_RESULT_DISCARD;
  }
  fmurt_substitute(n, matrix, scale, pivot, solution);
  return (fmurt_result)system->evaluate_inner(values);
}
