// Scenes: parsed geometry and the pairs to be watched.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "contact_multibody.h"
#include "scene/shape.hpp"

namespace cmb {

// Immutable but for its diagnostic counters; shared by threads.
struct Scene {
  struct Pair {
    std::size_t first = 0, second = 0;  // 0-based body numbers
  };
  std::vector<BodyShapes> bodies;
  std::vector<Pair> pairs;
  cmb_backend backend = CMB_BACKEND_AUTO;

  // How often a back end answered and how often its answer was missing or refused; diagnostics only.
  struct Counter {
    std::atomic<std::uint64_t> answered{0};
    std::atomic<std::uint64_t> refused{0};
  };
  mutable Counter counters[4];  // by cmb_backend
};

}  // namespace cmb
