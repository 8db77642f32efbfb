// The minimum translation of two polytopes that overlap, by a walk over the facets of their difference C = A - B.
//
// Beyond a side that the origin's foot is beyond, the facet is nearer to the origin; so the walk comes down to a facet that
// holds the origin's foot. From there facets are added until the cone from a point of C on the far side to the rim of those
// found has no side within the ball of the depth. Then these facets and the cone are a closed surface of points of C round the
// ball: no other facet meets it, and the least of the heights found is the depth. Where that takes many facets, the cone is
// bent outwards over a support ring of six more points of C.
#pragma once

#include <cstdint>
#include <vector>

#include "narrowphase/minkowski_difference.hpp"
#include "narrowphase/polytope/difference_facets.hpp"
#include "narrowphase/polytope/patch_completion.hpp"

namespace cmb::convex {

// Works in storage allocated by the constructor alone. Not for sharing between threads.
class FacetWalk {
 public:
  enum class Outcome {
    found,
    apart,     // along `direction` the bodies do not overlap
    undecided  // parallel edges or faces, or too many facets: ask another method
  };
  struct Result {
    double depth = 0.0;  // the support function along `direction`
    Vec3 direction;      // unit, from A to B
    Vec3 a, b;           // witness points, in A's frame
  };

  FacetWalk();

  // Of bodies that are polytopes or boxes (has_facets). `first` is any direction, best a guess of that from A to B, `farthest` the
  // difference's support along it. A result that is `found` is proven.
  Outcome minimum_translation(const MinkowskiDifference &difference, const Vec3 &first, const DifferencePoint &farthest, Result &result);

 private:
  using Corner = DifferenceFacets::Corner;
  using Facet = DifferenceFacets::Facet;
  struct Side {
    std::int32_t facet, corner;
    bool inner;  // both of its facets were met
  };
  struct Mark {
    std::uint64_t key;
    std::uint32_t growth;
    std::int32_t side;
  };

  bool descend(Facet &facet);
  bool grow(const MinkowskiDifference &difference, Facet &lowest);
  Mark &mark_of(const Corner &corner);
  bool add_sides(const Facet &facet, std::int32_t number, std::int32_t k);
  bool is_closed(const PatchCompletion &completion) const;
  const Vec3 &end_of(const Side &side) const {
    const Facet &facet = facets_[static_cast<std::size_t>(side.facet)];
    return surface_.end_of(facet, side.corner - facet.first);
  }
  bool choose_by_foot(double scale, Facet &lowest) const;

  DifferenceFacets surface_;
  std::vector<Facet> facets_;  // those found in the present growth
  std::vector<Side> sides_;
  // Sides by what they are: a hash table, of which what the present growth wrote counts; no two sides of small bodies have
  // the same place.
  std::vector<Mark> marks_;
  bool small_ = false;
  std::uint32_t growth_ = 0;
};

}  // namespace cmb::convex
