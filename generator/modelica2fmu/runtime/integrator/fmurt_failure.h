/* fmurt_failure.h - why CVODE stopped, in words. */
#ifndef FMURT_FAILURE_H
#define FMURT_FAILURE_H

#include <stddef.h>
#include <sundials/sundials_nvector.h>

/* Names the state whose error was largest in the last step that CVODE tried; leaves the text as it is if that is unknown.
 * `cvode` is CVODE's memory, `state` holds the model's states, at least one. */
void fmurt_describe_worst_state(void *cvode, N_Vector state, char *text, size_t size);

/* Writes why CVODE answered `flag` at this time, and what may help. `maximum_steps`: of a communication step; `cause`: the
 * model's own words, or empty; `state`: what fmurt_describe_worst_state wrote, or empty. */
void fmurt_describe_failure(int flag, double time, int maximum_steps, const char *cause, const char *state, char *text,
                            size_t size);

#endif
