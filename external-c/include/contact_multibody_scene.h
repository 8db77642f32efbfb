/* contact_multibody_scene.h - scenes of many bodies: which of them touch, and what forces follow.
 *
 * cmb_intern takes a list of pairs; here any two bodies may touch that a filter does not keep apart, and a search in
 * nearly linear time finds those that do. cmb_evaluate_response also computes the forces, by the laws of the Modelica
 * library. As in contact_multibody.h, every function may be called from any thread at any time, and results depend on
 * the arguments alone. Arrays are the caller's, row-major, never NULL unless said so. */
#ifndef CONTACT_MULTIBODY_SCENE_H
#define CONTACT_MULTIBODY_SCENE_H

#include "contact_multibody.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Handle of an interned scene with its filter. One that is released is refused. */
typedef struct cmb_broadphase {
  int number; /* positive; 0 is none */
} cmb_broadphase;

/* How many broad phases there can be at a time. */
#define CMB_BROADPHASE_LIMIT 4096

/* Which pairs never touch: two fixed bodies; bodies of which one is in no group that the other collides with; excluded
 * pairs, as of neighbours in a joint. */
typedef struct cmb_collision_filter {
  size_t body_count;      /* that of the scene */
  const int *fixed;       /* [body_count] not 0 for bodies that never move, which also have infinite mass; NULL: none */
  const int *group;       /* [body_count] bits of the groups a body belongs to; NULL: bit 0 of each */
  const int *mask;        /* [body_count] bits of the groups it collides with; NULL: all */
  const int *excluded;    /* [excluded_count][2] 1-based body numbers; may be NULL if excluded_count is 0 */
  size_t excluded_count;
} cmb_collision_filter;

/* Interns the bodies of a scene with a filter; the scene's own pairs are not used. The same arguments give the same
 * handle, in every thread.
 * filter      NULL: every two bodies may touch
 * broadphase  receives the handle; unchanged on error. Not NULL. */
CMB_API cmb_status cmb_intern_broadphase(cmb_scene scene, const cmb_collision_filter *filter,
                                         cmb_broadphase *broadphase);

/* Takes back one cmb_intern_broadphase; as cmb_release_scene. */
CMB_API cmb_status cmb_release_broadphase(cmb_broadphase broadphase);

/* The pairs of bodies whose bounds overlap, sorted: all pairs that touch are among them.
 * pairs  [pair_capacity][2] receives 1-based body numbers, the smaller first; may be NULL if pair_capacity is 0
 * pair_count  receives how many there are, also where pair_capacity is smaller. Not NULL. */
CMB_API cmb_status cmb_query_candidates(cmb_broadphase broadphase, const cmb_poses *poses, size_t pair_capacity,
                                        int *pairs, size_t *pair_count);

/* One contact point. */
typedef struct cmb_contact {
  int body_a, body_b;          /* 1-based, body_a < body_b */
  double depth, weight;        /* m, > 0; 1, > 0 */
  double normal[3], point[3];  /* world axes; the unit normal from body_b towards body_a */
} cmb_contact;

/* All contact points, sorted by bodies.
 * contacts  [contact_capacity], may be NULL if contact_capacity is 0
 * contact_count  receives how many there are, also where contact_capacity is smaller. Not NULL. */
CMB_API cmb_status cmb_query_contacts(cmb_broadphase broadphase, const cmb_poses *poses, size_t contact_capacity,
                                      cmb_contact *contacts, size_t *contact_count);

/* In the order of ContactMultiBody.Types.NormalLaw. */
typedef CMB_ENUM(cmb_normal_law) {
  CMB_LAW_EXACT = 1,
  CMB_LAW_JUHASZ = 2,
  CMB_LAW_HUNT_CROSSLEY = 3,
  CMB_LAW_HERBERT_MCWHANNELL = 4,
  CMB_LAW_LEE_WANG = 5,
  CMB_LAW_LANKARANI_NIKRAVESH = 6,
  CMB_LAW_GONTHIER = 7,
  CMB_LAW_FLORES = 8,
  CMB_LAW_HU_GUO = 9,
  CMB_LAW_SPRING_DAMPER = 10
} cmb_normal_law;

/* In the order of ContactMultiBody.Types.CombinationRule. */
typedef CMB_ENUM(cmb_combination_rule) {
  CMB_COMBINE_MINIMUM = 1,
  CMB_COMBINE_MAXIMUM = 2,
  CMB_COMBINE_ARITHMETIC_MEAN = 3,
  CMB_COMBINE_GEOMETRIC_MEAN = 4,
  CMB_COMBINE_HARMONIC_MEAN = 5,
  CMB_COMBINE_PRODUCT = 6
} cmb_combination_rule;

/* The force laws of a scene. x is a point's depth, K its pair's stiffness, n the exponent. */
typedef struct cmb_contact_law {
  cmb_normal_law normal_law;
  /* Not 0: K x^n (1 + d dx/dt / v0) with d by normal_law from the restitution, and the speed of impact v0 recovered from
   * depth and speed. 0: K x^n (1 + steady_rate dx/dt). Without effect for CMB_LAW_SPRING_DAMPER. */
  int use_restitution;
  double exponent;                      /* >= 1 */
  double steady_rate;                   /* s/m, >= 0 */
  double damping;                       /* N.s/m, >= 0, of CMB_LAW_SPRING_DAMPER */
  double damping_depth;                 /* m, > 0, from which that damper acts fully */
  cmb_combination_rule restitution_rule, friction_rule;
  int use_friction;                     /* not 0: Coulomb friction, regularised */
  double regularisation_speed;          /* m/s, > 0 */
  double stribeck_speed;                /* m/s, >= 0: from mu_static to mu_dynamic; 0: mu_dynamic at every speed */
  double spin_radius;                   /* m, >= 0, of the area of contact; 0: no spin friction */
  double rolling_lever;                 /* m, >= 0, coefficient of rolling friction; 0: none */
  double turning_regularisation_speed;  /* rad/s, > 0 */
} cmb_contact_law;

/* Exact law with restitution, exponent 1, smaller restitution and geometric mean of friction, friction with 1e-3 m/s,
 * no Stribeck, spin or rolling friction. law: not NULL. */
CMB_API void cmb_contact_law_init(cmb_contact_law *law);

/* What each body brings into contacts. */
typedef struct cmb_body_properties {
  /* For the effective mass of a pair; may be NULL where restitution is not used. Those of fixed bodies are not read. */
  const double *mass;            /* [body_count] kg, > 0 */
  const double *center_of_mass;  /* [body_count][3] m, in the body's frame */
  const double *inertia;         /* [body_count][3][3] kg.m2, about it, in the body's axes; 0: does not turn */
  /* Stiffness: either stiffness is given, or (with stiffness NULL) modulus and curvature by Hertz. */
  const double *stiffness;  /* [body_count] N/m^exponent, > 0, against a rigid body; two bodies act in series */
  const double *modulus;    /* [body_count] Pa, > 0, E/(1 - nu^2) */
  const double *curvature;  /* [body_count] 1/m, >= 0, 1/radius of the surface; of two bodies that touch one is > 0 */
  const double *restitution;               /* [body_count] 0 ... 1, against its like */
  const double *mu_static, *mu_dynamic;    /* [body_count] >= 0; may be NULL where unused */
} cmb_body_properties;

/* How the bodies move. */
typedef struct cmb_motion {
  cmb_poses poses;
  const double *velocity;          /* [body_count][3] m/s, of the frames' origins */
  const double *angular_velocity;  /* [body_count][3] rad/s, world axes */
} cmb_motion;

/* Sums over a scene. */
typedef struct cmb_response_sums {
  double elastic_energy;  /* J, stored in all contacts */
  double largest_depth;   /* m */
  double relative_depth;  /* 1, largest depth by the thickness of the thinner of the two bodies (see cmb_pair_thickness) */
  size_t contact_count;   /* pairs of bodies that touch */
} cmb_response_sums;

/* The contact forces on all bodies.
 * force   [body_count][3] N, world axes
 * torque  [body_count][3] N.m, about the frames' origins, world axes
 * sums    may be NULL
 * Outputs are unchanged on error. Does not allocate once this thread's scratch has grown. */
CMB_API cmb_status cmb_evaluate_response(cmb_broadphase broadphase, const cmb_contact_law *law,
                                         const cmb_body_properties *properties, const cmb_motion *motion,
                                         double *force, double *torque, cmb_response_sums *sums);

/* The contact forces on some bodies, were there no others; for integrators that follow bodies which are out of each other's reach
 * with steps of their own. Arrays are those of all bodies; the rows of others are neither read nor written. The work
 * grows with the number of the bodies in the list.
 * bodies  [count] 1-based, ascending */
CMB_API cmb_status cmb_evaluate_response_among(cmb_broadphase broadphase, const cmb_contact_law *law,
                                               const cmb_body_properties *properties, const cmb_motion *motion,
                                               const int *bodies, size_t count, double *force, double *torque,
                                               cmb_response_sums *sums);

/* Radii of balls about the origins of the bodies' frames that hold them; infinite for half-spaces.
 * radius  [body_count] m */
CMB_API cmb_status cmb_body_radii(cmb_broadphase broadphase, size_t body_count, double *radius);

/* Gives how the bodies move at a share of a step, 0 ... 1: motion is as cmb_step has it. 0 on success. */
typedef int (*cmb_motion_at)(void *context, double share, double *motion);

/* A step of an integrator. Motions are [18 * body_count]: positions [][3] and rotations [][3][3] as of cmb_poses, then velocities
 * [][3] and angular velocities [][3] as of cmb_motion. */
typedef struct cmb_step {
  size_t body_count;
  double duration;           /* s, > 0 */
  const double *begin, *end; /* motions */
  cmb_motion_at at;          /* not called where the motions at both ends tell that nothing can have happened */
  void *context;
} cmb_step;

/* Two bodies that met in between. */
typedef struct cmb_passage {
  int body_a, body_b; /* 1-based; 0: there are none */
  double share;       /* of the step, from which on they touch, or lie deeper in each other than at its beginning */
  double thickness;   /* m, of the thinner one */
  double speed;       /* m/s, by which they come nearer there at most */
} cmb_passage;

/* Looks for the first of a scene's pairs that in between the ends of a step are in each other by 2 % of the thickness of the thinner
 * body more than at these, or were apart at the beginning and are not at the end: an integrator that looks at the ends alone takes no
 * notice, or too late. Pairs that move against each other by less
 * than a quarter of the thickness are not looked at: they overlap by a hundredth of it or two at most in between.
 * passage  receives what was found; where `at` fails, none. Not NULL. */
CMB_API cmb_status cmb_find_passage(cmb_scene scene, const cmb_step *step, cmb_passage *passage);

/* The same of bodies that a filter lets touch.
 * bodies  [count] 1-based, ascending; NULL: all */
CMB_API cmb_status cmb_find_passage_among(cmb_broadphase broadphase, const int *bodies, size_t count, const cmb_step *step,
                                          cmb_passage *passage);

#ifdef __cplusplus
}
#endif

#endif
