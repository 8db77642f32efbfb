// The compiled response: laws against closed forms, mechanics' invariants, and restitution delivered by integration.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <random>
#include <thread>
#include <vector>

#include "response/point_forces.hpp"
#include "response/speed_ratio.hpp"
#include "support/engine_calls.hpp"
#include "response/spring_deceleration.hpp"
#include "support/rigid_bodies.hpp"

namespace test_response {
namespace {

using namespace cmb::test;

constexpr double pi = 3.14159265358979323846;
constexpr cmb_normal_law all_laws[] = {
    CMB_LAW_EXACT,   CMB_LAW_JUHASZ,   CMB_LAW_HUNT_CROSSLEY, CMB_LAW_HERBERT_MCWHANNELL, CMB_LAW_LEE_WANG,
    CMB_LAW_LANKARANI_NIKRAVESH, CMB_LAW_GONTHIER, CMB_LAW_FLORES, CMB_LAW_HU_GUO, CMB_LAW_SPRING_DAMPER};

double uniform(std::mt19937 &random, double low, double high) { return low + (high - low) * (random() / 4294967296.0); }

Vec3 random_vector(std::mt19937 &random, double size) {
  return {uniform(random, -size, size), uniform(random, -size, size), uniform(random, -size, size)};
}

Mat3 random_rotation(std::mt19937 &random) {
  return rotation_about(normalized(random_vector(random, 1.0)), uniform(random, 0.0, 6.0));
}

// Bodies of many kinds that overlap a little in places, on a floor.
Bodies random_bodies(std::mt19937 &random, std::size_t count) {
  Bodies bodies;
  const char *const shapes[] = {"cmb/1 sphere radius=0.3", "cmb/1 box size=0.4,0.5,0.6",
                                "cmb/1 capsule radius=0.2 length=0.4", "cmb/1 cylinder radius=0.25 length=0.5",
                                "cmb/1 sphere radius=0.2 position=0.2,0,0;cmb/1 box size=0.4,0.2,0.3"};
  for (std::size_t i = 0; i < count; ++i) {
    bodies.add(shapes[random() % 5], uniform(random, 0.1, 10),
               {uniform(random, 0.2, 0.3), uniform(random, 0.2, 0.3), uniform(random, 0.2, 0.3)},
               uniform(random, 1e3, 1e5), uniform(random, 0, 1), uniform(random, 0, 1));
    // A full tensor, and a centre of mass beside the origin.
    double *tensor = bodies.inertia.data() + 9 * i;
    tensor[1] = tensor[3] = uniform(random, -0.03, 0.03);
    tensor[2] = tensor[6] = uniform(random, -0.03, 0.03);
    tensor[5] = tensor[7] = uniform(random, -0.03, 0.03);
    Motion::set_row(bodies.center_of_mass, i, random_vector(random, 0.1));
  }
  bodies.add_fixed("cmb/1 halfspace");
  bodies.intern();
  return bodies;
}

Motion random_motion(std::mt19937 &random, const Bodies &bodies) {
  Motion motion(bodies.count());
  for (std::size_t i = 0; i + 1 < bodies.count(); ++i) {
    Motion::set_row(motion.position, i, random_vector(random, 0.7) + Vec3{0, 0, 0.6});
    Motion::set_row(motion.velocity, i, random_vector(random, 1.0));
    Motion::set_row(motion.angular_velocity, i, random_vector(random, 2.0));
    motion.set_rotation(i, random_rotation(random));
  }
  return motion;
}

cmb_contact_law random_law(std::mt19937 &random) {
  cmb_contact_law law;
  cmb_contact_law_init(&law);
  law.normal_law = all_laws[random() % 10];
  law.use_restitution = random() % 3 != 0;
  law.exponent = random() % 2 == 0 ? 1.0 : 1.5;
  law.restitution_rule = static_cast<cmb_combination_rule>(1 + random() % 6);
  law.friction_rule = static_cast<cmb_combination_rule>(1 + random() % 6);
  law.use_friction = random() % 4 != 0;
  law.stribeck_speed = random() % 2 == 0 ? 0.0 : 0.1;
  law.spin_radius = random() % 2 == 0 ? 0.0 : 0.02;
  law.rolling_lever = random() % 2 == 0 ? 0.0 : 0.01;
  return law;
}

double largest(const std::vector<double> &values) {
  double result = 0.0;
  for (const double value : values) result = std::fmax(result, std::fabs(value));
  return result;
}

TEST(Response, KeepsMomentumAndAngularMomentum) {
  std::mt19937 random(1);
  for (int repetition = 0; repetition < 60; ++repetition) {
    Bodies bodies = random_bodies(random, 15);
    bodies.law = random_law(random);
    const Motion motion = random_motion(random, bodies);
    const Wrenches wrenches(bodies, motion);
    ASSERT_GT(wrenches.sums.contact_count, 3u);
    Vec3 force, torque;
    for (std::size_t i = 0; i < bodies.count(); ++i) {
      const Vec3 f = Motion::row(wrenches.force, i);
      force = force + f;
      torque = torque + Motion::row(wrenches.torque, i) + cross(Motion::row(motion.position, i), f);
    }
    EXPECT_LT(norm(force), 1e-12 * largest(wrenches.force));
    EXPECT_LT(norm(torque), 1e-12 * (largest(wrenches.force) + largest(wrenches.torque)));
  }
}

TEST(Response, DoesNotDependOnTheWorldFrame) {
  std::mt19937 random(2);
  for (int repetition = 0; repetition < 40; ++repetition) {
    Bodies bodies = random_bodies(random, 12);
    bodies.law = random_law(random);
    const Motion motion = random_motion(random, bodies);
    const Mat3 turn = random_rotation(random);
    const Vec3 shift = random_vector(random, 3.0), drift = random_vector(random, 5.0);
    Motion moved = motion;
    for (std::size_t i = 0; i < bodies.count(); ++i) {
      Motion::set_row(moved.position, i, turn * Motion::row(motion.position, i) + shift);
      Motion::set_row(moved.velocity, i, turn * Motion::row(motion.velocity, i) + drift);
      Motion::set_row(moved.angular_velocity, i, turn * Motion::row(motion.angular_velocity, i));
      moved.set_rotation(i, product(turn, motion.axes(i)));
    }
    const Wrenches wrenches(bodies, motion), other(bodies, moved);
    EXPECT_EQ(wrenches.sums.contact_count, other.sums.contact_count);
    EXPECT_NEAR(wrenches.sums.elastic_energy, other.sums.elastic_energy, 1e-9 * wrenches.sums.elastic_energy);
    const double scale = largest(wrenches.force);
    for (std::size_t i = 0; i < bodies.count(); ++i) {
      EXPECT_LT(norm(turn * Motion::row(wrenches.force, i) - Motion::row(other.force, i)), 1e-8 * scale);
      EXPECT_LT(norm(turn * Motion::row(wrenches.torque, i) - Motion::row(other.torque, i)), 1e-8 * scale);
    }
  }
}

TEST(Response, RemembersNothing) {
  std::mt19937 random(3);
  Bodies bodies = random_bodies(random, 20), others = random_bodies(random, 30);
  const Motion motion = random_motion(random, bodies);
  const Wrenches expected(bodies, motion);
  std::vector<std::thread> threads;
  std::atomic<int> wrong{0};
  for (unsigned thread = 0; thread < 4; ++thread) {
    threads.emplace_back([&, thread] {
      std::mt19937 own(thread);
      Bodies different = others;
      for (int repetition = 0; repetition < 20; ++repetition) {
        different.law = random_law(own);
        const Wrenches between(different, random_motion(own, different));
        const Wrenches again(bodies, motion);
        if (again.force != expected.force || again.torque != expected.torque) ++wrong;
      }
    });
  }
  for (std::thread &thread : threads) thread.join();
  EXPECT_EQ(wrong, 0);
}

// The same bodies where they were, with one number of one of them changed, or of the law: as a thread answers that has never
// been asked before.
TEST(Response, SeesEveryNumberThatChanges) {
  std::mt19937 random(5);
  for (const bool alike : {true, false}) {  // one material, or more than are kept
    Bodies bodies = random_bodies(random, 40);
    if (alike) {
      for (std::size_t i = 0; i + 1 < bodies.count(); ++i) {
        bodies.stiffness[i] = bodies.stiffness[0];
        bodies.restitution[i] = bodies.restitution[0];
        bodies.mu_static[i] = bodies.mu_static[0];
        bodies.mu_dynamic[i] = bodies.mu_dynamic[0];
      }
    }
    const Motion motion = random_motion(random, bodies);
    std::vector<double> *const changed[] = {&bodies.mass,        &bodies.center_of_mass, &bodies.inertia,   &bodies.stiffness,
                                            &bodies.restitution, &bodies.mu_static,      &bodies.mu_dynamic};
    for (int repetition = 0; repetition < 60; ++repetition) {
      if (repetition % 3 == 0) bodies.law = random_law(random);
      std::vector<double> &column = *changed[random() % 7];
      const std::size_t each = column.size() / bodies.count(), body = random() % (bodies.count() - 1);
      column[each * body] *= uniform(random, 0.9, 0.99);
      const Wrenches asked(bodies, motion);
      std::thread([&] {
        const Wrenches fresh(bodies, motion);
        EXPECT_EQ(asked.force, fresh.force) << repetition;
        EXPECT_EQ(asked.torque, fresh.torque) << repetition;
      }).join();
    }
  }
}

// One sphere, moved by hand, on the half-space z <= 0.
struct BallOnFloor {
  static constexpr double radius = 0.1, mass = 2.0, depth = 0.001;
  Bodies bodies;
  Motion motion{2};

  explicit BallOnFloor(double stiffness = 1e5, double restitution = 0.5, double mu = 0.4) {
    bodies.add_sphere(radius, mass, stiffness, restitution, mu);
    bodies.add_fixed("cmb/1 halfspace", restitution, mu);
    bodies.intern();
    Motion::set_row(motion.position, 0, {0, 0, radius - depth});
  }
  Vec3 force() { return Motion::row(Wrenches(bodies, motion).force, 0); }
  Vec3 torque() { return Motion::row(Wrenches(bodies, motion).torque, 0); }
};

TEST(Response, PushesWithTheSpringOfTheTwoBodies) {
  BallOnFloor ball;
  ball.bodies.law.use_restitution = 0;
  EXPECT_NEAR(ball.force().z, 1e5 * 1e-3, 1e-9);
  ball.bodies.law.exponent = 1.5;
  EXPECT_NEAR(ball.force().z, 1e5 * std::pow(1e-3, 1.5), 1e-9);
  // Two springs F = k x^n in series: the depths of equal forces add up to the depth.
  ball.bodies.stiffness[1] = 3e5;
  const double force = ball.force().z;
  EXPECT_NEAR(std::pow(force / 1e5, 1 / 1.5) + std::pow(force / 3e5, 1 / 1.5), 1e-3, 1e-15);
}

TEST(Response, PushesAsHertzSays) {
  BallOnFloor ball;
  ball.bodies.law.use_restitution = 0;
  ball.bodies.law.exponent = 1.5;
  // K = 4/3 E* sqrt(R); both bodies of E = 2e9, nu = 0.3.
  const double modulus[2] = {2e9 / 0.91, 2e9 / 0.91}, curvature[2] = {1 / 0.1, 0.0};
  cmb_body_properties properties = ball.bodies.properties();
  properties.stiffness = nullptr;
  properties.modulus = modulus;
  properties.curvature = curvature;
  double force[6], torque[6];
  const cmb_motion motion = ball.motion.view();
  ASSERT_EQ(cmb_evaluate_response(ball.bodies.broadphase, &ball.bodies.law, &properties, &motion, force, torque,
                                  nullptr),
            CMB_OK);
  EXPECT_NEAR(force[2], 4.0 / 3 * (1e9 / 0.91) * std::sqrt(0.1) * std::pow(1e-3, 1.5), 1e-6);
  const double flat[2] = {0.0, 0.0};
  properties.curvature = flat;
  EXPECT_EQ(cmb_evaluate_response(ball.bodies.broadphase, &ball.bodies.law, &properties, &motion, force, torque,
                                  nullptr),
            CMB_ERROR_ARGUMENT);
  EXPECT_NE(std::string(cmb_last_error()).find("bodies 1 and 2"), std::string::npos);
}

TEST(Response, DampsAsItsLawSays) {
  BallOnFloor ball;
  ball.bodies.law.use_restitution = 0;
  ball.bodies.law.steady_rate = 2.0;
  Motion::set_row(ball.motion.velocity, 0, {0, 0, -0.25});
  EXPECT_NEAR(ball.force().z, 100 * 1.5, 1e-9);
  Motion::set_row(ball.motion.velocity, 0, {0, 0, 0.6});
  EXPECT_EQ(ball.force().z, 0.0);

  ball.bodies.law.normal_law = CMB_LAW_SPRING_DAMPER;
  ball.bodies.law.damping = 50;
  Motion::set_row(ball.motion.velocity, 0, {0, 0, -0.25});
  EXPECT_NEAR(ball.force().z, 100 + 12.5, 1e-9);
  ball.bodies.law.damping_depth = 2e-3;  // half way: half of the damper
  EXPECT_NEAR(ball.force().z, 100 + 6.25, 1e-9);
}

TEST(Response, RubsAsItsLawSays) {
  BallOnFloor ball;
  ball.bodies.law.use_restitution = 0;
  ball.bodies.law.regularisation_speed = 1e-3;
  Motion::set_row(ball.motion.velocity, 0, {0.75, 1, 0});
  const double largest_friction = 0.4 * 100 * 1.25 / std::hypot(1.25, 1e-3);
  EXPECT_NEAR(ball.force().x, -0.6 * largest_friction, 1e-9);
  EXPECT_NEAR(ball.force().y, -0.8 * largest_friction, 1e-9);
  // The point of contact lies half way between the surfaces.
  EXPECT_NEAR(ball.torque().x, -0.8 * largest_friction * (0.1 - 1e-3 / 2), 1e-9);
  EXPECT_NEAR(ball.torque().y, 0.6 * largest_friction * (0.1 - 1e-3 / 2), 1e-9);

  ball.bodies.law.stribeck_speed = 1.25;
  const double mu = 0.4 + 0.2 * std::exp(-1.0);
  EXPECT_NEAR(ball.force().y, -0.8 * largest_friction * mu / 0.4, 1e-9);
  ball.bodies.law.use_friction = 0;
  EXPECT_EQ(ball.force().y, 0.0);
}

TEST(Response, ResistsSpinningAndRolling) {
  BallOnFloor ball;
  ball.bodies.law.use_restitution = 0;
  ball.bodies.law.spin_radius = 0.03;
  ball.bodies.law.rolling_lever = 0.02;
  ball.bodies.law.turning_regularisation_speed = 1e-6;
  Motion::set_row(ball.motion.angular_velocity, 0, {0, 0, 5});
  EXPECT_NEAR(ball.torque().z, -2.0 / 3 * 0.4 * 0.03 * 100, 1e-9);
  // Rolling without sliding at the point of contact.
  Motion::set_row(ball.motion.angular_velocity, 0, {0, 5, 0});
  Motion::set_row(ball.motion.velocity, 0, {5 * (0.1 - 1e-3 / 2), 0, 0});
  EXPECT_NEAR(ball.torque().y, -0.02 * 100, 1e-9);
  EXPECT_NEAR(ball.force().x, 0, 1e-9);
}

TEST(MemorylessLaw, SolvesItsEquation) {
  // s/v0^2 = (1 - r)/d - ln((1 + d)/(1 + d r))/d^2, s = K x^(n+1)/(m (n+1)).
  // From 0.12 on the root is known nearly, below damping is heavy.
  for (const double e : {0.05, 0.1, 0.11, 0.115, 0.12, 0.125, 0.15, 0.2, 0.3, 0.5, 0.7, 0.9, 0.99}) {
    const double d = cmb::damping_factor(CMB_LAW_EXACT, e);
    EXPECT_NEAR(std::log((1 + d) / (1 - d * e)), d * (1 + e), 1e-8 * d);
    const cmb::Damping damping = cmb::damping_of(d);
    EXPECT_NEAR(damping.logarithm_at_separation, std::log1p(-d * e), 1e-7);
    for (const double exponent : {1.0, 1.5, 2.0}) {
      for (int k = 1; k < 40; ++k) {
        const double r = -e + (1 + e) * k / 40, v0 = 3.0, K = 1e6, m = 0.7;
        const double s = v0 * v0 * ((1 - r) / d - std::log((1 + d) / (1 + d * r)) / (d * d));
        EXPECT_NEAR(cmb::memoryless_speed_ratio(r * v0, s, damping), r, 1e-8 * (1 + 1 / d));
        const double depth = std::pow(s * m * (exponent + 1) / K, 1 / (exponent + 1));
        const double spring = K * std::pow(depth, exponent);
        EXPECT_NEAR(cmb::memoryless_force(depth, r * v0, K, exponent, spring / m, damping), spring * (1 + d * r),
                    1e-8 * spring * (1 + d));
      }
    }
  }
}

TEST(MemorylessLaw, IsExactWhereDampingIsLight) {
  // As where it is heavy, for t in (ln(1 - d e), ln(1 + d)), which are found in long numbers, too. With a table of where the search
  // begins, and without.
  for (const double d : {1e-3, 0.01, 0.1, 0.166, 0.5, 1.0, 1.433, 2.0, 3.087, 5.0, 6.5, 8.0}) {
    const long double start = std::log1p(static_cast<long double>(d)), constant = 1 + d - start;
    long double separation = -constant - 1, least = 0;
    for (int i = 0; i < 120; ++i) {
      const long double t = (separation + least) / 2;
      (t - std::exp(t) + constant < 0 ? separation : least) = t;
    }
    const cmb::Damping damping = cmb::damping_of(d);
    cmb::Damping tabulated = damping;
    tabulated.sigma = cmb::tabulate_sigma(damping);
    ASSERT_NE(tabulated.sigma, nullptr);
    std::vector<double> speeds{0.0};
    for (int k = -160; k <= 80; ++k) {
      speeds.push_back(std::pow(10.0, 0.05 * k));
      speeds.push_back(-std::pow(10.0, 0.05 * k));
    }
    for (const double q : speeds) {
      long double low = q > 0 ? 0 : separation, high = q > 0 ? start : 0;
      for (int i = 0; i < 120; ++i) {
        const long double t = (low + high) / 2, under = std::fmax(0.0L, t - std::exp(t) + constant);
        (std::expm1(t) < q * std::sqrt(under) ? low : high) = t;
      }
      const double expected = static_cast<double>(std::expm1(low) / d);
      // exp(t) - 1 is known to a few roundings of exp(t), and so is t - exp(t) + constant, d^2/2 at most where d is small.
      const double known = 2e-15 * (1 + 1 / d + std::fabs(expected) / (d * d));
      EXPECT_NEAR(cmb::memoryless_speed_ratio(q, 1.0, damping), expected, known) << d << ' ' << q;
      EXPECT_NEAR(cmb::memoryless_speed_ratio(q, 1.0, tabulated), expected, known) << d << ' ' << q;
    }
  }
}

TEST(MemorylessLaw, BeginsItsSearchNearTheRoot) {
  for (const double d : {0.01, 0.1, 1.433, 3.0, 8.0}) {
    cmb::Damping damping = cmb::damping_of(d);
    damping.sigma = cmb::tabulate_sigma(damping);
    for (int k = -400; k <= 400; ++k) {
      const double q = std::sinh(0.024 * k), sigma = damping.sigma->sigma(q), p = sigma * sigma;
      const double t = (damping.logarithm_at_start * p + damping.logarithm_at_separation) / (1 + p);
      const double ratio = cmb::memoryless_speed_ratio(q, 1.0, damping);
      EXPECT_NEAR(std::exp(t), 1 + d * ratio, (d < 4 ? 3e-6 : 1e-4) * d) << d << ' ' << q;
    }
  }
  EXPECT_EQ(cmb::tabulate_sigma(cmb::damping_of(8.1)), nullptr);
}

TEST(MemorylessLaw, IsExactWhereDampingIsHeavy) {
  // The relation itself, t = ln(1 + d r): exp(t) - 1 = q sqrt(t - exp(t) + 1 + d - ln(1 + d)), whose left side less its right
  // one rises with t, bisected in long numbers.
  for (const double d : {8.0 + 1e-9, 8.5, 10.0, 20.0, 70.0, 300.0, 1999.5, 1e5}) {
    const long double start = std::log1p(static_cast<long double>(d)), constant = 1 + d - start;
    const cmb::Damping damping = cmb::damping_of(d);
    std::vector<double> speeds{damping.speed_between};
    for (int k = -80; k <= 40; ++k) {
      speeds.push_back(std::pow(10.0, 0.1 * k));
      speeds.push_back(-std::pow(10.0, 0.1 * k));
      speeds.push_back(damping.speed_between * (1 + (k % 2 == 0 ? 1 : -1) * std::pow(10.0, 0.1 * (k - 41))));
    }
    for (const double q : speeds) {
      long double low = q > 0 ? 0 : -constant - 10, high = q > 0 ? start : 0;
      for (int i = 0; i < 120; ++i) {
        const long double t = (low + high) / 2, under = std::fmax(0.0L, t - std::exp(t) + constant);
        (std::expm1(t) < q * std::sqrt(under) ? low : high) = t;
      }
      const double expected = static_cast<double>(std::expm1(low));
      const double found = d * cmb::memoryless_speed_ratio(q, 1.0, damping);
      EXPECT_NEAR(found, expected, 2e-15 * (1 + std::fabs(expected))) << d << ' ' << q;
      if (std::fabs(q) < 1e-3) {
        EXPECT_NEAR(found, expected, 2e-15 * std::fabs(expected)) << d << ' ' << q;
      }
    }
  }
}

TEST(ExactLaw, DeliversSmallRestitutionsToo) {
  const auto delivered = [](double asked) {
    const double d = cmb::damping_factor(CMB_LAW_EXACT, asked);
    return (1 - std::exp(cmb::logarithm_at_separation(d))) / d;
  };
  for (const double e : {5e-4, 1e-3, 5e-3, 0.01, 0.02}) EXPECT_NEAR(delivered(e), e, 1e-9);
  EXPECT_NEAR(delivered(0), 5e-4, 1e-9);  // no smaller one, which would need unbounded damping
}

// A body that meets the floor without gravity and friction: speed of the point `arm` (world axes, from the centre)
// along the normal, after by before.
double delivered_restitution(Bodies &bodies, const Mat3 &axes, double height, const Vec3 &arm, double speed) {
  bodies.law.use_friction = 0;
  Motion start(2);
  start.set_rotation(0, axes);
  Motion::set_row(start.position, 0, {0, 0, height});
  Motion::set_row(start.velocity, 0, {0, 0, -speed});
  Simulation simulation(bodies, start, {});
  bool touched = false, parted = false;
  while (!parted) {
    simulation.run(simulation.time() + 1e-5, 1e-8, [&] {
      const bool touches = simulation.wrenches().sums.contact_count > 0;
      parted = touched && !touches;
      touched = touched || touches;
    });
    if (simulation.time() > 1.0) {
      ADD_FAILURE() << "still touching, or never";
      return 0.0;
    }
  }
  const Vec3 v = Motion::row(simulation.motion().velocity, 0) +
                 cross(Motion::row(simulation.motion().angular_velocity, 0), arm);
  return v.z / speed;
}

TEST(Restitution, IsDeliveredByBallsUnderEveryLaw) {
  for (const double e : {0.1, 0.3, 0.5, 0.7, 0.9, 1.0}) {
    for (const double exponent : {1.0, 1.5}) {
      BallOnFloor ball(1e5, e);
      ball.bodies.law.exponent = exponent;
      EXPECT_NEAR(delivered_restitution(ball.bodies, {}, 0.1001, {}, 1.0), e, e == 1.0 ? 1e-3 : 1e-4);
    }
  }
  // What the published laws deliver at e = 0.5: the root of (1 + d)/(1 - d e) = exp(d (1 + e)) for their d.
  const std::pair<cmb_normal_law, double> published[] = {
      {CMB_LAW_JUHASZ, 0.594}, {CMB_LAW_HUNT_CROSSLEY, 0.663}, {CMB_LAW_HERBERT_MCWHANNELL, 0.594},
      {CMB_LAW_LEE_WANG, 0.799}, {CMB_LAW_LANKARANI_NIKRAVESH, 0.725}, {CMB_LAW_GONTHIER, 0.488},
      {CMB_LAW_FLORES, 0.470}, {CMB_LAW_HU_GUO, 0.488}};
  for (const auto &[law, delivered] : published) {
    BallOnFloor ball(1e5, 0.5);
    ball.bodies.law.normal_law = law;
    EXPECT_NEAR(delivered_restitution(ball.bodies, {}, 0.1001, {}, 1.0), delivered, 6e-4);
  }
}

TEST(Restitution, IsDeliveredBetweenBallsOfAnyMasses) {
  for (const double heavy : {1.0, 7.0, 1000.0}) {
    Bodies bodies;
    bodies.add_sphere(0.1, 1.0, 1e5, 0.6);
    bodies.add_sphere(0.2, heavy, 1e5, 0.6);
    bodies.intern();
    Motion start(2);
    Motion::set_row(start.position, 1, {0.3001, 0, 0});
    Motion::set_row(start.velocity, 0, {1.0, 0, 0});
    Simulation simulation(bodies, start, {});
    simulation.run(0.05, 1e-8);
    const double after = simulation.motion().velocity[3] - simulation.motion().velocity[0];
    EXPECT_EQ(simulation.wrenches().sums.contact_count, 0u);
    EXPECT_NEAR(after, 0.6, 1e-4);
    EXPECT_NEAR(simulation.motion().velocity[0] + heavy * simulation.motion().velocity[3], 1.0, 1e-9);
  }
}

// A cube lands on its face, an edge and a corner, with the centre of mass above the contact: the mass that counts is
// that of the cube, whatever the weights of the points.
TEST(Restitution, IsDeliveredByFacesEdgesAndCorners) {
  const Mat3 on_edge = rotation_about({1, 0, 0}, pi / 4);
  const Mat3 on_corner = product(rotation_about({0, 1, 0}, -std::atan(std::sqrt(0.5))), on_edge);
  const std::pair<Mat3, double> cases[] = {{{}, 0.5}, {on_edge, std::sqrt(0.5)}, {on_corner, std::sqrt(0.75)}};
  for (const auto &[axes, height] : cases) {
    Bodies bodies;
    bodies.add("cmb/1 box size=1,1,1", 3.0, {0.5, 0.5, 0.5}, 1e6, 0.4);
    bodies.add_fixed("cmb/1 halfspace", 0.4);
    bodies.intern();
    EXPECT_NEAR(delivered_restitution(bodies, axes, height + 1e-4, {}, 1.0), 0.4, 2e-4);
  }
}

// A rod meets the floor with one end: only its turning makes the restitution at that end what was asked for.
TEST(Restitution, IsDeliveredWhereBodiesTurn) {
  for (const double stiffness : {1e7, 1e9}) {
    Bodies bodies;
    bodies.add("cmb/1 sphere radius=0.05 position=0.5,0,0", 2.0, {1e-3, 0.2, 0.2}, stiffness, 0.6);
    bodies.add_fixed("cmb/1 halfspace", 0.6);
    bodies.intern();
    const double delivered = delivered_restitution(bodies, {}, 0.05001, {0.5, 0, 0}, 1.0);
    // The rod turns during the contact, the less the stiffer it is.
    EXPECT_NEAR(delivered, 0.6, stiffness > 1e8 ? 1e-3 : 1e-2);
  }
}

// One point: K x^n by the effective mass.
TEST(SpringDeceleration, IsThatOfTheClosedForm) {
  std::mt19937 random(7);
  for (int repetition = 0; repetition < 100; ++repetition) {
    const Mat3 axes[2] = {random_rotation(random), random_rotation(random)};
    double tensor[2][9];
    cmb::Inertia inertia[2];
    const Vec3 point = random_vector(random, 1.0), normal = normalized(random_vector(random, 1.0));
    double inverse = 0.0;
    for (int body = 0; body < 2; ++body) {
      // I = Q diag(moments) Q^T: its inverse is known.
      const Mat3 q = random_rotation(random);
      const Vec3 moments{uniform(random, 0.1, 1), uniform(random, 0.1, 1), uniform(random, 0.1, 1)};
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
          tensor[body][3 * i + j] = 0.0;
          for (int k = 0; k < 3; ++k) tensor[body][3 * i + j] += q.row[i][k] * moments[k] * q.row[j][k];
        }
      }
      inertia[body] = {false, uniform(random, 0.1, 5), random_vector(random, 1.0), tensor[body], &axes[body]};
      const Vec3 turning = transposed_times(
          q, transposed_times(axes[body], cross(point - inertia[body].center, normal)));
      inverse += 1 / inertia[body].mass + turning.x * turning.x / moments.x + turning.y * turning.y / moments.y +
                 turning.z * turning.z / moments.z;
    }
    std::vector<double> deceleration;
    cmb::spring_decelerations({{1e-3, 0.25, normal, point}}, 1e6, 1.5, inertia[0], inertia[1], deceleration);
    EXPECT_NEAR(deceleration[0] / (0.25 * 1e6 * std::pow(1e-3, 1.5) * inverse), 1.0, 1e-10);
    // A fixed body takes no part; one without tensor does not turn.
    cmb::spring_decelerations({{1e-3, 1.0, normal, point}}, 1e6, 1.0, inertia[0], {}, deceleration);
    EXPECT_LT(deceleration[0], 1e3 * inverse);
    const double none[9] = {};
    inertia[0].tensor = none;
    cmb::spring_decelerations({{1e-3, 1.0, normal, point}}, 1e6, 1.0, inertia[0], {}, deceleration);
    EXPECT_NEAR(deceleration[0], 1e3 / inertia[0].mass, 1e-9 * deceleration[0]);
  }
}

TEST(SpringDeceleration, SeesTheContactAsAWhole) {
  const Vec3 up{0, 0, 1};
  const double tensor[9] = {2, 0, 0, 0, 2, 0, 0, 0, 2};
  const Mat3 axes;
  const cmb::Inertia body{false, 4.0, {0, 0, 1}, tensor, &axes};
  std::vector<double> deceleration;
  // A face: all of its points are slowed down as the body is.
  cmb::spring_decelerations({{1e-3, 0.25, up, {1, 1, 0}}, {1e-3, 0.25, up, {-1, 1, 0}}, {1e-3, 0.25, up, {-1, -1, 0}},
                             {1e-3, 0.25, up, {1, -1, 0}}},
                            1e6, 1.0, body, {}, deceleration);
  for (const double value : deceleration) EXPECT_NEAR(value, 1e3 / 4.0, 1e-9);
  // A point that only begins to carry changes nothing.
  cmb::spring_decelerations({{1e-3, 0.25, up, {1, 0, 0}}}, 1e6, 1.0, body, {}, deceleration);
  const double alone = deceleration[0];
  cmb::spring_decelerations({{1e-3, 0.25, up, {1, 0, 0}}, {1e-200, 0.25, up, {9, 0, 0}}}, 1e6, 1.0, body, {},
                            deceleration);
  EXPECT_NEAR(deceleration[0], alone, 1e-12 * alone);
  // A point that the springs drive deeper counts a tenth of what its own spring would do.
  cmb::spring_decelerations({{1e-3, 1.0, up, {5, 0, 0}}, {1e-9, 1.0, up, {-5, 0, 0}}}, 1e6, 1.0, body, {},
                            deceleration);
  EXPECT_NEAR(deceleration[1], 0.1 * 1e6 * 1e-9 * (1 / 4.0 + 5 * 5 / 2.0), 1e-12);
}

// Balls between a floor and four walls.
Bodies balls_in_box(std::size_t count, double restitution, double mu) {
  Bodies bodies;
  for (std::size_t i = 0; i < count; ++i) bodies.add_sphere(0.05, 0.5, 2e4, restitution, mu);
  bodies.add_fixed(
      "cmb/1 halfspace;cmb/1 box size=0.1,2,2 position=-0.215,0,0;cmb/1 box size=0.1,2,2 position=0.215,0,0;"
      "cmb/1 box size=2,0.1,2 position=0,-0.215,0;cmb/1 box size=2,0.1,2 position=0,0.215,0",
      restitution, mu);
  bodies.intern();
  return bodies;
}

Motion dropped(const Bodies &bodies) {
  Motion motion(bodies.count());
  std::mt19937 random(5);
  for (std::size_t i = 0; i + 1 < bodies.count(); ++i) {
    const int k = static_cast<int>(i);
    Motion::set_row(motion.position, i, Vec3{0.108 * (k % 3 - 1), 0.108 * (k / 3 % 3 - 1), 0.1 + 0.12 * (k / 9)} +
                                            random_vector(random, 0.004));
  }
  return motion;
}

TEST(Energy, IsKeptWithoutDamping) {
  Bodies bodies = balls_in_box(27, 1.0, 0.0);
  bodies.law.use_friction = 0;
  bodies.law.use_restitution = 0;
  bodies.law.steady_rate = 0.0;
  Simulation simulation(bodies, dropped(bodies), {0, 0, -9.81});
  const double start = simulation.energy();
  double most_contacts = 0;
  while (simulation.time() < 0.5) {
    simulation.run(simulation.time() + 0.01, 1e-7);
    most_contacts = std::fmax(most_contacts, static_cast<double>(simulation.wrenches().sums.contact_count));
    EXPECT_NEAR(simulation.energy(), start, 2e-4 * start);
  }
  EXPECT_GT(most_contacts, 9);
}

TEST(Energy, NeverRisesAndTheFloorCarriesTheWeight) {
  Bodies bodies = balls_in_box(27, 0.3, 0.5);
  bodies.law.rolling_lever = 1e-2;
  bodies.law.regularisation_speed = 1e-2;
  bodies.law.turning_regularisation_speed = 0.2;
  Simulation simulation(bodies, dropped(bodies), {0, 0, -9.81});
  double last = simulation.energy();
  while (simulation.time() < 3.0) {
    simulation.run(simulation.time() + 0.02, 1e-6);
    EXPECT_LT(simulation.energy(), last + 1e-5);
    last = simulation.energy();
  }
  // What is left is the creeping of regularised friction, slower than its regularisation speed.
  EXPECT_LT(simulation.kinetic_energy(), 0.25 * 0.5 * 27 * 0.5 * std::pow(bodies.law.regularisation_speed, 2));
  EXPECT_NEAR(Motion::row(simulation.wrenches().force, 27).z, -27 * 0.5 * 9.81, 0.01);
  for (std::size_t i = 0; i < 27; ++i) {
    const Vec3 p = Motion::row(simulation.motion().position, i);
    EXPECT_LT(std::fmax(std::fabs(p.x), std::fabs(p.y)), 0.12);
    EXPECT_GT(p.z, 0.045);
  }
}

// A ball that slides at v0 rolls at 5/7 v0 after v0 2/(7 mu g).
TEST(Friction, MakesASlidingBallRoll) {
  BallOnFloor ball(1e5, 0.5, 0.3);
  Motion start = ball.motion;
  Motion::set_row(start.position, 0, {0, 0, 0.1 - 2.0 * 9.81 / 1e5});
  Motion::set_row(start.velocity, 0, {2, 0, 0});
  Simulation simulation(ball.bodies, start, {0, 0, -9.81});
  simulation.run(0.15, 1e-7);
  EXPECT_NEAR(simulation.motion().velocity[0], 2 - 0.3 * 9.81 * 0.15, 1e-3);
  simulation.run(0.4, 1e-7);
  EXPECT_NEAR(simulation.motion().velocity[0], 10.0 / 7, 2e-3);
}

TEST(Response, SaysWhatIsWrong) {
  BallOnFloor ball;
  double force[6] = {1, 2, 3, 4, 5, 6}, torque[6] = {};
  const auto refused = [&](const char *says, cmb_status expected = CMB_ERROR_ARGUMENT) {
    const cmb_body_properties properties = ball.bodies.properties();
    const cmb_motion motion = ball.motion.view();
    EXPECT_EQ(cmb_evaluate_response(ball.bodies.broadphase, &ball.bodies.law, &properties, &motion, force, torque,
                                    nullptr),
              expected);
    EXPECT_NE(std::string(cmb_last_error()).find(says), std::string::npos) << cmb_last_error();
    EXPECT_EQ(force[2], 3.0) << "outputs changed";
    ball = BallOnFloor();
  };
  ball.bodies.mass[0] = 0.0;
  refused("body 1: the mass");
  ball.bodies.mass[0] = HUGE_VAL;
  refused("body 1: the mass");
  ball.bodies.inertia[4] = -1.0;
  refused("body 1: the inertia");
  // One half of the tensor is as good as the other: both have to say the same.
  for (const std::size_t entry : {1, 2, 3, 5, 6, 7}) {
    ball.bodies.inertia[entry] = NAN;
    refused("body 1: the inertia");
    ball.bodies.inertia[entry] = 1e-3 * ball.bodies.inertia[0];
    refused("body 1: the inertia");
  }
  for (const std::size_t axis : {0, 1, 2}) {
    ball.bodies.center_of_mass[axis] = axis == 1 ? HUGE_VAL : NAN;
    refused("body 1: the centre of mass is not finite");
  }
  ball.bodies.stiffness[1] = -1.0;
  refused("body 2: the stiffness");
  ball.bodies.stiffness[0] = HUGE_VAL;
  refused("no finite stiffness");
  ball.bodies.restitution[1] = 1.5;
  refused("body 2: the restitution");
  ball.bodies.mu_dynamic[0] = NAN;
  refused("body 1: mu_dynamic");
  ball.bodies.law.exponent = 0.5;
  refused("exponent");
  ball.bodies.law.regularisation_speed = 0;
  refused("regularisation_speed");
  ball.bodies.law.normal_law = static_cast<cmb_normal_law>(11);
  refused("normal_law");
  ball.bodies.law.friction_rule = static_cast<cmb_combination_rule>(0);
  refused("combination rule");
  ball.motion.velocity[5] = NAN;
  refused("body 2 has a velocity", CMB_ERROR_POSE);
  ball.motion.rotation[0] = 0.5;
  refused("body 1 has a rotation", CMB_ERROR_POSE);
}

// The bodies of a list alone: as where all others are far away, to the bit. Nothing is read or written of others.
TEST(Response, AmongSomeBodiesIsAsWithoutOthers) {
  std::mt19937 random(11);
  int touching = 0;
  for (int repetition = 0; repetition < 40; ++repetition) {
    Bodies bodies = random_bodies(random, repetition % 4 < 2 ? 14 : 60);
    if (repetition % 2 == 1) bodies.law = random_law(random);
    Motion motion = random_motion(random, bodies), alone = motion;
    std::vector<int> listed;
    for (std::size_t i = 0; i < bodies.count(); ++i) {
      if (i + 1 == bodies.count() || random() % 2 == 0) {
        listed.push_back(static_cast<int>(i) + 1);
      } else {
        Motion::set_row(alone.position, i, {100.0 * static_cast<double>(i + 1), 0, 100});
        Motion::set_row(motion.position, i, {NAN, NAN, NAN});
        Motion::set_row(motion.velocity, i, {NAN, NAN, NAN});
      }
    }
    const Wrenches expected(bodies, alone);
    const cmb_body_properties properties = bodies.properties();
    const cmb_motion view = motion.view();
    std::vector<double> force(3 * bodies.count(), 7.0), torque(3 * bodies.count(), 7.0);
    cmb_response_sums sums{};
    ASSERT_EQ(cmb_evaluate_response_among(bodies.broadphase, &bodies.law, &properties, &view, listed.data(),
                                          listed.size(), force.data(), torque.data(), &sums),
              CMB_OK);
    for (std::size_t i = 0; i < bodies.count(); ++i) {
      const bool is_listed = std::find(listed.begin(), listed.end(), static_cast<int>(i) + 1) != listed.end();
      for (std::size_t k = 3 * i; k < 3 * i + 3; ++k) {
        EXPECT_EQ(force[k], is_listed ? expected.force[k] : 7.0);
        EXPECT_EQ(torque[k], is_listed ? expected.torque[k] : 7.0);
      }
    }
    EXPECT_EQ(sums.contact_count, expected.sums.contact_count);
    EXPECT_EQ(sums.elastic_energy, expected.sums.elastic_energy);
    touching += static_cast<int>(sums.contact_count);
  }
  EXPECT_GT(touching, 100);
}

TEST(Response, AmongSomeBodiesSeesEveryNumberThatChanges) {
  std::mt19937 random(12);
  Bodies bodies = random_bodies(random, 14);
  const Motion motion = random_motion(random, bodies);
  std::vector<int> listed = {1, 2, 3, 5, 8, 13, 15};
  std::vector<double> *const changed[] = {&bodies.mass,        &bodies.center_of_mass, &bodies.inertia,   &bodies.stiffness,
                                          &bodies.restitution, &bodies.mu_static,      &bodies.mu_dynamic};
  const auto answer = [&] {
    const cmb_body_properties properties = bodies.properties();
    const cmb_motion view = motion.view();
    std::vector<double> force(3 * bodies.count()), torque(3 * bodies.count());
    EXPECT_EQ(cmb_evaluate_response_among(bodies.broadphase, &bodies.law, &properties, &view, listed.data(), listed.size(),
                                          force.data(), torque.data(), nullptr),
              CMB_OK);
    force.insert(force.end(), torque.begin(), torque.end());
    return force;
  };
  for (int repetition = 0; repetition < 60; ++repetition) {
    if (repetition % 3 == 0) bodies.law = random_law(random);
    std::vector<double> &column = *changed[random() % 7];
    const std::size_t each = column.size() / bodies.count(), body = random() % (bodies.count() - 1);
    column[each * body] *= uniform(random, 0.9, 0.99);
    const std::vector<double> asked = answer();
    std::thread([&] { EXPECT_EQ(asked, answer()) << repetition; }).join();
  }
}

TEST(Response, AmongSomeBodiesRefusesWhatIsNoList) {
  BallOnFloor ball;
  double force[6] = {}, torque[6] = {};
  const auto refused = [&](std::vector<int> listed) {
    const cmb_body_properties properties = ball.bodies.properties();
    const cmb_motion motion = ball.motion.view();
    EXPECT_EQ(cmb_evaluate_response_among(ball.bodies.broadphase, &ball.bodies.law, &properties, &motion, listed.data(),
                                          listed.size(), force, torque, nullptr),
              CMB_ERROR_ARGUMENT);
  };
  for (const std::vector<int> &listed : {std::vector<int>{0}, {3}, {1, 1}, {2, 1}, {-1, 2}}) refused(listed);
}

TEST(Response, RadiiHoldTheBodies) {
  Bodies bodies;
  bodies.add("cmb/1 sphere radius=0.2 position=0.2,0,0;cmb/1 box size=0.4,0.2,0.3", 1, {1, 1, 1}, 1e4);
  bodies.add_sphere(0.3, 1, 1e4);
  bodies.add_fixed("cmb/1 halfspace");
  bodies.intern();
  double radius[3] = {};
  ASSERT_EQ(cmb_body_radii(bodies.broadphase, 3, radius), CMB_OK);
  EXPECT_GE(radius[0], 0.4);
  EXPECT_LE(radius[0], 0.5);
  EXPECT_NEAR(radius[1], 0.3, 1e-15);
  EXPECT_EQ(radius[2], HUGE_VAL);
}

TEST(Response, NeedsNoMassesWithoutRestitution) {
  BallOnFloor ball;
  ball.bodies.law.use_restitution = 0;
  ball.bodies.mass[0] = 0.0;
  EXPECT_NEAR(ball.force().z, 100, 1e-9);
}

}  // namespace
}  // namespace test_response
