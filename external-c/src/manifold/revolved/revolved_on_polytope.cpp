#include "manifold/revolved/revolved_on_polytope.hpp"

#include <algorithm>
#include <cmath>

#include "manifold/revolved/face_polygon.hpp"
#include "math/pi.hpp"

namespace cmb {

namespace {

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

}  // namespace

bool RevolvedOnPolytope::find(const RevolvedBody &body, const convex::PolytopeView &polytope, const Pose &in_frame, const Vec3 &place,
                              OverlapSurface &surface) {
  body_ = &body, polytope_ = &polytope;
  const std::size_t vertex_count = polytope_->vertices.size(), edge_count = polytope_->edges.size();
  if (vertices_.size() < vertex_count) vertices_.resize(vertex_count);
  if (edges_.size() < edge_count) edges_.resize(edge_count), edge_search_.resize(edge_count);
  if (++search_ == 0) {
    std::fill(edge_search_.begin(), edge_search_.end(), 0);
    search_ = 1;
  }
  beyond_any_ = 0;
  for (std::size_t v = 0; v < vertex_count; ++v) {
    Vertex &vertex = vertices_[v];
    vertex.at = in_frame(polytope_->vertices[v]);
    const Vec3 &p = vertex.at;
    const double radius = body.radius, diagonal = std::sqrt(2.0) * radius;
    vertex.beyond = (p.z < -body.half ? 1u : 0u) | (p.z > body.half ? 2u : 0u) | (p.x < -radius ? 4u : 0u) |
                    (p.x > radius ? 8u : 0u) | (p.y < -radius ? 16u : 0u) | (p.y > radius ? 32u : 0u) |
                    (p.x + p.y > diagonal ? 64u : 0u) | (p.x + p.y < -diagonal ? 128u : 0u) |
                    (p.x - p.y > diagonal ? 256u : 0u) | (p.x - p.y < -diagonal ? 512u : 0u);
    vertex.in_mantle = body.beyond_mantle(p) <= 0.0;
    beyond_any_ |= vertex.beyond;
  }
  faces_.clear();
  planes_.clear();
  for (std::size_t f = 0; f < polytope_->faces.size(); ++f) {
    const convex::Polytope::Face &face = polytope_->faces[f];
    std::uint32_t beyond = ~0u;
    for (std::int32_t i = face.first; i < face.first + face.count; ++i) {
      beyond &= vertices_[static_cast<std::size_t>(polytope_->face_vertices[static_cast<std::size_t>(i)])].beyond;
    }
    if (beyond != 0) continue;
    const Vec3 normal = in_frame.rotation * face.normal;
    const double offset = face.offset + dot(normal, in_frame.translation);
    faces_.push_back(static_cast<std::int32_t>(f));
    planes_.push_back({offset, {normal, place, offset - dot(normal, place), surface.of_b()}});
  }
  const Vec3 apex{0.0, 0.0, body.half};
  const bool to_apex = !body.is_cylinder() && holds(apex, in_frame);
  const bool found = integrate(in_frame, place, to_apex, surface);
  // Where the border as good as turns in an apex that is outside, more than the overlap's is added and taken off: so much counts by rounding.
  constexpr double cancels = 3.0;
  const double area = surface.area_a();
  if (body.is_cylinder() || to_apex || !(area > cancels * surface.area_b()) || !has_near(apex, body.near_apex(), in_frame)) return found;
  const bool found_from_apex = integrate(in_frame, place, true, surface);
  return surface.area_a() < area ? found_from_apex : integrate(in_frame, place, false, surface);
}

bool RevolvedOnPolytope::integrate(const Pose &in_frame, const Vec3 &place, bool to_apex, OverlapSurface &surface) {
  surface.start(place);
  for (Plane &plane : planes_) plane.fan = {plane.fan.normal(), place, plane.offset - dot(plane.fan.normal(), place), surface.of_b()};
  Mantle mantle(*body_, {}, place, to_apex, Mantle::Partner::polytope, border_, surface.of_a());
  PlaneFan end_fan[ends] = {{{0.0, 0.0, -1.0}, place, body_->half + place.z, surface.of_a()},
                            {{0.0, 0.0, 1.0}, place, body_->half - place.z, surface.of_a()}};
  for (const End end : {base, top}) rim_[end].start(mantle, end);
  for (std::size_t k = 0; k < faces_.size(); ++k) {
    if (!follow_face(static_cast<std::int32_t>(k), mantle, end_fan)) return false;
  }
  const auto in_polytope = [&](const Vec3 &at) { return holds(at, in_frame); };
  for (const End end : {base, top}) {
    // What does not reach beyond an end does not hold its rim, which rounding may deny where a face lies in the end.
    if ((beyond_any_ & bit_of(end)) != 0 && !rim_[end].follow(end_fan[end], in_polytope)) return false;
  }
  mantle.integrate();
  return surface.sum();
}

// First the faces that may bound the overlap, which most places outside are beyond. They decide alone, as for a conic's way about a cone's
// apex: what another frame's rounding says of them would not fit that.
bool RevolvedOnPolytope::holds(const Vec3 &at, const Pose &in_frame) const {
  for (const Plane &plane : planes_) {
    if (dot(plane.fan.normal(), at) > plane.offset) return false;
  }
  const Vec3 local = transposed_times(in_frame.rotation, at - in_frame.translation);
  auto decided = faces_.begin();
  for (std::size_t f = 0; f < polytope_->faces.size(); ++f) {
    if (decided != faces_.end() && static_cast<std::size_t>(*decided) == f) {
      ++decided;
    } else if (dot(polytope_->faces[f].normal, local) > polytope_->faces[f].offset) {
      return false;
    }
  }
  return true;
}

bool RevolvedOnPolytope::has_near(const Vec3 &at, double margin, const Pose &in_frame) const {
  for (const Plane &plane : planes_) {
    if (dot(plane.fan.normal(), at) > plane.offset + margin) return false;
  }
  const Vec3 local = transposed_times(in_frame.rotation, at - in_frame.translation);
  return std::all_of(polytope_->faces.begin(), polytope_->faces.end(),
                     [&](const convex::Polytope::Face &face) { return dot(face.normal, local) <= face.offset + margin; });
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
  // From the middle of what is inside: from afar rounding would count as the square of the way there.
  const double half_way = -b / a;
  const Vec3 middle = between(p, q, half_way);
  const double rest = middle.x * way.x + middle.y * way.y - body_->radius_at(middle.z) * growth;
  const double free = rest * rest - a * body_->beyond_mantle(middle);
  if (!(free > 0.0)) return {};
  const double half = std::sqrt(free), first = (-rest - half) / a, last = (half - rest) / a;
  if (!(first < last)) return {};
  const auto place = [&](double part) {
    if (half_way + part <= 0.0) return p;
    return half_way + part >= 1.0 ? q : middle + part * way;
  };
  return {true, true, true, place(first), place(last)};
}

const RevolvedOnPolytope::EdgePart &RevolvedOnPolytope::part_of(std::int32_t edge) {
  const auto index = static_cast<std::size_t>(edge);
  EdgePart &part = edges_[index];
  if (edge_search_[index] == search_) return part;
  edge_search_[index] = search_;
  const std::int32_t *const vertex = polytope_->edges[index].vertex;
  const Vertex &v = vertices_[static_cast<std::size_t>(vertex[0])], &w = vertices_[static_cast<std::size_t>(vertex[1])];
  part.between = (v.beyond & w.beyond & 3u) == 0;
  if (!part.between) {
    part.inside = {};
    return part;
  }
  const auto cut = [&](const Vertex &vertex_beyond, Vec3 &at, bool &inside) {
    at = vertex_beyond.at, inside = vertex_beyond.in_mantle;
    if ((vertex_beyond.beyond & 3u) == 0) return;
    const End end = (vertex_beyond.beyond & bit_of(base)) != 0 ? base : top;
    at = at_height(v.at, w.at, height_of(end));
    inside = !is_apex(end) && body_->beyond_mantle(at) <= 0.0;
  };
  cut(v, part.from, part.from_in_mantle);
  cut(w, part.to, part.to_in_mantle);
  part.inside = (v.beyond & w.beyond) == 0 ? in_mantle(part.from, part.from_in_mantle, part.to, part.to_in_mantle) : Stretch{};
  return part;
}

bool RevolvedOnPolytope::follow_face(std::int32_t index, Mantle &mantle, PlaneFan *end_fan) {
  Plane &plane = planes_[static_cast<std::size_t>(index)];
  const convex::Polytope::Face &face =
      polytope_->faces[static_cast<std::size_t>(faces_[static_cast<std::size_t>(index)])];
  section_.start(mantle, plane.fan.normal(), plane.offset);
  struct Crossing {
    const EdgePart *part = nullptr;
    bool forward = true;
  };
  Crossing leaving[ends], coming[ends];
  for (std::int32_t i = face.first; i < face.first + face.count; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const std::int32_t v = polytope_->face_vertices[at], edge = polytope_->face_edges[at];
    const std::int32_t *const vertex = polytope_->edges[static_cast<std::size_t>(edge)].vertex;
    const bool forward = vertex[0] == v;
    const std::uint32_t here = vertices_[static_cast<std::size_t>(v)].beyond;
    const std::uint32_t there = vertices_[static_cast<std::size_t>(vertex[forward ? 1 : 0])].beyond;
    const EdgePart &part = part_of(edge);
    for (const End end : {base, top}) {
      const std::uint32_t bit = bit_of(end);
      if ((here & bit) == 0 && (there & bit) != 0) leaving[end] = {&part, forward};
      if ((here & bit) != 0 && (there & bit) == 0) coming[end] = {&part, forward};
    }
    const Stretch &inside = part.inside;
    if (!inside.any) continue;
    const Vec3 &from = forward ? inside.from : inside.to, &to = forward ? inside.to : inside.from;
    plane.fan.add_segment(from, to);
    if (forward ? inside.comes_in : inside.goes_out) section_.add_passage(from, false);
    if (forward ? inside.goes_out : inside.comes_in) section_.add_passage(to, true);
  }
  for (const End end : {base, top}) {
    if (is_apex(end) || leaving[end].part == nullptr || coming[end].part == nullptr) continue;
    add_chord(*leaving[end].part, leaving[end].forward, *coming[end].part, coming[end].forward, end, plane.fan, end_fan[end]);
  }
  return section_.follow(plane.fan, [&](const Vec3 &at) { return is_in_face(index, at); });
}

// The border between a face and an end: from where the face's border leaves the ends to where it comes back.
void RevolvedOnPolytope::add_chord(const EdgePart &leaving, bool leaving_forward, const EdgePart &coming, bool coming_forward, End end,
                                   PlaneFan &face_fan, PlaneFan &end_fan) {
  const Vec3 &from = leaving_forward ? leaving.to : leaving.from, &to = coming_forward ? coming.from : coming.to;
  const bool from_inside = leaving_forward ? leaving.to_in_mantle : leaving.from_in_mantle;
  const bool to_inside = coming_forward ? coming.from_in_mantle : coming.to_in_mantle;
  const Stretch chord = in_mantle(from, from_inside, to, to_inside);
  if (!chord.any) return;
  face_fan.add_segment(chord.from, chord.to);
  end_fan.add_segment(chord.to, chord.from);
  if (chord.comes_in) section_.add_passage(chord.from, false), rim_[end].add_passage(chord.from, true);
  if (chord.goes_out) section_.add_passage(chord.to, true), rim_[end].add_passage(chord.to, false);
}

bool RevolvedOnPolytope::is_in_face(std::int32_t index, const Vec3 &at) const {
  const convex::Polytope::Face &face = polytope_->faces[static_cast<std::size_t>(faces_[static_cast<std::size_t>(index)])];
  const std::int32_t *const corner = polytope_->face_vertices.data() + face.first;
  const Vec3 &normal = planes_[static_cast<std::size_t>(index)].fan.normal();
  return is_in_polygon(face.count, [&](std::int32_t k) { return vertices_[static_cast<std::size_t>(corner[k])].at; }, normal, at);
}

}  // namespace cmb
