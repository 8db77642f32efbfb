// Prints the force-carrying sums along paths that are hard on contacts, as CSV:
// path, s, distance (m), load (m: sum of weight times depth), its components, and its moment about A (m2).
//
//   sample_paths [samples a path]
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>

#include "contact_multibody.h"
#include "math/vector3.hpp"
#include "support/engine_calls.hpp"

namespace {

using cmb::convex::cross;
using cmb::convex::dot;
using cmb::convex::Mat3;
using cmb::convex::normalized;
using cmb::convex::transposed;
using cmb::convex::Vec3;

constexpr double pi = 3.14159265358979323846, depth = 0.01;
constexpr std::size_t capacity = 16;

struct Place {
  Vec3 position;
  Mat3 rotation;  // body to world
};

Mat3 rotation_about(const Vec3 &axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  Mat3 columns;
  for (int i = 0; i < 3; ++i) {
    Vec3 e;
    e.set(i, 1.0);
    columns.row[i] = c * e + s * cross(axis, e) + ((1.0 - c) * dot(axis, e)) * axis;
  }
  return transposed(columns);
}

struct Path {
  const char *name, *a, *b;
  std::function<Place(double)> place_of_a;
};

// Turning on a level surface at z = 0.5, always as deep.
Place tilting_cube(double s) {
  // From the face over an edge onto a corner.
  const double edge = pi / 4 * std::fmin(1.0, 2.0 * s), corner = std::fmax(0.0, 2.0 * s - 1.0) * std::atan(std::sqrt(0.5));
  const Mat3 first = rotation_about({0, 1, 0}, edge), second = rotation_about({1, 0, 0}, corner);
  double lowest = 0.0;
  Mat3 rotation;
  for (int j = 0; j < 3; ++j) {
    const Vec3 column = second * first.column(j);
    for (int i = 0; i < 3; ++i) rotation.row[i].set(j, column[i]);
  }
  for (int v = 0; v < 8; ++v) {
    const Vec3 p{v & 1 ? 0.5 : -0.5, v & 2 ? 0.5 : -0.5, v & 4 ? 0.5 : -0.5};
    lowest = std::fmin(lowest, (rotation * p).z);
  }
  return {{0.1, 0.2, 0.5 - lowest - depth}, rotation};
}

Place tilting_cylinder(double s) {
  const Mat3 rotation = rotation_about({0, 1, 0}, pi / 2 * s);
  const Vec3 axis = rotation.column(2);
  return {{0.1, 0.2, 0.5 + 0.25 * std::fabs(axis.z) + 0.3 * std::hypot(axis.x, axis.y) - depth}, rotation};
}

const char *const table = "cmb/1 box size=4,4,1";
const char *const wedge =
    "cmb/1 hull vertices=-0.5,-0.4,-0.3,0.5,-0.5,-0.3,0.4,0.5,-0.3,-0.4,0.4,-0.3,-0.3,0,0.4,0.3,0.1,0.5";

const Path paths[] = {
    {"box slides off the border of a table", "cmb/1 box size=1,1,1", table,
     [](double s) { return Place{{2.38 + 0.13 * s, 0.1, 1.0 - depth}, {}}; }},
    {"cube tilts from a face over an edge onto a corner", "cmb/1 box size=1,1,1", table, tilting_cube},
    {"cylinder rolls over its rim onto its side", "cmb/1 cylinder radius=0.3 length=0.5", table, tilting_cylinder},
    {"hulls turn on each other", wedge, wedge,
     [](double s) {
       return Place{{0.06, 0.02, 0.74},
                    transposed(Mat3{{(rotation_about({0, 0, 1}, 2 * pi * s) * Vec3{1, 0, 0}),
                                     (rotation_about({0, 0, 1}, 2 * pi * s) * Vec3{0, -1, 0}), Vec3{0, 0, -1}}})};
     }},
    {"capsule slides off the border of a table", "cmb/1 capsule radius=0.1 length=0.8", table,
     [](double s) { return Place{{1.4 + 1.1 * s, 0.1, 0.6 - depth}, rotation_about({0, 1, 0}, pi / 2)}; }},
    {"standing cylinder slides over the border of a drum", "cmb/1 cylinder radius=0.3 length=0.5",
     "cmb/1 cylinder radius=1 length=1",
     [](double s) { return Place{{0.6 + 0.6 * s, 0.1, 0.75 - depth}, {}}; }},
    {"tilted cylinder slips off a corner deeper than it overlaps", "cmb/1 cylinder radius=0.3 length=0.5", table,
     [](double s) { return Place{{2.1 + 0.2 * s, 2.05 + 0.2 * s, 0.65}, rotation_about({0.6, 0.8, 0}, 0.2)}; }},
    {"cone slips off a border with its tip down", "cmb/1 cone radius=0.3 length=0.5", table,
     [](double s) { return Place{{1.9 + 0.2 * s, 0.1, 0.7}, rotation_about({1, 0, 0}, pi)}; }},
    {"lying capsule sinks past a box's edge which its axis crosses", "cmb/1 capsule radius=0.1 length=0.8", table,
     [](double s) { return Place{{2.0, 0.1, 0.65 - 0.3 * s}, rotation_about({1, 0, 0}, pi / 2)}; }},
    {"ellipsoid rolls over a hull", "cmb/1 ellipsoid size=0.9,0.6,0.4", wedge,
     [](double s) {
       return Place{{-0.7 + 1.4 * s, 0.1, 0.62}, rotation_about(normalized(Vec3{0.3, 1, 0.1}), 2 * pi * s)};
     }},
};

}  // namespace

int main(int argc, char **argv) {
  const int samples = argc > 1 ? std::atoi(argv[1]) : 1000;
  std::printf("path,s,distance,load,load_x,load_y,load_z,moment_x,moment_y,moment_z\n");
  for (const Path &path : paths) {
    const char *geometry[] = {path.a, path.b};
    const int pair[] = {1, 2};
    cmb_scene scene{};
    if (cmb::test::intern_scene(geometry, 2, pair, 1, CMB_BACKEND_AUTO, &scene) != CMB_OK) {
      std::fprintf(stderr, "%s\n", cmb_last_error());
      return 1;
    }
    for (int k = 0; k <= samples; ++k) {
      const double s = static_cast<double>(k) / samples;
      const Place place = path.place_of_a(s);
      double position[6] = {place.position.x, place.position.y, place.position.z, 0, 0, 0};
      double rotation[18] = {0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) rotation[3 * i + j] = place.rotation.row[j][i];
      }
      double distance, d[capacity], w[capacity], n[3 * capacity], p[3 * capacity];
      if (cmb::test::query_scene(scene, position, rotation, 2, 1, capacity, &distance, d, w, n, p) != CMB_OK) {
        std::fprintf(stderr, "%s\n", cmb_last_error());
        return 1;
      }
      Vec3 load, moment;
      for (std::size_t i = 0; i < capacity; ++i) {
        const Vec3 force = (w[i] * d[i]) * Vec3{n[3 * i], n[3 * i + 1], n[3 * i + 2]};
        load = load + force;
        moment = moment + cross(Vec3{p[3 * i], p[3 * i + 1], p[3 * i + 2]} - place.position, force);
      }
      std::printf("%s,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g\n", path.name, s, distance, norm(load), load.x, load.y,
                  load.z, moment.x, moment.y, moment.z);
    }
  }
  return 0;
}
