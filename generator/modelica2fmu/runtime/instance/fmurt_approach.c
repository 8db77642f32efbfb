/* fmurt_approach.c - see fmurt_approach.h. */
#include "fmurt_approach.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fmurt_passage.h"

/* Bodies may get into each other by so many times the first step after a meeting, half the thickness of the thinner one, before it
 * counts as left behind. */
static const double steps_left_behind = 5000.0;

/* Where an importer was. */
typedef struct place {
  double time;
  double *state, *slope;
} place;

struct fmurt_approach {
  fmurt_passage *passage;
  int seen;       /* of the places below */
  place last, one_before;
  int has_met;
  double begin, end; /* of the step in which they met */
  fmurt_meeting meeting;
  double *block;
};

size_t fmurt_shown_indicator_count(void) { return fmurt_model.indicator_count + (fmurt_model.scene_count > 0); }

static void destroy(fmurt_approach *self) {
  if (self == NULL) return;
  fmurt_passage_destroy(self->passage);
  free(self->block);
  free(self);
}

static fmurt_approach *create(fmurt_instance *instance) {
  const size_t count = fmurt_model.state_count;
  fmurt_approach *self = calloc(1, sizeof *self);
  if (self == NULL) return NULL;
  self->passage = fmurt_passage_create(instance);
  self->block = calloc(4 * count + 1, sizeof(double));
  if (self->passage == NULL || self->block == NULL) {
    destroy(self);
    return NULL;
  }
  self->last = (place){0.0, self->block, self->block + count};
  self->one_before = (place){0.0, self->block + 2 * count, self->block + 3 * count};
  return self;
}

void fmurt_approach_forget(fmurt_instance *instance) {
  if (instance->approach == NULL) return;
  instance->approach->seen = instance->approach->has_met = 0;
}

static void take_place(const fmurt_instance *instance, place *here) {
  here->time = instance->values.time;
  for (size_t i = 0; i < fmurt_model.state_count; ++i) {
    here->state[i] = instance->values.real[fmurt_model.state[i]];
    here->slope[i] = instance->values.real[fmurt_model.derivative[i]];
  }
}

/* Exchanges both places. */
static void turn(fmurt_approach *self) {
  const place last = self->last;
  self->last = self->one_before;
  self->one_before = last;
}

static double start(fmurt_approach *self, fmurt_instance *instance) {
  take_place(instance, &self->last);
  fmurt_passage_begin(self->passage);
  self->seen = 1;
  return 1.0;
}

/* The step from the last place to the one that was put aside for it. */
static int states_between(void *context, double share, double *state) {
  const fmurt_approach *self = context;
  const place *begin = &self->last, *end = &self->one_before;
  for (size_t i = 0; i < fmurt_model.state_count; ++i) {
    state[i] = fmurt_between(share, end->time - begin->time, begin->state[i], begin->slope[i], end->state[i], end->slope[i]);
  }
  return 0;
}

static double shown(const fmurt_approach *self, double time) {
  const double value = (self->meeting.time - time) / (self->end - self->begin);
  return value > 0.0 ? value : fmin(value, -1e-12);
}

double fmurt_approach_indicator(fmurt_instance *instance) {
  const double time = instance->values.time;
  if (instance->kind != FMURT_KIND_MODEL_EXCHANGE || instance->situation.phase != FMURT_PHASE_CONTINUOUS) return 1.0;
  if (instance->approach == NULL) instance->approach = create(instance);
  instance->destroy_approach = destroy;
  fmurt_approach *self = instance->approach;
  if (self == NULL) return 1.0;
  if (self->seen == 0) return start(self, instance);
  if (self->has_met && time >= self->begin) return shown(self, time);
  self->has_met = 0;
  if (time == self->last.time) return 1.0;
  if (time < self->last.time) { /* the importer looks back, or repeats its step */
    if (self->seen < 2 || !(time > self->one_before.time)) return start(self, instance);
    turn(self);
    fmurt_passage_go_back(self->passage);
    self->seen = 1;
  }
  take_place(instance, &self->one_before);
  if (fmurt_passage_look(self->passage, states_between, self, &self->meeting)) {
    self->has_met = 1;
    self->begin = self->last.time;
    self->end = time;
    self->seen = 1;
    return shown(self, time);
  }
  turn(self);
  self->seen = 2;
  return 1.0;
}

fmurt_result fmurt_approach_check(fmurt_instance *instance) {
  const fmurt_approach *self = instance->approach;
  if (self == NULL || !self->has_met) return FMURT_RESULT_OK;
  const double behind = instance->values.time - self->meeting.time;
  if (!(behind > steps_left_behind * self->meeting.next_step)) return FMURT_RESULT_OK;
  snprintf(instance->message, sizeof instance->message,
           "Between time %.9g and %.9g %s pass through each other, from %.9g on, and the importer's integrator went on "
           "without a look there. Let it locate state events, or take steps of %.3g s or less",
           self->begin, self->end, fmurt_passage_text(self->passage), self->meeting.time,
           0.5 * steps_left_behind * self->meeting.next_step);
  return FMURT_RESULT_ERROR;
}
