/* fmi3_values.c - FMI 3.0.2, what is asked by value reference: getting, setting and directional derivatives.
 *
 * FMI 3.0 has one numbering for all variables: the uppermost four bits of a value reference say what it is, the next
 * six tell variables of one slot apart, the others are the slot (packaging/fmi3_description.py writes them). */
#include <stdio.h>
#include <stdlib.h>

#include "fmurt_approach.h"
#include "fmurt_fmu.h"
#include "fmi3Functions.h"

enum { KIND_SHIFT = 28, SLOT_BITS = 22 };

typedef enum reference_kind {
  KIND_REAL,
  KIND_INTEGER,
  KIND_BOOLEAN,
  KIND_STRING,
  KIND_SOLVER_REAL,
  KIND_SOLVER_INTEGER,
  KIND_INDICATOR,
  KIND_TIME,
  KIND_NONE = 16 /* no reference has it */
} reference_kind;

static unsigned kind_of(fmi3ValueReference reference) { return reference >> KIND_SHIFT; }

static unsigned slot_of(fmi3ValueReference reference) { return reference & ((1u << SLOT_BITS) - 1u); }

static int counts_agree(fmi3Instance c, const char *call, size_t references, size_t values) {
  if (!fmurt_fmu_permits(c, call, FMURT_ANY_PHASE)) return 0;
  if (references == values) return 1;
  fmurt_fmu_refuse(c, call, "the numbers of value references and values differ");
  return 0;
}

static size_t slot_count(reference_kind kind) {
  switch (kind) {
    case KIND_REAL: return fmurt_model.real_count;
    case KIND_INTEGER: return fmurt_model.integer_count;
    case KIND_BOOLEAN: return fmurt_model.boolean_count;
    case KIND_STRING: return fmurt_model.string_count;
    case KIND_SOLVER_REAL: return FMURT_SOLVER_REAL_COUNT;
    case KIND_SOLVER_INTEGER: return FMURT_SOLVER_INTEGER_COUNT;
    case KIND_INDICATOR: return fmurt_shown_indicator_count();
    case KIND_TIME: return 1;
    case KIND_NONE: break;
  }
  return 0;
}

static int is_of_kind(fmi3ValueReference reference, reference_kind kind) {
  return kind_of(reference) == (unsigned)kind && slot_of(reference) < slot_count(kind);
}

static void refuse_reference(fmi3Instance c, const char *call, fmi3ValueReference reference) {
  char reason[80];
  snprintf(reason, sizeof reason, "value reference %u is not one of a variable for this function", reference);
  fmurt_fmu_refuse(c, call, reason);
}

/* The slots behind references of one kind, or of the solver's variables of that type, in a new array. NULL (logged) if
 * one is of another kind, memory is short or a pointer is missing. */
static unsigned *slots(fmi3Instance c, const char *call, const fmi3ValueReference *reference, size_t count,
                       reference_kind kind, reference_kind solver_kind) {
  unsigned *slot = reference != NULL ? malloc((count + 1) * sizeof *slot) : NULL;
  if (slot == NULL) {
    fmurt_fmu_refuse(c, call, reference == NULL ? "null pointer" : "no memory");
    return NULL;
  }
  for (size_t i = 0; i < count; ++i) {
    if (is_of_kind(reference[i], kind)) {
      slot[i] = slot_of(reference[i]);
    } else if (is_of_kind(reference[i], solver_kind)) {
      slot[i] = FMURT_SOLVER_FIRST_REFERENCE + slot_of(reference[i]);
    } else {
      refuse_reference(c, call, reference[i]);
      free(slot);
      return NULL;
    }
  }
  return slot;
}

/* Begins a call on variables of one type: their slots, or NULL where there is nothing to do or the call is refused, with the
 * status to return. */
static unsigned *open_slots(fmi3Instance c, const char *call, const fmi3ValueReference *reference, size_t count,
                            size_t value_count, reference_kind kind, reference_kind solver_kind, fmi3Status *status) {
  *status = fmi3Error;
  if (!counts_agree(c, call, count, value_count)) return NULL;
  if (count > 0) return slots(c, call, reference, count, kind, solver_kind);
  *status = fmi3OK;
  return NULL;
}

static fmi3Status close_slots(unsigned *slot, fmurt_fmu_status status) {
  free(slot);
  return (fmi3Status)status;
}

static fmurt_fmu_status get_float(fmi3Instance c, const char *call, fmi3ValueReference reference, double *value) {
  const unsigned slot = slot_of(reference);
  if (is_of_kind(reference, KIND_INDICATOR)) return fmurt_fmu_get_indicator(c, call, slot, value);
  if (is_of_kind(reference, KIND_REAL)) return fmurt_fmu_get_real(c, call, &slot, 1, value);
  if (is_of_kind(reference, KIND_SOLVER_REAL)) {
    const unsigned option = FMURT_SOLVER_FIRST_REFERENCE + slot;
    return fmurt_fmu_get_real(c, call, &option, 1, value);
  }
  if (is_of_kind(reference, KIND_TIME)) {
    *value = ((fmurt_fmu *)c)->instance->values.time;
    return FMURT_FMU_OK;
  }
  refuse_reference(c, call, reference);
  return FMURT_FMU_ERROR;
}

fmi3Status fmi3GetFloat64(fmi3Instance c, const fmi3ValueReference reference[], size_t count, fmi3Float64 value[],
                          size_t value_count) {
  if (!counts_agree(c, __func__, count, value_count)) return fmi3Error;
  if (count > 0 && (reference == NULL || value == NULL))
    return (fmi3Status)fmurt_fmu_refuse(c, __func__, "null pointer");
  fmurt_fmu_status status = FMURT_FMU_OK;
  for (size_t i = 0; i < count && status == FMURT_FMU_OK; ++i) status = get_float(c, __func__, reference[i], &value[i]);
  return (fmi3Status)status;
}

fmi3Status fmi3SetFloat64(fmi3Instance c, const fmi3ValueReference reference[], size_t count, const fmi3Float64 value[],
                          size_t value_count) {
  fmi3Status status;
  unsigned *slot = open_slots(c, __func__, reference, count, value_count, KIND_REAL, KIND_SOLVER_REAL, &status);
  return slot == NULL ? status : close_slots(slot, fmurt_fmu_set_real(c, __func__, slot, count, value));
}

fmi3Status fmi3GetInt32(fmi3Instance c, const fmi3ValueReference reference[], size_t count, fmi3Int32 value[],
                        size_t value_count) {
  fmi3Status status;
  unsigned *slot = open_slots(c, __func__, reference, count, value_count, KIND_INTEGER, KIND_SOLVER_INTEGER, &status);
  return slot == NULL ? status : close_slots(slot, fmurt_fmu_get_integer(c, __func__, slot, count, value));
}

fmi3Status fmi3SetInt32(fmi3Instance c, const fmi3ValueReference reference[], size_t count, const fmi3Int32 value[],
                        size_t value_count) {
  fmi3Status status;
  unsigned *slot = open_slots(c, __func__, reference, count, value_count, KIND_INTEGER, KIND_SOLVER_INTEGER, &status);
  return slot == NULL ? status : close_slots(slot, fmurt_fmu_set_integer(c, __func__, slot, count, value));
}

/* Enumerations are 64-bit in FMI 3.0. */
fmi3Status fmi3GetInt64(fmi3Instance c, const fmi3ValueReference reference[], size_t count, fmi3Int64 value[],
                        size_t value_count) {
  if (!counts_agree(c, __func__, count, value_count)) return fmi3Error;
  if (count > 0 && value == NULL) return (fmi3Status)fmurt_fmu_refuse(c, __func__, "null pointer");
  fmi3Status status = fmi3OK;
  for (size_t i = 0; i < count && status == fmi3OK; ++i) {
    fmi3Int32 narrow = 0;
    status = fmi3GetInt32(c, reference != NULL ? &reference[i] : NULL, 1, &narrow, 1);
    value[i] = narrow;
  }
  return status;
}

fmi3Status fmi3SetInt64(fmi3Instance c, const fmi3ValueReference reference[], size_t count, const fmi3Int64 value[],
                        size_t value_count) {
  if (!counts_agree(c, __func__, count, value_count)) return fmi3Error;
  if (count == 0) return fmi3OK;
  if (value == NULL) return (fmi3Status)fmurt_fmu_refuse(c, __func__, "null pointer");
  fmi3Int32 *narrow = malloc(count * sizeof *narrow);
  if (narrow == NULL) return (fmi3Status)fmurt_fmu_refuse(c, __func__, "no memory");
  fmi3Status status = fmi3OK;
  for (size_t i = 0; i < count && status == fmi3OK; ++i) {
    narrow[i] = (fmi3Int32)value[i];
    if (narrow[i] != value[i]) status = (fmi3Status)fmurt_fmu_refuse(c, __func__, "the value is out of range");
  }
  if (status == fmi3OK) status = fmi3SetInt32(c, reference, count, narrow, count);
  free(narrow);
  return status;
}

fmi3Status fmi3GetBoolean(fmi3Instance c, const fmi3ValueReference reference[], size_t count, fmi3Boolean value[],
                          size_t value_count) {
  if (!counts_agree(c, __func__, count, value_count)) return fmi3Error;
  if (count == 0) return fmi3OK;
  if (value == NULL) return (fmi3Status)fmurt_fmu_refuse(c, __func__, "null pointer");
  unsigned *slot = slots(c, __func__, reference, count, KIND_BOOLEAN, KIND_NONE);
  if (slot == NULL) return fmi3Error;
  fmurt_fmu_status status = FMURT_FMU_OK;
  for (size_t i = 0; i < count && status == FMURT_FMU_OK; ++i) {
    int truth = 0;
    status = fmurt_fmu_get_boolean(c, __func__, &slot[i], 1, &truth);
    value[i] = truth != 0;
  }
  free(slot);
  return (fmi3Status)status;
}

fmi3Status fmi3SetBoolean(fmi3Instance c, const fmi3ValueReference reference[], size_t count, const fmi3Boolean value[],
                          size_t value_count) {
  if (!counts_agree(c, __func__, count, value_count)) return fmi3Error;
  if (count == 0) return fmi3OK;
  if (value == NULL) return (fmi3Status)fmurt_fmu_refuse(c, __func__, "null pointer");
  unsigned *slot = slots(c, __func__, reference, count, KIND_BOOLEAN, KIND_NONE);
  int *truth = malloc(count * sizeof *truth);
  fmurt_fmu_status status = FMURT_FMU_ERROR;
  if (truth == NULL) {
    fmurt_fmu_refuse(c, __func__, "no memory");
  } else if (slot != NULL) {
    for (size_t i = 0; i < count; ++i) truth[i] = value[i];
    status = fmurt_fmu_set_boolean(c, __func__, slot, count, truth);
  }
  free(slot);
  free(truth);
  return (fmi3Status)status;
}

fmi3Status fmi3GetString(fmi3Instance c, const fmi3ValueReference reference[], size_t count, fmi3String value[],
                         size_t value_count) {
  fmi3Status status;
  unsigned *slot = open_slots(c, __func__, reference, count, value_count, KIND_STRING, KIND_NONE, &status);
  return slot == NULL ? status : close_slots(slot, fmurt_fmu_get_string(c, __func__, slot, count, value));
}

fmi3Status fmi3SetString(fmi3Instance c, const fmi3ValueReference reference[], size_t count, const fmi3String value[],
                         size_t value_count) {
  fmi3Status status;
  unsigned *slot = open_slots(c, __func__, reference, count, value_count, KIND_STRING, KIND_NONE, &status);
  return slot == NULL ? status : close_slots(slot, fmurt_fmu_set_string(c, __func__, slot, count, value));
}

fmi3Status fmi3GetDirectionalDerivative(fmi3Instance c, const fmi3ValueReference unknown[], size_t unknown_count,
                                        const fmi3ValueReference known[], size_t known_count, const fmi3Float64 seed[],
                                        size_t seed_count, fmi3Float64 sensitivity[], size_t sensitivity_count) {
  if (!counts_agree(c, __func__, unknown_count, sensitivity_count) ||
      !counts_agree(c, __func__, known_count, seed_count)) {
    return fmi3Error;
  }
  if (unknown_count == 0) return fmi3OK;
  if (known == NULL && known_count == 0) known = unknown; /* not read */
  unsigned *unknown_slot = slots(c, __func__, unknown, unknown_count, KIND_REAL, KIND_NONE);
  unsigned *known_slot = unknown_slot != NULL ? slots(c, __func__, known, known_count, KIND_REAL, KIND_NONE) : NULL;
  fmurt_fmu_status status = FMURT_FMU_ERROR;
  if (known_slot != NULL) {
    status = fmurt_fmu_directional_derivative(c, __func__, unknown_slot, unknown_count, known_slot, known_count, seed,
                                              sensitivity);
  }
  free(unknown_slot);
  free(known_slot);
  return (fmi3Status)status;
}
