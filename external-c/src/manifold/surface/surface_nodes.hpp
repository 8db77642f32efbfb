// Places and areas that integrals over a surface are summed over, two by two.
#pragma once

#include <cstddef>
#include <vector>

#include "math/lanes.hpp"

namespace cmb {

using convex::Vec3;

struct SurfaceNode {
  Vec3 at;            // from the surface's place
  Vec3 area;          // outward
  double cone = 0.0;  // place . area: three times the volume of the cone from the place
};

// They are kept as sums take them. Room that was taken once is kept.
class SurfaceNodes {
 public:
  // Two nodes; where there is no second one, that is zero.
  struct Pair {
    convex::LaneVec3 at, area;
    convex::Lanes cone;
  };

  std::size_t size() const { return count_; }
  bool empty() const { return count_ == 0; }
  void clear() { count_ = 0; }
  // Leaves the first `count`, no more than there are.
  void shorten(std::size_t count) {
    count_ = count;
    if (count % 2 != 0) leave_first(pairs_[count / 2]);
  }
  void add(const Vec3 &at, const Vec3 &area) {
    if (count_ == 2 * pairs_.size()) pairs_.resize(2 * pairs_.size() + 1);
    Pair &pair = pairs_[count_ / 2];
    if (count_++ % 2 == 0) {
      pair.at.x = convex::Lanes{at.x, 0.0}, pair.at.y = convex::Lanes{at.y, 0.0}, pair.at.z = convex::Lanes{at.z, 0.0};
      pair.area.x = convex::Lanes{area.x, 0.0}, pair.area.y = convex::Lanes{area.y, 0.0}, pair.area.z = convex::Lanes{area.z, 0.0};
      pair.cone = convex::Lanes{0.0, 0.0};
    } else {
      pair.at.x[1] = at.x, pair.at.y[1] = at.y, pair.at.z[1] = at.z;
      pair.area.x[1] = area.x, pair.area.y[1] = area.y, pair.area.z[1] = area.z;
    }
  }
  SurfaceNode operator[](std::size_t k) const {
    const Pair &pair = pairs_[k / 2];
    const std::size_t lane = k % 2;
    return {{pair.at.x[lane], pair.at.y[lane], pair.at.z[lane]}, {pair.area.x[lane], pair.area.y[lane], pair.area.z[lane]}, pair.cone[lane]};
  }

  // All, two at once: sums over them come in an order of their own.
  template <typename Visit>
  void visit_pairs(Visit &&visit) const {
    const Pair *const end = pairs_.data() + (count_ + 1) / 2;
    for (const Pair *pair = pairs_.data(); pair != end; ++pair) visit(*pair);
  }
  template <typename Change>
  void change_pairs(Change &&change) {
    Pair *const end = pairs_.data() + (count_ + 1) / 2;
    for (Pair *pair = pairs_.data(); pair != end; ++pair) change(*pair);
    if (count_ % 2 != 0) leave_first(end[-1]);
  }

  // One by one, in turn.
  class Iterator {
   public:
    Iterator(const SurfaceNodes &nodes, std::size_t place) : nodes_(&nodes), place_(place) {}
    SurfaceNode operator*() const { return (*nodes_)[place_]; }
    Iterator &operator++() {
      ++place_;
      return *this;
    }
    bool operator!=(const Iterator &other) const { return place_ != other.place_; }

   private:
    const SurfaceNodes *nodes_;
    std::size_t place_;
  };
  Iterator begin() const { return {*this, 0}; }
  Iterator end() const { return {*this, count_}; }

 private:
  static void leave_first(Pair &pair) {
    for (convex::LaneVec3 *const two : {&pair.at, &pair.area}) two->x[1] = two->y[1] = two->z[1] = 0.0;
    pair.cone[1] = 0.0;
  }

  std::vector<Pair> pairs_;
  std::size_t count_ = 0;
};

}  // namespace cmb
