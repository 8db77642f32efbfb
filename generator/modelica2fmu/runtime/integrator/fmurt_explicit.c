/* fmurt_explicit.c - see fmurt_explicit.h and fmurt_pair.h. */
#include "fmurt_explicit.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "fmurt_pair.h"

/* The estimate is the error of order 2; what goes on is of order 3. */
static const double largest_estimate = 1.5;

struct fmurt_explicit {
  size_t state_count;
  int runs;        /* the first slope and the step are known */
  double step;     /* that the error estimate permits next */
  double estimate; /* of the last step's error, by the largest */
  double *numbers; /* all of them */
  double *slope[4], *next;
};

fmurt_explicit *fmurt_explicit_create(size_t state_count) {
  fmurt_explicit *self = calloc(1, sizeof *self);
  if (self == NULL) return NULL;
  self->state_count = state_count;
  self->numbers = calloc(5 * state_count, sizeof(double));
  if (self->numbers == NULL) {
    free(self);
    return NULL;
  }
  for (size_t k = 0; k < 4; ++k) self->slope[k] = self->numbers + k * state_count;
  self->next = self->numbers + 4 * state_count;
  return self;
}

void fmurt_explicit_destroy(fmurt_explicit *self) {
  if (self != NULL) free(self->numbers);
  free(self);
}

void fmurt_explicit_restart(fmurt_explicit *self) { self->runs = 0; }

/* Root mean square of the numbers by their tolerances; state and other tell the size of a state. */
static double norm(const fmurt_explicit *self, const fmurt_explicit_model *model, const double *state,
                   const double *other, const double *numbers) {
  double sum = 0.0;
  for (size_t i = 0; i < self->state_count; ++i) {
    const double size = fmax(fabs(state[i]), fabs(other[i]));
    const double part = numbers[i] / (model->relative * size + model->absolute[i]);
    sum += part * part;
  }
  return sqrt(sum / (double)self->state_count);
}

static double first_step(const fmurt_explicit *self, const fmurt_explicit_model *model, const double *state, double way) {
  const double size = norm(self, model, state, state, state), rate = norm(self, model, state, state, self->slope[0]);
  return rate > 0.0 && size > 0.0 ? fmin(way, fmurt_pair_first_change * size / rate) : 1e-3 * way;
}

/* The states at the end of the step and the slope there. `error` is the difference of both orders, by the largest permitted. */
static fmurt_result try_step(fmurt_explicit *self, const fmurt_explicit_model *model, double time, const double *state,
                             double step, double *error, long *evaluations) {
  double *const *slope = self->slope, *next = self->next;
  const size_t count = self->state_count;
  for (size_t i = 0; i < count; ++i) next[i] = fmurt_pair_place(1, step, state[i], slope, i);
  ++*evaluations;
  fmurt_result result = model->derivatives(model->context, time + 0.5 * step, next, slope[1]);
  if (result != FMURT_RESULT_OK) return result;
  for (size_t i = 0; i < count; ++i) next[i] = fmurt_pair_place(2, step, state[i], slope, i);
  ++*evaluations;
  result = model->derivatives(model->context, time + 0.75 * step, next, slope[2]);
  if (result != FMURT_RESULT_OK) return result;
  for (size_t i = 0; i < count; ++i) next[i] = fmurt_pair_place(3, step, state[i], slope, i);
  ++*evaluations;
  result = model->derivatives(model->context, time + step, next, slope[3]);
  if (result != FMURT_RESULT_OK) return result;
  for (size_t i = 0; i < count; ++i) slope[1][i] = fmurt_pair_difference(step, slope, i);
  *error = norm(self, model, state, next, slope[1]) / largest_estimate;
  return FMURT_RESULT_OK;
}

static void tell_start(const fmurt_explicit *self, const fmurt_explicit_model *model, double time, const double *state) {
  if (model->unseen == NULL) return;
  const fmurt_explicit_step none = {time, 0.0, state, self->slope[0], state, self->slope[0]};
  (void)model->unseen(model->context, &none);
}

/* The share of the step that was tried after which it is to end; 0: it is good. */
static double unseen_share(const fmurt_explicit *self, const fmurt_explicit_model *model, double time, const double *state,
                           double step) {
  if (model->unseen == NULL) return 0.0;
  const fmurt_explicit_step tried = {time, step, state, self->slope[0], self->next, self->slope[3]};
  return model->unseen(model->context, &tried);
}

static void take_step(fmurt_explicit *self, double *state) {
  double *first = self->slope[0];
  memcpy(state, self->next, self->state_count * sizeof(double));
  self->slope[0] = self->slope[3];
  self->slope[3] = first;
}

fmurt_explicit_outcome fmurt_explicit_advance(fmurt_explicit *self, const fmurt_explicit_model *model, double *time,
                                              double *state, double end, double largest_step,
                                              fmurt_explicit_work allowed, fmurt_explicit_work *done) {
  *done = (fmurt_explicit_work){0};
  if (!self->runs) {
    ++done->evaluations;
    const fmurt_result result = model->derivatives(model->context, *time, state, self->slope[0]);
    if (result != FMURT_RESULT_OK) return result == FMURT_RESULT_DISCARD ? FMURT_EXPLICIT_STUCK : FMURT_EXPLICIT_ERROR;
    self->step = first_step(self, model, state, end - *time);
    self->estimate = 1.0;
    self->runs = 1;
    tell_start(self, model, *time, state);
  }
  const double shortest = fmurt_pair_least_roundings * DBL_EPSILON * fmax(fabs(*time), fabs(end));
  double growth = fmurt_pair_largest_growth;
  while (*time < end) {
    if (done->steps >= allowed.steps || done->evaluations >= allowed.evaluations) return FMURT_EXPLICIT_STOPPED;
    if (largest_step > 0.0) self->step = fmin(self->step, largest_step);
    if (!(self->step > shortest)) return FMURT_EXPLICIT_STUCK;
    const double left = end - *time;
    /* Two steps alike rather than one and a crumb. */
    const double step = self->step >= left ? left : self->step > 0.5 * left ? 0.5 * left : self->step;
    double error = HUGE_VAL;
    const fmurt_result result = try_step(self, model, *time, state, step, &error, &done->evaluations);
    if (result == FMURT_RESULT_ERROR) return FMURT_EXPLICIT_ERROR;
    if (result != FMURT_RESULT_OK || !(error <= 1.0)) {
      ++done->rejected;
      self->step = fmurt_pair_after_failure(step, error);
      growth = 1.0;
      continue;
    }
    const double share = unseen_share(self, model, *time, state, step);
    if (share > 0.0) {
      ++done->rejected;
      self->step = fmax(share * step, 2.0 * shortest);
      growth = 1.0;
      continue;
    }
    take_step(self, state);
    *time = step == left ? end : *time + step;
    ++done->steps;
    error = fmax(error, fmurt_pair_least_estimate);
    const double permitted = fmurt_pair_permitted(step, growth, error, self->estimate);
    self->estimate = error;
    /* A step that the end cut short tells little of how long the next one may be. */
    self->step = step < self->step ? fmax(self->step, permitted) : permitted;
    growth = fmurt_pair_largest_growth;
    if (model->accepted != NULL) model->accepted(model->context);
  }
  return FMURT_EXPLICIT_AT_END;
}
