/* fmurt_chatter.c - see fmurt_chatter.h. */
#include "fmurt_chatter.h"

#include <stdio.h>
#include <string.h>

void fmurt_chatter_count(fmurt_instance *instance, size_t indicator) {
  ++instance->chatter.changes[indicator];
  instance->chatter.changed = 1;
}

static void describe(fmurt_instance *instance) {
  const int *changes = instance->chatter.changes;
  size_t most = 0;
  for (size_t i = 1; i < fmurt_model.indicator_count; ++i) {
    if (changes[i] > changes[most]) most = i;
  }
  char cause[600] = "Most of them are time events: the next one always lies at the present time, or hardly after it";
  if (fmurt_model.indicator_count > 0 && changes[most] > 0) {
    const char *text = fmurt_model.indicator_text != NULL ? fmurt_model.indicator_text[most] : "";
    snprintf(cause, sizeof cause,
             "The relation %s%.400s%sevent indicator %zu%s undoes the condition under which it became true; give it a "
             "hysteresis or make the change continuous",
             text[0] != '\0' ? "'" : "of ", text, text[0] != '\0' ? "' (" : "", most + 1, text[0] != '\0' ? ")" : "");
  }
  const double now = instance->values.time;
  snprintf(instance->message, sizeof instance->message, "The model chatters at time %.9g: %d events within %.3g s. %s",
           now, FMURT_CHATTER_EVENTS, now - instance->chatter.begin, cause);
}

int fmurt_chatter_found(fmurt_instance *instance) {
  fmurt_chatter *chatter = &instance->chatter;
  const double elapsed = instance->values.time - chatter->begin;
  if (chatter->events == 0 || !(elapsed >= 0.0 && elapsed < FMURT_CHATTER_TIME)) {
    chatter->begin = instance->values.time;
    chatter->events = 0;
    memset(chatter->changes, 0, fmurt_model.indicator_count * sizeof *chatter->changes);
  }
  chatter->changed = 0;
  if (chatter->events > FMURT_CHATTER_EVENTS || ++chatter->events != FMURT_CHATTER_EVENTS) return 0;
  describe(instance);
  ++chatter->events;
  return 1;
}
