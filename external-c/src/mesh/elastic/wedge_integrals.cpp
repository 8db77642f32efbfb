#include "mesh/elastic/wedge_integrals.hpp"

#include <cmath>

namespace cmb::mesh {

void WedgeIntegrals::look_at(std::uint32_t t) {
  triangle_ = t;
  normal_ = mesh_.face_normal(t);
  offset_ = dot(normal_, mesh_.corner(t, 0));
}

bool WedgeIntegrals::is_out_of_reach(const Vec3 &center) const {
  if (depth(center) <= -radius_) return true;
  for (const WedgeSide &side : mesh_.wedge_sides(triangle_)) {
    if (dot(side.normal, center) - side.offset <= -radius_) return true;
  }
  return false;
}

void WedgeIntegrals::begin(const Vec3 &place) {
  if (!begun_) patches_.set_origin(place);
  begun_ = true;
}

void WedgeIntegrals::add_patch(const PatchSums &patch, const Vec3 &middle) {
  if (patch.area > 0.0) patches_.add(patch, normal_, inside_share(middle));
}

WedgeIntegrals::PolygonSums WedgeIntegrals::add_surface(const Vec3 *polygon, std::size_t count, const Vec3 &normal, PatchSums &patch) {
  const double cosine = -dot(normal, normal_);
  PolygonSums sums;
  Vec3 places, places_by_squares;
  const Vec3 &origin = patches_.origin();
  const Vec3 p = polygon[0] - origin;
  const double dp = depth_behind(polygon[0]);
  Vec3 q = polygon[1] - origin;
  double dq = depth_behind(polygon[1]);
  double deepest = dp >= dq ? dp : dq;
  Vec3 deepest_place = dp >= dq ? polygon[0] : polygon[1];
  for (std::size_t i = 2; i < count; ++i) {
    const Vec3 r = polygon[i] - origin;
    const double dr = depth_behind(polygon[i]);
    const double size = 0.5 * dot(normal, cross(q - p, r - p));
    const double depths = dp + dq + dr, of_squares = dp * dp + dq * dq + dr * dr;
    sums.area += size;
    sums.squares += size * (depths * depths + of_squares) / 12.0;
    const Vec3 sum = p + q + r, weighted = dp * p + dq * q + dr * r;
    const Vec3 by_squares = (dp * dp) * p + (dq * dq) * q + (dr * dr) * r;
    places = places + (size / 3.0) * sum;
    places_by_squares = places_by_squares + (size / 60.0) * ((depths * depths + of_squares) * sum + (2.0 * depths) * weighted +
                                                              2.0 * by_squares);
    if (cosine > 0.0) patch.add_triangle(cosine * size, p, dp, q, dq, r, dr);
    if (dr > deepest) deepest = dr, deepest_place = polygon[i];
    q = r;
    dq = dr;
  }
  first_.gradient.force = first_.gradient.force + sums.area * normal;
  first_.gradient.torque = first_.gradient.torque + cross(places, normal);
  third_.gradient.force = third_.gradient.force + (3.0 * sums.squares) * normal;
  third_.gradient.torque = third_.gradient.torque + cross(3.0 * places_by_squares, normal);
  if (cosine > 0.0) offer_deepest(deepest, deepest_place);
  return sums;
}

void WedgeIntegrals::offer_deepest(double depth, const Vec3 &place) {
  if (!(depth > deepest_) || !(inside_share(place) > 0.0)) return;
  deepest_ = depth;
  deepest_place_ = place;
  deepest_normal_ = normal_;
}

// 1 where the triangle's plane is what is nearest to a point behind it; falls to 0 where another part of the surface
// is nearer by half, as on the far side of a thin wall. Down to the clear depth nothing is, which need not be looked up.
double WedgeIntegrals::inside_share(const Vec3 &p) const {
  const double clear = mesh_.clear_depth(triangle_), deep = depth(p);
  if (!mesh_.closed() || deep <= clear) return 1.0;
  const double share = std::fmin(1.0, std::fmax(0.0, -2.0 * mesh_.nearest(p, triangle_).distance / deep - 1.0 + 1e-9));
  return deep >= 2.0 * clear ? share : 1.0 - (deep / clear - 1.0) * (1.0 - share);
}

Wrench WedgeIntegrals::wrench() const {
  const double part = 0.5 * factor_ / first_.integral, mean = third_.integral / first_.integral;
  return {-part * (third_.gradient.force - mean * first_.gradient.force),
          -part * (third_.gradient.torque - mean * first_.gradient.torque)};
}

}  // namespace cmb::mesh
