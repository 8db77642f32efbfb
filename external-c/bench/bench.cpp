// Times queries of one pair: the engine through its C interface, libccd's portal refinement and FCL's collide bare.
// Prints medians in microseconds. No dependency but the libraries compared.
#include <ccd/ccd.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/collision_object.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "contact_multibody.h"
#include "scene/descriptor.hpp"

namespace {

using cmb::Pose;
using cmb::Shape;
using cmb::ShapeKind;
using cmb::Vec3;

constexpr int poses_a_case = 64, repetitions = 25;

std::string digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

// A hull of points on a sphere of radius 0.5.
std::string hull_of_sphere(int points) {
  std::mt19937 random(1);
  std::string text = "cmb/1 hull vertices=";
  for (int i = 0; i < points; ++i) {
    // Golden-section spiral, slightly shaken so that no four points lie in a plane.
    const double z = 1.0 - (2.0 * i + 1.0) / points, angle = 2.39996322972865332 * i + 1e-3 * (random() % 100);
    const double r = std::sqrt(1.0 - z * z);
    text += (i > 0 ? "," : "") + digits(0.5 * r * std::cos(angle)) + "," + digits(0.5 * r * std::sin(angle)) + "," +
            digits(0.5 * z);
  }
  return text;
}

struct Case {
  const char *name;
  std::string a, b;
  double height;  // of A's frame above B's, at the deepest
  double tilt;    // rad, at most
};

double median_microseconds(const std::function<void(int)> &query) {
  std::vector<double> times;
  for (int r = 0; r < repetitions; ++r) {
    const auto begin = std::chrono::steady_clock::now();
    for (int pose = 0; pose < poses_a_case; ++pose) query(pose);
    const std::chrono::duration<double, std::micro> taken = std::chrono::steady_clock::now() - begin;
    times.push_back(taken.count() / poses_a_case);
  }
  std::nth_element(times.begin(), times.begin() + repetitions / 2, times.end());
  return times[repetitions / 2];
}

struct PlacedShape {
  const Shape *shape;
  Pose pose;
};

void support(const void *object, const ccd_vec3_t *direction, ccd_vec3_t *result) {
  const PlacedShape &placed = *static_cast<const PlacedShape *>(object);
  const Vec3 local = transposed_times(placed.pose.rotation, {direction->v[0], direction->v[1], direction->v[2]});
  const Vec3 core = cmb::convex::core_support(placed.shape->body, local).point;
  const Vec3 p = placed.pose(core + placed.shape->body.radius * normalized(local));
  ccdVec3Set(result, p.x, p.y, p.z);
}

void center(const void *object, ccd_vec3_t *result) {
  const PlacedShape &placed = *static_cast<const PlacedShape *>(object);
  const Vec3 p = placed.pose(cmb::convex::core_center(placed.shape->body));
  ccdVec3Set(result, p.x, p.y, p.z);
}

std::shared_ptr<fcl::CollisionGeometryd> fcl_geometry(const Shape &shape) {
  const Vec3 &h = shape.body.half;
  switch (shape.kind) {
    case ShapeKind::halfspace: return std::make_shared<fcl::Halfspaced>(fcl::Vector3d(0, 0, 1), 0.0);
    case ShapeKind::sphere: return std::make_shared<fcl::Sphered>(shape.body.radius);
    case ShapeKind::capsule: return std::make_shared<fcl::Capsuled>(shape.body.radius, 2 * h.z);
    case ShapeKind::box: return std::make_shared<fcl::Boxd>(2 * h.x, 2 * h.y, 2 * h.z);
    default: break;
  }
  const auto &polytope = shape.polytope->geometry();
  auto vertices = std::make_shared<std::vector<fcl::Vector3d>>();
  auto faces = std::make_shared<std::vector<int>>();
  for (const Vec3 &v : polytope.vertices()) vertices->emplace_back(v.x, v.y, v.z);
  for (const auto &face : polytope.faces()) {
    faces->push_back(face.count);
    for (int k = 0; k < face.count; ++k) {
      faces->push_back(polytope.face_vertices()[static_cast<std::size_t>(face.first + k)]);
    }
  }
  return std::make_shared<fcl::Convexd>(vertices, static_cast<int>(polytope.faces().size()), faces);
}

void run(const Case &c) {
  std::mt19937 random(3);
  const auto uniform = [&](double low, double high) { return low + (high - low) * (random() / 4294967296.0); };
  std::vector<double> position(6 * poses_a_case, 0.0), rotation(18 * poses_a_case, 0.0);
  std::vector<Pose> pose_a(poses_a_case);
  for (int k = 0; k < poses_a_case; ++k) {
    const double yaw = uniform(-3.1, 3.1), tilt = uniform(-c.tilt, c.tilt);
    const double cy = std::cos(yaw), sy = std::sin(yaw), ct = std::cos(tilt), st = std::sin(tilt);
    // First tilted about y, then turned about z.
    pose_a[static_cast<std::size_t>(k)] = {{{{cy * ct, -sy, cy * st}, {sy * ct, cy, sy * st}, {-st, 0, ct}}},
                                           {uniform(-0.1, 0.1), uniform(-0.1, 0.1), c.height + uniform(0, 1e-3)}};
    const Pose &pose = pose_a[static_cast<std::size_t>(k)];
    for (int i = 0; i < 3; ++i) {
      position[static_cast<std::size_t>(6 * k + i)] = pose.translation[i];
      for (int j = 0; j < 3; ++j) {
        rotation[static_cast<std::size_t>(18 * k + 3 * i + j)] = pose.rotation.row[j][i];
        rotation[static_cast<std::size_t>(18 * k + 9 + 3 * i + j)] = i == j ? 1.0 : 0.0;
      }
    }
  }
  const char *geometry[] = {c.a.c_str(), c.b.c_str()};
  const int pairs[] = {1, 2};
  cmb_scene scene = 0;
  if (cmb_intern(geometry, 2, pairs, 1, CMB_BACKEND_AUTO, &scene) != CMB_OK) {
    std::printf("%s: %s\n", c.name, cmb_last_error());
    return;
  }
  double distance, depth[8], weight[8], normal[24], point[24];
  const double engine = median_microseconds([&](int k) {
    cmb_query_scene(scene, &position[static_cast<std::size_t>(6 * k)], &rotation[static_cast<std::size_t>(18 * k)], 2, 1,
                    8, &distance, depth, weight, normal, point);
  });

  const auto shapes_a = cmb::parse_descriptor(c.a), shapes_b = cmb::parse_descriptor(c.b);
  double ccd_time = std::nan("");
  if (shapes_b[0].kind != ShapeKind::halfspace) {
    ccd_t options;
    CCD_INIT(&options);
    options.support1 = options.support2 = support;
    options.center1 = options.center2 = center;
    options.max_iterations = 500;
    PlacedShape a{&shapes_a[0], {}}, b{&shapes_b[0], {}};
    ccd_time = median_microseconds([&](int k) {
      a.pose = pose_a[static_cast<std::size_t>(k)];
      ccd_real_t ccd_depth;
      ccd_vec3_t direction, at;
      ccdMPRPenetration(&a, &b, &options, &ccd_depth, &direction, &at);
    });
  }

  fcl::CollisionObjectd object_a(fcl_geometry(shapes_a[0])), object_b(fcl_geometry(shapes_b[0]));
  const double fcl_time = median_microseconds([&](int k) {
    fcl::Transform3d transform = fcl::Transform3d::Identity();
    const Pose &pose = pose_a[static_cast<std::size_t>(k)];
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) transform.linear()(i, j) = pose.rotation.row[i][j];
      transform.translation()(i) = pose.translation[i];
    }
    object_a.setTransform(transform);
    object_a.computeAABB();
    fcl::CollisionRequestd request(8, true);
    request.gjk_solver_type = fcl::GST_INDEP;
    fcl::CollisionResultd result;
    fcl::collide(&object_a, &object_b, request, result);
  });
  std::printf("%-34s %10.2f %10.2f %10.2f\n", c.name, engine, ccd_time, fcl_time);
}

}  // namespace

int main() {
  const std::string sphere = "cmb/1 sphere radius=0.5", cube = "cmb/1 box size=1,1,1",
                    table = "cmb/1 box size=4,4,1", plane = "cmb/1 halfspace",
                    capsule = "cmb/1 capsule radius=0.2 length=0.6", hull = hull_of_sphere(100);
  const Case cases[] = {{"sphere, half-space", sphere, plane, 0.49, 3.0},
                        {"box flat, half-space", cube, plane, 0.49, 0.0},
                        {"box tilted, half-space", cube, plane, 0.55, 0.3},
                        {"hull of 100 points, half-space", hull, plane, 0.48, 3.0},
                        {"sphere, sphere", sphere, sphere, 0.98, 3.0},
                        {"sphere, box", sphere, cube, 0.98, 3.0},
                        {"capsule, capsule", capsule, capsule, 0.88, 0.3},
                        {"capsule, box", capsule, table, 0.98, 0.3},
                        {"box, box apart", cube, table, 1.5, 0.3},
                        {"box flat, larger box", cube, table, 0.99, 0.0},
                        {"box tilted, larger box", cube, table, 1.05, 0.3},
                        {"box flat, equal box", cube, cube, 0.99, 0.0},
                        {"hull of 100 points, box", hull, table, 0.98, 3.0},
                        {"hulls of 100 points", hull, hull, 0.97, 3.0}};
  std::printf("median of one query, microseconds\n%-34s %10s %10s %10s\n", "pair", "engine", "libccd MPR", "FCL");
  for (const Case &c : cases) run(c);
  return 0;
}
