#include "manifold/convex_manifold.hpp"

namespace cmb {

void convex_contact(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b, const ConvexAnswer &answer,
                    ManifoldScratch &scratch, ContactSet &result) {
  result.distance = answer.distance;
  result.normal = answer.normal;
  result.witness = 0.5 * (answer.point_a + answer.point_b);
  if (!(answer.distance < 0.0)) return;
  const std::size_t begin = result.points.size();
  if (a.polytope && b.polytope) {
    polytope_contact(*a.polytope, pose_a, *b.polytope, pose_b, answer.mean_normal, result.witness, scratch.polytope,
                     result.points);
  } else if (a.kind == ShapeKind::capsule || b.kind == ShapeKind::capsule) {
    axis_contact(a, pose_a, b, pose_b, answer, scratch.axis, result.points);
  }
  // One point where the shapes touch in one, and where they hardly overlap or one swallows the other.
  if (result.points.size() == begin) {
    result.points.push_back({-answer.distance, 1.0, answer.normal, result.witness});
  }
}

}  // namespace cmb
