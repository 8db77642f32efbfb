#include "mesh/contact/smooth_facets.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "math/pi.hpp"

namespace cmb::mesh {

namespace {

constexpr int rings = 4, sectors = 16;     // of an ellipsoid's cap
constexpr int fixed_angles = 12;           // round a cylinder or cone
constexpr int fine_angles = 5;             // on each side of the lowest line of each rim

class Builder {
 public:
  explicit Builder(Facets &facets) : facets_(facets) {
    facets.corners.clear();
    facets.facets.clear();
  }
  void corner(const Vec3 &p) { facets_.corners.push_back(p); }
  // The corners since the last facet; `inside` is a point behind it.
  void close(const Vec3 &inside) {
    const std::vector<Vec3> &c = facets_.corners;
    Facets::Facet facet;
    facet.first = first_;
    facet.count = c.size() - first_;
    first_ = c.size();
    Vec3 area;
    for (std::size_t k = 1; k + 1 < facet.count; ++k) {
      area = area + cross(c[facet.first + k] - c[facet.first], c[facet.first + k + 1] - c[facet.first]);
    }
    if (!(norm2(area) > 0.0)) return;
    facet.normal = normalized(area);
    if (dot(facet.normal, c[facet.first] - inside) < 0.0) facet.normal = -facet.normal;
    facets_.facets.push_back(facet);
  }

 private:
  Facets &facets_;
  std::size_t first_ = 0;
};

// A pair perpendicular to the unit vector d and to each other: two fixed vectors, turned by the shortest rotation that
// takes a fixed axis to d. Continuous but where d is opposite to that axis, which is along none that bodies rest on.
void across(const Vec3 &d, Vec3 &e1, Vec3 &e2) {
  static const Vec3 axis{0.36, 0.48, 0.8}, first{0.8, -0.6, 0.0}, second{0.48, 0.64, -0.6};
  const double shrink = 1.0 / std::fmax(1.0 + dot(axis, d), 1e-12);
  e1 = first - (dot(d, first) * shrink) * (axis + d);
  e2 = second - (dot(d, second) * shrink) * (axis + d);
}

// The angle whose cosine is 1 - x, accurate for small x too.
double angle_of_sagitta(double x) { return 2.0 * std::asin(std::sqrt(std::fmin(1.0, 0.5 * x))); }

// In the frame in which the ellipsoid is the unit sphere, its part below the plane is a spherical cap.
double ellipsoid_cap(const Vec3 &axes, const Vec3 &down, double level, Facets &facets) {
  const Vec3 scaled{axes.x * down.x, axes.y * down.y, axes.z * down.z};
  const double reach = norm(scaled);  // of the ellipsoid below its centre
  const double depth = reach - level;
  Builder builder(facets);
  if (!(depth > 0.0)) return 1.0;
  const Vec3 pole = (1.0 / reach) * scaled;
  Vec3 e1, e2;
  across(pole, e1, e2);
  const double angle = angle_of_sagitta(depth / reach);
  const auto place = [&](int ring, int sector) {
    const double theta = angle * ring / rings, phi = 2.0 * pi * sector / sectors;
    const Vec3 u = std::cos(theta) * pole + (std::sin(theta) * std::cos(phi)) * e1 + (std::sin(theta) * std::sin(phi)) * e2;
    return Vec3{axes.x * u.x, axes.y * u.y, axes.z * u.z};
  };
  for (int ring = 0; ring < rings; ++ring) {
    for (int sector = 0; sector < sectors; ++sector) {
      builder.corner(place(ring, sector));
      builder.corner(place(ring + 1, sector));
      builder.corner(place(ring + 1, sector + 1));
      if (ring > 0) builder.corner(place(ring, sector + 1));
      builder.close({});
    }
  }
  // The mean depth of these pieces, seen from the plane: between two rings it is linear in the ring's radius.
  double load = 0.0, area = 0.0;
  const double counted = std::fmin(angle, 0.5 * pi);
  for (int ring = 0; ring < rings; ++ring) {
    const double inner = counted * ring / rings, outer = counted * (ring + 1) / rings;
    const double r1 = std::sin(inner), r2 = std::sin(outer);
    const double half1 = std::sin(0.5 * inner), half2 = std::sin(0.5 * outer);
    const double d1 = depth - 2.0 * reach * half1 * half1, d2 = depth - 2.0 * reach * half2 * half2;
    const double squares = r2 * r2 - r1 * r1, cubes = r2 * r2 * r2 - r1 * r1 * r1;
    area += 0.5 * squares;
    load += 0.5 * d1 * squares + (d2 - d1) / (r2 - r1) * (cubes / 3.0 - 0.5 * r1 * squares);
  }
  return load > 0.0 ? depth * area / load : 1.0;
}

// From the lowest line of a cylinder or cone: what is as far on its other side has the opposite sine.
void collect_lines(double lower_radius, double upper_radius, double half, double slope, const Vec3 &down, double level,
                   std::vector<Facets::Line> &lines) {
  lines.clear();
  for (int k = 0; k <= fixed_angles / 2; ++k) lines.push_back({2.0 * pi * k / fixed_angles, 0.0, 0.0});
  // From the lowest line of a rim to where the plane cuts it; of an apex, which has no rim, to where it would cut the base's
  // that deep.
  const auto add_rim = [&](double radius, double z) {
    const double deep = radius * slope - (level - down.z * z), steep = (radius > 0.0 ? radius : lower_radius) * slope;
    if (!(deep > 0.0)) return;
    const double end = deep < 2.0 * steep ? angle_of_sagitta(deep / steep) : pi;
    for (int k = 1; k <= fine_angles; ++k) lines.push_back({end * k / fine_angles, 0.0, 0.0});
  };
  add_rim(lower_radius, -half);
  add_rim(upper_radius, half);
  std::sort(lines.begin(), lines.end(), [](const Facets::Line &x, const Facets::Line &y) { return x.angle < y.angle; });
  for (Facets::Line &line : lines) line.cosine = std::cos(line.angle), line.sine = std::sin(line.angle);
}

void round_solid(double lower_radius, double upper_radius, double half, const Vec3 &down, double level,
                 Facets &facets) {
  const double slope = std::hypot(down.x, down.y);
  const Vec3 e1 = slope > 0.0 ? Vec3{down.x / slope, down.y / slope, 0.0} : Vec3{1.0, 0.0, 0.0};
  const Vec3 e2{-e1.y, e1.x, 0.0};
  collect_lines(lower_radius, upper_radius, half, slope, down, level, facets.lines);
  const auto count = static_cast<std::ptrdiff_t>(facets.lines.size());
  Builder builder(facets);
  // Lines are numbered from the highest one round the lowest one, 0, to the highest one again.
  const auto rim = [&](double radius, double z, std::ptrdiff_t i) {
    const Facets::Line &line = facets.lines[static_cast<std::size_t>(std::abs(i))];
    return (radius * line.cosine) * e1 + (radius * (i < 0 ? -line.sine : line.sine)) * e2 + Vec3{0.0, 0.0, z};
  };
  // How deep the lower end of a line's place is; lines rise from the lowest one on.
  const auto is_below = [&](double radius, double z, std::ptrdiff_t i) {
    return radius * slope * facets.lines[static_cast<std::size_t>(std::abs(i))].cosine + down.z * z >= level;
  };
  for (std::ptrdiff_t i = 1 - count; i + 1 < count; ++i) {
    const std::ptrdiff_t lowest = i < 0 ? i + 1 : i;
    if (!is_below(lower_radius, -half, lowest) && !is_below(upper_radius, half, lowest)) continue;
    builder.corner(rim(lower_radius, -half, i));
    builder.corner(rim(lower_radius, -half, i + 1));
    builder.corner(rim(upper_radius, half, i + 1));
    if (upper_radius > 0.0) builder.corner(rim(upper_radius, half, i));
    builder.close({0.0, 0.0, -half});
  }
  const auto disc = [&](double radius, double z) {
    if (!is_below(radius, z, 0)) return;
    for (std::ptrdiff_t i = 1 - count; i + 1 < count; ++i) builder.corner(rim(radius, z, i));
    builder.close({});
  };
  disc(lower_radius, -half);
  if (upper_radius > 0.0) disc(upper_radius, half);
}

}  // namespace

double facets_below(const convex::ConvexBody &body, const Vec3 &normal, double offset, Facets &facets) {
  // The plane lies `level` below the body's origin.
  const Vec3 down = -normal, &half = body.half;
  const double level = -offset;
  switch (body.core) {
    case convex::CoreShape::ellipsoid: return ellipsoid_cap(half, down, level, facets);
    case convex::CoreShape::cylinder: round_solid(half.x, half.x, half.z, down, level, facets); return 1.0;
    case convex::CoreShape::cone: round_solid(half.x, 0.0, half.z, down, level, facets); return 1.0;
    default: facets.facets.clear(); return 1.0;
  }
}

}  // namespace cmb::mesh
