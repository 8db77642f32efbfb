// A module of its own, loaded by coal_loader.cpp.
#include <coal/collision.h>
#include <coal/contact_patch.h>
#include <coal/shape/convex.h>
#include <coal/shape/geometric_shapes.h>

#include <cmath>

#include "contact_peer.hpp"

namespace cmb::bench {

namespace {

std::shared_ptr<coal::CollisionGeometry> coal_geometry(const Shape &shape) {
  const Vec3 &h = shape.body.half;
  switch (shape.kind) {
    case ShapeKind::halfspace: return std::make_shared<coal::Halfspace>(coal::Vec3s(0, 0, 1), 0.0);
    case ShapeKind::sphere: return std::make_shared<coal::Sphere>(shape.body.radius);
    case ShapeKind::capsule: return std::make_shared<coal::Capsule>(shape.body.radius, 2 * h.z);
    case ShapeKind::box: return std::make_shared<coal::Box>(2 * h.x, 2 * h.y, 2 * h.z);
    case ShapeKind::ellipsoid: return std::make_shared<coal::Ellipsoid>(h.x, h.y, h.z);
    case ShapeKind::cylinder: return std::make_shared<coal::Cylinder>(h.x, 2 * h.z);
    case ShapeKind::cone: return std::make_shared<coal::Cone>(h.x, 2 * h.z);
    default: break;  // a hull
  }
  // coal's polygons are triangles here: faces of more corners are cut into fans.
  const auto &polytope = shape.polytope->geometry();
  auto vertices = std::make_shared<std::vector<coal::Vec3s>>();
  auto triangles = std::make_shared<std::vector<coal::Triangle>>();
  for (const Vec3 &v : polytope.vertices()) vertices->emplace_back(v.x, v.y, v.z);
  for (const auto &face : polytope.faces()) {
    const auto corner = [&](std::int32_t k) {
      return static_cast<std::size_t>(polytope.face_vertices()[static_cast<std::size_t>(face.first + k)]);
    };
    for (std::int32_t k = 1; k + 1 < face.count; ++k) triangles->emplace_back(corner(0), corner(k), corner(k + 1));
  }
  const auto vertex_count = static_cast<unsigned>(vertices->size()), triangle_count = static_cast<unsigned>(triangles->size());
  return std::make_shared<coal::Convex<coal::Triangle>>(vertices, vertex_count, triangles, triangle_count);
}

std::vector<coal::Transform3s> transforms(const std::vector<Pose> &poses) {
  std::vector<coal::Transform3s> result;
  for (const Pose &pose : poses) {
    coal::Matrix3s rotation;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) rotation(i, j) = pose.rotation.row[i][j];
    }
    result.emplace_back(rotation, coal::Vec3s(pose.translation.x, pose.translation.y, pose.translation.z));
  }
  return result;
}

// coal's settings are its own; its functors, which look the pair's solver up once, are the quick way to ask it.
class CoalPeer : public ContactPeer {
 public:
  CoalPeer(const PosedPair &pair, bool with_patch)
      : a_(coal_geometry(pair.a)),
        b_(coal_geometry(pair.b)),
        at_a_(transforms(pair.pose_a)),
        at_b_(transforms(pair.pose_b)),
        collide_(a_.get(), b_.get()),
        find_patch_(a_.get(), b_.get()),
        request_(coal::CONTACT, 1),
        with_patch_(with_patch) {}

  double ask(std::size_t k) override {
    result_.clear();
    collide_(at_a_[k], at_b_[k], request_, result_);
    if (!result_.isCollision()) return std::nan("");
    if (with_patch_) {
      patches_.clear();
      find_patch_(at_a_[k], at_b_[k], result_, patch_request_, patches_);
    }
    return result_.getContact(0).penetration_depth;  // negative inside
  }

 private:
  std::shared_ptr<coal::CollisionGeometry> a_, b_;
  std::vector<coal::Transform3s> at_a_, at_b_;
  coal::ComputeCollision collide_;
  coal::ComputeContactPatch find_patch_;
  coal::CollisionRequest request_;
  coal::CollisionResult result_;
  coal::ContactPatchRequest patch_request_;
  coal::ContactPatchResult patches_;
  bool with_patch_;
};

}  // namespace

}  // namespace cmb::bench

extern "C" __attribute__((visibility("default"))) cmb::bench::ContactPeer *cmb_bench_coal_peer(const cmb::bench::PosedPair *pair, int with_patch) {
  return new cmb::bench::CoalPeer(*pair, with_patch != 0);
}
