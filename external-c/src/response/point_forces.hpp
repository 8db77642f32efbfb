// Forces of one contact point, by the laws of ContactMultiBody.NormalForce and ContactMultiBody.Friction.
#pragma once

#include "math/vector3.hpp"
#include "response/damping_factor.hpp"

namespace cmb {

using convex::Vec3;

// x^exponent for x >= 0.
double depth_power(double depth, double exponent);

// All normal forces are never negative, and 0 where depth is 0. approach_speed is positive while the depth grows.

// K x^n (1 + rate dx/dt)
double damped_force(double depth, double approach_speed, double stiffness, double exponent, double rate);

// K x^n + s(x) damping dx/dt, the cubic step s fading the damper in over damping_depth.
double spring_damper_force(double depth, double approach_speed, double stiffness, double exponent, double damping,
                           double damping_depth);

// K x^n (1 + d (dx/dt)/v0); spring_deceleration: K x^n/m.
double memoryless_force(double depth, double approach_speed, double stiffness, double exponent,
                        double spring_deceleration, const Damping &damping);

// mu between static and sliding friction at this speed; mu_dynamic where limit_speed is 0.
double stribeck(double speed, double mu_static, double mu_dynamic, double limit_speed);

// Coulomb friction, continuous through zero speed; on the body whose velocity against the other is `sliding`.
Vec3 friction_force(double normal_force, const Vec3 &sliding, double mu, double regularisation_speed);

// Torques against turning about the normal and against rolling; w: angular velocity against the other body.
Vec3 spin_torque(double normal_force, const Vec3 &normal, const Vec3 &w, double mu, double radius,
                 double regularisation_speed);
Vec3 rolling_torque(double normal_force, const Vec3 &normal, const Vec3 &w, double lever, double regularisation_speed);

}  // namespace cmb
