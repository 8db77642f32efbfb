// Stands in for the Modelica tool: ModelicaFormatError throws what it is told.
#pragma once

#include <stdexcept>

struct ModelicaError : std::runtime_error {
  using std::runtime_error::runtime_error;
};
