/* fmurt_apart.c - see fmurt_apart.h.
 *
 * A window of time begins with all parts at one time. Each body gets a ball that it will not leave in the window, by its speed
 * and size; parts whose balls overlap are a group. Groups do not act on each other, whatever their times within the window are:
 * each is integrated to its end on its own, with the pair of fmurt_pair.h. Where a group has many parts and
 * the window is long beside its steps, it is divided further in each half of the window, where balls are smaller. A body that
 * leaves its ball has all go back to where that window began, and it is halved. */
#include "fmurt_apart.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "fmurt_call.h"
#include "fmurt_pair.h"
#include "fmurt_passage.h"

/* The estimate is the error of order 2. Where nearly all parts are one group, steps are as good as common to all, and may be as long as those are. */
static const double largest_estimate = 1.0, largest_common_estimate = 1.5, nearly_all = 0.9;

/* A body's ball: its way at the greatest speed in its group and some more, what gravity adds, and a share of its size. */
static const double more_than_speed = 1.2, acceleration = 10.0, share_of_size = 2e-3;
/* Windows of so many steps and fewer are not divided further. */
static const double least_steps = 4.0;
/* The sum of two radii, by another order of the same numbers. */
static const double more_than_rounding = 1.0 + 1e-12;
/* How windows grow and shrink, by the largest group's share of all parts. */
static const double window_growth = 1.5, window_shrink = 0.6, large_share = 0.25;
/* The first window, by the shortest first step. */
static const double first_window = 16.0;
enum { LEVELS = 16 };
/* Numbers that tell a body's motion, at the beginning of what the model works in. */
static const size_t motion_size = 18;

typedef enum outcome { WENT, ESCAPED, STOPPED, STUCK, FAILED } outcome;

/* A window that is divided into groups. */
typedef struct level {
  int *order;     /* [part_count] the parts, group by group */
  int *group_end; /* [part_count] */
  int groups;
  double *center, *limit;   /* [3 * body_count], [body_count] balls */
  double *state, *slope;    /* [state_count] where it began */
  double *step, *estimate;  /* [part_count] there */
} level;

/* A body's ball: its extent along the first axis, its middle along the others. */
typedef struct item {
  double low, high, y, z, radius;
  int body, part;
} item;

struct fmurt_apart {
  fmurt_instance *instance;
  const fmurt_parts *parts;
  const fmurt_explicit_model *model; /* of the present advance */
  size_t state_count;
  int runs;           /* slopes and steps are known */
  double window;      /* that comes next */
  double shortest;    /* step */
  double largest;     /* step; 0: none */
  double steps, evaluations, rejected; /* done, as shares of what all parts do */
  double most_steps;
  int escaped_from; /* level of the ball that a body left */
  int is_told;      /* that a step could not be looked through */
  double *numbers;
  int *integers;
  /* By the states in the order of parts. */
  double *state, *slope[4], *next, *absolute;
  double *step, *estimate; /* of parts */
  double *radius, *m;      /* of bodies; what the model works in */
  double *reach, *speed;   /* of bodies */
  double *begin, *finish;  /* motions of bodies, as at the beginning of `m`, at both ends of a step */
  double *between;         /* [state_count] scratch: states within a step */
  double *full;            /* [state_count] in the model's order */
  double *fastest;         /* of parts: the greatest speed in the group of which it is the root */
  int *offset, *root, *number, *bodies, *all;
  item *items;
  level levels[LEVELS];
};

/* Hands out arrays of one block; with none, counts what they need. */
static double *take(double **numbers, size_t *count, size_t size) {
  double *const taken = *numbers == NULL ? NULL : *numbers + *count;
  *count += size;
  return taken;
}

static int *take_integers(int **integers, size_t *count, size_t size) {
  int *const taken = *integers == NULL ? NULL : *integers + *count;
  *count += size;
  return taken;
}

static void arrange(fmurt_apart *self, size_t *numbers, size_t *integers) {
  const size_t states = self->state_count, parts = (size_t)self->parts->part_count;
  const size_t bodies = (size_t)self->parts->body_count;
  double **block = &self->numbers;
  int **whole = &self->integers;
  *numbers = *integers = 0;
  self->state = take(block, numbers, states);
  for (int k = 0; k < 4; ++k) self->slope[k] = take(block, numbers, states);
  self->next = take(block, numbers, states);
  self->absolute = take(block, numbers, states);
  self->full = take(block, numbers, states);
  self->between = take(block, numbers, states);
  self->begin = take(block, numbers, motion_size * bodies);
  self->finish = take(block, numbers, motion_size * bodies);
  self->step = take(block, numbers, parts);
  self->estimate = take(block, numbers, parts);
  self->radius = take(block, numbers, bodies);
  self->reach = take(block, numbers, bodies);
  self->speed = take(block, numbers, bodies);
  self->fastest = take(block, numbers, parts);
  self->m = take(block, numbers, self->parts->memory_count);
  self->offset = take_integers(whole, integers, parts + 1);
  self->root = take_integers(whole, integers, parts);
  self->number = take_integers(whole, integers, parts);
  self->bodies = take_integers(whole, integers, bodies);
  self->all = take_integers(whole, integers, parts);
  for (int k = 0; k < LEVELS; ++k) {
    level *const here = &self->levels[k];
    here->center = take(block, numbers, 3 * bodies);
    here->limit = take(block, numbers, bodies);
    here->state = take(block, numbers, states);
    here->slope = take(block, numbers, states);
    here->step = take(block, numbers, parts);
    here->estimate = take(block, numbers, parts);
    here->order = take_integers(whole, integers, parts);
    here->group_end = take_integers(whole, integers, parts);
  }
}

fmurt_apart *fmurt_apart_create(fmurt_instance *instance) {
  fmurt_apart *self = calloc(1, sizeof *self);
  if (self == NULL) return NULL;
  self->instance = instance;
  self->parts = fmurt_model.parts;
  self->state_count = fmurt_model.state_count;
  size_t numbers, integers;
  arrange(self, &numbers, &integers);
  self->numbers = calloc(numbers, sizeof(double));
  self->integers = calloc(integers, sizeof(int));
  self->items = calloc((size_t)self->parts->body_count, sizeof(item));
  if (self->numbers == NULL || self->integers == NULL || self->items == NULL) {
    fmurt_apart_destroy(self);
    return NULL;
  }
  arrange(self, &numbers, &integers);
  for (int k = 0; k < self->parts->part_count; ++k) {
    self->offset[k + 1] = self->offset[k] + self->parts->part[k].kind->state_count;
    self->all[k] = k;
  }
  return self;
}

void fmurt_apart_destroy(fmurt_apart *self) {
  if (self == NULL) return;
  free(self->numbers);
  free(self->integers);
  free(self->items);
  free(self);
}

void fmurt_apart_restart(fmurt_apart *self) { self->runs = 0; }

/* -- the model -- */

typedef struct group_call {
  fmurt_apart *self;
  const int *group;
  int count, body_count; /* parts; bodies, fixed ones included, which are in self->bodies */
  const double *state;
  double *rate;
} group_call;

static fmurt_result move_bodies(fmurt_values *values, fmurt_apart *self, const int *group, int count, const double *state) {
  for (int k = 0; k < count; ++k) {
    const fmurt_part *part = &self->parts->part[group[k]];
    const int result = part->kind->motion(values, part->slot, part->body, state + self->offset[group[k]], self->m, NULL);
    if (result != FMURT_RESULT_OK) return (fmurt_result)result;
  }
  return FMURT_RESULT_OK;
}

static fmurt_result run_group(fmurt_values *values, void *context) {
  const group_call *call = context;
  fmurt_apart *self = call->self;
  int result = move_bodies(values, self, call->group, call->count, call->state);
  if (result == FMURT_RESULT_OK) result = self->parts->response(values, self->bodies, (size_t)call->body_count, self->m);
  for (int k = 0; k < call->count && result == FMURT_RESULT_OK; ++k) {
    const fmurt_part *part = &self->parts->part[call->group[k]];
    const int offset = self->offset[call->group[k]];
    result = part->kind->rates(values, part->slot, part->body, call->state + offset, self->m, call->rate + offset);
  }
  return (fmurt_result)result;
}

static fmurt_result run_prepare(fmurt_values *values, void *context) {
  fmurt_apart *self = context;
  int result = self->parts->prepare(values, self->m);
  if (result == FMURT_RESULT_OK) result = self->parts->radii(values, self->radius);
  if (result == FMURT_RESULT_OK) result = move_bodies(values, self, self->all, self->parts->part_count, self->state);
  return (fmurt_result)result;
}

static fmurt_result guarded(fmurt_apart *self, fmurt_result (*run)(fmurt_values *, void *), void *context) {
  fmurt_guarded call = {run, context};
  return fmurt_call_model(self->instance, FMURT_CALL_GUARDED, &call);
}

static int compare(const void *a, const void *b) { return *(const int *)a - *(const int *)b; }

/* Bodies of a group and those that never move, 1-based and ascending. */
static int list_bodies(fmurt_apart *self, const int *group, int count) {
  int listed = 0;
  for (int k = 0; k < count; ++k) {
    const fmurt_part *part = &self->parts->part[group[k]];
    for (int j = 0; j < part->kind->body_count; ++j) self->bodies[listed++] = part->body[j] + 1;
  }
  for (int k = 0; k < self->parts->fixed_count; ++k) self->bodies[listed++] = self->parts->fixed[k] + 1;
  qsort(self->bodies, (size_t)listed, sizeof(int), compare);
  return listed;
}

static const double *position_of(const fmurt_apart *self, int body) { return self->m + 3 * body; }

static double speed_of(const fmurt_apart *self, int body) {
  const double *v = self->m + 12 * self->parts->body_count + 3 * body;
  return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

static double distance(const double *a, const double *b) {
  const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
  return sqrt(x * x + y * y + z * z);
}

/* -- groups -- */

static int find_root(int *root, int part) {
  while (root[part] != part) part = root[part] = root[root[part]];
  return part;
}

static int compare_items(const void *a, const void *b) {
  const item *x = a, *y = b;
  return x->low < y->low ? -1 : x->low > y->low ? 1 : x->body - y->body;
}

/* The balls of the members' bodies, by the speeds that they may have. */
static int size_balls(fmurt_apart *self, const int *members, int count, double span) {
  int items = 0;
  for (int k = 0; k < count; ++k) {
    const fmurt_part *part = &self->parts->part[members[k]];
    for (int j = 0; j < part->kind->body_count; ++j) {
      const int body = part->body[j];
      const double room = isfinite(self->radius[body]) ? share_of_size * self->radius[body] : 0.0;
      self->reach[body] = more_than_speed * self->speed[body] * span + acceleration * span * span + room;
      const double all = self->radius[body] + self->reach[body];
      const double *const r = position_of(self, body);
      self->items[items++] = (item){r[0] - all, r[0] + all, r[1], r[2], all, body, members[k]};
    }
  }
  qsort(self->items, (size_t)items, sizeof(item), compare_items);
  return items;
}

/* Unites parts whose balls overlap; 1 if there are any that were not united. */
static int unite_near(fmurt_apart *self, int items) {
  int united = 0;
  for (int a = 0; a < items; ++a) {
    const item *one = &self->items[a];
    for (int b = a + 1; b < items && self->items[b].low <= one->high; ++b) {
      const item *other = &self->items[b];
      const double far = (one->radius + other->radius) * more_than_rounding;
      if (fabs(one->y - other->y) > far || fabs(one->z - other->z) > far) continue;
      const int root = find_root(self->root, one->part), other_root = find_root(self->root, other->part);
      if (root == other_root) continue;
      const double near = self->radius[one->body] + self->reach[one->body] + self->radius[other->body] + self->reach[other->body];
      if (!(distance(position_of(self, one->body), position_of(self, other->body)) < near)) continue;
      self->root[root] = other_root;
      united = 1;
    }
  }
  return united;
}

/* Lets each body be as fast as the fastest of its group, which may run into it; 1 if that is faster than before. */
static int share_speeds(fmurt_apart *self, const int *members, int count) {
  for (int k = 0; k < count; ++k) self->fastest[members[k]] = 0.0;
  for (int pass = 0; pass < 2; ++pass) {
    int rises = 0;
    for (int k = 0; k < count; ++k) {
      double *const fastest = &self->fastest[find_root(self->root, members[k])];
      const fmurt_part *part = &self->parts->part[members[k]];
      for (int j = 0; j < part->kind->body_count; ++j) {
        double *const speed = &self->speed[part->body[j]];
        if (pass == 0) {
          *fastest = fmax(*fastest, *speed);
        } else if (*speed < *fastest) {
          *speed = *fastest;
          rises = 1;
        }
      }
    }
    if (pass == 1) return rises;
  }
  return 0;
}

static void find_groups(fmurt_apart *self, level *here, const int *members, int count, double span) {
  for (int k = 0; k < count; ++k) {
    const fmurt_part *part = &self->parts->part[members[k]];
    self->root[members[k]] = members[k];
    for (int j = 0; j < part->kind->body_count; ++j) self->speed[part->body[j]] = speed_of(self, part->body[j]);
  }
  while (unite_near(self, size_balls(self, members, count, span)) && share_speeds(self, members, count)) {
  }
  here->groups = 0;
  for (int k = 0; k < count; ++k) {
    if (self->root[members[k]] == members[k]) {
      here->group_end[here->groups] = 0;
      self->number[members[k]] = here->groups++;
    }
  }
  for (int k = 0; k < count; ++k) ++here->group_end[self->number[find_root(self->root, members[k])]];
  for (int g = 0, sum = 0; g < here->groups; ++g) {
    const int size = here->group_end[g];
    here->group_end[g] = sum; /* its beginning; its end once all are placed */
    sum += size;
  }
  for (int k = 0; k < count; ++k) here->order[here->group_end[self->number[find_root(self->root, members[k])]]++] = members[k];
}

/* -- windows -- */

static void copy_parts(const fmurt_apart *self, const int *members, int count, double *target, const double *source) {
  for (int k = 0; k < count; ++k) {
    const size_t offset = (size_t)self->offset[members[k]];
    memcpy(target + offset, source + offset, (size_t)self->parts->part[members[k]].kind->state_count * sizeof(double));
  }
}

static void keep(fmurt_apart *self, level *here, const int *members, int count) {
  copy_parts(self, members, count, here->state, self->state);
  copy_parts(self, members, count, here->slope, self->slope[0]);
  for (int k = 0; k < count; ++k) {
    const fmurt_part *part = &self->parts->part[members[k]];
    here->step[members[k]] = self->step[members[k]];
    here->estimate[members[k]] = self->estimate[members[k]];
    for (int j = 0; j < part->kind->body_count; ++j) {
      const int body = part->body[j];
      memcpy(here->center + 3 * body, position_of(self, body), 3 * sizeof(double));
      here->limit[body] = here->groups > 1 ? self->reach[body] : HUGE_VAL;
    }
  }
}

static outcome go_back(fmurt_apart *self, const level *here, const int *members, int count) {
  copy_parts(self, members, count, self->state, here->state);
  copy_parts(self, members, count, self->slope[0], here->slope);
  for (int k = 0; k < count; ++k) {
    self->step[members[k]] = here->step[members[k]];
    self->estimate[members[k]] = here->estimate[members[k]];
  }
  return move_bodies(&self->instance->values, self, members, count, self->state) == FMURT_RESULT_OK ? WENT : FAILED;
}

/* The outermost level whose ball a body of the group has left; -1 if none. */
static int level_left(const fmurt_apart *self, int depth, const int *group, int count) {
  for (int d = 0; d <= depth; ++d) {
    const level *here = &self->levels[d];
    for (int k = 0; k < count; ++k) {
      const fmurt_part *part = &self->parts->part[group[k]];
      for (int j = 0; j < part->kind->body_count; ++j) {
        const int body = part->body[j];
        if (distance(position_of(self, body), here->center + 3 * body) > here->limit[body]) return d;
      }
    }
  }
  return -1;
}

/* A body passes no more than its radius in a step, so that it does not jump over another one. */
static double longest_step(const fmurt_apart *self, const int *group, int count) {
  double longest = self->largest > 0.0 ? self->largest : HUGE_VAL;
  for (int k = 0; k < count; ++k) {
    const fmurt_part *part = &self->parts->part[group[k]];
    for (int j = 0; j < part->kind->body_count; ++j) {
      const double speed = speed_of(self, part->body[j]);
      if (speed > 0.0 && self->radius[part->body[j]] > 0.0) longest = fmin(longest, self->radius[part->body[j]] / speed);
    }
  }
  return longest;
}

/* The states of the group at the end of a step, in `next`, and the slope there. */
static fmurt_result try_step(fmurt_apart *self, group_call *call, double step, double *error) {
  double *const *slope = self->slope, *const next = self->next, *const state = self->state;
  const double share = (double)call->count / self->parts->part_count;
  call->state = next;
  fmurt_result result = FMURT_RESULT_OK;
  for (int stage = 1; stage <= 3 && result == FMURT_RESULT_OK; ++stage) {
    for (int k = 0; k < call->count; ++k) {
      const int end = self->offset[call->group[k] + 1];
      for (int i = self->offset[call->group[k]]; i < end; ++i) {
        next[i] = fmurt_pair_place(stage, step, state[i], slope, (size_t)i);
      }
    }
    call->rate = slope[stage];
    self->evaluations += share;
    result = guarded(self, run_group, call);
  }
  if (result != FMURT_RESULT_OK) return result;
  double sum = 0.0;
  int states = 0;
  for (int k = 0; k < call->count; ++k) {
    const int begin = self->offset[call->group[k]], end = self->offset[call->group[k] + 1];
    for (int i = begin; i < end; ++i) {
      const double difference = fmurt_pair_difference(step, slope, (size_t)i);
      const double size = fmax(fabs(state[i]), fabs(next[i]));
      const double part = difference / (self->model->relative * size + self->absolute[i]);
      sum += part * part;
    }
    states += end - begin;
  }
  *error = sqrt(sum / states) / (share > nearly_all ? largest_common_estimate : largest_estimate);
  return FMURT_RESULT_OK;
}

/* Copies the motions of the bodies at hand from the model's memory. */
static void keep_motion(fmurt_apart *self, double *motion, int body_count) {
  static const size_t sizes[] = {3, 9, 3, 3};
  size_t offset = 0;
  for (size_t k = 0; k < sizeof sizes / sizeof *sizes; ++k) {
    for (int j = 0; j < body_count; ++j) {
      const size_t row = offset + sizes[k] * (size_t)(self->bodies[j] - 1);
      memcpy(motion + row, self->m + row, sizes[k] * sizeof(double));
    }
    offset += sizes[k] * (size_t)self->parts->body_count;
  }
}

/* A search for bodies of a group that pass through each other in a step. */
typedef struct passage_call {
  group_call group;
  double step;
  int pair[2];
  double number[3];
  int is_moved;
  int is_blind; /* the model could not be evaluated somewhere */
} passage_call;

static int motion_within(void *context, double share, double *motion) {
  passage_call *call = context;
  fmurt_apart *self = call->group.self;
  double *const *slope = self->slope;
  call->is_moved = 1;
  for (int k = 0; k < call->group.count; ++k) {
    const int end = self->offset[call->group.group[k] + 1];
    for (int i = self->offset[call->group.group[k]]; i < end; ++i) {
      self->between[i] = fmurt_between(share, call->step, self->state[i], slope[0][i], self->next[i], slope[3][i]);
    }
  }
  const fmurt_result result =
      move_bodies(&self->instance->values, self, call->group.group, call->group.count, self->between);
  memcpy(motion, self->m, motion_size * (size_t)self->parts->body_count * sizeof(double));
  if (result != FMURT_RESULT_OK) call->is_blind = 1;
  return result == FMURT_RESULT_OK ? 0 : -1;
}

static fmurt_result run_passage(fmurt_values *values, void *context) {
  passage_call *call = context;
  fmurt_apart *self = call->group.self;
  int result = self->parts->passage(values, self->bodies, (size_t)call->group.body_count, call->step, self->begin, self->finish,
                                    motion_within, call, call->pair, call->number);
  if (result == FMURT_RESULT_OK && call->is_moved) {
    result = move_bodies(values, self, call->group.group, call->group.count, self->next);
  }
  return (fmurt_result)result;
}

/* The share of a step that was tried in which no bodies pass through each other unseen; 0: all of it. */
static double unseen_share(fmurt_apart *self, const group_call *group, double step) {
  passage_call call = {.group = *group, .step = step};
  keep_motion(self, self->finish, group->body_count);
  const fmurt_result result = guarded(self, run_passage, &call);
  const int is_found = result == FMURT_RESULT_OK && call.pair[0] != 0;
  if (!is_found && (result != FMURT_RESULT_OK || call.is_blind)) {
    const double time = self->instance->values.time;
    fmurt_tell_unsearched(self->instance, time, time + step, &self->is_told);
  }
  if (!is_found) return 0.0;
  return fmin(fmax(call.number[0], DBL_EPSILON), 0.999);
}

/* Integrates a group over a time. */
static outcome integrate(fmurt_apart *self, int depth, const int *group, int count, double span) {
  group_call call = {self, group, count, list_bodies(self, group, count), NULL, NULL};
  const double share = (double)count / self->parts->part_count;
  keep_motion(self, self->begin, call.body_count);
  double next_step = HUGE_VAL, estimate = 1.0, growth = fmurt_pair_largest_growth, gone = 0.0;
  for (int k = 0; k < count; ++k) {
    if (self->step[group[k]] >= next_step) continue;
    next_step = self->step[group[k]];
    estimate = self->estimate[group[k]];
  }
  while (gone < span) {
    if (self->steps >= self->most_steps) return STOPPED;
    const double left = span - gone, allowed = fmin(next_step, longest_step(self, group, count));
    if (!(allowed > self->shortest) && left > self->shortest) return STUCK;
    const double step = allowed >= left ? left : allowed > 0.5 * left ? 0.5 * left : allowed;
    double error = HUGE_VAL;
    const fmurt_result result = try_step(self, &call, step, &error);
    if (result == FMURT_RESULT_ERROR) return FAILED;
    if (result != FMURT_RESULT_OK || !(error <= 1.0)) {
      self->rejected += share;
      next_step = fmurt_pair_after_failure(step, error);
      growth = 1.0;
      continue;
    }
    self->escaped_from = level_left(self, depth, group, count);
    if (self->escaped_from >= 0) return ESCAPED;
    const double seen = unseen_share(self, &call, step);
    if (seen > 0.0) {
      self->rejected += share;
      next_step = fmax(seen * step, 2.0 * self->shortest);
      growth = 1.0;
      continue;
    }
    keep_motion(self, self->begin, call.body_count);
    copy_parts(self, group, count, self->state, self->next);
    copy_parts(self, group, count, self->slope[0], self->slope[3]);
    gone = step == left ? span : gone + step;
    self->steps += share;
    error = fmax(error, fmurt_pair_least_estimate);
    const double permitted = fmurt_pair_permitted(step, growth, error, estimate);
    estimate = error;
    /* A step that was cut short tells little of how long the next one may be. */
    next_step = step < next_step ? fmax(next_step, permitted) : permitted;
    growth = fmurt_pair_largest_growth;
  }
  for (int k = 0; k < count; ++k) {
    self->step[group[k]] = next_step;
    self->estimate[group[k]] = estimate;
  }
  return WENT;
}

static double least_step(const fmurt_apart *self, const int *group, int count) {
  double least = HUGE_VAL;
  for (int k = 0; k < count; ++k) least = fmin(least, self->step[group[k]]);
  return least;
}

/* Integrates the members over a time, group by group. */
static outcome go(fmurt_apart *self, int depth, const int *members, int count, double span) {
  level *const here = &self->levels[depth];
  find_groups(self, here, members, count, span);
  keep(self, here, members, count);
  outcome result = WENT;
  for (int g = 0, begin = 0; g < here->groups && result == WENT; begin = here->group_end[g++]) {
    const int *const group = here->order + begin;
    const int size = here->group_end[g] - begin;
    if (size == 1 || depth + 1 == LEVELS || span <= least_steps * least_step(self, group, size)) {
      result = integrate(self, depth, group, size, span);
      continue;
    }
    result = go(self, depth + 1, group, size, 0.5 * span);
    if (result == WENT) result = go(self, depth + 1, group, size, 0.5 * span);
  }
  if (result != ESCAPED || self->escaped_from != depth) return result;
  result = go_back(self, here, members, count);
  if (result == WENT) result = go(self, depth, members, count, 0.5 * span);
  if (result == WENT) result = go(self, depth, members, count, 0.5 * span);
  return result;
}

/* -- all of them -- */

/* From the model's order to that of the parts, or back. */
static void gather(const fmurt_apart *self, double *packed, const double *state) {
  for (int k = 0; k < self->parts->part_count; ++k) {
    const fmurt_part *part = &self->parts->part[k];
    for (int i = 0; i < part->kind->state_count; ++i) packed[self->offset[k] + i] = state[part->state[i]];
  }
}

static void scatter(const fmurt_apart *self, double *state, const double *packed) {
  for (int k = 0; k < self->parts->part_count; ++k) {
    const fmurt_part *part = &self->parts->part[k];
    for (int i = 0; i < part->kind->state_count; ++i) state[part->state[i]] = packed[self->offset[k] + i];
  }
}

/* A first step in which a part's states change by a share of themselves. */
static double first_step(const fmurt_apart *self, int part, double way) {
  double sizes = 0.0, rates = 0.0;
  for (int i = self->offset[part]; i < self->offset[part + 1]; ++i) {
    const double tolerance = self->model->relative * fabs(self->state[i]) + self->absolute[i];
    const double size = self->state[i] / tolerance, rate = self->slope[0][i] / tolerance;
    sizes += size * size;
    rates += rate * rate;
  }
  return rates > 0.0 && sizes > 0.0 ? fmin(way, fmurt_pair_first_change * sqrt(sizes / rates)) : 1e-3 * way;
}

static fmurt_result begin(fmurt_apart *self, double time, const double *state, double way) {
  gather(self, self->state, state);
  fmurt_result result = guarded(self, run_prepare, self);
  self->evaluations += 1.0;
  if (result == FMURT_RESULT_OK) result = self->model->derivatives(self->model->context, time, state, self->full);
  if (result != FMURT_RESULT_OK) return result;
  gather(self, self->slope[0], self->full);
  double least = HUGE_VAL;
  for (int k = 0; k < self->parts->part_count; ++k) {
    self->step[k] = first_step(self, k, way);
    self->estimate[k] = 1.0;
    least = fmin(least, self->step[k]);
  }
  self->window = first_window * least;
  self->runs = 1;
  return FMURT_RESULT_OK;
}

/* The largest group's share decides how long the next window is. */
static void choose_window(fmurt_apart *self, double span) {
  const level *top = &self->levels[0];
  int largest = 0;
  for (int g = 0, begin = 0; g < top->groups; begin = top->group_end[g++]) {
    if (top->group_end[g] - begin > largest) largest = top->group_end[g] - begin;
  }
  if (largest > large_share * self->parts->part_count) {
    self->window = window_shrink * span;
  } else if (span >= self->window) {
    self->window *= window_growth;
  }
  self->window = fmax(self->window, least_steps * least_step(self, self->all, self->parts->part_count));
}

static fmurt_explicit_outcome meaning_of(outcome result) {
  return result == STOPPED ? FMURT_EXPLICIT_STOPPED : result == STUCK ? FMURT_EXPLICIT_STUCK : FMURT_EXPLICIT_ERROR;
}

fmurt_explicit_outcome fmurt_apart_advance(fmurt_apart *self, const fmurt_explicit_model *model, double *time, double *state,
                                           double end, double largest_step, fmurt_explicit_work allowed,
                                           fmurt_explicit_work *done) {
  self->model = model;
  self->largest = largest_step;
  self->shortest = fmurt_pair_least_roundings * DBL_EPSILON * fmax(fabs(*time), fabs(end));
  self->steps = self->evaluations = self->rejected = 0.0;
  self->most_steps = (double)allowed.steps;
  gather(self, self->absolute, model->absolute);
  fmurt_explicit_outcome result = FMURT_EXPLICIT_AT_END;
  if (!self->runs) {
    const fmurt_result begun = begin(self, *time, state, end - *time);
    if (begun != FMURT_RESULT_OK) result = begun == FMURT_RESULT_DISCARD ? FMURT_EXPLICIT_STUCK : FMURT_EXPLICIT_ERROR;
  }
  while (result == FMURT_EXPLICIT_AT_END && *time < end) {
    if (self->steps >= self->most_steps || self->evaluations >= (double)allowed.evaluations) {
      result = FMURT_EXPLICIT_STOPPED;
      break;
    }
    const double left = end - *time;
    const double span = self->window >= left ? left : self->window > 0.5 * left ? 0.5 * left : self->window;
    const outcome went = go(self, 0, self->all, self->parts->part_count, span);
    if (went != WENT) {
      self->runs = 0;
      result = meaning_of(went);
      break;
    }
    scatter(self, state, self->state);
    *time = span == left ? end : *time + span;
    choose_window(self, span);
    if (model->accepted == NULL) continue;
    self->evaluations += 1.0;
    if (model->derivatives(model->context, *time, state, self->full) == FMURT_RESULT_OK) model->accepted(model->context);
  }
  *done = (fmurt_explicit_work){(long)ceil(self->steps), (long)ceil(self->evaluations), (long)ceil(self->rejected)};
  return result;
}
