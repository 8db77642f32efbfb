/* fmurt_fmu_values.c - values by reference, saved states and directional derivatives of fmurt_fmu.h. */
#include "fmurt_access.h"
#include "fmurt_derivative.h"
#include "fmurt_fmu.h"
#include "fmurt_state.h"

/* -- values -- */

/* 1 if these references can be read, 0 (logged) if not. */
static int readable(fmurt_fmu *fmu, const char *call, fmurt_base_type type, const unsigned *reference, size_t count,
                    const void *value) {
  if (!fmurt_fmu_permits(fmu, call, FMURT_ANY_PHASE) || !fmurt_fmu_has_arrays(fmu, call, count, reference, value)) return 0;
  if (fmurt_check_references(fmu->instance, type, reference, count) == FMURT_RESULT_OK) return 1;
  fmurt_fmu_reject(fmu, call);
  return 0;
}

static int writable(fmurt_fmu *fmu, const char *call, const unsigned *reference, size_t count, const void *value) {
  return fmurt_fmu_permits(fmu, call, FMURT_BEFORE_START | FMURT_MODEL_EXCHANGE | FMURT_PHASE_STEP) &&
         fmurt_fmu_has_arrays(fmu, call, count, reference, value);
}

fmurt_fmu_status fmurt_fmu_get_real(fmurt_fmu *fmu, const char *call, const unsigned *reference, size_t count,
                                    double *value) {
  if (!readable(fmu, call, FMURT_TYPE_REAL, reference, count, value)) return FMURT_FMU_ERROR;
  return fmurt_fmu_finish_read(fmu, call, fmurt_get_real(fmu->instance, reference, count, value));
}

fmurt_fmu_status fmurt_fmu_get_integer(fmurt_fmu *fmu, const char *call, const unsigned *reference, size_t count,
                                       int *value) {
  if (!readable(fmu, call, FMURT_TYPE_INTEGER, reference, count, value)) return FMURT_FMU_ERROR;
  return fmurt_fmu_finish_read(fmu, call, fmurt_get_integer(fmu->instance, reference, count, value));
}

fmurt_fmu_status fmurt_fmu_get_boolean(fmurt_fmu *fmu, const char *call, const unsigned *reference, size_t count,
                                       int *value) {
  if (!readable(fmu, call, FMURT_TYPE_BOOLEAN, reference, count, value)) return FMURT_FMU_ERROR;
  return fmurt_fmu_finish_read(fmu, call, fmurt_get_boolean(fmu->instance, reference, count, value));
}

fmurt_fmu_status fmurt_fmu_get_string(fmurt_fmu *fmu, const char *call, const unsigned *reference, size_t count,
                                      const char **value) {
  if (!readable(fmu, call, FMURT_TYPE_STRING, reference, count, (const void *)value)) return FMURT_FMU_ERROR;
  return fmurt_fmu_finish_read(fmu, call, fmurt_get_string(fmu->instance, reference, count, value));
}

static fmurt_fmu_status finish_write(fmurt_fmu *fmu, const char *call, fmurt_result result) {
  return result == FMURT_RESULT_OK ? FMURT_FMU_OK : fmurt_fmu_reject(fmu, call);
}

fmurt_fmu_status fmurt_fmu_set_real(fmurt_fmu *fmu, const char *call, const unsigned *reference, size_t count,
                                    const double *value) {
  if (!writable(fmu, call, reference, count, value)) return FMURT_FMU_ERROR;
  return finish_write(fmu, call, fmurt_set_reals(fmu->instance, reference, count, value));
}

fmurt_fmu_status fmurt_fmu_set_integer(fmurt_fmu *fmu, const char *call, const unsigned *reference, size_t count,
                                       const int *value) {
  if (!writable(fmu, call, reference, count, value)) return FMURT_FMU_ERROR;
  return finish_write(fmu, call, fmurt_set_integers(fmu->instance, reference, count, value));
}

fmurt_fmu_status fmurt_fmu_set_boolean(fmurt_fmu *fmu, const char *call, const unsigned *reference, size_t count,
                                       const int *value) {
  if (!writable(fmu, call, reference, count, value)) return FMURT_FMU_ERROR;
  return finish_write(fmu, call, fmurt_set_booleans(fmu->instance, reference, count, value));
}

fmurt_fmu_status fmurt_fmu_set_string(fmurt_fmu *fmu, const char *call, const unsigned *reference, size_t count,
                                      const char *const *value) {
  if (!writable(fmu, call, reference, count, (const void *)value)) return FMURT_FMU_ERROR;
  return finish_write(fmu, call, fmurt_set_strings(fmu->instance, reference, count, value));
}

/* -- state of the FMU -- */

fmurt_fmu_status fmurt_fmu_get_state(fmurt_fmu *fmu, const char *call, void **state) {
  if (!fmurt_fmu_permits(fmu, call, FMURT_ANY_PHASE)) return FMURT_FMU_ERROR;
  if (state == NULL) return fmurt_fmu_refuse_null(fmu, call);
  fmurt_state *saved = *state;
  if (fmurt_state_save(fmu->instance, &saved) != FMURT_RESULT_OK) return fmurt_fmu_refuse(fmu, call, "no memory");
  *state = saved;
  return FMURT_FMU_OK;
}

fmurt_fmu_status fmurt_fmu_set_state(fmurt_fmu *fmu, const char *call, const void *state) {
  if (!fmurt_fmu_permits(fmu, call, FMURT_ANY_PHASE)) return FMURT_FMU_ERROR;
  if (state == NULL) return fmurt_fmu_refuse_null(fmu, call);
  if (!fmurt_state_fits(fmu->instance, state)) {
    return fmurt_fmu_refuse(fmu, call,
                            "the state is of an instance for another use (model exchange, co-simulation, "
                            "co-simulation with event mode)");
  }
  if (fmurt_state_restore(fmu->instance, state) != FMURT_RESULT_OK) return fmurt_fmu_refuse(fmu, call, "no memory");
  return FMURT_FMU_OK;
}

fmurt_fmu_status fmurt_fmu_free_state(fmurt_fmu *fmu, const char *call, void **state) {
  if (!fmurt_fmu_permits(fmu, call, FMURT_ANY_PHASE)) return FMURT_FMU_ERROR;
  if (state == NULL) return FMURT_FMU_OK;
  fmurt_state_free(*state);
  *state = NULL;
  return FMURT_FMU_OK;
}

fmurt_fmu_status fmurt_fmu_state_size(fmurt_fmu *fmu, const char *call, const void *state, size_t *size) {
  if (!fmurt_fmu_permits(fmu, call, FMURT_ANY_PHASE)) return FMURT_FMU_ERROR;
  if (state == NULL || size == NULL) return fmurt_fmu_refuse_null(fmu, call);
  *size = fmurt_state_size(state);
  return FMURT_FMU_OK;
}

fmurt_fmu_status fmurt_fmu_write_state(fmurt_fmu *fmu, const char *call, const void *state, char *bytes, size_t size) {
  if (!fmurt_fmu_permits(fmu, call, FMURT_ANY_PHASE)) return FMURT_FMU_ERROR;
  if (state == NULL || bytes == NULL) return fmurt_fmu_refuse_null(fmu, call);
  if (size < fmurt_state_size(state)) return fmurt_fmu_refuse(fmu, call, "the array is too small");
  fmurt_state_write(state, bytes);
  return FMURT_FMU_OK;
}

fmurt_fmu_status fmurt_fmu_read_state(fmurt_fmu *fmu, const char *call, const char *bytes, size_t size, void **state) {
  if (!fmurt_fmu_permits(fmu, call, FMURT_ANY_PHASE)) return FMURT_FMU_ERROR;
  if (bytes == NULL || state == NULL) return fmurt_fmu_refuse_null(fmu, call);
  fmurt_state *read = fmurt_state_read(bytes, size);
  if (read == NULL) return fmurt_fmu_refuse(fmu, call, "these bytes are not a state of this FMU");
  *state = read;
  return FMURT_FMU_OK;
}

/* -- derivatives -- */

static int are_model_variables(const unsigned *reference, size_t count) {
  for (size_t i = 0; i < count; ++i) {
    if (reference[i] >= fmurt_model.real_count) return 0;
  }
  return 1;
}

fmurt_fmu_status fmurt_fmu_directional_derivative(fmurt_fmu *fmu, const char *call, const unsigned *unknown,
                                                  size_t unknown_count, const unsigned *known, size_t known_count,
                                                  const double *seed, double *sensitivity) {
  if (!fmurt_fmu_permits(fmu, call, FMURT_PHASE_INITIALIZATION | FMURT_MODEL_EXCHANGE | FMURT_PHASE_STEP) ||
      !fmurt_fmu_has_arrays(fmu, call, unknown_count, unknown, sensitivity) || !fmurt_fmu_has_arrays(fmu, call, known_count, known, seed)) {
    return FMURT_FMU_ERROR;
  }
  if (!are_model_variables(unknown, unknown_count) || !are_model_variables(known, known_count)) {
    return fmurt_fmu_refuse(fmu, call, "a value reference is no Real variable of the model");
  }
  return fmurt_fmu_finish(
      fmu, call,
      fmurt_directional_derivative(fmu->instance, unknown, unknown_count, known, known_count, seed, sensitivity));
}
