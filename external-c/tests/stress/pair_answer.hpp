// A pair of bodies, asked through the public interface.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <string>

#include "contact_multibody.h"
#include "math/vector3.hpp"
#include "support/engine_calls.hpp"

namespace cmb::stress {

using convex::Pose;
using convex::Vec3;

constexpr std::size_t capacity = 6;

struct Answer {
  double distance = 0.0;
  std::array<double, capacity> depth{}, weight{};
  std::array<Vec3, capacity> normal, point;
};

// Bodies A and B; throws std::string, what the engine says, where they make no scene or have no answer.
class Pair {
 public:
  Pair(const std::string &a, const std::string &b, cmb_backend backend = CMB_BACKEND_AUTO) {
    const char *const geometry[] = {a.c_str(), b.c_str()};
    const int pairs[] = {1, 2, 2, 1};
    if (cmb::test::intern_scene(geometry, 2, pairs, 2, backend, &scene_) != CMB_OK) {
      throw std::string(cmb_last_error()) + "\n" + a + "\n" + b;
    }
  }

  // Poses are those of the bodies in the world. `reversed` asks for B against A.
  Answer ask(const Pose &a, const Pose &b, bool reversed = false) const {
    double position[6], rotation[18];
    const Pose *const poses[] = {&a, &b};
    for (int body = 0; body < 2; ++body) {
      for (int i = 0; i < 3; ++i) {
        position[3 * body + i] = poses[body]->translation[i];
        for (int j = 0; j < 3; ++j) rotation[9 * body + 3 * i + j] = poses[body]->rotation.row[j][i];
      }
    }
    Answer answer;
    double normal[3 * capacity], point[3 * capacity];
    if (cmb::test::query_pair(scene_, reversed ? 2 : 1, position, rotation, 2, capacity, &answer.distance,
                       answer.depth.data(), answer.weight.data(), normal, point) != CMB_OK) {
      throw std::string(cmb_last_error());
    }
    for (std::size_t k = 0; k < capacity; ++k) {
      answer.normal[k] = {normal[3 * k], normal[3 * k + 1], normal[3 * k + 2]};
      answer.point[k] = {point[3 * k], point[3 * k + 1], point[3 * k + 2]};
    }
    return answer;
  }

 private:
  cmb_scene scene_{};
};

inline bool same_bits(const Answer &a, const Answer &b) {
  const auto same = [](const auto &one, const auto &other) { return std::memcmp(&one, &other, sizeof one) == 0; };
  return same(a.distance, b.distance) && same(a.depth, b.depth) && same(a.weight, b.weight) &&
         same(a.normal, b.normal) && same(a.point, b.point);
}

// Null, or what is wrong whatever the bodies are: numbers that are not finite or not as the interface promises, bodies
// that touch without a force or carry one without touching.
inline const char *fault_of_numbers(const Answer &answer) {
  if (!std::isfinite(answer.distance)) return "the distance is not finite";
  double load = 0.0;
  for (std::size_t k = 0; k < capacity; ++k) {
    if (!std::isfinite(answer.depth[k]) || answer.depth[k] < 0.0) return "a depth is not finite or negative";
    if (!std::isfinite(answer.weight[k]) || answer.weight[k] < 0.0) return "a weight is not finite or negative";
    if (!(std::fabs(norm(answer.normal[k]) - 1.0) < 1e-9)) return "a normal is not a unit vector";
    if (!is_finite(answer.point[k])) return "a point is not finite";
    load += answer.depth[k] * answer.weight[k];
  }
  if (answer.distance < 0.0 && !(load > 0.0)) return "the bodies touch, but no point carries";
  if (answer.distance >= 0.0 && load > 0.0) return "a point carries, but the bodies are apart";
  return nullptr;
}

}  // namespace cmb::stress
