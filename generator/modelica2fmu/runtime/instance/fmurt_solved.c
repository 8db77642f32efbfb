/* fmurt_solved.c - see fmurt_solved.h. */
#include "fmurt_solved.h"

#include <math.h>
#include <string.h>

/* A point: its followed values, its time, and its number, 0 where nothing is remembered. The last double of all counts. */
static double *point(const fmurt_instance *instance, size_t k) {
  return instance->solved + k * (fmurt_model.followed_count + 2);
}

static double *time_of(double *point) { return point + fmurt_model.followed_count; }

static double *number_of(double *point) { return point + fmurt_model.followed_count + 1; }

static double *counter(const fmurt_instance *instance) { return point(instance, FMURT_SOLVED_POINTS); }

static int is_between_steps(const fmurt_instance *instance) {
  return fmurt_model.followed_count > 0 && instance->situation.phase == FMURT_PHASE_CONTINUOUS && !instance->at_event;
}

void fmurt_offer_solved(fmurt_instance *instance) {
  fmurt_values *values = &instance->values;
  values->solved_count = 0;
  values->may_stray = is_between_steps(instance);
  if (!values->may_stray) return;
  double gap[FMURT_SOLVED_POINTS];
  for (size_t k = 0; k < FMURT_SOLVED_POINTS; ++k) {
    double *candidate = point(instance, k);
    if (*number_of(candidate) == 0.0) continue;
    const double distance = fabs(*time_of(candidate) - values->time);
    int place = values->solved_count++;
    for (; place > 0 && gap[place - 1] > distance; --place) {
      gap[place] = gap[place - 1];
      values->solved[place] = values->solved[place - 1];
    }
    gap[place] = distance;
    values->solved[place] = candidate;
  }
}

void fmurt_remember_solved(fmurt_instance *instance) {
  if (!is_between_steps(instance) || instance->values.strayed) return;
  double *place = point(instance, 0);
  for (size_t k = 0; k < FMURT_SOLVED_POINTS; ++k) {
    double *candidate = point(instance, k);
    if (*number_of(candidate) != 0.0 && *time_of(candidate) == instance->values.time) {
      place = candidate;
      break;
    }
    if (*number_of(candidate) < *number_of(place)) place = candidate;
  }
  for (size_t i = 0; i < fmurt_model.followed_count; ++i) {
    place[i] = instance->values.real[fmurt_model.followed[i]];
  }
  *time_of(place) = instance->values.time;
  *number_of(place) = *counter(instance) += 1.0;
}

void fmurt_forget_solved(fmurt_instance *instance) {
  if (*counter(instance) == 0.0) return;
  memset(instance->solved, 0, fmurt_solved_size() * sizeof(double));
}
