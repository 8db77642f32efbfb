/* fmurt_instance.c - memory and start values of an instance, and its log. */
#include "fmurt_instance.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fmurt_dead_center.h"
#include "fmurt_delay.h"

const char *const fmurt_log_category_name[FMURT_LOG_CATEGORY_COUNT] = {
    "logEvents", "logSolver", "logStatusWarning", "logStatusDiscard", "logStatusError", "logAll"};

static char *duplicate(const char *text) {
  const size_t size = strlen(text) + 1;
  char *copy = malloc(size);
  if (copy != NULL) memcpy(copy, text, size);
  return copy;
}

static double *take_doubles(double **next, size_t count) {
  double *taken = *next;
  *next += count;
  return taken;
}

static int *take_ints(int **next, size_t count) {
  int *taken = *next;
  *next += count;
  return taken;
}

/* One block for all doubles and one for all ints; calloc of at least one element never asks for size 0. */
static int allocate_arrays(fmurt_instance *instance) {
  const size_t reals = fmurt_model.real_count, integers = fmurt_model.integer_count,
               booleans = fmurt_model.boolean_count;
  const size_t delays = fmurt_model.delay_count * FMURT_DELAY_SIZE;
  instance->double_block_count = 4 * reals + fmurt_model.state_count + fmurt_model.work_count + delays +
                                 fmurt_accepted_size() + fmurt_history_size(fmurt_model.followed_count) + fmurt_solved_size();
  instance->int_block_count =
      5 * integers + 5 * booleans + reals + 2 * fmurt_model.indicator_count + fmurt_model.integer_work_count;
  instance->double_block = calloc(instance->double_block_count + 1, sizeof(double));
  instance->int_block = calloc(instance->int_block_count + 1, sizeof(int));
  instance->string = calloc(fmurt_model.string_count + 1, sizeof(char *));
  instance->start_string = calloc(fmurt_model.string_count + 1, sizeof(char *));
  instance->values.string = calloc(fmurt_model.string_count + 1, sizeof(char *));
  instance->indicator = calloc(fmurt_model.indicator_count + 1, sizeof(double));
  instance->scratch = calloc(reals + 1, sizeof(double));
  instance->chatter.changes = calloc(fmurt_model.indicator_count + 1, sizeof(int));
  if (instance->double_block == NULL || instance->int_block == NULL || instance->string == NULL ||
      instance->start_string == NULL || instance->values.string == NULL || instance->indicator == NULL ||
      instance->scratch == NULL || instance->chatter.changes == NULL) {
    return 0;
  }

  double *next_double = instance->double_block;
  instance->values.real = take_doubles(&next_double, reals);
  instance->values.pre_real = take_doubles(&next_double, reals);
  instance->start_real = take_doubles(&next_double, reals);
  instance->set_real = take_doubles(&next_double, reals);
  instance->values.state_nominal = take_doubles(&next_double, fmurt_model.state_count);
  instance->values.work = take_doubles(&next_double, fmurt_model.work_count);
  instance->values.delay = take_doubles(&next_double, delays);
  instance->values.accepted = take_doubles(&next_double, fmurt_accepted_size());
  instance->values.history = fmurt_history_in(
      take_doubles(&next_double, fmurt_history_size(fmurt_model.followed_count)), fmurt_model.followed_count);
  instance->solved = take_doubles(&next_double, fmurt_solved_size());

  int *next_int = instance->int_block;
  instance->values.integer = take_ints(&next_int, integers);
  instance->values.pre_integer = take_ints(&next_int, integers);
  instance->start_integer = take_ints(&next_int, integers);
  instance->set_integer = take_ints(&next_int, integers);
  instance->integer_is_set = take_ints(&next_int, integers);
  instance->values.boolean = take_ints(&next_int, booleans);
  instance->values.pre_boolean = take_ints(&next_int, booleans);
  instance->start_boolean = take_ints(&next_int, booleans);
  instance->set_boolean = take_ints(&next_int, booleans);
  instance->boolean_is_set = take_ints(&next_int, booleans);
  instance->real_is_set = take_ints(&next_int, reals);
  instance->values.relation = take_ints(&next_int, fmurt_model.indicator_count);
  instance->crossed = take_ints(&next_int, fmurt_model.indicator_count);
  instance->values.integer_work = take_ints(&next_int, fmurt_model.integer_work_count);
  return 1;
}

fmurt_instance *fmurt_instance_create(const char *name, fmurt_kind kind, fmurt_log_sink sink, void *receiver) {
  fmurt_instance *instance = calloc(1, sizeof *instance);
  if (instance == NULL) return NULL;
  instance->kind = kind;
  instance->sink = sink;
  instance->receiver = receiver;
  instance->values.host = instance;
  instance->name = duplicate(name);
  if (instance->name == NULL || !allocate_arrays(instance) || fmurt_instance_reset(instance) != FMURT_RESULT_OK) {
    fmurt_instance_destroy(instance);
    return NULL;
  }
  return instance;
}

static void destroy_solver(fmurt_instance *instance) {
  if (instance->solver != NULL) instance->destroy_solver(instance->solver);
  instance->solver = NULL;
}

static void destroy_approach(fmurt_instance *instance) {
  if (instance->approach != NULL) instance->destroy_approach(instance->approach);
  instance->approach = NULL;
}

void fmurt_instance_destroy(fmurt_instance *instance) {
  if (instance == NULL) return;
  destroy_solver(instance);
  destroy_approach(instance);
  for (size_t i = 0; i < fmurt_model.string_count; ++i) {
    if (instance->string != NULL) free(instance->string[i]);
    if (instance->start_string != NULL) free(instance->start_string[i]);
  }
  free(instance->string);
  free(instance->start_string);
  free((void *)instance->values.string);
  free(instance->double_block);
  free(instance->int_block);
  free(instance->jacobian);
  free(instance->indicator);
  free(instance->scratch);
  free(instance->chatter.changes);
  free(instance->name);
  free(instance);
}

static void copy_doubles(double *target, const double *source, size_t count) {
  if (count > 0) memcpy(target, source, count * sizeof *target);
}

static void copy_ints(int *target, const int *source, size_t count) {
  if (count > 0) memcpy(target, source, count * sizeof *target);
}

fmurt_result fmurt_instance_reset(fmurt_instance *instance) {
  destroy_solver(instance);
  destroy_approach(instance);
  memset(instance->double_block, 0, instance->double_block_count * sizeof(double));
  memset(instance->int_block, 0, instance->int_block_count * sizeof(int));
  copy_doubles(instance->start_real, fmurt_model.real_start, fmurt_model.real_count);
  copy_doubles(instance->values.state_nominal, fmurt_model.state_nominal, fmurt_model.state_count);
  copy_ints(instance->start_integer, fmurt_model.integer_start, fmurt_model.integer_count);
  copy_ints(instance->start_boolean, fmurt_model.boolean_start, fmurt_model.boolean_count);
  copy_doubles(instance->values.real, instance->start_real, fmurt_model.real_count);
  copy_ints(instance->values.integer, instance->start_integer, fmurt_model.integer_count);
  copy_ints(instance->values.boolean, instance->start_boolean, fmurt_model.boolean_count);
  for (size_t i = 0; i < fmurt_model.string_count; ++i) {
    const char *start = fmurt_model.string_start[i] != NULL ? fmurt_model.string_start[i] : "";
    char *copy = duplicate(start);
    if (copy == NULL || fmurt_set_string(instance, i, start) != FMURT_RESULT_OK) {
      free(copy);
      return FMURT_RESULT_ERROR;
    }
    free(instance->start_string[i]);
    instance->start_string[i] = copy;
  }

  memset(&instance->situation, 0, sizeof instance->situation);
  instance->situation.phase = FMURT_PHASE_INSTANTIATED;
  instance->situation.parameters_stale = 1;
  instance->situation.initialization_stale = 1;
  instance->situation.continuous_stale = 1;
  instance->situation.settings.start_time = fmurt_interface_tables.start_time;
  instance->situation.settings.stop_time = HUGE_VAL;
  instance->situation.solver_real[FMURT_SOLVER_RELATIVE_TOLERANCE] = fmurt_interface_tables.relative_tolerance;
  instance->situation.solver_real[FMURT_SOLVER_ABSOLUTE_TOLERANCE] = fmurt_interface_tables.absolute_tolerance;
  instance->situation.solver_real[FMURT_SOLVER_MAXIMUM_STEP] = fmurt_interface_tables.maximum_step;
  instance->situation.solver_integer[FMURT_SOLVER_MAXIMUM_STEPS] = fmurt_interface_tables.maximum_steps;
  instance->values.time = instance->situation.settings.start_time;
  instance->values.next_time_event = HUGE_VAL;
  instance->values.initial = 0;
  instance->values.terminal = 0;
  instance->values.terminate = 0;
  instance->chatter.events = 0;
  instance->at_event = 0;
  instance->jacobian_is_current = 0;
  instance->message[0] = '\0';
  return FMURT_RESULT_OK;
}

void fmurt_log(fmurt_instance *instance, fmurt_severity severity, fmurt_log_category category, const char *format,
               ...) {
  if (severity == FMURT_LOG_DEBUG && !instance->logged[category] && !instance->logged[FMURT_LOG_ALL]) return;
  if (instance->sink == NULL) return;
  char message[2048];
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(message, sizeof message, format, arguments);
  va_end(arguments);
  instance->sink(instance->receiver, instance->name, severity, category, message);
}

const char *fmurt_slot_name(const fmurt_slot_table *table, size_t slot) {
  return slot < table->count && table->name != NULL && table->name[slot] != NULL ? table->name[slot] : "?";
}

fmurt_result fmurt_set_string(fmurt_instance *instance, size_t slot, const char *text) {
  char *copy = duplicate(text);
  if (copy == NULL) return FMURT_RESULT_ERROR;
  free(instance->string[slot]);
  instance->string[slot] = copy;
  instance->values.string[slot] = copy;
  return FMURT_RESULT_OK;
}

void fmurt_invalidate(fmurt_instance *instance, int parameter_changed) {
  if (parameter_changed) instance->situation.parameters_stale = 1;
  instance->situation.initialization_stale = 1;
  instance->situation.continuous_stale = 1;
}
