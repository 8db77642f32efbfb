#include "volume/curved_overlap.hpp"

#include <algorithm>
#include <cmath>

namespace cmb::overlap {

namespace {

struct Box {
  Vec3 low, high;
};

Box bounds_of(const convex::Polytope &polytope, const Pose &pose) {
  Box box;
  bool first = true;
  for (const Vec3 &vertex : polytope.vertices()) {
    const Vec3 p = pose(vertex);
    if (first) box = {p, p};
    first = false;
    for (int k = 0; k < 3; ++k) {
      box.low.set(k, std::min(box.low[k], p[k]));
      box.high.set(k, std::max(box.high[k], p[k]));
    }
  }
  return box;
}

void cut_by_faces(const convex::Polytope &polytope, const Pose &pose, convex::OverlapScratch &flat) {
  for (std::size_t f = 0; f < polytope.faces().size() && !flat.faces().empty(); ++f) {
    const auto &face = polytope.faces()[f];
    const Vec3 normal = pose.rotation * face.normal;
    flat.cut(normal, face.offset + dot(normal, pose.translation), static_cast<std::int32_t>(f), false);
  }
}

// Places on the way from `from` to `to`, as far as `shape` holds it.
void add_guess(const Vec3 &from, const Vec3 &to, const convex::Polytope *polytope, const Pose &pose,
               const RoundSolid &round, double *guess, int &count) {
  const Vec3 way = to - from;
  Stretch inside{0.0, 1.0};
  const auto cut = [&](const Vec3 &normal, double offset) {
    const double at = dot(normal, from) - offset, slope = dot(normal, way);
    if (slope > 0.0) inside.end = std::min(inside.end, -at / slope);
    if (slope < 0.0) inside.begin = std::max(inside.begin, -at / slope);
  };
  if (polytope != nullptr) {
    for (const auto &face : polytope->faces()) {
      const Vec3 normal = pose.rotation * face.normal;
      cut(normal, face.offset + dot(normal, pose.translation));
    }
  } else {
    const Stretch whole = round.stretch(from, way);
    inside = {std::max(inside.begin, whole.begin), std::min(inside.end, whole.end)};
    round.visit_flat_ends(cut);
  }
  if (!inside.empty()) guess[count++] = from.y + 0.5 * (inside.begin + inside.end) * way.y;
}

}  // namespace

Vec3 straight_axis(const Shape &shape, const Pose &pose) {
  const bool has = shape.kind == ShapeKind::capsule || shape.kind == ShapeKind::cylinder || shape.kind == ShapeKind::cone;
  return has ? pose.rotation.column(2) : Vec3{};
}

ShapeOverlap curved_overlap(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b,
                            const DeepestPoints &deepest, CurvedScratch &scratch) {
  Vec3 across = cross(deepest.normal, straight_axis(a, pose_a));
  if (!(norm(across) > 0.1)) across = cross(deepest.normal, straight_axis(b, pose_b));
  if (!(norm(across) > 0.1)) across = convex::any_perpendicular(deepest.normal);
  const Pose axes = seen_along(deepest.normal, across, 0.5 * (deepest.a + deepest.b));
  const Pose poses[2] = {relative_pose(axes, pose_a), relative_pose(axes, pose_b)};
  const Shape *shapes[2] = {&a, &b};
  RoundSolid rounds[2], solid[2];
  int round_count = 0;
  Box common;
  for (int k = 0; k < 2; ++k) {
    Box box;
    if (RoundSolid::is_round(*shapes[k])) {
      solid[k] = RoundSolid(*shapes[k], poses[k]);
      box = {solid[k].low(), solid[k].high()};
      rounds[round_count++] = solid[k];
    } else {
      box = bounds_of(shapes[k]->polytope->geometry(), poses[k]);
    }
    // Wider, so that the box' faces touch nothing.
    const Vec3 margin = 1e-3 * (box.high - box.low);
    box = {box.low - margin, box.high + margin};
    if (k == 0) common = box;
    for (int i = 0; i < 3; ++i) {
      common.low.set(i, std::max(common.low[i], box.low[i]));
      common.high.set(i, std::min(common.high[i], box.high[i]));
      if (!(common.low[i] < common.high[i])) return {};
    }
  }
  scratch.flat.start_box(common.low, common.high);
  for (int k = 0; k < 2; ++k) {
    if (shapes[k]->polytope) {
      cut_by_faces(shapes[k]->polytope->geometry(), poses[k], scratch.flat);
    } else {
      solid[k].visit_flat_ends([&](const Vec3 &normal, double offset) { scratch.flat.cut(normal, offset, -1, false); });
    }
  }
  if (scratch.flat.faces().empty()) return {};
  double guess[6] = {0.0};
  int guesses = 1;
  Vec3 point[2], middle[2];
  for (int k = 0; k < 2; ++k) {
    point[k] = transposed_times(axes.rotation, (k == 0 ? deepest.a : deepest.b) - axes.translation);
    middle[k] = shapes[k]->polytope ? poses[k](shapes[k]->polytope->geometry().center()) : solid[k].inner_point();
  }
  for (int k = 0; k < 2; ++k) {
    const int other = 1 - k;
    const convex::Polytope *polytope = shapes[other]->polytope ? &shapes[other]->polytope->geometry() : nullptr;
    add_guess(point[k], middle[k], polytope, poses[other], solid[other], guess, guesses);
    add_guess(middle[k], middle[other], polytope, poses[other], solid[other], guess, guesses);
  }
  return shape_overlap(scratch.slices.measure({&scratch.flat, rounds, round_count}, guess, guesses, 3e-11).solid, axes);
}

}  // namespace cmb::overlap
