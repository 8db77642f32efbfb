/* fmurt_dead_center.c - see fmurt_dead_center.h. */
#include "fmurt_dead_center.h"

#include <math.h>
#include <string.h>

/* Unknowns that miss by this share what they would change by at the speed of before may have turned back. */
static const double steady = 0.2;
/* Those that turn by themselves move back slower than by this share of the speed where a step was first too long. */
static const double slow = 0.5;
/* Where unknowns turn by themselves determinant and time left do not both fall to this share of what they were where a step was first too
 * long. */
static const double shortest_share = 0.01;
/* A determinant that has grown to so many times what it was there is not about to be zero. */
static const double far_again = 2.0;

size_t fmurt_history_size(size_t followed_count) { return 6 * followed_count + 1; }

fmurt_history fmurt_history_in(double *memory, size_t followed_count) {
  double *const determinants = memory + followed_count + 1;
  return (fmurt_history){.count = followed_count,
                         .before = memory,
                         .determinant = determinants,
                         .determinant_before = determinants + followed_count,
                         .noted = determinants + 2 * followed_count,
                         .time_left = determinants + 3 * followed_count,
                         .speed = determinants + 4 * followed_count};
}

static double accepted_at(const fmurt_values *values) { return values->accepted[values->history.count]; }

/* How long the last accepted step was. */
static double length_of_step(const fmurt_values *values) {
  return accepted_at(values) - values->history.before[values->history.count];
}

void fmurt_history_forget(fmurt_values *values) {
  fmurt_history *history = &values->history;
  if (history->count == 0) return;
  memset(history->before, 0, fmurt_history_size(history->count) * sizeof(double));
  history->before[history->count] = values->accepted[history->count];
}

void fmurt_history_shift(fmurt_values *values) {
  fmurt_history *history = &values->history;
  const size_t size = history->count * sizeof(double);
  if (history->count == 0 || values->time == accepted_at(values)) return;
  memcpy(history->before, values->accepted, size + sizeof(double));
  memcpy(history->determinant_before, history->determinant, size);
  memset(history->determinant, 0, size);
}

void fmurt_history_learn(fmurt_values *values, int offset, double determinant) {
  fmurt_history *history = &values->history;
  if (history->count == 0) return;
  history->determinant[offset] = isfinite(determinant) ? determinant : 0.0;
  if (fabs(determinant) > far_again * fabs(history->noted[offset])) history->noted[offset] = history->time_left[offset] = 0.0;
}

/* Until the determinant is zero if it goes on to fall as in the last step; infinite where it does not. */
static double time_left(const fmurt_values *values, int offset) {
  const fmurt_history *history = &values->history;
  const double here = fabs(history->determinant[offset]), before = fabs(history->determinant_before[offset]);
  const double lasted = length_of_step(values);
  const int keeps_its_sign = history->determinant[offset] * history->determinant_before[offset] > 0.0;
  return keeps_its_sign && here < before && lasted > 0.0 ? here / (before - here) * lasted : HUGE_VAL;
}

/* 1 if the last step was long enough for the determinant to fall to zero and to rise again as fast as it fell where a step was first
 * too long: impacts turn unknowns as suddenly, at any determinant. */
static int was_zero(const fmurt_values *values, int offset) {
  const fmurt_history *history = &values->history;
  const double way = fabs(history->determinant_before[offset]) + fabs(history->determinant[offset]);
  return length_of_step(values) * fabs(history->noted[offset]) > slow * way * history->time_left[offset];
}

typedef struct unknowns_change {
  double expected; /* by the speed of the last step; largest of the unknowns, scaled, as the others are */
  double missing;  /* of what was expected */
  double made;
  double along; /* > 0 if it goes on in the direction of the last step */
} unknowns_change;

static unknowns_change change_of(const fmurt_values *values, int offset, int n, const double *x, const double *scale) {
  const fmurt_history *history = &values->history;
  const double *const here = values->accepted + offset, *const before = history->before + offset;
  const double share = (values->time - accepted_at(values)) / length_of_step(values);
  unknowns_change found = {0.0, 0.0, 0.0, 0.0};
  for (int i = 0; i < n; ++i) {
    const double expected = (here[i] - before[i]) * share / scale[i], made = (x[i] - here[i]) / scale[i];
    found.expected = fmax(found.expected, fabs(expected));
    found.missing = fmax(found.missing, fabs(made - expected));
    found.made = fmax(found.made, fabs(made));
    found.along += made * expected;
  }
  return found;
}

fmurt_course fmurt_history_course(const fmurt_values *values, int offset, int n, const double *x, const double *scale) {
  const fmurt_history *history = &values->history;
  if (history->count == 0) return FMURT_GOES_ON;
  const double lasts = values->time - accepted_at(values);
  if (!(lasts > 0.0) || !(length_of_step(values) > 0.0)) return FMURT_GOES_ON;
  const double left = time_left(values, offset);
  const int was_noted = history->noted[offset] != 0.0;
  if (was_noted && left < shortest_share * history->time_left[offset] &&
      fabs(history->determinant[offset]) < shortest_share * fabs(history->noted[offset])) {
    return FMURT_TURNS_BACK;
  }
  if (!was_noted && lasts <= left) return FMURT_GOES_ON;
  const unknowns_change found = change_of(values, offset, n, x, scale);
  if (was_noted && found.along < 0.0 && found.made > slow * history->speed[offset] * lasts && was_zero(values, offset)) {
    return FMURT_TURNS_BACK;
  }
  if (lasts <= left || found.missing <= steady * found.expected) return FMURT_GOES_ON;
  return FMURT_MAY_TURN_BACK;
}

void fmurt_history_note(fmurt_values *values, int offset, int n, const double *scale) {
  fmurt_history *history = &values->history;
  if (history->noted[offset] != 0.0) return;
  history->noted[offset] = history->determinant[offset];
  history->time_left[offset] = time_left(values, offset);
  history->speed[offset] = 0.0;
  for (int i = offset; i < offset + n; ++i) {
    const double change = fabs(values->accepted[i] - history->before[i]) / scale[i - offset];
    history->speed[offset] = fmax(history->speed[offset], change / length_of_step(values));
  }
}
