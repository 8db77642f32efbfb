// Scenes of many bodies: the search for pairs beside FCL's dynamic tree, the cost of contact forces, and simulated
// seconds by numbers of spheres. Prints processor times and ratios; the ratios matter.
//
//   bench_scene [search] [forces] [fall]      all three if none is named
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/broadphase/default_broadphase_callbacks.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision_object.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <functional>
#include <memory>
#include <random>

#include "broadphase/broad_phase.hpp"
#include "support/engine_calls.hpp"
#include "support/rigid_bodies.hpp"

namespace {

using namespace cmb::test;

// Of this process: others share the machine.
double seconds(const std::function<void()> &work) {
  const std::clock_t begin = std::clock();
  work();
  return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

// The least of several runs.
double least_seconds(int runs, const std::function<void()> &work) {
  double least = HUGE_VAL;
  for (int run = 0; run < runs; ++run) least = std::min(least, seconds(work));
  return least;
}

// Spheres of radius 0.05 on a shaken lattice, each near enough to its neighbours to touch some.
struct Cloud {
  Bodies bodies;
  Motion motion;
  std::vector<Motion> moved;  // the same a little later, several times

  static Bodies spheres(int count, bool floor) {
    Bodies result;
    for (int i = 0; i < count; ++i) result.add_sphere(0.05, 0.5, 2e4, 0.3, 0.5);
    if (floor) result.add_fixed("cmb/1 halfspace", 0.3, 0.5);
    result.intern();
    return result;
  }

  Cloud(int count, bool floor) : bodies(spheres(count, floor)), motion(bodies.count()) {
    std::mt19937 random(1);
    const int edge = static_cast<int>(std::ceil(std::cbrt(count)));
    const auto shake = [&](double size) { return size * (random() / 2147483648.0 - 1.0); };
    for (int i = 0; i < count; ++i) {
      const Vec3 cell{0.1 * (i % edge), 0.1 * (i / edge % edge), 0.049 + 0.1 * (i / edge / edge)};
      Motion::set_row(motion.position, static_cast<std::size_t>(i), cell + Vec3{shake(0.01), shake(0.01), shake(0.01)});
      Motion::set_row(motion.velocity, static_cast<std::size_t>(i), {shake(0.1), shake(0.1), shake(0.1)});
    }
    for (int k = 0; k < 8; ++k) {
      moved.push_back(motion);
      for (double &x : moved.back().position) x += shake(1e-3);
    }
  }
};

bool count_pair(fcl::CollisionObjectd *, fcl::CollisionObjectd *, void *count) {
  ++*static_cast<std::size_t *>(count);
  return false;  // go on
}

void search() {
  std::printf("\nPairs whose bounds overlap, microseconds per body (spheres, all moved before each search)\n");
  std::printf("%8s %12s %12s %12s %8s %12s\n", "bodies", "pairs/body", "this", "FCL tree", "ratio", "growth");
  double first = 0.0;
  for (const int count : {100, 300, 1000, 3000, 10000}) {
    Cloud cloud(count, false);
    std::size_t found = 0;
    const int repetitions = std::max(1, 4000 / count);
    std::size_t turn = 0;
    const auto ours = [&] {
      for (int r = 0; r < repetitions; ++r) {
        const Motion &motion = cloud.moved[turn++ % cloud.moved.size()];
        query_candidates(cloud.bodies.broadphase, motion.position.data(), motion.rotation.data(),
                             cloud.bodies.count(), 0, nullptr, &found);
      }
    };
    ours();
    const double own = least_seconds(15, ours) / repetitions / count * 1e6;

    std::vector<std::unique_ptr<fcl::CollisionObjectd>> objects;
    fcl::DynamicAABBTreeCollisionManagerd manager;
    const auto sphere = std::make_shared<fcl::Sphered>(0.05);
    for (int i = 0; i < count; ++i) {
      objects.push_back(std::make_unique<fcl::CollisionObjectd>(sphere));
      const double *p = cloud.motion.position.data() + 3 * i;
      objects.back()->setTranslation({p[0], p[1], p[2]});
      objects.back()->computeAABB();
      manager.registerObject(objects.back().get());
    }
    manager.setup();
    std::size_t fcl_found = 0;
    const auto theirs = [&] {
      for (int r = 0; r < repetitions; ++r) {
        const Motion &motion = cloud.moved[turn++ % cloud.moved.size()];
        for (int i = 0; i < count; ++i) {
          const double *p = motion.position.data() + 3 * i;
          objects[static_cast<std::size_t>(i)]->setTranslation({p[0], p[1], p[2]});
          objects[static_cast<std::size_t>(i)]->computeAABB();
        }
        manager.update();
        fcl_found = 0;
        manager.collide(&fcl_found, count_pair);
      }
    };
    theirs();
    const double fcl_time = least_seconds(5, theirs) / repetitions / count * 1e6;
    if (first == 0.0) first = own;
    std::printf("%8d %12.2f %12.3f %12.3f %8.2f %12.2f\n", count, static_cast<double>(found) / count, own, fcl_time,
                fcl_time / own, own / first);
    if (turn % cloud.moved.size() == 0 && found == 0 && fcl_found == 0) std::printf("no pairs?\n");
  }
}

void forces() {
  std::printf("\nContact forces of the same spheres on a floor, microseconds\n");
  std::printf("%8s %12s %12s %12s %12s %12s\n", "bodies", "contacts", "per body", "constant", "search", "growth");
  double first = 0.0;
  for (const int count : {10, 100, 1000, 10000}) {
    Cloud cloud(count, true);
    Wrenches wrenches(cloud.bodies, cloud.motion);
    const int repetitions = std::max(1, 2000 / count);
    std::size_t turn = 0, found = 0;
    const auto per_body = [&](const std::function<void(const Motion &)> &work) {
      const auto all = [&] {
        for (int r = 0; r < repetitions; ++r) work(cloud.moved[turn++ % cloud.moved.size()]);
      };
      all();
      return least_seconds(10, all) / repetitions / count * 1e6;
    };
    const auto evaluate = [&](const Motion &motion) { wrenches.evaluate(cloud.bodies, motion); };
    const double memoryless = per_body(evaluate);
    cloud.bodies.law.use_restitution = 0;
    const double constant = per_body(evaluate);
    const double search_alone = per_body([&](const Motion &motion) {
      query_candidates(cloud.bodies.broadphase, motion.position.data(), motion.rotation.data(),
                           cloud.bodies.count(), 0, nullptr, &found);
    });
    if (first == 0.0) first = memoryless;
    std::printf("%8d %12zu %12.3f %12.3f %12.3f %12.2f\n", count, wrenches.sums.contact_count, memoryless, constant,
                search_alone, memoryless / first);
  }
  std::printf("per body: restitution by the memoryless law; constant: damping in place of restitution\n");
}

// edge^3 spheres fall into a box with walls of half-spaces. edge * 0.12 wide.
void fall_of(int edge, double stop) {
  Bodies bodies;
  for (int i = 0; i < edge * edge * edge; ++i) bodies.add_sphere(0.05, 0.5, 2e4, 0.3, 0.5);
  const double half = 0.06 * edge;
  const std::string wall = "cmb/1 halfspace position=";
  bodies.add_fixed("cmb/1 halfspace;" + wall + digits(-half) + ",0,0 rotation=0,0,-1,0,1,0,1,0,0;" + wall +
                       digits(half) + ",0,0 rotation=0,0,1,0,1,0,-1,0,0;" + wall + "0," + digits(-half) +
                       ",0 rotation=1,0,0,0,0,-1,0,1,0;" + wall + "0," + digits(half) +
                       ",0 rotation=1,0,0,0,0,1,0,-1,0",
                   0.3, 0.5);
  bodies.law.rolling_lever = 1e-2;
  bodies.law.regularisation_speed = 0.05;
  bodies.law.turning_regularisation_speed = 0.2;
  bodies.intern();
  Motion start(bodies.count());
  std::mt19937 random(1);
  for (int i = 0; i < edge * edge * edge; ++i) {
    const auto shake = [&] { return 0.005 * (random() / 2147483648.0 - 1.0); };
    const Vec3 cell{0.12 * (i % edge) - half + 0.06, 0.12 * (i / edge % edge) - half + 0.06,
                    0.08 + 0.12 * (i / edge / edge)};
    Motion::set_row(start.position, static_cast<std::size_t>(i), cell + Vec3{shake(), shake(), shake()});
  }
  Simulation simulation(bodies, start, {0, 0, -9.81});
  const double weight = edge * edge * edge * 0.5 * 9.81, energy = simulation.energy();
  double rise = 0.0, last = energy;
  const double taken = seconds([&] {
    while (simulation.time() < stop) {
      simulation.run(simulation.time() + 0.02, 1e-5);
      rise = std::max(rise, simulation.energy() - last);
      last = simulation.energy();
    }
  });
  std::size_t escaped = 0;
  for (std::size_t i = 0; i + 1 < bodies.count(); ++i) {
    const Vec3 p = Motion::row(simulation.motion().position, i);
    if (std::fmax(std::fabs(p.x), std::fabs(p.y)) > half - 0.04 || p.z < 0.04) ++escaped;
  }
  const double force = -Motion::row(simulation.wrenches().force, bodies.count() - 1).z;
  std::printf("%8d %10.2f %12zu %12.2f %10zu %12.2e %12.6f %12.2e %8zu\n", edge * edge * edge, taken / stop,
              simulation.evaluations(), taken / static_cast<double>(simulation.evaluations()) * 1e6,
              simulation.wrenches().sums.contact_count, simulation.kinetic_energy(), force / weight,
              rise / energy, escaped);
  std::fflush(stdout);
}

void fall() {
  std::printf("\nSpheres fall into a box, 1 s; Bogacki-Shampine 3(2) with step control, tolerance 1e-5\n");
  std::printf("%8s %10s %12s %12s %10s %12s %12s %12s %8s\n", "spheres", "s per s", "evaluations", "us each",
              "contacts", "kinetic J", "floor/weight", "rise/energy", "escaped");
  for (const int edge : {2, 3, 5, 10}) fall_of(edge, 1.0);
}

}  // namespace

int main(int argc, char **argv) {
  const auto wanted = [&](const char *name) {
    return argc == 1 || std::any_of(argv + 1, argv + argc, [&](const char *given) { return !std::strcmp(given, name); });
  };
  if (wanted("search")) search();
  if (wanted("forces")) forces();
  if (wanted("fall")) fall();
  return 0;
}
