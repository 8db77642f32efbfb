// Scenes: parsed geometry and the pairs to be watched.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "contact_multibody.h"
#include "scene/body_bounds.hpp"
#include "shape/shape.hpp"

namespace cmb {

struct DistanceLibrary;

// Immutable but for two diagnostic counters; shared by threads.
struct Scene {
  struct Pair {
    std::size_t first = 0, second = 0;  // 0-based body numbers
  };
  const std::uint64_t number = next_number();  // of each scene another, of released ones too; positive
  std::vector<BodyShapes> bodies;
  std::vector<std::shared_ptr<const BodyShapes>> geometry;  // what bodies were copied from: shared with other scenes
  std::vector<double> thickness;   // of each body, see thickness.hpp
  std::vector<BodyBounds> bounds;  // of each body
  std::vector<Pair> pairs;
  cmb_backend backend = CMB_BACKEND_AUTO;
  const DistanceLibrary *library = nullptr;  // of the back end; null for the engine's own

  // How often the library named as back end gave an answer that held, and how often not; diagnostics only.
  mutable std::atomic<std::uint64_t> answered{0};
  mutable std::atomic<std::uint64_t> refused{0};

 private:
  static std::uint64_t next_number() {
    static std::atomic<std::uint64_t> last{0};
    return ++last;
  }
};

}  // namespace cmb
