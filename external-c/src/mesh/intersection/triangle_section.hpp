// How a triangle of a mesh passes through a convex body.
#pragma once

#include <vector>

#include "mesh/core/triangle_hierarchy.hpp"
#include "shape/convex_body.hpp"
#include "shape/polytope.hpp"

namespace cmb::mesh {

struct TriangleSection {
  double depth = 0.0;  // m; positive where some of the triangle lies inside the body, 0 where none does
  Vec3 place;          // of the triangle, in the body (round ones: hardly outside); in the mesh's frame
};

// Depth and place of sections are continuous in the pose: how deep the deepest place lies below all of the body's surface, and what of the section
// is nearest to the middle.
//
// Borrows all it is given. Thread-safe where `polygon` and `room`, which are overwritten, are.
class SectionedBody {
 public:
  // A ball, capsule, ellipsoid, cylinder or cone. `place`: its pose in the mesh's frame.
  SectionedBody(const convex::ConvexBody &body, const Pose &place, std::vector<Vec3> &polygon, std::vector<Vec3> &room);
  // A polytope with its vertices and its faces' normals in the mesh's frame.
  SectionedBody(const convex::Polytope &polytope, const Pose &place, const std::vector<Vec3> &vertices,
                const std::vector<Vec3> &normals, std::vector<Vec3> &polygon, std::vector<Vec3> &room);

  // A point inside the body, and the box that holds it; in the mesh's frame.
  Vec3 center() const;
  Bounds bounds() const;
  double volume() const;
  // The greatest d . x of its points x.
  double reach(const Vec3 &d) const;

  // The section of the triangle; depth 0 where that is at most `enough` (the place is of no use then).
  TriangleSection section(const Vec3 (&corner)[3], double enough = 0.0) const;

 private:
  TriangleSection polytope_section(const Vec3 (&corner)[3], double enough) const;
  TriangleSection ellipsoid_section(const Vec3 (&corner)[3], const Vec3 &half) const;
  TriangleSection capsule_section(const Vec3 (&corner)[3]) const;
  TriangleSection revolved_section(const Vec3 (&corner)[3], double enough) const;
  void clip_mantle(double radius, double slope) const;

  convex::ConvexBody body_;
  const Pose &place_;
  const std::vector<Vec3> *vertices_ = nullptr, *normals_ = nullptr;
  std::vector<Vec3> &polygon_, &room_;
};

}  // namespace cmb::mesh
