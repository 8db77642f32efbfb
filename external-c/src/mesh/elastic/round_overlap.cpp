#include "mesh/elastic/round_overlap.hpp"

#include <algorithm>
#include <cmath>

#include "mesh/elastic/deepest_within.hpp"

namespace cmb::mesh {

namespace {

using convex::CoreShape;
using convex::Lanes;
using convex::LaneVec3;

// How thick overlaps are, by the body's radius, of which rounding is a part that counts: they are integrated from a place within.
constexpr double hardly_thick = 1e-11;

// What a body stores on a plane, by d^2/2, is 1 then. A shallow cap of an ellipsoid stores 3/5 of what a face does, a lying cylinder's segment
// 16/21; a cylinder keeps that.
double factor_of(const convex::ConvexBody &body) {
  switch (body.core) {
    case CoreShape::ellipsoid: return 5.0 / 3.0;
    case CoreShape::segment: return 21.0 / 16.0;
    default: return 1.0;
  }
}

double radius_of(const convex::ConvexBody &body) { return convex::core_radius(body) + body.radius; }

}  // namespace

RoundOverlap::RoundOverlap(const convex::ConvexBody &body, const Pose &place, const TriangleMesh &mesh, RoundOverlapScratch &scratch)
    : WedgeIntegrals(mesh, radius_of(body), factor_of(body), hardly_thick, scratch.parts),
      whole_{body, place},
      scratch_(scratch) {
  if (body.core != CoreShape::segment) {
    pieces_[count_++] = whole_;
    return;
  }
  const double r = body.radius, half = body.half.z;
  const convex::ConvexBody ball = convex::make_ellipsoid({r, r, r});
  pieces_[count_++] = {ball, {place.rotation, place({0.0, 0.0, half})}, 0.0, HUGE_VAL};
  pieces_[count_++] = {ball, {place.rotation, place({0.0, 0.0, -half})}, -HUGE_VAL, 0.0};
  constexpr double shortest = 1e-9;
  if (half > shortest * r) pieces_[count_++] = {convex::make_cylinder(r, 2.0 * half), place, -half, half};
}

// Of a ball that goes on as another piece its half alone.
bool RoundOverlap::is_outside(const Piece &piece) const {
  const bool is_upper_half = piece.is_ellipsoid() && piece.low == 0.0, is_lower_half = piece.is_ellipsoid() && piece.high == 0.0;
  return WedgeIntegrals::is_outside(piece.place, [&](const Vec3 &d) {
    const bool is_rim = (is_upper_half && d.z < 0.0) || (is_lower_half && d.z > 0.0);
    return is_rim ? piece.body.half.x * std::sqrt(d.x * d.x + d.y * d.y) : dot(d, convex::swept_support(piece.body, d));
  });
}

// What of the wedge is about the piece; false where there is nothing.
bool RoundOverlap::set_cell(const Piece &piece) {
  const Vec3 &center = piece.place.translation;
  // How far the piece reaches along a direction.
  const auto reach = [&](const Vec3 &direction) {
    const Vec3 local = transposed_times(piece.place.rotation, direction);
    return dot(direction, center) + dot(local, convex::core_support(piece.body, local).point);
  };
  const double offset_of_front = dot(face_normal(), mesh().corner(triangle(), 0)), deepest = offset_of_front + reach(-face_normal());
  deepest_below_ = std::min(deepest, mesh().depth_limit(triangle()));
  // Most of what is not there a plane tells, before anything is cut.
  const auto may_hold = [&](const WedgePlane &plane) { return reach(plane.normal) > moved_offset(plane); };
  if (!region().visit_planes(deepest, may_hold)) return false;
  scratch_.planes.clear();
  scratch_.cell.start(center, 1.1 * radius_of(piece.body));
  // A plane that would cut through a corner of the cell is moved by as little as that.
  const auto cut = [&](const Vec3 &plane_normal, double offset) {
    for (const double shift : {0.0, 1e-11, -1e-11, 1e-10}) {
      const ConvexCell::Cut done = scratch_.cell.keep_before(plane_normal, offset + shift * radius());
      if (done != ConvexCell::Cut::failed) return done != ConvexCell::Cut::none;
    }
    return false;
  };
  if (!cut(-face_normal(), -offset_of_front)) return false;
  const WedgePlane front{transposed_times(piece.place.rotation, -face_normal()), -offset_of_front + dot(face_normal(), center), false};
  const auto limit = [&](double along, double offset) {
    const WedgePlane end{Vec3{0.0, 0.0, along}, offset, false};
    if (coincide({-end.normal, -end.offset}, front, radius())) return false;  // a piece that ends where the triangle's plane is
    scratch_.planes.push_back(end);
    if (coincide(end, front, radius())) return true;
    const Vec3 normal = along * piece.place.rotation.column(2);
    return cut(normal, offset + dot(normal, center));
  };
  if (std::isfinite(piece.low) && !limit(1.0, piece.low)) return false;
  if (std::isfinite(piece.high) && !limit(-1.0, -piece.high)) return false;
  return region().visit_planes(deepest, [&](const WedgePlane &plane) {
    const double offset = moved_offset(plane);
    if (-reach(-plane.normal) >= offset) return true;
    const WedgePlane in_body{transposed_times(piece.place.rotation, plane.normal), offset - dot(plane.normal, center), false};
    for (const WedgePlane &other : scratch_.planes) {
      if (coincide(in_body, other, radius())) return true;
      if (coincide({-in_body.normal, -in_body.offset}, other, radius())) return false;
    }
    scratch_.planes.push_back(in_body);
    return cut(plane.normal, offset);
  });
}

// From a place in the cell first. What is thin by the way from there, or open by that way, is looked at once more from itself, of which the
// edges tell where the surface does not; and where rounding is in the way at all, from a little aside.
bool RoundOverlap::find_surface(const Piece &piece) {
  constexpr double thin = 1e-5, open = 1e-9;
  // A mantle that goes on as another piece does not end at once.
  convex::ConvexBody body = piece.body;
  if (std::isfinite(piece.high) && !piece.is_ellipsoid()) body.half.z += body.half.x;
  const RevolvedBody revolved(body);
  const convex::PolytopeView cell = scratch_.cell.surface();
  OverlapSurface &surface = scratch_.surface;
  Vec3 place;
  for (const Vec3 &v : cell.vertices) place = place + v;
  place = transposed_times(piece.place.rotation, (1.0 / static_cast<double>(cell.vertices.size())) * place - piece.place.translation);
  Pose in_body = piece.place.inverse();
  const auto find = [&](bool from_apex) {
    if (piece.is_ellipsoid()) return scratch_.ball.find(body.half, cell, in_body, place, surface);
    return scratch_.revolved.find(revolved, cell, in_body, place, surface, Mantle::Partner::wedge, from_apex);
  };
  constexpr int attempts = 8;
  double aside = 1e-10 * radius();
  for (int attempt = 1; attempt <= attempts; ++attempt) {
    const bool found = find(false);
    if (surface.of_a().empty() && surface.of_b().empty()) return false;
    const Vec3 nearer = surface.place() + surface.middle();
    const double way = norm(nearer - place), volume = surface.volume();
    if (found && (attempt == attempts || (volume > thin * way * surface.area_a() && open * volume > way * surface.gap()))) {
      // Where a cone's border as good as turns in its apex the mantle may be added and taken off far from the triangle, at a depth of which the cube
      // counts.
      constexpr double far = 2.0;
      if (piece.body.core != CoreShape::cone) return true;
      const double off = farthest_off(piece);
      if (off > far * deepest_below_ && (!find(true) || farthest_off(piece) > off)) return find(false);
      return true;
    }
    if (!found && attempt > 1) {
      in_body.translation = in_body.translation + aside * Vec3{0.61, -0.53, 0.59};
      aside *= 10.0;
    }
    place = found ? nearer : place_on_edges(piece, surface.place() + surface.middle_of_area());
  }
  return false;
}

// How far any of the surface that is summed over is from the triangle's plane.
double RoundOverlap::farthest_off(const Piece &piece) const {
  const Vec3 local = transposed_times(piece.place.rotation, face_normal());
  const double at_place = depth(piece.place(scratch_.surface.place()));
  double most = 0.0;
  for (const OverlapSurface::Node &node : scratch_.surface.of_a()) most = std::fmax(most, std::fabs(at_place - dot(local, node.at)));
  return most;
}

// Among the parts of the cell's edges in the piece, which are in the overlap; `otherwise` where there are none.
Vec3 RoundOverlap::place_on_edges(const Piece &piece, const Vec3 &otherwise) const {
  Vec3 sum;
  int count = 0;
  const auto add = [&](const Vec3 &at) { sum = sum + at, ++count; };
  visit_edge_ends(piece, add);
  return count > 0 ? (1.0 / count) * sum : otherwise;
}

void RoundOverlap::add(const WedgeRegion &region) {
  look_at(region);
  if (is_out_of_reach(whole_.place.translation) || is_outside(whole_)) return;
  for (std::size_t k = 0; k < count_; ++k) {
    const Piece &piece = pieces_[k];
    if ((count_ > 1 && is_outside(piece)) || !set_cell(piece) || !find_surface(piece)) continue;
    begin(piece.place(scratch_.surface.place() + scratch_.surface.middle()));
    integrate(piece);
  }
}

// The greatest depth of the piece below the triangle at hand, and its place in its frame; 0 where it is not above `enough`.
double RoundOverlap::deepest_of_overlap(const Piece &piece, const Vec3 &local, double enough, Vec3 &deepest_place) const {
  const double center_depth = depth(piece.place.translation);
  const auto depth_of = [&](const Vec3 &at) { return center_depth - dot(local, at); };
  switch (deepest_within(piece.body, -local, scratch_.planes, enough - center_depth, deepest_place)) {
    case Deepest::none: return 0.0;
    case Deepest::found: return depth_of(deepest_place);
    case Deepest::on_edges: break;
  }
  double deepest = 0.0;
  const auto offer = [&](const Vec3 &at) {
    if (depth_of(at) > deepest) deepest = depth_of(at), deepest_place = at;
  };
  visit_edge_ends(piece, offer);
  return deepest;
}

// `at_place` being the depth of the surface's place and `local` the triangle's normal in the body's frame: over cones from the place, so
// that powers of a thickness are no difference of powers of a width. The overlap is convex,
// between a cone on the triangle's plane, with a quarter of its height and a twentieth of the cube of it, and one that stands on its tip: what is so
// thin that rounding counts keeps within these.
RoundOverlap::Means RoundOverlap::means(const Piece &piece, double at_place, const Vec3 &local) const {
  constexpr double thin = 1e-6, least[2] = {0.25, 0.05}, most[2] = {0.75, 0.5};
  const OverlapSurface &surface = scratch_.surface;
  const double place2 = at_place * at_place, place3 = at_place * place2;
  const LaneVec3 inward(-local);
  Lanes depths{}, cubes{};
  for (const auto *const side : {&surface.of_a(), &surface.of_b()}) {
    side->visit_pairs([&](const OverlapSurface::Nodes::Pair &node) {
      const Lanes change = dot(inward, node.at);
      depths += node.cone * (at_place + 0.75 * change);
      cubes += node.cone * (place3 + change * (2.25 * place2 + change * (1.8 * at_place + 0.5 * change)));
    });
  }
  const double part = 1.0 / (3.0 * surface.volume());
  const Means known{part * convex::sum_of(depths), part * convex::sum_of(cubes)};
  if (surface.volume() > thin * radius() * surface.area_a()) return known;
  Vec3 deepest_place;
  const double deepest = deepest_of_overlap(piece, local, 0.0, deepest_place);
  const double cube = deepest * deepest * deepest;
  return {std::clamp(known.depth, least[0] * deepest, most[0] * deepest), std::clamp(known.cube, least[1] * cube, most[1] * cube)};
}

void RoundOverlap::integrate(const Piece &piece) {
  const OverlapSurface &surface = scratch_.surface;
  const Vec3 place = piece.place(surface.place()), from_origin = place - origin();
  const Vec3 local = transposed_times(piece.place.rotation, face_normal());
  const double at_place = depth(place);
  const Means mean = means(piece, at_place, local);
  part().second.integral += 2.0 * surface.volume() * mean.depth;
  part().fourth.integral += 4.0 * surface.volume() * mean.cube;
  const LaneVec3 inward(-local), base(from_origin);
  LaneVec3 second_force, second_torque, fourth_force, fourth_torque;  // torques about the surface's place
  LanePatchSums patches;
  surface.of_a().visit_pairs([&](const OverlapSurface::Nodes::Pair &node) {
    const Lanes deep = at_place + dot(inward, node.at), cubes = 4.0 * deep * deep * deep;
    const LaneVec3 torque = cross(node.at, node.area);
    second_force = second_force + (2.0 * deep) * node.area, second_torque = second_torque + (2.0 * deep) * torque;
    fourth_force = fourth_force + cubes * node.area, fourth_torque = fourth_torque + cubes * torque;
    patches.add_places(dot(inward, node.area), base + piece.place.rotation * node.at, deep);
  });
  const Wrench second{convex::sum_of(second_force), convex::sum_of(second_torque)};
  const Wrench fourth{convex::sum_of(fourth_force), convex::sum_of(fourth_torque)};
  PatchSums patch = patches.sums();
  const auto add = [&](const Wrench &sum, Integral &integral) {
    const Vec3 force = piece.place.rotation * sum.force;
    integral.gradient.add(force, from_origin);
    integral.gradient.torque = integral.gradient.torque + piece.place.rotation * sum.torque;
  };
  add(second, part().second);
  add(fourth, part().fourth);
  // Surface that faces away is taken off, which leaves sums of polynomials; a wall's patches right through the body vanish so. The area is at
  // least a part of what so great a volume has at the greatest depth.
  constexpr double least_area = 0.25;
  patch.area = std::max(patch.area, least_area * surface.volume() / deepest_below_);
  patch.load = std::max(patch.load, 0.0);
  if (patch.load > deepest_below_ * patch.area) patch.scale(deepest_below_ * patch.area / patch.load);
  // Nor is its mean depth much more than that by area: what vanishes has none.
  constexpr double most_uneven = 4.0;
  const double most_mean = std::min(deepest_below_, most_uneven * patch.load / patch.area);
  patch.energy = std::clamp(patch.energy, 0.0, most_mean * patch.load);
  patch.keep_within(piece.place.translation - origin(), radius_of(piece.body));
  add_patch(patch, piece.place(surface.place() + surface.middle()));
  if (!(patch.load > 0.0)) return;
  Vec3 deepest_place;
  const double deep = deepest_of_overlap(piece, local, deepest(), deepest_place);
  if (deep > deepest()) offer_deepest(deep, piece.place(deepest_place)), offer_lowest(deep, piece.place(deepest_place));
}

}  // namespace cmb::mesh
