/* fmurt_dense.c - see fmurt_dense.h.
 *
 * The matrix is divided into sparse rows s, whose block is diagonal, and the remaining ones r:
 *
 *   D x_s + K x_r = b_s,   A x_s + B x_r = b_r,   so   (B - A D^-1 K) x_r = b_r - A D^-1 b_s.
 *
 * For positions s with the rates of speeds, D is the identity, K is -gamma times few ones, and what remains is the
 * matrix of the equations of second order. */
#include "fmurt_dense.h"

#include <math.h>
#include <stdlib.h>

#include <nvector/nvector_serial.h>
#include <sunmatrix/sunmatrix_dense.h>

#include "fmurt_lu.h"

/* A sparse row has at most so many entries beside the diagonal one, its pivot, and none is larger than that:
 * multipliers of at most one, as in partial pivoting. */
enum { SPARSE_ENTRIES = 4 };

typedef struct sparse_row {
  int row; /* and column of its pivot */
  int count;
  int column[SPARSE_ENTRIES];   /* of the matrix, later its place among the remaining ones */
  double entry[SPARSE_ENTRIES]; /* over the pivot */
  double pivot;
} sparse_row;

typedef struct content {
  int size, sparse_count, rest_count;
  sparse_row *sparse;     /* [size] the first sparse_count are in use */
  int *rest;              /* [size] rows that remain, in order */
  int *place;             /* [size] of each row among the remaining ones; -1 for a sparse one */
  int *pivot;             /* [size] of the remaining matrix */
  double *below;          /* [rest_count * sparse_count] A, column-major */
  double *factors;        /* [rest_count * rest_count] */
  double *right;          /* [size] */
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

/* The entries of a row; 0 if it is not sparse. */
static int read_row(const double *matrix, int n, int i, sparse_row *row) {
  row->row = i;
  row->count = 0;
  row->pivot = matrix[i + (size_t)i * (size_t)n];
  if (!(fabs(row->pivot) > 0.0) || !isfinite(row->pivot)) return 0;
  for (int j = 0; j < n; ++j) {
    const double entry = matrix[i + (size_t)j * (size_t)n];
    if (entry == 0.0 || j == i) continue;
    if (row->count == SPARSE_ENTRIES || !(fabs(entry) <= fabs(row->pivot))) return 0;
    row->column[row->count] = j;
    row->entry[row->count++] = entry / row->pivot;
  }
  return 1;
}

/* Chooses sparse rows such that none has an entry in the pivot's column of another one. */
static void choose_sparse_rows(content *self, const double *matrix) {
  enum { OPEN = 0, NEEDED = -2, SPARSE = -1 };
  const int n = self->size;
  self->sparse_count = self->rest_count = 0;
  for (int i = 0; i < n; ++i) self->place[i] = OPEN;
  for (int i = 0; i < n; ++i) {
    sparse_row *row = &self->sparse[self->sparse_count];
    if (self->place[i] == NEEDED || !read_row(matrix, n, i, row)) continue;
    int is_apart = 1;
    for (int k = 0; k < row->count; ++k) is_apart = is_apart && self->place[row->column[k]] != SPARSE;
    if (!is_apart) continue;
    for (int k = 0; k < row->count; ++k) self->place[row->column[k]] = NEEDED;
    self->place[i] = SPARSE;
    ++self->sparse_count;
  }
  for (int i = 0; i < n; ++i) {
    if (self->place[i] == SPARSE) continue;
    self->place[i] = self->rest_count;
    self->rest[self->rest_count++] = i;
  }
  for (int k = 0; k < self->sparse_count; ++k) {
    sparse_row *row = &self->sparse[k];
    for (int e = 0; e < row->count; ++e) row->column[e] = self->place[row->column[e]];
  }
}

static int setup(SUNLinearSolver solver, SUNMatrix matrix) {
  content *self = content_of(solver);
  const double *all = SUNDenseMatrix_Data(matrix);
  choose_sparse_rows(self, all);
  const size_t n = (size_t)self->size, m = (size_t)self->rest_count;
  for (size_t j = 0; j < m; ++j) {
    const double *column = all + (size_t)self->rest[j] * n;
    for (size_t i = 0; i < m; ++i) self->factors[i + j * m] = column[self->rest[i]];
  }
  for (int k = 0; k < self->sparse_count; ++k) {
    const sparse_row *row = &self->sparse[k];
    const double *column = all + (size_t)row->row * n;
    double *below = self->below + (size_t)k * m;
    for (size_t i = 0; i < m; ++i) below[i] = column[self->rest[i]];
    for (int e = 0; e < row->count; ++e) {
      fmurt_lu_subtract(self->rest_count, self->factors + (size_t)row->column[e] * m, row->entry[e], below);
    }
  }
  self->last_flag = fmurt_lu_factorize(self->rest_count, self->factors, self->pivot, 0.0);
  return self->last_flag != 0; /* recoverable: another step gives another matrix */
}

static int solve(SUNLinearSolver solver, SUNMatrix matrix, N_Vector solution, N_Vector right, realtype tolerance) {
  content *self = content_of(solver);
  (void)matrix, (void)tolerance;
  double *x = NV_DATA_S(solution), *remaining = self->right;
  const double *b = NV_DATA_S(right);
  const int m = self->rest_count;
  for (int i = 0; i < m; ++i) remaining[i] = b[self->rest[i]];
  for (int k = 0; k < self->sparse_count; ++k) {
    const sparse_row *row = &self->sparse[k];
    const double value = b[row->row] / row->pivot;
    x[row->row] = value; /* b and x may be the same */
    const double *below = self->below + (size_t)k * (size_t)m;
    if (value == 0.0) continue;
    fmurt_lu_subtract(m, remaining, value, below);
  }
  fmurt_lu_solve(m, self->factors, self->pivot, remaining);
  for (int i = 0; i < m; ++i) x[self->rest[i]] = remaining[i];
  for (int k = 0; k < self->sparse_count; ++k) {
    const sparse_row *row = &self->sparse[k];
    for (int e = 0; e < row->count; ++e) x[row->row] -= row->entry[e] * remaining[row->column[e]];
  }
  return 0;
}

static sunindextype last_flag(SUNLinearSolver solver) { return content_of(solver)->last_flag; }

static int destroy(SUNLinearSolver solver) {
  content *self = content_of(solver);
  if (self != NULL) {
    free(self->sparse);
    free(self->rest);
    free(self->place);
    free(self->pivot);
    free(self->below);
    free(self->factors);
    free(self->right);
  }
  free(self);
  solver->content = NULL;
  SUNLinSolFreeEmpty(solver);
  return 0;
}

static content *create_content(int size) {
  content *self = calloc(1, sizeof *self);
  if (self == NULL) return NULL;
  const size_t n = (size_t)size;
  self->size = size;
  self->sparse = calloc(n, sizeof *self->sparse);
  self->rest = calloc(n, sizeof *self->rest);
  self->place = calloc(n, sizeof *self->place);
  self->pivot = calloc(n, sizeof *self->pivot);
  self->below = calloc(n * n, sizeof *self->below);
  self->factors = calloc(n * n, sizeof *self->factors);
  self->right = calloc(n, sizeof *self->right);
  return self;
}

SUNLinearSolver fmurt_dense_create(sunindextype size, SUNContext context) {
  SUNLinearSolver solver = SUNLinSolNewEmpty(context);
  if (solver == NULL) return NULL;
  solver->ops->gettype = type_of;
  solver->ops->initialize = initialize;
  solver->ops->setup = setup;
  solver->ops->solve = solve;
  solver->ops->lastflag = last_flag;
  solver->ops->free = destroy;
  content *self = create_content((int)size);
  solver->content = self;
  if (self == NULL || self->sparse == NULL || self->rest == NULL || self->place == NULL || self->pivot == NULL ||
      self->below == NULL || self->factors == NULL || self->right == NULL) {
    SUNLinSolFree(solver);
    return NULL;
  }
  return solver;
}
