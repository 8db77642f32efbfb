/* ModelicaUtilities.h - functions that external C code of a Modelica model may call
 * (Modelica Language Specification 3.6, section 12.9.6). */
#ifndef MODELICA_UTILITIES_H
#define MODELICA_UTILITIES_H

#include <stdarg.h>
#include <stddef.h>

#if defined(__GNUC__)
#define MODELICA_UTILITIES_NORETURN __attribute__((noreturn))
#define MODELICA_UTILITIES_PRINTF(text, first) __attribute__((format(printf, text, first)))
#else
#define MODELICA_UTILITIES_NORETURN
#define MODELICA_UTILITIES_PRINTF(text, first)
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* Messages to the user; text and format are not NULL. */
void ModelicaMessage(const char *string);
void ModelicaFormatMessage(const char *format, ...) MODELICA_UTILITIES_PRINTF(1, 2);
void ModelicaVFormatMessage(const char *format, va_list arguments) MODELICA_UTILITIES_PRINTF(1, 0);

void ModelicaWarning(const char *string);
void ModelicaFormatWarning(const char *format, ...) MODELICA_UTILITIES_PRINTF(1, 2);
void ModelicaVFormatWarning(const char *format, va_list arguments) MODELICA_UTILITIES_PRINTF(1, 0);

/* Errors: never return; treated like a failing assertion. */
MODELICA_UTILITIES_NORETURN void ModelicaError(const char *string);
MODELICA_UTILITIES_NORETURN void ModelicaFormatError(const char *format, ...) MODELICA_UTILITIES_PRINTF(1, 2);
MODELICA_UTILITIES_NORETURN void ModelicaVFormatError(const char *format, va_list arguments)
    MODELICA_UTILITIES_PRINTF(1, 0);

/* Memory for a text of `length` characters and its end, to be returned to Modelica; it belongs to the
 * simulation environment and lives at least until the external function returns. The first never returns
 * NULL (it ends in ModelicaError), the second does where memory is short. */
char *ModelicaAllocateString(size_t length);
char *ModelicaAllocateStringWithErrorReturn(size_t length);

/* The same, filled with a copy of string. */
char *ModelicaDuplicateString(const char *string);
char *ModelicaDuplicateStringWithErrorReturn(const char *string);

#ifdef __cplusplus
}
#endif

#endif
