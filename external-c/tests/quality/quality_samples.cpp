#include "quality_samples.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "closed_work.hpp"
#include "scene/descriptor.hpp"
#include "support/path_sums.hpp"

namespace cmb::quality {

namespace {

using test::BodyPose;
using test::Contact;
using test::PairScene;
using test::product;
using test::rotation_about;

constexpr double pi = 3.14159265358979323846;
constexpr std::size_t capacity = 512;

// A sample: bodies and, for each path, numbers of its own.
struct Sample {
  Body a, b;
  std::unique_ptr<PairScene> scene;
  double size, thickness;

  // A few bodies a pair are enough: paths differ more than they do.
  Sample(const KindPair &kinds, std::uint64_t seed) {
    Random random(seed);
    a = kinds.a->make(random);
    b = kinds.b->make(random);
    scene = std::make_unique<PairScene>(a.text, b.text);
    size = std::min(a.size, b.size);
    thickness = std::min(a.thickness, b.thickness);
  }
};

std::vector<Sample> bodies_of(const KindPair &kinds, int paths, std::uint64_t seed) {
  std::vector<Sample> samples;
  for (int k = 0; k < std::min(paths, 16); ++k) samples.emplace_back(kinds, seed * 1000003u + static_cast<std::uint64_t>(k));
  return samples;
}

convex::Mat3 any_rotation(Random &random) { return random_bodies::random_rotation(random); }

// One of the 24 orientations in which the axes of two frames agree.
convex::Mat3 quarter_turns(Random &random) {
  convex::Mat3 result;
  for (const convex::Vec3 &axis : {convex::Vec3{1, 0, 0}, convex::Vec3{0, 1, 0}, convex::Vec3{0, 0, 1}}) {
    result = product(rotation_about(axis, 0.5 * pi * random.integer(0, 3)), result);
  }
  return result;
}

// Orientations of which a third rest flat, a third nearly so.
convex::Mat3 start_rotation(Random &random) {
  const int kind = random.integer(0, 2);
  if (kind == 0) return any_rotation(random);
  const convex::Mat3 level = product(rotation_about({0, 0, 1}, random.uniform(0, 2 * pi)), quarter_turns(random));
  return kind == 1 ? level : product(rotation_about(random.direction(), random.log_uniform(1e-9, 0.1)), level);
}

// Where A comes from.
convex::Vec3 approach(const KindPair &kinds, Random &random) {
  if (!kinds.b->ground) return random.integer(0, 1) ? random.direction() : quarter_turns(random) * convex::Vec3{0, 0, 1};
  convex::Vec3 d = random.direction();
  d.z = 1.0 + std::fabs(d.z);
  return normalized(d);
}

// A moved along `direction` from beside B until it is `deep` in it; nothing where that does not settle.
std::optional<BodyPose> touching(const Sample &sample, const convex::Mat3 &rotation, const convex::Vec3 &aside,
                                 const convex::Vec3 &direction, double deep) {
  BodyPose pose{aside + 3.0 * direction, rotation};
  for (int step = 0; step < 80; ++step) {
    const double more = sample.scene->query(pose, {}, capacity).distance + deep;
    if (std::fabs(more) < 1e-3 * deep) return pose;
    if (norm(pose.position) > 10.0) break;  // passed by
    pose.position = pose.position - more * direction;
  }
  return std::nullopt;
}

// A sum of two harmonics with period 1, about 1 at most.
class Swing {
 public:
  explicit Swing(Random &random) {
    for (double &part : parts_) part = random.uniform(-0.5, 0.5);
  }
  double value(double s) const {
    const double t = 2 * pi * s;
    return parts_[0] * std::cos(t) + parts_[1] * std::sin(t) + 0.5 * (parts_[2] * std::cos(2 * t) + parts_[3] * std::sin(2 * t));
  }
  double rate(double s) const {
    const double t = 2 * pi * s;
    return 2 * pi *
           (parts_[1] * std::cos(t) - parts_[0] * std::sin(t) + parts_[3] * std::cos(2 * t) - parts_[2] * std::sin(2 * t));
  }

 private:
  std::array<double, 4> parts_;
};

// A closed path with its velocities.
class Loop {
 public:
  Loop(const BodyPose &start, double move, double turn, Random &random)
      : start_(start), move_(move), turn_(turn), place_{Swing(random), Swing(random), Swing(random)},
        angle_{Swing(random), Swing(random), Swing(random)} {}

  BodyPose pose(double s) const {
    convex::Mat3 rotation = start_.rotation;
    for (std::size_t k = 3; k-- > 0;) rotation = product(turned(k, s), rotation);
    return {start_.position + move_ * at(s, &Swing::value), rotation};
  }
  convex::Vec3 velocity(double s) const { return move_ * at(s, &Swing::rate); }
  convex::Vec3 angular_velocity(double s) const {
    convex::Vec3 sum;
    for (std::size_t k = 3; k-- > 0;) {
      convex::Vec3 axis;
      axis.set(static_cast<int>(k), turn_ * angle_[k].rate(s));
      sum = axis + turned(k, s) * sum;
    }
    return sum;
  }

 private:
  convex::Vec3 at(double s, double (Swing::*of)(double) const) const {
    return {(place_[0].*of)(s), (place_[1].*of)(s), (place_[2].*of)(s)};
  }
  convex::Mat3 turned(std::size_t k, double s) const {
    convex::Vec3 axis;
    axis.set(static_cast<int>(k), 1.0);
    return rotation_about(axis, turn_ * angle_[k].value(s));
  }

  BodyPose start_;
  double move_, turn_;
  std::array<Swing, 3> place_, angle_;
};

// A beside B, turning over and over; at knots of the path as deep as asked or less, between them it moves straight.
std::optional<test::PosePath> wandering(const KindPair &kinds, const Sample &sample, double deep, Random &random) {
  constexpr int knots = 12;
  const convex::Mat3 start = start_rotation(random);
  const convex::Vec3 first = random.direction(), second = random.direction(), from = approach(kinds, random),
                     aside = random.direction();
  const double fast = random.log_uniform(1e-3, 4), slow = random.uniform(6, 24), drift = random.uniform(3, 15);
  const double wide = kinds.b->ground ? random.uniform(0.2, 0.9) : 0.0;
  const auto rotation = [=](double s) {
    return product(product(rotation_about(first, fast * s), rotation_about(second, 0.1 * fast * std::sin(slow * s))), start);
  };
  std::vector<convex::Vec3> places;
  for (int k = 0; k <= knots; ++k) {
    const double s = static_cast<double>(k) / knots, swing = std::sin(drift * s);
    const convex::Vec3 direction =
        kinds.b->ground ? convex::Vec3{0, 0, 1} : normalized(from + (0.4 * std::fmin(1.0, fast) * swing) * aside);
    const convex::Vec3 beside{wide * swing, wide * std::sin(0.7 * drift * s + 1.0), 0.0};
    const auto pose = touching(sample, rotation(s), beside, direction, deep * sample.thickness * (0.55 + 0.45 * std::sin(17.0 * s)));
    if (!pose) return std::nullopt;
    places.push_back(pose->position);
  }
  return [=](double s) {
    const double place = s * knots;
    const auto k = std::min<std::size_t>(knots - 1, static_cast<std::size_t>(place));
    const double part = place - static_cast<double>(k);
    return BodyPose{(1.0 - part) * places[k] + part * places[k + 1], rotation(s)};
  };
}

std::uint64_t path_seed(std::uint64_t seed, int path) { return (seed << 20) + static_cast<std::uint64_t>(path) + 1; }

convex::Vec3 beside_ground(const KindPair &kinds, Random &random) {
  return kinds.b->ground ? convex::Vec3{random.uniform(-0.7, 0.7), random.uniform(-0.7, 0.7), 0.0} : convex::Vec3{};
}

}  // namespace

LoopWork sample_loops(const KindPair &kinds, double deep, double turn, int paths, int steps, std::uint64_t seed,
                      const ForceFactor &factor) {
  const std::vector<Sample> bodies = bodies_of(kinds, paths, seed);
  LoopWork result;
  double sum = 0.0;
  for (int k = 0; k < paths; ++k) {
    const Sample &sample = bodies[static_cast<std::size_t>(k) % bodies.size()];
    Random random(path_seed(seed, k));
    const auto start = touching(sample, start_rotation(random), beside_ground(kinds, random), approach(kinds, random),
                                deep * sample.size);
    if (!start) continue;
    const Loop loop(*start, deep * sample.size, turn, random);
    const ClosedWork found = closed_work(
        [&](double s) {
          const BodyPose pose = loop.pose(s);
          const Contact contact = sample.scene->query(pose, {}, capacity);
          const double power = dot(contact.load(), loop.velocity(s)) + dot(contact.moment(pose.position), loop.angular_velocity(s));
          return PathPlace{factor ? factor(pose) * power : power, contact.energy()};
        },
        steps);
    if (!(found.largest_energy > 0.0)) continue;
    const double part = std::fabs(found.work) / found.largest_energy;
    sum += part;
    ++result.paths;
    if (part > result.worst) result.worst = part, result.worst_seed = path_seed(seed, k);
  }
  result.mean = result.paths > 0 ? sum / result.paths : 0.0;
  return result;
}

Jumps sample_jumps(const KindPair &kinds, double deep, int paths, int steps, std::uint64_t seed) {
  constexpr double least_jump = 1e-4, deepest = 0.25;
  const std::vector<Sample> bodies = bodies_of(kinds, paths, seed);
  Jumps result;
  for (int k = 0; k < paths; ++k) {
    const Sample &sample = bodies[static_cast<std::size_t>(k) % bodies.size()];
    Random random(path_seed(seed, k));
    const auto path = wandering(kinds, sample, deep, random);
    if (!path) continue;
    const test::PathSums sums = test::follow(*sample.scene, *path, {}, steps, 12, capacity, deepest * sample.thickness);
    if (!(sums.largest_load > 0.0)) continue;
    ++result.paths;
    const double jump = sums.largest_jump / sums.largest_load;
    if (jump > least_jump) ++result.jumping;
    if (jump > result.worst) result.worst = jump, result.worst_seed = path_seed(seed, k), result.worst_place = sums.jump_at;
  }
  return result;
}

FrameError sample_frames(const KindPair &kinds, int poses, std::uint64_t seed) {
  const std::vector<Sample> bodies = bodies_of(kinds, poses, seed);
  FrameError result;
  for (int k = 0; k < poses; ++k) {
    const Sample &sample = bodies[static_cast<std::size_t>(k) % bodies.size()];
    Random random(path_seed(seed, k));
    const double deep = random.log_uniform(1e-4, 0.05) * sample.thickness;
    const auto pose = touching(sample, any_rotation(random), beside_ground(kinds, random), approach(kinds, random), deep);
    if (!pose) continue;
    const BodyPose frame{{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)}, any_rotation(random)};
    const Contact here = sample.scene->query(*pose, {}, capacity);
    const BodyPose moved{frame.rotation * pose->position + frame.position, product(frame.rotation, pose->rotation)};
    const Contact there = sample.scene->query(moved, frame, capacity);
    const double load = norm(here.load());
    ++result.poses;
    const double force = norm(frame.rotation * here.load() - there.load());
    const double moment = norm(frame.rotation * here.moment(pose->position) - there.moment(moved.position)) / sample.size;
    const double error = (force + moment) / std::fmax(load, 1e-3 * deep);
    if (error > result.worst) result.worst = error, result.worst_seed = path_seed(seed, k);
    double rounding = 0.0;
    for (const test::Vec3 &way : {test::Vec3{1, 0, 0}, test::Vec3{0, 1, 0}, test::Vec3{0, 0, 1}}) {
      const BodyPose beside{pose->position + 1e-15 * way, pose->rotation};
      const Contact there_too = sample.scene->query(beside, {}, capacity);
      rounding = std::fmax(rounding, norm(there_too.load() - here.load()) +
                                         norm(there_too.moment(pose->position) - here.moment(pose->position)) / sample.size);
    }
    const double known = rounding / std::fmax(load, 1e-3 * deep);
    result.worst_by_rounding = std::fmax(result.worst_by_rounding, error / std::fmax(1e-9, known));
  }
  return result;
}

namespace {

struct Ball {
  convex::Vec3 center;
  double radius = 0.0;
};

// About all shapes of a body, in its frame; no radius where the body has no bounds.
Ball ball_about(const std::string &text) {
  Ball ball;
  const BodyShapes shapes = parse_descriptor(text);
  for (const Shape &shape : shapes) {
    ball.center = ball.center + (1.0 / static_cast<double>(shapes.size())) * shape.in_body(shape.bound_center);
  }
  for (const Shape &shape : shapes) {
    ball.radius = std::fmax(ball.radius, norm(shape.in_body(shape.bound_center) - ball.center) + shape.bound_radius);
  }
  return ball;
}

}  // namespace

FarPoints sample_far_points(const KindPair &kinds, int poses, std::uint64_t seed) {
  const std::vector<Sample> bodies = bodies_of(kinds, poses, seed);
  std::vector<std::pair<Ball, Ball>> balls;
  for (const Sample &sample : bodies) balls.emplace_back(ball_about(sample.a.text), ball_about(sample.b.text));
  FarPoints result;
  for (int k = 0; k < poses; ++k) {
    const Sample &sample = bodies[static_cast<std::size_t>(k) % bodies.size()];
    Random random(path_seed(seed, k));
    const double deep = random.log_uniform(1e-7, 0.3) * sample.thickness;
    const auto pose = touching(sample, start_rotation(random), beside_ground(kinds, random), approach(kinds, random), deep);
    if (!pose) continue;
    ++result.poses;
    const auto &[a, b] = balls[static_cast<std::size_t>(k) % bodies.size()];
    const bool of_a = kinds.b->ground || a.radius <= b.radius;
    const convex::Vec3 center = of_a ? pose->position + pose->rotation * a.center : b.center;
    const Contact contact = sample.scene->query(*pose, {}, capacity);
    double load = 0.0;
    for (const test::Point &point : contact.points) load += point.weight * point.depth;
    for (const test::Point &point : contact.points) {
      const double far = norm(point.position - center) / (of_a ? a.radius : b.radius);
      ++result.points;
      for (std::size_t i = 0; i < 3; ++i) result.beyond[i] += far > FarPoints::limits[i] ? 1 : 0;
      if (!(far > result.farthest)) continue;
      result.farthest = far, result.load_there = point.weight * point.depth / load, result.worst_seed = path_seed(seed, k);
    }
  }
  return result;
}

}  // namespace cmb::quality
