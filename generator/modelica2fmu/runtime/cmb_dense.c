/* cmb_dense.c - see cmb_dense.h. */
#include "cmb_dense.h"

#include <math.h>
#include <stdlib.h>

#include <nvector/nvector_serial.h>
#include <sunmatrix/sunmatrix_dense.h>

typedef struct content {
  sunindextype size;
  sunindextype *pivot;   /* [size] row that was exchanged with row k */
  sunindextype last_flag; /* 0, or 1 + the column without a pivot */
} content;

static content *content_of(SUNLinearSolver solver) { return solver->content; }

static SUNLinearSolver_Type type_of(SUNLinearSolver solver) {
  (void)solver;
  return SUNLINEARSOLVER_DIRECT;
}

static int initialize(SUNLinearSolver solver) {
  content_of(solver)->last_flag = 0;
  return 0;
}

/* Right-looking LU with partial pivoting by columns (Golub and Van Loan, Matrix Computations, algorithm 3.4.1);
 * entries that are zero in the pivot's row save their column, which exploits what sparsity there is. */
static int setup(SUNLinearSolver solver, SUNMatrix matrix) {
  content *self = content_of(solver);
  const sunindextype n = self->size;
  double *a = SUNDenseMatrix_Data(matrix);
  for (sunindextype k = 0; k < n; ++k) {
    double *restrict pivot_column = a + k * n;
    sunindextype row = k;
    for (sunindextype i = k + 1; i < n; ++i) {
      if (fabs(pivot_column[i]) > fabs(pivot_column[row])) row = i;
    }
    self->pivot[k] = row;
    if (pivot_column[row] == 0.0) {
      self->last_flag = k + 1;
      return 1; /* recoverable: another step gives another matrix */
    }
    if (row != k) {
      for (sunindextype j = 0; j < n; ++j) {
        const double entry = a[j * n + k];
        a[j * n + k] = a[j * n + row];
        a[j * n + row] = entry;
      }
    }
    const double inverse = 1.0 / pivot_column[k];
    for (sunindextype i = k + 1; i < n; ++i) pivot_column[i] *= inverse;
    for (sunindextype j = k + 1; j < n; ++j) {
      double *restrict column = a + j * n;
      const double entry = column[k];
      if (entry == 0.0) continue;
      for (sunindextype i = k + 1; i < n; ++i) column[i] -= pivot_column[i] * entry;
    }
  }
  self->last_flag = 0;
  return 0;
}

static int solve(SUNLinearSolver solver, SUNMatrix matrix, N_Vector solution, N_Vector right, realtype tolerance) {
  const content *self = content_of(solver);
  const sunindextype n = self->size;
  const double *a = SUNDenseMatrix_Data(matrix);
  double *restrict x = NV_DATA_S(solution);
  const double *b = NV_DATA_S(right);
  (void)tolerance;
  for (sunindextype i = 0; i < n; ++i) x[i] = b[i];
  for (sunindextype k = 0; k < n; ++k) {
    const sunindextype row = self->pivot[k];
    const double entry = x[row];
    x[row] = x[k];
    x[k] = entry;
  }
  for (sunindextype k = 0; k < n; ++k) {
    const double *restrict column = a + k * n;
    const double entry = x[k];
    for (sunindextype i = k + 1; i < n; ++i) x[i] -= column[i] * entry;
  }
  for (sunindextype k = n; k-- > 0;) {
    const double *restrict column = a + k * n;
    const double entry = x[k] /= column[k];
    for (sunindextype i = 0; i < k; ++i) x[i] -= column[i] * entry;
  }
  return 0;
}

static sunindextype last_flag(SUNLinearSolver solver) { return content_of(solver)->last_flag; }

static int destroy(SUNLinearSolver solver) {
  content *self = content_of(solver);
  if (self != NULL) free(self->pivot);
  free(self);
  solver->content = NULL;
  SUNLinSolFreeEmpty(solver);
  return 0;
}

SUNLinearSolver cmb_dense_create(sunindextype size, SUNContext context) {
  SUNLinearSolver solver = SUNLinSolNewEmpty(context);
  if (solver == NULL) return NULL;
  solver->ops->gettype = type_of;
  solver->ops->initialize = initialize;
  solver->ops->setup = setup;
  solver->ops->solve = solve;
  solver->ops->lastflag = last_flag;
  solver->ops->free = destroy;
  content *self = calloc(1, sizeof *self);
  solver->content = self;
  if (self != NULL) {
    self->size = size;
    self->pivot = calloc((size_t)size, sizeof *self->pivot);
  }
  if (self == NULL || self->pivot == NULL) {
    SUNLinSolFree(solver);
    return NULL;
  }
  return solver;
}
