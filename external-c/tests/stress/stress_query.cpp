// Random and adversarial poses of all pairs of kinds of bodies, through the public interface.
//
//   stress_query [poses [seed [kinds]]]          `kinds`: part of a class's name, such as "box, cylinder"
//   stress_query --replay seed kinds sample
//
// Checked at every pose: no error, no number that is not finite, points that fit the distance; at some, by turns:
//  - apart, the distance is proven by how far the bodies reach along the normal: no contact is missed, no sign is wrong;
//  - of boxes and hulls, the depth is that of the separating axes; of others, no direction leads out sooner;
//  - on half-spaces, the distance is the lowest point's;
//  - closed meshes, compounds and level height fields agree with the convex bodies or the half-space they stand for;
//  - the same bits again, the same distance reversed, and changes no greater than the motion that makes them;
//  - FCL and libccd as back ends change nothing by more than they may.
// A failure, or a signal that ends the program, prints the second line, which asks for that pose alone.
#include <algorithm>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <optional>
#include <unistd.h>

#include "../published_poses.hpp"
#include "certificates.hpp"
#include "geometry/pose_algebra.hpp"
#include "pair_answer.hpp"
#include "solids.hpp"

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

// Two bodies with all the scenes they are asked in.
struct Bodies {
  Solid a, b;
  Axes axes_a, axes_b;  // of boxes and hulls
  std::unique_ptr<Pair> pair, fcl, libccd;
  std::vector<std::vector<std::unique_ptr<Pair>>> parts;  // where A or B is a mesh or a compound: by parts of A and B
  // Meshes push a body's surface as far as it faces them: how deep an overlap surely carries. A body that is unloaded may
  // have no such surface.
  double range = 0.0;
  // A corner or an edge of a mesh is felt by an ellipsoid, cylinder or cone once it is deeper than the round surface is off
  // the pieces that stand for it: this part of the size at most.
  double late = 0.0;
};

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

bool is_single(const Solid &solid) { return solid.nature == Nature::convex; }
bool is_hull(const Solid &solid) { return is_single(solid) && solid.parts[0].form == Part::Form::points; }
bool is_sheet(const Solid &solid) { return solid.nature == Nature::flat_sheet || solid.nature == Nature::rough_sheet; }

// Parts that stand for the body as far as its distance is concerned.
bool has_parts(const Solid &solid) { return !solid.parts.empty(); }

std::unique_ptr<Bodies> make_bodies(const Class &c, Random &random) {
  auto bodies = std::make_unique<Bodies>();
  bodies->a = c.a->make(random);
  bodies->b = c.b->make(random);
  const Solid &a = bodies->a, &b = bodies->b;
  bodies->pair = std::make_unique<Pair>(a.text, b.text);
  bodies->range = 0.25 * std::min(a.least_thickness(), b.least_thickness());
  const auto has_pieces = [](const Solid &solid) {
    return std::any_of(solid.parts.begin(), solid.parts.end(), [](const Part &part) {
      return part.form == Part::Form::ellipsoid || part.form == Part::Form::cylinder || part.form == Part::Form::cone;
    });
  };
  bodies->late = has_pieces(a) || has_pieces(b) ? 1e-3 : 0.0;
  if (is_single(a) && is_single(b)) {
    bodies->fcl = std::make_unique<Pair>(a.text, b.text, CMB_BACKEND_FCL);
    bodies->libccd = std::make_unique<Pair>(a.text, b.text, CMB_BACKEND_LIBCCD);
  }
  if (is_hull(a) && is_hull(b)) {
    bodies->axes_a = axes_of(a.parts[0].points);
    bodies->axes_b = axes_of(b.parts[0].points);
  }
  if (has_parts(a) && has_parts(b) && !(is_single(a) && is_single(b))) {
    for (const Part &part : a.parts) {
      bodies->parts.emplace_back();
      for (const Part &other : b.parts) bodies->parts.back().push_back(std::make_unique<Pair>(part.text, other.text));
    }
  }
  return bodies;
}

double size_of(const Bodies &bodies) { return 2.0 * std::max(bodies.a.radius, bodies.b.radius); }

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

// One pose of two bodies, with what all checks need.
struct Sample {
  const Bodies &bodies;
  bool unloaded = false;  // the surfaces cross, but nothing pushes: deep, or hardly by an edge (Bodies::range, late)
  Pose a, b;
  double slack;  // m, that rounding and the engine's own accuracy may take
  Answer answer;
};

using Fault = std::optional<std::string>;

Fault too_far(const char *what, double value, double expected) {
  char text[160];
  std::snprintf(text, sizeof text, "%s: %.17g instead of %.17g", what, value, expected);
  return text;
}

double least_gap_along(const Sample &s, const Vec3 &n) {
  return gap_along(s.bodies.a.parts[0], s.a, s.bodies.b.parts[0], s.b, n);
}

Fault check_convex(const Sample &s, Random &random) {
  const Answer &answer = s.answer;
  if (answer.distance > s.slack) {
    const double proven = least_gap_along(s, answer.normal[0]);
    if (!(proven > answer.distance - s.slack)) return too_far("apart, proven by the normal", proven, answer.distance);
    return {};
  }
  // Every direction leads out of the overlap within its own depth.
  double gap = -1e300;
  const auto offer = [&](const Vec3 &n) { gap = std::max(gap, least_gap_along(s, n)); };
  for (std::size_t k = 0; k < capacity; ++k) offer(answer.normal[k]);
  for (int k = 0; k < 3; ++k) {
    for (const double sense : {-1.0, 1.0}) {
      offer(sense * s.a.rotation.column(k));
      offer(sense * s.b.rotation.column(k));
    }
    offer(random.direction());
  }
  if (norm(s.a.translation - s.b.translation) > 0.0) offer(normalized(s.a.translation - s.b.translation));
  if (gap > answer.distance + s.slack) return too_far("a direction leads out sooner", answer.distance, gap);
  return {};
}

Fault check_axes(const Sample &s) {
  const double gap = greatest_gap(s.bodies.a.parts[0], s.bodies.axes_a, s.a, s.bodies.b.parts[0], s.bodies.axes_b, s.b);
  const bool same = gap > 0.0 ? s.answer.distance > gap - s.slack : std::fabs(s.answer.distance - gap) < s.slack;
  if (!same) return too_far("separating axes", s.answer.distance, gap);
  return {};
}

// The distance of a body of parts from the half-space z <= height of a pose.
double above_plane(const Solid &solid, const Pose &pose, const Pose &plane, double height) {
  const Vec3 n = plane.rotation.column(2);
  double least = 1e300;
  for (const Part &part : solid.parts) {
    least = std::min(least, dot(n, pose.translation - plane.translation) - height -
                                reach(part, -transposed_times(pose.rotation, n)));
  }
  return least;
}

double top_above_plane(const Solid &solid, const Pose &pose, const Pose &plane) {
  const Vec3 n = plane.rotation.column(2);
  double most = -1e300;
  for (const Part &part : solid.parts) {
    most = std::max(most, dot(n, pose.translation - plane.translation) + reach(part, transposed_times(pose.rotation, n)));
  }
  return most;
}

// `ground` is a half-space or a sheet, `solid` has parts.
Fault check_ground(Sample &s, const Solid &solid, const Pose &pose, const Solid &ground, const Pose &plane) {
  const double d = s.answer.distance;
  if (ground.nature == Nature::halfspace) {
    const double expected = above_plane(solid, pose, plane, 0.0);
    if (std::fabs(d - expected) > s.slack) return too_far("on the half-space", d, expected);
    return {};
  }
  const double above = above_plane(solid, pose, plane, ground.high), below = above_plane(solid, pose, plane, ground.low);
  if (above > s.slack && !(d > above - s.slack)) return too_far("above the sheet", d, above);
  if (ground.nature == Nature::flat_sheet && above > s.slack && std::fabs(d - above) > s.slack) {
    return too_far("above the level sheet", d, above);
  }
  if (below < -s.slack && above > -s.bodies.range && top_above_plane(solid, pose, plane) > ground.high + s.slack && d >= 0.0) {
    return too_far("through the sheet", d, below);
  }
  return {};
}

// Closed meshes and compounds against the convex parts they stand for.
Fault check_parts(Sample &s) {
  double least = 1e300;
  for (const auto &row : s.bodies.parts) {
    for (const auto &pair : row) least = std::min(least, pair->ask(s.a, s.b).distance);
  }
  const double d = s.answer.distance;
  const bool meshes = s.bodies.a.nature == Nature::closed_mesh || s.bodies.b.nature == Nature::closed_mesh;
  bool same = std::fabs(d - least) < s.slack;
  if (meshes && least < s.slack) {
    // Meshes measure depth along their triangles' normals; whether they touch is the same.
    s.unloaded = d == 0.0 && (least < -s.bodies.range || least > -s.bodies.late * size_of(s.bodies));
    same = s.unloaded || (d < s.slack && (d < 0.0 || least > -s.slack));
  }
  if (!same) return too_far("the distance of its convex parts", d, least);
  return {};
}

Fault check_library(const Sample &s, const Pair &library) {
  const Answer answer = library.ask(s.a, s.b);
  if (const char *wrong = fault_of_numbers(answer)) return std::string("as a back end: ") + wrong;
  if ((answer.distance < 0.0) != (s.answer.distance < 0.0)) {
    return too_far("touching, as a back end", answer.distance, s.answer.distance);
  }
  // The engine's bounding spheres are about the bodies' middles, these about their origins.
  const double allowed = 2e-4 * (s.bodies.a.radius + s.bodies.b.radius);
  if (std::fabs(answer.distance - s.answer.distance) > allowed) {
    return too_far("as a back end", answer.distance, s.answer.distance);
  }
  return {};
}

Fault check_reversed(const Sample &s) {
  const Answer reversed = s.bodies.pair->ask(s.a, s.b, true);
  if (const char *wrong = fault_of_numbers(reversed)) return std::string("reversed: ") + wrong;
  // Of two meshes the larger one pushes, of equal ones the second: they touch either way, but not as deep.
  const auto is_mesh = [](const Solid &solid) { return solid.nature == Nature::closed_mesh || is_sheet(solid); };
  const bool either_way = is_mesh(s.bodies.a) && is_mesh(s.bodies.b) && s.answer.distance < 0.0 && reversed.distance < 0.0;
  if (!either_way && std::fabs(reversed.distance - s.answer.distance) > s.slack) {
    return too_far("reversed", reversed.distance, s.answer.distance);
  }
  return {};
}

Fault check_motion(const Sample &s, Random &random) {
  const double turn = random.log_uniform(1e-14, 1e-3), size = size_of(s.bodies);
  const Vec3 shift = turn * size * random.direction();
  Pose near = s.a;
  near.rotation = compose({rotation_about(random.direction(), turn), {}}, s.a).rotation;
  near.translation = s.a.translation + shift;
  const Answer answer = s.bodies.pair->ask(near, s.b);
  if (const char *wrong = fault_of_numbers(answer)) return std::string("moved: ") + wrong;
  const bool exact_depth = has_parts(s.bodies.a) && has_parts(s.bodies.b) &&
                           s.bodies.a.nature != Nature::closed_mesh && s.bodies.b.nature != Nature::closed_mesh;
  if (!exact_depth && (answer.distance < 0.0 || s.answer.distance < 0.0)) return {};
  // What of A, which may have no end, is near B.
  const double reaches = std::max(s.bodies.a.radius, norm(s.a.translation - s.b.translation) +
                                                         std::max(s.bodies.b.radius, s.bodies.b.extent));
  const double motion = turn * (size + reaches);
  if (std::fabs(answer.distance - s.answer.distance) > motion + 2.0 * s.slack) {
    return too_far("a change greater than the motion", answer.distance, s.answer.distance);
  }
  return {};
}

Fault check(Sample &s, Random &random, long sample) {
  s.answer = s.bodies.pair->ask(s.a, s.b);
  if (const char *wrong = fault_of_numbers(s.answer)) return wrong;
  const Solid &a = s.bodies.a, &b = s.bodies.b;
  if (is_single(a) && is_single(b)) {
    if (auto fault = check_convex(s, random)) return fault;
    if (sample % 8 == 0 && is_hull(a) && is_hull(b)) {
      if (auto fault = check_axes(s)) return fault;
    }
    if (sample % 32 == 1) return check_library(s, *s.bodies.fcl);
    if (sample % 16 == 2) return check_library(s, *s.bodies.libccd);
  } else if (has_parts(b) && !has_parts(a)) {
    if (auto fault = check_ground(s, b, s.b, a, s.a)) return fault;
  } else if (has_parts(a) && !has_parts(b)) {
    if (auto fault = check_ground(s, a, s.a, b, s.b)) return fault;
  } else if (has_parts(a) && has_parts(b) && sample % 2 == 0) {
    if (auto fault = check_parts(s)) return fault;
  }
  if (sample % 4 == 1) return check_reversed(s);
  if (sample % 4 == 3 && (a.nature != Nature::halfspace || has_parts(b))) return check_motion(s, random);
  if (sample % 16 == 4 && !same_bits(s.answer, s.bodies.pair->ask(s.a, s.b))) return "the same pose gives other bits";
  return {};
}

void print_pose(const char *name, const Pose &pose) {
  const Vec3 *r = pose.rotation.row;
  std::printf("    %s {{{%a, %a, %a}, {%a, %a, %a}, {%a, %a, %a}}}, {%a, %a, %a}\n", name, r[0].x, r[0].y, r[0].z, r[1].x,
              r[1].y, r[1].z, r[2].x, r[2].y, r[2].z, pose.translation.x, pose.translation.y, pose.translation.z);
}

struct Tally {
  long poses = 0, failures = 0, touching = 0, unloaded = 0;
};

// Every sample has random numbers of its own, so that it can be replayed without those before it.
Random random_of_sample(std::uint64_t seed, long sample) {
  return Random(Random(seed ^ Random(static_cast<std::uint64_t>(sample)).bits()).bits());
}

// Samples first ... end - 1 of a class. `replay`: prints each, whatever comes of it.
Tally run(const Class &c, long first, long end, std::uint64_t seed, bool replay) {
  Random making(seed);
  std::vector<std::unique_ptr<Bodies>> pool;
  for (int k = 0; k < pairs_in_a_class; ++k) pool.push_back(make_bodies(c, making));
  Tally tally;
  for (long k = first; k < end; ++k) {
    std::snprintf(replay_line, sizeof replay_line, "    replay: stress_query --replay %llu '%s' %ld\n",
                  static_cast<unsigned long long>(seed), c.name.c_str(), k);
    alarm(seconds_a_pose);
    Random random = random_of_sample(seed, k);
    const Bodies &bodies = *pool[static_cast<std::size_t>(random.integer(0, pairs_in_a_class - 1))];
    Fault fault;
    Sample s{bodies, false, {}, {}, 0.0, {}};
    try {
      const Pose relative = make_pose(bodies, random);
      double far = 0.0;
      if (random.integer(0, 2) == 0) {  // elsewhere in the world
        far = random.log_uniform(1e-2, 1e3) * size_of(bodies);
        s.b = {random_rotation(random), far * random.direction()};
      }
      s.a = compose(s.b, relative);
      const bool curved = bodies.a.curved || bodies.b.curved;
      s.slack = (curved ? 1e-6 : 1e-9) * std::max(size_of(bodies), std::max(bodies.a.extent, bodies.b.extent)) + 1e-14 * far;
      fault = check(s, random, k);
    } catch (const std::string &error) {
      fault = error;
    } catch (...) {
      fault = "an exception came out of the engine";
    }
    ++tally.poses;
    tally.touching += s.answer.distance < 0.0;
    tally.failures += fault.has_value();
    tally.unloaded += s.unloaded;
    if (replay || (fault && tally.failures <= 5)) {
      std::printf("  %s %s sample %ld: distance %.17g%s%s\n%s    %.300s\n    %.300s\n", fault ? "FAILED" : "holds",
                  c.name.c_str(), k, s.answer.distance, fault ? ": " : "", fault ? fault->c_str() : "", replay_line,
                  bodies.a.text.c_str(), bodies.b.text.c_str());
      print_pose("A", s.a);
      print_pose("B", s.b);
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
      if (fault == nullptr && k % 8 == 0 && std::fabs(fcl[which]->ask(a, b).distance - answer.distance) > 5e-4) {
        fault = "FCL as a back end";
      }
      if (fault == nullptr && std::fabs(libccd[which]->ask(a, b).distance - answer.distance) > 5e-4) {
        fault = "libccd as a back end";
      }
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
  std::printf("%-26s %9ld poses, %4.1f %% touching, %ld crossing without a load, %ld failures\n", name, tally.poses,
              100.0 * static_cast<double>(tally.touching) / static_cast<double>(std::max(1L, tally.poses)), tally.unloaded,
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
    total.unloaded += tally.unloaded;
  };
  for (const Class &c : all) {
    if (c.name.find(only) != std::string::npos) count(c.name.c_str(), run(c, 0, in_a_class, seed, false));
  }
  if (*only == '\0') count("published failures", run_published(in_a_class, seed));
  print_tally("all", total);
  return total.failures == 0 ? 0 : 1;
}
