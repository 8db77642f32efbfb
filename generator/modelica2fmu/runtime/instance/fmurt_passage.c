/* fmurt_passage.c - see fmurt_passage.h. */
#include "fmurt_passage.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fmurt_call.h"
#include "fmurt_evaluate.h"

/* Of the thickness of the thinner body: how far the step after a meeting may lead them into each other. */
static const double first_overlap = 1e-4;

struct fmurt_passage {
  fmurt_instance *instance;
  double time, time_before; /* of `begin` and `before` */
  double *begin, *end;      /* motions of all scenes, one after the other */
  double *before;           /* at the beginning of the step before */
  double *state;            /* [state_count] scratch */
  double *kept;             /* [state_count] at the end of the step, where the instance was moved from there */
  double *block;
  int is_moved;
  int is_told;  /* that a step could not be looked through */
  /* The search at hand. */
  double end_time;
  size_t scene;
  fmurt_states_at states_at;
  void *context;
  const double *motion_begin, *motion_end;
  int is_blind; /* the model could not be evaluated somewhere */
  int pair[2];
  double number[3];
  char text[200];
};

static size_t motion_size(void) {
  size_t size = 0;
  for (size_t k = 0; k < fmurt_model.scene_count; ++k) size += 18 * (size_t)fmurt_model.scene[k].body_count;
  return size;
}

fmurt_passage *fmurt_passage_create(fmurt_instance *instance) {
  fmurt_passage *self = calloc(1, sizeof *self);
  if (self == NULL) return NULL;
  const size_t motion = motion_size();
  self->instance = instance;
  self->block = calloc(3 * motion + 2 * fmurt_model.state_count + 1, sizeof(double));
  if (self->block == NULL) {
    free(self);
    return NULL;
  }
  self->begin = self->block;
  self->end = self->begin + motion;
  self->before = self->end + motion;
  self->state = self->before + motion;
  self->kept = self->state + fmurt_model.state_count;
  return self;
}

void fmurt_passage_destroy(fmurt_passage *self) {
  if (self == NULL) return;
  free(self->block);
  free(self);
}

static void gather(fmurt_passage *self, double *motion) {
  for (size_t k = 0; k < fmurt_model.scene_count; ++k) {
    (void)fmurt_model.scene[k].motion(&self->instance->values, motion);
    motion += 18 * (size_t)fmurt_model.scene[k].body_count;
  }
}

void fmurt_passage_begin(fmurt_passage *self) {
  self->time = self->time_before = self->instance->values.time;
  gather(self, self->begin);
  memcpy(self->before, self->begin, motion_size() * sizeof(double));
}

void fmurt_passage_go_back(fmurt_passage *self) {
  self->time = self->time_before;
  memcpy(self->begin, self->before, motion_size() * sizeof(double));
}

static void keep_end(fmurt_passage *self) {
  if (self->is_moved) return;
  self->is_moved = 1;
  for (size_t i = 0; i < fmurt_model.state_count; ++i) {
    self->kept[i] = self->instance->values.real[fmurt_model.state[i]];
  }
}

/* For the engine: the motion of a scene within the step. */
static int motion_at(void *context, double share, double *motion) {
  fmurt_passage *self = context;
  fmurt_instance *instance = self->instance;
  keep_end(self);
  int is_known = self->states_at(self->context, share, self->state) == 0;
  if (is_known) {
    fmurt_set_point(instance, self->time + share * (self->end_time - self->time), self->state);
    is_known = fmurt_update_rates(instance) == FMURT_RESULT_OK &&
               fmurt_model.scene[self->scene].motion(&instance->values, motion) == FMURT_RESULT_OK;
  }
  if (!is_known) self->is_blind = 1;
  return is_known ? 0 : -1;
}

static fmurt_result run_search(fmurt_values *values, void *context) {
  fmurt_passage *self = context;
  return (fmurt_result)fmurt_model.scene[self->scene].passage(values, self->end_time - self->time, self->motion_begin,
                                                              self->motion_end, motion_at, self, self->pair, self->number);
}

static void take_meeting(fmurt_passage *self, double time, fmurt_meeting *meeting) {
  const double thickness = self->number[1], speed = self->number[2];
  meeting->time = time;
  meeting->next_step = speed > 0.0 ? first_overlap * thickness / speed : self->end_time - self->time;
  snprintf(self->text, sizeof self->text, "bodies %d and %d of %.100s", self->pair[0], self->pair[1],
           fmurt_model.scene[self->scene].name);
}

void fmurt_tell_unsearched(fmurt_instance *instance, double begin, double end, int *is_told) {
  if (*is_told) return;
  *is_told = 1;
  const int has_cause = instance->message[0] != '\0';
  fmurt_log(instance, FMURT_LOG_WARNING, FMURT_LOG_STATUS_WARNING,
            "Between time %.9g and %.9g bodies may have passed through each other unseen: the model could not be evaluated "
            "there%s%s. Choose shorter communication steps or a smaller tolerance (told once)",
            begin, end, has_cause ? ": " : "", instance->message);
}

int fmurt_passage_look(fmurt_passage *self, fmurt_states_at states_at, void *context, fmurt_meeting *meeting) {
  fmurt_instance *instance = self->instance;
  self->end_time = instance->values.time;
  self->states_at = states_at;
  self->context = context;
  self->is_moved = 0;
  if (!(self->end_time > self->time)) return 0;
  gather(self, self->end);
  int found = 0;
  size_t offset = 0;
  for (self->scene = 0; self->scene < fmurt_model.scene_count; ++self->scene) {
    fmurt_guarded search = {run_search, self};
    self->motion_begin = self->begin + offset;
    self->motion_end = self->end + offset;
    offset += 18 * (size_t)fmurt_model.scene[self->scene].body_count;
    self->pair[0] = 0;
    self->is_blind = 0;
    const fmurt_result result = fmurt_call_model(instance, FMURT_CALL_GUARDED, &search);
    const int is_found = result == FMURT_RESULT_OK && self->pair[0] != 0;
    if (!is_found && (result != FMURT_RESULT_OK || self->is_blind)) {
      fmurt_tell_unsearched(instance, self->time, self->end_time, &self->is_told);
    }
    if (!is_found) continue;
    const double time = self->time + self->number[0] * (self->end_time - self->time);
    if (!found || time < meeting->time) take_meeting(self, time, meeting);
    found = 1;
  }
  if (self->is_moved) {
    fmurt_set_point(instance, self->end_time, self->kept);
    (void)fmurt_update_rates(instance); /* as it was before */
  }
  if (found) {
    fmurt_log(instance, FMURT_LOG_DEBUG, FMURT_LOG_SOLVER,
              "Between time %.9g and %.9g %s pass through each other unseen: it goes on from time %.9g, where they meet",
              self->time, self->end_time, self->text, meeting->time);
    return 1;
  }
  double *oldest = self->before;
  self->before = self->begin;
  self->time_before = self->time;
  self->begin = self->end;
  self->time = self->end_time;
  self->end = oldest;
  return 0;
}

const char *fmurt_passage_text(const fmurt_passage *self) { return self->text; }
