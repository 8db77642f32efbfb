#include "manifold/revolved/revolved_on_polytope.hpp"

#include <algorithm>
#include <cmath>

#include "math/gauss_rule.hpp"
#include "math/pi.hpp"

namespace cmb {

namespace {

using overlap::gauss_rule;
using overlap::GaussNodes;


double square(double x) { return x * x; }

// What is left of the way from p, inside, to q: both are not equal, and the mantle is between them.
double part_inside(const RevolvedBody &body, const Vec3 &p, const Vec3 &q) {
  const Vec3 way = q - p;
  const double growth = body.slope * way.z, at_p = body.radius_at(p.z);
  const double a = square(way.x) + square(way.y) - square(growth), b = p.x * way.x + p.y * way.y - at_p * growth;
  const double c = body.beyond_mantle(p), root = std::sqrt(std::max(0.0, b * b - a * c));
  const double part = b > 0.0 ? -c / (b + root) : (root - b) / a;
  return part >= 0.0 ? std::min(part, 1.0) : 0.0;
}

Vec3 between(const Vec3 &p, const Vec3 &q, double part) { return p + part * (q - p); }

// Where the line between p and q is at this height, which lies between theirs.
Vec3 at_height(const Vec3 &p, const Vec3 &q, double height) {
  Vec3 at = between(p, q, (height - p.z) / (q.z - p.z));
  at.z = height;
  return at;
}

// A rule that serves for curves through so great an angle. What is cut off by a chord is as deep as the angle's square, and that counts by
// its third power.
GaussNodes rule_for(double angle) {
  if (angle < 0.1) return GaussNodes(gauss_rule<5>);
  if (angle < 0.5) return GaussNodes(gauss_rule<6>);
  return GaussNodes(gauss_rule<8>);
}
constexpr double widest = 1.0;  // that one rule serves for

// The cosines' way from angle0 to angle1, and its slope, at the part of the turn between them. No angles of both signs.
void cosine_way(double angle0, double turn, double part, double &way, double &slope) {
  const double whole = std::sin(angle0 + 0.5 * turn) * std::sin(0.5 * turn);
  if (std::fabs(turn) < 1e-12 || whole == 0.0) {
    way = part, slope = 1.0;
    return;
  }
  way = std::sin(angle0 + 0.5 * part * turn) * std::sin(0.5 * part * turn) / whole;
  slope = 0.5 * turn * std::sin(angle0 + part * turn) / whole;
}

}  // namespace

bool RevolvedOnPolytope::find(const RevolvedBody &body, const ContactPolytope &polytope, const Pose &in_frame, const Vec3 &place,
                              OverlapSurface &surface) {
  body_ = &body, polytope_ = &polytope.geometry(), surface_ = &surface, in_frame_ = in_frame, place_ = place;
  surface.start(place);
  const std::size_t vertex_count = polytope_->vertices().size(), edge_count = polytope_->edges().size();
  if (vertices_.size() < vertex_count) vertices_.resize(vertex_count);
  if (edges_.size() < edge_count) edges_.resize(edge_count), edge_search_.resize(edge_count);
  if (++search_ == 0) {
    std::fill(edge_search_.begin(), edge_search_.end(), 0);
    search_ = 1;
  }
  for (std::size_t v = 0; v < vertex_count; ++v) {
    Vertex &vertex = vertices_[v];
    vertex.at = in_frame(polytope_->vertices()[v]);
    const Vec3 &p = vertex.at;
    const double radius = body.radius, diagonal = std::sqrt(2.0) * radius;
    vertex.beyond = (p.z < -body.half ? 1u : 0u) | (p.z > body.half ? 2u : 0u) | (p.x < -radius ? 4u : 0u) |
                    (p.x > radius ? 8u : 0u) | (p.y < -radius ? 16u : 0u) | (p.y > radius ? 32u : 0u) |
                    (p.x + p.y > diagonal ? 64u : 0u) | (p.x + p.y < -diagonal ? 128u : 0u) |
                    (p.x - p.y > diagonal ? 256u : 0u) | (p.x - p.y < -diagonal ? 512u : 0u);
    vertex.in_mantle = body.beyond_mantle(p) <= 0.0;
  }
  for (const End end : {base, top}) {
    end_[end] = {{0.0, 0.0, end == base ? -1.0 : 1.0}, body.half, &surface.of_a()};
    on_rim_[end].clear();
  }
  faces_.clear();
  planes_.clear();
  for (std::size_t f = 0; f < polytope_->faces().size(); ++f) {
    const convex::Polytope::Face &face = polytope_->faces()[f];
    std::uint32_t beyond = ~0u;
    for (std::int32_t i = face.first; i < face.first + face.count; ++i) {
      beyond &= vertices_[static_cast<std::size_t>(polytope_->face_vertices()[static_cast<std::size_t>(i)])].beyond;
    }
    if (beyond != 0) continue;
    const Vec3 normal = in_frame.rotation * face.normal;
    const double offset = face.offset + dot(normal, in_frame.translation);
    faces_.push_back(static_cast<std::int32_t>(f));
    planes_.push_back({normal, offset, &surface.of_b()});
  }
  for (std::size_t k = 0; k < faces_.size(); ++k) {
    if (!follow_face(static_cast<std::int32_t>(k))) return false;
  }
  if (!follow_rim(base) || !follow_rim(top)) return false;
  return surface.sum();
}

// Only of places that are not far from the overlap: beyond the polytope they are beyond a face that may bound it.
bool RevolvedOnPolytope::holds(const Vec3 &at) const {
  return std::all_of(planes_.begin(), planes_.end(), [&](const Plane &plane) { return dot(plane.normal, at) <= plane.offset; });
}

RevolvedOnPolytope::Stretch RevolvedOnPolytope::in_mantle(const Vec3 &p, bool p_inside, const Vec3 &q, bool q_inside) const {
  if (p_inside && q_inside) return {true, false, false, p, q};
  if (p_inside) return {true, false, true, p, between(p, q, part_inside(*body_, p, q))};
  if (q_inside) return {true, true, false, between(q, p, part_inside(*body_, q, p)), q};
  const Vec3 way = q - p;
  const double growth = body_->slope * way.z;
  const double a = square(way.x) + square(way.y) - square(growth);
  const double b = p.x * way.x + p.y * way.y - body_->radius_at(p.z) * growth;
  if (!(a > 0.0) || !(b < 0.0) || !(-b < a)) return {};
  const double c = body_->beyond_mantle(p), free = b * b - a * c;
  if (!(free > 0.0)) return {};
  const double far = std::sqrt(free) - b, first = c / far, last = far / a;
  if (!(first < last)) return {};
  return {true, true, true, between(p, q, std::max(0.0, first)), between(p, q, std::min(1.0, last))};
}

const RevolvedOnPolytope::EdgePart &RevolvedOnPolytope::part_of(std::int32_t edge) {
  const auto index = static_cast<std::size_t>(edge);
  EdgePart &part = edges_[index];
  if (edge_search_[index] == search_) return part;
  edge_search_[index] = search_;
  const std::int32_t *const vertex = polytope_->edges()[index].vertex;
  const Vertex &v = vertices_[static_cast<std::size_t>(vertex[0])], &w = vertices_[static_cast<std::size_t>(vertex[1])];
  part.between = (v.beyond & w.beyond & 3u) == 0;
  if (!part.between) {
    part.inside = {};
    return part;
  }
  const auto cut = [&](const Vertex &vertex_beyond, Vec3 &at, bool &inside) {
    at = vertex_beyond.at, inside = vertex_beyond.in_mantle;
    if ((vertex_beyond.beyond & 3u) == 0) return;
    at = at_height(v.at, w.at, height_of((vertex_beyond.beyond & 1u) != 0 ? base : top));
    inside = body_->beyond_mantle(at) <= 0.0;
  };
  cut(v, part.from, part.from_in_mantle);
  cut(w, part.to, part.to_in_mantle);
  part.inside = (v.beyond & w.beyond) == 0 ? in_mantle(part.from, part.from_in_mantle, part.to, part.to_in_mantle) : Stretch{};
  return part;
}

RevolvedOnPolytope::Conic RevolvedOnPolytope::conic_of(const Plane &plane) const {
  Conic conic;
  const Vec3 &n = plane.normal;
  conic.radial = std::sqrt(n.x * n.x + n.y * n.y);
  conic.axial = n.z, conic.offset = plane.offset;
  conic.along = conic.radial > 1e-14 ? Vec3{n.x / conic.radial, n.y / conic.radial, 0.0} : Vec3{1.0, 0.0, 0.0};
  conic.across = {-conic.along.y, conic.along.x, 0.0};
  // A cone's apex in the plane counts as within the polytope, as for holds().
  conic.sense = (body_->is_cylinder() ? n.z >= 0.0 : n.z * body_->half > plane.offset) ? 1.0 : -1.0;
  if (!find_height(conic, 1.0, conic.height)) conic.height = -body_->half;
  conic.height = std::clamp(conic.height, -body_->half, body_->half);
  return conic;
}

// False where there is none, on a cone on its own side of the apex.
bool RevolvedOnPolytope::find_height(const Conic &conic, double cosine, double &height) const {
  if (body_->is_cylinder()) {
    height = (conic.offset - conic.radial * body_->radius * cosine) / conic.axial;
    return conic.axial != 0.0;
  }
  const double above = conic.axial * body_->half - conic.offset, growth = -conic.radial * body_->slope * cosine - conic.axial;
  height = body_->half + above / growth;
  return above > 0.0 ? growth < 0.0 : growth > 0.0;
}

RevolvedOnPolytope::Passage RevolvedOnPolytope::passage(const Conic &conic, const Vec3 &at, bool to_curve) const {
  const double angle = std::atan2(dot(conic.across, at), dot(conic.along, at));
  // Where the plane is as good as parallel to the axis the height tells how far along the conic a place is; elsewhere both do.
  const double key = conic.sense * body_->radius * angle + std::copysign(at.z - conic.height, at.z >= conic.height ? angle : -angle);
  return {key, angle, at.z, to_curve};
}

// Takes out of the passages that at which the curve that begins with `from` ends. `round`: it passes where keys begin.
bool RevolvedOnPolytope::next_passage(std::vector<Passage> &passages, const Passage &from, Passage &next, bool &round) const {
  const double size = body_->radius + body_->half, rounding = 1e-12 * size, whole = 16.0 * size;
  std::size_t best = passages.size();
  double nearest = HUGE_VAL;
  for (std::size_t k = 0; k < passages.size(); ++k) {
    if (passages[k].to_curve) continue;
    double way = passages[k].key - from.key;
    const bool passes = way < -rounding;
    if (passes) way += whole;
    if (way < nearest) nearest = way, best = k, round = passes;
  }
  if (best == passages.size()) return false;
  next = passages[best];
  passages[best] = passages.back();
  passages.pop_back();
  return true;
}

bool RevolvedOnPolytope::follow_face(std::int32_t index) {
  Plane &plane = planes_[static_cast<std::size_t>(index)];
  const convex::Polytope::Face &face =
      polytope_->faces()[static_cast<std::size_t>(faces_[static_cast<std::size_t>(index)])];
  const Conic conic = conic_of(plane);
  on_conic_.clear();
  struct Crossing {
    const EdgePart *part = nullptr;
    bool forward = true;
  };
  Crossing leaving[ends], coming[ends];
  for (std::int32_t i = face.first; i < face.first + face.count; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const std::int32_t v = polytope_->face_vertices()[at], edge = polytope_->face_edges()[at];
    const std::int32_t *const vertex = polytope_->edges()[static_cast<std::size_t>(edge)].vertex;
    const bool forward = vertex[0] == v;
    const std::uint32_t here = vertices_[static_cast<std::size_t>(v)].beyond;
    const std::uint32_t there = vertices_[static_cast<std::size_t>(vertex[forward ? 1 : 0])].beyond;
    const EdgePart &part = part_of(edge);
    for (const End end : {base, top}) {
      const std::uint32_t bit = end == base ? 1u : 2u;
      if ((here & bit) == 0 && (there & bit) != 0) leaving[end] = {&part, forward};
      if ((here & bit) != 0 && (there & bit) == 0) coming[end] = {&part, forward};
    }
    const Stretch &inside = part.inside;
    if (!inside.any) continue;
    const Vec3 &from = forward ? inside.from : inside.to, &to = forward ? inside.to : inside.from;
    add_segment(from, to, plane);
    if (forward ? inside.comes_in : inside.goes_out) on_conic_.push_back(passage(conic, from, false));
    if (forward ? inside.goes_out : inside.comes_in) on_conic_.push_back(passage(conic, to, true));
  }
  for (const End end : {base, top}) {
    if (leaving[end].part == nullptr || coming[end].part == nullptr) continue;
    add_chord(*leaving[end].part, leaving[end].forward, *coming[end].part, coming[end].forward, end, plane, conic);
  }
  return follow_conic(plane, conic, index);
}

// The border between a face and an end: from where the face's border leaves the ends to where it comes back.
void RevolvedOnPolytope::add_chord(const EdgePart &leaving, bool leaving_forward, const EdgePart &coming, bool coming_forward, End end,
                                   Plane &plane, const Conic &conic) {
  const Vec3 &from = leaving_forward ? leaving.to : leaving.from, &to = coming_forward ? coming.from : coming.to;
  const bool from_inside = leaving_forward ? leaving.to_in_mantle : leaving.from_in_mantle;
  const bool to_inside = coming_forward ? coming.from_in_mantle : coming.to_in_mantle;
  const Stretch chord = in_mantle(from, from_inside, to, to_inside);
  if (!chord.any) return;
  add_segment(chord.from, chord.to, plane);
  add_segment(chord.to, chord.from, end_[end]);
  const auto on_rim = [&](const Vec3 &at, bool to_curve) {
    const double angle = std::atan2(at.y, at.x);
    on_rim_[end].push_back({(end == top ? body_->radius : -body_->radius) * angle, angle, at.z, to_curve});
  };
  if (chord.comes_in) on_conic_.push_back(passage(conic, chord.from, false)), on_rim(chord.from, true);
  if (chord.goes_out) on_conic_.push_back(passage(conic, chord.to, true)), on_rim(chord.to, false);
}

bool RevolvedOnPolytope::follow_conic(Plane &plane, const Conic &conic, std::int32_t index) {
  const double sense = conic.sense;
  double at_front = 0.0, at_back = 0.0;  // heights at angle 0 and on the other side
  const bool has_front = find_height(conic, 1.0, at_front), has_back = find_height(conic, -1.0, at_back);
  if (on_conic_.empty()) {
    // All of it or nothing.
    const auto is_between = [this](double height) { return std::fabs(height) <= body_->half; };
    if (!has_front || !has_back || !is_between(at_front) || !is_between(at_back)) return true;
    const Vec3 at = body_->radius_at(at_front) * conic.along + Vec3{0.0, 0.0, at_front};
    const convex::Polytope::Face &face =
        polytope_->faces()[static_cast<std::size_t>(faces_[static_cast<std::size_t>(index)])];
    for (std::int32_t i = 0; i < face.count; ++i) {
      const std::int32_t *const corner = polytope_->face_vertices().data() + face.first;
      const Vec3 &p = vertices_[static_cast<std::size_t>(corner[i])].at;
      const Vec3 &q = vertices_[static_cast<std::size_t>(corner[i + 1 < face.count ? i + 1 : 0])].at;
      if (dot(cross(q - p, at - p), plane.normal) < 0.0) return true;
    }
    add_arc(plane, conic, -sense * pi, at_back, 0.0, at_front);
    add_arc(plane, conic, 0.0, at_front, sense * pi, at_back);
    return true;
  }
  const double rounding = 1e-12 * (body_->radius + body_->half);
  while (!on_conic_.empty()) {
    std::size_t first = 0;
    while (first < on_conic_.size() && !on_conic_[first].to_curve) ++first;
    if (first == on_conic_.size()) return false;
    const Passage from = on_conic_[first];
    on_conic_[first] = on_conic_.back();
    on_conic_.pop_back();
    Passage to;
    bool round = false;
    if (!next_passage(on_conic_, from, to, round)) return false;
    if (!round && to.key - from.key <= rounding) continue;
    double angle = from.angle, height = from.height;
    const auto go = [&](double to_angle, double to_height) {
      add_arc(plane, conic, angle, height, to_angle, to_height);
      angle = to_angle, height = to_height;
    };
    // By way of the places where the height turns.
    if (round) {
      if (sense * angle < 0.0) {
        if (!has_front) return false;
        go(0.0, at_front);
      }
      if (!has_back) return false;
      go(sense * pi, at_back);
      angle = -sense * pi;
    }
    if (sense * angle < 0.0 && sense * to.angle > 0.0) {
      if (!has_front) return false;
      go(0.0, at_front);
    }
    go(to.angle, to.height);
  }
  return true;
}

bool RevolvedOnPolytope::follow_rim(End end) {
  Plane &plane = end_[end];
  const double height = height_of(end), sense = end == top ? 1.0 : -1.0;
  std::vector<Passage> &passages = on_rim_[end];
  if (passages.empty()) {
    const double radius = end == top && !body_->is_cylinder() ? 0.0 : body_->radius;
    if (holds({radius, 0.0, height})) add_rim(plane, height, 0.0, sense * 2.0 * pi);
    return true;
  }
  const double rounding = 1e-12 * (body_->radius + body_->half);
  while (!passages.empty()) {
    std::size_t first = 0;
    while (first < passages.size() && !passages[first].to_curve) ++first;
    if (first == passages.size()) return false;
    const Passage from = passages[first];
    passages[first] = passages.back();
    passages.pop_back();
    Passage to;
    bool round = false;
    if (!next_passage(passages, from, to, round)) return false;
    if (!round && to.key - from.key <= rounding) continue;
    add_rim(plane, height, from.angle, to.angle - from.angle + (round ? sense * 2.0 * pi : 0.0));
  }
  return true;
}

// A triangle of the fan, by the rule of seven places that is exact to the fifth degree (Radon 1948).
void RevolvedOnPolytope::add_segment(const Vec3 &from, const Vec3 &to, Plane &plane) const {
  if (!plane.has_apex) plane.apex = from, plane.has_apex = true;
  const Vec3 p = from - plane.apex, q = to - plane.apex, apex = plane.apex - place_;
  const double area = 0.5 * dot(plane.normal, cross(p, q));
  constexpr struct {
    double weight, near;
  } rule[2] = {{0.125939180544827153, 0.101286507323456339}, {0.132394152788506181, 0.470142064105115090}};
  plane.nodes->push_back({apex + (1.0 / 3.0) * (p + q), (0.225 * area) * plane.normal});
  for (const auto &node : rule) {
    const double far = 1.0 - 2.0 * node.near;
    const Vec3 part = (node.weight * area) * plane.normal;
    plane.nodes->push_back({apex + node.near * (p + q), part});
    plane.nodes->push_back({apex + far * p + node.near * q, part});
    plane.nodes->push_back({apex + node.near * p + far * q, part});
  }
}

// A place of a curve on the mantle that runs counter-clockwise about the plane: `outward` (unit) points there from the axis, `step` is its
// way by the rule's weight, `turn` that of its angle about the axis. About the mantle it runs clockwise.
void RevolvedOnPolytope::add_curve_node(const Vec3 &outward, double height, const Vec3 &step, double turn, Plane &plane) {
  const double radius = body_->radius_at(height);
  const Vec3 at{radius * outward.x, radius * outward.y, height};
  if (!plane.has_apex) plane.apex = at, plane.has_apex = true;
  const Vec3 way = at - plane.apex, apex = plane.apex - place_;
  const double area = dot(plane.normal, cross(way, step));
  const auto &rule = gauss_rule<4>;
  for (std::size_t k = 0; k < 4; ++k) {
    const double part = rule.node[k];
    plane.nodes->push_back({apex + part * way, (rule.weight[k] * part * area) * plane.normal});
  }
  const double rise = height - place_.z;
  const GaussNodes heights = body_->is_cylinder() ? GaussNodes(gauss_rule<3>) : GaussNodes(gauss_rule<4>);
  for (std::size_t k = 0; k < heights.count; ++k) {
    const double z = heights.node[k] * rise, r = body_->radius_at(place_.z + z), part = turn * rise * heights.weight[k] * r;
    surface_->of_a().push_back(
        {{r * outward.x - place_.x, r * outward.y - place_.y, z}, {part * outward.x, part * outward.y, -part * body_->slope}});
  }
}

void RevolvedOnPolytope::add_rim(Plane &plane, double height, double from, double turn) {
  const int parts = 1 + static_cast<int>(std::fabs(turn) / widest);
  const double width = turn / parts, radius = body_->radius_at(height);
  const GaussNodes rule = rule_for(std::fabs(width));
  for (int part = 0; part < parts; ++part) {
    for (std::size_t k = 0; k < rule.count; ++k) {
      const double angle = from + width * (part + rule.node[k]), step = width * rule.weight[k];
      const double cosine = std::cos(angle), sine = std::sin(angle), way = radius * step;
      add_curve_node({cosine, sine, 0.0}, height, {-way * sine, way * cosine, 0.0}, step, plane);
    }
  }
}

// A conic's part where its angle keeps its sign and its height grows or falls.
void RevolvedOnPolytope::add_arc(Plane &plane, const Conic &conic, double angle0, double height0, double angle1, double height1) {
  const double turn = angle1 - angle0;
  const auto visit = [&](double angle, double height, double turn_step, double rise_step) {
    const double radius = body_->radius_at(height), cosine = std::cos(angle), sine = std::sin(angle);
    const Vec3 outward = cosine * conic.along + sine * conic.across, around = cosine * conic.across - sine * conic.along;
    Vec3 step = (radius * turn_step) * around + (body_->slope * rise_step) * outward;
    step.z = rise_step;
    add_curve_node(outward, height, step, turn_step, plane);
  };
  if (body_->is_cylinder()) {
    const int parts = 1 + static_cast<int>(std::fabs(turn) / widest);
    const GaussNodes rule = rule_for(std::fabs(turn) / parts);
    for (int part = 0; part < parts; ++part) {
      for (std::size_t k = 0; k < rule.count; ++k) {
        const double along = (part + rule.node[k]) / parts, weight = rule.weight[k] / parts;
        double way, slope;
        cosine_way(angle0, turn, along, way, slope);
        visit(angle0 + along * turn, height0 + way * (height1 - height0), weight * turn, weight * slope * (height1 - height0));
      }
    }
    return;
  }
  // The inverse of how far a cone's place is below the apex is linear in the cosine. Parts in which that hardly changes.
  const double least = 1e-7 * body_->half;
  const double down0 = std::max(body_->half - height0, least), down1 = std::max(body_->half - height1, least);
  const GaussNodes rule(gauss_rule<8>);
  if (std::fabs(turn) < 1e-9) {  // a straight line, as good as
    for (std::size_t k = 0; k < rule.count; ++k) {
      const double part = rule.node[k];
      visit(angle0 + part * turn, height0 + part * (height1 - height0), rule.weight[k] * turn, rule.weight[k] * (height1 - height0));
    }
    return;
  }
  const double inverse0 = 1.0 / down0, inverse1 = 1.0 / down1, ratio = down1 / down0;
  constexpr double most_ratio = 2.0;
  const int parts = 1 + static_cast<int>(std::max(std::fabs(turn) / widest, std::fabs(std::log(ratio)) / std::log(most_ratio)));
  const double cosine0 = std::cos(angle0), cosine1 = std::cos(angle1);
  double from = angle0, from_inverse = inverse0;
  for (int part = 0; part < parts; ++part) {
    double to = angle1, to_inverse = inverse1;
    if (part + 1 < parts) {
      if (std::fabs(turn) / widest > std::fabs(std::log(ratio)) / std::log(most_ratio)) {
        double slope;
        to = angle0 + turn * (part + 1) / parts;
        cosine_way(angle0, turn, static_cast<double>(part + 1) / parts, to_inverse, slope);
        to_inverse = inverse0 + to_inverse * (inverse1 - inverse0);
      } else {
        to_inverse = inverse0 * std::pow(ratio, -static_cast<double>(part + 1) / parts);
        const double way = (to_inverse - inverse0) / (inverse1 - inverse0);
        to = std::copysign(std::acos(std::clamp(cosine0 + way * (cosine1 - cosine0), -1.0, 1.0)), angle0 + angle1);
      }
    }
    const double part_turn = to - from;
    for (std::size_t k = 0; k < rule.count; ++k) {
      double way, slope;
      cosine_way(from, part_turn, rule.node[k], way, slope);
      const double down = 1.0 / (from_inverse + way * (to_inverse - from_inverse));
      visit(from + rule.node[k] * part_turn, body_->half - down, rule.weight[k] * part_turn,
            rule.weight[k] * slope * (to_inverse - from_inverse) * down * down);
    }
    from = to, from_inverse = to_inverse;
  }
}

}  // namespace cmb
