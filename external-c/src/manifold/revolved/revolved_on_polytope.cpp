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

// Of a ball: wholly beyond an end, wholly beyond a plane along the mantle, in part beyond an end.
constexpr std::uint64_t ball_below = 1, ball_above = 2, ball_beside = 4, ball_reaches_below = 8, ball_reaches_above = 16;

// By more than rounding. Arrays that do not overlap, so that compilers make vectors of them.
void look_at_balls(const RevolvedBody &body, const Pose &in_frame, std::size_t count, const double *__restrict x, const double *__restrict y,
                   const double *__restrict z, const double *__restrict radius, std::uint64_t *__restrict found) {
  const double margin = 1e-9 * (body.radius + body.half), widened = 1.0 + 1e-9, half = body.half, by_across = 1.0 / body.across;
  const double at_origin = body.radius_at(0.0), slope = body.slope;
  const Vec3 row_x = in_frame.rotation.row[0], row_y = in_frame.rotation.row[1], row_z = in_frame.rotation.row[2], shift = in_frame.translation;
  for (std::size_t g = 0; g < count; ++g) {
    const double px = row_x.x * x[g] + row_x.y * y[g] + row_x.z * z[g] + shift.x;
    const double py = row_y.x * x[g] + row_y.y * y[g] + row_y.z * z[g] + shift.y;
    const double pz = row_z.x * x[g] + row_z.y * y[g] + row_z.z * z[g] + shift.z;
    const double ball = widened * radius[g] + margin, reach = at_origin + slope * pz + ball * by_across;
    const double beside = reach < 0.0 ? 1.0 : px * px + py * py - reach * reach;
    found[g] = (pz < -half - ball ? ball_below : 0) | (pz > half + ball ? ball_above : 0) | (beside > 0.0 ? ball_beside : 0) |
               (pz < ball - half ? ball_reaches_below : 0) | (pz > half - ball ? ball_reaches_above : 0);
  }
}

}  // namespace

bool RevolvedOnPolytope::find(const RevolvedBody &body, const convex::PolytopeView &polytope, const Pose &in_frame, const Vec3 &place,
                              OverlapSurface &surface, Mantle::Partner partner, bool from_apex) {
  body_ = &body, polytope_ = &polytope, partner_ = partner;
  find_faces(in_frame, place, surface);
  const bool to_apex = !body.is_cylinder() && (from_apex || holds({0.0, 0.0, body.half}, in_frame));
  return integrate(in_frame, place, to_apex, surface);
}

void RevolvedOnPolytope::find_faces(const Pose &in_frame, const Vec3 &place, OverlapSurface &surface) {
  constexpr std::size_t few_groups = 8;
  const std::size_t vertex_count = polytope_->vertices.size(), edge_count = polytope_->edges.size();
  if (vertices_.size() < vertex_count) vertices_.resize(vertex_count), vertex_search_.resize(vertex_count);
  if (edges_.size() < edge_count) edges_.resize(edge_count), edge_search_.resize(edge_count);
  if (++search_ == 0) {
    for (std::vector<std::uint32_t> *const searches : {&vertex_search_, &edge_search_}) std::fill(searches->begin(), searches->end(), 0);
    search_ = 1;
  }
  beyond_any_ = 0;
  faces_.clear();
  if (polytope_->clusters != nullptr && polytope_->clusters->count() > few_groups) {
    find_faces_by_groups(*polytope_->clusters, in_frame);
    std::sort(faces_.begin(), faces_.end());
  } else {
    for (std::size_t f = 0; f < polytope_->faces.size(); ++f) offer_face(static_cast<std::int32_t>(f), in_frame);
  }
  planes_.clear();
  for (const std::int32_t f : faces_) {
    const convex::Polytope::Face &face = polytope_->faces[static_cast<std::size_t>(f)];
    const Vec3 normal = in_frame.rotation * face.normal;
    const double offset = face.offset + dot(normal, in_frame.translation);
    planes_.push_back({offset, {normal, place, offset - dot(normal, place), surface.of_b()}});
  }
}

// Groups of faces that a plane parts from the body need no look at their faces, but where some of their vertices may decide what reaches
// beyond an end.
void RevolvedOnPolytope::find_faces_by_groups(const FaceClusters &clusters, const Pose &in_frame) {
  const std::size_t count = clusters.count();
  if (groups_.size() < count) groups_.resize(count);
  look_at_balls(*body_, in_frame, count, clusters.ball_centers(0), clusters.ball_centers(1), clusters.ball_centers(2), clusters.ball_radii(),
                groups_.data());
  for (std::size_t g = 0; g < count; ++g) {
    if ((groups_[g] & (ball_below | ball_above | ball_beside)) == 0) {
      for (const std::int32_t f : clusters.faces(g)) offer_face(f, in_frame);
    }
    beyond_any_ |= ((groups_[g] & ball_below) != 0 ? bit_of(base) : 0u) | ((groups_[g] & ball_above) != 0 ? bit_of(top) : 0u);
  }
  for (const End end : {base, top}) {
    const std::uint64_t not_known = ball_beside | (end == base ? ball_reaches_below : ball_reaches_above);
    for (std::size_t g = 0; g < count && (beyond_any_ & bit_of(end)) == 0; ++g) {
      if ((groups_[g] & not_known) != not_known) continue;
      for (const std::int32_t f : clusters.faces(g)) {
        const convex::Polytope::Face &face = polytope_->faces[static_cast<std::size_t>(f)];
        for (std::int32_t i = face.first; i < face.first + face.count; ++i) {
          place_vertex(polytope_->face_vertices[static_cast<std::size_t>(i)], in_frame);
        }
      }
    }
  }
}

const RevolvedOnPolytope::Vertex &RevolvedOnPolytope::place_vertex(std::int32_t number, const Pose &in_frame) {
  const auto v = static_cast<std::size_t>(number);
  Vertex &vertex = vertices_[v];
  if (vertex_search_[v] == search_) return vertex;
  vertex_search_[v] = search_;
  vertex.at = in_frame(polytope_->vertices[v]);
  const Vec3 &p = vertex.at;
  const double radius = body_->radius, diagonal = std::sqrt(2.0) * radius;
  vertex.beyond = (p.z < -body_->half ? 1u : 0u) | (p.z > body_->half ? 2u : 0u) | (p.x < -radius ? 4u : 0u) | (p.x > radius ? 8u : 0u) |
                  (p.y < -radius ? 16u : 0u) | (p.y > radius ? 32u : 0u) | (p.x + p.y > diagonal ? 64u : 0u) |
                  (p.x + p.y < -diagonal ? 128u : 0u) | (p.x - p.y > diagonal ? 256u : 0u) | (p.x - p.y < -diagonal ? 512u : 0u);
  vertex.in_mantle = body_->beyond_mantle(p) <= 0.0;
  beyond_any_ |= vertex.beyond & (bit_of(base) | bit_of(top));
  return vertex;
}

void RevolvedOnPolytope::offer_face(std::int32_t number, const Pose &in_frame) {
  const convex::Polytope::Face &face = polytope_->faces[static_cast<std::size_t>(number)];
  std::uint32_t beyond = ~0u;
  for (std::int32_t i = face.first; i < face.first + face.count; ++i) {
    beyond &= place_vertex(polytope_->face_vertices[static_cast<std::size_t>(i)], in_frame).beyond;
  }
  if (beyond == 0) faces_.push_back(number);
}

bool RevolvedOnPolytope::integrate(const Pose &in_frame, const Vec3 &place, bool to_apex, OverlapSurface &surface) {
  surface.start(place);
  for (Plane &plane : planes_) plane.fan = {plane.fan.normal(), place, plane.offset - dot(plane.fan.normal(), place), surface.of_b()};
  Mantle mantle(*body_, {}, place, to_apex, partner_, border_, surface.of_a());
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
  // The mantle alone depends on where it counts from, and comes last.
  const std::size_t beside_mantle = surface.of_a().size();
  const auto measure = [&](bool from_apex) {
    mantle.count_from_apex(from_apex);
    surface.of_a().shorten(beside_mantle);
    mantle.integrate();
    return surface.measure();
  };
  bool found = measure(to_apex);
  // Where the border as good as turns in an apex that is outside, more than the overlap's is added and taken off: so much counts by rounding.
  constexpr double cancels = 3.0;
  const double area = surface.area_a();
  if (!body_->is_cylinder() && !to_apex && area > cancels * surface.area_b() &&
      has_near({0.0, 0.0, body_->half}, body_->near_apex(), in_frame)) {
    found = measure(true);
    if (!(surface.area_a() < area)) found = measure(false);
  }
  return found && surface.settle();
}

// First the faces that may bound the overlap, which most places outside are beyond. They decide alone, as for a conic's way about a cone's
// apex: what another frame's rounding says of them would not fit that.
bool RevolvedOnPolytope::holds(const Vec3 &at, const Pose &in_frame) const {
  for (const Plane &plane : planes_) {
    if (dot(plane.fan.normal(), at) > plane.offset) return false;
  }
  const Vec3 local = transposed_times(in_frame.rotation, at - in_frame.translation);
  return visit_near(local, 0.0, [&](std::int32_t f) {
    const convex::Polytope::Face &face = polytope_->faces[static_cast<std::size_t>(f)];
    return dot(face.normal, local) <= face.offset || std::binary_search(faces_.begin(), faces_.end(), f);
  });
}

bool RevolvedOnPolytope::has_near(const Vec3 &at, double margin, const Pose &in_frame) const {
  for (const Plane &plane : planes_) {
    if (dot(plane.fan.normal(), at) > plane.offset + margin) return false;
  }
  const Vec3 local = transposed_times(in_frame.rotation, at - in_frame.translation);
  return visit_near(local, -margin, [&](std::int32_t f) {
    const convex::Polytope::Face &face = polytope_->faces[static_cast<std::size_t>(f)];
    return dot(face.normal, local) <= face.offset + margin;
  });
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
