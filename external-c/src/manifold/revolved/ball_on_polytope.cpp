#include "manifold/revolved/ball_on_polytope.hpp"

#include <algorithm>
#include <cmath>

#include "manifold/revolved/face_polygon.hpp"
#include "math/gauss_rule.hpp"
#include "math/pi.hpp"

namespace cmb {

namespace {

using overlap::gauss_rule;
using overlap::GaussNodes;
using overlap::NodeTurns;

constexpr double widest = 1.0;     // rad: of an arc's part that one rule serves for
constexpr int round_places = 16;   // evenly round a circle
constexpr double rounding = 1e-12;

template <typename Vector>
Vector scaled(const Vec3 &by, const Vector &v) {
  return {by.x * v.x, by.y * v.y, by.z * v.z};
}
Vec3 divided(const Vec3 &v, const Vec3 &by) { return {v.x / by.x, v.y / by.y, v.z / by.z}; }

GaussNodes rule_along(double angle) {
  if (angle < 0.1) return GaussNodes(gauss_rule<6>);
  if (angle < 0.5) return GaussNodes(gauss_rule<7>);
  return GaussNodes(gauss_rule<10>);
}
// From the fan's place to an arc, that far on the ball.
GaussNodes rule_across(double angle) {
  if (angle < 0.1) return GaussNodes(gauss_rule<6>);
  if (angle < 0.4) return GaussNodes(gauss_rule<7>);
  if (angle < 1.2) return GaussNodes(gauss_rule<10>);
  return GaussNodes(gauss_rule<14>);
}

// Places of an arc, their ways by the weight of the rule. What is summed changes with the arc's angle times `faster`.
template <typename Arc, typename Visit>
void visit_arc(const Arc &arc, double longest, double faster, Visit &&visit) {
  const auto offer = [&](double cosine, double sine, double step) {
    visit(arc.center + cosine * arc.along + sine * arc.across, step * (cosine * arc.across - sine * arc.along));
  };
  if (arc.turn == 2.0 * pi && longest >= widest) {
    const double width = arc.turn / round_places;
    for (int k = 0; k < round_places; ++k) offer(std::cos(arc.from + width * k), std::sin(arc.from + width * k), width);
    return;
  }
  const int parts = 1 + static_cast<int>(faster * arc.turn / longest);
  const double width = arc.turn / parts;
  const GaussNodes rule = rule_along(faster * width);
  const NodeTurns turns(rule, width, std::cos(width), std::sin(width));
  for (int part = 0; part < parts; ++part) {
    const double cosine = std::cos(arc.from + width * part), sine = std::sin(arc.from + width * part);
    for (std::size_t k = 0; k < rule.count; ++k) {
      const double c = turns.cosine[k], s = turns.sine[k];
      offer(cosine * c - sine * s, sine * c + cosine * s, width * rule.weight[k]);
    }
  }
}

// All of the ball.
void add_ball(const Vec3 &place, OverlapSurface::Nodes &nodes) {
  const auto &heights = gauss_rule<6>;
  constexpr int around = 12;
  for (std::size_t k = 0; k < 6; ++k) {
    const double z = 2.0 * heights.node[k] - 1.0, r = std::sqrt(1.0 - z * z), part = 4.0 * pi * heights.weight[k] / around;
    for (int j = 0; j < around; ++j) {
      const double angle = 2.0 * pi * j / around;
      const Vec3 at{r * std::cos(angle), r * std::sin(angle), z};
      nodes.add(at - place, part * at);
    }
  }
}

}  // namespace

bool BallOnPolytope::find(const Vec3 &semi_axes, const convex::PolytopeView &polytope, const Pose &in_frame, const Vec3 &place,
                          OverlapSurface &surface) {
  polytope_ = &polytope, semi_axes_ = semi_axes;
  surface.start(place);
  arcs_.clear();
  planes_.clear();
  vertices_.clear();
  stretches_.clear();
  for (const convex::Polytope::Face &face : polytope.faces) {
    const Vec3 normal = in_frame.rotation * face.normal, in_ball = scaled(semi_axes, normal);
    const double scale = 1.0 / norm(in_ball), offset = scale * (face.offset + dot(normal, in_frame.translation));
    if (offset <= -1.0) return false;
    planes_.push_back({scale * in_ball, offset});
  }
  for (const Vec3 &vertex : polytope.vertices) {
    const Vec3 at = divided(in_frame(vertex), semi_axes);
    vertices_.push_back({at, norm2(at) <= 1.0});
  }
  for (const convex::Polytope::Edge &edge : polytope.edges) {
    stretches_.push_back(stretch_of(vertices_[static_cast<std::size_t>(edge.vertex[0])],
                                    vertices_[static_cast<std::size_t>(edge.vertex[1])]));
  }
  const Vec3 from = divided(place, semi_axes);
  for (std::size_t f = 0; f < planes_.size(); ++f) {
    PlaneFan fan(planes_[f].normal, from, planes_[f].offset - dot(planes_[f].normal, from), surface.of_b());
    if (planes_[f].offset < 1.0 && !follow_face(f, fan)) return false;
  }
  add_ball_part(from, surface.of_a());
  const Vec3 areas{semi_axes.y * semi_axes.z, semi_axes.z * semi_axes.x, semi_axes.x * semi_axes.y};
  for (OverlapSurface::Nodes *const side : {&surface.of_a(), &surface.of_b()}) {
    side->change_pairs([&](OverlapSurface::Nodes::Pair &node) {
      node.at = scaled(semi_axes, node.at), node.area = scaled(areas, node.area);
    });
  }
  return surface.sum();
}

BallOnPolytope::Stretch BallOnPolytope::stretch_of(const Vertex &p, const Vertex &q) const {
  if (p.inside && q.inside) return {true, false, false, p.at, q.at};
  const Vec3 way = q.at - p.at;
  const double a = norm2(way), b = dot(p.at, way), c = norm2(p.at) - 1.0, free = b * b - a * c;
  if (p.inside || q.inside) {
    const double root = std::sqrt(std::max(0.0, free));
    // The root on the way out of p, or on that to q.
    const double part = p.inside ? (b > 0.0 ? -c / (b + root) : (root - b) / a) : (b < 0.0 ? c / (root - b) : (-b - root) / a);
    const Vec3 at = p.at + std::clamp(part, 0.0, 1.0) * way;
    return p.inside ? Stretch{true, false, true, p.at, at} : Stretch{true, true, false, at, q.at};
  }
  if (!(b < 0.0) || !(-b < a) || !(free > 0.0)) return {};
  const double far = std::sqrt(free) - b, first = c / far, last = far / a;
  if (!(first < last)) return {};
  return {true, true, true, p.at + std::max(0.0, first) * way, p.at + std::min(1.0, last) * way};
}

bool BallOnPolytope::holds(const Vec3 &at) const {
  return std::all_of(planes_.begin(), planes_.end(), [&](const Plane &plane) { return dot(plane.normal, at) <= plane.offset; });
}

bool BallOnPolytope::follow_face(std::size_t index, PlaneFan &fan) {
  const Plane &plane = planes_[index];
  const convex::Polytope::Face &face = polytope_->faces[index];
  const double radius = std::sqrt((1.0 - plane.offset) * (1.0 + plane.offset));
  const Vec3 along = convex::any_perpendicular(plane.normal), across = cross(plane.normal, along);
  const Vec3 center = plane.offset * plane.normal;
  passages_.clear();
  const auto pass = [&](const Vec3 &at, bool to_circle) {
    const double angle = std::atan2(dot(across, at), dot(along, at));
    passages_.add({radius * angle, angle, 0.0, to_circle});
  };
  for (std::int32_t i = face.first; i < face.first + face.count; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const std::int32_t edge = polytope_->face_edges[at];
    const bool forward = polytope_->edges[static_cast<std::size_t>(edge)].vertex[0] == polytope_->face_vertices[at];
    const Stretch &inside = stretches_[static_cast<std::size_t>(edge)];
    if (!inside.any) continue;
    const Vec3 &from = forward ? inside.from : inside.to, &to = forward ? inside.to : inside.from;
    fan.add_segment(from, to);
    if (forward ? inside.comes_in : inside.goes_out) pass(from, false);
    if (forward ? inside.goes_out : inside.comes_in) pass(to, true);
  }
  if (passages_.empty()) {
    // All of the circle borders, or nothing.
    const auto corner = [&](std::int32_t k) {
      return vertices_[static_cast<std::size_t>(polytope_->face_vertices[static_cast<std::size_t>(face.first + k)])].at;
    };
    if (!is_in_polygon(face.count, corner, plane.normal, center + radius * along)) return true;
    add_arc({center, radius * along, radius * across, 0.0, 2.0 * pi, &plane}, fan);
    return true;
  }
  while (!passages_.empty()) {
    Passages::Arc arc;
    if (!passages_.take_arc(rounding, arc)) return false;
    if (arc.empty) continue;
    const double turn = arc.to.angle - arc.from.angle + (arc.round ? 2.0 * pi : 0.0);
    if (turn > 0.0) add_arc({center, radius * along, radius * across, arc.from.angle, turn, &plane}, fan);
  }
  return true;
}

void BallOnPolytope::add_arc(Arc arc, PlaneFan &fan) {
  const double step = arc.turn / Arc::parts, by_cosine = std::cos(step), by_sine = std::sin(step);
  double cosine = std::cos(arc.from), sine = std::sin(arc.from);
  for (Vec3 &place : arc.sample) {
    place = arc.center + cosine * arc.along + sine * arc.across;
    const double next = by_cosine * cosine - by_sine * sine;
    sine = by_cosine * sine + by_sine * cosine, cosine = next;
  }
  arcs_.push_back(arc);
  visit_arc(arc, widest, 1.0, [&](const Vec3 &at, const Vec3 &step) { fan.add_curve_node(at, step); });
}

// The circle that the arcs keep nearest to, where that is nearer than great circles do, and well off its poles.
bool BallOnPolytope::find_band(Band &band) const {
  constexpr double most_width = 0.1, most_bend = 0.25;  // by the circle's distance from its pole; of the width by how far great circles bend
  double longest = 0.0, narrowest = HUGE_VAL;
  for (const Arc &arc : arcs_) longest = std::max(longest, std::min(arc.turn, pi) * norm(arc.along));
  for (const Arc &own : arcs_) {
    const Plane &plane = *own.plane;
    double width = 0.0;
    for (const Arc &arc : arcs_) {
      if (arc.plane == own.plane) continue;
      for (const Vec3 &at : arc.sample) width = std::max(width, std::fabs(dot(plane.normal, at) - plane.offset));
    }
    if (width < narrowest) narrowest = width, band = {&plane, norm(own.along)};
  }
  const double bend = 0.125 * longest * longest * std::fabs(band.plane->offset) / band.radius;
  return narrowest < most_width * band.radius * band.radius && narrowest < most_bend * bend && !holds(-band.plane->normal);
}

// With z along the circle's axis and the latitude l, an area is cos(l) dl by the angle about the axis: along each arc that from the circle to it.
void BallOnPolytope::add_band(const Band &band, const Vec3 &place, OverlapSurface::Nodes &nodes) const {
  constexpr double longest = 0.5;
  const Vec3 &axis = band.plane->normal;
  const double height = band.plane->offset;
  for (const Arc &arc : arcs_) {
    if (arc.plane == band.plane) continue;
    // All arcs are about as far from the axis as the circle.
    visit_arc(arc, longest, std::max(1.0, norm(arc.along) / band.radius), [&](const Vec3 &at, const Vec3 &step) {
      const Vec3 around = cross(axis, at);
      const double z = dot(axis, at), radius = norm(around);
      const double turn = dot(around, step) / (radius * radius);
      const double sine = z * band.radius - height * radius, cosine = z * height + radius * band.radius, angle = std::atan2(sine, cosine);
      if (angle == 0.0) return;
      const Vec3 out = (1.0 / radius) * cross(around, axis);
      const Vec3 start = band.radius * out + height * axis, ahead = band.radius * axis - height * out;
      const GaussNodes rule = rule_across(std::fabs(angle));
      const NodeTurns turns(rule, angle, cosine, sine);
      for (std::size_t k = 0; k < rule.count; ++k) {
        const Vec3 on_ball = turns.cosine[k] * start + turns.sine[k] * ahead;
        const double from_axis = turns.cosine[k] * band.radius - turns.sine[k] * height;
        nodes.add(on_ball - place, (rule.weight[k] * angle * from_axis * turn) * on_ball);
      }
    });
  }
}

void BallOnPolytope::add_ball_part(const Vec3 &place, OverlapSurface::Nodes &nodes) const {
  if (arcs_.empty()) {
    if (holds({1.0, 0.0, 0.0})) add_ball(place, nodes);
    return;
  }
  Band band;
  if (find_band(band)) {
    add_band(band, place, nodes);
    return;
  }
  // The antipode of the fan's place has to be off the arcs.
  Vec3 middle;
  double whole = 0.0;
  for (const Arc &arc : arcs_) {
    const double radius = norm(arc.along);
    const Vec3 inner =
        arc.turn == 2.0 * pi ? (-1.0 / (radius * radius)) * cross(arc.along, arc.across) : arc.sample[Arc::parts / 2];
    middle = middle + (radius * arc.turn) * inner;
    whole += radius * arc.turn;
  }
  const auto distance_of_antipode = [&](const Vec3 &start) {
    double least = pi;
    for (const Arc &arc : arcs_) {
      double nearest = -1.0;
      for (const Vec3 &at : arc.sample) nearest = std::max(nearest, -dot(start, at));
      least = std::min(least, std::acos(std::min(nearest, 1.0)) - 0.5 * (arc.turn / Arc::parts) * norm(arc.along));
    }
    return least;
  };
  constexpr double far_enough = 0.8;
  Vec3 start{1.0, 0.0, 0.0};
  double farthest = -1.0;
  const auto offer = [&](const Vec3 &direction) {
    if (farthest >= far_enough || !(norm2(direction) > 1e-6)) return;
    const Vec3 candidate = normalized(direction);
    const double far = distance_of_antipode(candidate);
    if (far > farthest) start = candidate, farthest = far;
  };
  offer((1.0 / whole) * middle);
  for (const double side : {1.0, -1.0}) offer({side, 0.0, 0.0}), offer({0.0, side, 0.0}), offer({0.0, 0.0, side});
  for (const double x : {1.0, -1.0}) {
    for (const double y : {1.0, -1.0}) offer({x, y, 1.0}), offer({x, y, -1.0});
  }
  // Nearer to the antipode the great circles' ways change faster.
  const double longest = std::min(widest, 0.5 * std::max(0.1, farthest));
  for (const Arc &arc : arcs_) {
    visit_arc(arc, longest, 1.0, [&](const Vec3 &at, const Vec3 &step) {
      const Vec3 turn = cross(start, at);
      const double sine = norm(turn), cosine = dot(start, at), angle = std::atan2(sine, cosine);
      if (!(sine > 0.0)) return;
      const double sweep = -dot(turn, step) / sine;  // clockwise about the ball's part, by the radius there
      const Vec3 ahead = cross((1.0 / sine) * turn, start);
      const GaussNodes rule = rule_across(angle);
      const NodeTurns turns(rule, angle, cosine, sine);
      for (std::size_t k = 0; k < rule.count; ++k) {
        const double here = turns.sine[k];
        const Vec3 on_ball = turns.cosine[k] * start + here * ahead;
        nodes.add(on_ball - place, (rule.weight[k] * angle * here / sine * sweep) * on_ball);
      }
    });
  }
  if (holds(-start)) add_ball(place, nodes);
}

}  // namespace cmb
