/* fmi3_functions.c - FMI 3.0.2, model exchange and co-simulation, over fmurt_fmu.h.
 *
 * FMI 3.0 has one numbering for all variables: the uppermost four bits of a value reference say what it is, the next
 * six tell variables of one slot apart, the others are the slot (packaging/fmi3_description.py writes them). */
#include <stdio.h>
#include <stdlib.h>

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

typedef struct component {
  fmurt_fmu fmu; /* first, so that a pointer to it is one to the component */
  fmi3InstanceEnvironment environment;
  fmi3LogMessageCallback log_message;
} component;

static unsigned kind_of(fmi3ValueReference reference) { return reference >> KIND_SHIFT; }

static unsigned slot_of(fmi3ValueReference reference) { return reference & ((1u << SLOT_BITS) - 1u); }

/* -- life -- */

static void log_to_importer(void *receiver, const char *instance_name, fmurt_severity severity,
                            fmurt_log_category category, const char *message) {
  static const fmi3Status status[] = {[FMURT_LOG_DEBUG] = fmi3OK,
                                      [FMURT_LOG_WARNING] = fmi3Warning,
                                      [FMURT_LOG_DISCARD] = fmi3Discard,
                                      [FMURT_LOG_ERROR] = fmi3Error};
  const component *c = receiver;
  (void)instance_name;
  if (c->log_message != NULL) {
    c->log_message(c->environment, status[severity], fmurt_log_category_name[category], message);
  }
}

const char *fmi3GetVersion(void) { return fmi3Version; }

fmi3Status fmi3SetDebugLogging(fmi3Instance c, fmi3Boolean on, size_t count, const fmi3String categories[]) {
  return (fmi3Status)fmurt_fmu_set_logging(c, __func__, on, count, categories);
}

static fmi3Instance instantiate(component prototype, fmi3String name, fmi3String token, fmi3Boolean logging_on) {
  component *c = malloc(sizeof *c);
  const char *problem = "no memory";
  if (c != NULL) {
    *c = prototype;
    problem = fmurt_fmu_open(&c->fmu, name, token, logging_on, log_to_importer, c);
  }
  if (problem == NULL) return c;
  free(c);
  if (prototype.log_message != NULL) {
    prototype.log_message(prototype.environment, fmi3Error, fmurt_log_category_name[FMURT_LOG_STATUS_ERROR], problem);
  }
  return NULL;
}

fmi3Instance fmi3InstantiateModelExchange(fmi3String name, fmi3String token, fmi3String resource_path,
                                          fmi3Boolean visible, fmi3Boolean logging_on,
                                          fmi3InstanceEnvironment environment, fmi3LogMessageCallback log_message) {
  (void)resource_path;
  (void)visible;
  const component prototype = {.environment = environment, .log_message = log_message};
  return instantiate(prototype, name, token, logging_on);
}

fmi3Instance fmi3InstantiateCoSimulation(fmi3String name, fmi3String token, fmi3String resource_path,
                                         fmi3Boolean visible, fmi3Boolean logging_on, fmi3Boolean event_mode_used,
                                         fmi3Boolean early_return_allowed,
                                         const fmi3ValueReference intermediate_variables[], size_t intermediate_count,
                                         fmi3InstanceEnvironment environment, fmi3LogMessageCallback log_message,
                                         fmi3IntermediateUpdateCallback intermediate_update) {
  (void)resource_path;
  (void)visible;
  (void)intermediate_variables;
  (void)intermediate_count;
  (void)intermediate_update;
  const component prototype = {
      .fmu = {.co_simulation = 1, .event_mode_used = event_mode_used, .early_return_allowed = early_return_allowed},
      .environment = environment,
      .log_message = log_message};
  return instantiate(prototype, name, token, logging_on);
}

fmi3Instance fmi3InstantiateScheduledExecution(fmi3String name, fmi3String token, fmi3String resource_path,
                                               fmi3Boolean visible, fmi3Boolean logging_on,
                                               fmi3InstanceEnvironment environment, fmi3LogMessageCallback log_message,
                                               fmi3ClockUpdateCallback clock_update, fmi3LockPreemptionCallback lock,
                                               fmi3UnlockPreemptionCallback unlock) {
  (void)name;
  (void)token;
  (void)resource_path;
  (void)visible;
  (void)logging_on;
  (void)clock_update;
  (void)lock;
  (void)unlock;
  if (log_message != NULL) {
    log_message(environment, fmi3Error, fmurt_log_category_name[FMURT_LOG_STATUS_ERROR],
                "this FMU is for model exchange and co-simulation");
  }
  return NULL;
}

void fmi3FreeInstance(fmi3Instance c) {
  if (c == NULL) return;
  fmurt_fmu_close(c);
  free(c);
}

fmi3Status fmi3EnterInitializationMode(fmi3Instance c, fmi3Boolean tolerance_defined, fmi3Float64 tolerance,
                                       fmi3Float64 start_time, fmi3Boolean stop_time_defined, fmi3Float64 stop_time) {
  const fmurt_fmu_status status =
      fmurt_fmu_set_experiment(c, __func__, tolerance_defined, tolerance, start_time, stop_time_defined, stop_time);
  return (fmi3Status)(status == FMURT_FMU_OK ? fmurt_fmu_enter_initialization(c, __func__) : status);
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance c) { return (fmi3Status)fmurt_fmu_exit_initialization(c, __func__); }

fmi3Status fmi3Terminate(fmi3Instance c) { return (fmi3Status)fmurt_fmu_terminate(c, __func__); }

fmi3Status fmi3Reset(fmi3Instance c) { return (fmi3Status)fmurt_fmu_reset(c, __func__); }

/* -- values -- */

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
    case KIND_INDICATOR: return fmurt_model.indicator_count;
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
  if (!counts_agree(c, __func__, count, value_count)) return fmi3Error;
  if (count == 0) return fmi3OK;
  unsigned *slot = slots(c, __func__, reference, count, KIND_REAL, KIND_SOLVER_REAL);
  if (slot == NULL) return fmi3Error;
  const fmurt_fmu_status status = fmurt_fmu_set_real(c, __func__, slot, count, value);
  free(slot);
  return (fmi3Status)status;
}

fmi3Status fmi3GetInt32(fmi3Instance c, const fmi3ValueReference reference[], size_t count, fmi3Int32 value[],
                        size_t value_count) {
  if (!counts_agree(c, __func__, count, value_count)) return fmi3Error;
  if (count == 0) return fmi3OK;
  unsigned *slot = slots(c, __func__, reference, count, KIND_INTEGER, KIND_SOLVER_INTEGER);
  if (slot == NULL) return fmi3Error;
  const fmurt_fmu_status status = fmurt_fmu_get_integer(c, __func__, slot, count, value);
  free(slot);
  return (fmi3Status)status;
}

fmi3Status fmi3SetInt32(fmi3Instance c, const fmi3ValueReference reference[], size_t count, const fmi3Int32 value[],
                        size_t value_count) {
  if (!counts_agree(c, __func__, count, value_count)) return fmi3Error;
  if (count == 0) return fmi3OK;
  unsigned *slot = slots(c, __func__, reference, count, KIND_INTEGER, KIND_SOLVER_INTEGER);
  if (slot == NULL) return fmi3Error;
  const fmurt_fmu_status status = fmurt_fmu_set_integer(c, __func__, slot, count, value);
  free(slot);
  return (fmi3Status)status;
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
  if (!counts_agree(c, __func__, count, value_count)) return fmi3Error;
  if (count == 0) return fmi3OK;
  unsigned *slot = slots(c, __func__, reference, count, KIND_STRING, KIND_NONE);
  if (slot == NULL) return fmi3Error;
  const fmurt_fmu_status status = fmurt_fmu_get_string(c, __func__, slot, count, value);
  free(slot);
  return (fmi3Status)status;
}

fmi3Status fmi3SetString(fmi3Instance c, const fmi3ValueReference reference[], size_t count, const fmi3String value[],
                         size_t value_count) {
  if (!counts_agree(c, __func__, count, value_count)) return fmi3Error;
  if (count == 0) return fmi3OK;
  unsigned *slot = slots(c, __func__, reference, count, KIND_STRING, KIND_NONE);
  if (slot == NULL) return fmi3Error;
  const fmurt_fmu_status status = fmurt_fmu_set_string(c, __func__, slot, count, value);
  free(slot);
  return (fmi3Status)status;
}

/* -- types, clocks and modes that no model of this generator has -- */

static fmi3Status refuse_all(fmi3Instance c, const char *call, size_t count, const char *reason) {
  if (!fmurt_fmu_permits(c, call, FMURT_ANY_PHASE)) return fmi3Error;
  return count == 0 ? fmi3OK : (fmi3Status)fmurt_fmu_refuse(c, call, reason);
}

static const char no_such_type[] = "this FMU has no variables of this type";
static const char no_clocks[] = "this FMU has no clocks";

#define FMURT_TYPE_WITHOUT_VARIABLES(type)                                                                         \
  fmi3Status fmi3Get##type(fmi3Instance c, const fmi3ValueReference reference[], size_t count, fmi3##type value[], \
                           size_t value_count) {                                                                   \
    (void)reference, (void)value, (void)value_count;                                                               \
    return refuse_all(c, __func__, count, no_such_type);                                                           \
  }                                                                                                                \
  fmi3Status fmi3Set##type(fmi3Instance c, const fmi3ValueReference reference[], size_t count,                     \
                           const fmi3##type value[], size_t value_count) {                                         \
    (void)reference, (void)value, (void)value_count;                                                               \
    return refuse_all(c, __func__, count, no_such_type);                                                           \
  }

FMURT_TYPE_WITHOUT_VARIABLES(Float32)
FMURT_TYPE_WITHOUT_VARIABLES(Int8)
FMURT_TYPE_WITHOUT_VARIABLES(UInt8)
FMURT_TYPE_WITHOUT_VARIABLES(Int16)
FMURT_TYPE_WITHOUT_VARIABLES(UInt16)
FMURT_TYPE_WITHOUT_VARIABLES(UInt32)
FMURT_TYPE_WITHOUT_VARIABLES(UInt64)

fmi3Status fmi3GetBinary(fmi3Instance c, const fmi3ValueReference reference[], size_t count, size_t size[],
                         fmi3Binary value[], size_t value_count) {
  (void)reference, (void)size, (void)value, (void)value_count;
  return refuse_all(c, __func__, count, no_such_type);
}

fmi3Status fmi3SetBinary(fmi3Instance c, const fmi3ValueReference reference[], size_t count, const size_t size[],
                         const fmi3Binary value[], size_t value_count) {
  (void)reference, (void)size, (void)value, (void)value_count;
  return refuse_all(c, __func__, count, no_such_type);
}

fmi3Status fmi3GetClock(fmi3Instance c, const fmi3ValueReference reference[], size_t count, fmi3Clock value[]) {
  (void)reference, (void)value;
  return refuse_all(c, __func__, count, no_clocks);
}

fmi3Status fmi3SetClock(fmi3Instance c, const fmi3ValueReference reference[], size_t count, const fmi3Clock value[]) {
  (void)reference, (void)value;
  return refuse_all(c, __func__, count, no_clocks);
}

fmi3Status fmi3GetIntervalDecimal(fmi3Instance c, const fmi3ValueReference reference[], size_t count,
                                  fmi3Float64 interval[], fmi3IntervalQualifier qualifier[]) {
  (void)reference, (void)interval, (void)qualifier;
  return refuse_all(c, __func__, count, no_clocks);
}

fmi3Status fmi3GetIntervalFraction(fmi3Instance c, const fmi3ValueReference reference[], size_t count,
                                   fmi3UInt64 counter[], fmi3UInt64 resolution[], fmi3IntervalQualifier qualifier[]) {
  (void)reference, (void)counter, (void)resolution, (void)qualifier;
  return refuse_all(c, __func__, count, no_clocks);
}

fmi3Status fmi3GetShiftDecimal(fmi3Instance c, const fmi3ValueReference reference[], size_t count,
                               fmi3Float64 shift[]) {
  (void)reference, (void)shift;
  return refuse_all(c, __func__, count, no_clocks);
}

fmi3Status fmi3GetShiftFraction(fmi3Instance c, const fmi3ValueReference reference[], size_t count,
                                fmi3UInt64 counter[], fmi3UInt64 resolution[]) {
  (void)reference, (void)counter, (void)resolution;
  return refuse_all(c, __func__, count, no_clocks);
}

fmi3Status fmi3SetIntervalDecimal(fmi3Instance c, const fmi3ValueReference reference[], size_t count,
                                  const fmi3Float64 interval[]) {
  (void)reference, (void)interval;
  return refuse_all(c, __func__, count, no_clocks);
}

fmi3Status fmi3SetIntervalFraction(fmi3Instance c, const fmi3ValueReference reference[], size_t count,
                                   const fmi3UInt64 counter[], const fmi3UInt64 resolution[]) {
  (void)reference, (void)counter, (void)resolution;
  return refuse_all(c, __func__, count, no_clocks);
}

fmi3Status fmi3SetShiftDecimal(fmi3Instance c, const fmi3ValueReference reference[], size_t count,
                               const fmi3Float64 shift[]) {
  (void)reference, (void)shift;
  return refuse_all(c, __func__, count, no_clocks);
}

fmi3Status fmi3SetShiftFraction(fmi3Instance c, const fmi3ValueReference reference[], size_t count,
                                const fmi3UInt64 counter[], const fmi3UInt64 resolution[]) {
  (void)reference, (void)counter, (void)resolution;
  return refuse_all(c, __func__, count, no_clocks);
}

fmi3Status fmi3ActivateModelPartition(fmi3Instance c, fmi3ValueReference clock, fmi3Float64 time) {
  (void)clock, (void)time;
  return refuse_all(c, __func__, 1, no_clocks);
}

fmi3Status fmi3EnterConfigurationMode(fmi3Instance c) {
  return refuse_all(c, __func__, 1, "this FMU has no structural parameters");
}

fmi3Status fmi3ExitConfigurationMode(fmi3Instance c) {
  return refuse_all(c, __func__, 1, "this FMU has no structural parameters");
}

fmi3Status fmi3EvaluateDiscreteStates(fmi3Instance c) {
  return refuse_all(c, __func__, 1, "discrete states are evaluated by fmi3UpdateDiscreteStates only");
}

fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance c, fmi3ValueReference reference, size_t *count) {
  (void)reference, (void)count;
  return refuse_all(c, __func__, 1, "dependencies of elements are not known");
}

fmi3Status fmi3GetVariableDependencies(fmi3Instance c, fmi3ValueReference dependent, size_t dependent_element[],
                                       fmi3ValueReference independent[], size_t independent_element[],
                                       fmi3DependencyKind kind[], size_t count) {
  (void)dependent, (void)dependent_element, (void)independent, (void)independent_element, (void)kind, (void)count;
  return refuse_all(c, __func__, 1, "dependencies of elements are not known");
}

fmi3Status fmi3GetAdjointDerivative(fmi3Instance c, const fmi3ValueReference unknown[], size_t unknown_count,
                                    const fmi3ValueReference known[], size_t known_count, const fmi3Float64 seed[],
                                    size_t seed_count, fmi3Float64 sensitivity[], size_t sensitivity_count) {
  (void)unknown, (void)unknown_count, (void)known, (void)known_count, (void)seed, (void)seed_count;
  (void)sensitivity, (void)sensitivity_count;
  return refuse_all(c, __func__, 1, "adjoint derivatives are not provided");
}

fmi3Status fmi3GetOutputDerivatives(fmi3Instance c, const fmi3ValueReference reference[], size_t count,
                                    const fmi3Int32 order[], fmi3Float64 value[], size_t value_count) {
  (void)reference, (void)order, (void)value, (void)value_count;
  return refuse_all(c, __func__, count, "this FMU has no derivatives of outputs");
}

/* -- state of the FMU -- */

fmi3Status fmi3GetFMUState(fmi3Instance c, fmi3FMUState *state) {
  return (fmi3Status)fmurt_fmu_get_state(c, __func__, state);
}

fmi3Status fmi3SetFMUState(fmi3Instance c, fmi3FMUState state) {
  return (fmi3Status)fmurt_fmu_set_state(c, __func__, state);
}

fmi3Status fmi3FreeFMUState(fmi3Instance c, fmi3FMUState *state) {
  return (fmi3Status)fmurt_fmu_free_state(c, __func__, state);
}

fmi3Status fmi3SerializedFMUStateSize(fmi3Instance c, fmi3FMUState state, size_t *size) {
  return (fmi3Status)fmurt_fmu_state_size(c, __func__, state, size);
}

fmi3Status fmi3SerializeFMUState(fmi3Instance c, fmi3FMUState state, fmi3Byte bytes[], size_t size) {
  return (fmi3Status)fmurt_fmu_write_state(c, __func__, state, (char *)bytes, size);
}

fmi3Status fmi3DeserializeFMUState(fmi3Instance c, const fmi3Byte bytes[], size_t size, fmi3FMUState *state) {
  return (fmi3Status)fmurt_fmu_read_state(c, __func__, (const char *)bytes, size, state);
}

/* -- derivatives -- */

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

/* -- modes -- */

fmi3Status fmi3EnterEventMode(fmi3Instance c) { return (fmi3Status)fmurt_fmu_enter_event_mode(c, __func__); }

fmi3Status fmi3UpdateDiscreteStates(fmi3Instance c, fmi3Boolean *need_update, fmi3Boolean *terminate,
                                    fmi3Boolean *nominals_changed, fmi3Boolean *states_changed,
                                    fmi3Boolean *next_time_defined, fmi3Float64 *next_time) {
  if (c != NULL && (need_update == NULL || terminate == NULL || nominals_changed == NULL || states_changed == NULL ||
                    next_time_defined == NULL || next_time == NULL)) {
    return (fmi3Status)fmurt_fmu_refuse(c, __func__, "null pointer");
  }
  fmurt_event_report report;
  const fmi3Status status = (fmi3Status)fmurt_fmu_update_discrete_states(c, __func__, &report);
  if (c == NULL) return status;
  *need_update = fmi3False;
  *terminate = report.terminate != 0;
  *nominals_changed = fmi3False;
  *states_changed = report.states_changed != 0;
  *next_time_defined = report.next_time_defined != 0;
  *next_time = report.next_time;
  return status;
}

fmi3Status fmi3EnterContinuousTimeMode(fmi3Instance c) {
  return (fmi3Status)fmurt_fmu_enter_continuous_time_mode(c, __func__);
}

fmi3Status fmi3EnterStepMode(fmi3Instance c) { return (fmi3Status)fmurt_fmu_enter_step_mode(c, __func__); }

/* -- model exchange -- */

fmi3Status fmi3CompletedIntegratorStep(fmi3Instance c, fmi3Boolean no_rewind, fmi3Boolean *enter_event_mode,
                                       fmi3Boolean *terminate) {
  (void)no_rewind;
  if (!fmurt_fmu_permits(c, __func__, FMURT_PHASE_CONTINUOUS)) return fmi3Error;
  if (enter_event_mode == NULL || terminate == NULL) return (fmi3Status)fmurt_fmu_refuse(c, __func__, "null pointer");
  *enter_event_mode = fmi3False;
  *terminate = fmi3False;
  return (fmi3Status)fmurt_fmu_completed_step(c, __func__);
}

fmi3Status fmi3SetTime(fmi3Instance c, fmi3Float64 time) { return (fmi3Status)fmurt_fmu_set_time(c, __func__, time); }

fmi3Status fmi3SetContinuousStates(fmi3Instance c, const fmi3Float64 state[], size_t count) {
  return (fmi3Status)fmurt_fmu_set_states(c, __func__, state, count);
}

fmi3Status fmi3GetContinuousStateDerivatives(fmi3Instance c, fmi3Float64 derivative[], size_t count) {
  return (fmi3Status)fmurt_fmu_get_derivatives(c, __func__, derivative, count);
}

fmi3Status fmi3GetEventIndicators(fmi3Instance c, fmi3Float64 indicator[], size_t count) {
  return (fmi3Status)fmurt_fmu_get_indicators(c, __func__, indicator, count);
}

fmi3Status fmi3GetContinuousStates(fmi3Instance c, fmi3Float64 state[], size_t count) {
  return (fmi3Status)fmurt_fmu_get_states(c, __func__, state, count);
}

fmi3Status fmi3GetNominalsOfContinuousStates(fmi3Instance c, fmi3Float64 nominal[], size_t count) {
  return (fmi3Status)fmurt_fmu_get_nominals(c, __func__, nominal, count);
}

static fmi3Status tell_number(fmi3Instance c, const char *call, size_t number, size_t *result) {
  if (!fmurt_fmu_permits(c, call, FMURT_ANY_PHASE)) return fmi3Error;
  if (result == NULL) return (fmi3Status)fmurt_fmu_refuse(c, call, "null pointer");
  *result = number;
  return fmi3OK;
}

fmi3Status fmi3GetNumberOfEventIndicators(fmi3Instance c, size_t *count) {
  return tell_number(c, __func__, fmurt_model.indicator_count, count);
}

fmi3Status fmi3GetNumberOfContinuousStates(fmi3Instance c, size_t *count) {
  return tell_number(c, __func__, fmurt_model.state_count, count);
}

/* -- co-simulation -- */

fmi3Status fmi3DoStep(fmi3Instance pointer, fmi3Float64 time, fmi3Float64 step, fmi3Boolean no_rewind,
                      fmi3Boolean *event_handling_needed, fmi3Boolean *terminate, fmi3Boolean *early_return,
                      fmi3Float64 *last_successful_time) {
  (void)no_rewind;
  component *c = pointer;
  if (c != NULL &&
      (event_handling_needed == NULL || terminate == NULL || early_return == NULL || last_successful_time == NULL)) {
    return (fmi3Status)fmurt_fmu_refuse(&c->fmu, __func__, "null pointer");
  }
  fmurt_step_report report;
  const fmi3Status status = (fmi3Status)fmurt_fmu_do_step(pointer, __func__, time, step, &report);
  if (c == NULL) return status;
  *event_handling_needed = report.event_waiting != 0;
  *terminate = report.terminate != 0;
  *early_return = status == fmi3OK && report.time < time + step;
  *last_successful_time = report.time;
  /* FMI 3.0 lets the importer go on from the last successful time. */
  if (status == fmi3Discard) c->fmu.instance->situation.phase = FMURT_PHASE_STEP;
  return status;
}
