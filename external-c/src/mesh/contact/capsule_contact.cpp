#include <algorithm>
#include <cmath>

#include "manifold/rod_end_share.hpp"
#include "math/pose_algebra.hpp"
#include "mesh/contact/ball_contacts.hpp"
#include "mesh/contact/mesh_contact.hpp"
#include "mesh/core/segment_distance.hpp"
#include "mesh/intersection/pierced_load.hpp"
#include "mesh/intersection/triangle_section.hpp"

namespace cmb::mesh {

namespace {

// The translation that frees a ball.
Vec3 escape_translation(const SharedLoad &shared) {
  Vec3 sum;
  for (std::size_t i = 0; i < shared.size(); ++i) sum = sum + shared[i].load * shared[i].normal;
  return sum;
}

// Everything in the mesh's frame but the result.
class CapsuleQuery {
 public:
  CapsuleQuery(double radius, double length, const Pose &body_in_mesh, const TriangleMesh &mesh, const Pose &pose,
               MeshContactScratch &scratch, ContactSet &result)
      : radius_(radius),
        mesh_(mesh),
        pose_(pose),
        place_(body_in_mesh),
        body_(convex::make_capsule(radius, length), place_, scratch.patch.polygon, scratch.patch.clipped),
        shared_(scratch.shared),
        result_(result),
        begin_(result.points.size()),
        axis_(body_in_mesh.rotation.column(2)),
        from_(body_in_mesh({0, 0, -0.5 * length})),
        to_(body_in_mesh({0, 0, 0.5 * length})) {}

  void run() {
    const NearestPoint nearest_from = mesh_.nearest(from_), nearest_to = mesh_.nearest(to_);
    free_from_ = end(from_, nearest_from, -1.0);
    free_to_ = end(to_, nearest_to, 1.0);
    shift_ends();
    between();
    result_.normal = pose_.rotation * nearest_normal_;
    result_.distance = distance_;
    result_.witness = pose_(nearest_at_ - (radius_ + 0.5 * distance_) * nearest_normal_);
    // No section of a triangle is deeper than this. Of a capsule with its axis through a wall the ends push apart: only what
    // is left of that counts.
    const double deepest = crosses_ ? radius_ : -distance_, load = crosses_ ? net_load() : total_load(result_.points, begin_);
    if (least_load_part * load < deepest) complete_contact(body_, mesh_, pose_, load, result_);
  }

 private:
  double net_load() const {
    Vec3 sum;
    for (std::size_t i = begin_; i < result_.points.size(); ++i) {
      sum = sum + (result_.points[i].weight * result_.points[i].depth) * result_.points[i].normal;
    }
    return norm(sum);
  }

  void keep_nearest(double distance, const Vec3 &at, const Vec3 &normal) {
    if (!(distance < distance_)) return;
    distance_ = distance;
    nearest_at_ = at;
    nearest_normal_ = normal;
  }

  // `at`: the point of the axis that the contact belongs to.
  void add(const Vec3 &at, const Vec3 &normal, double depth, double load) {
    if (!(load > 0.0)) return;
    result_.points.push_back(
        {depth, load / depth, pose_.rotation * normal, pose_(at - (radius_ - 0.5 * depth) * normal)});
  }

  Vec3 end(const Vec3 &center, const NearestPoint &nearest, double sense) {
    keep_nearest(ball_contacts(center, radius_, mesh_, nearest, shared_), center, nearest.normal);
    for (std::size_t i = 0; i < shared_.size(); ++i) {
      const double sine = -sense * dot(axis_, shared_[i].normal);
      const double limited = std::fmin(1.0, std::fmax(-1.0, sine));
      const double share = 0.5 * (1.0 + end_share_difference(limited));
      const Vec3 &normal = shared_[i].normal;
      const double load = shared_[i].load, depth = shared_[i].depth;
      add(center, normal, depth, share * load);
      ends_load_ += share * load;
      const Vec3 across = axis_ - dot(axis_, normal) * normal;
      missing_ = missing_ + (0.25 * sense * end_share_slope(limited) * load * depth) * across;
    }
    return escape_translation(shared_);
  }

  // Energy that changes with the direction alone asks for a torque; a shift of the points supplies it, as on a
  // half-space.
  void shift_ends() {
    if (!(ends_load_ > 0.0)) return;
    const Vec3 shift = pose_.rotation * ((1.0 / ends_load_) * missing_);
    for (std::size_t i = begin_; i < result_.points.size(); ++i) {
      result_.points[i].position = result_.points[i].position + shift;
    }
  }

  // A place of the mesh that is nearest to the inside of the axis.
  void place(double part, const Vec3 &point, const Vec3 &direction, double distance, double share) {
    const Vec3 at = from_ + part * (to_ - from_);
    keep_nearest(distance - radius_, at, direction);
    const Vec3 freed = (1.0 - part) * free_from_ + part * free_to_;
    const double rest = radius_ - distance - dot(freed, direction);
    if (rest > 0.0 && share > 0.0) shared_.add({rest, share, direction, point}, place_tolerance(mesh_));
  }

  // An edge along the axis is as near as its ends are: rounding must not leave out both.
  double slack(double distance) const { return 1e-3 * place_tolerance(mesh_) + 1e-14 * distance; }

  void edge(std::uint32_t t, std::size_t k) {
    const SegmentPoints points =
        nearest_of_segments(from_, to_ - from_, mesh_.corner(t, k), mesh_.corner(t, k + 1) - mesh_.corner(t, k));
    if (!(points.s > 0.0 && points.s < 1.0 && points.t > 0.0 && points.t < 1.0)) return;
    const Vec3 off = points.first - points.second;
    const double distance = norm(off);
    if (!(distance > place_tolerance(mesh_)) || !edge_is_nearest(mesh_, t, k, off, slack(distance))) return;
    const Vec3 direction = (1.0 / distance) * off;
    place(points.s, points.second, direction, distance, edge_share(mesh_, t, k, direction));
  }

  void vertex(std::uint32_t v) {
    const Vec3 &point = mesh_.vertices()[v];
    const Vec3 along = to_ - from_;
    const double part = dot(point - from_, along) / norm2(along);
    if (!(part > 0.0 && part < 1.0)) return;
    const Vec3 off = from_ + part * along - point;
    const double distance = norm(off);
    if (!(distance > place_tolerance(mesh_)) || !vertex_is_nearest(mesh_, v, off, slack(distance))) return;
    const Vec3 direction = (1.0 / distance) * off;
    place(part, point, direction, distance, vertex_share(mesh_, v, direction));
  }

  // Where the axis passes through a triangle, the surfaces meet however far the ends and all edges are.
  void crossing(std::uint32_t t) {
    const Vec3 &a = mesh_.corner(t, 0), &b = mesh_.corner(t, 1), &c = mesh_.corner(t, 2), &normal = mesh_.face_normal(t);
    const double height_from = dot(normal, from_ - a), height_to = dot(normal, to_ - a);
    if ((height_from > 0.0) == (height_to > 0.0)) return;
    const Vec3 at = from_ + (height_from / (height_from - height_to)) * (to_ - from_);
    // Where it passes through an edge, rounding must not leave out both sides.
    const auto inside = [&](const Vec3 &from, const Vec3 &to) {
      return dot(normal, cross(to - from, at - from)) >= -place_tolerance(mesh_) * norm(to - from);
    };
    if (!inside(a, b) || !inside(b, c) || !inside(c, a)) return;
    crosses_ = true;
    keep_nearest(0.0, at, normal);
  }

  void between() {
    shared_.clear();
    Bounds box;
    for (int k = 0; k < 3; ++k) {
      box.low.set(k, std::fmin(from_[k], to_[k]));
      box.high.set(k, std::fmax(from_[k], to_[k]));
    }
    const auto reach = [&] {
      const double farthest = radius_ + std::fmax(0.0, distance_);
      return farthest * farthest;
    };
    mesh_.hierarchy().visit_near(box, reach, [&](std::uint32_t t) {
      if (!crosses_) crossing(t);
      for (std::size_t k = 0; k < 3; ++k) {
        const std::int32_t other = mesh_.neighbour(t, k);
        if (other < 0 || static_cast<std::uint32_t>(other) > t) edge(t, k);
        const std::uint32_t v = mesh_.triangles()[t][k];
        if (mesh_.vertex_triangles()[mesh_.vertex_begin(v)] == t) vertex(v);
      }
    });
    shared_.solve();
    for (std::size_t i = 0; i < shared_.size(); ++i) {
      // The point of the axis over the place, and the depth before the ends took their part.
      const Vec3 along = to_ - from_;
      const double part = dot(shared_[i].position - from_, along) / norm2(along);
      const Vec3 at = from_ + std::fmin(1.0, std::fmax(0.0, part)) * along;
      const double depth = radius_ - norm(at - shared_[i].position);
      if (depth > 0.0) add(at, shared_[i].normal, depth, shared_[i].load);
    }
  }

  double radius_;
  const TriangleMesh &mesh_;
  const Pose &pose_;
  const Pose &place_;
  SectionedBody body_;
  SharedLoad &shared_;
  ContactSet &result_;
  std::size_t begin_;
  Vec3 axis_, from_, to_;
  double ends_load_ = 0.0;
  Vec3 missing_;
  Vec3 free_from_, free_to_;  // what would free the ends
  double distance_ = HUGE_VAL;
  bool crosses_ = false;  // the axis and the mesh
  Vec3 nearest_at_, nearest_normal_;
};

}  // namespace

void capsule_contact(double radius, double length, const Pose &body_pose, const TriangleMesh &mesh, const Pose &pose,
                     MeshContactScratch &scratch, ContactSet &result) {
  const Pose body_in_mesh = relative_pose(pose, body_pose);
  CapsuleQuery(radius, length, body_in_mesh, mesh, pose, scratch, result).run();
}

}  // namespace cmb::mesh
