// What of a convex polytope lies behind the triangles of a mesh, as an elastic solid.
#pragma once

#include <cstdint>
#include <vector>

#include "math/pose_algebra.hpp"
#include "mesh/elastic/direction_patches.hpp"
#include "mesh/core/triangle_mesh.hpp"
#include "mesh/core/triangle_wedge.hpp"
#include "shape/polytope.hpp"

namespace cmb::mesh {

// A force with its torque about the origin.
struct Wrench {
  Vec3 force, torque;

  void add(const Vec3 &f, const Vec3 &at) {
    force = force + f;
    torque = torque + cross(at, f);
  }
};

// Room for the pieces of one polytope; grows in the first calls.
struct OverlapScratch {
  struct Piece {  // a plane convex polygon: `count` of the points
    std::size_t first = 0, count = 0;
    Vec3 normal;  // outward
    bool of_body = false;  // or of a cap
  };
  struct Plane {
    Vec3 normal;  // inward, unit
    double offset = 0.0;
    bool capped = false, strict = false;
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
};

// With the depth s below the triangle in whose wedge a place lies, the overlap O of body and mesh stores
//
//   E = 3/2 (mean of s^2 over O) = I3 / (2 I1),   Ik = integral over O of k s^(k-1):
//
// a face pressed in flat d^2/2, whatever its area. Wedges are regions of the mesh's frame, so only the body's surface moves
// their contents: the gradient of Ik is the integral of k s^(k-1) times the normal over the body's surface in the wedges, exact
// for any wedges. Where wedges share their sides s is continuous, and the force with it.
//
// Volumes are sums of cones from a point in the triangle's plane, over the body's faces and over the caps that the wedge's sides
// cut off. Sides that pass through that point need none.
//
// Everything in the mesh's frame. Borrows all it is given.
class WedgeOverlap {
 public:
  // `vertices`, `normals`: the body's, placed. `center`: of its box; `radius`: of a ball about it that holds the body.
  WedgeOverlap(const convex::Polytope &body, const std::vector<Vec3> &vertices, const std::vector<Vec3> &normals,
               const TriangleMesh &mesh, const Vec3 &center, double radius, OverlapScratch &scratch)
      : body_(body), vertices_(vertices), normals_(normals), mesh_(mesh), center_(center), radius_(radius), scratch_(scratch) {}

  // What lies behind triangle t.
  void add(std::uint32_t t);

  // Whether the mesh's front pushes surface that faces it.
  bool touches() const { return deepest_ > 0.0 && patches_.area() > 0.0 && first_.integral > 0.0; }

  double energy() const { return 0.5 * third_.integral / first_.integral; }
  // On the body; torque about the patches' origin.
  Wrench wrench() const;
  double radius() const { return radius_; }
  // The patches that face the triangles, by depth and area.
  const DirectionPatches &patches() const { return patches_; }

  double deepest() const { return deepest_; }
  const Vec3 &deepest_place() const { return deepest_place_; }
  const Vec3 &deepest_normal() const { return deepest_normal_; }

 private:
  // I1 or I3 and its gradient by the body's pose.
  struct Integral {
    double integral = 0.0;
    Wrench gradient;
  };

  bool set_planes(std::uint32_t t);
  bool offer(const OverlapScratch::Plane &plane);
  void keep_before(const OverlapScratch::Plane &plane);
  void integrate(const OverlapScratch::Piece &piece);
  double depth(const Vec3 &p) const { return offset_ - dot(normal_, p); }
  double inside_share(const Vec3 &p) const;

  const convex::Polytope &body_;
  const std::vector<Vec3> &vertices_, &normals_;
  const TriangleMesh &mesh_;
  Vec3 center_;
  double radius_;
  OverlapScratch &scratch_;
  DirectionPatches patches_;
  Integral first_, third_;
  bool found_ = false;
  double deepest_ = 0.0;
  Vec3 deepest_place_, deepest_normal_;
  // Of the triangle at hand:
  std::uint32_t triangle_ = 0;
  Vec3 normal_, apex_;
  double offset_ = 0.0;
  std::uint64_t front_ = 0;  // the bit of the triangle's plane, where that cuts
  PatchSums patch_;
};

}  // namespace cmb::mesh
