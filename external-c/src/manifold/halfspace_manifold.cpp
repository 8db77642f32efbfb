#include "manifold/halfspace_manifold.hpp"

#include <cmath>

#include "manifold/axis_share.hpp"

namespace cmb {

namespace {

// Collects the points of one shape; everything in the shape's frame, where the obstacle lies towards `down`.
class Collector {
 public:
  Collector(const Pose &pose, const Plane &plane, ContactSet &result)
      : pose_(pose),
        plane_(plane),
        result_(result),
        begin_(result.points.size()),
        down_(-transposed_times(pose.rotation, plane.normal)),
        offset_(dot(plane.normal, pose.translation) - plane.offset) {}

  const Vec3 &down() const { return down_; }

  // Height above the plane of a point of the shape.
  double height(const Vec3 &p) const { return offset_ - dot(down_, p); }

  // A point of the shape that carries `weight`, and that weight's derivative by the direction `down`.
  void add(const Vec3 &p, double weight, const Vec3 &weight_gradient = {}) {
    const double depth = -height(p);
    if (!(depth > 0.0) || !(weight > 0.0)) return;
    result_.points.push_back({depth, weight, plane_.normal, pose_(p) + 0.5 * depth * plane_.normal});
    load_ += weight * depth;
    missing_ = missing_ + 0.5 * depth * depth * weight_gradient;
  }

  // Ends the collection: `lowest` is the shape's lowest point.
  void finish(const Vec3 &lowest) {
    result_.distance = height(lowest);
    result_.normal = plane_.normal;
    result_.witness = pose_(lowest) - 0.5 * result_.distance * plane_.normal;
    if (result_.points.size() == begin_) return;
    // Energy that changes with the direction alone asks for a torque; a shift of the points supplies it.
    const Vec3 tangential = missing_ - dot(missing_, down_) * down_;
    const Vec3 shift = (1.0 / load_) * (pose_.rotation * tangential);
    for (std::size_t i = begin_; i < result_.points.size(); ++i) {
      result_.points[i].position = result_.points[i].position + shift;
    }
    limit_load(result_.points, begin_);
  }

 private:
  const Pose &pose_;
  const Plane &plane_;
  ContactSet &result_;
  std::size_t begin_;
  Vec3 down_;
  double offset_;
  double load_ = 0.0;
  Vec3 missing_;
};

void polytope_contact(const ContactPolytope &polytope, Collector &collector) {
  const std::vector<Vec3> &vertices = polytope.geometry().vertices();
  std::size_t lowest = 0;
  double lowest_height = collector.height(vertices[0]);
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const double height = collector.height(vertices[v]);
    if (height < lowest_height) {
      lowest_height = height;
      lowest = v;
    }
    if (!(height < 0.0)) continue;
    Vec3 gradient;
    const double share = polytope.share(static_cast<std::int32_t>(v), collector.down(), &gradient);
    collector.add(vertices[v], share, gradient);
  }
  collector.finish(vertices[lowest]);
}

void capsule_contact(const convex::ConvexBody &body, Collector &collector) {
  const Vec3 &down = collector.down();
  const double sine = down.z;
  const double difference = end_share_difference(sine), slope = end_share_slope(sine);
  const Vec3 upper = Vec3{0, 0, body.half.z} + body.radius * down, lower = Vec3{0, 0, -body.half.z} + body.radius * down;
  collector.add(upper, 0.5 * (1.0 + difference), {0, 0, 0.5 * slope});
  collector.add(lower, 0.5 * (1.0 - difference), {0, 0, -0.5 * slope});
  collector.finish(sine < 0.0 ? lower : upper);
}

void single_point_contact(const convex::ConvexBody &body, Collector &collector) {
  const Vec3 lowest = convex::core_support(body, collector.down()).point + body.radius * collector.down();
  collector.add(lowest, 1.0);
  collector.finish(lowest);
}

}  // namespace

void halfspace_contact(const Shape &shape, const Pose &pose, const Plane &plane, ContactSet &result) {
  Collector collector(pose, plane, result);
  switch (shape.kind) {
    case ShapeKind::box:
    case ShapeKind::hull:
      polytope_contact(*shape.polytope, collector);
      return;
    case ShapeKind::capsule:
      capsule_contact(shape.body, collector);
      return;
    default:
      single_point_contact(shape.body, collector);
      return;
  }
}

}  // namespace cmb
