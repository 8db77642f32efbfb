#include "mesh/contact/patch_load.hpp"

#include <cmath>

namespace cmb::mesh {

// The depth over the polygon, whose plane meets the triangle's under an angle of the given cosine.
PatchLoad::Integral PatchLoad::integrate(const std::vector<Vec3> &polygon, const TriangleWedge &wedge, double cosine) {
  Integral sum;
  const Vec3 &p = polygon[0];
  const double dp = std::fmax(0.0, wedge.depth(p));
  double dq = std::fmax(0.0, wedge.depth(polygon[1]));
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const Vec3 &q = polygon[i], &r = polygon[i + 1];
    const double dr = std::fmax(0.0, wedge.depth(r));
    const double area = 0.5 * norm(cross(q - p, r - p)) * cosine, depths = dp + dq + dr;
    sum.area += area;
    sum.load += area * depths / 3.0;
    sum.energy += area * (depths * depths + dp * dp + dq * dq + dr * dr) / 12.0;
    sum.moment = sum.moment + (area / 12.0) * ((dp + depths) * p + (dq + depths) * q + (dr + depths) * r);
    dq = dr;
  }
  return sum;
}

bool PatchLoad::push(const TriangleWedge &wedge, const Vec3 &normal) {
  std::vector<Vec3> &polygon = scratch_.polygon;
  wedge.clip(polygon, scratch_.clipped);
  if (polygon.size() < 3) return false;
  wedge.clip_roof(polygon, scratch_.clipped);
  if (polygon.size() < 3) return true;
  const double cosine = -dot(normal, wedge.normal());
  if (cosine > 0.0) {
    add_patch(wedge, cosine);
  } else {
    area_ += integrate(polygon, wedge, -cosine).area;
  }
  return true;
}

// The patch is scratch_.polygon.
void PatchLoad::add_patch(const TriangleWedge &wedge, double cosine) {
  std::vector<Vec3> &polygon = scratch_.polygon;
  const double frontal = std::fmin(1.0, 4.0 * cosine * cosine);
  for (const Vec3 &p : polygon) {
    const double depth = frontal * wedge.depth(p);
    if (!(depth > deepest_)) continue;
    deepest_ = depth;
    deepest_place_ = p;
    deepest_normal_ = wedge.normal();
  }
  // Two planes through the centre, along the two axes that the normal is farthest from, part the quadrants.
  const Vec3 &n = wedge.normal();
  const double x = std::fabs(n.x), y = std::fabs(n.y), z = std::fabs(n.z);
  const int across = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
  const int first = (across + 1) % 3, second = (across + 2) % 3;
  const auto side_of = [&](const std::vector<Vec3> &points, int axis) {  // -1, 1, or 0 where the plane cuts
    bool below = false, above = false;
    for (const Vec3 &p : points) (p[axis] < center_[axis] ? below : above) = true;
    return below && above ? 0 : below ? -1 : 1;
  };
  const auto take = [&](std::size_t quadrant) {
    const Integral integral = integrate(polygon, wedge, cosine);
    area_ += integral.area;
    if (integral.load > 0.0) add(integral, quadrant, n, frontal);
  };
  const auto split_second = [&](std::size_t quadrant) {
    const int side = side_of(polygon, second);
    if (side != 0) {
      take(quadrant + (side > 0 ? 2 : 0));
      return;
    }
    Vec3 axis;
    axis.set(second, 1.0);
    scratch_.quarter = polygon;
    clip_polygon(polygon, axis, center_[second], scratch_.clipped);
    if (polygon.size() >= 3) take(quadrant + 2);
    polygon = scratch_.quarter;
    clip_polygon(polygon, -axis, -center_[second], scratch_.clipped);
    if (polygon.size() >= 3) take(quadrant);
  };
  const int side = side_of(polygon, first);
  if (side != 0) {
    split_second(side > 0 ? 1 : 0);
    return;
  }
  Vec3 axis;
  axis.set(first, 1.0);
  scratch_.half = polygon;
  clip_polygon(polygon, axis, center_[first], scratch_.clipped);
  if (polygon.size() >= 3) split_second(1);
  polygon = scratch_.half;
  clip_polygon(polygon, -axis, -center_[first], scratch_.clipped);
  if (polygon.size() >= 3) split_second(0);
}

void PatchLoad::add(const Integral &integral, std::size_t quadrant, const Vec3 &normal, double share) {
  if (!(share > 0.0)) return;
  const Vec3 moment = integral.moment - integral.load * center_;
  sums_[quadrant].add(share * integral.load, share * integral.energy, share * moment, normal);
}

void PatchLoad::finish(ContactSet &result) const {
  for (std::size_t direction = 0; direction < DirectionSums::directions; ++direction) {
    for (const DirectionSums &quadrant : sums_) {
      ContactPoint point;
      if (!quadrant.point(direction, center_, 1.0 / area_, point)) continue;
      point.normal = pose_.rotation * point.normal;
      point.position = pose_(point.position);
      result.points.push_back(point);
    }
  }
  result.distance = -deepest_;
  result.normal = pose_.rotation * deepest_normal_;
  result.witness = pose_(deepest_place_ + (0.5 * deepest_) * deepest_normal_);
}

}  // namespace cmb::mesh
