#include "mesh/patch_load.hpp"

#include <cmath>

namespace cmb::mesh {

namespace {

constexpr std::size_t most_points = 64;  // merging takes the square of their number

}  // namespace

void PatchLoad::open(const TriangleWedge &wedge) {
  wedge_ = &wedge;
  axis_ = mesh_.corner(wedge.triangle(), 1) - mesh_.corner(wedge.triangle(), 0);
  for (Patch &patch : quadrants_) patch = {};
}

void PatchLoad::push(const Vec3 &normal, double factor) {
  const double cosine = -dot(normal, wedge_->normal());
  if (!(cosine > 0.0)) return;
  std::vector<Vec3> &polygon = scratch_.polygon;
  wedge_->clip(polygon, scratch_.clipped);
  if (polygon.size() < 3) return;
  const auto depth = [&](const Vec3 &p) { return std::fmax(0.0, wedge_->depth(p)); };
  Vec3 middle;
  for (const Vec3 &p : polygon) middle = middle + p;
  middle = (1.0 / static_cast<double>(polygon.size())) * middle;
  const double middle_depth = depth(middle);
  const double carried = inside_share(middle, middle_depth);
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 &p = polygon[i], &q = polygon[i + 1 == polygon.size() ? 0 : i + 1];
    const double dp = depth(p);
    add_part(middle, p, q, middle_depth, dp, depth(q), cosine, carried, factor);
    if (carried > 0.0 && dp > deepest_) {
      deepest_ = dp;
      deepest_place_ = p;
      deepest_normal_ = wedge_->normal();
    }
  }
}

// Triangle pqr with depths at its corners; `cosine` is that between its plane and the contact plane.
void PatchLoad::add_part(const Vec3 &p, const Vec3 &q, const Vec3 &r, double dp, double dq, double dr, double cosine,
                         double carried, double factor) {
  const double area = 0.5 * norm(cross(q - p, r - p)) * cosine, sum = dp + dq + dr;
  area_ += area;
  carrying_area_ += carried * area;
  if (!(area * sum > 0.0)) return;
  most_carried_ = std::fmax(most_carried_, carried);
  const double share = factor * carried * area;
  const Vec3 off = p + q + r - 3.0 * center_;
  const bool right = dot(axis_, off) >= 0.0, ahead = dot(cross(wedge_->normal(), axis_), off) >= 0.0;
  Patch &patch = quadrants_[(right ? 1 : 0) + (ahead ? 2 : 0)];
  patch.load += share * sum / 3.0;
  patch.energy += share * (sum * sum + dp * dp + dq * dq + dr * dr) / 12.0;
  patch.moment = patch.moment + (share / 12.0) * ((dp + sum) * p + (dq + sum) * q + (dr + sum) * r);
}

void PatchLoad::close() {
  for (const Patch &patch : quadrants_) {
    if (!(patch.load > 0.0)) continue;
    const double depth = patch.energy / patch.load;
    if (!(depth > 0.0)) continue;
    const Vec3 place = (1.0 / patch.load) * patch.moment + (0.5 * depth) * wedge_->normal();
    result_.points.push_back({depth, patch.load / depth, pose_.rotation * wedge_->normal(), pose_(place)});
  }
}

// 1 where the triangle's plane is what is nearest to a point behind it; falls to 0 where another part of the surface
// is nearer by half, as on the far side of a thin wall.
double PatchLoad::inside_share(const Vec3 &p, double depth) const {
  if (!mesh_.closed() || !(depth > 0.0)) return 1.0;
  return std::fmin(1.0, std::fmax(0.0, -2.0 * mesh_.nearest(p, wedge_->triangle()).distance / depth - 1.0 + 1e-9));
}

void PatchLoad::finish(double part) {
  // Patches that belong to another side do not count, unless there are no others.
  const double area = carrying_area_ + (1.0 - most_carried_) * area_;
  for (std::size_t i = begin_; i < result_.points.size(); ++i) result_.points[i].weight *= part / area;
  thin();
  result_.distance = -deepest_;
  result_.normal = pose_.rotation * deepest_normal_;
  result_.witness = pose_(deepest_place_ + (0.5 * deepest_) * deepest_normal_);
}

// Merges neighbours until there are few; keeps the sums of forces and, but for what turns about the force, of moments.
void PatchLoad::thin() {
  std::vector<ContactPoint> &points = result_.points;
  while (points.size() - begin_ > most_points) {
    std::size_t kept = begin_;
    for (std::size_t i = begin_; i < points.size(); i += 2, ++kept) {
      points[kept] = points[i];
      if (i + 1 == points.size()) continue;
      const ContactPoint &a = points[i], &b = points[i + 1];
      const double load_a = a.weight * a.depth, load_b = b.weight * b.depth, load = load_a + load_b;
      const Vec3 force = load_a * a.normal + load_b * b.normal;
      const Vec3 middle = (1.0 / load) * (load_a * a.position + load_b * b.position);
      const Vec3 moment = cross(a.position - middle, load_a * a.normal) + cross(b.position - middle, load_b * b.normal);
      ContactPoint merged;
      merged.depth = (load_a * a.depth + load_b * b.depth) / load;
      merged.weight = norm(force) / merged.depth;
      merged.normal = normalized(force, a.normal);
      merged.position = middle;
      if (norm2(force) > 1e-6 * load * load) merged.position = middle + (1.0 / norm2(force)) * cross(force, moment);
      points[kept] = merged;
    }
    points.resize(kept);
  }
}

}  // namespace cmb::mesh
