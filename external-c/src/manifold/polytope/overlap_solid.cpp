#include "manifold/polytope/overlap_solid.hpp"

#include <algorithm>
#include <cmath>

#include "math/branchless.hpp"
#include "math/index.hpp"

namespace cmb {

namespace {

// So many planes are looked at one by one.
constexpr std::size_t few_planes = 16;
// By the size: what is nearer to a plane lies in it.
constexpr double flush_tolerance = 1e-9;
// Planes whose normals have a greater cosine are one plane where they are near; where they are as good as parallel, one fades into
// the other, within this part of the depth.
constexpr double same_plane_cosine = 1.0 - 1e-12, fading_cosine = 0.995, fading_part = 0.05;

}  // namespace

double OverlapSolid::share(const Plane &plane, const Vec3 &p) const {
  return convex::within_unit(0.5 + 0.5 * (plane.below(p + origin_)) / fading_);
}

OverlapSolid::Plane OverlapSolid::Body::plane_of(std::int32_t face) const {
  const convex::Polytope::Face &own = geometry().faces()[index(face)];
  const Vec3 normal = in_axes.rotation * own.normal;
  return {normal, own.offset + dot(normal, in_axes.translation), face};
}

bool OverlapSolid::find(const ContactPolytope &a, const Pose &a_in_axes, const ContactPolytope &b, const Pose &b_in_axes) {
  size_ = std::fmin(a.geometry().radius(), b.geometry().radius());
  a_.in_axes = a_in_axes;
  b_.in_axes = b_in_axes;
  // A lies above: it is mirrored.
  Pose mirrored = a_in_axes;
  mirrored.rotation.row[2] = -mirrored.rotation.row[2];
  mirrored.translation.z = -mirrored.translation.z;
  a_.side.place(a, mirrored, {});
  b_.side.place(b, b_in_axes, {});
  const double thickness = a_.side.reach() + b_.side.reach();
  if (!(thickness > 0.0)) return false;
  fading_ = fading_part * thickness;
  a_.side.gather(-b_.side.reach());
  b_.side.gather(-a_.side.reach());
  look_at(a_, -1.0);
  look_at(b_, 1.0);
  if (a_.few_planes && b_.few_planes && (!keep_cutting(b_, a_) || !keep_cutting(a_, b_))) return false;
  find_alike();
  start_search();
  points_.clear();
  cut_faces_of_a();
  cut_faces_of_b();
  if (pieces_a_.empty() && pieces_b_.empty()) return false;
  set_origin();
  return find_moments();
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

void OverlapSolid::look_at(Body &body, double sense) {
  const ContactSide &side = body.side;
  body.side.near_faces(faces_);
  body.planes.clear();
  for (const std::int32_t f : faces_) body.planes.push_back(body.plane_of(f));
  body.few_planes = faces_.size() <= few_planes;
  body.last_plane = faces_.front();
  body.outline.clear();
  if (!body.few_planes) return;
  const auto true_place = [sense](const Vec3 &p) { return Vec3{p.x, p.y, sense * p.z}; };
  for (std::size_t k = 0; k < side.inside_count(); ++k) body.outline.push_back(true_place(side.at(index(side.inside(k)))));
  const double limit = side.limit();
  for (std::size_t k = 0; k < side.edge_count(); ++k) {
    const Vec3 from = side.at(index(side.edge(k).vertex[0])), to = side.at(index(side.edge(k).vertex[1]));
    if (to.z > limit) continue;
    body.outline.push_back(true_place(from + ((from.z - limit) / (from.z - to.z)) * (to - from)));
  }
}

// Drops the planes that have all of the other body's part before them. False where a plane has none of it.
bool OverlapSolid::keep_cutting(Body &body, const Body &other) const {
  std::size_t kept = 0;
  for (const Plane &plane : body.planes) {
    double least = HUGE_VAL, most = -HUGE_VAL;
    for (const Vec3 &p : other.outline) {
      const double below = plane.below(p);
      least = below < least ? below : least;
      most = below > most ? below : most;
    }
    if (!(most > 0.0)) return false;
    if (least > 1e-12 * size_ + 2.0 * fading_) continue;
    body.planes[kept++] = plane;
  }
  body.planes.resize(kept);
  return true;
}

// Of few planes the one beyond which the corner is farthest and that is not done, of many the farthest.
void OverlapSolid::find_plane(Body &body, Corner &corner) {
  if (!body.few_planes) {
    find_farthest_plane(body, corner);
    // What is at the border may be beyond it by rounding.
    if (std::find(done_faces_.begin(), done_faces_.end(), corner.plane) != done_faces_.end()) corner.below = HUGE_VAL;
    return;
  }
  corner.plane = 0;
  corner.below = HUGE_VAL;
  const Plane *const planes = body.planes.data();
  const auto count = static_cast<std::int32_t>(body.planes.size());
  for (std::int32_t k = 0; k < count; ++k) {
    const double below = planes[k].below(corner.at);
    const bool beyond = (below < corner.below) & ((done_ >> k & 1) == 0);
    corner.below = beyond ? below : corner.below;
    corner.plane = beyond ? k : corner.plane;
  }
}

// Beyond which the corner is by the greatest part of the body's own reach: a linear function on the corners of the polar body, which has
// no maximum but one.
void OverlapSolid::find_farthest_plane(Body &body, Corner &corner) {
  const convex::Polytope &geometry = body.geometry();
  const convex::Polytope::Face *const faces = geometry.faces().data();
  const Vec3 *const polar = body.side.body().polar_corners().data();
  const std::int32_t *const across = body.side.body().faces_across().data();
  const Vec3 place = transposed_times(body.in_axes.rotation, corner.at - body.in_axes.translation), at = place - geometry.center();
  std::int32_t best = body.last_plane, from = -1;
  double farthest = dot(polar[best], at);
  for (std::int32_t next_best = best;; best = next_best) {
    const convex::Polytope::Face &face = faces[best];
    for (std::int32_t k = face.first; k < face.first + face.count; ++k) {
      const std::int32_t next = across[k];
      if (next == from) continue;
      const double beyond = dot(polar[next], at);
      next_best = beyond > farthest ? next : next_best;
      farthest = beyond > farthest ? beyond : farthest;
    }
    if (next_best == best) break;
    from = best;
  }
  body.last_plane = corner.plane = best;
  corner.below = faces[best].offset - dot(faces[best].normal, place);
}

// Of many planes only those that may be one, as fine tessellations have none that are as good as parallel for long.
void OverlapSolid::find_alike() {
  alike_.clear();
  const bool few = a_.few_planes && b_.few_planes;
  const double least = few ? fading_cosine : same_plane_cosine;
  for (std::size_t i = 0; i < a_.planes.size(); ++i) {
    const Vec3 &normal = a_.planes[i].normal;
    if (!few && b_.side.body().greatest_face_cosine(transposed_times(b_.in_axes.rotation, normal)) < least - 1e-9) continue;
    for (std::size_t j = 0; j < b_.planes.size(); ++j) {
      if (dot(normal, b_.planes[j].normal) > least) alike_.push_back({i, j, false});
    }
  }
}

void OverlapSolid::start_polygon(Body &body, const Plane &face, Body &other) {
  const convex::Polytope::Face &corners = body.geometry().faces()[index(face.face)];
  const std::int32_t *const vertices = body.geometry().face_vertices().data() + corners.first;
  polygon_.clear();
  done_ = 0;
  done_faces_.clear();
  for (std::int32_t i = 0; i < corners.count; ++i) {
    Body::Mark &mark = body.marks[index(vertices[i])];
    if (mark.search != search_) {
      mark = {search_, static_cast<std::int32_t>(body.corners.size())};
      body.corners.push_back({body.in_axes(body.geometry().vertices()[index(vertices[i])]), -1, 0.0});
      find_plane(other, body.corners.back());
    }
    polygon_.push_back(body.corners[index(mark.place)]);
  }
}

// A plane that shall not cut the polygon. The numbers of corners that it concerns are forgotten.
void OverlapSolid::leave_out(const Body &other, std::size_t plane) {
  const std::int32_t number = other.few_planes ? static_cast<std::int32_t>(plane) : other.planes[plane].face;
  set_done(other, number);
  for (Corner &corner : polygon_) {
    if (corner.plane == number) corner.plane = -1;
  }
}

void OverlapSolid::set_done(const Body &other, std::int32_t plane) {
  if (other.few_planes) {
    done_ |= std::uint64_t{1} << plane;
  } else {
    done_faces_.push_back(plane);
  }
}

// Leaves of the polygon what lies in the other body, but for planes that are done already.
void OverlapSolid::cut_by(Body &other) {
  const double tolerance = 1e-15 * size_;
  for (;;) {
    std::int32_t worst = -1;
    double least = -tolerance;
    for (Corner &corner : polygon_) {
      if (corner.plane < 0) find_plane(other, corner);
      const bool worse = corner.below < least;
      worst = worse ? corner.plane : worst;
      least = worse ? corner.below : least;
    }
    if (worst < 0) return;
    set_done(other, worst);
    cut(other.numbered(worst));
  }
}

// Leaves of the polygon what lies below the plane. New corners have no face yet.
void OverlapSolid::cut(const Plane &plane) {
  cut_polygon_.clear();
  const Corner *last = &polygon_.back();
  double from = plane.below(last->at);
  for (const Corner &corner : polygon_) {
    const double to = plane.below(corner.at);
    if ((from >= 0.0) != (to >= 0.0)) {
      cut_polygon_.push_back({last->at + (from / (from - to)) * (corner.at - last->at), -1, 0.0});
    }
    if (to >= 0.0) cut_polygon_.push_back(corner);
    last = &corner, from = to;
  }
  polygon_.swap(cut_polygon_);
  if (polygon_.size() < 3) polygon_.clear();
}

void OverlapSolid::append(std::vector<Piece> &pieces, const Vec3 &normal, bool bounds, bool carries, const Plane *fades) {
  if (polygon_.empty()) return;
  pieces.push_back({points_.size(), polygon_.size(), normal, bounds, carries, fades});
  for (const Corner &corner : polygon_) points_.push_back(corner.at);
}

// Of faces that lie in one plane and look the same way, A's is the surface.
void OverlapSolid::cut_faces_of_a() {
  pieces_a_.clear();
  for (std::size_t i = 0; i < a_.planes.size(); ++i) {
    const Plane &face = a_.planes[i];
    start_polygon(a_, face, b_);
    for (Alike &alike : alike_) {
      const Plane &plane = b_.planes[alike.b];
      if (alike.a != i || !(dot(face.normal, plane.normal) > same_plane_cosine)) continue;
      alike.flush = true;
      for (const Corner &corner : polygon_) alike.flush &= std::fabs(plane.below(corner.at)) < flush_tolerance * size_;
      if (alike.flush) leave_out(b_, alike.b);
    }
    cut_by(b_);
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
  for (const Corner &corner : polygon_) least = std::fmin(least, beside.below(corner.at));
  if (least >= fading_) {
    append(pieces_b_, face.normal, true, true, nullptr);
    return;
  }
  fades_ = true;
  whole_ = polygon_;
  const auto leave = [&](const Plane &plane) {
    if (!polygon_.empty()) cut(plane);
  };
  if (!alike.flush) {
    leave(beside);
    append(pieces_b_, face.normal, true, false, nullptr);
  }
  polygon_ = whole_;
  leave({beside.normal, beside.offset - fading_, 0});
  append(pieces_b_, face.normal, false, true, nullptr);
  polygon_ = whole_;
  leave({beside.normal, beside.offset + fading_, 0});
  leave({-beside.normal, fading_ - beside.offset, 0});
  append(pieces_b_, face.normal, false, true, &beside);
}

// A corner in which many faces meet, whose moments are known then.
void OverlapSolid::set_origin() {
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
  origin_ = below_all(b_.planes, lowest) ? lowest : below_all(a_.planes, of_b) ? of_b : points_[0];
  for (Vec3 &p : points_) p = p - origin_;
}

// Sums of cones from the origin over the pieces.
bool OverlapSolid::find_moments() {
  double volume = 0.0, xx = 0.0, yy = 0.0, zz = 0.0, yz = 0.0, zx = 0.0, xy = 0.0;
  Vec3 first;
  for (const std::vector<Piece> *pieces : {&pieces_a_, &pieces_b_}) {
    for (const Piece &piece : *pieces) {
      const Vec3 *const corner = points_.data() + piece.first;
      const double height = dot(piece.normal, corner[0]);
      if (!piece.bounds || std::fabs(height) <= 1e-15 * size_) continue;
      const Vec3 p = corner[0];
      for (std::size_t i = 2; i < piece.count; ++i) {
        const Vec3 &q = corner[i - 1], &r = corner[i], sum = p + q + r;
        const double part = 0.5 * height * dot(piece.normal, cross(q - p, r - p));
        volume += part;
        first = first + part * sum;
        xx += part * (sum.x * sum.x + p.x * p.x + q.x * q.x + r.x * r.x);
        yy += part * (sum.y * sum.y + p.y * p.y + q.y * q.y + r.y * r.y);
        zz += part * (sum.z * sum.z + p.z * p.z + q.z * q.z + r.z * r.z);
        yz += part * (sum.y * sum.z + p.y * p.z + q.y * q.z + r.y * r.z);
        zx += part * (sum.z * sum.x + p.z * p.x + q.z * q.x + r.z * r.x);
        xy += part * (sum.x * sum.y + p.x * p.y + q.x * q.y + r.x * r.y);
      }
    }
  }
  if (!(volume > 0.0)) return false;
  volume_ = volume / 3.0;
  middle_ = (0.25 / volume) * first;
  const double part = 0.05 / volume;
  const Vec3 &m = middle_;
  spread_ = {{part * xx - m.x * m.x, part * yy - m.y * m.y, part * zz - m.z * m.z, part * yz - m.y * m.z, part * zx - m.z * m.x,
              part * xy - m.x * m.y}};
  return true;
}

}  // namespace cmb
