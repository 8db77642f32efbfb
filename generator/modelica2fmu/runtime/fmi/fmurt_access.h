/* cmb_access.h - reading and setting slots through value references, checked against the interface.
 *
 * Getting brings values up to date first and fails only where the model fails. Setting checks phase, causality
 * and variability; nothing is set where one of the references is wrong. Failures leave their cause in
 * instance->message. */
#ifndef CMB_ACCESS_H
#define CMB_ACCESS_H

#include "cmb_instance.h"

typedef enum cmb_base_type { CMB_TYPE_REAL, CMB_TYPE_INTEGER, CMB_TYPE_BOOLEAN, CMB_TYPE_STRING } cmb_base_type;

/* CMB_RESULT_ERROR if one of the value references does not exist. */
cmb_result cmb_check_references(cmb_instance *instance, cmb_base_type type, const unsigned *reference, size_t count);

/* The references must exist. */
cmb_result cmb_get_real(cmb_instance *instance, const unsigned *reference, size_t count, double *value);
cmb_result cmb_get_integer(cmb_instance *instance, const unsigned *reference, size_t count, int *value);
cmb_result cmb_get_boolean(cmb_instance *instance, const unsigned *reference, size_t count, int *value);
/* The texts belong to the instance and are valid until its next call. */
cmb_result cmb_get_string(cmb_instance *instance, const unsigned *reference, size_t count, const char **value);

/* All values are set or, if one cannot be, none. */
cmb_result cmb_set_reals(cmb_instance *instance, const unsigned *reference, size_t count, const double *value);
cmb_result cmb_set_integers(cmb_instance *instance, const unsigned *reference, size_t count, const int *value);
cmb_result cmb_set_booleans(cmb_instance *instance, const unsigned *reference, size_t count, const int *value);
cmb_result cmb_set_strings(cmb_instance *instance, const unsigned *reference, size_t count, const char *const *value);

#endif
