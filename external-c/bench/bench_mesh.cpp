// Times contact of two meshes at the same poses: the engine through its C interface, and fcl::collide asked for all
// contacts (crossing triangles; it knows no depth). Prints, over the poses, the median of both and of their ratio, with
// the quartiles of the ratio.
//
//   bench_mesh [poses a row]
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/OBBRSS.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/collision_object.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "contact_multibody.h"
#include "support/engine_calls.hpp"
#include "support/mesh_text.hpp"
#include "support/random_bodies.hpp"

namespace {

using cmb::convex::Mat3;
using cmb::convex::Vec3;
using mesh_samples::MeshData;

constexpr int repetitions = 15;
constexpr double depth = 0.01;  // m, of bodies of about 1 m

// A ring of n x m quadrilaterals, each cut in two, about the z axis.
MeshData torus(double radius, double tube, std::uint32_t n, std::uint32_t m) {
  constexpr double turn = 6.283185307179586;
  MeshData data;
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < m; ++j) {
      const double u = turn * i / n, v = turn * j / m, r = radius + tube * std::cos(v);
      data.vertices.push_back({r * std::cos(u), r * std::sin(u), tube * std::sin(v)});
      const std::uint32_t next_i = (i + 1) % n, next_j = (j + 1) % m;
      const std::uint32_t a = i * m + j, b = next_i * m + j, c = next_i * m + next_j, d = i * m + next_j;
      data.triangles.push_back({a, b, c});
      data.triangles.push_back({a, c, d});
    }
  }
  return data;
}

std::shared_ptr<fcl::CollisionGeometryd> fcl_mesh(const MeshData &data) {
  auto model = std::make_shared<fcl::BVHModel<fcl::OBBRSSd>>();
  std::vector<fcl::Vector3d> vertices;
  std::vector<fcl::Triangle> triangles;
  for (const Vec3 &p : data.vertices) vertices.emplace_back(p.x, p.y, p.z);
  for (const auto &t : data.triangles) triangles.emplace_back(t[0], t[1], t[2]);
  model->beginModel();
  model->addSubModel(vertices, triangles);
  model->endModel();
  return model;
}

// The least of several runs, in microseconds: what disturbs a run makes it longer.
template <typename Work>
double microseconds(Work &&work) {
  double least = std::numeric_limits<double>::infinity();
  for (int r = 0; r < repetitions; ++r) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double, std::micro> taken = std::chrono::steady_clock::now() - begin;
    least = std::min(least, taken.count());
  }
  return least;
}

double quantile(std::vector<double> values, double part) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(part * static_cast<double>(values.size() - 1))];
}

// Two bodies of one mesh, the second one at rest.
void run(const char *name, const MeshData &data, int poses) {
  const std::string text = mesh_samples::mesh_text(data);
  const char *geometry[] = {text.c_str(), text.c_str()};
  const int pairs[] = {1, 2};
  cmb_scene scene{};
  if (cmb::test::intern_scene(geometry, 2, pairs, 1, CMB_BACKEND_AUTO, &scene) != CMB_OK) {
    std::printf("%s: %s\n", name, cmb_last_error());
    std::exit(1);
  }
  fcl::CollisionObjectd one(fcl_mesh(data)), other(fcl_mesh(data));
  random_bodies::Random random(1);
  std::vector<double> engine_times, fcl_times, ratios, contacts;
  for (int k = 0; k < poses; ++k) {
    const Vec3 direction = random.direction();
    const Mat3 turned = random_bodies::random_rotation(random);
    double position[6] = {}, rotation[18] = {0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) rotation[3 * i + j] = turned.row[j][i];
    }
    double distance, depths[8], weight[8], normal[24], point[24];
    const auto ask = [&] {
      cmb::test::query_scene(scene, position, rotation, 2, 1, 8, &distance, depths, weight, normal, point);
    };
    // From afar towards the other body: as far as the distance allows until they touch, then the depth.
    double along = 3.0;
    const auto place = [&] {
      for (int i = 0; i < 3; ++i) position[i] = along * direction[i];
    };
    for (int step = 0; step < 200 && along > 0.0; ++step) {
      place();
      ask();
      if (distance < 1e-6) break;
      along -= distance;
    }
    if (!(along > 0.05)) continue;  // through the hole
    along -= depth;
    place();
    engine_times.push_back(microseconds(ask));
    fcl::Transform3d transform = fcl::Transform3d::Identity();
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) transform.linear()(i, j) = turned.row[i][j];
      transform.translation()(i) = position[i];
    }
    one.setTransform(transform);
    one.computeAABB();
    std::size_t found = 0;
    fcl_times.push_back(microseconds([&] {
      fcl::CollisionRequestd request(1000000, true);
      fcl::CollisionResultd result;
      found = fcl::collide(&one, &other, request, result);
    }));
    ratios.push_back(engine_times.back() / fcl_times.back());
    contacts.push_back(static_cast<double>(found));
  }
  std::printf("| %s, %zu triangles | %.0f | %.0f | %.2f | %.2f to %.2f | %.0f |\n", name, data.triangles.size(),
              quantile(engine_times, 0.5), quantile(fcl_times, 0.5), quantile(ratios, 0.5), quantile(ratios, 0.25),
              quantile(ratios, 0.75), quantile(contacts, 0.5));
}

}  // namespace

int main(int count, char **arguments) {
  const int poses = count > 1 ? std::atoi(arguments[1]) : 41;
  if (poses < 1) {
    std::fprintf(stderr, "usage: bench_mesh [poses a row]\n");
    return 2;
  }
  std::printf("| pair of meshes, %g mm deep | engine (us) | FCL collide (us) | ratio | quartiles | crossings |\n"
              "|---|---|---|---|---|---|\n", 1e3 * depth);
  run("spheres", mesh_samples::sphere_mesh(0.5, 3), poses);
  run("spheres", mesh_samples::sphere_mesh(0.5, 5), poses);
  run("rings", torus(0.5, 0.2, 32, 16), poses);
  run("rings", torus(0.5, 0.2, 100, 50), poses);
}
