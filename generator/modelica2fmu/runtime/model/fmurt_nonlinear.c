/* fmurt_nonlinear.c - damped Newton for small nonlinear blocks of generated code.
 *
 * Deuflhard, Newton Methods for Nonlinear Problems (2011), chapter 3, in its simplest form: a step is halved
 * until the residual, scaled by the rows of the Jacobian, falls. */
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "fmurt_dead_center.h"
#include "fmurt_model.h"

enum { MAXIMUM_ITERATIONS = 100, MAXIMUM_HALVINGS = 30 };

typedef struct newton {
  fmurt_values *values;
  const void *context;
  fmurt_residual residual;
  int n;
  double *x;
  const double *nominal;
  double *jacobian;     /* [n * n], column-major */
  double *r;            /* [n] residual at x */
  double *r_trial;      /* [n] */
  double *x_trial;      /* [n] */
  double *step;         /* [n] */
  double *row_scale;    /* [n] size of each row of the Jacobian times the nominal values */
  double *x_scale;      /* [n] */
  double *linear_scale; /* [n] of the factorized Jacobian's rows */
} newton;

static int all_finite(int n, const double *vector) {
  for (int i = 0; i < n; ++i) {
    if (!isfinite(vector[i])) return 0;
  }
  return 1;
}

static int evaluate(const newton *solver, const double *x, double *r) {
  const int result = solver->residual(solver->values, solver->context, x, r);
  if (result != FMURT_RESULT_OK) return result;
  return all_finite(solver->n, r) ? FMURT_RESULT_OK : FMURT_RESULT_DISCARD;
}

static double scaled_norm(const newton *solver, const double *r) {
  double norm = 0.0;
  for (int i = 0; i < solver->n; ++i) norm = fmax(norm, fabs(r[i]) / solver->row_scale[i]);
  return norm;
}

static double scaled_size(const newton *solver, const double *change) {
  double size = 0.0;
  for (int i = 0; i < solver->n; ++i) size = fmax(size, fabs(change[i]) / solver->x_scale[i]);
  return size;
}

/* Forward differences, backward where the model cannot be evaluated forward. */
static int compute_jacobian(newton *solver) {
  const int n = solver->n;
  for (int j = 0; j < n; ++j) solver->row_scale[j] = 0.0;
  for (int j = 0; j < n; ++j) {
    const double x = solver->x[j];
    double delta = sqrt(DBL_EPSILON) * solver->x_scale[j];
    memcpy(solver->x_trial, solver->x, (size_t)n * sizeof(double));
    int result = FMURT_RESULT_DISCARD;
    for (int side = 0; side < 2 && result == FMURT_RESULT_DISCARD; ++side) {
      if (side == 1) delta = -delta;
      volatile double shifted = x + delta; /* the difference that is really made, not the one asked for */
      solver->x_trial[j] = shifted;
      result = evaluate(solver, solver->x_trial, solver->r_trial);
    }
    if (result != FMURT_RESULT_OK) return result;
    delta = solver->x_trial[j] - x;
    for (int i = 0; i < n; ++i) {
      const double entry = (solver->r_trial[i] - solver->r[i]) / delta;
      solver->jacobian[i + (size_t)j * (size_t)n] = entry;
      solver->row_scale[i] = fmax(solver->row_scale[i], fabs(entry) * solver->x_scale[j]);
    }
  }
  for (int i = 0; i < n; ++i) {
    if (!(solver->row_scale[i] > 0.0)) solver->row_scale[i] = 1.0;
  }
  return FMURT_RESULT_OK;
}

static void update_scale(newton *solver) {
  for (int i = 0; i < solver->n; ++i) {
    const double nominal = solver->nominal != NULL && solver->nominal[i] > 0.0 ? solver->nominal[i] : 1.0;
    solver->x_scale[i] = fmax(fabs(solver->x[i]), nominal);
  }
}

static int fail(fmurt_values *values, int iteration, double norm) {
  char message[200];
  snprintf(message, sizeof message,
           "A nonlinear system does not converge at time %.15g (%d iterations, scaled residual %.3g)", values->time,
           iteration, norm);
  fmurt_report_error(values, message);
  return FMURT_RESULT_DISCARD;
}

static newton solver_of(fmurt_values *values, const void *context, fmurt_residual residual, int n, double *x,
                        const double *nominal, double *work) {
  const size_t size = (size_t)n;
  double *vectors = work + size * size;
  return (newton){.values = values,
                  .context = context,
                  .residual = residual,
                  .n = n,
                  .x = x,
                  .nominal = nominal,
                  .jacobian = work,
                  .r = vectors,
                  .r_trial = vectors + size,
                  .x_trial = vectors + 2 * size,
                  .step = vectors + 3 * size,
                  .row_scale = vectors + 4 * size,
                  .x_scale = vectors + 5 * size,
                  .linear_scale = vectors + 6 * size};
}

int fmurt_solve_nonlinear(fmurt_values *values, const void *context, fmurt_residual residual, int n, double *x,
                          const double *nominal, double tolerance, double *work, int *integer_work) {
  const size_t size = (size_t)n;
  newton solver = solver_of(values, context, residual, n, x, nominal, work);
  int result = evaluate(&solver, x, solver.r);
  if (result != FMURT_RESULT_OK) return result;

  double norm = HUGE_VAL;
  for (int iteration = 0; iteration < MAXIMUM_ITERATIONS; ++iteration) {
    update_scale(&solver);
    result = compute_jacobian(&solver);
    if (result != FMURT_RESULT_OK) return result;
    norm = scaled_norm(&solver, solver.r);
    memcpy(solver.step, solver.r, size * sizeof(double));
    const int singular = fmurt_factorize(n, solver.jacobian, solver.linear_scale, integer_work);
    if (singular != 0) {
      if (norm <= tolerance) return FMURT_RESULT_OK; /* solved already; the missing direction does not matter */
      char message[200];
      snprintf(message, sizeof message, "The Jacobian of a nonlinear system is singular in unknown %d at time %.15g",
               singular, values->time);
      fmurt_report_error(values, message);
      return FMURT_RESULT_DISCARD;
    }
    fmurt_substitute(n, solver.jacobian, solver.linear_scale, integer_work, solver.step);

    const double step_size = scaled_size(&solver, solver.step);
    double damping = 1.0;
    int accepted = 0;
    for (int halving = 0; halving < MAXIMUM_HALVINGS && !accepted; ++halving, damping *= 0.5) {
      for (int i = 0; i < n; ++i) solver.x_trial[i] = x[i] - damping * solver.step[i];
      result = evaluate(&solver, solver.x_trial, solver.r_trial);
      if (result == FMURT_RESULT_ERROR) return result;
      if (result == FMURT_RESULT_DISCARD) continue;
      const double trial_norm = scaled_norm(&solver, solver.r_trial);
      accepted = trial_norm <= (1.0 - 0.25 * damping) * norm || trial_norm <= DBL_EPSILON || step_size <= tolerance;
    }
    if (!accepted) {
      if (norm <= tolerance) return evaluate(&solver, x, solver.r);
      return fail(values, iteration, norm);
    }
    memcpy(x, solver.x_trial, size * sizeof(double));
    memcpy(solver.r, solver.r_trial, size * sizeof(double));
    if (step_size <= tolerance) return FMURT_RESULT_OK;
  }
  return fail(values, MAXIMUM_ITERATIONS, norm);
}

/* -- following -- */

enum { MAXIMUM_JACOBIANS = 20 };

/* A correction by the Jacobian of the one before may be so large beside it; from the next on, a new Jacobian is worth
 * its evaluations. All of them together may be so large beside the first. */
static const double largest_ratio = 0.25, largest_ratio_without_jacobian = 0.03, longest_way = 1.4;
/* Of a correction that is larger than this share of the unknowns' size, points on the way are tried too: angles that go
 * round come back to the same equations, which says nothing of what lies between. */
static const double large_step = 0.1, largest_error_on_way = 0.06;
static const double points_on_way[] = {0.5, 0.21, 0.77};
/* Where following fails since the equations have a kink, so small a change is no leap. */
static const double small_change = 0.1;

static double determinant(int n, const double *factors, const double *scale, const int *pivot) {
  double product = 1.0;
  for (int k = 0; k < n; ++k) {
    const double entry = factors[k + (size_t)k * (size_t)n] / scale[k];
    product *= pivot[k] != k ? -entry : entry;
  }
  return product;
}

/* 1 if the equations change as the Jacobian says, nearly, on the way of the step. */
static int is_straight(newton *solver, double step_size, const int *pivot) {
  const int n = solver->n;
  for (size_t k = 0; k < sizeof points_on_way / sizeof points_on_way[0]; ++k) {
    const double share = points_on_way[k];
    for (int i = 0; i < n; ++i) solver->x_trial[i] = solver->x[i] - share * solver->step[i];
    if (evaluate(solver, solver->x_trial, solver->r_trial) != FMURT_RESULT_OK) return 0;
    fmurt_substitute(n, solver->jacobian, solver->linear_scale, pivot, solver->r_trial);
    for (int i = 0; i < n; ++i) solver->r_trial[i] -= (1.0 - share) * solver->step[i];
    if (scaled_size(solver, solver->r_trial) > largest_error_on_way * step_size) return 0;
  }
  return 1;
}

/* x: accepted solution in, present one out. *at_start: the first Jacobian's determinant, 0 if it is singular. */
static int follow(newton *solver, double tolerance, int *pivot, double *at_start) {
  const int n = solver->n;
  const size_t size = (size_t)n;
  double way_left = HUGE_VAL;
  *at_start = 0.0;
  int result = evaluate(solver, solver->x, solver->r);
  for (int count = 0; count < MAXIMUM_JACOBIANS && result == FMURT_RESULT_OK; ++count) {
    update_scale(solver);
    result = compute_jacobian(solver);
    if (result != FMURT_RESULT_OK) return result;
    const double norm = scaled_norm(solver, solver->r);
    if (fmurt_factorize(n, solver->jacobian, solver->linear_scale, pivot) != 0) {
      return norm <= tolerance ? FMURT_RESULT_OK : FMURT_RESULT_DISCARD;
    }
    if (count == 0) *at_start = determinant(n, solver->jacobian, solver->linear_scale, pivot);
    memcpy(solver->step, solver->r, size * sizeof(double));
    fmurt_substitute(n, solver->jacobian, solver->linear_scale, pivot, solver->step);
    double step_size = scaled_size(solver, solver->step);
    if (step_size > large_step && !is_straight(solver, step_size, pivot)) return FMURT_RESULT_DISCARD;
    if (count == 0) way_left = longest_way * step_size;

    for (double ratio = 0.0; ratio <= largest_ratio_without_jacobian;) {
      for (int i = 0; i < n; ++i) solver->x[i] -= solver->step[i];
      if (step_size <= tolerance) return FMURT_RESULT_OK;
      way_left -= step_size;
      result = evaluate(solver, solver->x, solver->r);
      if (result != FMURT_RESULT_OK) return result;
      memcpy(solver->step, solver->r, size * sizeof(double));
      fmurt_substitute(n, solver->jacobian, solver->linear_scale, pivot, solver->step);
      const double next_size = scaled_size(solver, solver->step);
      ratio = next_size / step_size;
      if (ratio > largest_ratio || next_size > way_left) {
        return scaled_norm(solver, solver->r) <= tolerance ? FMURT_RESULT_OK : FMURT_RESULT_DISCARD;
      }
      step_size = next_size;
    }
  }
  return result == FMURT_RESULT_OK ? FMURT_RESULT_DISCARD : result;
}

/* 1 if x, which is a solution, is on the same side of where solutions meet as one with that determinant. */
static int is_on_same_side(newton *solver, double at_start, int *pivot) {
  if (evaluate(solver, solver->x, solver->r) != FMURT_RESULT_OK || compute_jacobian(solver) != FMURT_RESULT_OK ||
      fmurt_factorize(solver->n, solver->jacobian, solver->linear_scale, pivot) != 0) {
    return 0;
  }
  return (determinant(solver->n, solver->jacobian, solver->linear_scale, pivot) > 0.0) == (at_start > 0.0);
}

/* 1 if x, which was solved for, is beside the accepted solution and on the same side of where solutions meet. */
static int is_near(newton *solver, const double *accepted, double at_start, int *pivot) {
  double change = 0.0;
  update_scale(solver);
  for (int i = 0; i < solver->n; ++i) {
    change = fmax(change, fabs(solver->x[i] - accepted[i]) / solver->x_scale[i]);
  }
  return at_start != 0.0 && change <= small_change && is_on_same_side(solver, at_start, pivot);
}

static int follow_from(const double *start, newton *solver, double tolerance, double *work, int *integer_work,
                       double *at_start) {
  memcpy(solver->x, start, (size_t)solver->n * sizeof(double));
  int result = follow(solver, tolerance, integer_work, at_start);
  if (result != FMURT_RESULT_DISCARD) return result;
  memcpy(solver->x, start, (size_t)solver->n * sizeof(double));
  result = fmurt_solve_nonlinear(solver->values, solver->context, solver->residual, solver->n, solver->x,
                                 solver->nominal, tolerance, work, integer_work);
  if (result != FMURT_RESULT_OK || solver->values->following == FMURT_FOLLOW_OR_SOLVE) return result;
  return is_near(solver, start, *at_start, integer_work) ? FMURT_RESULT_OK : FMURT_RESULT_DISCARD;
}

/* 1 if the solution x, found from the accepted one, turned back at a dead centre. */
static int comes_back(newton *solver, int offset, double at_start, int *pivot) {
  fmurt_values *values = solver->values;
  if (values->following != FMURT_FOLLOW) return 0;
  update_scale(solver);
  const fmurt_course course = fmurt_history_course(values, offset, solver->n, solver->x, solver->x_scale);
  if (course == FMURT_GOES_ON) return 0;
  if (course == FMURT_MAY_TURN_BACK && !is_on_same_side(solver, at_start, pivot)) return 0;
  fmurt_history_note(values, offset, solver->n, solver->x_scale);
  return 1;
}

int fmurt_follow_nonlinear(fmurt_values *values, int offset, const void *context, fmurt_residual residual, int n,
                           double *x, const double *nominal, double tolerance, double *work, int *integer_work) {
  if (values->following == FMURT_SOLVE) {
    return fmurt_solve_nonlinear(values, context, residual, n, x, nominal, tolerance, work, integer_work);
  }
  newton solver = solver_of(values, context, residual, n, x, nominal, work);
  double at_start = 0.0;
  int result = follow_from(values->accepted + offset, &solver, tolerance, work, integer_work, &at_start);
  fmurt_history_learn(values, offset, at_start);
  for (int k = 0; k < values->solved_count && result == FMURT_RESULT_DISCARD; ++k) {
    double at_solved = 0.0;
    result = follow_from(values->solved[k] + offset, &solver, tolerance, work, integer_work, &at_solved);
  }
  if (result == FMURT_RESULT_OK && comes_back(&solver, offset, at_start, integer_work)) result = FMURT_RESULT_DISCARD;
  if (result != FMURT_RESULT_DISCARD || !values->may_stray || values->following != FMURT_FOLLOW) return result;
  values->strayed = 1;
  memcpy(x, values->accepted + offset, (size_t)n * sizeof(double));
  return fmurt_solve_nonlinear(values, context, residual, n, x, nominal, tolerance, work, integer_work);
}

/* -- messages -- */

/* Equations that are off by no more than this are solved. */
static const double singular_residual = 1e-6;

int fmurt_report_unsolved(fmurt_values *values, fmurt_residual residual, int n, const double *x, double *r,
                          const char *const *unknown, const char *const *equation, int result) {
  if (residual(values, NULL, x, r) != FMURT_RESULT_OK || !all_finite(n, r))
    return result; /* that is the better cause */
  int worst = 0;
  for (int i = 1; i < n; ++i) {
    if (fabs(r[i]) > fabs(r[worst])) worst = i;
  }
  char names[400] = "";
  size_t length = 0;
  for (int i = 0; i < n && length < sizeof names - 40; ++i) {
    length +=
        (size_t)snprintf(names + length, sizeof names - length, "%s%s = %.6g", i > 0 ? ", " : "", unknown[i], x[i]);
  }
  const char *more = length >= sizeof names - 40 ? ", ..." : "";
  char message[900];
  if (fabs(r[worst]) <= singular_residual) {
    snprintf(message, sizeof message,
             "A nonlinear system of %d equations is singular at time %.9g, or its solution cannot be followed there in one "
             "step: the equation %s holds, but the unknowns would leap, as at a dead centre of a mechanism or where a loop "
             "would close in another way than before. Take shorter steps, or choose other states, such as other joints of "
             "the loop. Unknowns: %s%s",
             n, values->time, equation[worst], names, more);
  } else if (values->following == FMURT_FOLLOW) {
    snprintf(message, sizeof message,
             "The solution of a nonlinear system of %d equations cannot be followed from the last step to time %.9g: the "
             "equation %s is off by %.3g. Shorter steps or other states may help. Unknowns: %s%s",
             n, values->time, equation[worst], r[worst], names, more);
  } else {
    snprintf(message, sizeof message,
             "A nonlinear system of %d equations has no solution near its start at time %.9g: the equation %s is off by "
             "%.3g. Better start values or other states may help. Unknowns: %s%s",
             n, values->time, equation[worst], r[worst], names, more);
  }
  fmurt_report_error(values, message);
  return result;
}
