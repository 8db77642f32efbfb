// Random and adversarial poses against the independent references.
//
//   stress_convex_distance [samples [seed [class]]]
//   stress_convex_distance --replay seed class sample
//
// A failure prints the second line, which asks for that pose alone and prints all of it, fault or not.
//
// For every class of pairs: largest errors of distance, normal and witness points relative to the
// size, of the exchange of A and B, of continuity under a small motion; repeated queries must agree to
// the bit. The exit status is 1 where a limit is exceeded.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>

#include "support/random_bodies.hpp"
#include "support/reference_smooth.hpp"

namespace {

using namespace cmb::convex;
using namespace random_bodies;
using reference::Real;

// A body with what the references need. `shape` (null for cores that are no polytopes) is kept alive here.
struct Sample {
  ConvexBody body;
  std::shared_ptr<Polytope> shape;
  reference::Polyhedron polyhedron;  // empty for curved, point and segment cores
  bool curved = false;
};

Sample hull_sample(const std::vector<Vec3> &points) {
  Sample sample;
  sample.shape = std::make_shared<Polytope>();
  if (!build_convex_hull(points, *sample.shape, nullptr, nullptr)) return sample;
  sample.body = make_polytope(*sample.shape);
  sample.polyhedron = reference_of(*sample.shape);
  return sample;
}

Sample box_sample(const Vec3 &size, bool as_hull) {
  Sample sample;
  sample.shape = std::make_shared<Polytope>(Polytope::box(size));
  sample.body = as_hull ? make_polytope(*sample.shape) : make_box(size);
  sample.polyhedron = reference_of(*sample.shape);
  return sample;
}

struct Class {
  const char *name;
  int share;           // samples: in thousandths of the total
  int pool;            // different bodies
  double limit;        // of the distance's error, relative to the size
  Sample (*make)(Random &random);
};

Vec3 sides(Random &random, double least) {
  return {random.log_uniform(least, 1), random.log_uniform(least, 1), random.log_uniform(least, 1)};
}

template <int per_thousand>
Sample make_curved(Random &random) {
  constexpr double least = 1e-3 * per_thousand;
  Sample sample;
  const double r = random.log_uniform(least, 1), h = random.log_uniform(least, 1);
  switch (random.integer(0, 4)) {
    case 0: sample.body = make_ellipsoid(sides(random, least)); break;
    case 1: sample.body = make_cylinder(r, 2 * h, random.integer(0, 1) * 0.1); break;
    case 2: sample.body = make_cone(r, 2 * h); break;
    case 3: sample = hull_sample(random_points(random, random.integer(4, 8), {1, 0.7, 0.5}, false)); break;
    default: sample.body = make_box(sides(random, least), 0.05); break;
  }
  sample.curved = true;
  return sample;
}

Sample make_round(Random &random) {
  Sample sample = random.integer(0, 1) ? box_sample(sides(random, 0.1), random.integer(0, 1) != 0)
                                       : hull_sample(random_points(random, 12, sides(random, 0.2), false));
  sample.body.radius = random.integer(0, 3) * 0.1;
  return sample;
}

// Cylinders and spheres as CAD systems tessellate them: many symmetric, coplanar and parallel parts.
Sample make_tessellated(Random &random) {
  std::vector<Vec3> points;
  const int around = random.integer(3, 24);
  const double full = 6.283185307179586, radius = random.log_uniform(0.1, 1), half = random.log_uniform(0.1, 1);
  if (random.integer(0, 1)) {
    for (int k = 0; k < around; ++k) {
      for (double z : {-half, half}) {
        points.push_back({radius * std::cos(full * k / around), radius * std::sin(full * k / around), z});
      }
    }
  } else {
    const int rings = random.integer(2, 7);
    points = {{0, 0, radius}, {0, 0, -radius}};
    for (int ring = 1; ring < rings; ++ring) {
      const double polar = 0.5 * full * ring / rings, r = radius * std::sin(polar), z = radius * std::cos(polar);
      for (int k = 0; k < around; ++k) {
        points.push_back({r * std::cos(full * k / around), r * std::sin(full * k / around), z});
      }
    }
  }
  if (random.integer(0, 1)) {  // as a file with seven digits brings them
    const Mat3 turn = random_rotation(random);
    for (Vec3 &p : points) {
      p = turn * p;
      for (int axis = 0; axis < 3; ++axis) p.set(axis, static_cast<float>(p[axis]));
    }
  }
  return hull_sample(points);
}

// A cube or hull of any size from a millimetre to a kilometre.
Sample make_sized(Random &random) {
  const double size = random.log_uniform(1e-3, 1e3);
  if (random.integer(0, 1)) return box_sample(size * sides(random, 0.3), random.integer(0, 1) != 0);
  return hull_sample(random_points(random, 12, size * sides(random, 0.3), false));
}

const Class classes[] = {
    {"boxes", 250, 400, 1e-9, [](Random &r) { return box_sample(sides(r, 0.3), false); }},
    {"slender boxes", 120, 400, 1e-9, [](Random &r) { return box_sample(sides(r, 1e-3), r.integer(0, 1) != 0); }},
    {"cubes as hulls", 100, 2, 1e-9, [](Random &) { return box_sample({1, 1, 1}, true); }},
    {"tetrahedra", 200, 400, 1e-9, [](Random &r) { return hull_sample(random_points(r, 4, sides(r, 0.1), true)); }},
    {"hulls of up to 20", 60, 400, 1e-9,
     [](Random &r) { return hull_sample(random_points(r, r.integer(5, 20), sides(r, 0.1), r.integer(0, 1) != 0)); }},
    {"slender hulls", 60, 400, 1e-9,
     [](Random &r) { return hull_sample(random_points(r, r.integer(5, 20), sides(r, 1e-3), r.integer(0, 1) != 0)); }},
    {"rounded polytopes", 100, 400, 1e-9, make_round},
    {"prisms on grids", 20, 100, 1e-9,
     [](Random &r) {
       std::vector<Vec3> points;  // many vertices in common planes
       for (int k = r.integer(6, 20); k > 0; --k) {
         for (double z : {-1.0, 1.0}) points.push_back({0.125 * r.integer(-8, 8), 0.125 * r.integer(-8, 8), z});
       }
       return hull_sample(points);
     }},
    {"tessellated solids", 15, 100, 1e-9, make_tessellated},
    {"1 mm to 1 km", 80, 400, 1e-9, make_sized},
    {"hulls of 100", 2, 40, 1e-9, [](Random &r) { return hull_sample(random_points(r, 100, sides(r, 0.3), false)); }},
    {"curved bodies", 8, 400, 1e-6, make_curved<100>},
    {"slender curved", 4, 400, 1e-6, make_curved<1>},
};

// A pose by one of several recipes, most of them made to be hard.
Pose make_pose(Random &random, const Sample &a, const Sample &b, double size, DistanceScratch &scratch) {
  Pose pose{random_rotation(random), {}};
  switch (random.integer(0, 5)) {
    case 0: pose.rotation = Mat3{}; break;
    case 1: pose.rotation = rotation_about(random.direction(), random.log_uniform(1e-14, 1)); break;
    case 2: {  // a right angle or an eighth of a turn about an axis
      Vec3 axis;
      axis.set(random.integer(0, 2), 1.0);
      pose.rotation = rotation_about(axis, 0.78539816339744831 * random.integer(1, 7));
      break;
    }
    case 3: {  // a face of B on a face of A, or edges parallel
      if (a.shape == nullptr || b.shape == nullptr) break;
      const auto &fa = a.shape->faces()[static_cast<std::size_t>(
          random.integer(0, static_cast<int>(a.shape->faces().size()) - 1))];
      const auto &fb = b.shape->faces()[static_cast<std::size_t>(
          random.integer(0, static_cast<int>(b.shape->faces().size()) - 1))];
      Vec3 from = fb.normal, to = -fa.normal;
      if (random.integer(0, 1)) {
        from = b.shape->edge_directions()[0];
        to = a.shape->edge_directions()[0];
      }
      const Vec3 axis = cross(from, to);
      const double sine = norm(axis), cosine = dot(from, to);
      if (sine > 1e-12) pose.rotation = rotation_about((1 / sine) * axis, std::atan2(sine, cosine));
      break;
    }
    default: break;
  }
  pose.translation = size * random.uniform(0, 1.5) * random.direction();
  if (random.integer(0, 4) == 0) {
    for (int axis = 0; axis < 3; ++axis) {
      if (random.integer(0, 1)) pose.translation.set(axis, 0.0);
    }
  }
  if (random.integer(0, 2)) {  // to a given depth or gap
    const SignedDistance d = signed_distance(a.body, b.body, pose, scratch);
    const double target = (random.integer(0, 2) ? -1 : 1) * size * random.log_uniform(1e-9, 0.3);
    pose.translation = pose.translation + (d.distance - target) * d.normal;
  }
  return pose;
}

bool same_bits(const SignedDistance &p, const SignedDistance &q) {
  return std::memcmp(&p.distance, &q.distance, sizeof p.distance) == 0 &&
         std::memcmp(&p.normal, &q.normal, sizeof p.normal) == 0 &&
         std::memcmp(&p.point_a, &q.point_a, sizeof p.point_a) == 0 &&
         std::memcmp(&p.point_b, &q.point_b, sizeof p.point_b) == 0;
}

// Every sample has random numbers of its own, so that it can be replayed without those before it.
Random random_of_sample(std::uint64_t seed, long sample) {
  return Random(Random(seed ^ Random(static_cast<std::uint64_t>(sample)).bits()).bits());
}

// Samples first ... end - 1. `replay`: prints each, whatever comes of it.
bool run(const Class &c, long first, long end, std::uint64_t seed, bool replay = false) {
  const long samples = end - first;
  Random random(seed);
  std::vector<Sample> pool;
  int refused = 0;
  while (static_cast<int>(pool.size()) < c.pool) {
    Sample sample = c.make(random);
    if (sample.shape != nullptr && sample.shape->vertices().empty()) {  // points that span no volume?
      if (++refused > c.pool) return false;
      continue;
    }
    pool.push_back(std::move(sample));
  }
  DistanceScratch scratch, other_scratch;
  reference::Errors worst;
  double worst_exchange = 0, worst_jump = 0;
  long failures = 0, queries_out = 0;
  for (long k = first; k < end; ++k) {
    random = random_of_sample(seed, k);
    const Sample &a = pool[static_cast<std::size_t>(random.integer(0, c.pool - 1))];
    const Sample &b = pool[static_cast<std::size_t>(random.integer(0, c.pool - 1))];
    const double size = 2 * std::max(core_radius(a.body) + a.body.radius, core_radius(b.body) + b.body.radius);
    const Pose pose = make_pose(random, a, b, size, scratch);
    const SignedDistance d = signed_distance(a.body, b.body, pose, scratch);
    queries_out += d.distance > 0;
    reference::Errors e;
    if (a.curved || b.curved) {
      e = reference::check_smooth(a.body, b.body, pose, d, true);
    } else {
      e = reference::check(a.polyhedron, moved(b.polyhedron, pose), a.body.radius, b.body.radius, d);
    }
    worst.distance = std::max(worst.distance, e.distance / size);
    worst.normal = std::max(worst.normal, e.normal / size);
    worst.witness = std::max(worst.witness, e.witness / size);
    const SignedDistance exchanged = signed_distance(b.body, a.body, pose.inverse(), scratch);
    const double exchange = std::fabs(exchanged.distance - d.distance) / size;
    worst_exchange = std::max(worst_exchange, exchange);
    // A motion of B by `motion` at most anywhere changes the distance by that at most.
    const double turn = random.log_uniform(1e-14, 1e-3);
    const Mat3 small = rotation_about(random.direction(), turn);
    Pose near = pose;
    for (int i = 0; i < 3; ++i) near.rotation.row[i] = transposed_times(pose.rotation, small.row[i]);
    near.translation = pose.translation + turn * size * random.direction();
    const double motion = turn * (size + core_radius(b.body));
    const double change = std::fabs(signed_distance(a.body, b.body, near, scratch).distance - d.distance);
    const double jump = (change - motion) / size;
    worst_jump = std::max(worst_jump, jump);
    const bool repeatable = same_bits(d, signed_distance(a.body, b.body, pose, other_scratch));
    const double limit = c.limit;
    const bool finite =
        std::isfinite(d.distance) && is_finite(d.normal) && is_finite(d.point_a) && is_finite(d.point_b);
    const bool holds = finite && repeatable && e.distance < limit * size && e.normal < limit * size &&
                       e.witness < 1e-6 * size && exchange < limit && jump < limit;
    if (!holds) ++failures;
    if (replay || (!holds && failures <= 5)) {
      std::printf("  %s %s sample %ld: distance %.17g errors %.2Lg normal %.2Lg witness %.2Lg exchange %.2g jump "
                  "%.2g repeatable %d method %d\n",
                  holds ? "holds" : "FAILED", c.name, k, d.distance, e.distance / size, e.normal / size, e.witness / size, exchange, jump,
                  repeatable, static_cast<int>(d.method));
      std::printf("    replay: stress_convex_distance --replay %llu '%s' %ld\n", static_cast<unsigned long long>(seed),
                  c.name, k);
      for (const Sample *sample : {&a, &b}) {
        const Vec3 &h = sample->body.half;
        std::printf("    body of pool %ld: core %d half %a %a %a radius %a\n", static_cast<long>(sample - pool.data()),
                    static_cast<int>(sample->body.core), h.x, h.y, h.z, sample->body.radius);
      }
      const Vec3 *r = pose.rotation.row;
      std::printf("    pose {{{%a, %a, %a}, {%a, %a, %a}, {%a, %a, %a}}}, {%a, %a, %a}\n", r[0].x, r[0].y, r[0].z,
                  r[1].x, r[1].y, r[1].z, r[2].x, r[2].y, r[2].z, pose.translation.x, pose.translation.y,
                  pose.translation.z);
    }
  }
  if (refused > 0) std::printf("%-18s %d sets of points refused\n", c.name, refused);
  std::printf("%-18s %9ld poses, %4.1f %% apart: distance %.1Le normal %.1Le witness %.1Le exchange %.1e jump %.1e; "
              "brute force %llu, unproven %llu of %llu queries; %ld failures\n",
              c.name, samples, 100.0 * queries_out / samples, worst.distance, worst.normal, worst.witness,
              worst_exchange, worst_jump, static_cast<unsigned long long>(scratch.counters.brute_force),
              static_cast<unsigned long long>(scratch.counters.unproven),
              static_cast<unsigned long long>(scratch.counters.queries), failures);
  std::fflush(stdout);
  return failures == 0;
}

}  // namespace

int main(int argc, char **argv) {
  if (argc > 1 && std::strcmp(argv[1], "--replay") == 0) {
    if (argc != 5) {
      std::fprintf(stderr, "stress_convex_distance: --replay takes seed, class and sample\n");
      return 2;
    }
    const long sample = std::atol(argv[4]);
    for (const Class &c : classes) {
      if (std::strcmp(c.name, argv[3]) != 0) continue;
      return run(c, sample, sample + 1, std::strtoull(argv[2], nullptr, 10), true) ? 0 : 1;
    }
    std::fprintf(stderr, "stress_convex_distance: there is no class '%s'\n", argv[3]);
    return 2;
  }
  const long samples = argc > 1 ? std::atol(argv[1]) : 60000;
  const std::uint64_t seed = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1;
  bool good = true;
  const char *only = argc > 3 ? argv[3] : "";  // part of a class's name
  for (const Class &c : classes) {
    if (std::strstr(c.name, only) == nullptr) continue;
    good = run(c, 0, std::max(20L, samples * c.share / 1000), seed) && good;
  }
  return good ? 0 : 1;
}
