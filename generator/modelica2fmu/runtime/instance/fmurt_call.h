/* cmb_call.h - calls of the generated model functions, guarded against ModelicaError.
 *
 * External C code of a model reports errors through ModelicaError, which must not return: a guarded call
 * marks where to go on. Text from ModelicaAllocateString lives until the guarded call ends; string slots
 * that the model changed are copied into the instance before. */
#ifndef CMB_CALL_H
#define CMB_CALL_H

#include "cmb_instance.h"

typedef enum cmb_model_function {
  CMB_CALL_PARAMETERS,
  CMB_CALL_INITIALIZE,
  CMB_CALL_CONTINUOUS,
  CMB_CALL_INDICATORS, /* argument: double [indicator_count] */
  CMB_CALL_DISCRETE,   /* argument: int *states_changed */
  CMB_CALL_JACOBIAN,   /* argument: double [state_count * state_count]; cmb_model.jacobian must be there */
  CMB_CALL_SETTLE      /* cmb_model.settle must be there */
} cmb_model_function;

/* Calls one function of cmb_model. ModelicaError in it gives CMB_RESULT_DISCARD, as a failing assertion in
 * Modelica does; the text is in instance->message. */
cmb_result cmb_call_model(cmb_instance *instance, cmb_model_function function, void *argument);

#endif
