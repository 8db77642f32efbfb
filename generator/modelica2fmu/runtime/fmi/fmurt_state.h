/* fmurt_state.h - saving, restoring and serializing everything an instance knows.
 *
 * The history of the integrator is not part of a saved state: the step after saving and the step after
 * restoring both start it afresh, so both go on with exactly the same numbers, in this process or another. */
#ifndef FMURT_STATE_H
#define FMURT_STATE_H

#include "fmurt_instance.h"

typedef struct fmurt_state fmurt_state;

/* Saves an instance's state, into *state where that is not NULL, else into a new one that the caller frees.
 * FMURT_RESULT_ERROR if memory is short; *state is then as before. */
fmurt_result fmurt_state_save(fmurt_instance *instance, fmurt_state **state);
/* 1 if a state is one of an instance of the same kind, which alone can be restored. */
int fmurt_state_fits(const fmurt_instance *instance, const fmurt_state *state);
/* Restores a state that fits. FMURT_RESULT_ERROR if memory is short; the instance is then as before. */
fmurt_result fmurt_state_restore(fmurt_instance *instance, const fmurt_state *state);
/* Frees a state; state may be NULL. */
void fmurt_state_free(fmurt_state *state);

/* Bytes of the serialized form. */
size_t fmurt_state_size(const fmurt_state *state);
/* Writes fmurt_state_size bytes. */
void fmurt_state_write(const fmurt_state *state, char *bytes);
/* Reads a serialized state; NULL if the bytes are damaged, of another model or version, or memory is short. */
fmurt_state *fmurt_state_read(const char *bytes, size_t size);

#endif
