#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/collision_object.h>

#include <cmath>

#include "contact_peer.hpp"

namespace cmb::bench {

namespace {

std::shared_ptr<fcl::CollisionGeometryd> fcl_geometry(const Shape &shape) {
  const Vec3 &h = shape.body.half;
  switch (shape.kind) {
    case ShapeKind::halfspace: return std::make_shared<fcl::Halfspaced>(fcl::Vector3d(0, 0, 1), 0.0);
    case ShapeKind::sphere: return std::make_shared<fcl::Sphered>(shape.body.radius);
    case ShapeKind::capsule: return std::make_shared<fcl::Capsuled>(shape.body.radius, 2 * h.z);
    case ShapeKind::box: return std::make_shared<fcl::Boxd>(2 * h.x, 2 * h.y, 2 * h.z);
    case ShapeKind::ellipsoid: return std::make_shared<fcl::Ellipsoidd>(h.x, h.y, h.z);
    case ShapeKind::cylinder: return std::make_shared<fcl::Cylinderd>(h.x, 2 * h.z);
    case ShapeKind::cone: return std::make_shared<fcl::Coned>(h.x, 2 * h.z);
    default: break;  // a hull
  }
  const auto &polytope = shape.polytope->geometry();
  auto vertices = std::make_shared<std::vector<fcl::Vector3d>>();
  auto faces = std::make_shared<std::vector<int>>();
  for (const Vec3 &v : polytope.vertices()) vertices->emplace_back(v.x, v.y, v.z);
  for (const auto &face : polytope.faces()) {
    faces->push_back(face.count);
    for (int k = 0; k < face.count; ++k) {
      faces->push_back(polytope.face_vertices()[static_cast<std::size_t>(face.first + k)]);
    }
  }
  return std::make_shared<fcl::Convexd>(vertices, static_cast<int>(polytope.faces().size()), faces);
}

std::vector<fcl::Transform3d> transforms(const std::vector<Pose> &poses) {
  std::vector<fcl::Transform3d> result;
  for (const Pose &pose : poses) {
    fcl::Transform3d transform = fcl::Transform3d::Identity();
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) transform.linear()(i, j) = pose.rotation.row[i][j];
      transform.translation()(i) = pose.translation[i];
    }
    result.push_back(transform);
  }
  return result;
}

class FclPeer : public ContactPeer {
 public:
  explicit FclPeer(const PosedPair &pair)
      : a_(fcl_geometry(pair.a)),
        b_(fcl_geometry(pair.b)),
        at_a_(transforms(pair.pose_a)),
        at_b_(transforms(pair.pose_b)),
        request_(8, true) {
    // The other solver, built on libccd, ends the program on some inputs: Debian keeps FCL's asserts.
    request_.gjk_solver_type = fcl::GST_INDEP;
  }

  double ask(std::size_t k) override {
    fcl::CollisionResultd result;
    try {
      fcl::collide(a_.get(), at_a_[k], b_.get(), at_b_[k], request_, result);
    } catch (const std::exception &) {
      return std::nan("");
    }
    if (!result.isCollision()) return std::nan("");
    double depth = -HUGE_VAL;
    for (std::size_t i = 0; i < result.numContacts(); ++i) {
      depth = std::fmax(depth, result.getContact(i).penetration_depth);
    }
    return -depth;
  }

 private:
  std::shared_ptr<fcl::CollisionGeometryd> a_, b_;
  std::vector<fcl::Transform3d> at_a_, at_b_;
  fcl::CollisionRequestd request_;
};

}  // namespace

std::unique_ptr<ContactPeer> make_fcl_collide(const PosedPair &pair) { return std::make_unique<FclPeer>(pair); }

}  // namespace cmb::bench
