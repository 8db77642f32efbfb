/* fmurt_fmu_check.h - an FMU instance, and the checks of calls and of their outcomes; conventions in fmurt_fmu.h. */
#ifndef FMURT_FMU_CHECK_H
#define FMURT_FMU_CHECK_H

#include "fmurt_instance.h"

/* Numerically fmi2Status and fmi3Status. */
typedef enum fmurt_fmu_status { FMURT_FMU_OK, FMURT_FMU_WARNING, FMURT_FMU_DISCARD, FMURT_FMU_ERROR } fmurt_fmu_status;

typedef struct fmurt_fmu {
  fmurt_instance *instance;
  int co_simulation;
  int event_mode_used;      /* co-simulation: the importer handles events in event mode (FMI 3.0) */
  int early_return_allowed; /* co-simulation: a step may end at an event (FMI 3.0) */
} fmurt_fmu;

enum {
  FMURT_BEFORE_START = FMURT_PHASE_INSTANTIATED | FMURT_PHASE_INITIALIZATION,
  FMURT_MODEL_EXCHANGE = FMURT_PHASE_EVENT | FMURT_PHASE_CONTINUOUS,
  FMURT_CO_SIMULATION = FMURT_PHASE_STEP | FMURT_PHASE_STEP_FAILED,
  FMURT_AFTER_END = FMURT_PHASE_TERMINATED | FMURT_PHASE_ERROR,
  FMURT_ANY_PHASE = FMURT_BEFORE_START | FMURT_MODEL_EXCHANGE | FMURT_CO_SIMULATION | FMURT_AFTER_END
};

/* 1 if the instance is in one of these phases, 0 (logged) if not. */
int fmurt_fmu_permits(fmurt_fmu *fmu, const char *call, int phases);
/* Logs the reason; FMURT_FMU_ERROR. */
fmurt_fmu_status fmurt_fmu_refuse(fmurt_fmu *fmu, const char *call, const char *reason);

/* The call was wrong; the cause is in the instance's message. */
fmurt_fmu_status fmurt_fmu_reject(fmurt_fmu *fmu, const char *call);
/* Outcome of an evaluation of the model: an error ends in the error state. */
fmurt_fmu_status fmurt_fmu_finish(fmurt_fmu *fmu, const char *call, fmurt_result result);
/* Outcome where no smaller step can help: initialization and events. */
fmurt_fmu_status fmurt_fmu_finish_strictly(fmurt_fmu *fmu, const char *call, fmurt_result result);
/* Outcome of reading what may have to be evaluated first. */
fmurt_fmu_status fmurt_fmu_finish_read(fmurt_fmu *fmu, const char *call, fmurt_result result);
fmurt_fmu_status fmurt_fmu_refuse_null(fmurt_fmu *fmu, const char *call);
/* 1 if neither array is missing, 0 (logged) if one is. */
int fmurt_fmu_has_arrays(fmurt_fmu *fmu, const char *call, size_t count, const void *reference, const void *value);

#endif
