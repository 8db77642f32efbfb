/* fmurt_race.c - see fmurt_race.h. */
#include "fmurt_race.h"

/* Evaluations of a trial, beside a few Jacobians. Those of its first half, where steps are still short, do not count. As many
 * at the end of the stretch before it are what it is compared with. */
static const long trial_evaluations = 300, trial_jacobians = 2;
/* Evaluations before a trial, beside twice as many as the trial takes; doubled by each that is lost, up to so often. */
static const long first_wait = 600;
enum { MOST_DOUBLINGS = 5 };
/* Implicit steps have to be so much quicker: they also solve, and are no more accurate. */
static const double lead = 1.3;

static long trial_length(long jacobian) { return trial_evaluations + trial_jacobians * jacobian; }

static long stretch(const fmurt_race *race, long jacobian) {
  const long trial = trial_length(jacobian);
  const int doublings = race->losses < MOST_DOUBLINGS ? race->losses : MOST_DOUBLINGS;
  return race->is_trial ? trial : (first_wait + 2 * trial) << doublings;
}

long fmurt_race_left(const fmurt_race *race, long jacobian) {
  const long left = stretch(race, jacobian) - race->spent;
  return left > 0 ? left : 1;
}

static void begin_stretch(fmurt_race *race, int is_trial) {
  race->is_trial = is_trial;
  race->spent = race->measured = 0;
  race->gone = 0.0;
}

static void change(fmurt_race *race) {
  race->method = race->method == FMURT_METHOD_EXPLICIT ? FMURT_METHOD_IMPLICIT : FMURT_METHOD_EXPLICIT;
}

int fmurt_race_add(fmurt_race *race, long jacobian, long evaluations, double gone) {
  const long end = stretch(race, jacobian);
  race->spent += evaluations;
  if (race->spent > end - trial_length(jacobian) / 2) {
    race->measured += evaluations;
    race->gone += gone;
  }
  if (race->spent < end) return 0;
  const double rate = race->measured > 0 ? race->gone / (double)race->measured : 0.0;
  const int ends_trial = race->is_trial;
  if (!ends_trial) {
    race->rate = rate;
    change(race);
  } else if (rate > (race->method == FMURT_METHOD_IMPLICIT ? lead * race->rate : race->rate / lead)) {
    race->losses = 0;
  } else {
    ++race->losses;
    change(race);
  }
  begin_stretch(race, !ends_trial);
  return ends_trial;
}

void fmurt_race_give_up(fmurt_race *race) {
  race->losses = race->is_trial ? race->losses + 1 : 0;
  change(race);
  begin_stretch(race, 0);
}
