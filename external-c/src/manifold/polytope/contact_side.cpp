#include "manifold/polytope/contact_side.hpp"

#include <algorithm>
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

}  // namespace

void ContactSide::place(const ContactPolytope &body, const Pose &to_side) {
  body_ = &body;
  to_side_ = to_side;
  const convex::Polytope &geometry = body.geometry();
  make_room();
  if (body.has_sets()) {
    const std::size_t count = geometry.vertices().size();
    map_all(to_side_, count, body.coordinates(0), body.coordinates(1), body.coordinates(2), x_.data(), y_.data(), z_.data());
    reach_ = convex::greatest_of(z_.data(), count);
    std::iota(number_.begin(), number_.begin() + static_cast<std::ptrdiff_t>(count), 0);
    vertex_count_ = count;
  } else {
    summit_ = geometry.support_vertex(towards());
    reach_ = dot(towards(), geometry.vertices()[index(summit_)]) + to_side.translation.z;
  }
}

void ContactSide::gather(double limit) {
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

void ContactSide::make_room() {
  const convex::Polytope &geometry = body_->geometry();
  // One place more than can be taken: what turns out not to be needed is overwritten.
  if (number_.size() <= geometry.vertices().size()) {
    const std::size_t room = geometry.vertices().size() + 1;
    for (std::vector<double> *const places : {&x_, &y_, &z_}) places->resize(room);
    number_.resize(room);
  }
  if (inside_.size() <= geometry.vertices().size()) inside_.resize(geometry.vertices().size() + 1);
  if (vertex_mark_.size() < geometry.vertices().size()) vertex_mark_.resize(geometry.vertices().size());
  if (face_mark_.size() < geometry.faces().size()) face_mark_.resize(geometry.faces().size());
}

void ContactSide::near_faces(std::vector<std::int32_t> &faces) {
  faces.clear();
  if (body_->has_sets()) {
    for (std::uint64_t left = face_set_; left != 0;) faces.push_back(take_lowest(left));
    return;
  }
  if (++face_gathering_ == 0) {
    std::fill(face_mark_.begin(), face_mark_.end(), 0);
    face_gathering_ = 1;
  }
  for (std::size_t k = 0; k < inside_count_; ++k) {
    const std::int32_t v = number_[index(inside_[k])];
    const std::int32_t *const last = body_->faces_at(v + 1);
    for (const std::int32_t *face = body_->faces_at(v); face != last; ++face) {
      if (face_mark_[index(*face)] == face_gathering_) continue;
      face_mark_[index(*face)] = face_gathering_;
      faces.push_back(*face);
    }
  }
}

}  // namespace cmb
