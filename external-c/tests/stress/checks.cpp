#include "checks.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "math/pose_algebra.hpp"
#include "support/level_sheets.hpp"

namespace cmb::stress {

namespace {

using random_bodies::rotation_about;

Fault too_far(const char *what, double value, double expected) {
  char text[160];
  std::snprintf(text, sizeof text, "%s: %.17g instead of %.17g", what, value, expected);
  return text;
}

double least_gap_along(const Sample &s, const Vec3 &n) {
  return gap_along(s.bodies.a.parts[0], s.a, s.bodies.b.parts[0], s.b, n);
}

Fault check_convex(const Sample &s, Random &random) {
  const Answer &answer = s.answer;
  if (answer.distance > s.slack) {
    const double proven = least_gap_along(s, answer.normal[0]);
    if (!(proven > answer.distance - s.slack)) return too_far("apart, proven by the normal", proven, answer.distance);
    return {};
  }
  // Every direction leads out of the overlap within its own depth.
  double gap = -1e300;
  const auto offer = [&](const Vec3 &n) { gap = std::max(gap, least_gap_along(s, n)); };
  for (std::size_t k = 0; k < capacity; ++k) offer(answer.normal[k]);
  for (int k = 0; k < 3; ++k) {
    for (const double sense : {-1.0, 1.0}) {
      offer(sense * s.a.rotation.column(k));
      offer(sense * s.b.rotation.column(k));
    }
    offer(random.direction());
  }
  if (norm(s.a.translation - s.b.translation) > 0.0) offer(normalized(s.a.translation - s.b.translation));
  if (gap > answer.distance + s.slack) return too_far("a direction leads out sooner", answer.distance, gap);
  return {};
}

Fault check_axes(const Sample &s) {
  const double gap = greatest_gap(s.bodies.a.parts[0], s.bodies.axes_a, s.a, s.bodies.b.parts[0], s.bodies.axes_b, s.b);
  const bool same = gap > 0.0 ? s.answer.distance > gap - s.slack : std::fabs(s.answer.distance - gap) < s.slack;
  if (!same) return too_far("separating axes", s.answer.distance, gap);
  return {};
}

// The distance of a body of parts from the half-space z <= height of a pose.
double above_plane(const Solid &solid, const Pose &pose, const Pose &plane, double height) {
  const Vec3 n = plane.rotation.column(2);
  double least = 1e300;
  for (const Part &part : solid.parts) {
    least = std::min(least, dot(n, pose.translation - plane.translation) - height -
                                reach(part, -transposed_times(pose.rotation, n)));
  }
  return least;
}

// How far below `low` a part reaches that reaches above `high` as well: 0 where there is none.
double reach_through(const Solid &solid, const Pose &pose, const Pose &plane, double low, double high) {
  const Vec3 n = plane.rotation.column(2);
  double deepest = 0.0;
  for (const Part &part : solid.parts) {
    const double middle = dot(n, pose.translation - plane.translation);
    const double top = middle + reach(part, transposed_times(pose.rotation, n)) - high;
    const double bottom = middle - reach(part, -transposed_times(pose.rotation, n)) - low;
    if (top > 0.0 && bottom < 0.0) deepest = std::max(deepest, std::min(top, -bottom));
  }
  return deepest;
}

// `ground` is a half-space or a sheet, `solid` has parts.
Fault check_ground(Sample &s, const Solid &solid, const Pose &pose, const Solid &ground, const Pose &plane) {
  const double d = s.answer.distance;
  if (ground.nature == Nature::halfspace) {
    const double expected = above_plane(solid, pose, plane, 0.0);
    if (std::fabs(d - expected) > s.slack) return too_far("on the half-space", d, expected);
    return {};
  }
  const double above = above_plane(solid, pose, plane, ground.high);
  if (above > s.slack && !(d > above - s.slack)) return too_far("above the sheet", d, above);
  if (ground.nature == Nature::flat_sheet && above > s.slack && std::fabs(d - above) > s.slack) {
    return too_far("above the level sheet", d, above);
  }
  const double through = reach_through(solid, pose, plane, ground.low, ground.high);
  if (through > s.slack && d >= 0.0) return too_far("through the sheet", d, -through);
  // All of the sheet's triangles push up.
  double up = 0.0;
  for (std::size_t k = 0; k < capacity; ++k) {
    up += s.answer.weight[k] * s.answer.depth[k] * dot(s.answer.normal[k], plane.rotation.column(2));
  }
  const double sense = &solid == &s.bodies.a ? 1.0 : -1.0;
  if (d < 0.0 && !(sense * up > 0.0)) return too_far("pushed down by the sheet", sense * up, -d);
  return {};
}

// Level sheets touch where the squares they are cross.
Fault check_level_sheets(const Sample &s) {
  const double sine = norm(cross(s.a.rotation.column(2), s.b.rotation.column(2)));
  if (!(sine > 1e-6)) return {};
  // Where squares a little smaller cross, or a little larger do not, rounding does not matter.
  const double margin = s.slack / sine;
  const double least = mesh_samples::common_extent(s.a, s.b, detail::sheet_half - margin);
  const double most = mesh_samples::common_extent(s.a, s.b, detail::sheet_half + margin);
  if (least > 0.0 && !(s.answer.distance < 0.0)) return too_far("level sheets that cross", s.answer.distance, least);
  if (most < 0.0 && s.answer.distance < 0.0) return too_far("level sheets apart", s.answer.distance, most);
  return {};
}

// Closed meshes and compounds against the convex parts they stand for.
Fault check_parts(Sample &s) {
  double least = 1e300;
  for (const auto &row : s.bodies.parts) {
    for (const auto &pair : row) least = std::min(least, pair->ask(s.a, s.b).distance);
  }
  const double d = s.answer.distance;
  const bool meshes = s.bodies.a.nature == Nature::closed_mesh || s.bodies.b.nature == Nature::closed_mesh;
  bool same = std::fabs(d - least) < s.slack;
  if (meshes && least < s.slack) {
    // Meshes measure depth along their triangles' normals; whether they touch is the same.
    same = d < s.slack && (d < 0.0 || least > -s.slack);
  }
  if (!same) return too_far("the distance of its convex parts", d, least);
  return {};
}

Fault check_library(const Sample &s, const Pair &library) {
  const Answer answer = library.ask(s.a, s.b);
  if (const char *wrong = fault_of_numbers(answer)) return std::string("as a back end: ") + wrong;
  // The engine's bounding spheres are about the bodies' middles, these about their origins.
  const double allowed = 2e-4 * (s.bodies.a.radius + s.bodies.b.radius);
  if (!is_library_answer(answer.distance, s.answer.distance, allowed, s.rounding)) {
    return too_far("as a back end", answer.distance, s.answer.distance);
  }
  return {};
}

// Points that hardly push, of bodies deep in each other, may be four times as deep as what they store; they are not without bound.
Fault check_depths(const Sample &s) {
  const Solid &a = s.bodies.a, &b = s.bodies.b;
  const double apart = norm(s.a.translation - s.b.translation);
  const double most = 8.0 * (apart + std::max(a.radius, a.extent) + std::max(b.radius, b.extent));
  for (const double depth : s.answer.depth) {
    if (!(depth <= most)) return too_far("deeper than the bodies are large", depth, most);
  }
  return {};
}

Fault check_reversed(const Sample &s) {
  const Answer reversed = s.bodies.pair->ask(s.a, s.b, true);
  if (const char *wrong = fault_of_numbers(reversed)) return std::string("reversed: ") + wrong;
  // Of two closed meshes the larger one pushes, of equal ones the second: they touch either way, but not as deep.
  const bool either_way = s.bodies.a.nature == Nature::closed_mesh && s.bodies.b.nature == Nature::closed_mesh &&
                          s.answer.distance < 0.0 && reversed.distance < 0.0;
  if (!either_way && std::fabs(reversed.distance - s.answer.distance) > s.slack) {
    return too_far("reversed", reversed.distance, s.answer.distance);
  }
  return {};
}

Fault check_motion(const Sample &s, Random &random) {
  const double turn = random.log_uniform(1e-14, 1e-3), size = size_of(s.bodies);
  const Vec3 shift = turn * size * random.direction();
  Pose near = s.a;
  near.rotation = compose({rotation_about(random.direction(), turn), {}}, s.a).rotation;
  near.translation = s.a.translation + shift;
  const Answer answer = s.bodies.pair->ask(near, s.b);
  if (const char *wrong = fault_of_numbers(answer)) return std::string("moved: ") + wrong;
  const bool exact_depth = has_parts(s.bodies.a) && has_parts(s.bodies.b) &&
                           s.bodies.a.nature != Nature::closed_mesh && s.bodies.b.nature != Nature::closed_mesh;
  if (!exact_depth && (answer.distance < 0.0 || s.answer.distance < 0.0)) return {};
  // What of A, which may have no end, is near B.
  const double reaches = std::max(s.bodies.a.radius, norm(s.a.translation - s.b.translation) +
                                                         std::max(s.bodies.b.radius, s.bodies.b.extent));
  const double motion = turn * (size + reaches);
  if (std::fabs(answer.distance - s.answer.distance) > motion + 2.0 * s.slack) {
    return too_far("a change greater than the motion", answer.distance, s.answer.distance);
  }
  return {};
}

}  // namespace

bool is_library_answer(double found, double truth, double allowed, double rounding) {
  return truth < -rounding ? found < 0.0 && found <= truth + allowed : std::fabs(found - truth) <= allowed;
}

Fault check(Sample &s, Random &random, long sample) {
  s.answer = s.bodies.pair->ask(s.a, s.b);
  if (const char *wrong = fault_of_numbers(s.answer)) return wrong;
  if (auto fault = check_depths(s)) return fault;
  const Solid &a = s.bodies.a, &b = s.bodies.b;
  if (is_single(a) && is_single(b)) {
    if (auto fault = check_convex(s, random)) return fault;
    if (sample % 8 == 0 && is_hull(a) && is_hull(b)) {
      if (auto fault = check_axes(s)) return fault;
    }
    if (sample % 32 == 1) return check_library(s, *s.bodies.fcl);
    if (sample % 16 == 2) return check_library(s, *s.bodies.libccd);
  } else if (has_parts(b) && !has_parts(a)) {
    if (auto fault = check_ground(s, b, s.b, a, s.a)) return fault;
  } else if (has_parts(a) && !has_parts(b)) {
    if (auto fault = check_ground(s, a, s.a, b, s.b)) return fault;
  } else if (a.nature == Nature::flat_sheet && b.nature == Nature::flat_sheet) {
    if (auto fault = check_level_sheets(s)) return fault;
  } else if (has_parts(a) && has_parts(b) && sample % 2 == 0) {
    if (auto fault = check_parts(s)) return fault;
  }
  if (sample % 4 == 1) return check_reversed(s);
  if (sample % 4 == 3 && (a.nature != Nature::halfspace || has_parts(b))) return check_motion(s, random);
  if (sample % 16 == 4 && !same_bits(s.answer, s.bodies.pair->ask(s.a, s.b))) return "the same pose gives other bits";
  return {};
}

}  // namespace cmb::stress
