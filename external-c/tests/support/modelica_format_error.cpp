#include "modelica_format_error.hpp"

#include <cstdarg>
#include <cstdio>

extern "C" void ModelicaFormatError(const char *format, ...);

extern "C" void ModelicaFormatError(const char *format, ...) {
  char text[4096];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  throw ModelicaError(text);
}
