#include "manifold/polytope/contact_side.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "math/branchless.hpp"
#include "math/index.hpp"

namespace cmb {

namespace {

// Takes the lowest member out of a set that has any.
inline std::int32_t take_lowest(std::uint64_t &set) {
  const int lowest = __builtin_ctzll(set);
  set &= set - 1;
  return lowest;
}

// Arrays that do not overlap, so that compilers make vectors of them.
void map_all(const Pose &pose, std::size_t count, const double *__restrict own_x, const double *__restrict own_y,
             const double *__restrict own_z, double *__restrict x, double *__restrict y, double *__restrict z) {
  const Vec3 row_x = pose.rotation.row[0], row_y = pose.rotation.row[1], row_z = pose.rotation.row[2];
  const Vec3 shift = pose.translation;
  for (std::size_t k = 0; k < count; ++k) {
    x[k] = row_x.x * own_x[k] + row_x.y * own_y[k] + row_x.z * own_z[k] + shift.x;
    y[k] = row_y.x * own_x[k] + row_y.y * own_y[k] + row_y.z * own_z[k] + shift.y;
    z[k] = row_z.x * own_x[k] + row_z.y * own_y[k] + row_z.z * own_z[k] + shift.z;
  }
}

// Where in the contact plane places are seen.
void perturb_all(const Perturbation &perturbation, std::size_t count, const double *__restrict x, const double *__restrict y,
                 const double *__restrict z, double *__restrict seen_x, double *__restrict seen_y) {
  const Vec3 turn = perturbation.turn, shift = perturbation.shift;
  for (std::size_t k = 0; k < count; ++k) {
    seen_x[k] = x[k] + (turn.y * z[k] - turn.z * y[k]) + shift.x;
    seen_y[k] = y[k] + (turn.z * x[k] - turn.x * z[k]) + shift.y;
  }
}

// The extent of an edge's part beyond the limit; `from` is its end there.
inline void find_part_beyond(const Vec3 &from, const Vec3 &to, double limit, Extent &extent) {
  const double rise = from.z - limit, fall = from.z - to.z;
  const double way = rise / (fall > rise ? fall : rise);  // 1 where the other end is beyond the limit, too
  const double x = from.x + way * (to.x - from.x), y = from.y + way * (to.y - from.y);
  extent.low_x = from.x < x ? from.x : x, extent.high_x = from.x > x ? from.x : x;
  extent.low_y = from.y < y ? from.y : y, extent.high_y = from.y > y ? from.y : y;
}

}  // namespace

void ContactSide::place(const ContactPolytope &body, const Pose &to_side, const Perturbation &perturbation) {
  body_ = &body;
  to_side_ = to_side;
  perturbation_ = perturbation;
  const convex::Polytope &geometry = body.geometry();
  make_room();
  if (body.has_sets()) {
    const std::size_t count = geometry.vertices().size();
    map_all(to_side_, count, body.coordinates(0), body.coordinates(1), body.coordinates(2), x_.data(), y_.data(), z_.data());
    reach_ = convex::greatest_of(z_.data(), count);
    std::iota(number_.begin(), number_.begin() + static_cast<std::ptrdiff_t>(count), 0);
    vertex_count_ = count;
    find_seen();
  } else {
    summit_ = geometry.support_vertex(towards());
    reach_ = dot(towards(), geometry.vertices()[index(summit_)]) + to_side.translation.z;
  }
}

void ContactSide::gather(double limit) {
  faces_gathered_ = false;
  limit_ = limit;
  if (body_->has_sets()) {
    gather_by_sets(limit);
  } else {
    gather_from_summit(limit);
    find_seen();
  }
}

void ContactSide::find_seen() {
  if (perturbation_.is_none()) return;
  perturb_all(perturbation_, vertex_count_, x_.data(), y_.data(), z_.data(), perturbed_x_.data(), perturbed_y_.data());
}

void ContactSide::gather_inside(double limit) {
  faces_gathered_ = false;
  limit_ = limit;
  if (body_->has_sets()) {
    find_inside(limit);
  } else {
    find_inside_from_summit(limit);
  }
}

void ContactSide::find_inside(double limit) {
  // Which are beyond the limit is unpredictable: no branch.
  std::uint64_t inside = 0, edge_set = 0, face_set = 0;
  std::size_t inside_count = 0;
  const double *const z = z_.data();
  const ContactPolytope::Incidence *const incidence = &body_->incidence(0);
  std::int32_t *const inside_list = inside_.data();
  for (std::size_t v = 0; v < vertex_count_; ++v) {
    const auto is_inside = static_cast<std::uint64_t>(z[v] > limit);
    inside_list[inside_count] = static_cast<std::int32_t>(v);
    inside_count += is_inside;
    inside |= is_inside << v;
    edge_set |= incidence[v].edges & (0 - is_inside);
    face_set |= incidence[v].faces & (0 - is_inside);
  }
  inside_count_ = inside_count;
  inside_set_ = inside;
  edge_set_ = edge_set;
  face_set_ = face_set;
}

void ContactSide::find_inside_from_summit(double limit) {
  const convex::Polytope &geometry = body_->geometry();
  const Vec3 *const places = geometry.vertices().data();
  const std::int32_t *const neighbours = geometry.neighbours().data();
  start_gathering();
  const Pose to_side = to_side_;
  std::size_t count = 0;
  const auto look_at = [&](std::int32_t number) {
    Mark &mark = vertex_mark_[index(number)];
    if (mark.gathering == gathering_) return;
    mark.gathering = gathering_;
    const double height = dot(to_side.rotation.row[2], places[number]) + to_side.translation.z;
    mark.place = height > limit ? static_cast<std::int32_t>(count) : -1;
    if (mark.place < 0) return;
    x_[count] = dot(to_side.rotation.row[0], places[number]) + to_side.translation.x;
    y_[count] = dot(to_side.rotation.row[1], places[number]) + to_side.translation.y;
    z_[count] = height;
    number_[count] = number;
    inside_[count] = mark.place;
    ++count;
  };
  look_at(summit_);
  for (std::size_t k = 0; k < count; ++k) {
    const std::int32_t last_slot = geometry.neighbour_begin(number_[k] + 1);
    for (std::int32_t slot = geometry.neighbour_begin(number_[k]); slot < last_slot; ++slot) look_at(neighbours[slot]);
  }
  vertex_count_ = inside_count_ = count;
  edge_count_ = 0;
}

std::size_t ContactSide::outline(double sense, std::vector<Vec3> &outline) const {
  const convex::Polytope &geometry = body_->geometry();
  const std::size_t most = geometry.vertices().size() + geometry.edges().size();
  if (outline.size() <= most) outline.resize(most + 1);
  const double *const x = x_.data(), *const y = y_.data(), *const z = z_.data(), level = sense * limit_;
  Vec3 *place = outline.data();
  for (std::size_t k = 0; k < inside_count_; ++k, ++place) {
    const std::size_t v = index(inside_[k]);
    place->x = x[v], place->y = y[v], place->z = sense * z[v];
  }
  const auto put_crossing = [&](const Vec3 &from, const Vec3 &to) {
    const double part = (from.z - limit_) / (from.z - to.z);
    place->x = from.x + part * (to.x - from.x), place->y = from.y + part * (to.y - from.y), place->z = level;
  };
  if (body_->has_sets()) {
    const convex::Polytope::Edge *const edges = geometry.edges().data();
    for (std::uint64_t left = edge_set_; left != 0;) {
      const std::int32_t *const ends = edges[take_lowest(left)].vertex;
      put_crossing(at(index(ends[0])), at(index(ends[1])));
      place += 1 - (inside_set_ >> ends[0] & inside_set_ >> ends[1] & 1);  // unless both ends are beyond
    }
    return static_cast<std::size_t>(place - outline.data());
  }
  for (std::size_t k = 0; k < inside_count_; ++k) {
    const std::int32_t last_slot = geometry.neighbour_begin(number_[k] + 1);
    for (std::int32_t slot = geometry.neighbour_begin(number_[k]); slot < last_slot; ++slot) {
      const std::size_t other = index(geometry.neighbours()[index(slot)]);
      if (vertex_mark_[other].place >= 0) continue;
      put_crossing(at(k), to_side_(geometry.vertices()[other]));
      ++place;
    }
  }
  return static_cast<std::size_t>(place - outline.data());
}

void ContactSide::start_gathering() {
  if (++gathering_ != 0) return;
  std::fill(vertex_mark_.begin(), vertex_mark_.end(), Mark{});
  gathering_ = 1;
}

void ContactSide::gather_by_sets(double limit) {
  const convex::Polytope &geometry = body_->geometry();
  find_inside(limit);
  const std::uint64_t inside = inside_set_;
  const double *const x = x_.data(), *const y = y_.data(), *const z = z_.data();
  const convex::Polytope::Edge *const all_edges = geometry.edges().data();
  Edge *edge = edges_.data();
  Extent extent;
  for (std::uint64_t left = edge_set_; left != 0;) {
    const std::int32_t number = take_lowest(left);
    const std::int32_t *const ends = all_edges[number].vertex;
    const std::size_t to_first = 1 - (inside >> ends[0] & 1);  // from an end beyond the limit
    const std::int32_t self = ends[to_first], other = ends[1 - to_first];
    const Vec3 from{x[self], y[self], z[self]}, to{x[other], y[other], z[other]};
    edge->vertex[0] = self;
    edge->vertex[1] = other;
    edge->number = number;
    find_part_beyond(from, to, limit, edge->extent);
    extent.add(edge->extent);
    ++edge;
  }
  edge_count_ = static_cast<std::size_t>(edge - edges_.data());
  extent_ = extent;
}

void ContactSide::make_room() {
  const convex::Polytope &geometry = body_->geometry();
  // One place more than can be taken: what turns out not to be needed is overwritten.
  if (number_.size() <= geometry.vertices().size()) {
    const std::size_t room = geometry.vertices().size() + 1;
    for (std::vector<double> *const places : {&x_, &y_, &z_, &perturbed_x_, &perturbed_y_}) places->resize(room);
    number_.resize(room);
  }
  if (inside_.size() <= geometry.vertices().size()) inside_.resize(geometry.vertices().size() + 1);
  if (edges_.size() <= geometry.edges().size()) edges_.resize(geometry.edges().size() + 1);
  if (vertex_mark_.size() < geometry.vertices().size()) vertex_mark_.resize(geometry.vertices().size());
  if (face_mark_.size() < geometry.faces().size()) face_mark_.resize(geometry.faces().size());
}

void ContactSide::gather_from_summit(double limit) {
  const convex::Polytope &geometry = body_->geometry();
  const Vec3 *const places = geometry.vertices().data();
  const std::int32_t *const neighbours = geometry.neighbours().data(), *const numbers = geometry.neighbour_edges().data();
  start_gathering();
  const Pose to_side = to_side_;
  const std::uint32_t gathering = gathering_;
  Mark *const marks = vertex_mark_.data();
  double *const x = x_.data(), *const y = y_.data(), *const z = z_.data();
  std::int32_t *const inside = inside_.data();
  Edge *const edges = edges_.data();
  std::int32_t count = 0;
  std::size_t inside_count = 0, edge_count = 0;
  // Whether a vertex is new, beyond the limit or an edge kept already is unpredictable: everything is computed, and kept
  // or overwritten. Written member by member: objects put together on the stack and copied as a whole would wait.
  const auto add_vertex = [&](std::int32_t number) {
    const Vec3 place = to_side(places[number]);
    x[count] = place.x, y[count] = place.y, z[count] = place.z;
    number_[index(count)] = number;
    Mark &mark = marks[number];
    const bool met = mark.gathering == gathering;
    mark.place = met ? mark.place : count;
    mark.gathering = gathering;
    inside[inside_count] = count;
    inside_count += static_cast<std::size_t>(!met & (place.z > limit));
    count += static_cast<std::int32_t>(!met);
    return mark.place;
  };
  add_vertex(summit_);
  Extent extent;
  for (std::size_t k = 0; k < inside_count; ++k) {
    const std::int32_t self = inside[k];
    const Vec3 from = at(index(self));
    const std::int32_t v = number_[index(self)], last_slot = geometry.neighbour_begin(v + 1);
    for (std::int32_t slot = geometry.neighbour_begin(v); slot < last_slot; ++slot) {
      const std::int32_t other = add_vertex(neighbours[slot]);
      const Vec3 to = at(index(other));
      Edge *const edge = edges + edge_count;
      edge->vertex[0] = self;
      edge->vertex[1] = other;
      edge->number = numbers[slot];
      find_part_beyond(from, to, limit, edge->extent);
      extent.add(edge->extent);
      // Of an edge with both ends beyond the limit the one that comes first keeps it.
      edge_count += 1 - (static_cast<std::size_t>(to.z > limit) & static_cast<std::size_t>(other < self));
    }
  }
  vertex_count_ = static_cast<std::size_t>(count);
  edge_count_ = edge_count;
  inside_count_ = inside_count;
  extent_ = extent;
}

template <typename Take>
void ContactSide::each_near_face(const Take &take) {
  if (body_->has_sets()) {
    for (std::uint64_t left = face_set_; left != 0;) take(take_lowest(left));
    return;
  }
  if (++face_gathering_ == 0) {
    std::fill(face_mark_.begin(), face_mark_.end(), 0);
    face_gathering_ = 1;
  }
  for (std::size_t k = 0; k < inside_count_; ++k) {
    const std::int32_t v = number_[index(inside_[k])];
    const auto *const last = body_->corners(v + 1);
    for (const auto *corner = body_->corners(v); corner != last; ++corner) {
      if (face_mark_[index(corner->face)] == face_gathering_) continue;
      face_mark_[index(corner->face)] = face_gathering_;
      take(corner->face);
    }
  }
}

void ContactSide::near_faces(std::vector<std::int32_t> &faces) {
  faces.clear();
  each_near_face([&](std::int32_t f) { faces.push_back(f); });
}

void ContactSide::gather_faces() {
  const Vec3 *const row = to_side_.rotation.row, turn = perturbation_.turn;
  perturbed_to_side_.rotation = {{row[0] + turn.y * row[2] - turn.z * row[1], row[1] + turn.z * row[0] - turn.x * row[2],
                                  row[2] + turn.x * row[1] - turn.y * row[0]}};
  perturbed_to_side_.translation = perturbation_(to_side_.translation);
  const std::vector<convex::Polytope::Face> &faces = body_->geometry().faces();
  if (up_faces_.size() <= faces.size()) up_faces_.resize(faces.size() + 1), walls_.resize(faces.size() + 1);
  const Vec3 up = perturbed_to_side_.rotation.row[2];
  UpFace *up_face = up_faces_.data();
  Wall *wall = walls_.data();
  // Which way a face looks is unpredictable: it is put down as both, and one of them overwritten.
  const auto add = [&](const Vec3 &normal, double offset) {
    const double cosine = dot(normal, up);
    up_face->normal = &normal, up_face->offset = offset, up_face->inverse_cosine = 1.0 / cosine;
    wall->normal = &normal, wall->offset = offset, wall->cosine = cosine;
    const bool looks_up = cosine > wall_cosine;
    up_face += looks_up ? 1 : 0;
    wall += looks_up ? 0 : 1;
  };
  each_near_face([&](std::int32_t f) { add(faces[index(f)].normal, faces[index(f)].offset); });
  up_face_count_ = static_cast<std::size_t>(up_face - up_faces_.data());
  wall_count_ = static_cast<std::size_t>(wall - walls_.data());
  faces_gathered_ = true;
}

bool ContactSide::face_over(double seen_x, double seen_y, double height, double level, double slack, Plane &plane) {
  if (!faces_gathered_) gather_faces();
  const Pose &pose = perturbed_to_side_;
  const Vec3 ground =
      transposed_times(pose.rotation, Vec3{seen_x - pose.translation.x, seen_y - pose.translation.y, -pose.translation.z});
  const UpFace *best = nullptr;
  double least = HUGE_VAL;
  for (std::size_t k = 0; k < up_face_count_; ++k) {
    const UpFace &up = up_faces_[k];
    const double over = up.inverse_cosine * (up.offset - dot(*up.normal, ground));
    best = over < least ? &up : best;  // which is lowest is unpredictable: no branch
    least = over < least ? over : least;
  }
  // What is far from deep enough, however the body is seen, need not be looked at further.
  if (best == nullptr || height + least <= level - slack * best->inverse_cosine) return false;
  for (std::size_t k = 0; k < wall_count_; ++k) {
    const Wall &wall = walls_[k];
    if (dot(*wall.normal, ground) + least * wall.cosine > wall.offset) return false;
  }
  const Vec3 normal = to_side_.rotation * *best->normal;
  const double part = 1.0 / normal.z;
  plane.slope_x = normal.x * part, plane.slope_y = normal.y * part;
  plane.height = (best->offset + dot(normal, to_side_.translation)) * part;
  return true;
}

}  // namespace cmb
