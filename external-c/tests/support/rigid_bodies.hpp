// Rigid bodies under gravity and compiled contact forces, and an integrator with step control.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "contact_multibody_scene.h"
#include "engine_calls.hpp"
#include "poses.hpp"

namespace cmb::test {

inline void require_ok(cmb_status status) {
  if (status != CMB_OK) throw std::runtime_error(cmb_last_error());
}

// States of all bodies; rotation maps body to world.
struct Motion {
  std::vector<double> position, rotation, velocity, angular_velocity;  // rotation: as the engine takes it

  explicit Motion(std::size_t count)
      : position(3 * count), rotation(9 * count), velocity(3 * count), angular_velocity(3 * count) {
    for (std::size_t i = 0; i < count; ++i) set_rotation(i, Mat3{});
  }
  void set_rotation(std::size_t body, const Mat3 &r) {
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) rotation[9 * body + static_cast<std::size_t>(3 * i + j)] = r.row[j][i];
    }
  }
  static Vec3 row(const std::vector<double> &array, std::size_t body) {
    return {array[3 * body], array[3 * body + 1], array[3 * body + 2]};
  }
  static void set_row(std::vector<double> &array, std::size_t body, const Vec3 &value) {
    for (int axis = 0; axis < 3; ++axis) array[3 * body + static_cast<std::size_t>(axis)] = value[axis];
  }
  // Axes of the body in the world.
  Mat3 axes(std::size_t body) const {
    const double *r = rotation.data() + 9 * body;
    return {{{r[0], r[3], r[6]}, {r[1], r[4], r[7]}, {r[2], r[5], r[8]}}};
  }
  cmb_motion view() const { return {{position.size() / 3, position.data(), rotation.data()}, velocity.data(), angular_velocity.data()}; }
};

// A scene with the properties of its bodies, whose frames lie at their centres of mass.
struct Bodies {
  std::vector<std::string> geometry;
  std::vector<int> fixed;
  std::vector<double> mass, center_of_mass, inertia, stiffness, restitution, mu_static, mu_dynamic;
  cmb_contact_law law{};
  cmb_broadphase broadphase{};

  Bodies() { cmb_contact_law_init(&law); }

  std::size_t count() const { return geometry.size(); }
  // moments: principal moments of inertia.
  void add(const std::string &shape, double m, const Vec3 &moments, double k, double e = 0.5, double mu = 0.3) {
    geometry.push_back(shape);
    fixed.push_back(m > 0.0 ? 0 : 1);
    mass.push_back(m);
    center_of_mass.insert(center_of_mass.end(), {0.0, 0.0, 0.0});
    inertia.insert(inertia.end(), {moments.x, 0, 0, 0, moments.y, 0, 0, 0, moments.z});
    stiffness.push_back(k);
    restitution.push_back(e);
    mu_static.push_back(1.5 * mu);
    mu_dynamic.push_back(mu);
  }
  void add_sphere(double radius, double m, double k, double e = 0.5, double mu = 0.3) {
    const double moment = 0.4 * m * radius * radius;
    add("cmb/1 sphere radius=" + digits(radius), m, {moment, moment, moment}, k, e, mu);
  }
  // Stiffness against which every other counts alone.
  void add_fixed(const std::string &shape, double e = 0.5, double mu = 0.3) {
    add(shape, 0.0, {}, HUGE_VAL, e, mu);
  }
  void intern(const std::vector<int> &excluded = {}) {
    std::vector<const char *> texts;
    for (const std::string &text : geometry) texts.push_back(text.c_str());
    cmb_scene scene{};
    require_ok(intern_scene(texts.data(), texts.size(), nullptr, 0, CMB_BACKEND_AUTO, &scene));
    const cmb_collision_filter filter{count(), fixed.data(), nullptr, nullptr, excluded.data(), excluded.size() / 2};
    require_ok(cmb_intern_broadphase(scene, &filter, &broadphase));
  }
  cmb_body_properties properties() const {
    return {mass.data(),      center_of_mass.data(), inertia.data(),   stiffness.data(), nullptr,
            nullptr,          restitution.data(),    mu_static.data(), mu_dynamic.data()};
  }
};

// Wrenches on all bodies.
struct Wrenches {
  std::vector<double> force, torque;
  cmb_response_sums sums{};

  Wrenches(const Bodies &bodies, const Motion &motion) : force(3 * bodies.count()), torque(3 * bodies.count()) {
    evaluate(bodies, motion);
  }
  void evaluate(const Bodies &bodies, const Motion &motion) {
    const cmb_body_properties properties = bodies.properties();
    const cmb_motion view = motion.view();
    require_ok(cmb_evaluate_response(bodies.broadphase, &bodies.law, &properties, &view, force.data(),
                                     torque.data(), &sums));
  }
};

// Integrates free bodies by Bogacki and Shampine's pair of orders 3 and 2 (1989), with step control.
class Simulation {
 public:
  Simulation(const Bodies &bodies, Motion start, const Vec3 &gravity)
      : bodies_(bodies), gravity_(gravity), motion_(std::move(start)), wrenches_(bodies, motion_) {
    state_.resize(13 * bodies.count());
    for (std::size_t i = 0; i < bodies.count(); ++i) pack(i);
    for (auto &slope : slope_) slope.resize(state_.size());
    trial_.resize(state_.size());
    derivative(state_, slope_[0]);
  }

  const Motion &motion() const { return motion_; }
  const Wrenches &wrenches() const { return wrenches_; }
  double time() const { return time_; }
  std::size_t evaluations() const { return evaluations_; }

  // Goes on until `stop`; `tolerance` is that of a step, in m, rad, m/s and rad/s alike.
  void run(double stop, double tolerance, const std::function<void()> &after_step = {}) {
    while (time_ < stop) {
      const double h = std::min(step_, stop - time_);
      combine(h, {0.5});
      derivative(trial_, slope_[1]);
      combine(h, {0.0, 0.75});
      derivative(trial_, slope_[2]);
      combine(h, {2.0 / 9, 1.0 / 3, 4.0 / 9});
      derivative(trial_, slope_[3]);
      double error = 0.0;
      for (std::size_t i = 0; i < state_.size(); ++i) {
        const double e = h * (-5.0 / 72 * slope_[0][i] + 1.0 / 12 * slope_[1][i] + 1.0 / 9 * slope_[2][i] -
                              1.0 / 8 * slope_[3][i]);
        error = std::fmax(error, std::fabs(e));
      }
      if (error <= tolerance) {
        time_ += h;
        state_.swap(trial_);
        slope_[0].swap(slope_[3]);
        if (after_step) after_step();
      }
      step_ = h * std::clamp(0.9 * std::cbrt(tolerance / std::fmax(error, 1e-30)), 0.2, 3.0);
    }
    unpack(state_);
    wrenches_.evaluate(bodies_, motion_);
  }

  // Kinetic energy, of one body or of all.
  double kinetic_energy(std::size_t i) const {
    const Vec3 v = Motion::row(motion_.velocity, i);
    const Vec3 w = transposed_times(motion_.axes(i), Motion::row(motion_.angular_velocity, i));
    const double *moments = bodies_.inertia.data() + 9 * i;
    return 0.5 * (bodies_.mass[i] * norm2(v) + moments[0] * w.x * w.x + moments[4] * w.y * w.y + moments[8] * w.z * w.z);
  }
  double kinetic_energy() const {
    double sum = 0.0;
    for (std::size_t i = 0; i < bodies_.count(); ++i) sum += bodies_.fixed[i] ? 0.0 : kinetic_energy(i);
    return sum;
  }
  // Kinetic, potential and elastic energy.
  double energy() const {
    double sum = kinetic_energy() + wrenches_.sums.elastic_energy;
    for (std::size_t i = 0; i < bodies_.count(); ++i) {
      if (!bodies_.fixed[i]) sum -= bodies_.mass[i] * dot(gravity_, Motion::row(motion_.position, i));
    }
    return sum;
  }

 private:
  // Of a body: position, quaternion (body to world), velocity, angular velocity (world axes).
  void pack(std::size_t i) {
    const Mat3 r = motion_.axes(i);
    double *s = state_.data() + 13 * i;
    for (int axis = 0; axis < 3; ++axis) {
      s[axis] = Motion::row(motion_.position, i)[axis];
      s[7 + axis] = Motion::row(motion_.velocity, i)[axis];
      s[10 + axis] = Motion::row(motion_.angular_velocity, i)[axis];
    }
    s[3] = 0.5 * std::sqrt(std::fmax(1e-12, 1 + r.row[0].x + r.row[1].y + r.row[2].z));
    s[4] = (r.row[2].y - r.row[1].z) / (4 * s[3]);
    s[5] = (r.row[0].z - r.row[2].x) / (4 * s[3]);
    s[6] = (r.row[1].x - r.row[0].y) / (4 * s[3]);
  }
  void unpack(const std::vector<double> &state) {
    for (std::size_t i = 0; i < bodies_.count(); ++i) {
      const double *s = state.data() + 13 * i;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        motion_.position[3 * i + axis] = s[axis];
        motion_.velocity[3 * i + axis] = s[7 + axis];
        motion_.angular_velocity[3 * i + axis] = s[10 + axis];
      }
      const double n = 1.0 / std::sqrt(s[3] * s[3] + s[4] * s[4] + s[5] * s[5] + s[6] * s[6]);
      const double w = n * s[3], x = n * s[4], y = n * s[5], z = n * s[6];
      motion_.set_rotation(i, {{{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
                                {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
                                {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}}});
    }
  }
  void derivative(const std::vector<double> &state, std::vector<double> &slope) {
    ++evaluations_;
    unpack(state);
    wrenches_.evaluate(bodies_, motion_);
    for (std::size_t i = 0; i < bodies_.count(); ++i) {
      const double *s = state.data() + 13 * i;
      double *d = slope.data() + 13 * i;
      if (bodies_.fixed[i]) {
        std::fill(d, d + 13, 0.0);
        continue;
      }
      const Vec3 w{s[10], s[11], s[12]};
      const Mat3 axes = motion_.axes(i);
      const double *moments = bodies_.inertia.data() + 9 * i;
      const Vec3 turning = transposed_times(axes, w);
      const Vec3 torque = transposed_times(axes, Motion::row(wrenches_.torque, i));
      const Vec3 momentum{moments[0] * turning.x, moments[4] * turning.y, moments[8] * turning.z};
      const Vec3 rest = torque - cross(turning, momentum);
      // In the body the derivative of w is that in the world.
      const Vec3 acceleration = axes * Vec3{rest.x / moments[0], rest.y / moments[4], rest.z / moments[8]};
      const Vec3 a = (1.0 / bodies_.mass[i]) * Motion::row(wrenches_.force, i) + gravity_;
      for (int axis = 0; axis < 3; ++axis) {
        d[axis] = s[7 + axis];
        d[7 + axis] = a[axis];
        d[10 + axis] = acceleration[axis];
      }
      const Vec3 q{s[4], s[5], s[6]};
      const Vec3 dq = 0.5 * (s[3] * w + cross(w, q));
      d[3] = -0.5 * dot(w, q);
      for (int axis = 0; axis < 3; ++axis) d[4 + axis] = dq[axis];
    }
  }
  void combine(double h, std::initializer_list<double> weights) {
    trial_ = state_;
    std::size_t k = 0;
    for (const double weight : weights) {
      if (weight != 0.0) {
        for (std::size_t i = 0; i < state_.size(); ++i) trial_[i] += h * weight * slope_[k][i];
      }
      ++k;
    }
  }

  const Bodies &bodies_;
  Vec3 gravity_;
  Motion motion_;
  Wrenches wrenches_;
  std::vector<double> state_, trial_;
  std::vector<double> slope_[4];
  double time_ = 0.0, step_ = 1e-4;
  std::size_t evaluations_ = 0;
};

}  // namespace cmb::test
