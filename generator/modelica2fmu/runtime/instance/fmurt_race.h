/* fmurt_race.h - which of two integrators goes on: the one that comes farther in the model's time for its work.
 *
 * Neither the number of states nor a stiffness tells beforehand which one that is: while many bodies collide, explicit
 * steps are quicker, once they rest, implicit ones are, by orders of magnitude. So the other one is tried from time to time,
 * the more seldom the more often it lost. Work is counted in evaluations of the model, not in seconds: the same model
 * takes the same steps everywhere. Part of an instance's saved state. */
#ifndef FMURT_RACE_H
#define FMURT_RACE_H

typedef enum fmurt_method { FMURT_METHOD_EXPLICIT, FMURT_METHOD_IMPLICIT } fmurt_method;

/* All zero at the beginning. */
typedef struct fmurt_race {
  int method;    /* fmurt_method that goes on */
  int is_trial;  /* of it, beside the other one */
  int losses;    /* trials in a row */
  long spent;    /* evaluations in this stretch */
  long measured; /* those of them that are measured, */
  double gone;   /* and how far they led, s */
  double rate;   /* of the one that is not tried, s per evaluation */
} fmurt_race;

/* How many evaluations are left in this stretch; at least 1. jacobian: how many evaluations a Jacobian of the implicit method
 * and its factors cost, here and below always the same. */
long fmurt_race_left(const fmurt_race *race, long jacobian);

/* Tells how far the present method came, in s, for how many evaluations; another one may be the present one then. Returns 1
 * where a trial has just ended. */
int fmurt_race_add(fmurt_race *race, long jacobian, long evaluations, double gone);

/* The present method cannot go on: the other one does. */
void fmurt_race_give_up(fmurt_race *race);

#endif
