// Random and adversarial poses of all pairs of kinds of bodies, through the public interface.
//
//   stress_query [poses [seed [kinds]]]          `kinds`: part of a class's name, such as "box, cylinder"
//   stress_query --replay seed kinds sample
//
// Checked at every pose: no error, no number that is not finite, points that fit the distance; at some, in alternation:
//  - apart, the distance is proven by how far the bodies reach along the normal: no contact is missed, no sign is wrong;
//  - of boxes and hulls, the depth is that of the separating axes; of others, no direction leads out sooner;
//  - on half-spaces, the distance is the lowest point's;
//  - closed meshes, compounds and level height fields agree with the convex bodies or the half-space they stand for;
//  - two level height fields touch where their squares cross;
//  - the same bits again, the same distance reversed, and changes no greater than the motion that makes them;
//  - with FCL and libccd as back ends no contact is missed, and bodies apart are as far apart.
// A failure, or a signal that ends the program, prints the second line, which asks for that pose alone.
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>
#include <vector>
#include <unistd.h>

#include "checks.hpp"
#include "math/pose_algebra.hpp"
#include "support/published_poses.hpp"

namespace {

using namespace cmb::stress;
using cmb::compose;
using random_bodies::random_rotation;
using random_bodies::rotation_about;

constexpr int pairs_in_a_class = 40;
constexpr unsigned seconds_a_pose = 60;

char replay_line[200];

void on_signal(int number) {
  const char *const what = number == SIGALRM ? "FAILED: no answer\n" : "FAILED: the program is ended\n";
  // write() is one of the few functions that may be called here.
  if (write(STDOUT_FILENO, what, std::strlen(what)) > 0 && write(STDOUT_FILENO, replay_line, std::strlen(replay_line)) > 0) {
    std::signal(number, SIG_DFL);
  }
  std::raise(number == SIGALRM ? SIGABRT : number);
}

struct Class {
  std::string name;
  const Kind *a, *b;
};

std::vector<Class> classes() {
  std::vector<Class> all;
  for (std::size_t i = 0; i < kinds().size(); ++i) {
    for (std::size_t j = i; j < kinds().size(); ++j) {
      all.push_back({std::string(kinds()[i].name) + ", " + kinds()[j].name, &kinds()[i], &kinds()[j]});
    }
  }
  return all;
}

// Where A is in B's frame, by one of several recipes, most of them made to be hard.
Pose make_pose(const Bodies &bodies, Random &random) {
  const double size = size_of(bodies);
  Pose pose{random_rotation(random), {}};
  switch (random.integer(0, 4)) {
    case 0: pose.rotation = {}; break;
    case 1: pose.rotation = rotation_about(random.direction(), random.log_uniform(1e-15, 1)); break;
    case 2: {  // an eighth of a turn, or several, about an axis; one more, hardly off it
      Vec3 axis;
      axis.set(random.integer(0, 2), 1.0);
      pose.rotation = rotation_about(axis, 0.78539816339744831 * random.integer(1, 7));
      if (random.integer(0, 1)) {
        pose.rotation = compose(pose, {rotation_about(random.direction(), random.log_uniform(1e-16, 1e-6)), {}}).rotation;
      }
      break;
    }
    default: break;
  }
  pose.translation = size * random.uniform(0, 1.5) * random.direction();
  if (is_sheet(bodies.b)) pose.translation.z = std::fabs(pose.translation.z);
  if (random.integer(0, 3) == 0) {
    for (int axis = 0; axis < 3; ++axis) {
      if (random.integer(0, 1)) pose.translation.set(axis, 0.25 * random.integer(-4, 4));
    }
  }
  if (random.integer(0, 2) != 0) {  // to a given depth or gap
    const Answer answer = bodies.pair->ask(pose, {});
    const double target = (random.integer(0, 2) ? -1 : 1) * size * random.log_uniform(1e-15, 0.3);
    if (answer.distance < 1e8) pose.translation = pose.translation + (target - answer.distance) * answer.normal[0];
  }
  return pose;
}

void print_pose(const char *name, const Pose &pose) {
  const Vec3 *r = pose.rotation.row;
  std::printf("    %s {{{%a, %a, %a}, {%a, %a, %a}, {%a, %a, %a}}}, {%a, %a, %a}\n", name, r[0].x, r[0].y, r[0].z, r[1].x,
              r[1].y, r[1].z, r[2].x, r[2].y, r[2].z, pose.translation.x, pose.translation.y, pose.translation.z);
}

struct Tally {
  long poses = 0, failures = 0, touching = 0;
};

// Every sample has random numbers of its own, so that it can be replayed without those before it.
Random random_of_sample(std::uint64_t seed, long sample) {
  return Random(Random(seed ^ Random(static_cast<std::uint64_t>(sample)).bits()).bits());
}

// Samples first ... end - 1 of a class. `replay`: prints each, whatever comes of it.
Tally run(const Class &c, long first, long end, std::uint64_t seed, bool replay) {
  Random making(seed);
  std::vector<std::unique_ptr<Bodies>> pool;
  for (int k = 0; k < pairs_in_a_class; ++k) pool.push_back(make_bodies(*c.a, *c.b, making));
  Tally tally;
  for (long k = first; k < end; ++k) {
    std::snprintf(replay_line, sizeof replay_line, "    replay: stress_query --replay %llu '%s' %ld\n",
                  static_cast<unsigned long long>(seed), c.name.c_str(), k);
    alarm(seconds_a_pose);
    Random random = random_of_sample(seed, k);
    const Bodies &bodies = *pool[static_cast<std::size_t>(random.integer(0, pairs_in_a_class - 1))];
    Fault fault;
    Sample s{bodies, {}, {}, 0.0, 0.0, {}};
    try {
      const Pose relative = make_pose(bodies, random);
      double far = 0.0;
      if (random.integer(0, 2) == 0) {  // elsewhere in the world
        far = random.log_uniform(1e-2, 1e3) * size_of(bodies);
        s.b = {random_rotation(random), far * random.direction()};
      }
      s.a = compose(s.b, relative);
      const bool curved = bodies.a.curved || bodies.b.curved;
      const double size = std::max(size_of(bodies), std::max(bodies.a.extent, bodies.b.extent));
      s.rounding = 1e-13 * size + 1e-14 * far;
      s.slack = (curved ? 1e-6 : 1e-9) * size + 1e-14 * far;
      fault = check(s, random, k);
    } catch (const std::string &error) {
      fault = error;
    } catch (...) {
      fault = "an exception came out of the engine";
    }
    ++tally.poses;
    tally.touching += s.answer.distance < 0.0;
    tally.failures += fault.has_value();
    if (replay || (fault && tally.failures <= 5)) {
      std::printf("  %s %s sample %ld: distance %.17g%s%s\n%s    %s\n    %s\n", fault ? "FAILED" : "holds",
                  c.name.c_str(), k, s.answer.distance, fault ? ": " : "", fault ? fault->c_str() : "", replay_line,
                  bodies.a.text.c_str(), bodies.b.text.c_str());
      print_pose("A", s.a);
      print_pose("B", s.b);
      for (std::size_t i = 0; i < capacity; ++i) {
        if (s.answer.depth[i] == 0.0 && s.answer.weight[i] == 0.0) continue;
        std::printf("    point: depth %.17g weight %.17g\n", s.answer.depth[i], s.answer.weight[i]);
      }
    }
  }
  alarm(0);
  return tally;
}

// Reported failures of other libraries, as they are and moved a little.
Tally run_published(long samples, std::uint64_t seed) {
  Tally tally;
  const auto &published = cmb::test::published_poses();
  std::vector<std::unique_ptr<Pair>> pairs, fcl, libccd;
  for (const auto &p : published) {
    pairs.push_back(std::make_unique<Pair>(p.a, p.b));
    fcl.push_back(std::make_unique<Pair>(p.a, p.b, CMB_BACKEND_FCL));
    libccd.push_back(std::make_unique<Pair>(p.a, p.b, CMB_BACKEND_LIBCCD));
  }
  for (long k = 0; k < samples; ++k) {
    const auto which = static_cast<std::size_t>(k) % published.size();
    const auto &p = published[which];
    std::snprintf(replay_line, sizeof replay_line, "    near the pose of %s, sample %ld of seed %llu\n", p.source, k,
                  static_cast<unsigned long long>(seed));
    alarm(seconds_a_pose);
    Random random = random_of_sample(seed, k);
    Pose a{p.pose_a.rotation, p.pose_a.position};
    const Pose b{p.pose_b.rotation, p.pose_b.position};
    if (k >= static_cast<long>(published.size())) {
      const double little = random.log_uniform(1e-17, 1e-2);
      a.rotation = compose({rotation_about(random.direction(), little), {}}, a).rotation;
      a.translation = a.translation + little * random.direction();
    }
    const char *fault = nullptr;
    try {
      const Answer answer = pairs[which]->ask(a, b);
      tally.touching += answer.distance < 0.0;
      fault = fault_of_numbers(answer);
      if (fault == nullptr && std::fabs(pairs[which]->ask(a, b, true).distance - answer.distance) > 1e-6) {
        fault = "another distance reversed";
      }
      const auto may_say = [&](const Pair &library) {
        return is_library_answer(library.ask(a, b).distance, answer.distance, 5e-4, 1e-12);
      };
      if (fault == nullptr && k % 8 == 0 && !may_say(*fcl[which])) fault = "FCL as a back end";
      if (fault == nullptr && !may_say(*libccd[which])) fault = "libccd as a back end";
    } catch (...) {
      fault = "an error or exception";
    }
    ++tally.poses;
    tally.failures += fault != nullptr;
    if (fault != nullptr && tally.failures <= 5) {
      std::printf("  FAILED: %s\n%s", fault, replay_line);
      print_pose("A", a);
      print_pose("B", b);
    }
  }
  alarm(0);
  return tally;
}

void print_tally(const char *name, const Tally &tally) {
  std::printf("%-26s %9ld poses, %4.1f %% touching, %ld failures\n", name, tally.poses,
              100.0 * static_cast<double>(tally.touching) / static_cast<double>(std::max(1L, tally.poses)),
              tally.failures);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char **argv) {
  for (const int number : {SIGABRT, SIGSEGV, SIGFPE, SIGBUS, SIGILL, SIGALRM}) std::signal(number, on_signal);
  const std::vector<Class> all = classes();
  if (argc > 1 && std::strcmp(argv[1], "--replay") == 0) {
    if (argc != 5) {
      std::fprintf(stderr, "stress_query: --replay takes seed, kinds and sample\n");
      return 2;
    }
    const long sample = std::atol(argv[4]);
    for (const Class &c : all) {
      if (c.name != argv[3]) continue;
      return run(c, sample, sample + 1, std::strtoull(argv[2], nullptr, 10), true).failures == 0 ? 0 : 1;
    }
    std::fprintf(stderr, "stress_query: there are no kinds '%s'\n", argv[3]);
    return 2;
  }
  const long poses = argc > 1 ? std::atol(argv[1]) : 60000;
  const std::uint64_t seed = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1;
  const char *only = argc > 3 ? argv[3] : "";
  const auto in_a_class = static_cast<long>(static_cast<std::size_t>(poses) / (all.size() + 1) + 1);
  Tally total;
  const auto count = [&](const char *name, const Tally &tally) {
    print_tally(name, tally);
    total.poses += tally.poses;
    total.failures += tally.failures;
    total.touching += tally.touching;
  };
  for (const Class &c : all) {
    if (c.name.find(only) != std::string::npos) count(c.name.c_str(), run(c, 0, in_a_class, seed, false));
  }
  const std::string published = "published failures";
  if (published.find(only) != std::string::npos) count(published.c_str(), run_published(in_a_class, seed));
  print_tally("all", total);
  return total.failures == 0 ? 0 : 1;
}
