// Kinds of bodies whose contact forces are sampled: all shapes of the engine, about a metre large, and their extremes.
#pragma once

#include <string>
#include <vector>

#include "support/random_bodies.hpp"

namespace cmb::quality {

using random_bodies::Random;

struct Body {
  std::string text;       // descriptor
  double size = 1.0;      // a length that motions are measured by, m
  double thickness = 1.0; // the least width of what the body is made of, m
};

struct Kind {
  const char *name;
  // A half-space or a height field, whose front is its +z: other bodies come from above.
  bool ground;
  Body (*make)(Random &random);
};

// All kinds, in the order in which tables list them.
const std::vector<Kind> &all_kinds();

// Null where no kind has the name.
const Kind *find_kind(const std::string &name);

}  // namespace cmb::quality
