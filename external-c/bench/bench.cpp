// Times the contact of one pair in one run: the engine, through its C interface and with its manifold, beside libccd's
// portal refinement, FCL's collide and coal's collide without and with contact patch.
//
//   bench [poses a row [part of the rows' names]]
//
// A row is a kind of pair at one distance (relative to the sizes of about 1 m); every query has another pose. The
// contestants take turns, sweep after sweep over all poses, so that what else the machine does hits them alike.
// Printed: medians in microseconds of processor time, half the interquartile range, the engine's ratio to coal with patch, and to
// libccd; and each one's largest error of the distance, the engine's exact path (checked against independent
// references by the tests) being the measure.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "backend/distance_backend.hpp"
#include "bench_support.hpp"
#include "contact_peer.hpp"
#include "scene/descriptor.hpp"
#include "support/random_bodies.hpp"

namespace {

using namespace cmb;
using namespace cmb::bench;
using random_bodies::Random;

constexpr int sweeps = 31;

enum class Attitude {
  any,   // both bodies anyhow
  flat,  // A's foot on B's top, turned about the vertical and moved within B's top
};

struct Row {
  const char *name;
  std::string a, b;
  double distance;
  Attitude attitude = Attitude::any;
};

double lowest(const Shape &shape) {
  return (convex::core_support(shape.body, {0, 0, -1}).point).z - shape.body.radius;
}

PosedPair place(const Row &row, std::size_t poses) {
  PosedPair pair;
  pair.descriptor_a = row.a;
  pair.descriptor_b = row.b;
  pair.a = parse_descriptor(row.a)[0];
  pair.b = parse_descriptor(row.b)[0];
  Random random(5);
  BackendScratch scratch;
  for (int attempts = 0; pair.pose_a.size() < poses && attempts < 100 * static_cast<int>(poses); ++attempts) {
    Pose a, b;
    if (row.attitude == Attitude::flat || pair.b.kind == ShapeKind::halfspace) {
      const double top = pair.b.kind == ShapeKind::halfspace
                             ? 0.0
                             : convex::core_support(pair.b.body, {0, 0, 1}).point.z + pair.b.body.radius;
      if (row.attitude == Attitude::flat) {
        a.rotation = random_bodies::rotation_about({0, 0, 1}, random.uniform(-3, 3));
        a.translation = {random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), top - lowest(pair.a) + row.distance};
      } else {
        a.rotation = random_bodies::random_rotation(random);
        const Vec3 down = transposed_times(a.rotation, Vec3{0, 0, -1});
        const double reach = dot(down, convex::core_support(pair.a.body, down).point) + pair.a.body.radius;
        a.translation = {0, 0, reach + row.distance};
      }
      pair.pose_a.push_back(a);
      pair.pose_b.push_back(b);
      continue;
    }
    a.rotation = random_bodies::random_rotation(random);
    b.rotation = random_bodies::random_rotation(random);
    a.translation = random.direction();
    for (int k = 0; k < 3; ++k) {
      const SignedDistance answer = exact_distance(pair.a, a, pair.b, b, scratch);
      a.translation = a.translation + (row.distance - answer.distance) * answer.normal;
    }
    if (std::fabs(exact_distance(pair.a, a, pair.b, b, scratch).distance - row.distance) <
        0.2 * std::fabs(row.distance)) {
      pair.pose_a.push_back(a);
      pair.pose_b.push_back(b);
    }
  }
  return pair;
}

struct Column {
  std::unique_ptr<ContactPeer> peer;
  std::vector<double> times;  // of a query in each sweep, microseconds
  double median = 0.0, half_spread = 0.0, error = 0.0;
  std::size_t failures = 0;
};

void run(const Row &row, std::size_t poses) {
  const PosedPair pair = place(row, poses);
  Column columns[5];
  columns[0].peer = make_engine(pair);
  columns[1].peer = make_coal_collide(pair, true);
  columns[2].peer = make_coal_collide(pair, false);
  columns[3].peer = make_libccd_portal(pair);
  columns[4].peer = make_fcl_collide(pair);
  BackendScratch scratch;
  for (Column &column : columns) {
    if (!column.peer) continue;
    for (std::size_t k = 0; k < pair.pose_a.size(); ++k) {
      const double found = column.peer->ask(k);  // also warms up
      const double exact = pair.b.kind == ShapeKind::halfspace
                               ? row.distance
                               : exact_distance(pair.a, pair.pose_a[k], pair.b, pair.pose_b[k], scratch).distance;
      if (std::isfinite(found)) column.error = std::fmax(column.error, std::fabs(found - exact));
      if (!std::isfinite(found)) ++column.failures;
    }
  }
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    for (Column &column : columns) {
      if (!column.peer) continue;
      const double begin = processor_microseconds();
      for (std::size_t k = 0; k < pair.pose_a.size(); ++k) column.peer->ask(k);
      column.times.push_back((processor_microseconds() - begin) / static_cast<double>(pair.pose_a.size()));
    }
  }
  std::printf("%-32s %7g", row.name, row.distance);
  for (Column &column : columns) {
    if (!column.peer) {
      std::printf(" | %21s", "-");
      continue;
    }
    std::sort(column.times.begin(), column.times.end());
    const std::size_t n = column.times.size();
    column.median = column.times[n / 2];
    column.half_spread = 0.5 * (column.times[3 * n / 4] - column.times[n / 4]);
    std::printf(" | %7.3f %5.3f ", column.median, column.half_spread);
    if (column.failures == pair.pose_a.size()) {
      std::printf("%7s", "none");
    } else {
      std::printf("%7.0e", column.error);
    }
  }
  const auto ratio = [&](const Column &other) {
    if (other.peer) {
      std::printf(" %6.2f", columns[0].median / other.median);
    } else {
      std::printf(" %6s", "-");
    }
  };
  std::printf(" |");
  ratio(columns[1]);
  ratio(columns[3]);
  std::printf("\n");
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char **argv) {
  const std::size_t poses = argc > 1 ? static_cast<std::size_t>(std::atol(argv[1])) : 256;
  const std::string sphere = "cmb/1 sphere radius=0.5", cube = "cmb/1 box size=1,1,1", box = "cmb/1 box size=0.6,0.8,1",
                    table = "cmb/1 box size=4,4,1", plane = "cmb/1 halfspace",
                    capsule = "cmb/1 capsule radius=0.2 length=0.6", cylinder = "cmb/1 cylinder radius=0.4 length=0.7",
                    cone = "cmb/1 cone radius=0.4 length=0.8", ellipsoid = "cmb/1 ellipsoid size=0.6,0.8,1",
                    hull20 = hull_descriptor(20), hull100 = hull_descriptor(100), hull1000 = hull_descriptor(1000);
  const Row rows[] = {
      {"sphere, half-space", sphere, plane, -0.01},
      {"box, half-space", box, plane, -0.01},
      {"box flat, half-space", box, plane, -0.01, Attitude::flat},
      {"cylinder flat, half-space", cylinder, plane, -0.01, Attitude::flat},
      {"hull of 100, half-space", hull100, plane, -0.01},
      {"sphere, sphere", sphere, sphere, -0.01},
      {"sphere, box", sphere, box, -0.01},
      {"capsule, capsule", capsule, capsule, -0.01},
      {"capsule, box", capsule, box, -0.01},
      {"box, box", box, box, -0.001},
      {"box, box", box, box, -0.01},
      {"box, box", box, box, -0.1},
      {"box flat on larger box", cube, table, -0.01, Attitude::flat},
      {"box flat on equal box", cube, cube, -0.01, Attitude::flat},
      {"cylinder, box", cylinder, box, -0.01},
      {"cylinder flat on larger box", cylinder, table, -0.01, Attitude::flat},
      {"cylinder, cylinder", cylinder, cylinder, -0.01},
      {"cylinder flat on cylinder", cylinder, cylinder, -0.01, Attitude::flat},
      {"cone, box", cone, box, -0.01},
      {"cone flat on larger box", cone, table, -0.01, Attitude::flat},
      {"ellipsoid, box", ellipsoid, box, -0.01},
      {"ellipsoid, ellipsoid", ellipsoid, ellipsoid, -0.01},
      {"hulls of 20", hull20, hull20, -0.001},
      {"hulls of 20", hull20, hull20, -0.01},
      {"hulls of 20", hull20, hull20, -0.1},
      {"hulls of 100", hull100, hull100, -0.001},
      {"hulls of 100", hull100, hull100, -0.01},
      {"hulls of 100", hull100, hull100, -0.1},
      {"hulls of 100", hull100, hull100, -0.3},
      {"hulls of 1000", hull1000, hull1000, -0.001},
      {"hulls of 1000", hull1000, hull1000, -0.01},
      {"hulls of 1000", hull1000, hull1000, -0.1},
      {"hull of 100, larger box", hull100, table, -0.01},
      {"box, box apart", box, box, 0.05},
      {"box, box far apart", box, box, 3.0},
      {"hulls of 100 apart", hull100, hull100, 0.05},
      {"hulls of 100 far apart", hull100, hull100, 3.0},
      {"cylinder, cylinder apart", cylinder, cylinder, 0.05},
  };
  std::printf("microseconds of processor time a query: median, half the interquartile range; largest error of the distance, m\n");
  std::printf("%-32s %7s | %-21s | %-21s | %-21s | %-21s | %-21s | ratio of engine to\n", "pair", "m apart",
              "engine with manifold", "coal with patch", "coal", "libccd MPR", "FCL collide");
  std::printf("%-32s %7s | %21s | %21s | %21s | %21s | %21s | %6s %6s\n", "", "", "", "", "", "", "", "patch", "MPR");
  for (const Row &row : rows) {
    if (argc <= 2 || std::strstr(row.name, argv[2]) != nullptr) run(row, poses);
  }
  return 0;
}
