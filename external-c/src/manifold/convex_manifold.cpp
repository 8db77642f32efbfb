#include "manifold/convex_manifold.hpp"

#include <algorithm>
#include <cmath>

#include "narrowphase/multicontact/contact_directions.hpp"
#include "shape/pair_table.hpp"

namespace cmb {

namespace {

// Borders of two blunt cones cut slivers out of each other that are next to rounding.
bool both_are_blunt(const Shape &a, const Shape &b) {
  constexpr double blunt = 3.7;  // the tangent of the half-angle, 75 degrees
  const auto is_blunt = [](const Shape &shape) { return shape.kind == ShapeKind::cone && shape.body.half.x > blunt * 2.0 * shape.body.half.z; };
  return is_blunt(a) && is_blunt(b);
}

// What a ball touches in one point alone: another ball, or any body with no second separating direction nearly as short.
bool touches_at_its_witness(const Shape &a, const Shape &b, const SignedDistance &answer) {
  const bool ball_a = a.kind == ShapeKind::sphere, ball_b = b.kind == ShapeKind::sphere;
  if (ball_a && ball_b) return true;
  if (!ball_a && !ball_b) return false;
  // The reach is no more than 1.5 depths, which takes no root.
  return answer.interior_ball >= -1.5 * answer.distance ||
         answer.interior_ball >= convex::inner_parallel_radius(-answer.distance, a.bound_radius + b.bound_radius);
}

// Whether points push, about as much as bodies that deep in each other may, and where these are. Overlaps that are thin beside what rounding
// does to their borders need not.
bool is_of_depth(const std::vector<ContactPoint> &points, const SignedDistance &answer, const Vec3 &witness, double size) {
  constexpr double most = 4.0;  // by the depth
  const double deepest = -most * answer.distance;
  double load = 0.0, along = 0.0;
  for (const ContactPoint &point : points) {
    const double part = point.weight * point.depth;
    if (!(point.depth <= deepest) || !(norm(point.position - witness) <= size)) return false;
    load += part, along += part * dot(point.normal, answer.normal);
  }
  return along > 0.0 && load <= deepest;
}

bool is_more_than_rounding(const Shape &a, const Shape &b, const SignedDistance &answer, const ContactSet &result) {
  constexpr double shallow = 1e-6;  // by the smaller body's radius
  const double smaller = std::min(a.bound_radius, b.bound_radius);
  return !(-answer.distance < shallow * smaller) || is_of_depth(result.points, answer, result.witness, 4.0 * smaller);
}

double stored(const std::vector<ContactPoint> &points, std::size_t begin) {
  double energy = 0.0;
  for (std::size_t k = begin; k < points.size(); ++k) energy += 0.5 * points[k].weight * points[k].depth * points[k].depth;
  return energy;
}

void scale_weights(double part, std::vector<ContactPoint> &points, std::size_t begin, std::size_t end) {
  for (std::size_t k = begin; k < end; ++k) points[k].weight *= part;
}

// Of two cylinders or cones. What rounding leaves of their load's way is that of contact directions, as much as stores the energy.
void revolved_contact(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b, const SignedDistance &answer,
                      convex::DistanceScratch &distance, ManifoldScratch &scratch, ContactSet &result) {
  std::vector<ContactPoint> &points = result.points;
  PairLoad load = revolved_pair_contact(a, pose_a, b, pose_b, answer.point_a, answer.point_b, scratch.revolved, points);
  if (load.known > 0.0 && !is_more_than_rounding(a, b, answer, result)) load.known = 0.0;
  if (load.known == 1.0) return;
  if (load.known == 0.0) points.clear();
  const std::size_t found = points.size();
  scale_weights(load.known, points, 0, found);
  curved_contact(a, pose_a, b, pose_b, answer, distance, scratch.curved, points);
  const double would_store = stored(points, found);
  const double part = load.energy > 0.0 && load.energy < would_store ? load.energy / would_store : 1.0;
  scale_weights((1.0 - load.known) * part, points, found, points.size());
}

}  // namespace

void convex_contact(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b, const SignedDistance &answer,
                    convex::DistanceScratch &distance, ManifoldScratch &scratch, ContactSet &result) {
  result.distance = answer.distance;
  result.normal = answer.normal;
  result.witness = 0.5 * (answer.point_a + answer.point_b);
  if (!(answer.distance < 0.0)) return;
  if (touches_at_its_witness(a, b, answer)) {
    // Written member by member: a point put together on the stack and copied as a whole would wait for the store.
    ContactPoint &point = result.points.emplace_back();
    point.depth = -answer.distance;
    point.weight = 1.0;
    point.normal = answer.normal;
    point.position = result.witness;
    return;
  }
  const bool revolved_a = is_revolved(a), revolved_b = is_revolved(b);
  bool touches = false;
  const bool polytopes = a.polytope && b.polytope;
  if (polytopes) {
    touches = elastic_contact(*a.polytope, pose_a, *b.polytope, pose_b, answer.normal, result.witness, scratch.polytopes, result.points);
  } else if (revolved_a && b.polytope) {
    touches = revolved_on_polytope_contact(a, pose_a, *b.polytope, pose_b, result.witness, 1.0, scratch.revolved, result.points);
  } else if (revolved_b && a.polytope) {
    touches = revolved_on_polytope_contact(b, pose_b, *a.polytope, pose_a, result.witness, -1.0, scratch.revolved, result.points);
  } else {
    if (revolved_a && revolved_b && !both_are_blunt(a, b)) {
      revolved_contact(a, pose_a, b, pose_b, answer, distance, scratch, result);
    } else {
      curved_contact(a, pose_a, b, pose_b, answer, distance, scratch.curved, result.points);
    }
    return;
  }
  // Where two directions are equally deep polytopes push along either, or between them.
  if (touches && !polytopes && !is_more_than_rounding(a, b, answer, result)) touches = false, result.points.clear();
  // Else an overlap by rounding, or a library's.
  if (!touches) result.points.push_back({-answer.distance, 1.0, answer.normal, result.witness});
}

}  // namespace cmb
