// Convex cones of directions and their solid angles.
#pragma once

#include <array>
#include <cstddef>

#include "math/vector3.hpp"

namespace cmb {

using convex::Vec3;

// A convex cone given by its edge rays (any lengths > 0), in turn. Holds up to `capacity` rays; more
// are left out, and what they span: who has more adds every second one or fewer.
class DirectionCone {
 public:
  static constexpr std::size_t capacity = 128;

  void clear() { count_ = 0; }
  bool empty() const { return count_ < 3; }
  std::size_t size() const { return count_; }
  const Vec3 &operator[](std::size_t i) const { return rays_[i]; }
  void add(const Vec3 &ray) {
    if (count_ < capacity) rays_[count_++] = ray;
  }

  // Solid angle in steradian; 0 where empty.
  double solid_angle() const;

 private:
  std::array<Vec3, capacity> rays_;
  std::size_t count_ = 0;
};

// Solid angle of the cone of three rays (Van Oosterom and Strackee 1983), with the sign of their
// orientation; any lengths > 0.
double triangle_solid_angle(const Vec3 &a, const Vec3 &b, const Vec3 &c);

// The directions between two rays of the upper hemisphere, not both horizontal, of lengths about 1.
struct DirectionArc {
  Vec3 first, second;                   // z >= 0
  double across_x = 0.0, across_y = 0.0;  // second.z first.z (second's slope - first's slope)

  // Whether one of them is lower than z.
  bool reaches_below(double z) const { return (first.z < z) | (second.z < z); }
  const Vec3 &lower() const { return second.z < first.z ? second : first; }
  const Vec3 &upper() const { return second.z < first.z ? first : second; }

  DirectionArc() = default;
  DirectionArc(const Vec3 &from, const Vec3 &to)
      : first(from), second(to), across_x(to.x * from.z - from.x * to.z), across_y(to.y * from.z - from.y * to.z) {}
};

// Solid angle of the cone of all directions whose slope (x / z, y / z) is the sum of slopes of `p` and `q`: what lies
// above the parallelogram that both arcs span.
double parallelogram_solid_angle(const DirectionArc &p, const DirectionArc &q);

}  // namespace cmb
