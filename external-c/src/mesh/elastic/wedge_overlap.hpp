// What of a convex polytope lies behind the triangles of a mesh, as an elastic solid.
#pragma once

#include <cstdint>
#include <vector>

#include "math/pose_algebra.hpp"
#include "mesh/elastic/wedge_integrals.hpp"
#include "mesh/wedges/wedge_region.hpp"
#include "shape/polytope.hpp"

namespace cmb::mesh {

// Room for the pieces of one polytope; grows in the first calls.
struct OverlapScratch {
  struct Piece {  // a plane convex polygon: `count` of the points
    std::size_t first = 0, count = 0;
    Vec3 normal;  // outward
    bool of_body = false;  // or of a cap
  };
  struct Plane : WedgePlane {
    bool capped = false;
    Plane(const WedgePlane &plane, bool has_cap) : WedgePlane(plane), capped(has_cap) {}
  };
  struct Edge {
    Vec3 from, to;
  };
  std::vector<double> depths, above;   // of the vertices; of a polygon's corners
  std::vector<std::uint64_t> outside;  // of the vertices, a bit for each plane
  std::vector<Plane> planes;
  std::vector<Piece> pieces;
  std::vector<Vec3> points, kept;
  std::vector<Edge> edges;  // of a cap
  std::vector<WedgeIntegrals::Part> parts;
};

// Volumes are sums of cones from a point in the triangle's plane, over the body's faces and over the caps that the wedge's sides
// cut off. Sides that pass through that point need none.
//
// Everything in the mesh's frame. Borrows all it is given.
class WedgeOverlap : public WedgeIntegrals {
 public:
  // `vertices`, `normals`: the body's at `place`. `center`: of its box; `radius`: of a ball about it that holds the body.
  WedgeOverlap(const convex::Polytope &body, const Pose &place, const std::vector<Vec3> &vertices, const std::vector<Vec3> &normals,
               const TriangleMesh &mesh, const Vec3 &center, double radius, OverlapScratch &scratch)
      : WedgeIntegrals(mesh, radius, 1.0, 0.0, scratch.parts), body_(body), place_(place), vertices_(vertices), normals_(normals), center_(center), scratch_(scratch) {}

  // What lies behind triangle t.
  void add(std::uint32_t t) {
    visit_regions(mesh(), t, [this](const WedgeRegion &region) { add(region); });
  }

 private:
  void add(const WedgeRegion &region);
  bool set_planes(const WedgeRegion &region);
  bool offer(const OverlapScratch::Plane &plane);
  void keep_before(const OverlapScratch::Plane &plane);
  PolygonSums sums_of(const Vec3 *polygon, std::size_t count, const Vec3 &normal) const;
  void integrate(const OverlapScratch::Piece &piece);

  const convex::Polytope &body_;
  const Pose &place_;
  const std::vector<Vec3> &vertices_, &normals_;
  Vec3 center_;
  OverlapScratch &scratch_;
  // Of the triangle at hand:
  Vec3 apex_;
  std::uint64_t front_ = 0;  // the bit of the triangle's plane, where that cuts
  PatchSums patch_;
};

}  // namespace cmb::mesh
