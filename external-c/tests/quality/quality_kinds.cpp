#include "quality_kinds.hpp"

#include <algorithm>
#include <cmath>

#include "support/mesh_text.hpp"
#include "support/poses.hpp"

namespace cmb::quality {

namespace {

using convex::Vec3;
using mesh_samples::MeshData;
using test::digits;

constexpr double pi = 3.14159265358979323846;

std::string three(double x, double y, double z) { return digits(x) + "," + digits(y) + "," + digits(z); }

Body halfspace(Random &) { return {"cmb/1 halfspace", 1.0, 1.0}; }

Body sphere(Random &random) {
  const double r = random.uniform(0.25, 0.5);
  return {"cmb/1 sphere radius=" + digits(r), 2 * r, 2 * r};
}

Body ellipsoid(Random &random) {
  const Vec3 size{random.uniform(0.4, 1), random.uniform(0.4, 1), random.uniform(0.4, 1)};
  return {"cmb/1 ellipsoid size=" + three(size.x, size.y, size.z), std::max({size.x, size.y, size.z}),
          std::min({size.x, size.y, size.z})};
}

// Of a kind that has a radius and a length along z.
Body about_axis(const char *kind, double radius, double length) {
  return {std::string("cmb/1 ") + kind + " radius=" + digits(radius) + " length=" + digits(length),
          std::max(2 * radius, length), std::min(2 * radius, length)};
}

Body capsule(Random &random) {
  const double radius = random.uniform(0.1, 0.3), length = random.uniform(0.2, 0.8);
  Body body = about_axis("capsule", radius, length);
  body.size = length + 2 * radius;
  body.thickness = 2 * radius;
  return body;
}

Body cylinder(Random &random) { return about_axis("cylinder", random.uniform(0.2, 0.5), random.uniform(0.3, 1.0)); }
Body cone(Random &random) { return about_axis("cone", random.uniform(0.25, 0.5), random.uniform(0.4, 1.0)); }

// Blunter than 75 degrees from axis to side.
Body flat_cone(Random &random) {
  const double radius = random.uniform(0.3, 0.5);
  return about_axis("cone", radius, radius * random.log_uniform(1e-3, 0.268));
}

Body slender_cone(Random &random) {
  const double length = random.uniform(0.5, 1.0);
  return about_axis("cone", length * random.log_uniform(1e-3, 0.05), length);
}

Body box(Random &random) {
  const Vec3 size{random.uniform(0.3, 1), random.uniform(0.3, 1), random.uniform(0.3, 1)};
  return {"cmb/1 box size=" + three(size.x, size.y, size.z), std::max({size.x, size.y, size.z}),
          std::min({size.x, size.y, size.z})};
}

Body prism(Random &random) {
  const int corners = random.integer(3, 8);
  const double radius = random.uniform(0.3, 0.5), half = random.uniform(0.15, 0.5);
  std::string text = "cmb/1 hull vertices=";
  for (int k = 0; k < corners; ++k) {
    const double angle = 2 * pi * k / corners, x = radius * std::cos(angle), y = radius * std::sin(angle);
    text += (k > 0 ? "," : "") + three(x, y, half) + "," + three(x, y, -half);
  }
  return {text, 2 * std::max(radius, half), 2 * std::min(0.5 * radius, half)};
}

// Corners on an ellipsoid.
Body hull(Random &random, int corners) {
  std::string text = "cmb/1 hull vertices=";
  for (int k = 0; k < corners; ++k) {
    const Vec3 p = random.direction();
    text += (k > 0 ? "," : "") + three(0.5 * p.x, 0.45 * p.y, 0.4 * p.z);
  }
  return {text, 1.0, 0.6};
}

Body hull20(Random &random) { return hull(random, 20); }
Body hull100(Random &random) { return hull(random, 100); }

Body box_mesh(Random &random, std::uint32_t cells) {
  const Vec3 size{random.uniform(0.5, 1), random.uniform(0.5, 1), random.uniform(0.5, 1)};
  return {mesh_samples::mesh_text(mesh_samples::box_mesh(size, cells)), std::max({size.x, size.y, size.z}),
          std::min({size.x, size.y, size.z})};
}

Body coarse_box_mesh(Random &random) { return box_mesh(random, 1); }
Body divided_box_mesh(Random &random) { return box_mesh(random, 3); }

// A prism over an L.
Body angle_mesh(Random &random) {
  const double a = random.uniform(0.3, 0.5), h = random.uniform(0.15, 0.3), inner = random.uniform(-0.1, 0.1) * a;
  return {mesh_samples::mesh_text(mesh_samples::angle_prism({-a, a, a, inner, inner, -a}, {-a, -a, inner, inner, a, a}, -h, h)),
          2 * a, std::min(a, 2 * h)};
}

Body sphere_mesh(Random &random) {
  const double radius = random.uniform(0.3, 0.5);
  return {mesh_samples::mesh_text(mesh_samples::sphere_mesh(radius, 2)), 2 * radius, 2 * radius};
}

Body torus_mesh(Random &random) {
  const double ring = random.uniform(0.3, 0.4), tube = random.uniform(0.08, 0.15);
  constexpr std::uint32_t around = 16, across = 8;
  MeshData data;
  for (std::uint32_t i = 0; i < around; ++i) {
    for (std::uint32_t j = 0; j < across; ++j) {
      const double u = 2 * pi * i / around, v = 2 * pi * j / across, r = ring + tube * std::cos(v);
      data.vertices.push_back({r * std::cos(u), r * std::sin(u), tube * std::sin(v)});
      const std::uint32_t a = i * across + j, b = (i + 1) % around * across + j;
      const std::uint32_t c = (i + 1) % around * across + (j + 1) % across, d = i * across + (j + 1) % across;
      data.triangles.push_back({a, b, c});
      data.triangles.push_back({a, c, d});
    }
  }
  return {mesh_samples::mesh_text(data), 2 * (ring + tube), 2 * tube};
}

// Two boxes in the form of a T.
Body compound(Random &random) {
  const double bar = random.uniform(0.6, 1.0), thick = random.uniform(0.15, 0.25), stem = random.uniform(0.4, 0.6);
  return {"cmb/1 box size=" + three(bar, thick, thick) + ";cmb/1 box size=" + three(thick, thick, stem) + " position=0,0," +
              digits(-0.5 * (stem + thick)),
          bar, thick};
}

Body height_field(Random &random) {
  const double phase = random.uniform(0, 2 * pi);
  const auto hills = [phase](double x, double y) {
    return 0.08 * std::sin(2.1 * x + phase) * std::cos(1.7 * y) + 0.02 * std::sin(5 * y);
  };
  return {mesh_samples::height_field_text(3.0, 17, hills), 1.0, 1.0};
}

}  // namespace

const std::vector<Kind> &all_kinds() {
  static const std::vector<Kind> kinds = {{"halfspace", true, halfspace},
                                          {"sphere", false, sphere},
                                          {"ellipsoid", false, ellipsoid},
                                          {"capsule", false, capsule},
                                          {"cylinder", false, cylinder},
                                          {"cone", false, cone},
                                          {"flat-cone", false, flat_cone},
                                          {"slender-cone", false, slender_cone},
                                          {"box", false, box},
                                          {"prism", false, prism},
                                          {"hull-20", false, hull20},
                                          {"hull-100", false, hull100},
                                          {"compound", false, compound},
                                          {"box-mesh", false, coarse_box_mesh},
                                          {"divided-box-mesh", false, divided_box_mesh},
                                          {"sphere-mesh", false, sphere_mesh},
                                          {"angle-mesh", false, angle_mesh},
                                          {"torus-mesh", false, torus_mesh},
                                          {"heightfield", true, height_field}};
  return kinds;
}

const Kind *find_kind(const std::string &name) {
  const auto found =
      std::find_if(all_kinds().begin(), all_kinds().end(), [&name](const Kind &kind) { return name == kind.name; });
  return found == all_kinds().end() ? nullptr : &*found;
}

}  // namespace cmb::quality
