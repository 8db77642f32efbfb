// Jumps of the force-carrying sums along paths in pose space.
//
// Each path is sampled; the intervals over which the sums change most are halved again and again towards the larger
// change. Over a jump the change stays; for continuous sums it goes to zero.
#pragma once

#include <algorithm>
#include <functional>

#include "random_bodies.hpp"
#include "scene_query.hpp"

namespace cmb::test {

using PosePath = std::function<BodyPose(double)>;  // over 0 to 1

struct PathSums {
  double largest_jump = 0.0;  // of load and moment, m
  double jump_at = 0.0;       // where along the path
  double largest_load = 0.0;  // m
};

// Stretches deeper than `deepest` (m) are left out.
inline PathSums follow(const PairScene &scene, const PosePath &pose_a, const BodyPose &pose_b, int samples,
                       std::size_t suspects, std::size_t capacity = 64, double deepest = HUGE_VAL) {
  struct Sums {
    Vec3 load, moment;
    double depth;
  };
  PathSums result;
  const auto sums = [&](double s) {
    const Contact contact = scene.query(pose_a(s), pose_b, capacity);
    const Sums found{contact.load(), contact.moment({}), -contact.distance};
    result.largest_load = std::fmax(result.largest_load, norm(found.load));
    return found;
  };
  const auto change = [](const Sums &x, const Sums &y) { return norm(x.load - y.load) + norm(x.moment - y.moment); };
  struct Interval {
    double change, begin;
  };
  std::vector<Interval> intervals;
  Sums last = sums(0.0);
  for (int i = 1; i <= samples; ++i) {
    const Sums next = sums(static_cast<double>(i) / samples);
    if (last.depth <= deepest && next.depth <= deepest) {
      intervals.push_back({change(last, next), static_cast<double>(i - 1) / samples});
    }
    last = next;
  }
  std::sort(intervals.begin(), intervals.end(), [](const auto &x, const auto &y) { return x.change > y.change; });
  for (std::size_t k = 0; k < std::min(suspects, intervals.size()); ++k) {
    double begin = intervals[k].begin, end = begin + 1.0 / samples, jump = 0.0;
    for (int halving = 0; halving < 32; ++halving) {
      const double middle = 0.5 * (begin + end);
      const Sums at_middle = sums(middle);
      const double first = change(sums(begin), at_middle), second = change(at_middle, sums(end));
      jump = std::fmax(first, second);
      (first > second ? end : begin) = middle;
    }
    if (jump > result.largest_jump) result.largest_jump = jump, result.jump_at = begin;
  }
  return result;
}

// A turns over and over beside B, which stays; at some knots of the path it is up to `deep` (m) in B, between them it
// moves straight, which may be deeper.
inline PosePath random_path(const PairScene &scene, random_bodies::Random &random, double deep) {
  constexpr int knots = 12;
  const Vec3 first = random.direction(), second = random.direction(), from = random.direction(), aside = random.direction();
  const double fast = random.uniform(1, 4), slow = random.uniform(6, 24), drift = random.uniform(3, 15);
  const auto rotation = [=](double s) {
    return product(rotation_about(first, fast * s), rotation_about(second, 0.5 * std::sin(slow * s)));
  };
  std::vector<Vec3> places;
  for (int k = 0; k <= knots; ++k) {
    const double s = static_cast<double>(k) / knots;
    const Vec3 direction = normalized(from + (0.6 * std::sin(drift * s)) * aside);
    BodyPose pose{1.5 * direction, rotation(s)};
    for (int step = 0; step < 12; ++step) {
      const double gap = scene.query(pose, {}, 4).distance + deep * (0.55 + 0.45 * std::sin(17.0 * s));
      pose.position = pose.position - gap * direction;
    }
    places.push_back(pose.position);
  }
  return [=](double s) {
    const double place = s * knots;
    const auto k = std::min<std::size_t>(knots - 1, static_cast<std::size_t>(place));
    const double part = place - static_cast<double>(k);
    return BodyPose{(1.0 - part) * places[k] + part * places[k + 1], rotation(s)};
  };
}

inline std::string random_box(random_bodies::Random &random) {
  std::string text = "cmb/1 box size=";
  for (int k = 0; k < 3; ++k) text += digits(random.uniform(0.3, 1.0)) + (k < 2 ? "," : "");
  return text;
}

inline std::string random_hull(random_bodies::Random &random) {
  std::string text = "cmb/1 hull vertices=";
  const int count = random.integer(4, 14);
  for (int k = 0; k < count; ++k) {
    const Vec3 p = random.direction();
    text += digits(0.5 * p.x) + "," + digits(0.4 * p.y) + "," + digits(0.3 * p.z) + (k + 1 < count ? "," : "");
  }
  return text;
}

// Of a kind by name: sphere, capsule, cylinder, cone, ellipsoid, box or hull.
inline std::string random_shape(const std::string &kind, random_bodies::Random &random) {
  const auto length = [&](double low, double high) { return digits(random.uniform(low, high)); };
  if (kind == "sphere") return "cmb/1 sphere radius=" + length(0.25, 0.5);
  if (kind == "capsule") return "cmb/1 capsule radius=" + length(0.1, 0.3) + " length=" + length(0.2, 0.8);
  if (kind == "cylinder") return "cmb/1 cylinder radius=" + length(0.2, 0.5) + " length=" + length(0.3, 1.0);
  if (kind == "cone") return "cmb/1 cone radius=" + length(0.25, 0.5) + " length=" + length(0.4, 1.0);
  if (kind == "ellipsoid") return "cmb/1 ellipsoid size=" + length(0.4, 1) + "," + length(0.4, 1) + "," + length(0.4, 1);
  return kind == "box" ? random_box(random) : random_hull(random);
}

// Corners on an ellipsoid.
inline std::string fine_hull(random_bodies::Random &random, int corners) {
  std::string text = "cmb/1 hull vertices=";
  for (int k = 0; k < corners; ++k) {
    const Vec3 p = random.direction();
    text += digits(0.5 * p.x) + "," + digits(0.45 * p.y) + "," + digits(0.4 * p.z) + (k + 1 < corners ? "," : "");
  }
  return text;
}

}  // namespace cmb::test
