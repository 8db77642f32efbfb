#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/mesh_contact.hpp"
#include "mesh/polytope_distance.hpp"
#include "geometry/pose_algebra.hpp"

namespace cmb::mesh {

namespace {

constexpr std::size_t most_points = 64;    // merging takes the cube of their number
constexpr std::size_t split_patches = 16;  // patches that give several points each

// A flat patch below a triangle, or a part of one.
struct Patch {
  double area = 0.0;     // m2, as seen along the triangle's normal
  double load = 0.0;     // m3, integral of the depth over it
  double energy = 0.0;   // m4, integral of the depth squared
  Vec3 moment;           // m4, integral of depth times place
};

// Of triangle pqr with depths at its corners; `cosine` is that between its plane and the contact plane.
Patch linear_patch(const Vec3 &p, const Vec3 &q, const Vec3 &r, double dp, double dq, double dr, double cosine) {
  Patch patch;
  patch.area = 0.5 * norm(cross(q - p, r - p)) * cosine;
  const double sum = dp + dq + dr;
  patch.load = patch.area * sum / 3.0;
  patch.energy = patch.area * (sum * sum + dp * dp + dq * dq + dr * dr) / 12.0;
  patch.moment = (patch.area / 12.0) * ((dp + sum) * p + (dq + sum) * q + (dr + sum) * r);
  return patch;
}

// Everything in the mesh's frame but the result.
class PolytopeQuery {
 public:
  PolytopeQuery(const convex::Polytope &body, const Pose &body_in_mesh, const TriangleMesh &mesh, const Pose &pose,
                MeshContactScratch &scratch, ContactSet &result)
      : body_(body), mesh_(mesh), pose_(pose), scratch_(scratch), result_(result), begin_(result.points.size()) {
    scratch.body_vertices.clear();
    scratch.body_normals.clear();
    for (const Vec3 &v : body.vertices()) scratch.body_vertices.push_back(body_in_mesh(v));
    for (const auto &face : body.faces()) scratch.body_normals.push_back(body_in_mesh.rotation * face.normal);
    box_ = {scratch.body_vertices[0], scratch.body_vertices[0]};
    for (const Vec3 &v : scratch.body_vertices) {
      for (int k = 0; k < 3; ++k) {
        box_.low.set(k, std::fmin(box_.low[k], v[k]));
        box_.high.set(k, std::fmax(box_.high[k], v[k]));
      }
    }
    size_ = 0.5 * norm(box_.high - box_.low);
  }

  void run() {
    mesh_.hierarchy().visit_near(
        box_, [&] { return size_ * size_; }, [&](std::uint32_t t) { triangle(t); });
    if (deepest_ > 0.0 && result_.points.size() > begin_) {
      // Patches that belong to another side do not count, unless there are no others.
      const double area = carrying_area_ + (1.0 - most_carried_) * area_;
      for (std::size_t i = begin_; i < result_.points.size(); ++i) result_.points[i].weight /= area;
      thin();
      result_.distance = -deepest_;
      result_.normal = pose_.rotation * deepest_normal_;
      result_.witness = pose_(deepest_place_ + (0.5 * deepest_) * deepest_normal_);
    } else {
      apart();
    }
  }

 private:
  // The part of the body's surface that triangle t pushes.
  void triangle(std::uint32_t t) {
    const Vec3 &normal = mesh_.face_normal(t), &a = mesh_.corner(t, 0);
    const double offset = dot(normal, a);
    double lowest = std::numeric_limits<double>::infinity();
    for (const Vec3 &v : scratch_.body_vertices) lowest = std::fmin(lowest, dot(normal, v));
    if (!(lowest < offset)) return;
    Vec3 side[3];
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 along = normalized(mesh_.corner(t, k + 1) - mesh_.corner(t, k));
      const Vec3 inward = cross(normal, along);
      const std::int32_t other = mesh_.neighbour(t, k);
      const Vec3 sum = other < 0 ? normal : normal + mesh_.face_normal(static_cast<std::uint32_t>(other));
      side[k] = normalized(cross(sum, along), inward);
    }
    const double limit = std::fmin(mesh_.depth_limit(t), size_);
    for (std::size_t f = 0; f < scratch_.body_normals.size(); ++f) {
      const double cosine = -dot(scratch_.body_normals[f], normal);
      if (!(cosine > 0.0)) continue;
      const convex::Polytope::Face &face = body_.faces()[f];
      std::vector<Vec3> &polygon = scratch_.polygon;
      polygon.clear();
      for (std::int32_t i = face.first; i < face.first + face.count; ++i) {
        polygon.push_back(
            scratch_.body_vertices[static_cast<std::size_t>(body_.face_vertices()[static_cast<std::size_t>(i)])]);
      }
      clip_polygon(polygon, -normal, -offset, scratch_.clipped);
      if (polygon.empty()) continue;
      clip_polygon(polygon, normal, offset - limit, scratch_.clipped);
      for (std::size_t k = 0; k < 3 && !polygon.empty(); ++k) {
        clip_polygon(polygon, side[k], dot(side[k], mesh_.corner(t, k)), scratch_.clipped);
      }
      if (polygon.size() >= 3) patch(normal, offset, cosine);
    }
  }

  // What scratch_.polygon carries, as several points that keep its load's place and moments.
  void patch(const Vec3 &normal, double offset, double cosine) {
    const std::vector<Vec3> &polygon = scratch_.polygon;
    const auto depth = [&](const Vec3 &p) { return std::fmax(0.0, offset - dot(normal, p)); };
    Vec3 middle;
    for (const Vec3 &p : polygon) middle = middle + p;
    middle = (1.0 / static_cast<double>(polygon.size())) * middle;
    const double middle_depth = depth(middle);
    const double carried = inside_share(middle, middle_depth);
    ++patches_;
    Patch whole;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec3 &p = polygon[i], &q = polygon[i + 1 == polygon.size() ? 0 : i + 1];
      const double dp = depth(p);
      const Patch part = linear_patch(middle, p, q, middle_depth, dp, depth(q), cosine);
      if (part.load > 0.0 && carried > 0.0 && dp > deepest_) {
        deepest_ = dp;
        deepest_place_ = p;
        deepest_normal_ = normal;
      }
      if (patches_ <= split_patches) {
        add(part, carried, normal);
      } else {
        whole.area += part.area;
        whole.load += part.load;
        whole.energy += part.energy;
        whole.moment = whole.moment + part.moment;
      }
    }
    if (patches_ > split_patches) add(whole, carried, normal);
  }

  void add(const Patch &patch, double carried, const Vec3 &normal) {
    area_ += patch.area;
    carrying_area_ += carried * patch.area;
    if (patch.load > 0.0) most_carried_ = std::fmax(most_carried_, carried);
    const double load = carried * patch.load;
    if (!(load > 0.0)) return;
    const double depth = patch.energy / patch.load;
    if (!(depth > 0.0)) return;
    const Vec3 place = (1.0 / patch.load) * patch.moment + (0.5 * depth) * normal;
    result_.points.push_back({depth, load / depth, pose_.rotation * normal, pose_(place)});
  }

  // 1 where the triangle's plane is what is nearest to a point behind it; falls to 0 where another part of the surface
  // is nearer by half, as on the far side of a thin wall.
  double inside_share(const Vec3 &p, double depth) const {
    if (!mesh_.closed() || !(depth > 0.0)) return 1.0;
    return std::fmin(1.0, std::fmax(0.0, -2.0 * mesh_.nearest(p).distance / depth - 1.0 + 1e-9));
  }

  // Merges neighbours until there are few; keeps the sum of forces.
  void thin() {
    std::vector<ContactPoint> &points = result_.points;
    while (points.size() - begin_ > most_points) {
      std::size_t kept = begin_;
      for (std::size_t i = begin_; i < points.size(); i += 2, ++kept) {
        points[kept] = points[i];
        if (i + 1 == points.size()) continue;
        const ContactPoint &a = points[i], &b = points[i + 1];
        const double load_a = a.weight * a.depth, load_b = b.weight * b.depth, load = load_a + load_b;
        const Vec3 force = load_a * a.normal + load_b * b.normal;
        ContactPoint merged;
        merged.depth = (load_a * a.depth + load_b * b.depth) / load;
        merged.weight = norm(force) / merged.depth;
        merged.normal = normalized(force, a.normal);
        merged.position = (1.0 / load) * (load_a * a.position + load_b * b.position);
        points[kept] = merged;
      }
      points.resize(kept);
    }
  }

  void apart() {
    PolytopeDistance best;
    best.distance = std::numeric_limits<double>::infinity();
    std::uint32_t nearest = 0;
    // The extents along the best direction so far bound the distance of the others.
    Vec3 direction;
    double lowest = 0.0;
    mesh_.hierarchy().visit_near(
        box_, [&] { return best.distance * best.distance; },
        [&](std::uint32_t t) {
          const double highest = std::fmax(dot(direction, mesh_.corner(t, 0)),
                                           std::fmax(dot(direction, mesh_.corner(t, 1)), dot(direction, mesh_.corner(t, 2))));
          if (lowest - highest > best.distance) return;
          const PolytopeDistance candidate =
              triangle_polytope_distance(mesh_.corner(t, 0), mesh_.corner(t, 1), mesh_.corner(t, 2), body_,
                                         scratch_.body_vertices, scratch_.body_normals, scratch_.polygon,
                                         scratch_.clipped);
          if (candidate.distance < best.distance || (candidate.distance == best.distance && t < nearest)) {
            best = candidate;
            nearest = t;
            direction = normalized(best.on_body - best.on_triangle, mesh_.face_normal(t));
            lowest = std::numeric_limits<double>::infinity();
            for (const Vec3 &v : scratch_.body_vertices) lowest = std::fmin(lowest, dot(direction, v));
          }
        });
    result_.distance = best.distance;
    result_.normal = pose_.rotation * normalized(best.on_body - best.on_triangle, mesh_.face_normal(nearest));
    result_.witness = pose_(0.5 * (best.on_body + best.on_triangle));
  }

  const convex::Polytope &body_;
  const TriangleMesh &mesh_;
  const Pose &pose_;
  MeshContactScratch &scratch_;
  ContactSet &result_;
  std::size_t begin_;
  Bounds box_;
  double size_ = 0.0;
  double area_ = 0.0, carrying_area_ = 0.0;
  double most_carried_ = 0.0;
  std::size_t patches_ = 0;
  double deepest_ = 0.0;
  Vec3 deepest_place_, deepest_normal_;
};

}  // namespace

void polytope_contact(const convex::Polytope &body, const Pose &body_pose, const TriangleMesh &mesh, const Pose &pose,
                      MeshContactScratch &scratch, ContactSet &result) {
  PolytopeQuery(body, relative_pose(pose, body_pose), mesh, pose, scratch, result).run();
}

}  // namespace cmb::mesh
