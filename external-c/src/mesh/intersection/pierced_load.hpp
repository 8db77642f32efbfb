// What a mesh pushes that passes through a body.
//
// A wall right through a box, a plate's end in its side, an edge in a ball between the pieces of its surface: there may be no
// surface that faces the mesh. Each triangle's section is how deep it reaches into the body, 0 where and only where it does not. All
// of the load is added where nothing else carries, none in ordinary contacts, whose load is an eighth of their depth at least. Two
// meshes count the least translation of crossing triangles, and push both ways first.
#pragma once

#include "manifold/contact_set.hpp"
#include "mesh/contact/direction_sums.hpp"
#include "mesh/core/triangle_mesh.hpp"
#include "mesh/intersection/triangle_section.hpp"

namespace cmb::mesh {

// A load counts as enough where it is at least the depth of what passes through, divided by this. Contacts that are not
// pierced carry more (the mean depth of a corner is a third of its depth, that of a section up to 1.5 times that).
constexpr double least_load_part = 8.0;

// The part, from 0 to 1, of the load of pierced bodies that a contact of the given load lacks; continuous.
inline double lacking_part(double load, double depth) {
  return depth > 0.0 ? std::fmax(0.0, 1.0 - least_load_part * load / depth) : 0.0;
}

// What a contact carries without what passes through the body.
struct CarriedLoad {
  double load = 0.0;     // the sum of weight * depth
  double pushing = 0.0;  // what is left of it where its parts oppose each other
  double depth = 0.0;    // about how deep in the surface what carries lies

  CarriedLoad(double only) : load(only), pushing(only) {}
  CarriedLoad(double all, double left, double deep) : load(all), pushing(left), depth(deep) {}

  // Where a part of it counts.
  void scale(double part) { load *= part, pushing *= part; }

  // Loads that oppose each other hold a body in a groove, but lead none off a wall that goes through it: much deeper than what
  // carries lies in that wall.
  double counted(double section) const {
    const double share = depth > 0.0 ? std::fmin(1.0, std::fmax(0.0, 2.0 - 0.5 * section / depth)) : 1.0;
    return pushing + share * (load - pushing);
  }
  // Sections as deep as this lack nothing.
  double enough() const {
    return std::fmax(least_load_part * std::fmin(pushing, load), std::fmin(least_load_part * load, 2.0 * depth));
  }
};

// Sections push along their triangle's normal with their own depth; the load is their mean. They count by their area, and by
// how short a translation along that normal parts the two: where a body has h below the triangle's plane, by the fourth power of
// depth / h. A wall through a body pushes to the side from which less has to come through.
class PiercedLoad {
 public:
  explicit PiercedLoad(const Vec3 &center) : center_(center) {}

  // `below`: how far the body reaches behind the triangle's plane. `area`: of the triangle.
  void add(const TriangleSection &section, const Vec3 &normal, double below, double area);
  double deepest() const { return deepest_.depth; }
  // The sum of the sections' depths.
  double depths() const { return depths_; }

  // How much its sections count together.
  double count() const { return count_; }

  // Appends the points, the load multiplied by `part` and by `share`; where the contact's distance is greater, sets distance,
  // normal and witness to those of the deepest section, its depth multiplied by `part`.
  void finish(double part, const Pose &pose, ContactSet &result, double share = 1.0) const;

 private:
  Vec3 center_;
  DirectionSums sums_;
  double count_ = 0.0, depths_ = 0.0;
  TriangleSection deepest_;
  Vec3 deepest_normal_;
};

// Scales the points from `begin` on, and the contact's depth, so that the load is `limit` at most; leaves no points where that is
// 0. Returns the load.
double limit_load(double limit, std::size_t begin, ContactSet &result);

// Bounds what a sheet carries of a convex body, whose load are the points from `begin` on, by the deepest section, times as much
// as leaves contacts from the front alone: more the more slender the body is in the ball of that `radius` about it. A body wholly behind a sheet is
// free, and gets there without a jump. Returns the load.
double limit_by_sections(const SectionedBody &body, double radius, const TriangleMesh &mesh, std::size_t begin, ContactSet &result);

// Completes the contact of a convex body with a mesh. `carried` is that of the points in `result`, which are those of the body's
// surface that faces the mesh's triangles; distance, normal and witness are set where it is positive. Where it is too little for
// what passes through the body, adds PiercedLoad; where a closed mesh has swallowed the body's middle, a point that leads it
// out along the shortest exit direction. Returns false, with no points added, where the two do not touch.
bool complete_contact(const SectionedBody &body, const TriangleMesh &mesh, const Pose &pose, const CarriedLoad &carried,
                      ContactSet &result);

}  // namespace cmb::mesh
