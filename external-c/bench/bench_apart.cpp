// Times pairs that are far apart, all pairs of a scene in one query: exact distances, and bounds from 0.1 m on
// (cmb_query_scene).
//
//   bench_apart [bodies]
#include <time.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "contact_multibody.h"
#include "support/engine_calls.hpp"
#include "support/random_bodies.hpp"

namespace {

double processor_microseconds() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}

constexpr int sweeps = 31;

void run(const char *name, const std::string &body, std::size_t bodies, std::size_t capacity) {
  std::vector<const char *> geometry(bodies, body.c_str());
  std::vector<int> pairs;
  for (int i = 1; i <= static_cast<int>(bodies); ++i) {
    for (int j = i + 1; j <= static_cast<int>(bodies); ++j) pairs.insert(pairs.end(), {i, j});
  }
  const std::size_t pair_count = pairs.size() / 2;
  cmb_scene scene{};
  if (cmb::test::intern_scene(geometry.data(), bodies, pairs.data(), pair_count, CMB_BACKEND_AUTO, &scene) != CMB_OK) {
    std::fprintf(stderr, "%s\n", cmb_last_error());
    std::exit(1);
  }
  random_bodies::Random random(7);
  std::vector<double> position, rotation, distance(pair_count), depth(pair_count * capacity), weight(pair_count * capacity),
      normal(3 * pair_count * capacity), point(3 * pair_count * capacity);
  const auto side = static_cast<std::size_t>(std::ceil(std::cbrt(static_cast<double>(bodies))));
  for (std::size_t k = 0; k < bodies; ++k) {
    for (const std::size_t cell : {k % side, k / side % side, k / side / side}) {
      position.push_back(3.0 * static_cast<double>(cell) + random.uniform(-0.3, 0.3));
    }
    const auto turn = random_bodies::random_rotation(random);
    for (int i = 0; i < 9; ++i) rotation.push_back(turn.row[i % 3][i / 3]);
  }
  std::vector<double> times[2];
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    for (const bool bounded : {false, true}) {
      const double begin = processor_microseconds();
      cmb::test::query_scene(scene, position.data(), rotation.data(), bodies, pair_count, capacity, distance.data(), depth.data(),
                  weight.data(), normal.data(), point.data(), bounded ? 0.1 : HUGE_VAL);
      times[bounded].push_back((processor_microseconds() - begin) / static_cast<double>(pair_count));
    }
  }
  for (auto &list : times) std::sort(list.begin(), list.end());
  std::printf("%-20s %8zu %6zu %10.3f %10.3f\n", name, pair_count, capacity, times[0][sweeps / 2], times[1][sweeps / 2]);
}

}  // namespace

int main(int argc, char **argv) {
  const std::size_t bodies = argc > 1 ? static_cast<std::size_t>(std::atol(argv[1])) : 64;
  std::printf("microseconds of processor time a pair, medians: bodies of about 1 m on a grid of 3 m, all pairs\n");
  std::printf("%-20s %8s %6s %10s %10s\n", "bodies", "pairs", "slots", "exact", "bounds");
  random_bodies::Random random(100);
  std::string hull = "cmb/1 hull vertices=";
  for (int i = 0; i < 100; ++i) {
    const auto p = 0.5 * random.direction();
    hull += (i > 0 ? "," : "") + std::to_string(p.x) + "," + std::to_string(p.y) + "," + std::to_string(p.z);
  }
  for (const std::size_t capacity : {std::size_t{1}, std::size_t{8}}) {
    run("spheres", "cmb/1 sphere radius=0.5", bodies, capacity);
    run("boxes", "cmb/1 box size=0.6,0.8,1", bodies, capacity);
    run("hulls of 100", hull, bodies, capacity);
    run("cylinders", "cmb/1 cylinder radius=0.4 length=0.7", bodies, capacity);
  }
  return 0;
}
