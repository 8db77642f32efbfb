#include "manifold/revolved/revolved_contact.hpp"

#include <algorithm>
#include <cmath>

#include "manifold/load_points.hpp"
#include "manifold/revolved/depth_in_revolved.hpp"
#include "math/pose_algebra.hpp"
#include "math/smoothstep.hpp"

namespace cmb {

namespace {

// A body's part of the energy, by what a side's place adds to its soft least mean square, and the means of how that changes by the place.
class PolytopePart {
 public:
  PolytopePart(DepthBelowFaces &depth, const ContactPolytope &polytope, const Pose &in_axes, const OverlapSurface &surface)
      : depth_(depth), middle_(surface.middle()) {
    depth_.find(surface.place() + surface.middle(), surface.spread(), polytope, in_axes);
  }
  double least() const { return depth_.least(); }
  double excess(const Vec3 &p) const { return depth_.squares().at(p - middle_) - depth_.least(); }
  convex::Lanes excess(const convex::LaneVec3 &p) const { return depth_.squares().at(p - convex::LaneVec3(middle_)) - depth_.least(); }
  void find_mean_slope(const OverlapSurface &, Vec3 &slope, Vec3 &moment) const {
    slope = -2.0 * depth_.squares().linear;
    moment = depth_.moment();
  }

 private:
  DepthBelowFaces &depth_;
  const Vec3 middle_;
};

// The energy of polytopes (polytope/overlap_energy.hpp): the mean of what both bodies store, 3/2 of the soft least mean square of the
// depths below their sides. As the depths in a body move with that body, its part changes by the other one's surface alone; over all of the
// overlap's surface the integral is one over its inside, which takes longer to find. But of a thin edge both sides nearly cancel: there
// rather the surface that cuts it off.
template <typename PartA, typename PartB>
OverlapLoad load_of(const OverlapSurface &surface, const PartA &a, const PartB &b, const FlushSides &flush) {
  constexpr double thin = 0.1;
  const Vec3 middle = surface.middle();
  Vec3 force, torque;
  const auto push_node = [&](const OverlapSurface::Node &node, double pressure) {
    force = force + pressure * node.area;
    torque = torque + pressure * cross(node.at - middle, node.area);
  };
  // Of A's or B's surface what counts as that, and what of the other one's counts so, too.
  const auto push = [&](const OverlapSurface::Nodes &side, double sense, const auto &excess) {
    if (!flush.any()) {
      const convex::LaneVec3 from(middle);
      convex::LaneVec3 forces, torques;
      side.visit_pairs([&](const OverlapSurface::Nodes::Pair &node) {
        const convex::LaneVec3 push_there = (sense * excess(node.at)) * node.area;
        forces = forces + push_there;
        torques = torques + cross(node.at - from, push_there);
      });
      force = force + sum_of(forces), torque = torque + sum_of(torques);
      return;
    }
    const bool of_a_side = &side == &surface.of_a();
    for (const OverlapSurface::Node &node : surface.of_a()) {
      const double share = flush.share_of_a(node), part = of_a_side ? share : 1.0 - share;
      if (part != 0.0) push_node(node, sense * part * excess(node.at));
    }
    for (const OverlapSurface::Node &node : surface.of_b()) {
      const double share = flush.share_of_b(node), part = of_a_side ? 1.0 - share : share;
      if (part != 0.0) push_node(node, sense * part * excess(node.at));
    }
  };
  // Of a place, or two.
  const auto of_a = [&](const auto &p) { return a.excess(p); };
  const auto of_b = [&](const auto &p) { return b.excess(p); };
  const auto of_both = [&](const auto &p) { return a.excess(p) + b.excess(p); };
  Vec3 slope, moment;
  double inside = 0.0;
  if (surface.area_b() < thin * surface.area_a()) {
    push(surface.of_b(), 1.0, of_both);
    b.find_mean_slope(surface, slope, moment);
    inside = -0.75;
  } else if (surface.area_a() < thin * surface.area_b()) {
    push(surface.of_a(), -1.0, of_both);
    a.find_mean_slope(surface, slope, moment);
    inside = 0.75;
  } else {
    push(surface.of_b(), 1.0, of_a);
    push(surface.of_a(), -1.0, of_b);
  }
  const double part = 0.75 / surface.volume();
  return {0.75 * (a.least() + b.least()), part * force + inside * slope, part * torque + inside * moment, surface.place() + middle,
          surface.spread()};
}

// How thick an overlap is in which this is the mean square of the depths below the sides of either.
double thickness_of(double least_a, double least_b) { return std::sqrt(1.5 * (least_a + least_b)); }

// The plane sides of a body of revolution, by normal and offset from the surface's place.
template <typename Visit>
void visit_ends(const RevolvedBody &body, const Pose &in_axes, const OverlapSurface &surface, Visit &&visit) {
  const Vec3 axis = in_axes.rotation.column(2);
  const double height = dot(axis, surface.place() - in_axes.translation);
  visit(-axis, body.half + height);
  if (body.is_cylinder()) visit(axis, body.half - height);
}

void find_flush(const RevolvedBody &body, const Pose &body_in_axes, const ContactPolytope &polytope, const Pose &polytope_in_axes,
                const OverlapSurface &surface, double thickness, FlushSides &flush) {
  flush.start(surface, thickness);
  visit_ends(body, body_in_axes, surface, [&](const Vec3 &normal, double offset) {
    if (polytope.greatest_face_cosine(transposed_times(polytope_in_axes.rotation, normal)) < FlushSides::least_cosine) return;
    for (const convex::Polytope::Face &face : polytope.geometry().faces()) {
      const Vec3 face_normal = polytope_in_axes.rotation * face.normal;
      const double from_place = face.offset + dot(face_normal, polytope_in_axes.translation - surface.place());
      flush.add(normal, offset, face_normal, from_place);
    }
  });
}

void find_flush(const RevolvedBody &a, const Pose &a_in_axes, const RevolvedBody &b, const Pose &b_in_axes, const OverlapSurface &surface,
                double thickness, FlushSides &flush) {
  flush.start(surface, thickness);
  visit_ends(a, a_in_axes, surface, [&](const Vec3 &normal_a, double offset_a) {
    visit_ends(b, b_in_axes, surface, [&](const Vec3 &normal_b, double offset_b) { flush.add(normal_a, offset_a, normal_b, offset_b); });
  });
}

// Where a face lies in an end, or an edge passes through a cone's apex, rounding decides what is whose, and may decide differently for sides
// that meet. So the polytope is looked at from beside, by more than rounding and less than counts, and where sides do not fit together all
// the same from farther and farther; `in_frame` says from where.
bool find_surface(const RevolvedBody &body, const ContactPolytope &polytope, const Vec3 &place, RevolvedScratch &scratch, Pose &in_frame) {
  const Vec3 at = in_frame.translation;
  for (const double aside : {3e-14, 1e-12, 1e-11, 1e-10, 1e-9}) {
    in_frame.translation = at + aside * (body.radius + body.half) * Vec3{0.61, -0.53, 0.59};
    if (scratch.on_polytope.find(body, polytope.geometry(), in_frame, place, scratch.surface)) return true;
    if (scratch.surface.of_a().empty() && scratch.surface.of_b().empty()) return false;
  }
  return false;
}

// So of two bodies of revolution, where their mantles cross in a curve through itself, or a border lies in a mantle.
bool find_surface(const RevolvedBody &a, const RevolvedBody &b, const Pose &b_in_a, const Vec3 &deepest_a, const Vec3 &deepest_b,
                  RevolvedScratch &scratch) {
  const double size = std::min(a.radius + a.half, b.radius + b.half);
  for (const double aside : {0.0, 1e-12, 1e-11, 1e-10, 1e-9}) {
    const Vec3 shift = aside * size * Vec3{0.61, -0.53, 0.59};
    if (scratch.pair.find(a, b, {b_in_a.rotation, b_in_a.translation + shift}, deepest_a, deepest_b, scratch.surface)) return true;
  }
  return false;
}

}  // namespace

bool revolved_on_polytope_contact(const Shape &revolved, const Pose &revolved_pose, const ContactPolytope &polytope,
                                  const Pose &polytope_pose, const Vec3 &witness, double sense, RevolvedScratch &scratch,
                                  std::vector<ContactPoint> &points) {
  const RevolvedBody body(revolved.body);
  Pose in_frame = relative_pose(revolved_pose, polytope_pose);
  const Vec3 place = transposed_times(revolved_pose.rotation, witness - revolved_pose.translation);
  if (!find_surface(body, polytope, place, scratch, in_frame)) return false;
  OverlapSurface &surface = scratch.surface;
  const Pose to_axes{surface.align(), {}};
  const Pose polytope_in_axes = compose(to_axes, in_frame);
  const DepthInRevolved in_revolved(body, to_axes, surface);
  const PolytopePart in_polytope(scratch.faces, polytope, polytope_in_axes, surface);
  find_flush(body, to_axes, polytope, polytope_in_axes, surface, thickness_of(in_revolved.least(), in_polytope.least()), scratch.flush);
  const OverlapLoad load = load_of(surface, in_revolved, in_polytope, scratch.flush);
  return append_load_points(load, compose(revolved_pose, to_axes.inverse()), to_axes.rotation, sense, points);
}

PairLoad revolved_pair_contact(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b, const Vec3 &deepest_a,
                               const Vec3 &deepest_b, RevolvedScratch &scratch, std::vector<ContactPoint> &points) {
  const RevolvedBody body_a(a.body), body_b(b.body);
  const Pose b_in_a = relative_pose(pose_a, pose_b);
  OverlapSurface &surface = scratch.surface;
  const auto in_a = [&](const Vec3 &place) { return transposed_times(pose_a.rotation, place - pose_a.translation); };
  if (!find_surface(body_a, body_b, b_in_a, in_a(deepest_a), in_a(deepest_b), scratch)) return {};
  const Pose to_axes{surface.align(), {}};
  const DepthInRevolved in_body_a(body_a, to_axes, surface), in_body_b(body_b, compose(to_axes, b_in_a), surface);
  find_flush(body_a, to_axes, body_b, compose(to_axes, b_in_a), surface, thickness_of(in_body_a.least(), in_body_b.least()), scratch.flush);
  const OverlapLoad load = load_of(surface, in_body_a, in_body_b, scratch.flush);
  if (!append_load_points(load, compose(pose_a, to_axes.inverse()), to_axes.rotation, 1.0, points)) return {};
  // What the sides are pushed by, of which only a difference may be left, and by how much rounding moves them beside how thick the overlap is.
  constexpr double rounding = 1e-15, known = 1e-6, unknown = 1e-4;
  const double pushed = 0.75 / surface.volume() * (in_body_a.least() * surface.area_b() + in_body_b.least() * surface.area_a());
  const double thickness = surface.volume() / std::min(surface.area_a(), surface.area_b());
  const double noise = pushed / norm(load.force) * rounding * (a.bound_radius + b.bound_radius) / thickness;
  return {load.energy, convex::falling_smoothstep(std::max(0.0, std::log(noise / known) / std::log(unknown / known)))};
}

}  // namespace cmb
