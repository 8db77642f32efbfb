/* fmurt_call.c - guarded calls, and the functions of ModelicaUtilities.h and fmurt_model.h that report from inside. */
#include "fmurt_call.h"

#include <pthread.h>
#include <setjmp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ModelicaUtilities.h"
#include "fmurt_solved.h"

typedef union allocation allocation;
union allocation {
  allocation *next;
  max_align_t alignment;
};

typedef struct call_frame {
  jmp_buf failure;
  fmurt_instance *instance;
  struct call_frame *outer;
  allocation *allocations;
} call_frame;

/* The guarded call this thread is in. Thread-local because ModelicaError has no argument for it. */
static _Thread_local call_frame *current_frame = NULL;

static fmurt_result dispatch(fmurt_values *values, fmurt_model_function function, void *argument) {
  switch (function) {
    case FMURT_CALL_PARAMETERS:
      return fmurt_model.parameters != NULL ? fmurt_model.parameters(values) : FMURT_RESULT_OK;
    case FMURT_CALL_INITIALIZE:
      return fmurt_model.initialize != NULL ? fmurt_model.initialize(values) : FMURT_RESULT_OK;
    case FMURT_CALL_CONTINUOUS:
      return fmurt_model.continuous != NULL ? fmurt_model.continuous(values) : FMURT_RESULT_OK;
    case FMURT_CALL_INDICATORS:
      return fmurt_model.indicators != NULL ? fmurt_model.indicators(values, argument) : FMURT_RESULT_OK;
    case FMURT_CALL_DISCRETE:
      return fmurt_model.discrete != NULL ? fmurt_model.discrete(values, argument) : FMURT_RESULT_OK;
    case FMURT_CALL_JACOBIAN: return fmurt_model.jacobian(values, argument);
    case FMURT_CALL_SETTLE: return fmurt_model.settle(values);
    case FMURT_CALL_GUARDED: return ((const fmurt_guarded *)argument)->run(values, ((const fmurt_guarded *)argument)->context);
    case FMURT_CALL_WARNINGS: return fmurt_model.warnings != NULL ? fmurt_model.warnings(values) : FMURT_RESULT_OK;
    case FMURT_CALL_REMAINING: return fmurt_model.remaining != NULL ? fmurt_model.remaining(values) : FMURT_RESULT_OK;
  }
  return FMURT_RESULT_ERROR;
}

/* Apart from the caller so that no local variable of this function changes between setjmp and longjmp. */
static fmurt_result call_in_frame(call_frame *frame, fmurt_model_function function, void *argument) {
  if (setjmp(frame->failure) != 0) return FMURT_RESULT_DISCARD;
  return dispatch(&frame->instance->values, function, argument);
}

/* Copies texts the model put into string slots. Old texts are freed last: a slot may show another one's text. */
static fmurt_result adopt_strings(fmurt_instance *instance) {
  fmurt_result result = FMURT_RESULT_OK;
  for (size_t i = 0; i < fmurt_model.string_count; ++i) {
    if (instance->values.string[i] == instance->string[i]) continue;
    const char *text = instance->values.string[i] != NULL ? instance->values.string[i] : "";
    const size_t size = strlen(text) + 1;
    char *copy = malloc(size);
    if (copy == NULL) {
      result = FMURT_RESULT_ERROR;
      instance->values.string[i] = instance->string[i];
    } else {
      memcpy(copy, text, size);
      instance->values.string[i] = copy;
    }
  }
  for (size_t i = 0; i < fmurt_model.string_count; ++i) {
    if (instance->values.string[i] == instance->string[i]) continue;
    free(instance->string[i]);
    instance->string[i] = (char *)instance->values.string[i];
  }
  return result;
}

/* While time goes on nothing jumps. At events parameters and inputs, and with them lengths of a loop, may; and who only
 * looks at other states, as one does who linearizes a model, does so at the same time. */
static fmurt_following following(const fmurt_instance *instance, fmurt_model_function function) {
  if (function == FMURT_CALL_PARAMETERS || function == FMURT_CALL_INITIALIZE) return FMURT_SOLVE;
  const int between_events = instance->situation.phase & (FMURT_PHASE_CONTINUOUS | FMURT_PHASE_STEP);
  const int has_moved = instance->values.time != instance->values.accepted[fmurt_model.followed_count];
  return between_events && has_moved && !instance->at_event ? FMURT_FOLLOW : FMURT_FOLLOW_OR_SOLVE;
}

fmurt_result fmurt_call_model(fmurt_instance *instance, fmurt_model_function function, void *argument) {
  call_frame frame;
  frame.instance = instance;
  frame.outer = current_frame;
  frame.allocations = NULL;
  current_frame = &frame;
  instance->message[0] = '\0';
  if (function != FMURT_CALL_JACOBIAN) instance->jacobian_is_current = 0;
  instance->values.following = following(instance, function);
  fmurt_offer_solved(instance);
  fmurt_result result = call_in_frame(&frame, function, argument);
  current_frame = frame.outer;
  if (fmurt_model.string_count > 0 && function != FMURT_CALL_GUARDED) {
    const fmurt_result adopted = adopt_strings(instance);
    if (result == FMURT_RESULT_OK) result = adopted;
  }
  while (frame.allocations != NULL) {
    allocation *next = frame.allocations->next;
    free(frame.allocations);
    frame.allocations = next;
  }
  return result;
}

static void keep_message(fmurt_instance *instance, const char *message) {
  snprintf(instance->message, sizeof instance->message, "%s", message);
  const size_t length = strlen(instance->message);
  if (length > 0 && instance->message[length - 1] == '\n') instance->message[length - 1] = '\0';
}

void fmurt_report_error(fmurt_values *values, const char *message) { keep_message(values->host, message); }

void fmurt_report_warning(fmurt_values *values, const char *message) {
  fmurt_log(values->host, FMURT_LOG_WARNING, FMURT_LOG_STATUS_WARNING, "%s", message);
}

/* -- ModelicaUtilities.h -- */

static void tell(fmurt_severity severity, const char *text) {
  if (current_frame == NULL) {
    fprintf(stderr, "%s\n", text); /* from a thread of the external code: no instance to tell */
    return;
  }
  fmurt_log(current_frame->instance, severity, severity == FMURT_LOG_WARNING ? FMURT_LOG_STATUS_WARNING : FMURT_LOG_ALL,
            "%s", text);
}

static void tell_formatted(fmurt_severity severity, const char *format, va_list arguments) {
  char text[2048];
  vsnprintf(text, sizeof text, format, arguments);
  tell(severity, text);
}

void ModelicaMessage(const char *string) { tell(FMURT_LOG_DEBUG, string); }

void ModelicaVFormatMessage(const char *format, va_list arguments) {
  tell_formatted(FMURT_LOG_DEBUG, format, arguments);
}

void ModelicaFormatMessage(const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  ModelicaVFormatMessage(format, arguments);
  va_end(arguments);
}

void ModelicaWarning(const char *string) { tell(FMURT_LOG_WARNING, string); }

void ModelicaVFormatWarning(const char *format, va_list arguments) {
  tell_formatted(FMURT_LOG_WARNING, format, arguments);
}

void ModelicaFormatWarning(const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  ModelicaVFormatWarning(format, arguments);
  va_end(arguments);
}

void ModelicaError(const char *string) {
  if (current_frame == NULL) {
    /* A thread that the external code started itself: there is no call to return from, so only it ends. */
    fprintf(stderr, "%s\n", string);
    pthread_exit(NULL);
  }
  keep_message(current_frame->instance, string);
  longjmp(current_frame->failure, 1);
}

void ModelicaVFormatError(const char *format, va_list arguments) {
  char text[1024];
  vsnprintf(text, sizeof text, format, arguments);
  ModelicaError(text);
}

void ModelicaFormatError(const char *format, ...) {
  char text[1024];
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  ModelicaError(text);
}

char *ModelicaAllocateStringWithErrorReturn(size_t length) {
  if (length > (size_t)-1 - sizeof(allocation) - 1) return NULL;
  allocation *memory = calloc(1, sizeof *memory + length + 1);
  if (memory == NULL) return NULL;
  if (current_frame != NULL) {
    memory->next = current_frame->allocations;
    current_frame->allocations = memory;
  }
  return (char *)(memory + 1);
}

char *ModelicaAllocateString(size_t length) {
  char *text = ModelicaAllocateStringWithErrorReturn(length);
  if (text == NULL) ModelicaFormatError("No memory for a text of %lu characters", (unsigned long)length);
  return text;
}

char *ModelicaDuplicateStringWithErrorReturn(const char *string) {
  const size_t length = strlen(string);
  char *text = ModelicaAllocateStringWithErrorReturn(length);
  if (text != NULL) memcpy(text, string, length);
  return text;
}

char *ModelicaDuplicateString(const char *string) {
  const size_t length = strlen(string);
  char *text = ModelicaAllocateString(length);
  memcpy(text, string, length);
  return text;
}
