#include "manifold/polytope/overlap_solid.hpp"

#include <algorithm>
#include <cmath>

#include "manifold/narrow_overlap.hpp"
#include "math/branchless.hpp"
#include "math/index.hpp"

namespace cmb {

namespace {

// So many planes are looked at one by one, as members of a set. Of more than so many none fades.
constexpr std::size_t few_planes = 24, most_that_fade = 16;
// Of a ball within a body, what is as good as on its surface left out.
constexpr double within_ball = 1.0 - 1e-9;
// By the size: what is nearer to a plane lies in it.
constexpr double flush_tolerance = 1e-9;
// Planes whose normals have a greater cosine are one plane where they are near; where they are as good as parallel, one fades into
// the other, within this part of the depth.
constexpr double same_plane_cosine = 1.0 - 1e-12, fading_cosine = 0.995, fading_part = 0.05;

// Adds `bit` to the sets of the places that are beyond a plane. Arrays that do not overlap, so that compilers make vectors of them.
void mark_beyond(double normal_x, double normal_y, double normal_z, double offset, std::uint64_t bit, std::size_t count,
                 const double *__restrict x, const double *__restrict y, const double *__restrict z, std::uint64_t *__restrict sets) {
  for (std::size_t k = 0; k < count; ++k) {
    sets[k] |= normal_x * x[k] + normal_y * y[k] + normal_z * z[k] > offset ? bit : 0;
  }
}

}  // namespace

double OverlapSolid::share(const Plane &plane, const Vec3 &p) const {
  return convex::within_unit(0.5 + 0.5 * plane.below(p) / fading_);
}

OverlapSolid::Plane OverlapSolid::Body::plane_of(std::int32_t face) const {
  const convex::Polytope::Face &own = geometry().faces()[index(face)];
  const Vec3 normal = in_axes.rotation * own.normal;
  return {normal, own.offset + dot(normal, in_axes.translation), face};
}

bool OverlapSolid::find(const ContactPolytope &a, const Pose &a_in_axes, const ContactPolytope &b, const Pose &b_in_axes) {
  size_ = a.geometry().radius() < b.geometry().radius() ? a.geometry().radius() : b.geometry().radius();
  tolerance_ = 1e-15 * size_;
  a_.in_axes = a_in_axes;
  b_.in_axes = b_in_axes;
  // A lies above: it is mirrored.
  Pose mirrored = a_in_axes;
  mirrored.rotation.row[2] = -mirrored.rotation.row[2];
  mirrored.translation.z = -mirrored.translation.z;
  a_.side.place(a, mirrored);
  b_.side.place(b, b_in_axes);
  const double thickness = a_.side.reach() + b_.side.reach();
  if (!(thickness > 0.0)) return false;
  fading_ = fading_part * thickness;
  a_.sense = -1.0;
  look_at(a_, -b_.side.reach());
  look_at(b_, -a_.side.reach());
  if (a_.few_planes && b_.few_planes && (!keep_cutting(b_, a_) || !keep_cutting(a_, b_))) return false;
  find_alike();
  start_search();
  see_vertices(a_, b_);
  see_vertices(b_, a_);
  first_ = 0;
  cut_faces_of_a();
  cut_faces_of_b();
  if (pieces_a_.empty() && pieces_b_.empty()) return false;
  const Vec3 apex = find_apex();
  if (!find_moments(apex)) return false;
  return !turn_along_narrow() || find_moments(turn_ * apex);
}

bool OverlapSolid::turn_along_narrow() {
  is_turned_ = find_turn_along_narrow(spread_, turn_);
  if (!is_turned_) return false;
  for (std::size_t k = 0; k < first_; ++k) points_[k] = turn_ * points_[k];
  for (std::vector<Piece> *pieces : {&pieces_a_, &pieces_b_}) {
    for (Piece &piece : *pieces) piece.normal = turn_ * piece.normal;
  }
  for (Plane &plane : a_.planes) plane.normal = turn_ * plane.normal;  // into which B's faces fade
  return true;
}

void OverlapSolid::start_search() {
  ++search_;
  for (Body *body : {&a_, &b_}) {
    body->corners.clear();
    if (body->marks.size() < body->geometry().vertices().size()) body->marks.resize(body->geometry().vertices().size());
    if (search_ == 0) std::fill(body->marks.begin(), body->marks.end(), Body::Mark{});
  }
  if (search_ == 0) search_ = 1;
}

void OverlapSolid::look_at(Body &body, double limit) {
  ContactSide &side = body.side;
  side.gather(limit);
  side.near_faces(faces_);
  body.planes.resize(faces_.size());
  for (std::size_t k = 0; k < faces_.size(); ++k) {
    const Plane own = body.plane_of(faces_[k]);
    Plane &plane = body.planes[k];  // written member by member, which does not wait for a copy
    plane.normal.x = own.normal.x, plane.normal.y = own.normal.y, plane.normal.z = own.normal.z;
    plane.offset = own.offset, plane.face = own.face;
  }
  body.few_planes = faces_.size() <= few_planes;
  body.may_fade = faces_.size() <= most_that_fade;
  body.last_plane = faces_.front();
  if (body.few_planes) body.outline_count = side.outline(body.sense, body.outline);
}

// Drops the planes that have all of the other body's part before them. False where a plane has none of it.
bool OverlapSolid::keep_cutting(Body &body, const Body &other) const {
  constexpr std::ptrdiff_t at_once = 4;
  const double before = 1e-12 * size_ + 2.0 * fading_;
  const Vec3 *const places = other.outline.data(), *const end = places + other.outline_count;
  std::size_t kept = 0;
  for (const Plane &plane : body.planes) {
    double least = HUGE_VAL, most = -HUGE_VAL;
    // Mostly the first places tell.
    for (const Vec3 *p = places; p != end && !(least <= before && most > 0.0);) {
      for (const Vec3 *const next = end - p > at_once ? p + at_once : end; p != next; ++p) {
        const double below = plane.below(*p);
        least = below < least ? below : least;
        most = below > most ? below : most;
      }
    }
    if (!(most > 0.0)) return false;
    if (least > before) continue;
    body.planes[kept++] = plane;
  }
  body.planes.resize(kept);
  return true;
}

// Beyond which the place is, if any, by the greatest part of the body's own reach: a linear function on the corners of the polar body, which has
// no maximum but one.
void OverlapSolid::find_farthest_plane(const Body &body, const Vec3 &where, std::int32_t start, std::int32_t &plane, double &below) {
  const convex::Polytope &geometry = body.geometry();
  const convex::Polytope::Face *const faces = geometry.faces().data();
  const ContactPolytope::FaceAcross *const across = body.side.body().faces_across().data();
  const Vec3 place = transposed_times(body.in_axes.rotation, where - body.in_axes.translation), at = place - geometry.center();
  // In a ball that is in the body no plane is asked for.
  const double inner = within_ball * body.side.body().inner_radius();
  if (norm2(at) < inner * inner) {
    plane = start, below = HUGE_VAL;
    return;
  }
  double farthest = dot(body.side.body().polar_corners()[index(start)], at);
  std::int32_t best = start, first = faces[start].first, count = faces[start].count;
  for (bool goes_on = true; goes_on;) {
    const ContactPolytope::FaceAcross *const begin = across + first, *const end = begin + count;
    goes_on = false;
    for (const ContactPolytope::FaceAcross *next = begin; next != end; ++next) {
      const double beyond = dot(next->polar_corner, at);
      const bool is_farther = beyond > farthest;
      best = is_farther ? next->face : best, first = is_farther ? next->first : first, count = is_farther ? next->count : count;
      farthest = is_farther ? beyond : farthest;
      goes_on |= is_farther;
    }
  }
  plane = best;
  below = faces[best].offset - dot(faces[best].normal, place);
}

// Of many planes only those that may be one, as fine tessellations have none that are as good as parallel for long.
void OverlapSolid::find_alike() {
  alike_.clear();
  const bool fade = a_.may_fade && b_.may_fade;
  const double least = fade ? fading_cosine : same_plane_cosine;
  for (std::size_t i = 0; i < a_.planes.size(); ++i) {
    const Vec3 &normal = a_.planes[i].normal;
    if (!fade && b_.side.body().greatest_face_cosine(transposed_times(b_.in_axes.rotation, normal)) < least - 1e-9) continue;
    for (std::size_t j = 0; j < b_.planes.size(); ++j) {
      if (dot(normal, b_.planes[j].normal) > least) alike_.push_back({i, j, false});
    }
  }
}

void OverlapSolid::see_vertices(Body &body, const Body &other) const {
  body.is_seen = other.few_planes && body.side.body().has_sets();
  if (!body.is_seen) return;
  const std::size_t count = body.side.vertex_count();
  if (body.beyond.size() < count) body.beyond.resize(count);
  std::fill_n(body.beyond.data(), count, 0);
  for (std::size_t k = 0; k < other.planes.size(); ++k) {
    const Plane &plane = other.planes[k];
    mark_beyond(plane.normal.x, plane.normal.y, body.sense * plane.normal.z, plane.offset + tolerance_, std::uint64_t{1} << k, count,
                body.side.places_x(), body.side.places_y(), body.side.heights(), body.beyond.data());
  }
}

void OverlapSolid::look_at_vertex(const Body &body, std::int32_t vertex, Body &other, Corner &corner) {
  const Vec3 at = body.in_axes(body.geometry().vertices()[index(vertex)]);
  corner.at.x = at.x, corner.at.y = at.y, corner.at.z = at.z;
  if (!other.few_planes) {
    find_farthest_plane(other, at, other.last_plane, corner.plane, corner.below);
    other.last_plane = corner.plane;
    return;
  }
  const Plane *const planes = other.planes.data();
  std::uint64_t beyond = 0;
  for (std::size_t k = 0; k < other.planes.size(); ++k) {
    beyond |= static_cast<std::uint64_t>(planes[k].below(at) < -tolerance_) << k;
  }
  corner.beyond = beyond;
}

void OverlapSolid::start_seen_polygon(const Body &body, const convex::Polytope::Face &face) {
  const std::int32_t *const vertices = body.geometry().face_vertices().data() + face.first;
  const double *const x = body.side.places_x(), *const y = body.side.places_y(), *const z = body.side.heights();
  const std::uint64_t *const beyond = body.beyond.data();
  Vec3 *const polygon = points_.data() + first_;
  for (std::size_t i = 0; i < count_; ++i) {
    const std::size_t v = index(vertices[i]);
    polygon[i].x = x[v], polygon[i].y = y[v], polygon[i].z = body.sense * z[v];
    beyond_any_ |= beyond[v];
    beyond_all_ &= beyond[v];
  }
}

void OverlapSolid::start_polygon(Body &body, const Plane &face, Body &other) {
  const convex::Polytope::Face &corners = body.geometry().faces()[index(face.face)];
  const std::int32_t *const vertices = body.geometry().face_vertices().data() + corners.first;
  count_ = index(corners.count);
  make_room();
  done_ = 0;
  done_faces_.clear();
  beyond_any_ = 0;
  beyond_all_ = ~std::uint64_t{0};
  if (body.is_seen) {
    start_seen_polygon(body, corners);
    return;
  }
  Vec3 *const polygon = points_.data() + first_;
  for (std::size_t i = 0; i < count_; ++i) {
    Body::Mark &mark = body.marks[index(vertices[i])];
    if (mark.search != search_) {
      mark.search = search_;
      mark.place = static_cast<std::int32_t>(body.corners.size());
      look_at_vertex(body, vertices[i], other, body.corners.emplace_back());
    }
    const Corner &corner = body.corners[index(mark.place)];
    polygon[i].x = corner.at.x, polygon[i].y = corner.at.y, polygon[i].z = corner.at.z;
    beyond_any_ |= corner.beyond;
    beyond_all_ &= corner.beyond;
    if (other.few_planes) continue;
    farthest_[i] = corner.plane;
    below_[i] = corner.below;
  }
}

// For the polygon and one corner more.
void OverlapSolid::make_room() {
  const std::size_t needed = count_ + 1;
  if (points_.size() < first_ + needed) points_.resize(2 * (first_ + needed));
  if (below_cut_.size() >= needed) return;
  below_cut_.resize(2 * needed);
  below_.resize(2 * needed);
  farthest_.resize(2 * needed);
}

// A plane that shall not cut the polygon. The corners that are farthest beyond it are looked at anew.
void OverlapSolid::leave_out(const Body &other, std::size_t plane) {
  if (other.few_planes) {
    done_ |= std::uint64_t{1} << plane;
    return;
  }
  const std::int32_t face = other.planes[plane].face;
  done_faces_.push_back(face);
  for (std::size_t i = 0; i < count_; ++i) farthest_[i] = farthest_[i] == face ? -1 : farthest_[i];
}

// Leaves of the polygon what lies in the other body, but for planes that are done already.
void OverlapSolid::cut_by(const Body &other) {
  if (other.few_planes) {
    cut_by_few(other);
  } else {
    cut_by_many(other);
  }
}

// New corners lie between old ones: no further planes concern them.
void OverlapSolid::cut_by_few(const Body &other) {
  if ((beyond_all_ & ~done_) != 0) count_ = 0;
  for (std::uint64_t left = beyond_any_ & ~done_; left != 0 && count_ != 0; left &= left - 1) {
    cut(other.planes[static_cast<std::size_t>(__builtin_ctzll(left))]);
  }
}

// Corner by corner, each by the plane beyond which it is farthest.
void OverlapSolid::cut_by_many(const Body &other) {
  std::int32_t start = other.last_plane;
  for (std::size_t i = 0; i < count_;) {
    if (farthest_[i] < 0) {
      find_farthest_plane(other, points_[first_ + i], start, farthest_[i], below_[i]);
      // What is at the border may be beyond it by rounding.
      const bool beyond = below_[i] < -tolerance_;
      if (beyond && std::find(done_faces_.begin(), done_faces_.end(), farthest_[i]) != done_faces_.end()) below_[i] = HUGE_VAL;
    }
    if (!(below_[i] < -tolerance_)) {
      ++i;
      continue;
    }
    start = farthest_[i];
    done_faces_.push_back(start);
    i = cut_corner(other.plane_of(start), i);
  }
}

// Leaves of the polygon what lies below the plane, beyond which the corner is, and returns the first corner that is new. Others beyond
// the plane are next to that corner.
std::size_t OverlapSolid::cut_corner(const Plane &plane, std::size_t corner) {
  make_room();
  const Vec3 *const polygon = points_.data() + first_;
  const std::size_t end = count_ - 1;
  double of_first = plane.below(polygon[corner]), of_last = of_first, before = 0.0, after = 0.0;
  if (!(of_first < 0.0)) {  // by rounding it is not beyond
    below_[corner] = HUGE_VAL;
    return corner;
  }
  std::size_t first = corner, last = corner, previous = corner, next = corner;
  for (std::size_t left = end;; --left) {
    next = last == end ? 0 : last + 1;
    after = plane.below(polygon[next]);
    if (after >= 0.0) break;
    if (left == 0) {
      count_ = 0;
      return 0;
    }
    last = next, of_last = after;
  }
  for (;;) {
    previous = first == 0 ? end : first - 1;
    before = plane.below(polygon[previous]);
    if (before >= 0.0) break;
    first = previous, of_first = before;
  }
  const Vec3 &p = polygon[previous], &q = polygon[first], &r = polygon[last], &s = polygon[next];
  const Vec3 leaves = p + (before / (before - of_first)) * (q - p), enters = r + (of_last / (of_last - after)) * (s - r);
  cut_out(first, last, leaves, enters);
  return first > last ? 0 : first;
}

// Leaves of the polygon what lies below the plane. New corners have no farthest plane yet.
void OverlapSolid::cut(const Plane &plane) {
  constexpr std::size_t most_in_set = 64;
  make_room();
  const std::size_t count = count_;
  Vec3 *const polygon = points_.data() + first_;
  double *const below = below_cut_.data();
  std::uint64_t beyond = 0;
  std::size_t within = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double here = plane.below(polygon[i]);
    below[i] = here;
    within += here >= 0.0 ? 1 : 0;
    beyond |= static_cast<std::uint64_t>(!(here >= 0.0)) << (i % most_in_set);
  }
  if (within == count) return;
  if (within == 0) {
    count_ = 0;
    return;
  }
  // The corners beyond follow each other but for rounding.
  if (count > most_in_set) {
    cut_ragged();
    return;
  }
  const std::uint64_t after_other = beyond << 1 | beyond >> (count - 1), before_other = beyond >> 1 | (beyond & 1) << (count - 1);
  const std::uint64_t firsts = beyond & ~after_other, lasts = beyond & ~before_other;
  if ((firsts & (firsts - 1)) != 0) {
    cut_ragged();
    return;
  }
  const auto first = static_cast<std::size_t>(__builtin_ctzll(firsts)), last = static_cast<std::size_t>(__builtin_ctzll(lasts));
  const std::size_t before = first == 0 ? count - 1 : first - 1, after = last + 1 == count ? 0 : last + 1;
  const Vec3 &p = polygon[before], &q = polygon[first], &r = polygon[last], &s = polygon[after];
  const Vec3 leaves = p + (below[before] / (below[before] - below[first])) * (q - p);
  const Vec3 enters = r + (below[last] / (below[last] - below[after])) * (s - r);
  cut_out(first, last, leaves, enters);
}

// Two corners in place of those from `first` to `last`, in turn.
void OverlapSolid::cut_out(std::size_t first, std::size_t last, const Vec3 &leaves, const Vec3 &enters) {
  Vec3 *const polygon = points_.data() + first_;
  double *const below = below_.data();
  std::int32_t *const farthest = farthest_.data();
  const auto move = [&](std::size_t from, std::size_t to) {
    polygon[to].x = polygon[from].x, polygon[to].y = polygon[from].y, polygon[to].z = polygon[from].z;
    below[to] = below[from], farthest[to] = farthest[from];
  };
  const auto put = [&](std::size_t to, const Vec3 &at) {
    polygon[to].x = at.x, polygon[to].y = at.y, polygon[to].z = at.z;
    farthest[to] = -1;
  };
  if (first > last) {  // across the end
    for (std::size_t i = last + 1; last > 0 && i < first; ++i) move(i, i - last);
    put(0, enters);
    put(first - last, leaves);
    count_ = first - last + 1;
    return;
  }
  const std::size_t after = last + 1;
  if (first == last) {
    for (std::size_t i = count_; i > after; --i) move(i - 1, i);
  } else if (after != first + 2) {
    for (std::size_t i = after; i < count_; ++i) move(i, i + first + 2 - after);
  }
  put(first, leaves);
  put(first + 1, enters);
  count_ = count_ + first + 2 - after;
}

// Where the corners beyond the plane do not follow each other.
void OverlapSolid::cut_ragged() {
  const auto begin = points_.begin() + static_cast<std::ptrdiff_t>(first_);
  ragged_.assign(begin, begin + static_cast<std::ptrdiff_t>(count_));
  ragged_below_.assign(below_cut_.begin(), below_cut_.begin() + static_cast<std::ptrdiff_t>(count_));
  count_ = 0;
  const auto put = [&](const Vec3 &at) {
    make_room();
    points_[first_ + count_] = at;
    farthest_[count_++] = -1;
  };
  std::size_t last = ragged_.size() - 1;
  for (std::size_t i = 0; i < ragged_.size(); last = i++) {
    const double from = ragged_below_[last], to = ragged_below_[i];
    if ((from >= 0.0) != (to >= 0.0)) put(ragged_[last] + (from / (from - to)) * (ragged_[i] - ragged_[last]));
    if (to >= 0.0) put(ragged_[i]);
  }
}

void OverlapSolid::append(std::vector<Piece> &pieces, const Vec3 &normal, bool bounds, bool carries, const Plane *fades) {
  if (count_ < 3) return;
  Piece &piece = pieces.emplace_back();
  piece.first = first_, piece.count = count_;
  piece.normal.x = normal.x, piece.normal.y = normal.y, piece.normal.z = normal.z;
  piece.bounds = bounds, piece.carries = carries, piece.fades = fades;
  first_ += count_;
}

// Of faces that lie in one plane and look the same way, A's is the surface.
void OverlapSolid::cut_faces_of_a() {
  pieces_a_.clear();
  // Beyond that one lies in the other body, and is surface there.
  const double flush_within = std::fmin(flush_tolerance * size_, fading_);
  for (std::size_t i = 0; i < a_.planes.size(); ++i) {
    const Plane &face = a_.planes[i];
    start_polygon(a_, face, b_);
    const auto is_one_plane = [&](const Alike &alike) { return alike.a == i && dot(face.normal, b_.planes[alike.b].normal) > same_plane_cosine; };
    for (const Alike &alike : alike_) {
      if (is_one_plane(alike)) leave_out(b_, alike.b);
    }
    cut_by(b_);
    // Whether they are flush is asked of what is within the other planes: where two planes cross, at an angle next to rounding, is not known,
    // and would be another line for each of the two faces.
    for (Alike &alike : alike_) {
      if (!is_one_plane(alike)) continue;
      const Plane &plane = b_.planes[alike.b];
      alike.flush = true;
      for (std::size_t k = 0; k < count_; ++k) alike.flush &= std::fabs(plane.below(points_[first_ + k])) < flush_within;
      if (!alike.flush && count_ != 0) cut(plane);
    }
    append(pieces_a_, face.normal, true, true, nullptr);
  }
}

void OverlapSolid::cut_faces_of_b() {
  pieces_b_.clear();
  fades_ = false;
  for (std::size_t j = 0; j < b_.planes.size(); ++j) {
    const Plane &face = b_.planes[j];
    start_polygon(b_, face, a_);
    const auto alike = std::find_if(alike_.begin(), alike_.end(), [j](const Alike &pair) { return pair.b == j; });
    if (alike != alike_.end()) leave_out(a_, alike->a);
    cut_by(a_);
    if (alike == alike_.end()) {
      append(pieces_b_, face.normal, true, true, nullptr);
    } else {
      fade(face, *alike);
    }
  }
}

// The polygon at hand is what A's other planes leave of B's face.
void OverlapSolid::fade(const Plane &face, const Alike &alike) {
  const Plane &beside = a_.planes[alike.a];
  double least = HUGE_VAL;
  for (std::size_t k = 0; k < count_; ++k) least = std::fmin(least, beside.below(points_[first_ + k]));
  if (least >= fading_) {
    append(pieces_b_, face.normal, true, true, nullptr);
    return;
  }
  fades_ = true;
  const auto begin = points_.begin() + static_cast<std::ptrdiff_t>(first_);
  whole_.assign(begin, begin + static_cast<std::ptrdiff_t>(count_));
  const auto take_whole = [&] {
    count_ = whole_.size();
    make_room();
    std::copy(whole_.begin(), whole_.end(), points_.begin() + static_cast<std::ptrdiff_t>(first_));
  };
  const auto leave = [&](const Plane &plane) {
    if (count_ != 0) cut(plane);
  };
  if (!alike.flush) {
    leave(beside);
    append(pieces_b_, face.normal, true, false, nullptr);
  }
  take_whole();
  leave({beside.normal, beside.offset - fading_, 0});
  append(pieces_b_, face.normal, false, true, nullptr);
  take_whole();
  leave({beside.normal, beside.offset + fading_, 0});
  leave({-beside.normal, fading_ - beside.offset, 0});
  append(pieces_b_, face.normal, false, true, &beside);
}

// A corner of the overlap in which many faces meet, whose moments about it are none.
Vec3 OverlapSolid::find_apex() const {
  const auto farthest = [](const ContactSide &side) {
    std::int32_t best = side.inside(0);
    for (std::size_t k = 1; k < side.inside_count(); ++k) {
      best = side.height(index(side.inside(k))) > side.height(index(best)) ? side.inside(k) : best;
    }
    return side.at(index(best));
  };
  const auto below_all = [](const std::vector<Plane> &planes, const Vec3 &p) {
    for (const Plane &plane : planes) {
      if (plane.below(p) < 0.0) return false;
    }
    return true;
  };
  const Vec3 of_a = farthest(a_.side), of_b = farthest(b_.side), lowest{of_a.x, of_a.y, -of_a.z};
  return below_all(b_.planes, lowest) ? lowest : below_all(a_.planes, of_b) ? of_b : points_[0];
}

// Sums of cones from the apex over the pieces.
bool OverlapSolid::find_moments(const Vec3 &apex) {
  double volume = 0.0, xx = 0.0, yy = 0.0, zz = 0.0, yz = 0.0, zx = 0.0, xy = 0.0;
  Vec3 first;
  for (const std::vector<Piece> *pieces : {&pieces_a_, &pieces_b_}) {
    for (const Piece &piece : *pieces) {
      const Vec3 *const corner = points_.data() + piece.first;
      const Vec3 p = corner[0] - apex;
      const double height = dot(piece.normal, p);
      if (!piece.bounds || std::fabs(height) <= 1e-15 * size_) continue;
      Vec3 q = corner[1] - apex;
      for (std::size_t i = 2; i < piece.count; ++i) {
        const Vec3 r = corner[i] - apex, sum = p + q + r;
        const double part = 0.5 * height * dot(piece.normal, cross(q - p, r - p));
        volume += part;
        first = first + part * sum;
        xx += part * (sum.x * sum.x + p.x * p.x + q.x * q.x + r.x * r.x);
        yy += part * (sum.y * sum.y + p.y * p.y + q.y * q.y + r.y * r.y);
        zz += part * (sum.z * sum.z + p.z * p.z + q.z * q.z + r.z * r.z);
        yz += part * (sum.y * sum.z + p.y * p.z + q.y * q.z + r.y * r.z);
        zx += part * (sum.z * sum.x + p.z * p.x + q.z * q.x + r.z * r.x);
        xy += part * (sum.x * sum.y + p.x * p.y + q.x * q.y + r.x * r.y);
        q = r;
      }
    }
  }
  if (!(volume > 0.0)) return false;
  volume_ = volume / 3.0;
  const Vec3 m = (0.25 / volume) * first;
  middle_ = apex + m;
  const double part = 0.05 / volume;
  spread_ = {{part * xx - m.x * m.x, part * yy - m.y * m.y, part * zz - m.z * m.z, part * yz - m.y * m.z, part * zx - m.z * m.x,
              part * xy - m.x * m.y}};
  return true;
}

}  // namespace cmb
