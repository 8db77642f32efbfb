// Plane sides of two bodies that look the same way and lie as good as in one plane.
#pragma once

#include <array>
#include <cstddef>

#include "manifold/surface/overlap_surface.hpp"

namespace cmb {

// Where one of them passes through the other the overlap's surface goes over from the one to the other at once, and the load by what all of it is
// pushed. Within some hundredths of a depth both are surface in part: a place of the one counts as the other's as well, by how near it is to it.
// Sides at an angle cross anyway, over as much as they are apart within the overlap: the less they are parallel, the less of a place counts so.
class FlushSides {
 public:
  // Of sides whose normals have a smaller cosine none is the other.
  static constexpr double least_cosine = 1.0 - 2e-4;

  // `thickness`: of the overlap.
  void start(const OverlapSurface &surface, double thickness);
  // A side of A and one of B by their planes normal . p = offset, p being from the surface's place in its axes; dropped unless they look the same way
  // and are near.
  void add(const Vec3 &normal_a, double offset_a, const Vec3 &normal_b, double offset_b);
  bool any() const { return count_ > 0; }
  // The part by which a node of A's surface counts as A's, or of B's as B's.
  double share_of_a(const OverlapSurface::Node &node) const { return share(node, &Sides::a, &Sides::b); }
  double share_of_b(const OverlapSurface::Node &node) const { return share(node, &Sides::b, &Sides::a); }

 private:
  struct Plane {
    Vec3 normal;
    double offset = 0.0;
  };
  struct Sides {
    Plane a, b;
    double most = 0.0;  // of a place's share that goes over
  };
  double share(const OverlapSurface::Node &node, Plane Sides::*own, Plane Sides::*other) const;

  static constexpr std::size_t most = 8;  // two ends, and what of a tessellated side is as good as parallel to one
  std::array<Sides, most> sides_;
  std::size_t count_ = 0;
  double fading_ = 0.0, width_ = 0.0;
};

}  // namespace cmb
