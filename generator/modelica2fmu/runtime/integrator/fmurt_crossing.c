/* fmurt_crossing.c - see fmurt_crossing.h. */
#include "fmurt_crossing.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* As closely as CVODE finds zeros: so many roundings of time. */
static const double roundings = 100.0;
/* An indicator is followed that is straight to this share of what a jump would be. */
static const double straight = 0.5;
/* So many evaluations must halve the way; and CVODE searches itself where more are needed than halving takes. */
enum { EVALUATIONS_TO_HALVE = 3, MOST_EVALUATIONS = 80 };

struct fmurt_crossing {
  size_t count;
  int seen;        /* whether `last` is known */
  int is_found;    /* the signs change between `before` and `after` */
  double last, end; /* times: the latest but those within steps; the one before it */
  double before, after;
  double *at_last, *at_before, *at_after; /* [count] */
  double *between; /* [count] scratch */
  double *bend;    /* [count] of each indicator as this search saw it last: 0 straight, 1 or more a jump */
  double *block;
};

fmurt_crossing *fmurt_crossing_create(size_t indicator_count) {
  fmurt_crossing *crossing = calloc(1, sizeof *crossing);
  if (crossing == NULL) return NULL;
  crossing->count = indicator_count;
  crossing->block = calloc(5 * indicator_count + 1, sizeof(double));
  if (crossing->block == NULL) {
    free(crossing);
    return NULL;
  }
  crossing->at_last = crossing->block;
  crossing->at_before = crossing->at_last + indicator_count;
  crossing->at_after = crossing->at_before + indicator_count;
  crossing->between = crossing->at_after + indicator_count;
  crossing->bend = crossing->between + indicator_count;
  return crossing;
}

void fmurt_crossing_destroy(fmurt_crossing *crossing) {
  if (crossing == NULL) return;
  free(crossing->block);
  free(crossing);
}

void fmurt_crossing_restart(fmurt_crossing *crossing) { crossing->seen = crossing->is_found = 0; }

/* Zero counts as changed, as it does for CVODE. */
static int changes(const double *before, const double *after, size_t i) {
  return before[i] > 0.0 ? after[i] <= 0.0 : before[i] < 0.0 && after[i] >= 0.0;
}

static int any_changes(const fmurt_crossing *crossing, const double *before, const double *after) {
  for (size_t i = 0; i < crossing->count; ++i) {
    if (changes(before, after, i)) return 1;
  }
  return 0;
}

/* How far the indicators that change are from straight lines, by their values at a share of the way. */
static void see_bends(fmurt_crossing *crossing, double share) {
  const double room = fmin(share, 1.0 - share);
  for (size_t i = 0; i < crossing->count; ++i) {
    if (!changes(crossing->at_before, crossing->at_after, i)) continue;
    const double way = crossing->at_after[i] - crossing->at_before[i];
    crossing->bend[i] = fabs(crossing->between[i] - crossing->at_before[i] - share * way) / (fabs(way) * room);
  }
}

/* The straightest of the indicators that change; their number in `changing`. */
static size_t straightest(const fmurt_crossing *crossing, int *changing) {
  size_t best = crossing->count;
  *changing = 0;
  for (size_t i = 0; i < crossing->count; ++i) {
    if (!changes(crossing->at_before, crossing->at_after, i)) continue;
    if (best == crossing->count || crossing->bend[i] < crossing->bend[best]) best = i;
    ++*changing;
  }
  return best;
}

/* Narrows the way between the two times until it is as short as rounding asks for. By regula falsi with the value halved at an end that
 * stays (the Illinois method: Dowell and Jarratt 1971). 0 on success. */
static int narrow(fmurt_crossing *crossing, double shortest, fmurt_indicators_at indicators_at, void *context) {
  double share_before = 1.0, share_after = 1.0, width = crossing->after - crossing->before;
  size_t followed = crossing->count;
  int since_halved = 0, is_seen = 0, side = 0; /* which end was replaced last: -1 the first, 1 the last, 0 none */
  for (int count = 0; crossing->after - crossing->before > shortest; ++count) {
    if (count >= MOST_EVALUATIONS) return -1;
    int changing = 0;
    const size_t best = straightest(crossing, &changing);
    if (best != followed) {
      share_before = share_after = 1.0;
      side = 0;
    }
    followed = best;
    const double way = crossing->after - crossing->before;
    double share = 0.5;
    if (since_halved < EVALUATIONS_TO_HALVE && (is_seen ? crossing->bend[best] < straight : changing == 1)) {
      const double begin = fabs(crossing->at_before[best]) * share_before, end = fabs(crossing->at_after[best]) * share_after;
      share = begin / (begin + end);
      const double nearest = fmin(0.5, 0.5 * shortest / way);
      share = fmin(fmax(share, nearest), 1.0 - nearest);
    }
    const double time = crossing->before + share * way;
    if (!(time > crossing->before && time < crossing->after)) return 0;
    if (indicators_at(context, time, crossing->between) != 0) return -1;
    see_bends(crossing, share);
    is_seen = 1;
    double *const between = crossing->between;
    if (any_changes(crossing, crossing->at_before, between)) {
      crossing->between = crossing->at_after;
      crossing->at_after = between;
      crossing->after = time;
      share_before = side > 0 ? 0.5 * share_before : 1.0;
      share_after = 1.0;
      side = 1;
    } else {
      crossing->between = crossing->at_before;
      crossing->at_before = between;
      crossing->before = time;
      share_after = side < 0 ? 0.5 * share_after : 1.0;
      share_before = 1.0;
      side = -1;
    }
    ++since_halved;
    if (crossing->after - crossing->before <= 0.5 * width) {
      width = crossing->after - crossing->before;
      since_halved = 0;
    }
  }
  return 0;
}

void fmurt_crossing_look(fmurt_crossing *crossing, double time, const double *indicator, fmurt_indicators_at indicators_at,
                         void *context) {
  if (crossing->seen && !(time > crossing->end)) return;
  const size_t size = crossing->count * sizeof(double);
  crossing->is_found = 0;
  if (crossing->seen && any_changes(crossing, crossing->at_last, indicator)) {
    crossing->last = crossing->before = crossing->end;
    crossing->after = time;
    memcpy(crossing->at_before, crossing->at_last, size);
    memcpy(crossing->at_after, indicator, size);
    memset(crossing->bend, 0, size); /* where it crosses depends on no search before */
    const double shortest = roundings * DBL_EPSILON * (fabs(time) + time - crossing->before);
    crossing->is_found = narrow(crossing, shortest, indicators_at, context) == 0;
  }
  memcpy(crossing->at_last, indicator, size);
  crossing->end = time;
  crossing->seen = 1;
}

int fmurt_crossing_tell(const fmurt_crossing *crossing, double time, double *indicator) {
  if (!crossing->is_found || !(time > crossing->last && time < crossing->end)) return 0;
  memcpy(indicator, time < crossing->after ? crossing->at_before : crossing->at_after, crossing->count * sizeof(double));
  return 1;
}
