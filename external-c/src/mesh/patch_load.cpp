#include "mesh/patch_load.hpp"

#include <cmath>

namespace cmb::mesh {

namespace {

constexpr std::size_t most_points = 64;    // merging takes the cube of their number
constexpr std::size_t split_patches = 16;  // patches that give several points each

}  // namespace

// Of triangle pqr with depths at its corners; `cosine` is that between its plane and the contact plane.
PatchLoad::Patch PatchLoad::linear_patch(const Vec3 &p, const Vec3 &q, const Vec3 &r, double dp, double dq, double dr,
                                         double cosine) {
  Patch patch;
  patch.area = 0.5 * norm(cross(q - p, r - p)) * cosine;
  const double sum = dp + dq + dr;
  patch.load = patch.area * sum / 3.0;
  patch.energy = patch.area * (sum * sum + dp * dp + dq * dq + dr * dr) / 12.0;
  patch.moment = (patch.area / 12.0) * ((dp + sum) * p + (dq + sum) * q + (dr + sum) * r);
  return patch;
}

void PatchLoad::push(const TriangleWedge &wedge, const Vec3 &normal, double factor) {
  const double cosine = -dot(normal, wedge.normal());
  if (!(cosine > 0.0)) return;
  std::vector<Vec3> &polygon = scratch_.polygon;
  wedge.clip(polygon, scratch_.clipped);
  if (polygon.size() < 3) return;
  const auto depth = [&](const Vec3 &p) { return std::fmax(0.0, wedge.depth(p)); };
  Vec3 middle;
  for (const Vec3 &p : polygon) middle = middle + p;
  middle = (1.0 / static_cast<double>(polygon.size())) * middle;
  const double middle_depth = depth(middle);
  const double carried = inside_share(middle, middle_depth, wedge.triangle());
  ++patches_;
  Patch whole;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 &p = polygon[i], &q = polygon[i + 1 == polygon.size() ? 0 : i + 1];
    const double dp = depth(p);
    const Patch part = linear_patch(middle, p, q, middle_depth, dp, depth(q), cosine);
    if (part.load > 0.0 && carried > 0.0 && dp > deepest_) {
      deepest_ = dp;
      deepest_place_ = p;
      deepest_normal_ = wedge.normal();
    }
    if (patches_ <= split_patches) {
      add(part, carried, factor, wedge.normal());
    } else {
      whole.area += part.area;
      whole.load += part.load;
      whole.energy += part.energy;
      whole.moment = whole.moment + part.moment;
    }
  }
  if (patches_ > split_patches) add(whole, carried, factor, wedge.normal());
}

// Points keep the load's place and moments.
void PatchLoad::add(const Patch &patch, double carried, double factor, const Vec3 &normal) {
  area_ += patch.area;
  carrying_area_ += carried * patch.area;
  if (patch.load > 0.0) most_carried_ = std::fmax(most_carried_, carried);
  const double load = factor * carried * patch.load;
  if (!(load > 0.0)) return;
  const double depth = patch.energy / patch.load;
  if (!(depth > 0.0)) return;
  const Vec3 place = (1.0 / patch.load) * patch.moment + (0.5 * depth) * normal;
  result_.points.push_back({depth, load / depth, pose_.rotation * normal, pose_(place)});
}

// 1 where the triangle's plane is what is nearest to a point behind it; falls to 0 where another part of the surface
// is nearer by half, as on the far side of a thin wall.
double PatchLoad::inside_share(const Vec3 &p, double depth, std::uint32_t triangle) const {
  if (!mesh_.closed() || !(depth > 0.0)) return 1.0;
  return std::fmin(1.0, std::fmax(0.0, -2.0 * mesh_.nearest(p, triangle).distance / depth - 1.0 + 1e-9));
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

// Merges neighbours until there are few; keeps the sum of forces.
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
      ContactPoint merged;
      merged.depth = (load_a * a.depth + load_b * b.depth) / load;
      merged.weight = norm(force) / merged.depth;
      merged.normal = normalized(force, a.normal);
      merged.position = (1.0 / load) * (load_a * a.position + load_b * b.position);
      points[kept] = merged;
    }
    points.resize(kept);
  }
}

}  // namespace cmb::mesh
