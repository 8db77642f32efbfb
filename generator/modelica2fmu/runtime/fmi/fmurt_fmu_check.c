/* fmurt_fmu_check.c - see fmurt_fmu_check.h. */
#include "fmurt_fmu_check.h"

fmurt_fmu_status fmurt_fmu_refuse(fmurt_fmu *fmu, const char *call, const char *reason) {
  fmurt_log(fmu->instance, FMURT_LOG_ERROR, FMURT_LOG_STATUS_ERROR, "%s: %s", call, reason);
  return FMURT_FMU_ERROR;
}

int fmurt_fmu_permits(fmurt_fmu *fmu, const char *call, int phases) {
  if (fmu == NULL) return 0;
  if (fmu->instance->situation.phase & phases) return 1;
  fmurt_fmu_refuse(fmu, call, "not permitted in the present state of the FMU");
  return 0;
}

fmurt_fmu_status fmurt_fmu_reject(fmurt_fmu *fmu, const char *call) {
  return fmurt_fmu_refuse(fmu, call, fmu->instance->message);
}

fmurt_fmu_status fmurt_fmu_finish(fmurt_fmu *fmu, const char *call, fmurt_result result) {
  switch (result) {
    case FMURT_RESULT_OK: return FMURT_FMU_OK;
    case FMURT_RESULT_DISCARD:
      fmurt_log(fmu->instance, FMURT_LOG_DISCARD, FMURT_LOG_STATUS_DISCARD, "%s: %s", call, fmu->instance->message);
      return FMURT_FMU_DISCARD;
    case FMURT_RESULT_ERROR: break;
  }
  fmu->instance->situation.phase = FMURT_PHASE_ERROR;
  return fmurt_fmu_reject(fmu, call);
}

fmurt_fmu_status fmurt_fmu_finish_strictly(fmurt_fmu *fmu, const char *call, fmurt_result result) {
  return fmurt_fmu_finish(fmu, call, result == FMURT_RESULT_DISCARD ? FMURT_RESULT_ERROR : result);
}

fmurt_fmu_status fmurt_fmu_finish_read(fmurt_fmu *fmu, const char *call, fmurt_result result) {
  const int before_start = (fmu->instance->situation.phase & FMURT_BEFORE_START) != 0;
  return before_start ? fmurt_fmu_finish_strictly(fmu, call, result) : fmurt_fmu_finish(fmu, call, result);
}

fmurt_fmu_status fmurt_fmu_refuse_null(fmurt_fmu *fmu, const char *call) {
  return fmurt_fmu_refuse(fmu, call, "null pointer");
}

int fmurt_fmu_has_arrays(fmurt_fmu *fmu, const char *call, size_t count, const void *reference, const void *value) {
  if (count == 0 || (reference != NULL && value != NULL)) return 1;
  fmurt_fmu_refuse_null(fmu, call);
  return 0;
}
