/* fmurt_call.h - calls of the generated model functions, guarded against ModelicaError.
 *
 * External C code of a model reports errors through ModelicaError, which must not return: a guarded call
 * marks where to go on. Text from ModelicaAllocateString lives until the guarded call ends; string slots
 * that the model changed are copied into the instance before. */
#ifndef FMURT_CALL_H
#define FMURT_CALL_H

#include "fmurt_instance.h"

typedef enum fmurt_model_function {
  FMURT_CALL_PARAMETERS,
  FMURT_CALL_INITIALIZE,
  FMURT_CALL_CONTINUOUS,
  FMURT_CALL_INDICATORS, /* argument: double [indicator_count] */
  FMURT_CALL_DISCRETE,   /* argument: int *states_changed */
  FMURT_CALL_JACOBIAN,   /* argument: double [state_count * state_count]; fmurt_model.jacobian must be there */
  FMURT_CALL_SETTLE,     /* fmurt_model.settle must be there */
  FMURT_CALL_WARNINGS,
  FMURT_CALL_REMAINING,
  FMURT_CALL_GUARDED /* argument: fmurt_guarded *, which changes no text */
} fmurt_model_function;

/* Something that calls functions of fmurt_model itself. */
typedef struct fmurt_guarded {
  fmurt_result (*run)(fmurt_values *values, void *context);
  void *context;
} fmurt_guarded;

/* Calls one function of fmurt_model. ModelicaError in it gives FMURT_RESULT_DISCARD, as a failing assertion in
 * Modelica does; the text is in instance->message. */
fmurt_result fmurt_call_model(fmurt_instance *instance, fmurt_model_function function, void *argument);

#endif
