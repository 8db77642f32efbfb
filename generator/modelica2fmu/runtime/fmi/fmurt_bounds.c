/* fmurt_bounds.c - see fmurt_bounds.h. */
#include "fmurt_bounds.h"

#include <stdio.h>

/* The bounds of a slot, which are in order; NULL if it has none. */
static const fmurt_bounds *find(const fmurt_slot_table *table, unsigned slot) {
  size_t first = 0, end = table->bounds_count;
  while (first < end) {
    const size_t middle = first + (end - first) / 2;
    if (table->bounds[middle].slot == slot) return &table->bounds[middle];
    if (table->bounds[middle].slot < slot) {
      first = middle + 1;
    } else {
      end = middle;
    }
  }
  return NULL;
}

fmurt_result fmurt_check_bounds(fmurt_instance *instance, const fmurt_slot_table *table, unsigned slot, double value) {
  const fmurt_bounds *bounds = find(table, slot);
  if (bounds == NULL) return FMURT_RESULT_OK;
  const int below = value < bounds->least;
  if (!below && !(value > bounds->largest)) return FMURT_RESULT_OK;
  snprintf(instance->message, sizeof instance->message, "%s cannot be set to %.15g: its %s is %.15g",
           fmurt_slot_name(table, slot), value, below ? "min" : "max", below ? bounds->least : bounds->largest);
  return FMURT_RESULT_ERROR;
}
