// What the overlaps behind a mesh's triangles store together, as an elastic solid.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "mesh/core/triangle_mesh.hpp"
#include "mesh/elastic/direction_patches.hpp"
#include "mesh/elastic/wedge_planes.hpp"

namespace cmb::mesh {

// A force with its torque about the origin.
struct Wrench {
  Vec3 force, torque;

  void add(const Vec3 &f, const Vec3 &at) {
    force = force + f;
    torque = torque + cross(at, f);
  }
};

// With the depth s below the triangle in whose wedge a place lies, the overlap O of body and mesh stores
//
//   E = factor 3/2 (mean of s^2 over O) = factor I3 / (2 I1),   Ik = integral over O of k s^(k-1):
//
// by factor 1 a face pressed in flat d^2/2, whatever its area. Wedges are regions of the mesh's frame, so only the body's surface moves
// their contents: the gradient of Ik is the integral of k s^(k-1) times the normal over the body's surface in the wedges, exact
// for any wedges. Where wedges share their sides s is continuous, and the force with it.
//
// Everything in the mesh's frame. Borrows the mesh.
class WedgeIntegrals {
 public:
  // `radius`: of a ball that holds the body.
  WedgeIntegrals(const TriangleMesh &mesh, double radius, double factor) : mesh_(mesh), radius_(radius), factor_(factor) {}

  // Whether the mesh's front pushes surface that faces it.
  bool touches() const { return deepest_ > 0.0 && patches_.area() > 0.0 && first_.integral > 0.0; }

  double energy() const { return 0.5 * factor_ * third_.integral / first_.integral; }
  // About how deep the body's surface lies in the mesh's: of a flat face, exactly.
  double surface_depth() const { return std::sqrt(third_.integral / (factor_ * first_.integral)); }
  // The same, between its deepest place and its mean: of a corner the first, which what passes through a body is compared with, is much more.
  double carrying_depth() const { return std::sqrt(deepest_ * surface_depth()); }
  // On the body; torque about the patches' origin.
  Wrench wrench() const;
  double radius() const { return radius_; }
  // From 0, where what is so thin that its gradient is rounding, to 1.
  double known_part() const { return known_part_; }
  // The patches that face the triangles, by depth and area.
  const DirectionPatches &patches() const { return patches_; }

  double deepest() const { return deepest_; }
  const Vec3 &deepest_place() const { return deepest_place_; }
  const Vec3 &deepest_normal() const { return deepest_normal_; }

 protected:
  // I1 or I3 and its gradient by the body's pose; torques about the patches' origin.
  struct Integral {
    double integral = 0.0;
    Wrench gradient;
  };

  // What follows is of triangle t.
  void look_at(std::uint32_t t);
  // Whether the body's ball, about `center`, lies before it or beyond a side of its wedge.
  bool is_out_of_reach(const Vec3 &center) const;
  // Whether nothing of a body is below it, or that lies beyond a side of its wedge. support(d) is the greatest d . x of the body in its own
  // frame, h(d), and `place` its pose. Below the plane n . x = o, m . x is at most h(m - l n) + l o for all l >= 0.
  template <typename Support>
  bool is_outside(const Pose &place, Support &&support) const {
    const Vec3 normal = transposed_times(place.rotation, normal_);
    const double front = depth(place.translation);
    if (!(front + support(-normal) > 0.0)) return true;
    // The side that the body is farthest beyond comes first.
    const std::array<WedgeSide, 3> &sides = mesh_.wedge_sides(triangle_);
    double offset[3];
    for (std::size_t k = 0; k < 3; ++k) offset[k] = sides[k].offset - dot(sides[k].normal, place.translation);
    const std::size_t first = offset[0] > offset[1] ? (offset[0] > offset[2] ? 0 : 2) : (offset[1] > offset[2] ? 1 : 2);
    for (std::size_t k = first; k < first + 3; ++k) {
      const Vec3 inward = transposed_times(place.rotation, sides[k % 3].normal);
      for (const double share : {4.0, 16.0, 1.0}) {
        if (support(inward - share * normal) + share * front < offset[k % 3] - 2.0 * aside()) return true;
      }
    }
    return false;
  }
  // A side or an end of the body that lies in a wedge's side would count for both wedges, or for none: so sides are moved by more than rounding,
  // both wedges' the same way.
  double aside() const { return 1e-11 * radius_; }
  double moved_offset(const WedgePlane &plane) const { return plane.offset + (plane.strict ? aside() : -aside()); }
  // Before its parts are added. `place`: near its overlap.
  void begin(const Vec3 &place);
  // What faces the triangle at hand, places relative to the patches' origin; about its `middle` it is asked whether the triangle is the
  // nearest part of the mesh.
  void add_patch(const PatchSums &patch, const Vec3 &middle);
  // Of a plane polygon.
  struct PolygonSums {
    double area = 0.0, squares = 0.0;  // of the depth
  };
  // A plane convex piece of the body's surface in the wedge, whose unit outward normal is `normal`: takes its part of the gradients, and,
  // where it faces the triangle, of the patch.
  PolygonSums add_surface(const Vec3 *polygon, std::size_t count, const Vec3 &normal, PatchSums &patch);
  // A place of the body's surface that faces the triangle at hand.
  void offer_deepest(double depth, const Vec3 &place);

  void set_known_part(double part) { known_part_ = part; }
  const TriangleMesh &mesh() const { return mesh_; }
  std::uint32_t triangle() const { return triangle_; }
  // Its normal.
  const Vec3 &face_normal() const { return normal_; }
  double depth(const Vec3 &p) const { return offset_ - dot(normal_, p); }

  // Depth, no less than 0.
  double depth_behind(const Vec3 &p) const {
    const double deep = depth(p);
    return deep > 0.0 ? deep : 0.0;
  }

  Integral first_, third_;

 private:
  double inside_share(const Vec3 &p) const;

  const TriangleMesh &mesh_;
  double radius_, factor_;
  DirectionPatches patches_;
  double known_part_ = 1.0;
  bool begun_ = false;
  double deepest_ = 0.0;
  Vec3 deepest_place_, deepest_normal_;
  // Of the triangle at hand:
  std::uint32_t triangle_ = 0;
  Vec3 normal_;
  double offset_ = 0.0;
};

}  // namespace cmb::mesh
