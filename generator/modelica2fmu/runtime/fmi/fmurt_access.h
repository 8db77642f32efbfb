/* fmurt_access.h - reading and setting slots through value references, checked against the interface.
 *
 * Getting brings values up to date first and fails only where the model fails. Setting checks phase, causality
 * and variability; nothing is set where one of the references is wrong. Failures leave their cause in
 * instance->message. */
#ifndef FMURT_ACCESS_H
#define FMURT_ACCESS_H

#include "fmurt_instance.h"

typedef enum fmurt_base_type {
  FMURT_TYPE_REAL,
  FMURT_TYPE_INTEGER,
  FMURT_TYPE_BOOLEAN,
  FMURT_TYPE_STRING
} fmurt_base_type;

/* FMURT_RESULT_ERROR if one of the value references does not exist. */
fmurt_result fmurt_check_references(fmurt_instance *instance, fmurt_base_type type, const unsigned *reference,
                                    size_t count);

/* The references must exist. */
fmurt_result fmurt_get_real(fmurt_instance *instance, const unsigned *reference, size_t count, double *value);
fmurt_result fmurt_get_integer(fmurt_instance *instance, const unsigned *reference, size_t count, int *value);
fmurt_result fmurt_get_boolean(fmurt_instance *instance, const unsigned *reference, size_t count, int *value);
/* The texts belong to the instance and are valid until its next call. */
fmurt_result fmurt_get_string(fmurt_instance *instance, const unsigned *reference, size_t count, const char **value);

/* All values are set or, if one cannot be, none. */
fmurt_result fmurt_set_reals(fmurt_instance *instance, const unsigned *reference, size_t count, const double *value);
fmurt_result fmurt_set_integers(fmurt_instance *instance, const unsigned *reference, size_t count, const int *value);
fmurt_result fmurt_set_booleans(fmurt_instance *instance, const unsigned *reference, size_t count, const int *value);
fmurt_result fmurt_set_strings(fmurt_instance *instance, const unsigned *reference, size_t count,
                               const char *const *value);

#endif
