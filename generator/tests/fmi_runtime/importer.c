/* A small importer of FMI 2.0 co-simulation FMUs, in C for any platform:
 *   importer BINARY GUID RESOURCES STOP STEPS REFERENCE...
 * prints the time and the values of the Real variables at the start and after each of STEPS steps. */
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include "fmi2FunctionTypes.h"

#ifdef _WIN32
#include <windows.h>
static void *open_library(const char *path) { return (void *)LoadLibraryA(path); }
static void *find_function(void *library, const char *name) { return (void *)GetProcAddress((HMODULE)library, name); }
static const char *why(void) { return "LoadLibrary failed"; }
#else
#include <dlfcn.h>
static void *open_library(const char *path) { return dlopen(path, RTLD_NOW | RTLD_LOCAL); }
static void *find_function(void *library, const char *name) { return dlsym(library, name); }
static const char *why(void) { return dlerror(); }
#endif

enum { most_variables = 100 };

static void *library;

static void fail(const char *what) {
  fprintf(stderr, "importer: %s\n", what);
  exit(1);
}

static void *function(const char *name) {
  void *const found = find_function(library, name);
  if (found == NULL) fail(name);
  return found;
}

static void logger(fmi2ComponentEnvironment environment, fmi2String instance, fmi2Status status, fmi2String category,
                   fmi2String message, ...) {
  va_list values;
  (void)environment, (void)instance, (void)status, (void)category;
  va_start(values, message);
  vfprintf(stderr, message, values);
  va_end(values);
  fputc('\n', stderr);
}

static void check(fmi2Status status, const char *what) {
  if (status != fmi2OK) fail(what);
}

int main(int count, char **argument) {
  const fmi2CallbackFunctions callbacks = {logger, calloc, free, NULL, NULL};
  fmi2ValueReference reference[most_variables];
  fmi2Real value[most_variables];
  int variables = count - 6, steps, step, k;
  double stop;
  fmi2Component fmu;
  if (variables < 1 || variables > most_variables) fail("wrong arguments");
  stop = atof(argument[4]), steps = atoi(argument[5]);
  for (k = 0; k < variables; ++k) reference[k] = (fmi2ValueReference)strtoul(argument[6 + k], NULL, 10);
  library = open_library(argument[1]);
  if (library == NULL) fail(why());
  fmu = ((fmi2InstantiateTYPE *)function("fmi2Instantiate"))("fmu", fmi2CoSimulation, argument[2], argument[3], &callbacks,
                                                           fmi2False, fmi2False);
  if (fmu == NULL) fail("fmi2Instantiate");
  check(((fmi2SetupExperimentTYPE *)function("fmi2SetupExperiment"))(fmu, fmi2False, 0.0, 0.0, fmi2True, stop), "setup");
  check(((fmi2EnterInitializationModeTYPE *)function("fmi2EnterInitializationMode"))(fmu), "enter initialization");
  check(((fmi2ExitInitializationModeTYPE *)function("fmi2ExitInitializationMode"))(fmu), "exit initialization");
  for (step = 0; step <= steps; ++step) {
    const double time = stop * step / steps;
    check(((fmi2GetRealTYPE *)function("fmi2GetReal"))(fmu, reference, (size_t)variables, value), "get");
    printf("%.17g", time);
    for (k = 0; k < variables; ++k) printf(" %.17g", value[k]);
    putchar('\n');
    if (step < steps) check(((fmi2DoStepTYPE *)function("fmi2DoStep"))(fmu, time, stop / steps, fmi2True), "step");
  }
  check(((fmi2TerminateTYPE *)function("fmi2Terminate"))(fmu), "terminate");
  ((fmi2FreeInstanceTYPE *)function("fmi2FreeInstance"))(fmu);
  return 0;
}
