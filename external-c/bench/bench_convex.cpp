// Speed of signed convex distances beside libccd and FCL.
//
//   bench_convex [poses]
//
// Every pair class is asked at the same poses, each time a different one, so that neither branch
// prediction nor caches know the answer. Printed: median and 90 % quantile in microseconds of batches of
// 16 queries, and the largest error of the depth against this library (which the tests check
// against independent references), in units of the size 1.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <vector>

#include <ccd/ccd.h>
#include <fcl/fcl.h>

#include "narrowphase/convex_distance.hpp"
#include "support/random_bodies.hpp"
#include "volume/convex_overlap.hpp"

namespace {

using namespace cmb::convex;
using namespace random_bodies;

struct Pair {
  ConvexBody a, b;
  Pose pose;
  SignedDistance exact;
};

struct Times {
  double median = 0, quantile = 0, worst_error = 0;
  long failures = 0;
};

// Times `query(i)`, which returns the signed distance it finds (NaN: it failed).
Times measure(const std::vector<Pair> &pairs, const std::function<double(std::size_t)> &query) {
  constexpr std::size_t batch = 16;
  Times result;
  std::vector<double> times;
  for (int round = 0; round < 5; ++round) {
    for (std::size_t first = 0; first + batch <= pairs.size(); first += batch) {
      double found[batch];
      const auto begin = std::chrono::steady_clock::now();
      for (std::size_t k = 0; k < batch; ++k) found[k] = query(first + k);
      const std::chrono::duration<double, std::micro> spent = std::chrono::steady_clock::now() - begin;
      times.push_back(spent.count() / batch);
      if (round > 0) continue;
      for (std::size_t k = 0; k < batch; ++k) {
        const double error = std::fabs(found[k] - pairs[first + k].exact.distance);
        if (std::isfinite(error)) {
          result.worst_error = std::max(result.worst_error, error);
        } else {
          ++result.failures;
        }
      }
    }
  }
  std::sort(times.begin(), times.end());
  result.median = times[times.size() / 2];
  result.quantile = times[times.size() * 9 / 10];
  return result;
}

void print(const char *name, double target, const char *method, const Times &t) {
  std::printf("%-24s %8g  %-22s %9.2f %9.2f   %.1e", name, target, method, t.median, t.quantile, t.worst_error);
  if (t.failures > 0) std::printf("  (%ld failed)", t.failures);
  std::printf("\n");
  std::fflush(stdout);
}

// A body for libccd: the same support functions, in world axes.
struct CcdBody {
  ConvexBody body;
  Pose pose;
};

void ccd_support(const void *object, const ccd_vec3_t *direction, ccd_vec3_t *point) {
  const CcdBody &b = *static_cast<const CcdBody *>(object);
  const Vec3 d{direction->v[0], direction->v[1], direction->v[2]};
  const Vec3 local = transposed_times(b.pose.rotation, d);
  const Vec3 p = b.pose(core_support(b.body, local).point + b.body.radius * normalized(local));
  ccdVec3Set(point, p.x, p.y, p.z);
}

void ccd_center(const void *object, ccd_vec3_t *center) {
  const CcdBody &b = *static_cast<const CcdBody *>(object);
  const Vec3 p = b.pose(core_center(b.body));
  ccdVec3Set(center, p.x, p.y, p.z);
}

std::shared_ptr<fcl::CollisionGeometryd> fcl_geometry(const ConvexBody &body) {
  const Vec3 &h = body.half;
  switch (body.core) {
    case CoreShape::point: return std::make_shared<fcl::Sphered>(body.radius);
    case CoreShape::segment: return std::make_shared<fcl::Capsuled>(body.radius, 2 * h.z);
    case CoreShape::box: return std::make_shared<fcl::Boxd>(2 * h.x, 2 * h.y, 2 * h.z);
    case CoreShape::ellipsoid: return std::make_shared<fcl::Ellipsoidd>(h.x, h.y, h.z);
    case CoreShape::cylinder: return std::make_shared<fcl::Cylinderd>(h.x, 2 * h.z);
    case CoreShape::cone: return std::make_shared<fcl::Coned>(h.x, 2 * h.z);
    case CoreShape::polytope: break;
  }
  auto vertices = std::make_shared<std::vector<fcl::Vector3d>>();
  for (const Vec3 &v : body.polytope->vertices()) vertices->push_back({v.x, v.y, v.z});
  auto faces = std::make_shared<std::vector<int>>();
  for (const Polytope::Face &f : body.polytope->faces()) {
    faces->push_back(f.count);
    for (int k = 0; k < f.count; ++k) {
      faces->push_back(body.polytope->face_vertices()[static_cast<std::size_t>(f.first + k)]);
    }
  }
  return std::make_shared<fcl::Convexd>(vertices, static_cast<int>(body.polytope->faces().size()), faces, true);
}

fcl::Transform3d fcl_transform(const Pose &pose) {
  fcl::Transform3d t = fcl::Transform3d::Identity();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) t.linear()(i, j) = pose.rotation.row[i][j];
    t.translation()[i] = pose.translation[i];
  }
  return t;
}

using Maker = std::function<ConvexBody(Random &, std::vector<std::unique_ptr<Polytope>> &)>;

void run(const char *name, const Maker &make, double target, std::size_t poses) {
  Random random(11);
  DistanceScratch scratch;
  std::vector<std::unique_ptr<Polytope>> shapes;
  std::vector<ConvexBody> bodies;
  for (int k = 0; k < 32; ++k) bodies.push_back(make(random, shapes));
  std::vector<Pair> pairs;
  while (pairs.size() < poses) {
    const auto pick = [&] { return bodies[static_cast<std::size_t>(random.integer(0, 31))]; };
    Pair pair{pick(), pick(), {random_rotation(random), random.direction()}, {}};
    for (int k = 0; k < 3; ++k) {
      pair.exact = signed_distance(pair.a, pair.b, pair.pose, scratch);
      pair.pose.translation = pair.pose.translation + (pair.exact.distance - target) * pair.exact.normal;
    }
    pair.exact = signed_distance(pair.a, pair.b, pair.pose, scratch);
    if (std::fabs(pair.exact.distance - target) < 0.5 * std::fabs(target)) pairs.push_back(pair);
  }
  print(name, target, "this library", measure(pairs, [&](std::size_t i) {
          return signed_distance(pairs[i].a, pairs[i].b, pairs[i].pose, scratch).distance;
        }));

  std::vector<CcdBody> ccd_a, ccd_b;
  for (const Pair &pair : pairs) ccd_a.push_back({pair.a, Pose{}}), ccd_b.push_back({pair.b, pair.pose});
  ccd_t ccd;
  CCD_INIT(&ccd);
  ccd.support1 = ccd.support2 = ccd_support;
  ccd.center1 = ccd.center2 = ccd_center;
  ccd.max_iterations = 200;
  ccd.epa_tolerance = 1e-12;
  ccd.mpr_tolerance = 1e-12;
  const auto penetration = [&](auto function) {
    return [&, function](std::size_t i) {
      ccd_real_t depth;
      ccd_vec3_t direction, position;
      return function(&ccd_a[i], &ccd_b[i], &ccd, &depth, &direction, &position) == 0 ? -depth : NAN;
    };
  };
  if (target < 0) {
    print(name, target, "libccd MPR", measure(pairs, penetration(ccdMPRPenetration)));
    print(name, target, "libccd GJK+EPA", measure(pairs, penetration(ccdGJKPenetration)));
  }

  // Debian's FCL keeps its asserts: with curved bodies that overlap it ends the program.
  if (target < 0 && !is_polyhedral(pairs[0].a.core)) return;
  std::vector<std::shared_ptr<fcl::CollisionGeometryd>> geometry_a, geometry_b;
  std::vector<fcl::Transform3d> transforms;
  for (const Pair &pair : pairs) {
    geometry_a.push_back(fcl_geometry(pair.a));
    geometry_b.push_back(fcl_geometry(pair.b));
    transforms.push_back(fcl_transform(pair.pose));
  }
  const fcl::Transform3d identity = fcl::Transform3d::Identity();
  fcl::DistanceRequestd request;
  request.enable_signed_distance = true;
  request.gjk_solver_type = fcl::GST_LIBCCD;
  request.distance_tolerance = 1e-9;
  print(name, target, "FCL signed distance", measure(pairs, [&](std::size_t i) {
          try {
            fcl::DistanceResultd result;
            fcl::distance(geometry_a[i].get(), identity, geometry_b[i].get(), transforms[i], request, result);
            return result.min_distance;
          } catch (const std::exception &) {
            return std::nan("");
          }
        }));
}

void run_overlap(const char *name, const Maker &make, double depth, std::size_t poses) {
  Random random(12);
  DistanceScratch scratch;
  OverlapScratch overlap_scratch;
  std::vector<std::unique_ptr<Polytope>> shapes;
  std::vector<Pair> pairs;
  for (int k = 0; k < 32; ++k) make(random, shapes);
  const auto pick = [&] { return static_cast<std::size_t>(random.integer(0, 31)); };
  std::vector<std::pair<const Polytope *, const Polytope *>> bodies;
  while (pairs.size() < poses) {
    bodies.push_back({shapes[pick()].get(), shapes[pick()].get()});
    Pair pair{make_polytope(*bodies.back().first), make_polytope(*bodies.back().second),
              {random_rotation(random), random.direction()}, {}};
    for (int k = 0; k < 3; ++k) {
      pair.exact = signed_distance(pair.a, pair.b, pair.pose, scratch);
      pair.pose.translation = pair.pose.translation + (pair.exact.distance + depth) * pair.exact.normal;
    }
    pairs.push_back(pair);
  }
  Times t = measure(pairs, [&](std::size_t i) {
    return convex_overlap(*bodies[i].first, *bodies[i].second, pairs[i].pose, pairs[i].exact.normal, overlap_scratch)
        .volume;
  });
  std::printf("%-24s %8g  %-22s %9.2f %9.2f\n", name, -depth, "overlap, this library", t.median, t.quantile);
}

Maker hulls(int count) {
  return [count](Random &random, std::vector<std::unique_ptr<Polytope>> &shapes) {
    shapes.push_back(std::make_unique<Polytope>());
    build_convex_hull(random_points(random, count, {0.5, 0.5, 0.5}, false), *shapes.back(), nullptr, nullptr);
    return make_polytope(*shapes.back());
  };
}

}  // namespace

int main(int argc, char **argv) {
  const std::size_t poses = argc > 1 ? static_cast<std::size_t>(std::atol(argv[1])) : 2000;
  const Maker box = [](Random &random, std::vector<std::unique_ptr<Polytope>> &shapes) {
    const Vec3 size{random.uniform(0.5, 1), random.uniform(0.5, 1), random.uniform(0.5, 1)};
    shapes.push_back(std::make_unique<Polytope>(Polytope::box(size)));
    return make_box(size);
  };
  const Maker cylinder = [](Random &random, auto &) {
    return make_cylinder(random.uniform(0.2, 0.5), random.uniform(0.3, 1));
  };
  const Maker ellipsoid = [](Random &random, auto &) {
    return make_ellipsoid({random.uniform(0.2, 0.5), random.uniform(0.2, 0.5), random.uniform(0.2, 0.5)});
  };
  std::printf("%-24s %8s  %-22s %9s %9s   %s\n", "pair", "distance", "method", "median us", "90 % us", "largest error");
  for (double target : {-1e-3, -1e-2, -1e-1, 1e-3, 0.5}) {
    run("boxes", box, target, poses);
    run("hulls of 20 vertices", hulls(20), target, poses);
    run("hulls of 100 vertices", hulls(100), target, poses);
    run("hulls of 1000 vertices", hulls(1000), target, std::min<std::size_t>(poses, 512));
    run("cylinders", cylinder, target, std::min<std::size_t>(poses, 512));
    run("ellipsoids", ellipsoid, target, std::min<std::size_t>(poses, 512));
  }
  for (double depth : {1e-3, 1e-1}) {
    run_overlap("boxes", box, depth, poses);
    run_overlap("hulls of 20 vertices", hulls(20), depth, poses);
    run_overlap("hulls of 100 vertices", hulls(100), depth, poses);
    run_overlap("hulls of 1000 vertices", hulls(1000), depth, std::min<std::size_t>(poses, 512));
  }
  return 0;
}
