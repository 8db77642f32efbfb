/* fmurt_newton.c - see fmurt_newton.h.
 *
 * A step's equation is G(c) = 0 for the correction c of the predicted states, and one iteration adds -M^-1 G(c), where M
 * was made some steps ago. CVODE's own test looks at that correction alone. Where a contact has opened since, M still
 * holds its stiffness: the correction is then tiny though G is not, the step is accepted, and what the contact did last
 * goes on in free flight, seen by no error test. So a correction is believed only
 *
 *   where the residual that it comes from is small itself: if M were wrong, the error would be no larger than that; or
 *   where it makes the residual smaller, as it must if M is right.
 *
 * The second takes an evaluation, which another iteration uses.
 *
 * Where the iteration fails with a new Jacobian, either the equation is too curved, which a shorter step cures, or the
 * Jacobian is wrong: contact points that swap their places in a list, beside a flat rest, spoil derivatives that are put
 * together from them. The derivative of G along the first correction tells which, by one evaluation. */
#include "fmurt_newton.h"

#include <math.h>
#include <stdlib.h>

/* Residuals up to so many times the tolerance of the correction are small, whatever the matrix is; a hundredth of what the
 * error test permits. Those that the matrix has just lessened may be larger: the next correction would do so again. */
static const double small_residual = 0.1, small_remainder = 1.0;
/* A correction by the right matrix leaves at most this share of the residual. */
static const double largest_remainder = 0.5;
/* CVODE's own: how fast the rate of convergence may fall from one iteration to the next, and what counts as divergence. */
static const double slowest_fall_of_rate = 0.3, divergence = 2.0;
/* The share of the first correction over which the residual is differentiated, and the largest error of a Jacobian. */
static const double probe_share = 1e-3, largest_jacobian_error = 0.1;
/* What an extrapolated correction may leave of the residual, so that no linear system is solved, and up to how many times
 * the tolerance the last one may err: CVODE's choice of order and step is upset by more. */
static const double largest_contraction = 0.9, small_extrapolation_error = 0.3;
/* How many of them a step takes; after how many steps they are tried again where they left more, which costs an evaluation
 * or two; and the number of states from which on solving with a matrix costs more than that. */
enum { MOST_EXTRAPOLATIONS = 5, WAIT_WITHOUT_MATRIX = 3, WAIT_WITH_MATRIX = 20, STATES_OF_A_LARGE_MATRIX = 100 };
/* So many Jacobians in a row are computed by difference quotients once the model's own was wrong. */
enum { QUOTIENTS_IN_A_ROW = 3 };

typedef struct content {
  SUNNonlinSolSysFn residual;
  SUNNonlinSolLSetupFn setup; /* NULL if the linear solver needs none */
  SUNNonlinSolLSolveFn solve;
  N_Vector step;                         /* a residual, then the correction that it gives */
  N_Vector first_residual, first_step;   /* of the last attempt with a new Jacobian */
  int most_iterations;
  int *quotients;
  double rate; /* of convergence, with the present matrix */
  int steps_to_solve; /* before extrapolated corrections are tried again */
  int has_matrix;     /* since the start: behind extrapolated corrections CVODE would take that of the time before it */
  long iterations, failures;
} content;

static content *content_of(SUNNonlinearSolver solver) { return solver->content; }

static SUNNonlinearSolver_Type type_of(SUNNonlinearSolver solver) {
  (void)solver;
  return SUNNONLINEARSOLVER_ROOTFIND;
}

static int initialize(SUNNonlinearSolver solver) {
  content_of(solver)->steps_to_solve = 0;
  content_of(solver)->has_matrix = 0;
  return SUN_NLS_SUCCESS;
}

static int set_residual(SUNNonlinearSolver solver, SUNNonlinSolSysFn function) {
  content_of(solver)->residual = function;
  return SUN_NLS_SUCCESS;
}

static int set_setup(SUNNonlinearSolver solver, SUNNonlinSolLSetupFn function) {
  content_of(solver)->setup = function;
  return SUN_NLS_SUCCESS;
}

static int set_solve(SUNNonlinearSolver solver, SUNNonlinSolLSolveFn function) {
  content_of(solver)->solve = function;
  return SUN_NLS_SUCCESS;
}

static int set_most_iterations(SUNNonlinearSolver solver, int count) {
  content_of(solver)->most_iterations = count;
  return SUN_NLS_SUCCESS;
}

static int get_iterations(SUNNonlinearSolver solver, long *count) {
  *count = content_of(solver)->iterations;
  return SUN_NLS_SUCCESS;
}

static int get_failures(SUNNonlinearSolver solver, long *count) {
  *count = content_of(solver)->failures;
  return SUN_NLS_SUCCESS;
}

/* Turns the residual in `step` into the correction and adds it. */
static int correct(content *self, N_Vector correction, void *integrator) {
  ++self->iterations;
  N_VScale(-1.0, self->step, self->step);
  const int flag = self->solve(self->step, integrator);
  if (flag == SUN_NLS_SUCCESS) N_VLinearSum(1.0, correction, 1.0, self->step, correction);
  return flag;
}

/* Iterates from the predicted states until the correction is believed; `is_new` tells whether the Jacobian is of this
 * very step. */
static int iterate(content *self, N_Vector correction, N_Vector weight, double tolerance, int is_new, void *integrator) {
  double last_change = 0.0, residual = N_VWrmsNorm(self->step, weight);
  if (is_new && self->quotients != NULL) N_VScale(1.0, self->step, self->first_residual);
  for (int count = 1;; ++count) {
    int flag = correct(self, correction, integrator);
    if (flag != SUN_NLS_SUCCESS) return flag;
    if (count == 1 && is_new && self->quotients != NULL) N_VScale(1.0, self->step, self->first_step);
    const double change = N_VWrmsNorm(self->step, weight);
    if (count > 1) self->rate = fmax(slowest_fall_of_rate * self->rate, change / last_change);
    const int converged = change * fmin(1.0, self->rate) <= tolerance;
    if (!converged && (count >= self->most_iterations || (count > 1 && change > divergence * last_change))) {
      return SUN_NLS_CONV_RECVR;
    }
    last_change = change;

    flag = self->residual(correction, self->step, integrator);
    if (flag != SUN_NLS_SUCCESS) return flag;
    const double remainder = N_VWrmsNorm(self->step, weight);
    if (converged) {
      const int is_right = remainder <= largest_remainder * residual;
      if (remainder <= (is_right ? small_remainder : small_residual) * tolerance) return SUN_NLS_SUCCESS;
      if (count >= self->most_iterations || !(is_new || is_right)) return SUN_NLS_CONV_RECVR;
    }
    residual = remainder;
  }
}

/* Takes the residual for the correction, extrapolated from the one before (Anderson 1965, depth 1), as long as that lessens
 * it: steps that are short beside the stiffest contact, as where a hundred bodies collide one after the other, need no
 * more. An evaluation a correction, where a linear system without a matrix takes one for each direction and one more. */
static int extrapolate(content *self, N_Vector correction, N_Vector weight, double tolerance, void *integrator) {
  N_Vector last = self->first_residual, move = self->first_step;
  double before = 0.0, residual = N_VWrmsNorm(self->step, weight);
  for (int count = 0; count < MOST_EXTRAPOLATIONS; ++count) {
    ++self->iterations;
    if (count == 0) {
      N_VScale(-1.0, self->step, move);
    } else {
      N_VLinearSum(1.0, self->step, -1.0, last, last);
      const double change = N_VWrmsNorm(last, weight), square = change * change;
      const double share = square > 0.0 ? 0.5 * (square + residual * residual - before * before) / square : 0.0;
      N_VLinearSum(-share, move, share, last, move);
      N_VLinearSum(1.0, move, -1.0, self->step, move);
    }
    N_VScale(1.0, self->step, last);
    N_VLinearSum(1.0, correction, 1.0, move, correction);
    const int flag = self->residual(correction, self->step, integrator);
    if (flag != SUN_NLS_SUCCESS) return flag;
    const double remainder = N_VWrmsNorm(self->step, weight);
    if (remainder > largest_contraction * residual) return SUN_NLS_CONV_RECVR;
    if (remainder * residual <= (residual - remainder) * small_extrapolation_error * tolerance) return SUN_NLS_SUCCESS;
    before = residual;
    residual = remainder;
  }
  return SUN_NLS_CONV_RECVR;
}

/* After a failure with a new Jacobian: 1 if that one does not give the residual's derivative along the first correction,
 * which must be minus the first residual. Changes `correction`. */
static int jacobian_is_wrong(content *self, N_Vector correction, N_Vector weight, void *integrator) {
  N_VScale(probe_share, self->first_step, correction);
  if (self->residual(correction, self->step, integrator) != SUN_NLS_SUCCESS) return 0;
  N_VLinearSum(1.0, self->step, probe_share - 1.0, self->first_residual, self->step);
  return N_VWrmsNorm(self->step, weight) >
         largest_jacobian_error * probe_share * N_VWrmsNorm(self->first_residual, weight);
}

static int solve(SUNNonlinearSolver solver, N_Vector predicted, N_Vector correction, N_Vector weight, realtype tolerance,
                 booleantype setup_wanted, void *integrator) {
  content *self = content_of(solver);
  (void)predicted; /* known to the residual's function */
  self->iterations = self->failures = 0;
  if (self->setup == NULL) self->rate = 1.0;
  if (self->steps_to_solve > 0) {
    --self->steps_to_solve;
  } else if (self->setup == NULL || N_VGetLength(correction) >= STATES_OF_A_LARGE_MATRIX) {
    int flag = self->residual(correction, self->step, integrator);
    if (flag == SUN_NLS_SUCCESS) flag = extrapolate(self, correction, weight, tolerance, integrator);
    if (flag <= 0) return flag;
    self->steps_to_solve = self->setup == NULL ? WAIT_WITHOUT_MATRIX : WAIT_WITH_MATRIX;
    N_VConst(0.0, correction);
  }
  booleantype jacobian_is_bad = SUNFALSE;
  for (;;) {
    booleantype is_new = self->setup == NULL;
    int flag = self->residual(correction, self->step, integrator);
    if (flag != SUN_NLS_SUCCESS) { /* the predicted states cannot be evaluated: no matrix helps */
      ++self->failures;
      return flag;
    }
    if ((setup_wanted || !self->has_matrix) && self->setup != NULL) {
      flag = self->setup(jacobian_is_bad || !self->has_matrix, &is_new, integrator);
      /* CVODE makes a Jacobian at the first step, or where the step is about as long as at the setup before: now it is. */
      if (flag == SUN_NLS_SUCCESS && !self->has_matrix && !is_new) flag = self->setup(SUNTRUE, &is_new, integrator);
      self->rate = 1.0;
      self->has_matrix = 1;
    }
    if (flag == SUN_NLS_SUCCESS) flag = iterate(self, correction, weight, tolerance, is_new, integrator);
    if (flag == SUN_NLS_SUCCESS) return flag;
    const int by_quotients = self->quotients == NULL || *self->quotients > 0;
    if (flag < 0 || (is_new && (flag != SUN_NLS_CONV_RECVR || by_quotients ||
                                !jacobian_is_wrong(self, correction, weight, integrator)))) {
      ++self->failures;
      return flag;
    }
    if (is_new) *self->quotients = QUOTIENTS_IN_A_ROW;
    setup_wanted = jacobian_is_bad = SUNTRUE;
    N_VConst(0.0, correction);
  }
}

static int destroy(SUNNonlinearSolver solver) {
  content *self = content_of(solver);
  if (self != NULL) {
    if (self->step != NULL) N_VDestroy(self->step);
    if (self->first_residual != NULL) N_VDestroy(self->first_residual);
    if (self->first_step != NULL) N_VDestroy(self->first_step);
  }
  free(self);
  solver->content = NULL;
  SUNNonlinSolFreeEmpty(solver);
  return SUN_NLS_SUCCESS;
}

SUNNonlinearSolver fmurt_newton_create(N_Vector like, int *quotients, SUNContext context) {
  SUNNonlinearSolver solver = SUNNonlinSolNewEmpty(context);
  if (solver == NULL) return NULL;
  solver->ops->gettype = type_of;
  solver->ops->initialize = initialize;
  solver->ops->setsysfn = set_residual;
  solver->ops->setlsetupfn = set_setup;
  solver->ops->setlsolvefn = set_solve;
  solver->ops->setmaxiters = set_most_iterations;
  solver->ops->getnumiters = get_iterations;
  solver->ops->getnumconvfails = get_failures;
  solver->ops->solve = solve;
  solver->ops->free = destroy;
  content *self = calloc(1, sizeof *self);
  solver->content = self;
  if (self != NULL) {
    self->quotients = quotients;
    self->rate = 1.0;
    self->step = N_VClone(like);
    self->first_residual = N_VClone(like);
    self->first_step = N_VClone(like);
  }
  if (self == NULL || self->step == NULL || self->first_residual == NULL || self->first_step == NULL) {
    destroy(solver);
    return NULL;
  }
  return solver;
}
