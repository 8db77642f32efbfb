#include "response/contact_response.hpp"

#include <cmath>

#include "response/pair_law.hpp"
#include "response/point_forces.hpp"
#include "response/spring_deceleration.hpp"

namespace cmb {

namespace {

Vec3 row_of(const double *array, std::size_t row) {
  return {array[3 * row], array[3 * row + 1], array[3 * row + 2]};
}


class Evaluation {
 public:
  Evaluation(const BroadPhase &broad_phase, const cmb_contact_law &law, const cmb_body_properties &properties,
             const cmb_motion &motion, ResponseScratch &scratch)
      : broad_phase_(broad_phase), law_(law), properties_(properties), motion_(motion), scratch_(scratch) {}

  void add(std::size_t a, std::size_t b, const std::vector<ContactPoint> &points) {
    const double thickness = std::fmin(broad_phase_.scene().thickness[a], broad_phase_.scene().thickness[b]);
    const PairLaw &pair = scratch_.laws.of(a, b);
    if (needs_masses(law_)) {
      spring_decelerations(points, pair.stiffness, law_.exponent, inertia_of(a), inertia_of(b), scratch_.deceleration);
    }
    const Vec3 origin_a = row_of(motion_.poses.position, a), origin_b = row_of(motion_.poses.position, b);
    const Vec3 v_a = row_of(motion_.velocity, a), v_b = row_of(motion_.velocity, b);
    const Vec3 w_a = row_of(motion_.angular_velocity, a), w_b = row_of(motion_.angular_velocity, b);
    for (std::size_t k = 0; k < points.size(); ++k) {
      const ContactPoint &point = points[k];
      const Vec3 arm_a = point.position - origin_a, arm_b = point.position - origin_b;
      const Vec3 velocity = v_a + cross(w_a, arm_a) - v_b - cross(w_b, arm_b);
      const double approach_speed = -dot(velocity, point.normal);
      const double normal_force = point.weight * unit_force(k, point.depth, approach_speed, pair);

      Vec3 force = normal_force * point.normal;
      Vec3 turning;
      if (law_.use_friction != 0) {
        const Vec3 sliding = velocity + approach_speed * point.normal;
        const double mu = stribeck(norm(sliding), pair.mu_static, pair.mu_dynamic, law_.stribeck_speed);
        force = force + friction_force(normal_force, sliding, mu, law_.regularisation_speed);
        if (law_.spin_radius > 0.0) {
          turning = spin_torque(normal_force, point.normal, w_a - w_b, pair.mu_dynamic, law_.spin_radius,
                                law_.turning_regularisation_speed);
        }
      }
      if (law_.rolling_lever > 0.0) {
        turning = turning + rolling_torque(normal_force, point.normal, w_a - w_b, law_.rolling_lever,
                                           law_.turning_regularisation_speed);
      }

      scratch_.force[a] = scratch_.force[a] + force;
      scratch_.force[b] = scratch_.force[b] - force;
      scratch_.torque[a] = scratch_.torque[a] + cross(arm_a, force) + turning;
      scratch_.torque[b] = scratch_.torque[b] - cross(arm_b, force) - turning;
      sums_.elastic_energy += point.weight * pair.stiffness * depth_power(point.depth, law_.exponent) * point.depth /
                              (law_.exponent + 1.0);
      sums_.largest_depth = std::fmax(sums_.largest_depth, point.depth);
      sums_.relative_depth = std::fmax(sums_.relative_depth, point.depth / thickness);
    }
    ++sums_.contact_count;
  }

  const cmb_response_sums &sums() const { return sums_; }

 private:
  // Normal force of point k of the pair, were its weight 1.
  double unit_force(std::size_t k, double depth, double approach_speed, const PairLaw &pair) const {
    if (law_.normal_law == CMB_LAW_SPRING_DAMPER) {
      return spring_damper_force(depth, approach_speed, pair.stiffness, law_.exponent, law_.damping,
                                 law_.damping_depth);
    }
    if (law_.use_restitution != 0) {
      return memoryless_force(depth, approach_speed, pair.stiffness, law_.exponent, scratch_.deceleration[k],
                              pair.damping);
    }
    return damped_force(depth, approach_speed, pair.stiffness, law_.exponent, law_.steady_rate);
  }

  Inertia inertia_of(std::size_t body) const {
    if (broad_phase_.filter().fixed(body)) return {};
    const Pose &pose = scratch_.broad_phase.body_poses[body];
    return {false, properties_.mass[body], pose(row_of(properties_.center_of_mass, body)),
            properties_.inertia + 9 * body, &pose.rotation};
  }

  const BroadPhase &broad_phase_;
  const cmb_contact_law &law_;
  const cmb_body_properties &properties_;
  const cmb_motion &motion_;
  ResponseScratch &scratch_;
  cmb_response_sums sums_{};
};

}  // namespace

ResponseScratch &response_scratch() {
  static thread_local ResponseScratch scratch;
  return scratch;
}

cmb_response_sums evaluate_response(const BroadPhase &broad_phase, const cmb_contact_law &law,
                                    const cmb_body_properties &properties, const cmb_motion &motion,
                                    ResponseScratch &scratch, QueryScratch &query) {
  scratch.laws.prepare(law, properties, broad_phase.filter());
  scratch.force.assign(broad_phase.body_count(), {});
  scratch.torque.assign(broad_phase.body_count(), {});
  Evaluation evaluation(broad_phase, law, properties, motion, scratch);
  visit_contacts(broad_phase, scratch.broad_phase, query,
                 [&](std::size_t a, std::size_t b, const std::vector<ContactPoint> &points) {
                   evaluation.add(a, b, points);
                 });
  return evaluation.sums();
}

cmb_response_sums evaluate_response_among(const BroadPhase &broad_phase, const cmb_contact_law &law,
                                          const cmb_body_properties &properties, const cmb_motion &motion,
                                          ResponseScratch &scratch, QueryScratch &query) {
  scratch.laws.prepare_among(law, properties, broad_phase.filter(), scratch.among);
  scratch.force.resize(broad_phase.body_count());
  scratch.torque.resize(broad_phase.body_count());
  for (const std::uint32_t body : scratch.among) scratch.force[body] = scratch.torque[body] = {};
  Evaluation evaluation(broad_phase, law, properties, motion, scratch);
  broad_phase.find_candidates_among(scratch.among, scratch.broad_phase);
  visit_touching(broad_phase, scratch.broad_phase, query,
                 [&](std::size_t a, std::size_t b, const std::vector<ContactPoint> &points) {
                   evaluation.add(a, b, points);
                 });
  return evaluation.sums();
}

}  // namespace cmb
