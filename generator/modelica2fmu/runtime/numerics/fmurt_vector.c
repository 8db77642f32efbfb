/* fmurt_vector.c - see fmurt_vector.h. */
#include "fmurt_vector.h"

#include <math.h>
#include <string.h>

#include <nvector/nvector_serial.h>
#include <sunmatrix/sunmatrix_dense.h>

enum { WIDTH = 4 };
typedef double numbers __attribute__((vector_size(WIDTH * sizeof(double)), aligned(sizeof(double)), may_alias));

/* z = a x + b y; z may be x or y. */
static void linear_sum(realtype a, N_Vector x, realtype b, N_Vector y, N_Vector z) {
  const sunindextype n = NV_LENGTH_S(x);
  const double *px = NV_DATA_S(x), *py = NV_DATA_S(y);
  double *pz = NV_DATA_S(z);
  sunindextype i = 0;
  for (; i + WIDTH <= n; i += WIDTH) {
    *(numbers *)(pz + i) = a * *(const numbers *)(px + i) + b * *(const numbers *)(py + i);
  }
  for (; i < n; ++i) pz[i] = a * px[i] + b * py[i];
}

static void scale(realtype factor, N_Vector x, N_Vector z) {
  const sunindextype n = NV_LENGTH_S(x);
  const double *px = NV_DATA_S(x);
  double *pz = NV_DATA_S(z);
  for (sunindextype i = 0; i < n; ++i) pz[i] = factor * px[i];
}

static void set_all(realtype value, N_Vector z) {
  const sunindextype n = NV_LENGTH_S(z);
  double *pz = NV_DATA_S(z);
  for (sunindextype i = 0; i < n; ++i) pz[i] = value;
}

static realtype dot_product(N_Vector x, N_Vector y) {
  const sunindextype n = NV_LENGTH_S(x);
  const double *px = NV_DATA_S(x), *py = NV_DATA_S(y);
  double sum = 0.0;
  for (sunindextype i = 0; i < n; ++i) sum += px[i] * py[i];
  return sum;
}

static realtype weighted_norm(N_Vector x, N_Vector weight) {
  const sunindextype n = NV_LENGTH_S(x);
  const double *px = NV_DATA_S(x), *pw = NV_DATA_S(weight);
  double sum = 0.0;
  for (sunindextype i = 0; i < n; ++i) sum += px[i] * pw[i] * (px[i] * pw[i]);
  return sqrt(sum / (double)n);
}

void fmurt_speed_up_vector(N_Vector vector) {
  vector->ops->nvlinearsum = linear_sum;
  vector->ops->nvscale = scale;
  vector->ops->nvconst = set_all;
  vector->ops->nvdotprod = dot_product;
  vector->ops->nvwrmsnorm = weighted_norm;
}

static int copy(SUNMatrix from, SUNMatrix to) {
  const size_t count = (size_t)SUNDenseMatrix_LData(from);
  memcpy(SUNDenseMatrix_Data(to), SUNDenseMatrix_Data(from), count * sizeof(double));
  return 0;
}

static int zero(SUNMatrix matrix) {
  memset(SUNDenseMatrix_Data(matrix), 0, (size_t)SUNDenseMatrix_LData(matrix) * sizeof(double));
  return 0;
}

/* A = factor A + I */
static int scale_add_identity(realtype factor, SUNMatrix matrix) {
  const sunindextype n = SUNDenseMatrix_Rows(matrix), count = SUNDenseMatrix_LData(matrix);
  double *entry = SUNDenseMatrix_Data(matrix);
  sunindextype i = 0;
  for (; i + WIDTH <= count; i += WIDTH) *(numbers *)(entry + i) *= factor;
  for (; i < count; ++i) entry[i] *= factor;
  for (sunindextype k = 0; k < n; ++k) entry[k * n + k] += 1.0;
  return 0;
}

/* CVODE keeps the Jacobian in a clone, and copies it back by the clone's operations. */
static SUNMatrix clone(SUNMatrix like) {
  const SUNMatrix matrix = SUNDenseMatrix(SUNDenseMatrix_Rows(like), SUNDenseMatrix_Columns(like), like->sunctx);
  if (matrix != NULL) fmurt_speed_up_matrix(matrix);
  return matrix;
}

void fmurt_speed_up_matrix(SUNMatrix matrix) {
  matrix->ops->clone = clone;
  matrix->ops->copy = copy;
  matrix->ops->zero = zero;
  matrix->ops->scaleaddi = scale_add_identity;
}
