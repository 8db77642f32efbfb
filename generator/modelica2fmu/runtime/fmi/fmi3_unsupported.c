/* fmi3_unsupported.c - FMI 3.0.2, the functions for types, clocks and modes that no FMU of this generator has. */
#include "fmurt_fmu.h"
#include "fmi3Functions.h"

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
