// What counts for a flat face beyond an edge at which the surface is folded inwards.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/wedges/wedge_plane.hpp"

namespace cmb::mesh {

class TriangleMesh;

// Of a fold the part that lies in the wedge of the triangle on this side and is behind the other side's plane too.
struct FoldRegion {
  std::uint32_t triangle = 0;      // across the fold: below it places count
  Vec3 from, to;                   // the fold's ends
  std::array<WedgeSide, 3> sides;  // the plane that halves the fold's angle, and one at each end
  std::uint32_t first = 0, count = 0;
};

// A wedge ends at the plane that halves the angle of a fold, where its depth is not 0. Faces whose contacts are one (FaceRelations) go over into each other
// there. Where each stores what it does alone, by the mean over what is behind it, as little as comes through that plane would be a contact of its own. So
// a face counts what is beyond as well, up to its own plane, where its depth vanishes: what both sides have in common counts for each of them. Immutable.
class FoldRegions {
 public:
  struct Regions {
    const FoldRegion *begin = nullptr, *end = nullptr;
  };
  struct Planes {
    const WedgePlane *begin = nullptr, *end = nullptr;
  };

  FoldRegions() = default;
  // Of a mesh that is complete but for these.
  explicit FoldRegions(const TriangleMesh &mesh);

  // Those in the wedge of triangle t.
  Regions of(std::uint32_t t) const { return {regions_.data() + first_[t], regions_.data() + first_[t + 1]}; }
  // All that bound it but the plane of its triangle.
  Planes planes(const FoldRegion &region) const {
    const WedgePlane *const begin = planes_.data() + region.first;
    return {begin, begin + region.count};
  }
  // For each triangle: what is s deep behind it in these regions lies within this times s of the fold; 0 where there are none.
  const std::vector<double> &spreads() const { return spreads_; }

 private:
  void add(const TriangleMesh &mesh, std::uint32_t t, std::size_t side);

  std::vector<FoldRegion> regions_;
  std::vector<std::uint32_t> first_;
  std::vector<WedgePlane> planes_;
  std::vector<double> spreads_;
};

}  // namespace cmb::mesh
