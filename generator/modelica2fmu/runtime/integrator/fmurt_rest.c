/* fmurt_rest.c - see fmurt_rest.h. */
#include "fmurt_rest.h"

#include <math.h>
#include <string.h>

enum { INTERVALS_OF_REST = 10 };
/* Slow impacts of soft contacts last 150 ms, and importers may step by microseconds. */
static const double time_of_rest = 0.1;

static int has_moved(const double *place, const double *state, const double *weight, size_t count) {
  double sum = 0.0;
  for (size_t i = 0; i < count; ++i) {
    const double change = weight[i] * (state[i] - place[i]);
    sum += change * change;
  }
  return !(sum < (double)count);
}

int fmurt_rest_watch(fmurt_rest *rest, double time, const double *state, const double *weight, size_t count) {
  const int before = rest->rests;
  if (rest->intervals == 0 || has_moved(rest->place, state, weight, count)) {
    memcpy(rest->place, state, count * sizeof *state);
    rest->since = time;
    rest->intervals = 1;
    rest->rests = 0;
  } else if (!rest->rests) {
    ++rest->intervals;
    rest->rests = rest->intervals > INTERVALS_OF_REST && time - rest->since >= time_of_rest;
  }
  return rest->rests != before;
}
