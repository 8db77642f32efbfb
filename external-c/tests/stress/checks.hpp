// What is checked at one pose.
#pragma once

#include <optional>
#include <string>

#include "bodies.hpp"

namespace cmb::stress {

// One pose of two bodies, with what all checks need.
struct Sample {
  const Bodies &bodies;
  Pose a, b;
  double rounding;  // m, of places on the bodies
  double slack;     // m, that rounding and the engine's own accuracy may take
  Answer answer;
};

// What is wrong, if anything.
using Fault = std::optional<std::string>;

// Whether a library that is named as back end may say so (m): no contact is missed that is deeper than `rounding`, overlaps
// are as deep as they are or deeper, and bodies apart are as far apart, all to `allowed`.
bool is_library_answer(double found, double truth, double allowed, double rounding);

// Asks the engine and checks its answer; which of the dearer checks are made depends on the sample's number. Throws
// std::string where the engine refuses to answer.
Fault check(Sample &s, Random &random, long sample);

}  // namespace cmb::stress
