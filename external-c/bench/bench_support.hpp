// What the benchmarks of pairs share.
#pragma once

#include <time.h>

#include <cstdint>
#include <cstdio>
#include <string>

#include "support/random_bodies.hpp"

namespace cmb::bench {

inline std::string digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

// The hull of points on a sphere of diameter 1.
inline std::string hull_descriptor(int points) {
  random_bodies::Random random(static_cast<std::uint64_t>(points));
  std::string text = "cmb/1 hull vertices=";
  for (int i = 0; i < points; ++i) {
    const convex::Vec3 p = 0.5 * random.direction();
    text += (i > 0 ? "," : "") + digits(p.x) + "," + digits(p.y) + "," + digits(p.z);
  }
  return text;
}

// This thread's processor time: what else the machine does does not count.
inline double processor_microseconds() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}

}  // namespace cmb::bench
