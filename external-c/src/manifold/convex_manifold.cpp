#include "manifold/convex_manifold.hpp"

namespace cmb {

void convex_contact(const Shape &, const Pose &, const Shape &, const Pose &, const ConvexAnswer &answer,
                    BackendScratch &, ContactSet &result) {
  result.distance = answer.distance;
  result.normal = answer.normal;
  result.witness = 0.5 * (answer.point_a + answer.point_b);
  if (answer.distance < 0.0) result.points.push_back({-answer.distance, 1.0, answer.normal, result.witness});
}

}  // namespace cmb
