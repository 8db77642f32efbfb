/* cmb_state.h - saving, restoring and serializing everything an instance knows.
 *
 * The history of the integrator is not part of a saved state: the step after saving and the step after
 * restoring both start it afresh, so both go on with exactly the same numbers, in this process or another. */
#ifndef CMB_STATE_H
#define CMB_STATE_H

#include "cmb_instance.h"

typedef struct cmb_state cmb_state;

/* Saves an instance's state, into *state where that is not NULL, else into a new one that the caller frees.
 * CMB_RESULT_ERROR if memory is short; *state is then as before. */
cmb_result cmb_state_save(cmb_instance *instance, cmb_state **state);
/* 1 if a state is one of an instance of the same kind, which alone can be restored. */
int cmb_state_fits(const cmb_instance *instance, const cmb_state *state);
/* Restores a state that fits. CMB_RESULT_ERROR if memory is short; the instance is then as before. */
cmb_result cmb_state_restore(cmb_instance *instance, const cmb_state *state);
/* Frees a state; state may be NULL. */
void cmb_state_free(cmb_state *state);

/* Bytes of the serialized form. */
size_t cmb_state_size(const cmb_state *state);
/* Writes cmb_state_size bytes. */
void cmb_state_write(const cmb_state *state, char *bytes);
/* Reads a serialized state; NULL if the bytes are damaged, of another model or version, or memory is short. */
cmb_state *cmb_state_read(const char *bytes, size_t size);

#endif
