#include <algorithm>
#include <cmath>
#include <tuple>

#include "math/pose_algebra.hpp"
#include "mesh/contact/ball_contacts.hpp"
#include "mesh/contact/mesh_contact.hpp"
#include "mesh/contact/rod_load.hpp"
#include "mesh/intersection/pierced_load.hpp"
#include "mesh/intersection/triangle_section.hpp"

namespace cmb::mesh {

namespace {

// A stretch of the axis, by parts of its length.
class Stretch {
 public:
  double begin() const { return begin_; }
  double end() const { return end_; }
  bool none() const { return !(begin_ <= end_); }
  void limit(double begin, double end) {
    begin_ = begin;
    end_ = end;
  }
  // Keeps where a value is at least `least` that runs straight from `first` at part 0 to `last` at part 1.
  void keep(double first, double last, double least) {
    if (first >= least && last >= least) return;
    if (first < least && last < least) {
      end_ = -1.0;
      return;
    }
    const double at = (least - first) / (last - first);
    if (first < least) {
      begin_ = std::fmax(begin_, at);
    } else {
      end_ = std::fmin(end_, at);
    }
  }

 private:
  double begin_ = 0.0, end_ = 1.0;
};

// Stretches over the triangles of one plane: between the two ends of them all the plane carries nothing more.
class PlaneStretches {
 public:
  explicit PlaneStretches(std::vector<PlaneStretch> &planes) : planes_(planes) { planes_.clear(); }

  void add(const Vec3 &normal, double offset, double tolerance, const PlaneStretch::End &begin, const PlaneStretch::End &end) {
    for (std::size_t i = planes_.size(); i-- > 0 && planes_.size() - i <= 16;) {
      PlaneStretch &plane = planes_[i];
      if (std::fabs(plane.offset - offset) > tolerance || norm2(plane.normal - normal) > 1e-18) continue;
      if (begin.part < plane.begin.part) plane.begin = begin;
      if (end.part > plane.end.part) plane.end = end;
      return;
    }
    planes_.push_back({normal, offset, begin, end});
  }

  void carry(double radius, RodLoad &load) const {
    for (const PlaneStretch &plane : planes_) {
      load.add(plane.begin.part, plane.normal, radius - plane.begin.height);
      load.add(plane.end.part, plane.normal, radius - plane.end.height);
    }
  }

 private:
  std::vector<PlaneStretch> &planes_;
};

// Everything in the mesh's frame but the result.
class CapsuleQuery {
 public:
  CapsuleQuery(double radius, double length, const Pose &body_in_mesh, const TriangleMesh &mesh, const Pose &pose,
               MeshContactScratch &scratch, ContactSet &result)
      : radius_(radius),
        mesh_(mesh),
        pose_(pose),
        body_(convex::make_capsule(radius, length), body_in_mesh, scratch.patch.polygon, scratch.patch.clipped),
        load_(scratch.rod),
        planes_(scratch.planes),
        edges_(scratch.edges),
        result_(result),
        begin_(result.points.size()),
        same_(place_tolerance(mesh)),
        slack_(1e-3 * same_),
        axis_(body_in_mesh.rotation.column(2)),
        from_(body_in_mesh({0, 0, -0.5 * length})),
        to_(body_in_mesh({0, 0, 0.5 * length})),
        along_(to_ - from_),
        per_length2_(1.0 / std::fmax(norm2(along_), 1e-300)) {
    load_.clear(axis_);
    edges_.clear();
  }

  void run() {
    end(0.0, from_);
    end(1.0, to_);
    visit();
    planes_.carry(radius_, load_);
    carry_edges();
    load_.solve();
    write_points();
    result_.normal = pose_.rotation * nearest_normal_;
    result_.distance = distance_;
    result_.witness = pose_(nearest_at_ - (radius_ + 0.5 * distance_) * nearest_normal_);
    // No section of a triangle is deeper than this. Of a capsule with its axis through a wall the ends push apart: only what
    // is left of that counts.
    const double deepest = crosses_ ? radius_ : -distance_;
    const double load = crosses_ ? norm(net_load(result_.points, begin_)) : total_load(result_.points, begin_);
    if (least_load_part * load < deepest) complete_contact(body_, mesh_, pose_, load, result_);
  }

 private:
  void keep_nearest(double distance, const Vec3 &at, const Vec3 &normal) {
    if (!(distance < distance_)) return;
    distance_ = distance;
    nearest_at_ = at;
    nearest_normal_ = normal;
  }

  Vec3 at(double part) const { return part < 0.5 ? from_ + part * along_ : to_ - (1.0 - part) * along_; }

  void end(double part, const Vec3 &center) {
    const NearestPoint nearest = mesh_.nearest(center);
    const double distance = mesh_.closed() ? nearest.distance : std::fabs(nearest.distance);
    keep_nearest(distance - radius_, center, nearest.normal);
    // In or below the surface only the nearest place tells the exit direction; above it all that are nearer than their
    // surroundings count.
    if (distance < radius_ && !(nearest.distance > same_)) {
      load_.add(part, nearest.normal, radius_ - distance, nearest_share(mesh_, nearest));
    }
  }

  // Calls place(part) at a stretch's ends and where it is nearest.
  template <typename Place>
  static void three_places(const Stretch &stretch, double nearest, const Place &place) {
    const double middle = std::fmin(stretch.end(), std::fmax(stretch.begin(), nearest));
    place(middle);
    if (stretch.begin() < middle) place(stretch.begin());
    if (stretch.end() > middle) place(stretch.end());
  }

  // A stretch over an edge or a corner. `share(direction)`: of the load.
  template <typename Offset, typename Share>
  void round_feature(const Stretch &stretch, double nearest, const Offset &offset, const Share &share) {
    three_places(stretch, nearest, [&](double part) {
      const Vec3 off = offset(part);
      const double distance = norm(off);
      if (!(distance > same_)) return;
      const Vec3 direction = (1.0 / distance) * off;
      keep_nearest(distance - radius_, at(part), direction);
      if (distance < radius_) load_.add(part, direction, radius_ - distance, share(direction));
    });
  }

  // The edge beyond side k of triangle t, which runs along `side`; `inside`: how far the axis' ends are on the triangle's side
  // of it.
  void edge(std::uint32_t t, std::size_t k, const Vec3 &side, double inside_from, double inside_to, double slack) {
    const Vec3 &corner = mesh_.corner(t, k), &normal = mesh_.face_normal(t);
    const Vec3 off_from = from_ - corner, off_to = to_ - corner;
    const double length2 = norm2(side), part_from = dot(off_from, side), part_to = dot(off_to, side);
    Stretch beside;
    beside.keep(part_from, part_to, 0.0);
    beside.keep(-part_from, -part_to, -length2);
    if (beside.none()) return;
    const auto offset = [&](double part) {
      const Vec3 off = at(part) - corner;
      return off - (dot(off, side) / length2) * side;
    };
    const Vec3 first = offset(0.0), across = along_ - (dot(along_, side) / length2) * side;
    const double across2 = norm2(across), nearest = across2 > 0.0 ? -dot(first, across) / across2 : 0.5;
    Stretch stretch = beside;
    stretch.keep(-inside_from, -inside_to, -slack);
    const std::int32_t other = mesh_.neighbour(t, k);
    if (other >= 0) {
      const Vec3 &beyond = mesh_.face_normal(static_cast<std::uint32_t>(other)), inward = cross(side, beyond);
      if (norm2(beyond - normal) < 1e-18) return;  // no edge, but the middle of a plane
      const double over_from = dot(off_from, inward), over_to = dot(off_to, inward);
      if (dot(normal, inward) > 0.0) {
        // Of a concave edge each side reaches on over the other, the less the farther.
        const auto reach_on = [&](double first_value, double last_value, const Vec3 &over, const Vec3 &pushed) {
          Stretch part = beside;
          part.keep(-first_value, -last_value, 0.0);
          part.keep(dot(off_from, over), dot(off_to, over), 0.0);
          if (!part.none()) edges_.push_back({edge_of(t, k), part.begin(), part.end(), nearest, corner, side, pushed, t, k, false});
        };
        reach_on(inside_from, inside_to, beyond, normal);
        reach_on(over_from, over_to, normal, beyond);
        return;
      }
      stretch.keep(-over_from, -over_to, -slack);
    }
    if (stretch.none()) return;
    const Vec3 middle = mesh_.edge_normal(t, k);
    stretch.keep(dot(off_from, middle), dot(off_to, middle), 0.0);
    if (stretch.none()) return;
    three_places(stretch, nearest, [&](double part) {
      const Vec3 off = offset(part);
      const double distance = norm(off);
      if (distance > same_) keep_nearest(distance - radius_, at(part), (1.0 / distance) * off);
    });
    edges_.push_back({edge_of(t, k), stretch.begin(), stretch.end(), nearest, corner, side, {}, t, k, true});
  }

  // The edge between two flat faces has a number; where there is but one triangle each side of a rim has.
  std::uint64_t edge_of(std::uint32_t t, std::size_t k) const {
    const std::int32_t other = mesh_.neighbour(t, k);
    if (other < 0) return ~((std::uint64_t{t} << 2) + k);
    const std::uint64_t own = mesh_.faces().face_of(t), beyond = mesh_.faces().face_of(static_cast<std::uint32_t>(other));
    return (std::min(own, beyond) << 32) + std::max(own, beyond);
  }

  // Stretches over sides of one edge that follow each other are one.
  void carry_edges() {
    const auto order = [](const EdgeStretch &a) {
      return std::tie(a.edge, a.round, a.pushed.x, a.pushed.y, a.pushed.z, a.begin, a.end, a.triangle, a.side_number);
    };
    std::sort(edges_.begin(), edges_.end(), [&](const EdgeStretch &a, const EdgeStretch &b) { return order(a) < order(b); });
    for (std::size_t i = 0; i < edges_.size();) {
      EdgeStretch whole = edges_[i];
      for (++i; i < edges_.size(); ++i) {
        const EdgeStretch &next = edges_[i];
        if (next.edge != whole.edge || next.round != whole.round || norm2(next.pushed - whole.pushed) > 1e-18) break;
        if (next.begin > whole.end + 1e-9) break;
        whole.end = std::fmax(whole.end, next.end);
      }
      carry(whole);
    }
  }

  void carry(const EdgeStretch &edge) {
    const double length2 = norm2(edge.side);
    Stretch stretch;
    stretch.limit(edge.begin, edge.end);
    three_places(stretch, edge.nearest, [&](double part) {
      const Vec3 from_corner = at(part) - edge.corner;
      const Vec3 off = from_corner - (dot(from_corner, edge.side) / length2) * edge.side;
      const double distance = norm(off);
      if (!(distance < radius_)) return;
      if (!edge.round) {
        load_.add(part, edge.pushed, radius_ - distance);
      } else if (distance > same_) {
        const Vec3 direction = (1.0 / distance) * off;
        load_.add(part, direction, radius_ - distance, edge_share(mesh_, edge.triangle, edge.side_number, direction));
      }
    });
  }

  // Whether a vertex is but a point of a flat face, or of the edge between two.
  bool is_plain(std::uint32_t v) const {
    const std::uint32_t begin = mesh_.vertex_begin(v), end = mesh_.vertex_begin(v + 1);
    const std::uint32_t first = mesh_.faces().face_of(mesh_.vertex_triangles()[begin]);
    std::uint32_t second = first;
    for (std::uint32_t i = begin; i < end; ++i) {
      const std::uint32_t t = mesh_.vertex_triangles()[i], face = mesh_.faces().face_of(t);
      if (face != first && second == first) second = face;
      if (face != first && face != second) return false;
      for (std::size_t k = 0; k < 3; ++k) {
        if (mesh_.neighbour(t, k) < 0) return false;
      }
    }
    return true;
  }

  void vertex(std::uint32_t v) {
    const Vec3 &corner = mesh_.vertices()[v];
    const Vec3 off_from = from_ - corner, off_to = to_ - corner;
    Stretch stretch;
    stretch.keep(dot(off_from, mesh_.vertex_normal(v)), dot(off_to, mesh_.vertex_normal(v)), 0.0);
    for (std::uint32_t i = mesh_.vertex_begin(v); i < mesh_.vertex_begin(v + 1); ++i) {
      for (const std::uint32_t w : mesh_.triangles()[mesh_.vertex_triangles()[i]]) {
        if (w == v) continue;
        if (stretch.none()) return;
        const Vec3 side = mesh_.vertices()[w] - corner;
        stretch.keep(-dot(off_from, side), -dot(off_to, side), -slack_ * norm(side));
      }
    }
    if (stretch.none() || is_plain(v)) return;
    const double nearest = -per_length2_ * dot(off_from, along_);
    round_feature(
        stretch, nearest, [&](double part) { return at(part) - corner; },
        [&](const Vec3 &direction) { return vertex_share(mesh_, v, direction); });
  }

  // Where the axis passes through a triangle, the surfaces meet however far the ends and all edges are.
  void crossing(std::uint32_t t, double height_from, double height_to) {
    const Vec3 &normal = mesh_.face_normal(t);
    const Vec3 place = from_ + (height_from / (height_from - height_to)) * along_;
    // Where it passes through an edge, rounding must not leave out both sides.
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 side = mesh_.corner(t, k + 1) - mesh_.corner(t, k);
      if (dot(normal, cross(side, place - mesh_.corner(t, k))) < -same_ * norm(side)) return;
    }
    crosses_ = true;
    keep_nearest(-radius_, place, normal);
  }

  // Whether the plane that parts the axis from the triangle's first corner shows that the triangle is out of reach.
  bool out_of_reach(std::uint32_t t, double reach) const {
    const Vec3 &first = mesh_.corner(t, 0);
    const double part = std::fmin(1.0, std::fmax(0.0, per_length2_ * dot(first - from_, along_)));
    const Vec3 foot = from_ + part * along_, off = first - foot;
    const double nearest =
        std::fmin(norm2(off), std::fmin(dot(off, mesh_.corner(t, 1) - foot), dot(off, mesh_.corner(t, 2) - foot)));
    return nearest > 0.0 && nearest * nearest > reach * reach * norm2(off);
  }

  void triangle(std::uint32_t t) {
    const double reach = radius_ + std::fmax(0.0, distance_);
    if (out_of_reach(t, reach)) return;
    const Vec3 &normal = mesh_.face_normal(t);
    const Vec3 &first = mesh_.corner(t, 0);
    const double offset = dot(normal, first);
    const double height_from = dot(normal, from_ - first), height_to = dot(normal, to_ - first);
    if (std::fmin(height_from, height_to) > reach || std::fmax(height_from, height_to) < -reach) return;
    if (!crosses_ && (height_from > 0.0) != (height_to > 0.0)) crossing(t, height_from, height_to);
    Stretch over;
    over.keep(height_from, height_to, 0.0);
    bool beyond_from[3], beyond_to[3];  // where a corner may be nearest
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 &corner = mesh_.corner(t, k);
      const Vec3 side = mesh_.corner(t, k + 1) - corner, inward = cross(normal, side);
      const double slack = slack_ * norm(side);
      const double inside_from = dot(from_ - corner, inward), inside_to = dot(to_ - corner, inward);
      beyond_from[k] = dot(from_ - corner, side) > slack && dot(to_ - corner, side) > slack;
      beyond_to[k] = dot(from_ - mesh_.corner(t, k + 1), side) < -slack && dot(to_ - mesh_.corner(t, k + 1), side) < -slack;
      if (!over.none()) over.keep(inside_from, inside_to, -slack);
      const std::int32_t other = mesh_.neighbour(t, k);
      if (other < 0 || static_cast<std::uint32_t>(other) > t) edge(t, k, side, inside_from, inside_to, slack);
    }
    if (!over.none()) {
      const auto end_at = [&](double part) {
        return PlaneStretch::End{part, (1.0 - part) * height_from + part * height_to};
      };
      const PlaneStretch::End begin = end_at(over.begin()), end = end_at(over.end());
      if (std::fmin(begin.height, end.height) < radius_) planes_.add(normal, offset, same_, begin, end);
    }
    for (std::size_t k = 0; k < 3; ++k) {
      if (beyond_from[k] || beyond_to[(k + 2) % 3]) continue;
      const std::uint32_t v = mesh_.triangles()[t][k];
      if (mesh_.vertex_triangles()[mesh_.vertex_begin(v)] == t) vertex(v);
    }
  }

  void visit() {
    Bounds box;
    for (int k = 0; k < 3; ++k) {
      box.low.set(k, std::fmin(from_[k], to_[k]));
      box.high.set(k, std::fmax(from_[k], to_[k]));
    }
    const auto reach = [&] {
      const double farthest = radius_ + std::fmax(0.0, distance_);
      return farthest * farthest;
    };
    mesh_.hierarchy().visit_near(box, reach, [&](std::uint32_t t) { triangle(t); });
  }

  void write_points() {
    double sum = 0.0;
    for (std::size_t i = 0; i < load_.size(); ++i) sum += load_[i].load;
    if (!(sum > 0.0)) return;
    // Energy that changes with the direction alone asks for a torque; a shift of the points supplies it, as on a half-space.
    const Vec3 shift = pose_.rotation * ((1.0 / sum) * load_.missing());
    for (std::size_t i = 0; i < load_.size(); ++i) {
      const RodLoad::Contact &contact = load_[i];
      if (!(contact.load > 0.0)) continue;
      const Vec3 place = pose_(at(contact.place) - (radius_ - 0.5 * contact.depth) * contact.normal);
      result_.points.push_back({contact.depth, contact.load / contact.depth, pose_.rotation * contact.normal, place + shift});
    }
  }

  double radius_;
  const TriangleMesh &mesh_;
  const Pose &pose_;
  SectionedBody body_;
  RodLoad &load_;
  PlaneStretches planes_;
  std::vector<EdgeStretch> &edges_;
  ContactSet &result_;
  std::size_t begin_;
  double same_, slack_;  // m: places that are one, and rounding
  Vec3 axis_, from_, to_, along_;
  double per_length2_;
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
