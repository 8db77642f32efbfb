#include "mesh/elastic/wedge_integrals.hpp"

#include <cmath>

#include "mesh/elastic/depth_powers.hpp"

namespace cmb::mesh {

void WedgeIntegrals::look_at(const WedgeRegion &region) {
  region_ = region;
  normal_ = mesh_.face_normal(triangle());
  offset_ = dot(normal_, mesh_.corner(triangle(), 0));
}

bool WedgeIntegrals::is_out_of_reach(const Vec3 &center) const {
  if (depth(center) <= -radius_) return true;
  for (const WedgeSide &side : region_.sides()) {
    if (dot(side.normal, center) - side.offset <= -radius_) return true;
  }
  return false;
}

void WedgeIntegrals::begin(const Vec3 &place) {
  if (parts_.empty()) origin_ = place;
  // Triangles of a face follow each other, mostly.
  const std::uint32_t face = mesh_.faces().face_of(triangle());
  for (at_hand_ = parts_.size(); at_hand_ > 0; --at_hand_) {
    if (parts_[at_hand_ - 1].face == face) break;
  }
  if (at_hand_ > 0) {
    --at_hand_;
    return;
  }
  at_hand_ = parts_.size();
  parts_.push_back({face, {}, {}, {}, 0.0, 0.0, {}});
}

void WedgeIntegrals::add_patch(const PatchSums &patch, const Vec3 &middle) {
  if (!(patch.area > 0.0)) return;
  const double share = inside_share(middle);
  Part &part = parts_[at_hand_];
  if (!(patch.load > 0.0) || !(share > 0.0)) return;
  most_carried_ = std::fmax(most_carried_, share);
  part.patches.add(share, patch, normal_);
  part.load += share * patch.load, part.depth_load += share * patch.energy;
  part.push.force = part.push.force + (share * patch.load) * normal_;
  part.push.torque = part.push.torque + share * cross(patch.moment, normal_);
}

WedgeIntegrals::PolygonSums WedgeIntegrals::add_surface(const Vec3 *polygon, std::size_t count, const Vec3 &normal, PatchSums &patch) {
  const double cosine = -dot(normal, normal_);
  PolygonSums sums;
  Vec3 by_depths, by_cubes;  // places
  const Vec3 p = polygon[0] - origin_;
  const double dp = depth_behind(polygon[0]);
  Vec3 q = polygon[1] - origin_;
  double dq = depth_behind(polygon[1]);
  double deepest = dp >= dq ? dp : dq;
  Vec3 deepest_place = dp >= dq ? polygon[0] : polygon[1];
  for (std::size_t i = 2; i < count; ++i) {
    const Vec3 r = polygon[i] - origin_;
    const double dr = depth_behind(polygon[i]);
    const double size = 0.5 * dot(normal, cross(q - p, r - p));
    // The mean of s^k is that of all products of k of the corners' depths, that of s^k times the place their derivatives' by these.
    const ProductsOfDepths products(dp, dq, dr);
    sums.depths += size / 3.0 * products.of_one;
    sums.cubes += size / 10.0 * products.of_three;
    by_depths = by_depths + (size / 12.0) * ((products.of_one + dp) * p + (products.of_one + dq) * q + (products.of_one + dr) * r);
    by_cubes = by_cubes + (size / 60.0) * (products.of_three_with(dp) * p + products.of_three_with(dq) * q + products.of_three_with(dr) * r);
    if (cosine > 0.0) patch.add_triangle(cosine * size, p, dp, q, dq, r, dr);
    if (dr > deepest) deepest = dr, deepest_place = polygon[i];
    q = r;
    dq = dr;
  }
  Wrench &second = part().second.gradient, &fourth = part().fourth.gradient;
  second.force = second.force + (2.0 * sums.depths) * normal;
  second.torque = second.torque + cross(2.0 * by_depths, normal);
  fourth.force = fourth.force + (4.0 * sums.cubes) * normal;
  fourth.torque = fourth.torque + cross(4.0 * by_cubes, normal);
  if (cosine > 0.0) offer_deepest(deepest, deepest_place);
  // Whether a side upright on the triangle faces it rounding decides: it counts here, and what faces away a little more less and less.
  constexpr double upright = 1e-6;
  if (cosine > -2.0 * upright) offer_lowest(std::fmin(1.0, 2.0 + cosine / upright) * deepest, deepest_place);
  return sums;
}

void WedgeIntegrals::offer_deepest(double depth, const Vec3 &place) {
  if (!(depth > deepest_) || !(inside_share(place) > 0.0)) return;
  deepest_ = depth;
  deepest_place_ = place;
  deepest_normal_ = normal_;
}

void WedgeIntegrals::offer_lowest(double depth, const Vec3 &place) {
  if (depth > lowest_ && inside_share(place) > 0.0) lowest_ = depth;
}

// 1 where the triangle's plane is what is nearest to a point behind it; falls to 0 where another part of the surface
// is nearer by half, as on the far side of a thin wall. Down to the clear depth nothing is, which need not be looked up.
double WedgeIntegrals::inside_share(const Vec3 &p) const {
  const double clear = mesh_.clear_depth(triangle()), deep = depth(p);
  if (!mesh_.closed() || deep <= clear) return 1.0;
  const double share = std::fmin(1.0, std::fmax(0.0, -2.0 * mesh_.nearest(p, triangle()).distance / deep - 1.0 + 1e-9));
  return deep >= 2.0 * clear ? share : 1.0 - (deep / clear - 1.0) * (1.0 - share);
}

}  // namespace cmb::mesh
