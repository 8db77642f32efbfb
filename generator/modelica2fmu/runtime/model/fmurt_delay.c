/* fmurt_delay.c - see fmurt_delay.h.
 *
 * Places in a delay's memory: how many points there are, the oldest of them, the time up to which jumps have returned,
 * the delay itself; then times, values and for each point whether an event has closed it. */
#include "fmurt_delay.h"

#include <math.h>

enum { COUNT, OLDEST, RETURNED, DELAY, POINTS };

static double *memory_of(const fmurt_values *values, int number) {
  return values->delay + (size_t)number * FMURT_DELAY_SIZE;
}

static int place(const double *memory, int i) { return ((int)memory[OLDEST] + i) % FMURT_DELAY_POINTS; }
static double *time_of(double *memory, int i) { return memory + POINTS + place(memory, i); }
static double *value_of(double *memory, int i) { return memory + POINTS + FMURT_DELAY_POINTS + place(memory, i); }
static double *is_closed(double *memory, int i) { return memory + POINTS + 2 * FMURT_DELAY_POINTS + place(memory, i); }

/* Smaller steps at events are none: two points so close in time tell nothing of a slope. */
static const double SMALLEST_JUMP = 1e-9;

/* What rounding may take from a time to which a delay was added. */
static double rounding(double time) { return 1e-12 * fmax(1.0, fabs(time)); }

static void append(double *memory, double time, double value) {
  if ((int)memory[COUNT] == FMURT_DELAY_POINTS) {
    memory[OLDEST] = (double)place(memory, 1);
    memory[COUNT] -= 1.0;
  }
  const int last = (int)memory[COUNT];
  memory[COUNT] += 1.0;
  *time_of(memory, last) = time;
  *value_of(memory, last) = value;
  *is_closed(memory, last) = 0.0;
}

static void note(double *memory, double time, double value, double longest) {
  while (memory[COUNT] > 0.0 && *time_of(memory, (int)memory[COUNT] - 1) > time) memory[COUNT] -= 1.0;
  const int count = (int)memory[COUNT];
  if (count > 0 && time - *time_of(memory, count - 1) <= rounding(time)) { /* the same time */
    const double change = fabs(value - *value_of(memory, count - 1));
    if (*is_closed(memory, count - 1) == 0.0) *value_of(memory, count - 1) = value;
    else if (change > SMALLEST_JUMP * fmax(1.0, fabs(value))) append(memory, *time_of(memory, count - 1), value);
    return;
  }
  /* A point between neighbours that are closer than need be makes way. */
  const int is_dense = count > 1 && *is_closed(memory, count - 1) == 0.0 && *is_closed(memory, count - 2) == 0.0 &&
                       time - *time_of(memory, count - 2) < longest / 1000.0;
  if (is_dense) memory[COUNT] = (double)(count - 1);
  append(memory, time, value);
}

/* Through the points first to last, at a time (Lagrange). */
static double polynomial(double *memory, int first, int last, double time) {
  double sum = 0.0;
  for (int i = first; i <= last; ++i) {
    double factor = *value_of(memory, i);
    for (int j = first; j <= last; ++j)
      if (j != i) factor *= (time - *time_of(memory, j)) / (*time_of(memory, i) - *time_of(memory, j));
    sum += factor;
  }
  return sum;
}

/* The value at a time; on the left of a jump there unless it has returned. */
static double value_at(double *memory, double time, int has_returned) {
  const int count = (int)memory[COUNT];
  const double margin = rounding(time);
  if (has_returned) {
    for (int i = count - 1; i > 0 && *time_of(memory, i) > time - margin; --i)
      if (*time_of(memory, i) == *time_of(memory, i - 1) && *time_of(memory, i) < time + margin)
        return *value_of(memory, i);
  }
  int low = 0, high = count - 1; /* the point low is before the time, or the first */
  if (time <= *time_of(memory, 0) || count == 1) return *value_of(memory, 0);
  while (high - low > 1) {
    const int middle = low + (high - low) / 2;
    if (*time_of(memory, middle) < time - (has_returned ? -margin : margin)) low = middle;
    else high = middle;
  }
  if (!(*time_of(memory, high) > *time_of(memory, low))) return *value_of(memory, high);
  int first = low, last = high;
  if (first > 0 && *time_of(memory, first - 1) < *time_of(memory, first)) --first;
  if (last < count - 1 && *time_of(memory, last + 1) > *time_of(memory, last)) ++last;
  return last - first == 3 ? polynomial(memory, first, last, time) : polynomial(memory, low, high, time);
}

double fmurt_delay(fmurt_values *values, int number, double expression, double delay, double longest) {
  double *memory = memory_of(values, number);
  note(memory, values->time, expression, longest);
  memory[DELAY] = delay;
  if (!(delay > 0.0)) return expression;
  const double time = values->time - delay;
  const int has_returned = memory[RETURNED] >= values->time - rounding(values->time);
  return value_at(memory, time, has_returned);
}

void fmurt_delay_close(fmurt_values *values) {
  for (size_t k = 0; k < fmurt_model.delay_count; ++k) {
    double *memory = memory_of(values, (int)k);
    const int count = (int)memory[COUNT];
    if (count > 0 && *time_of(memory, count - 1) == values->time) *is_closed(memory, count - 1) = 1.0;
  }
}

void fmurt_delay_event(fmurt_values *values) {
  for (size_t k = 0; k < fmurt_model.delay_count; ++k) {
    double *memory = memory_of(values, (int)k);
    const int count = (int)memory[COUNT];
    if (count == 0) continue;
    memory[RETURNED] = values->time;
    for (int i = count - 1; i > 0; --i) {
      const double back = *time_of(memory, i) + memory[DELAY];
      if (back <= values->time + rounding(values->time)) break;
      if (*time_of(memory, i) == *time_of(memory, i - 1) && back < values->next_time_event)
        values->next_time_event = back;
    }
  }
}
