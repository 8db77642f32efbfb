/* fmurt_integer.c - values of Integers for generated code. */
#include <limits.h>
#include <math.h>
#include <stdio.h>

#include "fmurt_model.h"

fmurt_result fmurt_round_integer(fmurt_values *values, int *target, double value, const char *name) {
  if (fabs(value) <= INT_MAX) { /* false for NaN */
    *target = (int)lrint(value);
    return FMURT_RESULT_OK;
  }
  char message[256];
  snprintf(message, sizeof message, "the Integer %.100s would be %.10g, beyond the largest, %d", name, value, INT_MAX);
  fmurt_report_error(values, message);
  return FMURT_RESULT_DISCARD;
}
