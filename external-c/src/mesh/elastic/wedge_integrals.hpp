// What the overlap with the wedge behind each triangle of a mesh stores, as an elastic solid.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "mesh/core/triangle_mesh.hpp"
#include "mesh/elastic/direction_patches.hpp"
#include "mesh/wedges/wedge_region.hpp"

namespace cmb::mesh {

// A force with its torque about the origin.
struct Wrench {
  Vec3 force, torque;

  void add(const Vec3 &f, const Vec3 &at) {
    force = force + f;
    torque = torque + cross(at, f);
  }
};

// Integrals over the overlap with the wedge behind triangle t, s being the depth below it: Ik = integral of k s^(k-1). Wedges are regions of
// the mesh's frame, so only the body's surface moves their contents: the gradient of Ik is the integral of k s^(k-1) times the normal over
// the body's surface in the wedge. Of surface in the mesh's own that is nothing, so whether it counts makes no difference.
//
// Everything in the mesh's frame. Borrows the mesh.
class WedgeIntegrals {
 public:
  // I2 or I4 and its gradient by the body's pose; torques about the origin of places.
  struct Integral {
    double integral = 0.0;
    Wrench gradient;

    double value() const { return integral > 0.0 ? integral : 0.0; }  // what is next to nothing may be less, by rounding
  };
  // What is behind one flat face, or a triangle by itself.
  struct Part {
    std::uint32_t face;
    Integral second, fourth;
    DirectionPatches patches;  // that face it, as far as they carry
    double load = 0.0, depth_load = 0.0;  // of these: of the depth and its square, by area
    Wrench push;                          // depth by area along the normals; torque about the origin

    double mean_depth() const { return depth_load / load; }  // each place by its depth
  };

  // `radius`: of a ball that holds the body. `factor`: of the energy (WedgeEnergy). Of overlaps as thin as `hardly_known`, by the radius, the
  // gradient is rounding; 0 where that is known of all. `parts`: room, which is overwritten.
  WedgeIntegrals(const TriangleMesh &mesh, double radius, double factor, double hardly_known, std::vector<Part> &parts)
      : mesh_(mesh), radius_(radius), factor_(factor), hardly_known_(hardly_known), parts_(parts) {
    parts_.clear();
  }

  const std::vector<Part> &parts() const { return parts_; }
  const TriangleMesh &mesh() const { return mesh_; }
  // What places are relative to: near the overlaps.
  const Vec3 &origin() const { return origin_; }
  // The greatest part of a patch that carries.
  double most_carried() const { return most_carried_; }
  double radius() const { return radius_; }
  double factor() const { return factor_; }
  double hardly_known() const { return hardly_known_; }

  double deepest() const { return deepest_; }
  // The same of surface that does not face away from the triangles.
  double lowest() const { return lowest_; }
  const Vec3 &deepest_place() const { return deepest_place_; }
  const Vec3 &deepest_normal() const { return deepest_normal_; }

 protected:
  // What follows is of that region.
  void look_at(const WedgeRegion &region);
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
    const std::array<WedgeSide, 3> &sides = region_.sides();
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
  // The same where all is plane, of which rounding is less: what cuts leave of a side in the plane would be on either side of it by chance.
  WedgePlane moved_aside(const WedgePlane &plane) const {
    const double aside = 1e-13 * radius_;
    return {plane.normal, plane.offset + (plane.strict ? aside : -aside), plane.strict};
  }
  // Before what follows is called. `place`: near its overlap.
  void begin(const Vec3 &place);
  Part &part() { return parts_[at_hand_]; }
  // What faces the triangle at hand; about its `middle` it is asked whether the triangle is the nearest part of the mesh.
  void add_patch(const PatchSums &patch, const Vec3 &middle);
  // Of a plane polygon.
  struct PolygonSums {
    double depths = 0.0, cubes = 0.0;  // of the depth
  };
  // A plane convex piece of the body's surface in the wedge, whose unit outward normal is `normal`: takes its part of the gradients, and,
  // where it faces the triangle, of the patch.
  PolygonSums add_surface(const Vec3 *polygon, std::size_t count, const Vec3 &normal, PatchSums &patch);
  // A place of the body's surface that faces the triangle at hand.
  void offer_deepest(double depth, const Vec3 &place);
  // One that does not face away from it.
  void offer_lowest(double depth, const Vec3 &place);

  const WedgeRegion &region() const { return region_; }
  std::uint32_t triangle() const { return region_.triangle(); }
  // Its normal.
  const Vec3 &face_normal() const { return normal_; }
  double depth(const Vec3 &p) const { return offset_ - dot(normal_, p); }

  // Depth, no less than 0.
  double depth_behind(const Vec3 &p) const {
    const double deep = depth(p);
    return deep > 0.0 ? deep : 0.0;
  }

 private:
  double inside_share(const Vec3 &p) const;

  const TriangleMesh &mesh_;
  double radius_, factor_, hardly_known_;
  std::vector<Part> &parts_;
  std::size_t at_hand_ = 0;
  Vec3 origin_;
  double most_carried_ = 0.0, deepest_ = 0.0, lowest_ = 0.0;
  Vec3 deepest_place_, deepest_normal_;
  // At hand:
  WedgeRegion region_{mesh_, 0};
  Vec3 normal_;
  double offset_ = 0.0;
};

}  // namespace cmb::mesh
