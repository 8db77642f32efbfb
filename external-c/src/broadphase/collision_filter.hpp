// Which pairs of bodies can never touch, whatever their poses.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace cmb {

// What a filter knows of one body.
struct FilterEntry {
  bool fixed = false;         // never moves
  std::uint32_t group = 1;    // bits: the groups the body belongs to
  std::uint32_t mask = ~0u;   // bits: the groups it collides with
};

// Immutable; shared by threads.
class CollisionFilter {
 public:
  // `excluded`: pairs of 0-based body numbers below bodies.size(), in any order, also more than once.
  CollisionFilter(std::vector<FilterEntry> bodies, const std::vector<std::pair<std::size_t, std::size_t>> &excluded);

  std::size_t body_count() const { return bodies_.size(); }
  bool fixed(std::size_t body) const { return bodies_[body].fixed; }

  // Whether the bodies a and b (0-based) may touch: two bodies, not both fixed, each in a group the other collides
  // with, and not excluded.
  bool may_touch(std::size_t a, std::size_t b) const;

 private:
  std::vector<FilterEntry> bodies_;
  // Of body i: partners_[first_[i] .. first_[i + 1]), sorted.
  std::vector<std::size_t> first_, partners_;
};

}  // namespace cmb
