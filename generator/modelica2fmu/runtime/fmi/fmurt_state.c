/* fmurt_state.c - see fmurt_state.h. */
#include "fmurt_state.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "fmurt_approach.h"
#include "fmurt_solver.h"

/* One block of bytes, the same in memory and serialized: header, situation, doubles, ints, texts. */
struct fmurt_state {
  size_t size;
  char *bytes;
};

typedef struct state_header {
  char format[8];
  uint64_t size;  /* of the whole block */
  uint64_t model; /* hash of the model's GUID */
  uint64_t hash;  /* of everything after the header; serialized states only */
} state_header;

static const char state_format[8] = "cmb/st4";

static uint64_t hash_bytes(const char *bytes, size_t size) {
  uint64_t hash = UINT64_C(14695981039346656037); /* FNV-1a */
  for (size_t i = 0; i < size; ++i) hash = (hash ^ (unsigned char)bytes[i]) * UINT64_C(1099511628211);
  return hash;
}

static uint64_t model_hash(void) { return hash_bytes(fmurt_model.guid, strlen(fmurt_model.guid)); }

static size_t fixed_size(const fmurt_instance *instance) {
  return sizeof(state_header) + sizeof(fmurt_situation) + instance->double_block_count * sizeof(double) +
         instance->int_block_count * sizeof(int);
}

static size_t text_size(char *const *texts) {
  size_t size = 0;
  for (size_t i = 0; i < fmurt_model.string_count; ++i) size += strlen(texts[i]) + 1;
  return size;
}

static char *put(char *position, const void *source, size_t size) {
  if (size > 0) memcpy(position, source, size);
  return position + size;
}

static char *put_texts(char *position, char *const *texts) {
  for (size_t i = 0; i < fmurt_model.string_count; ++i) position = put(position, texts[i], strlen(texts[i]) + 1);
  return position;
}

fmurt_result fmurt_state_save(fmurt_instance *instance, fmurt_state **state) {
  const size_t size = fixed_size(instance) + text_size(instance->string) + text_size(instance->start_string);
  char *bytes = malloc(size);
  fmurt_state *saved = *state != NULL ? *state : calloc(1, sizeof **state);
  if (bytes == NULL || saved == NULL) {
    free(bytes);
    if (*state == NULL) free(saved);
    return FMURT_RESULT_ERROR;
  }
  fmurt_solver_restart(instance->solver);

  fmurt_situation *situation = &instance->situation;
  situation->kind = instance->kind;
  situation->time = instance->values.time;
  situation->next_time_event = instance->values.next_time_event;
  situation->initial = instance->values.initial;
  situation->terminal = instance->values.terminal;
  char *position = bytes + sizeof(state_header);
  position = put(position, situation, sizeof *situation);
  position = put(position, instance->double_block, instance->double_block_count * sizeof(double));
  position = put(position, instance->int_block, instance->int_block_count * sizeof(int));
  position = put_texts(position, instance->string);
  put_texts(position, instance->start_string);

  state_header header = {.size = size, .model = model_hash()};
  memcpy(header.format, state_format, sizeof header.format);
  memcpy(bytes, &header, sizeof header);

  free(saved->bytes);
  saved->bytes = bytes;
  saved->size = size;
  *state = saved;
  return FMURT_RESULT_OK;
}

static void free_texts(char **texts) {
  if (texts == NULL) return;
  for (size_t i = 0; i < 2 * fmurt_model.string_count; ++i) free(texts[i]);
  free(texts);
}

/* Copies the saved texts, current ones first, then start texts; NULL if memory is short or the bytes end early. */
static char **copy_texts(const char *position, const char *end) {
  char **texts = calloc(2 * fmurt_model.string_count + 1, sizeof *texts);
  if (texts == NULL) return NULL;
  for (size_t i = 0; i < 2 * fmurt_model.string_count; ++i) {
    const char *zero = memchr(position, '\0', (size_t)(end - position));
    const size_t size = zero != NULL ? (size_t)(zero - position) + 1 : 0;
    texts[i] = zero != NULL ? malloc(size) : NULL;
    if (texts[i] == NULL) {
      free_texts(texts);
      return NULL;
    }
    memcpy(texts[i], position, size);
    position += size;
  }
  return texts;
}

int fmurt_state_fits(const fmurt_instance *instance, const fmurt_state *state) {
  fmurt_situation saved;
  if (state->size < fixed_size(instance)) return 0;
  memcpy(&saved, state->bytes + sizeof(state_header), sizeof saved);
  return saved.kind == (int)instance->kind;
}

fmurt_result fmurt_state_restore(fmurt_instance *instance, const fmurt_state *state) {
  const char *position = state->bytes + sizeof(state_header);
  char **texts = copy_texts(state->bytes + fixed_size(instance), state->bytes + state->size);
  if (texts == NULL) return FMURT_RESULT_ERROR;

  fmurt_situation *situation = &instance->situation;
  memcpy(situation, position, sizeof *situation);
  position += sizeof *situation;
  memcpy(instance->double_block, position, instance->double_block_count * sizeof(double));
  position += instance->double_block_count * sizeof(double);
  memcpy(instance->int_block, position, instance->int_block_count * sizeof(int));
  for (size_t i = 0; i < fmurt_model.string_count; ++i) {
    free(instance->string[i]);
    free(instance->start_string[i]);
    instance->string[i] = texts[i];
    instance->start_string[i] = texts[fmurt_model.string_count + i];
    instance->values.string[i] = instance->string[i];
  }
  free(texts);

  instance->values.time = situation->time;
  instance->values.next_time_event = situation->next_time_event;
  instance->values.initial = situation->initial;
  instance->values.terminal = situation->terminal;
  instance->values.terminate = situation->terminate_requested;
  instance->jacobian_is_current = 0;
  fmurt_approach_forget(instance);
  fmurt_solver_restart(instance->solver);
  return FMURT_RESULT_OK;
}

void fmurt_state_free(fmurt_state *state) {
  if (state == NULL) return;
  free(state->bytes);
  free(state);
}

size_t fmurt_state_size(const fmurt_state *state) { return state->size; }

void fmurt_state_write(const fmurt_state *state, char *bytes) {
  state_header header;
  memcpy(&header, state->bytes, sizeof header);
  header.hash = hash_bytes(state->bytes + sizeof header, state->size - sizeof header);
  memcpy(bytes, state->bytes, state->size);
  memcpy(bytes, &header, sizeof header);
}

fmurt_state *fmurt_state_read(const char *bytes, size_t size) {
  state_header header;
  if (size < sizeof header) return NULL;
  memcpy(&header, bytes, sizeof header);
  if (memcmp(header.format, state_format, sizeof header.format) != 0 || header.size != size ||
      header.model != model_hash() || header.hash != hash_bytes(bytes + sizeof header, size - sizeof header)) {
    return NULL;
  }
  fmurt_state *state = calloc(1, sizeof *state);
  char *copy = malloc(size);
  if (state == NULL || copy == NULL) {
    free(state);
    free(copy);
    return NULL;
  }
  memcpy(copy, bytes, size);
  state->bytes = copy;
  state->size = size;
  return state;
}
