// Bodies of every kind as descriptors, each with what independent checks need: how far its parts reach.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "support/mesh_text.hpp"
#include "support/poses.hpp"
#include "support/random_bodies.hpp"

namespace cmb::stress {

using convex::Mat3;
using convex::Pose;
using convex::Vec3;
using random_bodies::Random;

// A convex part: all points of `points`, or a round solid about the z axis, moved by `in_body`.
struct Part {
  enum class Form { points, ball, rod, cylinder, cone, ellipsoid };
  Form form = Form::points;
  Vec3 size;  // radius in x, half the length in z; an ellipsoid's semi-axes
  std::vector<Vec3> points;
  Pose in_body;
  std::string text;  // of the part alone
};

// The greatest d . x of the part's points x, in the body's frame.
inline double reach(const Part &part, const Vec3 &d) {
  const Vec3 l = transposed_times(part.in_body.rotation, d);
  const double across = std::hypot(l.x, l.y), along = std::fabs(l.z), r = part.size.x, h = part.size.z;
  double most = 0.0;
  switch (part.form) {
    case Part::Form::points:
      most = dot(l, part.points[0]);
      for (const Vec3 &p : part.points) most = std::max(most, dot(l, p));
      break;
    case Part::Form::ball: most = r * norm(l); break;
    case Part::Form::rod: most = r * norm(l) + h * along; break;
    case Part::Form::cylinder: most = r * across + h * along; break;
    case Part::Form::cone: most = std::max(h * l.z, r * across - h * l.z); break;
    case Part::Form::ellipsoid:
      most = std::sqrt(l.x * l.x * part.size.x * part.size.x + l.y * l.y * part.size.y * part.size.y +
                       l.z * l.z * part.size.z * part.size.z);
      break;
  }
  return most + dot(d, part.in_body.translation);
}

// The radius of a ball about the part's own origin that holds it.
inline double bound(const Part &part) {
  double most = 0.0;
  switch (part.form) {
    case Part::Form::points:
      for (const Vec3 &p : part.points) most = std::max(most, norm(p));
      return most;
    case Part::Form::ball: return part.size.x;
    case Part::Form::rod: return part.size.x + part.size.z;
    case Part::Form::cylinder:
    case Part::Form::cone: return std::hypot(part.size.x, part.size.z);
    case Part::Form::ellipsoid: return std::max(part.size.x, std::max(part.size.y, part.size.z));
  }
  return most;
}

// The least width of the part: exact for boxes and round parts, hardly above it for hulls.
inline double thickness(const Part &part) {
  double least = 1e300;
  const auto offer = [&](const Vec3 &d) { least = std::min(least, reach(part, d) + reach(part, -d)); };
  for (int k = 0; k < 3; ++k) offer(part.in_body.rotation.column(k));
  Random random(1);
  for (int k = 0; k < 300; ++k) offer(random.direction());
  return least;
}

enum class Nature { halfspace, convex, compound, closed_mesh, flat_sheet, rough_sheet };

struct Solid {
  Nature nature = Nature::convex;
  std::string text;
  std::vector<Part> parts;         // none of half-spaces and sheets
  std::string twin;                // of closed meshes: the same solid of convex parts
  double radius = 1.0;             // of a ball about the origin that holds it; of half-spaces and sheets 1,
  double extent = 0.0;             // but this where not 0
  double low = 0.0, high = 0.0;    // of sheets: their heights lie between
  bool curved = false;

  double least_thickness() const {
    double least = 1e300;
    for (const Part &part : parts) least = std::min(least, thickness(part));
    return least;
  }
};

struct Kind {
  const char *name;
  Solid (*make)(Random &random);
};

namespace detail {

using test::digits;

inline std::string numbers(const std::vector<double> &values) {
  std::string text;
  for (std::size_t k = 0; k < values.size(); ++k) text += (k > 0 ? "," : "") + digits(values[k]);
  return text;
}

inline std::vector<Vec3> box_corners(const Vec3 &half) {
  std::vector<Vec3> corners;
  for (int k = 0; k < 8; ++k) {
    corners.push_back({k & 1 ? half.x : -half.x, k & 2 ? half.y : -half.y, k & 4 ? half.z : -half.z});
  }
  return corners;
}

// Round lengths often: coincidences are what breaks geometry.
inline double length(Random &random) {
  static const double round[] = {0.25, 0.5, 1.0, 0.1};
  return random.integer(0, 1) ? round[random.integer(0, 3)] : random.log_uniform(random.integer(0, 4) ? 0.1 : 1e-3, 1.0);
}

inline Vec3 lengths(Random &random) { return {length(random), length(random), length(random)}; }

inline Solid solid_of(Part part, bool curved) {
  Solid solid;
  solid.text = part.text;
  solid.curved = curved;
  solid.radius = bound(part);
  solid.parts.push_back(std::move(part));
  return solid;
}

inline Part box_part(const Vec3 &half) {
  Part part;
  part.points = box_corners(half);
  part.text = "cmb/1 box size=" + numbers({2 * half.x, 2 * half.y, 2 * half.z});
  return part;
}

inline std::string vertices_text(const std::vector<Vec3> &points) {
  std::vector<double> values;
  for (const Vec3 &p : points) values.insert(values.end(), {p.x, p.y, p.z});
  return numbers(values);
}

inline Part round_part(Part::Form form, double r, double h) {
  static const char *const names[] = {"", "sphere", "capsule", "cylinder", "cone"};
  Part part;
  part.form = form;
  part.size = {r, r, form == Part::Form::ball ? 0.0 : h};
  part.text = std::string("cmb/1 ") + names[static_cast<int>(form)] + " radius=" + digits(r);
  if (form != Part::Form::ball) part.text += " length=" + digits(2 * h);
  return part;
}

// The part moved within its body by multiples of a quarter, turned about z by a right angle or not at all.
inline Part moved_part(Part part, Random &random) {
  part.in_body.translation = {0.25 * random.integer(-2, 2), 0.25 * random.integer(-2, 2), 0.25 * random.integer(-2, 2)};
  const Vec3 &t = part.in_body.translation;
  part.text += " position=" + numbers({t.x, t.y, t.z});
  if (random.integer(0, 1)) {
    part.in_body.rotation = Mat3{{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}};
    part.text += " rotation=0,1,0,-1,0,0,0,0,1";
  }
  return part;
}

inline Part any_part(Random &random) {
  const double r = length(random), h = length(random);
  switch (random.integer(0, 4)) {
    case 0: return round_part(Part::Form::ball, r, 0.0);
    case 1: return round_part(Part::Form::rod, r, h);
    case 2: return round_part(Part::Form::cylinder, r, h);
    default: return box_part(lengths(random));
  }
}

inline Solid compound_of(std::vector<Part> parts) {
  Solid solid;
  solid.nature = Nature::compound;
  solid.radius = 0.0;
  for (const Part &part : parts) {
    solid.text += (solid.text.empty() ? "" : ";") + part.text;
    solid.curved = solid.curved || part.form != Part::Form::points;
    solid.radius = std::max(solid.radius, norm(part.in_body.translation) + bound(part));
  }
  solid.parts = std::move(parts);
  return solid;
}

// A mesh and the convex parts it is the surface of.
inline Solid mesh_of(const mesh_samples::MeshData &data, Solid parts) {
  parts.nature = Nature::closed_mesh;
  parts.twin = parts.text;
  parts.text = mesh_samples::mesh_text(data);
  return parts;
}

// An L: [0, a] x [0, 1] x [0, b] and [0, 1] x [0, a] x [0, b] in units of `unit`, about its middle.
inline Solid angle_mesh(double unit, double a, double b) {
  double xs[] = {0, a, a, 1, 1, 0}, ys[] = {0, 0, 1, 1, a, a};
  for (int k = 0; k < 6; ++k) xs[k] = unit * (xs[k] - 0.5 * a), ys[k] = unit * (ys[k] - 0.5 * a);
  const mesh_samples::MeshData data = mesh_samples::angle_prism(xs, ys, unit * (0.0 - 0.5 * b), unit * (b - 0.5 * b));
  std::vector<Part> parts;
  for (const bool along_x : {true, false}) {
    const double x = along_x ? a : 1.0, y = along_x ? 1.0 : a;
    Part part = box_part({0.5 * unit * x, 0.5 * unit * y, 0.5 * unit * b});
    part.in_body.translation = {0.5 * unit * (x - a), 0.5 * unit * (y - a), 0.0};
    const Vec3 &t = part.in_body.translation;
    part.text += " position=" + numbers({t.x, t.y, t.z});
    parts.push_back(std::move(part));
  }
  return mesh_of(data, compound_of(std::move(parts)));
}

inline Part hull_part(std::vector<Vec3> points) {
  Part part;
  part.text = "cmb/1 hull vertices=" + vertices_text(points);
  part.points = std::move(points);
  return part;
}

// So wide that no body used here reaches its border.
constexpr double sheet_half = 12.0;

inline Solid sheet(Random &random, bool flat) {
  Solid solid;
  solid.nature = flat ? Nature::flat_sheet : Nature::rough_sheet;
  const double height = flat ? 0.0 : 0.02;
  solid.low = -height;
  solid.high = height;
  const double turn = random.uniform(0, 6.28);
  solid.extent = 20.0;
  solid.text = mesh_samples::height_field_text(
      2.0 * sheet_half, 17, [&](double x, double y) { return height * std::sin(1.3 * x + turn) * std::cos(1.7 * y); });
  return solid;
}

}  // namespace detail

inline const std::vector<Kind> &kinds() {
  using namespace detail;
  using Form = Part::Form;
  static const std::vector<Kind> all = {
      {"half-space",
       [](Random &) {
         Solid solid;
         solid.nature = Nature::halfspace;
         solid.text = "cmb/1 halfspace";
         return solid;
       }},
      {"sphere", [](Random &r) { return solid_of(round_part(Form::ball, length(r), 0.0), true); }},
      {"box", [](Random &r) { return solid_of(box_part(lengths(r)), false); }},
      {"capsule", [](Random &r) { return solid_of(round_part(Form::rod, length(r), length(r)), true); }},
      {"cylinder", [](Random &r) { return solid_of(round_part(Form::cylinder, length(r), length(r)), true); }},
      {"cone", [](Random &r) { return solid_of(round_part(Form::cone, length(r), length(r)), true); }},
      {"ellipsoid",
       [](Random &r) {
         Part part;
         part.form = Form::ellipsoid;
         part.size = lengths(r);
         part.text = "cmb/1 ellipsoid size=" + numbers({2 * part.size.x, 2 * part.size.y, 2 * part.size.z});
         return solid_of(std::move(part), true);
       }},
      {"hull",
       [](Random &r) {
         const Vec3 size{r.log_uniform(0.05, 1), r.log_uniform(0.2, 1), r.log_uniform(0.2, 1)};
         return solid_of(hull_part(random_bodies::random_points(r, r.integer(4, 8), size, false)), false);
       }},
      {"compound",
       [](Random &r) {
         std::vector<Part> parts;
         for (int k = r.integer(2, 3); k > 0; --k) parts.push_back(moved_part(any_part(r), r));
         return compound_of(std::move(parts));
       }},
      {"mesh",
       [](Random &r) {
         if (r.integer(0, 2) == 0) return angle_mesh(length(r), 2.0 + r.integer(0, 1), 1.0);
         const mesh_samples::MeshData data =
             r.integer(0, 1) ? mesh_samples::box_mesh(2.0 * lengths(r), static_cast<std::uint32_t>(r.integer(1, 2)))
                             : mesh_samples::sphere_mesh(length(r), 1);
         return mesh_of(data, solid_of(hull_part(data.vertices), false));
       }},
      {"flat sheet", [](Random &r) { return sheet(r, true); }},
      {"rough sheet", [](Random &r) { return sheet(r, false); }}};
  return all;
}

}  // namespace cmb::stress
