/* fmurt_solver.c - see fmurt_solver.h. */
#include "fmurt_solver.h"

#include <cvode/cvode.h>
#include <float.h>
#include <limits.h>
#include <math.h>
#include <nvector/nvector_serial.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sunlinsol/sunlinsol_spgmr.h>
#include <sunmatrix/sunmatrix_dense.h>

#include "fmurt_apart.h"
#include "fmurt_call.h"
#include "fmurt_crossing.h"
#include "fmurt_dead_center.h"
#include "fmurt_dense.h"
#include "fmurt_evaluate.h"
#include "fmurt_event.h"
#include "fmurt_explicit.h"
#include "fmurt_failure.h"
#include "fmurt_newton.h"
#include "fmurt_passage.h"
#include "fmurt_rest.h"
#include "fmurt_solved.h"
#include "fmurt_tolerance.h"
#include "fmurt_vector.h"
#include "fmurt_watch.h"

enum { MAXIMUM_RETRIES = 1000, MAXIMUM_ROOT_RETRIES = 3 };

/* From so many states on, Newton's linear systems are solved by GMRES with products of Jacobian and vector, each of
 * which costs one evaluation: a dense Jacobian costs as many as there are states, and its factors the cube of that.
 * Scenes of many bodies are so large; each body feels a few others, and few iterations do. */
enum { KRYLOV_STATES = 500 };

/* How far Newton's iteration goes, as a share of what the error test permits: CVODE's own share, and the one for where
 * the integrator creeps. At loose tolerances one iteration with an old Jacobian may do, and steps beside a kink, as of
 * dry friction, can go round in a cycle of two points: the error estimate is then always the same, just too large for a
 * longer step. Going on with the iteration breaks the cycle. Always doing so makes bodies at rest tremble (tried). */
static const double usual_newton_share = 0.1, careful_newton_share = 0.01;
/* From so many states on, of models without event indicators, explicit steps are tried beside CVODE's. */
enum { STATES_OF_A_RACE = 100 };

/* How many evaluations a Jacobian, its factors and what is solved with them cost, for each state (dominoes, boxes). */
enum { EVALUATIONS_OF_A_COLUMN = 2 };

/* What integrate() answers where the other method goes on from here. */
enum { METHOD_CHANGED = 1000 };

/* So many steps of one length, shorter than this share of the longest, are creeping. */
enum { STEPS_WATCHED = 200 };
static const double creeping_share = 0.1;

/* How much longer the second step after a start may be than the first. CVODE's own 10 000 makes a step of a millisecond
 * out of one of a microsecond, at order one: between its ends the interpolated distance of bodies that part slowly leads
 * back into contact, and the events found there go on and on. */
static const double growth_after_start = 10.0;
/* CVODE's own after the very first start, where bodies do not part as a rule. */
static const double growth_at_first = 10000.0;

struct fmurt_solver {
  fmurt_instance *instance;
  SUNContext context;
  void *memory;
  N_Vector state, tolerance; /* the absolute one of each state */
  double relative;           /* tolerance */
  SUNMatrix matrix; /* NULL with GMRES */
  SUNLinearSolver linear;
  SUNNonlinearSolver newton;
  fmurt_watch *watch;
  fmurt_crossing *crossing;
  fmurt_passage *passage; /* NULL where the model has no contacts that the engine finds */
  fmurt_meeting meeting;
  const fmurt_explicit_step *explicit_step; /* at which it looks */
  double looked_from, looked_to; /* ends of the step at which it looks */
  double step_of_meeting; /* in which bodies met unseen; 0: none did since the start */
  fmurt_explicit *explicit_steps; /* NULL where CVODE alone integrates */
  fmurt_apart *apart;             /* explicit steps where the model has parts; else NULL */
  N_Vector between; /* states within a step */
  int quotients; /* how many of the next Jacobians are computed by difference quotients */
  double *entry;          /* [state_count] states at the start of an advance */
  double *entry_accepted; /* [fmurt_accepted_size()] accepted there */
  int *roots;             /* [indicator_count + 1] scratch */
  fmurt_rest rest;
  double step_of_rest; /* with which it begins */
  size_t state_count;
  int initialized, restart;
  double step_at_root; /* in which the latest root was found, if that is why the next start is; else 0 */
  fmurt_result cause; /* of the last failed evaluation */
  long counted[FMURT_SOLVER_INTEGER_COUNT];
  long steps_accepted;       /* since the latest start, as far as the instance knows; -1 before that */
  long steps_left;           /* that are still allowed */
  long quotient_evaluations; /* of the right-hand side, since the last count */
};

/* Models without states are integrated with one constant state, so that indicators of time are watched. */
static size_t vector_size(const fmurt_solver *solver) { return solver->state_count > 0 ? solver->state_count : 1; }

static void log_solver_error(int code, const char *module, const char *function, char *message, void *data) {
  if (code == CV_TOO_MUCH_WORK) return; /* advance_watched calls again, or the step is given up with a message */
  fmurt_log(data, FMURT_LOG_DEBUG, FMURT_LOG_SOLVER, "%s, %s (%d): %s", module, function, code, message);
}

static int to_cvode(fmurt_solver *solver, fmurt_result result) {
  if (result != FMURT_RESULT_OK) {
    solver->cause = result;
    fmurt_log(solver->instance, FMURT_LOG_DEBUG, FMURT_LOG_SOLVER, "%s", solver->instance->message);
  }
  return result == FMURT_RESULT_OK ? 0 : result == FMURT_RESULT_DISCARD ? 1 : -1;
}

static fmurt_result derivatives_at(void *context, double time, const double *state, double *derivative) {
  fmurt_solver *solver = context;
  fmurt_instance *instance = solver->instance;
  fmurt_set_point(instance, time, state);
  const fmurt_result result = fmurt_update_rates(instance);
  if (result != FMURT_RESULT_OK) return result;
  if (solver->state_count == 0) derivative[0] = 0.0;
  for (size_t i = 0; i < solver->state_count; ++i) derivative[i] = instance->values.real[fmurt_model.derivative[i]];
  return result;
}

static int right_hand_side(realtype time, N_Vector state, N_Vector derivative, void *data) {
  return to_cvode(data, derivatives_at(data, time, NV_DATA_S(state), NV_DATA_S(derivative)));
}

/* CVODE asks for the indicators at the start, and at the end of each accepted step before it looks for roots inside. */
static int is_end_of_step(fmurt_solver *solver) {
  long steps = 0;
  if (CVodeGetNumSteps(solver->memory, &steps) != CV_SUCCESS || steps == solver->steps_accepted) return 0;
  solver->steps_accepted = steps;
  return 1;
}

static int indicators_between(void *context, double time, double *indicator) {
  fmurt_solver *solver = context;
  if (CVodeGetDky(solver->memory, time, 0, solver->between) != CV_SUCCESS) return -1;
  fmurt_set_point(solver->instance, time, NV_DATA_S(solver->between));
  return fmurt_event_indicators(solver->instance, indicator) == FMURT_RESULT_OK ? 0 : -1;
}

static int states_between(void *context, double share, double *state) {
  fmurt_solver *solver = context;
  const double time = solver->looked_from + share * (solver->looked_to - solver->looked_from);
  if (CVodeGetDky(solver->memory, time, 0, solver->between) != CV_SUCCESS) return -1;
  memcpy(state, NV_DATA_S(solver->between), solver->state_count * sizeof *state);
  return 0;
}

/* 1 if the instance is where the step of which `time` is a part ends: there it was evaluated last, as a rule. */
static int is_at_end_of_step(const fmurt_solver *solver, double time) {
  const fmurt_instance *instance = solver->instance;
  double end = time;
  return CVodeGetCurrentTime(solver->memory, &end) == CV_SUCCESS && end > time && instance->values.time == end &&
         !instance->situation.continuous_stale;
}

/* At the start, the end of a step or a time inside that CVODE looks at before the end: whether bodies passed through each other since
 * the time before; up to the end of the step where that costs no evaluation. Earlier times, at which zeros are looked for, do nothing. */
static void look_for_passages(fmurt_solver *solver, double time, N_Vector state, int is_start) {
  fmurt_instance *instance = solver->instance;
  if (solver->passage == NULL || solver->step_of_meeting > 0.0 || !(is_start || time > solver->looked_from)) return;
  if (!is_start && is_at_end_of_step(solver, time)) {
    time = instance->values.time;
  } else if (instance->values.time != time) {
    fmurt_set_point(instance, time, NV_DATA_S(state));
  }
  if (fmurt_update_rates(instance) != FMURT_RESULT_OK) return;
  if (is_start) {
    fmurt_passage_begin(solver->passage);
  } else {
    solver->looked_to = time;
    if (fmurt_passage_look(solver->passage, states_between, solver, &solver->meeting)) {
      solver->step_of_meeting = time - solver->looked_from;
    }
  }
  solver->looked_from = time;
}

/* For CVODE: falls through zero where bodies met. */
static double meeting_indicator(const fmurt_solver *solver, double time) {
  return solver->step_of_meeting > 0.0 ? (solver->meeting.time - time) / solver->step_of_meeting : 1.0;
}

static int shown_between(void *context, double time, double *indicator) {
  const fmurt_solver *solver = context;
  if (indicators_between(context, time, indicator) != 0) return -1;
  fmurt_watch_show(solver->watch, time, indicator);
  return 0;
}

/* At a start indicators have the signs that the relations have, though by rounding they may lie beyond; CVODE, which looks for changes
 * alone, would never find these zeros. */
static void show_relations(const fmurt_solver *solver, double *indicator) {
  for (size_t i = 0; i < fmurt_model.indicator_count; ++i) {
    const double sign = solver->instance->values.relation[i] ? 1.0 : -1.0;
    if (!(sign * indicator[i] > 0.0)) indicator[i] = sign * DBL_MIN;
  }
}

static int roots(realtype time, N_Vector state, realtype *indicator, void *data) {
  fmurt_solver *solver = data;
  if (fmurt_crossing_tell(solver->crossing, time, indicator)) {
    if (solver->passage != NULL) indicator[fmurt_model.indicator_count] = meeting_indicator(solver, time);
    return 0;
  }
  fmurt_set_point(solver->instance, time, NV_DATA_S(state));
  const fmurt_result result = fmurt_event_indicators(solver->instance, indicator);
  if (result == FMURT_RESULT_OK) {
    const int is_end = is_end_of_step(solver);
    if (is_end && solver->steps_accepted > 0) fmurt_accept(solver->instance);
    const int is_start = is_end && solver->steps_accepted == 0;
    if (is_start) show_relations(solver, indicator);
    look_for_passages(solver, time, state, is_start);
    fmurt_watch_step(solver->watch, time, indicator, indicators_between, solver);
  }
  fmurt_watch_show(solver->watch, time, indicator);
  if (result == FMURT_RESULT_OK) fmurt_crossing_look(solver->crossing, time, indicator, shown_between, solver);
  if (solver->passage != NULL) indicator[fmurt_model.indicator_count] = meeting_indicator(solver, time);
  return to_cvode(solver, result);
}

/* The step that CVODE has just accepted, wherever it is asked for in it. The point that was evaluated last differs from its end by a
 * correction that the integrator takes for none; it is not evaluated again. What cannot be evaluated is not accepted. */
static void accept_end_of_step(fmurt_solver *solver, realtype time, N_Vector state) {
  fmurt_instance *instance = solver->instance;
  const int is_there = (instance->values.time == time && !instance->situation.continuous_stale) || is_at_end_of_step(solver, time);
  if (!is_there) fmurt_set_point(instance, time, NV_DATA_S(state));
  if (fmurt_update_rates(instance) == FMURT_RESULT_OK) fmurt_accept(instance);
}

/* Models without events: an indicator, which has zeros where bodies meet unseen alone, tells of accepted steps. */
static int no_roots(realtype time, N_Vector state, realtype *indicator, void *data) {
  fmurt_solver *solver = data;
  const int is_end = is_end_of_step(solver), is_start = is_end && solver->steps_accepted == 0;
  if (is_end && !is_start) accept_end_of_step(solver, time, state);
  look_for_passages(solver, time, state, is_start);
  indicator[0] = meeting_indicator(solver, time);
  return 0;
}

/* Difference quotients with increments by the states' values or nominal values, whichever is larger. CVODE's own shrink
 * with the derivatives: at rest, where stiff contacts leave hardly any, the rounding of large forces would make up a
 * good part of the quotients, and wrong Jacobians let Newton accept points beside the fast modes' equilibrium. */
static int difference_quotients(realtype time, N_Vector state, N_Vector derivative, SUNMatrix matrix, void *data,
                                N_Vector first, N_Vector second, N_Vector third) {
  fmurt_solver *solver = data;
  (void)second, (void)third;
  double *x = NV_DATA_S(state), *moved = NV_DATA_S(first);
  const double *here = NV_DATA_S(derivative);
  for (size_t k = 0; k < solver->state_count; ++k) {
    const double kept = x[k], nominal = solver->instance->values.state_nominal[k];
    x[k] += sqrt(DBL_EPSILON) * fmax(fabs(kept), nominal > 0.0 ? nominal : 1.0);
    const double step = x[k] - kept;
    const int flag = right_hand_side(time, state, first, data);
    x[k] = kept;
    ++solver->quotient_evaluations;
    if (flag != 0) return flag;
    double *column = SUNDenseMatrix_Column(matrix, (sunindextype)k);
    for (size_t i = 0; i < solver->state_count; ++i) column[i] = (moved[i] - here[i]) / step;
  }
  return 0;
}

static int all_finite(const double *numbers, size_t count) {
  for (size_t i = 0; i < count; ++i) {
    if (!isfinite(numbers[i])) return 0;
  }
  return 1;
}

/* The model's own Jacobian; where it has none, since a part of the model cannot be differentiated there (the root of
 * zero, a call that fails beside the point), or where it was found wrong, difference quotients. */
static int jacobian(realtype time, N_Vector state, N_Vector derivative, SUNMatrix matrix, void *data, N_Vector first,
                    N_Vector second, N_Vector third) {
  fmurt_solver *solver = data;
  fmurt_set_point(solver->instance, time, NV_DATA_S(state));
  fmurt_result result = fmurt_update_continuous(solver->instance);
  if (result != FMURT_RESULT_OK) return to_cvode(solver, result);
  if (solver->quotients > 0) {
    --solver->quotients;
    return difference_quotients(time, state, derivative, matrix, data, first, second, third);
  }
  result = fmurt_call_model(solver->instance, FMURT_CALL_JACOBIAN, SUNDenseMatrix_Data(matrix));
  if (result == FMURT_RESULT_ERROR) return to_cvode(solver, result);
  if (result == FMURT_RESULT_OK && all_finite(SUNDenseMatrix_Data(matrix), solver->state_count * solver->state_count)) {
    return 0;
  }
  return difference_quotients(time, state, derivative, matrix, data, first, second, third);
}

fmurt_solver *fmurt_solver_create(fmurt_instance *instance) {
  fmurt_solver *solver = calloc(1, sizeof *solver);
  if (solver == NULL) return NULL;
  solver->instance = instance;
  solver->state_count = fmurt_model.state_count;
  solver->restart = 1;
  const sunindextype size = (sunindextype)vector_size(solver);
  if (SUNContext_Create(NULL, &solver->context) != 0) {
    free(solver);
    return NULL;
  }
  solver->entry = calloc(vector_size(solver), sizeof(double));
  solver->entry_accepted = calloc(fmurt_accepted_size(), sizeof(double));
  solver->roots = calloc(fmurt_model.indicator_count + 1, sizeof(int));
  solver->rest.place = calloc(vector_size(solver), sizeof(double));
  solver->state = N_VNew_Serial(size, solver->context);
  solver->tolerance = N_VNew_Serial(size, solver->context);
  solver->between = N_VNew_Serial(size, solver->context);
  solver->watch = fmurt_watch_create(fmurt_model.indicator_count);
  solver->crossing = fmurt_crossing_create(fmurt_model.indicator_count);
  const int has_scenes = fmurt_model.scene_count > 0;
  if (has_scenes) solver->passage = fmurt_passage_create(instance);
  solver->memory = CVodeCreate(CV_BDF, solver->context);
  if (solver->state != NULL) {
    fmurt_speed_up_vector(solver->state);
    N_VConst(0.0, solver->state);
  }
  const int has_jacobian = fmurt_model.jacobian != NULL && solver->state_count < KRYLOV_STATES;
  if (solver->state != NULL) {
    solver->newton = fmurt_newton_create(solver->state, has_jacobian ? &solver->quotients : NULL, solver->context);
  }
  if (solver->state_count < KRYLOV_STATES) {
    solver->matrix = SUNDenseMatrix(size, size, solver->context);
    if (solver->matrix != NULL) {
      fmurt_speed_up_matrix(solver->matrix);
      solver->linear = fmurt_dense_create(size, solver->context);
    }
  } else if (solver->state != NULL) {
    solver->linear = SUNLinSol_SPGMR(solver->state, SUN_PREC_NONE, 0, solver->context);
  }
  const int races = solver->state_count >= STATES_OF_A_RACE && fmurt_model.indicator_count == 0;
  if (races) solver->explicit_steps = fmurt_explicit_create(solver->state_count);
  const int has_parts = races && fmurt_model.parts != NULL;
  if (has_parts) solver->apart = fmurt_apart_create(instance);
  if ((races && solver->explicit_steps == NULL) || (has_parts && solver->apart == NULL) || (has_scenes && solver->passage == NULL) || solver->entry == NULL || solver->entry_accepted == NULL || solver->roots == NULL ||
      solver->rest.place == NULL || solver->state == NULL ||
      solver->tolerance == NULL || solver->between == NULL || solver->watch == NULL || solver->crossing == NULL || solver->memory == NULL ||
      solver->linear == NULL || solver->newton == NULL ||
      CVodeSetErrHandlerFn(solver->memory, log_solver_error, instance) != CV_SUCCESS) {
    fmurt_solver_destroy(solver);
    return NULL;
  }
  return solver;
}

void fmurt_solver_destroy(fmurt_solver *solver) {
  if (solver == NULL) return;
  if (solver->memory != NULL) CVodeFree(&solver->memory);
  if (solver->newton != NULL) SUNNonlinSolFree(solver->newton);
  if (solver->linear != NULL) SUNLinSolFree(solver->linear);
  if (solver->matrix != NULL) SUNMatDestroy(solver->matrix);
  if (solver->state != NULL) N_VDestroy(solver->state);
  if (solver->tolerance != NULL) N_VDestroy(solver->tolerance);
  if (solver->between != NULL) N_VDestroy(solver->between);
  fmurt_watch_destroy(solver->watch);
  fmurt_crossing_destroy(solver->crossing);
  fmurt_passage_destroy(solver->passage);
  fmurt_explicit_destroy(solver->explicit_steps);
  fmurt_apart_destroy(solver->apart);
  free(solver->rest.place);
  free(solver->entry);
  free(solver->entry_accepted);
  free(solver->roots);
  SUNContext_Free(&solver->context);
  free(solver);
}

static void restart_explicit_steps(fmurt_solver *solver) {
  if (solver->explicit_steps != NULL) fmurt_explicit_restart(solver->explicit_steps);
  if (solver->apart != NULL) fmurt_apart_restart(solver->apart);
}

void fmurt_solver_restart_after_event(fmurt_solver *solver) {
  solver->restart = 1;
  solver->rest.intervals = solver->rest.rests = 0;
  restart_explicit_steps(solver);
}

void fmurt_solver_restart(fmurt_solver *solver) {
  if (solver == NULL) return;
  fmurt_solver_restart_after_event(solver);
  solver->step_at_root = 0.0;
}

static void load_point(fmurt_solver *solver) {
  double *state = NV_DATA_S(solver->state);
  for (size_t i = 0; i < solver->state_count; ++i) state[i] = solver->instance->values.real[fmurt_model.state[i]];
}

static double relative_tolerance(const fmurt_situation *situation) {
  if (situation->settings.tolerance > 0.0) return situation->settings.tolerance;
  return situation->solver_real[FMURT_SOLVER_RELATIVE_TOLERANCE];
}

/* For CVODE, before each step. */
static int weigh(N_Vector state, N_Vector weight, void *data) {
  fmurt_solver *solver = data;
  double step = 0.0;
  if (CVodeGetLastStep(solver->memory, &step) != CV_SUCCESS) return -1;
  return fmurt_weigh(fmurt_share_of_tolerance(step, solver->relative), solver->relative, NV_DATA_S(solver->tolerance),
                     NV_DATA_S(state), vector_size(solver), NV_DATA_S(weight));
}

static void set_tolerances(fmurt_solver *solver) {
  const fmurt_situation *situation = &solver->instance->situation;
  const double relative = relative_tolerance(situation);
  const double option = situation->solver_real[FMURT_SOLVER_ABSOLUTE_TOLERANCE];
  double *tolerance = NV_DATA_S(solver->tolerance);
  if (solver->state_count == 0) tolerance[0] = 1.0;
  for (size_t i = 0; i < solver->state_count; ++i) {
    tolerance[i] = fmurt_absolute_tolerance(relative, option, solver->instance->values.state_nominal[i]);
  }
  solver->relative = relative;
}

static int first_start(fmurt_solver *solver) {
  int flag = CVodeInit(solver->memory, right_hand_side, solver->instance->values.time, solver->state);
  if (flag == CV_SUCCESS) flag = CVodeWFtolerances(solver->memory, weigh);
  if (flag == CV_SUCCESS) flag = CVodeSetUserData(solver->memory, solver);
  if (flag == CV_SUCCESS) flag = CVodeSetLinearSolver(solver->memory, solver->linear, solver->matrix);
  if (flag == CV_SUCCESS && solver->state_count > 0 && solver->matrix != NULL) {
    flag = CVodeSetJacFn(solver->memory, fmurt_model.jacobian != NULL ? jacobian : difference_quotients);
  }
  if (flag == CV_SUCCESS) flag = CVodeSetNonlinearSolver(solver->memory, solver->newton);
  if (flag == CV_SUCCESS) flag = CVodeSetMaxHnilWarns(solver->memory, -1);
  if (flag == CV_SUCCESS && fmurt_model.indicator_count > 0) {
    flag = CVodeRootInit(solver->memory, (int)fmurt_model.indicator_count + (solver->passage != NULL), roots);
    if (flag == CV_SUCCESS) flag = CVodeSetNoInactiveRootWarn(solver->memory);
  } else if (flag == CV_SUCCESS && (fmurt_model.followed_count > 0 || fmurt_model.warnings != NULL || solver->passage != NULL)) {
    flag = CVodeRootInit(solver->memory, 1, no_roots);
  }
  solver->initialized = flag == CV_SUCCESS;
  return flag;
}

/* Order, Jacobians and the first step by whether something moves. */
static int choose_order(fmurt_solver *solver) {
  const int rests = solver->rest.rests;
  solver->quotients = rests ? INT_MAX : 0;
  const int flag = CVodeSetInitStep(solver->memory, rests ? solver->step_of_rest : 0.0);
  return flag == CV_SUCCESS ? CVodeSetMaxOrd(solver->memory, rests ? 1 : fmurt_highest_order(solver->relative)) : flag;
}

static int start(fmurt_solver *solver) {
  load_point(solver);
  set_tolerances(solver);
  int *has_started = &solver->instance->situation.has_started;
  int flag = solver->initialized ? CV_SUCCESS : first_start(solver);
  /* Which start it is belongs to a saved state, not to this integrator, so that what goes on from one repeats it. CVODE takes the growth
   * after a start over in CVodeReInit alone. */
  const double growth = *has_started || solver->explicit_steps != NULL ? growth_after_start : growth_at_first;
  if (flag == CV_SUCCESS) flag = CVodeSetEtaMaxFirstStep(solver->memory, growth);
  if (flag == CV_SUCCESS) flag = CVodeReInit(solver->memory, solver->instance->values.time, solver->state);
  if (flag == CV_SUCCESS) *has_started = 1;
  if (flag == CV_SUCCESS) flag = choose_order(solver);
  if (flag == CV_SUCCESS) flag = CVodeSetNonlinConvCoef(solver->memory, usual_newton_share);
  memset(solver->counted, 0, sizeof solver->counted);
  solver->steps_accepted = -1;
  solver->step_of_meeting = 0.0;
  fmurt_watch_restart(solver->watch);
  fmurt_crossing_restart(solver->crossing);
  solver->restart = flag != CV_SUCCESS;
  return flag;
}

/* Adds what CVODE did since the last call to the instance's counters. */
static void count(fmurt_solver *solver) {
  long now[FMURT_SOLVER_INTEGER_COUNT] = {0};
  CVodeGetNumSteps(solver->memory, &now[FMURT_SOLVER_STEPS]);
  CVodeGetNumRhsEvals(solver->memory, &now[FMURT_SOLVER_EVALUATIONS]);
  CVodeGetNumJacEvals(solver->memory, &now[FMURT_SOLVER_JACOBIANS]);
  CVodeGetNumErrTestFails(solver->memory, &now[FMURT_SOLVER_ERROR_TEST_FAILURES]);
  CVodeGetNumNonlinSolvConvFails(solver->memory, &now[FMURT_SOLVER_CONVERGENCE_FAILURES]);
  long products = 0; /* of Jacobian and vector, by GMRES */
  if (CVodeGetNumLinRhsEvals(solver->memory, &products) == CV_SUCCESS) now[FMURT_SOLVER_EVALUATIONS] += products;
  solver->steps_left -= now[FMURT_SOLVER_STEPS] - solver->counted[FMURT_SOLVER_STEPS];
  for (int i = 0; i < FMURT_SOLVER_INTEGER_COUNT; ++i) {
    solver->instance->situation.solver_integer[i] += (int)(now[i] - solver->counted[i]);
    solver->counted[i] = now[i];
  }
  solver->instance->situation.solver_integer[FMURT_SOLVER_EVALUATIONS] += (int)solver->quotient_evaluations;
  solver->quotient_evaluations = 0;
}

static void remember_entry(fmurt_solver *solver) {
  const fmurt_values *values = &solver->instance->values;
  for (size_t i = 0; i < solver->state_count; ++i) solver->entry[i] = values->real[fmurt_model.state[i]];
  memcpy(solver->entry_accepted, values->accepted, fmurt_accepted_size() * sizeof(double));
}

/* Moves the instance back to where the advance began, which was at `time`: what steps have been accepted since is forgotten. */
static void move_to_entry(fmurt_solver *solver, double time) {
  fmurt_instance *instance = solver->instance;
  fmurt_set_point(instance, time, solver->entry);
  memcpy(instance->values.accepted, solver->entry_accepted, fmurt_accepted_size() * sizeof(double));
  fmurt_history_forget(&instance->values);
  fmurt_forget_solved(instance);
}

static fmurt_result explain(fmurt_solver *solver, int flag, double time, const char *cause) {
  fmurt_instance *instance = solver->instance;
  const fmurt_result result = flag == CV_RHSFUNC_FAIL ||
                                      (flag == CV_RTFUNC_FAIL && solver->cause == FMURT_RESULT_ERROR) ||
                                      flag == CV_MEM_FAIL || flag == CV_ILL_INPUT
                                  ? FMURT_RESULT_ERROR
                                  : FMURT_RESULT_DISCARD;
  char state[200] = "";
  if (cause[0] == '\0' && flag != CV_TOO_MUCH_WORK && solver->initialized && solver->state_count > 0) {
    fmurt_describe_worst_state(solver->memory, solver->state, state, sizeof state);
  }
  fmurt_describe_failure(flag, time, instance->situation.solver_integer[FMURT_SOLVER_MAXIMUM_STEPS], cause, state,
                         instance->message, sizeof instance->message);
  return result;
}

static int goes_explicitly(const fmurt_solver *solver) {
  return solver->explicit_steps != NULL && solver->instance->situation.race.method == FMURT_METHOD_EXPLICIT;
}

/* After a failure: moves the instance to the latest point of CVODE's last successful step at which the model can be
 * evaluated. The accepted solution need not be one, since Newton's last correction is not evaluated again. Without one,
 * to the point where the advance began. Returns the time. Explicit steps leave the instance at such a point. */
static double move_to_last_good_point(fmurt_solver *solver, double begin) {
  static const double share_back[] = {0.0, 0.125, 0.5, 1.0};
  double last_time = 0.0, last_step = 0.0;
  if (goes_explicitly(solver)) return solver->instance->values.time;
  if (CVodeGetCurrentTime(solver->memory, &last_time) == CV_SUCCESS &&
      CVodeGetLastStep(solver->memory, &last_step) == CV_SUCCESS) {
    for (size_t i = 0; i < sizeof share_back / sizeof share_back[0]; ++i) {
      const double time = last_time - share_back[i] * last_step;
      if (!(time > begin) || CVodeGetDky(solver->memory, time, 0, solver->state) != CV_SUCCESS) break;
      fmurt_set_point(solver->instance, time, NV_DATA_S(solver->state));
      if (fmurt_update_continuous(solver->instance) == FMURT_RESULT_OK) return time;
    }
  }
  move_to_entry(solver, begin);
  return begin;
}

/* Without states and indicators there is nothing to integrate or to watch. */
static fmurt_result jump(fmurt_solver *solver, double target) {
  fmurt_set_point(solver->instance, target, NULL);
  return FMURT_RESULT_OK;
}

/* 1 if all of the last STEPS_WATCHED steps, since `begin`, were as short as each other. */
static int creeps(fmurt_solver *solver, double begin, double largest_step) {
  double time = 0.0, step = 0.0;
  if (CVodeGetCurrentTime(solver->memory, &time) != CV_SUCCESS ||
      CVodeGetLastStep(solver->memory, &step) != CV_SUCCESS) {
    return 0;
  }
  const double way = STEPS_WATCHED * step;
  return (largest_step <= 0.0 || step < creeping_share * largest_step) && fabs(time - begin - way) < 1e-6 * way;
}

/* The first step after an event is no longer than the one in which it was found. CVODE's own choice knows the error test
 * alone, and a long step at order one may lead bodies that part slowly back into contact between its ends, where another
 * event is found, and so on. */
static int first_step_after_event(fmurt_solver *solver, double end, double largest_step, double *reached) {
  const double longest = fmin(solver->step_at_root, end - solver->instance->values.time);
  solver->step_at_root = 0.0;
  int flag = CV_SUCCESS;
  if (largest_step <= 0.0 || longest < largest_step) flag = CVodeSetMaxStep(solver->memory, longest);
  if (flag == CV_SUCCESS) flag = CVode(solver->memory, end, solver->state, reached, CV_ONE_STEP);
  count(solver);
  const int reset = CVodeSetMaxStep(solver->memory, largest_step);
  return flag < 0 || reset == CV_SUCCESS ? flag : reset;
}

/* Says which method goes on, where a trial of the other one ended. */
static void tell_method(const fmurt_solver *solver, double time) {
  const int is_explicit = solver->instance->situation.race.method == FMURT_METHOD_EXPLICIT;
  fmurt_log(solver->instance, FMURT_LOG_DEBUG, FMURT_LOG_SOLVER,
            "From time %.9g on %s goes on, as it comes farther for its evaluations than %s", time,
            is_explicit ? "explicit steps" : "CVODE", is_explicit ? "CVODE" : "explicit steps");
}

static long cost_of_jacobian(const fmurt_solver *solver) {
  return solver->matrix != NULL ? EVALUATIONS_OF_A_COLUMN * (long)solver->state_count : 0;
}

/* What CVODE did so far, in evaluations. */
static long work(const fmurt_solver *solver) {
  const int *counters = solver->instance->situation.solver_integer;
  return counters[FMURT_SOLVER_EVALUATIONS] + counters[FMURT_SOLVER_JACOBIANS] * cost_of_jacobian(solver);
}

/* Lets CVODE go on to `end`, as far as steps are left, and counts what it did; where it creeps, Newton's iteration is
 * carried further until the next start. METHOD_CHANGED where explicit steps go on from `reached`. */
static int advance_watched(fmurt_solver *solver, double end, double largest_step, double *reached) {
  fmurt_race *race = solver->explicit_steps != NULL ? &solver->instance->situation.race : NULL;
  const long jacobian = cost_of_jacobian(solver);
  for (;;) {
    double begin = 0.0, now = 0.0;
    const long work_before = work(solver);
    long steps = solver->steps_left < STEPS_WATCHED ? solver->steps_left : STEPS_WATCHED;
    /* A step takes some four evaluations. */
    const long left = race != NULL ? fmurt_race_left(race, jacobian) : 0;
    if (race != NULL && left / 8 + 1 < steps) steps = left / 8 + 1;
    int flag = CVodeSetMaxNumSteps(solver->memory, steps);
    if (flag == CV_SUCCESS) flag = CVodeGetCurrentTime(solver->memory, &begin);
    if (flag != CV_SUCCESS) return flag;
    flag = CVode(solver->memory, end, solver->state, reached, CV_NORMAL);
    count(solver);
    if (race != NULL && (flag >= 0 || flag == CV_TOO_MUCH_WORK) &&
        CVodeGetCurrentTime(solver->memory, &now) == CV_SUCCESS &&
        fmurt_race_add(race, jacobian, work(solver) - work_before, now - begin)) {
      tell_method(solver, *reached);
    }
    if (flag != CV_TOO_MUCH_WORK || solver->steps_left <= 0) return flag;
    if (race != NULL && race->method == FMURT_METHOD_EXPLICIT) return METHOD_CHANGED;
    if (steps == STEPS_WATCHED && creeps(solver, begin, largest_step)) flag = CVodeSetNonlinConvCoef(solver->memory, careful_newton_share);
  }
}

static void accept_step(void *context) {
  const fmurt_solver *solver = context;
  fmurt_accept(solver->instance);
}

static int explicit_states_between(void *context, double share, double *state) {
  const fmurt_solver *solver = context;
  const fmurt_explicit_step *step = solver->explicit_step;
  for (size_t i = 0; i < solver->state_count; ++i) {
    state[i] = fmurt_between(share, step->length, step->begin[i], step->first[i], step->end[i], step->last[i]);
  }
  return 0;
}

/* Bodies that pass through each other within an explicit step. */
static double unseen_passage(void *context, const fmurt_explicit_step *step) {
  fmurt_solver *solver = context;
  if (step->length == 0.0) {
    fmurt_passage_begin(solver->passage);
    return 0.0;
  }
  solver->explicit_step = step;
  fmurt_meeting meeting;
  if (!fmurt_passage_look(solver->passage, explicit_states_between, solver, &meeting)) return 0.0;
  return fmin(fmax((meeting.time - step->time) / step->length, DBL_EPSILON), 0.999);
}

/* Goes on by explicit steps from the instance's time, and moves the instance to where they lead. */
static int integrate_explicitly(fmurt_solver *solver, double end, double largest_step, double *reached) {
  fmurt_instance *instance = solver->instance;
  fmurt_race *race = &instance->situation.race;
  const int is_told = fmurt_model.followed_count > 0 || fmurt_model.warnings != NULL;
  set_tolerances(solver);
  const fmurt_explicit_model model = {derivatives_at,
                                      is_told ? accept_step : NULL,
                                      solver->passage != NULL ? unseen_passage : NULL,
                                      solver,
                                      solver->relative,
                                      NV_DATA_S(solver->tolerance)};
  const long jacobian = cost_of_jacobian(solver);
  int *counters = instance->situation.solver_integer;
  double time = instance->values.time;
  load_point(solver);
  solver->restart = 1; /* of CVODE, when it is its turn */
  while (race->method == FMURT_METHOD_EXPLICIT) {
    const double begin = time;
    const fmurt_explicit_work allowed = {solver->steps_left, fmurt_race_left(race, jacobian), 0};
    fmurt_explicit_work done;
    double *const state = NV_DATA_S(solver->state);
    const fmurt_explicit_outcome outcome =
        solver->apart != NULL
            ? fmurt_apart_advance(solver->apart, &model, &time, state, end, largest_step, allowed, &done)
            : fmurt_explicit_advance(solver->explicit_steps, &model, &time, state, end, largest_step, allowed, &done);
    counters[FMURT_SOLVER_STEPS] += (int)done.steps;
    counters[FMURT_SOLVER_EVALUATIONS] += (int)done.evaluations;
    counters[FMURT_SOLVER_ERROR_TEST_FAILURES] += (int)done.rejected;
    solver->steps_left -= done.steps;
    if (fmurt_race_add(race, jacobian, done.evaluations, time - begin)) tell_method(solver, time);
    if (outcome == FMURT_EXPLICIT_STUCK) fmurt_race_give_up(race);
    if (race->method != FMURT_METHOD_EXPLICIT) restart_explicit_steps(solver);
    *reached = time;
    fmurt_set_point(instance, time, NV_DATA_S(solver->state));
    if (outcome == FMURT_EXPLICIT_ERROR) {
      solver->cause = FMURT_RESULT_ERROR;
      return CV_RHSFUNC_FAIL;
    }
    if (outcome == FMURT_EXPLICIT_AT_END) return CV_SUCCESS;
    if (solver->steps_left <= 0) return CV_TOO_MUCH_WORK;
  }
  return METHOD_CHANGED;
}

/* Goes on by CVODE from the instance's time. */
static int integrate_implicitly(fmurt_solver *solver, double end, double limit, double largest_step, double *reached) {
  int flag = solver->restart ? start(solver) : CV_SUCCESS;
  /* Smaller steps than the rounding of time lead nowhere: they only creep up to where the model cannot be evaluated. */
  const double smallest_step = 2.0 * DBL_EPSILON * fmax(fabs(solver->instance->values.time), fabs(end));
  if (flag == CV_SUCCESS) flag = CVodeSetMinStep(solver->memory, 0.0);
  if (flag == CV_SUCCESS) flag = CVodeSetMaxStep(solver->memory, largest_step);
  if (flag == CV_SUCCESS && (largest_step <= 0.0 || smallest_step < largest_step)) {
    flag = CVodeSetMinStep(solver->memory, smallest_step);
  }
  if (flag == CV_SUCCESS) flag = CVodeSetStopTime(solver->memory, fmin(limit, DBL_MAX));
  if (flag != CV_SUCCESS) return flag;
  if (solver->steps_left <= 0) return CV_TOO_MUCH_WORK;
  if (solver->step_at_root > smallest_step) {
    flag = first_step_after_event(solver, end, largest_step, reached);
    if (flag == CV_ROOT_RETURN || flag < 0) return flag;
  }
  return advance_watched(solver, end, largest_step, reached);
}

/* Integrates from the instance's time. */
static int integrate(fmurt_solver *solver, double end, double limit, double largest_step, double *reached) {
  solver->cause = FMURT_RESULT_OK;
  solver->instance->message[0] = '\0';
  remember_entry(solver);
  if (solver->explicit_steps == NULL) return integrate_implicitly(solver, end, limit, largest_step, reached);
  const fmurt_race *race = &solver->instance->situation.race;
  for (;;) {
    const int flag = race->method == FMURT_METHOD_EXPLICIT
                         ? integrate_explicitly(solver, end, largest_step, reached)
                         : integrate_implicitly(solver, end, limit, largest_step, reached);
    if (flag != METHOD_CHANGED) return flag;
    fmurt_set_point(solver->instance, *reached, NV_DATA_S(solver->state));
  }
}

/* After an interval that ended at `time`, where nothing stopped it: begins or ends rest. */
static int watch_rest(fmurt_solver *solver, double time) {
  if (solver->restart || solver->state_count == 0 || goes_explicitly(solver)) return CV_SUCCESS;
  const int flag = CVodeGetErrWeights(solver->memory, solver->between);
  if (flag != CV_SUCCESS) return flag;
  if (!fmurt_rest_watch(&solver->rest, time, NV_DATA_S(solver->state), NV_DATA_S(solver->between), solver->state_count)) {
    return CV_SUCCESS;
  }
  solver->restart = solver->rest.rests; /* only a start lowers the order */
  return solver->rest.rests ? CVodeGetLastStep(solver->memory, &solver->step_of_rest) : choose_order(solver);
}

/* Failures after which a fresh start from the last point may help. */
static int is_recoverable(int flag) {
  return flag == CV_ERR_FAILURE || flag == CV_CONV_FAILURE || flag == CV_REPTD_RHSFUNC_ERR ||
         flag == CV_UNREC_RHSFUNC_ERR;
}

static double last_step_begin(fmurt_solver *solver) {
  double time = -HUGE_VAL, step = 0.0;
  if (CVodeGetCurrentTime(solver->memory, &time) != CV_SUCCESS ||
      CVodeGetLastStep(solver->memory, &step) != CV_SUCCESS) {
    return -HUGE_VAL;
  }
  return time - step;
}

/* CVODE refuses intervals of a few roundings; over these the states do not change. */
static int is_too_short(double begin, double end) {
  return end - begin <= 8.0 * DBL_EPSILON * fmax(fabs(begin), fabs(end));
}

/* Tells the event to come which indicators crossed zero; the roots' last is that of bodies that met. */
static void tell_crossed(fmurt_solver *solver) {
  if (CVodeGetRootInfo(solver->memory, solver->roots) != CV_SUCCESS) return;
  for (size_t i = 0; i < fmurt_model.indicator_count; ++i) solver->instance->crossed[i] = solver->roots[i] != 0;
}

void fmurt_solver_allow_steps(fmurt_solver *solver, long count) { solver->steps_left = count; }

fmurt_result fmurt_solver_advance(fmurt_solver *solver, double target, double limit, double maximum_step,
                                  fmurt_stop *stop) {
  fmurt_instance *instance = solver->instance;
  *stop = FMURT_STOP_TARGET;
  if (solver->state_count == 0 && fmurt_model.indicator_count == 0) return jump(solver, target);

  double end = target, largest_step = maximum_step;
  double progress_time = -HUGE_VAL; /* where the last fresh start after a failure was */
  int retries = 0, shortened = 0;
  char failure[sizeof instance->message] = "";
  for (;;) {
    const double begin = instance->values.time;
    if (solver->restart && is_too_short(begin, end)) {
      instance->values.time = end;
      instance->situation.continuous_stale = 1;
      return FMURT_RESULT_OK;
    }
    double reached = begin;
    const int flag = integrate(solver, end, limit, largest_step, &reached);
    if (flag >= 0) {
      const int found_root = flag == CV_ROOT_RETURN;
      fmurt_set_point(instance, found_root ? reached : end, NV_DATA_S(solver->state));
      instance->situation.continuous_stale = 1;
      if (found_root) {
        *stop = FMURT_STOP_ROOT;
        tell_crossed(solver);
      }
      const int rest_flag = found_root || shortened ? CV_SUCCESS : watch_rest(solver, end);
      if (rest_flag != CV_SUCCESS) return explain(solver, rest_flag, end, "");
      if (!found_root || CVodeGetLastStep(solver->memory, &solver->step_at_root) != CV_SUCCESS) {
        solver->step_at_root = 0.0;
      }
      if (found_root && solver->step_of_meeting > 0.0) {
        solver->step_at_root = fmin(solver->step_at_root, solver->meeting.next_step);
      }
      if (!shortened || found_root) return FMURT_RESULT_OK;
      memcpy(instance->message, failure, sizeof failure);
      return FMURT_RESULT_DISCARD;
    }

    char cause[sizeof instance->message];
    snprintf(cause, sizeof cause, "%s", solver->cause != FMURT_RESULT_OK ? instance->message : "");
    const int root_failed = flag == CV_RTFUNC_FAIL && solver->cause == FMURT_RESULT_DISCARD;
    const double failed_at = root_failed ? last_step_begin(solver) : reached;
    solver->restart = 1;
    if (is_recoverable(flag) || flag == CV_TOO_MUCH_WORK) {
      reached = move_to_last_good_point(solver, begin);
    } else {
      move_to_entry(solver, begin);
      reached = begin;
    }
    instance->situation.continuous_stale = 1;
    if (is_recoverable(flag) && instance->situation.race.is_trial) fmurt_race_give_up(&instance->situation.race);

    if (is_recoverable(flag) && reached > fmax(begin, progress_time) && retries < MAXIMUM_RETRIES) {
      progress_time = reached; /* went some way: on from there */
      ++retries;
    } else if (root_failed && retries < MAXIMUM_ROOT_RETRIES) {
      /* An indicator cannot be computed inside a step that was already taken; a shorter one may stay away from it. */
      largest_step = (largest_step > 0.0 ? fmin(largest_step, end - begin) : end - begin) * 0.125;
      ++retries;
    } else if ((is_recoverable(flag) || root_failed) && reached == begin && failed_at > begin && !shortened) {
      /* This is the edge of where the model can be evaluated: up to shortly before that, then give up. */
      (void)explain(solver, flag, failed_at, cause);
      memcpy(failure, instance->message, sizeof failure);
      end = begin + 0.999 * (failed_at - begin);
      shortened = 1;
    } else {
      return explain(solver, flag, reached, cause);
    }
  }
}
