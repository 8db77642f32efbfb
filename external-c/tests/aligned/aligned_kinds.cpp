#include "aligned_kinds.hpp"

#include <algorithm>
#include <cmath>

#include "shape/convex_hull.hpp"

namespace cmb::aligned {

namespace {

using mesh_samples::MeshData;
using stress::detail::box_part;
using stress::detail::hull_part;
using stress::detail::round_part;
using Form = Part::Form;

constexpr double pi = 3.14159265358979323846;

// Few round numbers, so that sizes of two bodies are equal or multiples of each other.
double length(Random &random) {
  static const double round[] = {0.2, 0.25, 0.4, 0.5, 0.8, 1.0};
  return random.integer(0, 4) > 0 ? round[random.integer(0, 5)] : random.uniform(0.2, 1.0);
}

void add_way(Body &body, const Vec3 &way) {
  const Vec3 unit = normalized(way);
  for (const Vec3 &known : body.ways) {
    if (norm(cross(known, unit)) < 1e-9) return;
  }
  body.ways.push_back(unit);
}

void add_axes(Body &body) {
  for (const Vec3 &axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) add_way(body, axis);
}

// Features of a polyhedron's faces, edges and corners.
void add_features(const convex::Polytope &polytope, Body &body) {
  const std::vector<Vec3> &vertices = polytope.vertices();
  std::vector<Vec3> at_corner(vertices.size());
  for (const convex::Polytope::Face &face : polytope.faces()) {
    Vec3 sum;
    for (int k = 0; k < face.count; ++k) {
      const auto v = static_cast<std::size_t>(polytope.face_vertices()[static_cast<std::size_t>(face.first + k)]);
      sum = sum + vertices[v];
      at_corner[v] = at_corner[v] + face.normal;
    }
    body.features.push_back({(1.0 / face.count) * sum, face.normal});
    add_way(body, face.normal);
  }
  for (const convex::Polytope::Edge &edge : polytope.edges()) {
    const Vec3 &p = vertices[static_cast<std::size_t>(edge.vertex[0])], &q = vertices[static_cast<std::size_t>(edge.vertex[1])];
    const Vec3 between = polytope.faces()[static_cast<std::size_t>(edge.face[0])].normal + polytope.faces()[static_cast<std::size_t>(edge.face[1])].normal;
    body.features.push_back({0.5 * (p + q), normalized(between)});
    add_way(body, q - p);
  }
  for (std::size_t v = 0; v < vertices.size(); ++v) body.features.push_back({vertices[v], normalized(at_corner[v])});
}

Body polyhedron(Part part) {
  Body body;
  convex::Polytope polytope;
  convex::build_convex_hull(part.points, polytope, nullptr, nullptr);
  add_features(polytope, body);
  body.text = part.text;
  body.thickness = stress::thickness(part);
  body.radius = stress::bound(part);
  body.size = 2.0 * body.radius;
  body.parts = {std::move(part)};
  return body;
}

Body box(Random &random) { return polyhedron(box_part({0.5 * length(random), 0.5 * length(random), 0.5 * length(random)})); }

Body prism_of(int corners, double radius, double half) {
  std::vector<Vec3> points;
  for (int k = 0; k < corners; ++k) {
    const double angle = 2 * pi * k / corners, x = radius * std::cos(angle), y = radius * std::sin(angle);
    points.push_back({x, y, half});
    points.push_back({x, y, -half});
  }
  return polyhedron(hull_part(std::move(points)));
}

Body prism(Random &random) {
  static const int corners[] = {3, 4, 6, 8};
  return prism_of(corners[random.integer(0, 3)], 0.5 * length(random), 0.5 * length(random));
}

// Many more faces than are looked at one by one.
Body round_prism(Random &random) { return prism_of(32, 0.5 * length(random), 0.5 * length(random)); }

// Octahedra, tetrahedra, ramps and frusta.
Body hull(Random &random) {
  const double a = 0.5 * length(random), b = 0.5 * length(random), c = 0.5 * length(random);
  switch (random.integer(0, 3)) {
    case 0: return polyhedron(hull_part({{a, 0, 0}, {-a, 0, 0}, {0, b, 0}, {0, -b, 0}, {0, 0, c}, {0, 0, -c}}));
    case 1: return polyhedron(hull_part({{a, a, a}, {a, -a, -a}, {-a, a, -a}, {-a, -a, a}}));
    case 2: return polyhedron(hull_part({{-a, -b, -c}, {a, -b, -c}, {a, b, -c}, {-a, b, -c}, {-a, -b, c}, {-a, b, c}}));
    default: {
      std::vector<Vec3> points;
      for (const double x : {-a, a}) {
        for (const double y : {-b, b}) points.push_back({x, y, -c}), points.push_back({0.5 * x, 0.5 * y, c});
      }
      return polyhedron(hull_part(std::move(points)));
    }
  }
}

// A tessellated ball.
Body ball_hull(Random &random) { return polyhedron(hull_part(mesh_samples::sphere_mesh(0.5 * length(random), random.integer(0, 1)).vertices)); }

Body round_body(Part part, double thickness) {
  Body body;
  body.text = part.text;
  body.thickness = thickness;
  body.radius = stress::bound(part);
  body.size = 2.0 * body.radius;
  add_axes(body);
  add_way(body, {1, 1, 0});
  body.parts = {std::move(part)};
  return body;
}

// Around the z axis: what lies at (radius, z) with the outward way (across, along).
void add_around(Body &body, double radius, double z, double across, double along) {
  for (int k = 0; k < 8; ++k) {
    const double c = std::cos(0.25 * pi * k), s = std::sin(0.25 * pi * k);
    body.features.push_back({{radius * c, radius * s, z}, normalized({across * c, across * s, along})});
  }
}

Body sphere(Random &random) {
  const double r = 0.5 * length(random);
  Body body = round_body(round_part(Form::ball, r, 0.0), 2 * r);
  for (const Vec3 &way : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{0, 0, -1}, Vec3{1, 1, 0}, Vec3{1, 1, 1}}) {
    body.features.push_back({r * normalized(way), normalized(way)});
  }
  return body;
}

Body ellipsoid(Random &random) {
  Part part;
  part.form = Form::ellipsoid;
  part.size = {0.5 * length(random), 0.5 * length(random), 0.5 * length(random)};
  part.text = "cmb/1 ellipsoid size=" + stress::detail::numbers({2 * part.size.x, 2 * part.size.y, 2 * part.size.z});
  const Vec3 s = part.size;
  Body body = round_body(std::move(part), 2 * std::min({s.x, s.y, s.z}));
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      Vec3 way;
      way.set(axis, sign);
      body.features.push_back({s[axis] * way, way});
    }
  }
  return body;
}

Body capsule(Random &random) {
  const double r = 0.5 * length(random), half = 0.5 * length(random);
  Body body = round_body(round_part(Form::rod, r, half), 2 * r);
  for (const double sign : {-1.0, 1.0}) {
    body.features.push_back({{0, 0, sign * (half + r)}, {0, 0, sign}});
    add_around(body, r, sign * half, 1, 0);
    add_around(body, r * std::sqrt(0.5), sign * (half + r * std::sqrt(0.5)), 1, sign);
  }
  add_around(body, r, 0, 1, 0);
  return body;
}

Body cylinder(Random &random) {
  const double r = 0.5 * length(random), half = 0.5 * length(random);
  Body body = round_body(round_part(Form::cylinder, r, half), 2 * std::min(r, half));
  for (const double sign : {-1.0, 1.0}) {
    body.features.push_back({{0, 0, sign * half}, {0, 0, sign}});
    add_around(body, r, sign * half, 1, sign);
  }
  add_around(body, r, 0, 1, 0);
  return body;
}

// Of a half-angle of 45 degrees often.
Body cone(Random &random) {
  const double r = 0.5 * length(random), half = random.integer(0, 2) == 0 ? 0.5 * r : 0.5 * length(random);
  Body body = round_body(round_part(Form::cone, r, half), std::min(2 * r, 2 * half) / (1.0 + std::min(r, half) / std::max(r, half)));
  body.features.push_back({{0, 0, half}, {0, 0, 1}});
  body.features.push_back({{0, 0, -half}, {0, 0, -1}});
  add_around(body, r, -half, 1, -1);
  add_around(body, r, -half, 1, 0);
  add_around(body, 0.5 * r, 0, 2 * half, r);
  return body;
}

// Features of a mesh's triangles, and of their edges and corners as far as these are convex.
Body mesh_body(const MeshData &data, double thickness) {
  Body body;
  Part part;
  part.points = data.vertices;
  std::vector<Vec3> at_corner(data.vertices.size());
  for (const mesh_samples::Triangle &t : data.triangles) {
    const Vec3 &p = data.vertices[t[0]], &q = data.vertices[t[1]], &r = data.vertices[t[2]];
    const Vec3 normal = normalized(cross(q - p, r - p));
    for (const Vec3 &place : {(1.0 / 3.0) * (p + q + r), 0.5 * (p + q), p}) body.features.push_back({place, normal});
    for (const Vec3 &way : {normal, q - p, r - q}) add_way(body, way);
    for (const std::uint32_t v : t) at_corner[v] = at_corner[v] + normal;
  }
  for (std::size_t v = 0; v < data.vertices.size(); ++v) {
    if (norm(at_corner[v]) > 0.1) body.features.push_back({data.vertices[v], normalized(at_corner[v])});
  }
  body.radius = stress::bound(part);
  body.size = 2.0 * body.radius;
  body.thickness = thickness;
  body.parts = {std::move(part)};
  return body;
}

// The same with a speck far off, as what is closed and convex is a hull.
Body speckled(const MeshData &data, double thickness) {
  Body body = mesh_body(data, thickness);
  body.text = mesh_samples::mesh_text(mesh_samples::with_speck(data));
  return body;
}

Body box_mesh(Random &random) {
  const Vec3 size{length(random), length(random), length(random)};
  return speckled(mesh_samples::box_mesh(size, static_cast<std::uint32_t>(random.integer(1, 2))), std::min({size.x, size.y, size.z}));
}

Body ball_mesh(Random &random) {
  const double radius = 0.5 * length(random);
  return speckled(mesh_samples::sphere_mesh(radius, random.integer(0, 1)), radius);
}

// An L.
Body angle_mesh(Random &random) {
  const double a = 0.5 * length(random), h = 0.5 * length(random);
  const MeshData data = mesh_samples::angle_prism({-a, a, a, 0, 0, -a}, {-a, -a, 0, 0, a, a}, -h, h);
  Body body = mesh_body(data, std::min(a, 2 * h));
  body.text = mesh_samples::mesh_text(data);
  return body;
}

// Half of it level, the other half roofs at 45 degrees.
Body height_field(Random &) {
  Body body;
  const auto height = [](double x) { return x <= 0.0 ? 0.0 : 0.25 - std::fabs(x - 0.25 - 0.5 * std::floor(2.0 * x)); };
  body.text = mesh_samples::height_field_text(2, 9, [&](double x, double) { return height(x); });
  body.swallows = [height](const Vec3 &p) { return p.z < height(p.x); };
  add_axes(body);
  for (const double y : {0.0, 0.125, -0.25}) {
    for (const double x : {-0.5, -0.375, -0.25, 0.0}) body.features.push_back({{x, y, 0}, {0, 0, 1}});
    body.features.push_back({{0.25, y, 0.25}, {0, 0, 1}});
    body.features.push_back({{0.125, y, 0.125}, normalized({-1, 0, 1})});
    body.features.push_back({{0.375, y, 0.125}, normalized({1, 0, 1})});
  }
  add_way(body, {1, 0, 1});
  return body;
}

Body halfspace(Random &) {
  Body body;
  body.text = "cmb/1 halfspace";
  add_axes(body);
  for (const Vec3 &place : {Vec3{0, 0, 0}, Vec3{0.5, 0.25, 0}}) body.features.push_back({place, {0, 0, 1}});
  return body;
}

}  // namespace

const std::vector<Kind> &all_kinds() {
  static const std::vector<Kind> kinds = {{"half-space", true, 1e-12, 1.0, halfspace},
                                          {"box", false, 1e-12, 1.0, box},
                                          {"prism", false, 1e-12, 1.0, prism},
                                          {"round-prism", false, 1e-12, 1.0, round_prism},
                                          {"hull", false, 1e-12, 1.0, hull},
                                          {"ball-hull", false, 1e-12, 1.0, ball_hull},
                                          {"sphere", false, 1e-12, 1.0, sphere},
                                          {"ellipsoid", false, 1e-12, 1.0, ellipsoid},
                                          {"capsule", false, 1e-12, 1.0, capsule},
                                          {"cylinder", false, 1e-10, 1.0, cylinder},
                                          {"cone", false, 1e-10, 1.0, cone},
                                          {"box-mesh", false, 1e-6, 0.25, box_mesh},
                                          {"ball-mesh", false, 1e-6, 0.25, ball_mesh},
                                          {"angle-mesh", false, 1e-6, 0.25, angle_mesh},
                                          {"field", true, 1e-6, 0.25, height_field}};
  return kinds;
}

const Kind *find_kind(const std::string &name) {
  const auto found = std::find_if(all_kinds().begin(), all_kinds().end(), [&name](const Kind &kind) { return name == kind.name; });
  return found == all_kinds().end() ? nullptr : &*found;
}

}  // namespace cmb::aligned
