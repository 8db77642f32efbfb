/* fmurt_watch.c - see fmurt_watch.h. */
#include "fmurt_watch.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Closer to the ends of a step than this share of it nothing is looked for. */
static const double near_end = 1e-4;

struct fmurt_watch {
  size_t count;
  int seen;        /* of the times below: 0, 1 or 2 */
  double time[2];  /* the latest, the one before */
  double *last;    /* [count] at time[0] */
  double *earlier; /* [count] at time[1] */
  double *middle;  /* [count] scratch */
  double *peak;    /* [count] scratch */
  double *hidden;  /* [count] from this time on the sign that was found there is shown */
  double *shown;   /* [count] what was found there */
  double *block;
};

fmurt_watch *fmurt_watch_create(size_t indicator_count) {
  fmurt_watch *watch = calloc(1, sizeof *watch);
  if (watch == NULL) return NULL;
  watch->count = indicator_count;
  watch->block = calloc(6 * indicator_count + 1, sizeof(double));
  if (watch->block == NULL) {
    free(watch);
    return NULL;
  }
  watch->last = watch->block;
  watch->earlier = watch->last + indicator_count;
  watch->middle = watch->earlier + indicator_count;
  watch->peak = watch->middle + indicator_count;
  watch->hidden = watch->peak + indicator_count;
  watch->shown = watch->hidden + indicator_count;
  fmurt_watch_restart(watch);
  return watch;
}

void fmurt_watch_destroy(fmurt_watch *watch) {
  if (watch == NULL) return;
  free(watch->block);
  free(watch);
}

void fmurt_watch_restart(fmurt_watch *watch) {
  watch->seen = 0;
  for (size_t i = 0; i < watch->count; ++i) watch->hidden[i] = HUGE_VAL;
}

/* 1 if indicator i, of one sign at both ends, could be zero in between at the rate at which it changed there or before. */
static int may_be_zero(const fmurt_watch *watch, size_t i, double time, double now) {
  const double last = watch->last[i];
  if (!(last * now > 0.0)) return 0;
  const double lasted = time - watch->time[0], lasted_before = watch->time[0] - watch->time[1];
  double change = fabs(now - last);
  if (watch->seen > 1) change = fmax(change, fabs(last - watch->earlier[i]) / lasted_before * lasted);
  return fmin(fabs(last), fabs(now)) < change;
}

/* Hides the later sign of those indicators that have another one at `between`. */
static void hide(fmurt_watch *watch, double between, const double *indicator) {
  for (size_t i = 0; i < watch->count; ++i) {
    if (!(watch->last[i] * indicator[i] < 0.0 && between < watch->hidden[i])) continue;
    watch->hidden[i] = between;
    watch->shown[i] = indicator[i];
  }
}

/* Where the parabola through three points, `middle` halfway, has its extremum; as a share of the way. */
static double extremum(double begin, double middle, double end) {
  const double curvature = begin - 2.0 * middle + end;
  return curvature != 0.0 ? 0.5 + 0.25 * (begin - end) / curvature : 0.5;
}

static void look_between(fmurt_watch *watch, double time, const double *indicator, fmurt_indicators_at indicators_at,
                         void *context) {
  const double begin = watch->time[0], lasted = time - begin;
  if (!(lasted > 16.0 * DBL_EPSILON * fabs(time))) return;
  int has_middle = 0;
  for (size_t i = 0; i < watch->count; ++i) {
    if (!may_be_zero(watch, i, time, indicator[i])) continue;
    if (!has_middle) {
      if (indicators_at(context, begin + 0.5 * lasted, watch->middle) != 0) return;
      has_middle = 1;
      hide(watch, begin + 0.5 * lasted, watch->middle);
    }
    const double share = extremum(watch->last[i], watch->middle[i], indicator[i]);
    const int towards_zero = fabs(watch->middle[i]) < fmax(fabs(watch->last[i]), fabs(indicator[i]));
    if (isfinite(watch->hidden[i]) || !towards_zero || !(share > near_end && share < 1.0 - near_end)) continue;
    if (indicators_at(context, begin + share * lasted, watch->peak) == 0) {
      hide(watch, begin + share * lasted, watch->peak);
    }
  }
}

void fmurt_watch_step(fmurt_watch *watch, double time, const double *indicator, fmurt_indicators_at indicators_at,
                      void *context) {
  if (watch->seen > 0 && !(time > watch->time[0])) return;
  if (watch->seen > 0) look_between(watch, time, indicator, indicators_at, context);
  double *oldest = watch->earlier;
  watch->earlier = watch->last;
  watch->last = oldest;
  memcpy(watch->last, indicator, watch->count * sizeof(double));
  watch->time[1] = watch->time[0];
  watch->time[0] = time;
  watch->seen += watch->seen < 2;
}

void fmurt_watch_show(const fmurt_watch *watch, double time, double *indicator) {
  for (size_t i = 0; i < watch->count; ++i) {
    if (time < watch->hidden[i]) continue;
    indicator[i] = copysign(fmax(fabs(indicator[i]), fabs(watch->shown[i])), watch->shown[i]);
  }
}
