#include "manifold/depth_graph.hpp"

#include <algorithm>
#include <cmath>

namespace cmb {

namespace {

constexpr double inverse_hemisphere = 0.5 / 3.14159265358979323846;
// The shake, in rad and in sizes of the bodies: large beside rounding, small beside anything else.
constexpr double shake_size = 1e-11;
// Faces at right angles to the contact plane to this cosine are walls.
constexpr double wall_cosine = 1e-9;
// Edges that cross at a smaller angle (its sine) count as parallel.
constexpr double parallel_sine = 1e-9;
// Slopes that change a cone by rounding only.
constexpr double level_slope = 1e-15;
// How far beyond the other body's extent, in sizes, edges and corners are still looked at: the shake moves the crossing of
// edges at the angle e by shake_size / e, and what is so nearly parallel that it moves farther weighs nothing.
constexpr double margin = 1e-3;

std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

// Of no special direction.
Shake shake_of(double size) {
  return {{0.53 * shake_size, -0.31 * shake_size, 0.79 * shake_size},
          {0.61 * shake_size * size, 0.37 * shake_size * size, -0.17 * shake_size * size}};
}

Extent common(const Extent &a, const Extent &b, double beyond) {
  return {std::max(a.low_x, b.low_x) - beyond, std::min(a.high_x, b.high_x) + beyond,
          std::max(a.low_y, b.low_y) - beyond, std::min(a.high_y, b.high_y) + beyond};
}

// Cuts the arc between two faces' directions at the hemisphere's border; false where nothing is left.
bool cut_arc(Vec3 &first, Vec3 &second) {
  if (first.z <= 0.0 && second.z <= 0.0) return false;
  if (first.z < 0.0) first = second.z * first - first.z * second, first.z = 0.0;
  if (second.z < 0.0) second = first.z * second - second.z * first, second.z = 0.0;
  return true;
}

double area(const Vec3 &from, const Vec3 &to, const Vec3 &p) {
  return (to.x - from.x) * (p.y - from.y) - (to.y - from.y) * (p.x - from.x);
}

// Interpolates (Shepard) between the ends of two edges that cross, at the parts t and s of their ways.
Stiffness between_ends(double t, const Stiffness &at_t0, const Stiffness &at_t1, double s, const Stiffness &at_s0,
                       const Stiffness &at_s1) {
  constexpr double smallest = 1e-28;
  const double a = 1.0 / (t * t + smallest), b = 1.0 / ((1.0 - t) * (1.0 - t) + smallest);
  const double c = 1.0 / (s * s + smallest), d = 1.0 / ((1.0 - s) * (1.0 - s) + smallest), sum = a + b + c + d;
  return {(a * at_t0.value + b * at_t1.value + c * at_s0.value + d * at_s1.value) / sum,
          (1.0 / sum) * (a * at_t0.slope + b * at_t1.slope + c * at_s0.slope + d * at_s1.slope)};
}

}  // namespace

void DepthGraph::Faces::gather(PolytopeSide &side) {
  planes.clear();
  shaken.clear();
  walls.clear();
  const Pose &to_side = side.to_side();
  const Shake &shake = side.shake();
  for (const std::int32_t number : side.faces()) {
    const convex::Polytope::Face &face = side.body().geometry().faces()[index(number)];
    const Vec3 n = to_side.rotation * face.normal, m = shake.direction(n);
    const double offset = face.offset + dot(n, to_side.translation), shaken_offset = offset + dot(m, shake.shift);
    if (n.z > wall_cosine && m.z > 0.0) {
      const double true_part = 1.0 / n.z, shaken_part = 1.0 / m.z;
      planes.push_back({n.x * true_part, n.y * true_part, offset * true_part});
      shaken.push_back({m.x * shaken_part, m.y * shaken_part, shaken_offset * shaken_part});
    } else {
      walls.push_back({m, shaken_offset});
    }
  }
}

const DepthGraph::Plane *DepthGraph::Faces::over(const Vec3 &p, double height, double level, double size) const {
  double least = HUGE_VAL;
  std::size_t best = planes.size();
  for (std::size_t k = 0; k < shaken.size(); ++k) {
    const double here = shaken[k].over(p);
    if (here >= least) continue;
    // What is far from deep enough, however the shake is taken, need not be looked at further.
    const double slack = 1e3 * shake_size * size * (1.0 + std::fabs(shaken[k].slope_x) + std::fabs(shaken[k].slope_y));
    if (height + here <= level - slack) return nullptr;
    least = here, best = k;
  }
  if (best == planes.size()) return nullptr;
  for (const Wall &wall : walls) {
    if (wall.normal.x * p.x + wall.normal.y * p.y + wall.normal.z * least > wall.offset) return nullptr;
  }
  return &planes[best];
}

void DepthGraph::Borders::gather(const PolytopeSide &side, const Extent &region) {
  list.clear();
  order.clear();
  const convex::Mat3 &rotation = side.to_side().rotation;
  const convex::Polytope &geometry = side.body().geometry();
  for (const PolytopeSide::Edge &edge : side.edges()) {
    if (!edge.extent.meets(region)) continue;
    const convex::Polytope::Edge &whole = geometry.edges()[index(edge.number)];
    Border border;
    for (int k = 0; k < 2; ++k) border.ray[k] = rotation * geometry.faces()[index(whole.face[k])].normal;
    if (!(std::max(border.ray[0].z, border.ray[1].z) > wall_cosine)) continue;
    if (!cut_arc(border.ray[0], border.ray[1])) continue;
    const PolytopeSide::Vertex &from = side.vertices()[index(edge.vertex[0])], &to = side.vertices()[index(edge.vertex[1])];
    border.from = from.at, border.to = to.at;
    border.shaken_from = from.shaken, border.shaken_to = to.shaken;
    border.extent.add(from.shaken);
    border.extent.add(to.shaken);
    for (int k = 0; k < 2; ++k) border.vertex[k] = edge.vertex[k];
    order.emplace_back(border.extent.low_x, static_cast<std::int32_t>(list.size()));
    list.push_back(border);
  }
  std::sort(order.begin(), order.end());
}

void DepthGraph::place(const ContactPolytope &a, const Pose &a_in_axes, const ContactPolytope &b,
                       const Pose &b_in_axes) {
  size_ = a.geometry().radius() + b.geometry().radius();
  // A lies above: it is mirrored, so that the depth is the sum of both heights.
  Pose mirrored = a_in_axes;
  mirrored.rotation.row[2] = -mirrored.rotation.row[2];
  mirrored.translation.z = -mirrored.translation.z;
  side_a_.place(a, mirrored, {});
  side_b_.place(b, b_in_axes, shake_of(size_));
  turning_a_ = 0.5;
  if (!a.shares_are_constant() || !b.shares_are_constant()) {
    // The contact normal turns with the body that has a face in it.
    const double lean_a = side_a_.lean(), lean_b = side_b_.lean();
    if (lean_a + lean_b > 0.0) turning_a_ = lean_a / (lean_a + lean_b);
  }
}

void DepthGraph::find_corners(double level) {
  corners_.clear();
  level_ = level;
  side_a_.gather(level - side_b_.reach());
  side_b_.gather(level - side_a_.reach());
  region_ = common(side_a_.extent(), side_b_.extent(), margin * size_);
  if (!(region_.low_x <= region_.high_x && region_.low_y <= region_.high_y)) return;
  stiffness_a_.start(side_a_, turning_a_);
  stiffness_b_.start(side_b_, 1.0 - turning_a_);
  add_vertices(side_a_, stiffness_a_, side_b_, faces_b_, -1.0);
  add_vertices(side_b_, stiffness_b_, side_a_, faces_a_, 1.0);
  add_crossings();
}

// Vertices of one side over faces of the other; `sense` is the contact normal along the side's z axis.
void DepthGraph::add_vertices(const PolytopeSide &side, VertexStiffness &stiffness, PolytopeSide &other_side,
                              Faces &others, double sense) {
  bool gathered = false;
  for (std::size_t i = 0; i < side.vertices().size(); ++i) {
    const PolytopeSide::Vertex &v = side.vertices()[i];
    if (!v.inside || !region_.holds(v.at)) continue;
    if (!gathered) others.gather(other_side), gathered = true;
    const Plane *plane = others.over(v.shaken, v.at.z, level_, size_);
    if (plane == nullptr) continue;
    const double other = plane->over(v.at), depth = v.at.z + other;
    if (!(depth > level_)) continue;
    const double visible = visible_cone(side, v.number, cone_);
    if (cone_.empty()) continue;
    const Stiffness &scale = stiffness.of(static_cast<std::int32_t>(i), visible);
    double part = visible;
    if (std::fabs(plane->slope_x) + std::fabs(plane->slope_y) > level_slope) {
      sheared_cone_.clear();
      for (std::size_t k = 0; k < cone_.size(); ++k) {
        const Vec3 &ray = cone_[k];
        sheared_cone_.add({ray.x + ray.z * plane->slope_x, ray.y + ray.z * plane->slope_y, ray.z});
      }
      part = sheared_cone_.solid_angle();
    }
    part *= inverse_hemisphere;
    // The surfaces are at sense * own height and -sense * the other's.
    corners_.push_back({{v.at.x, v.at.y, 0.5 * sense * (v.at.z - other)}, depth, part * scale.value, part * scale.slope});
  }
}

// The crossing of two edges, seen along the contact normal, if there is one.
void DepthGraph::add_crossing(const Border &e, const Border &f) {
  if (f.extent.low_y > e.extent.high_y || f.extent.high_y < e.extent.low_y) return;
  if ((area(f.shaken_from, f.shaken_to, e.shaken_from) > 0.0) ==
      (area(f.shaken_from, f.shaken_to, e.shaken_to) > 0.0)) {
    return;
  }
  if ((area(e.shaken_from, e.shaken_to, f.shaken_from) > 0.0) ==
      (area(e.shaken_from, e.shaken_to, f.shaken_to) > 0.0)) {
    return;
  }
  const Vec3 de = e.to - e.from, df = f.to - f.from, between = f.from - e.from;
  const double product = de.x * df.y - de.y * df.x;
  if (!(product * product > parallel_sine * parallel_sine * norm2(de) * norm2(df))) return;
  const double inverse = 1.0 / product;
  const double t = std::clamp((between.x * df.y - between.y * df.x) * inverse, 0.0, 1.0);
  const double s = std::clamp((between.x * de.y - between.y * de.x) * inverse, 0.0, 1.0);
  const Vec3 on_e = e.from + t * de, on_f = f.from + s * df;
  const double depth = on_e.z + on_f.z;
  if (!(depth > level_)) return;
  // Slopes add up: the cone's rays are the sums of both edges' directions, taken at the same z.
  cone_.clear();
  for (const int corner : {0, 1, 3, 2}) {
    const Vec3 &p = e.ray[corner & 1], &q = f.ray[corner >> 1];
    const Vec3 ray{p.x * q.z + q.x * p.z, p.y * q.z + q.y * p.z, p.z * q.z};
    if (norm2(ray) > 0.0) cone_.add(ray);
  }
  const double part = cone_.solid_angle() * inverse_hemisphere;
  const Vec3 middle{0.5 * (on_e.x + on_f.x), 0.5 * (on_e.y + on_f.y), 0.5 * (on_f.z - on_e.z)};
  const Stiffness scale = between_ends(t, stiffness_a_.of(e.vertex[0]), stiffness_a_.of(e.vertex[1]), s,
                                       stiffness_b_.of(f.vertex[0]), stiffness_b_.of(f.vertex[1]));
  corners_.push_back({middle, depth, part * scale.value, part * scale.slope});
}

// Edges whose extents along x overlap are found by a sweep.
void DepthGraph::add_crossings() {
  borders_a_.gather(side_a_, region_);
  if (borders_a_.list.empty()) return;
  borders_b_.gather(side_b_, region_);
  const auto &order_a = borders_a_.order, &order_b = borders_b_.order;
  std::size_t next_a = 0, next_b = 0;
  while (next_a < order_a.size() && next_b < order_b.size()) {
    if (order_a[next_a].first <= order_b[next_b].first) {
      const Border &e = borders_a_.list[index(order_a[next_a++].second)];
      for (std::size_t k = next_b; k < order_b.size() && order_b[k].first <= e.extent.high_x; ++k) {
        add_crossing(e, borders_b_.list[index(order_b[k].second)]);
      }
    } else {
      const Border &f = borders_b_.list[index(order_b[next_b++].second)];
      for (std::size_t k = next_a; k < order_a.size() && order_a[k].first <= f.extent.high_x; ++k) {
        add_crossing(borders_a_.list[index(order_a[k].second)], f);
      }
    }
  }
}

}  // namespace cmb
