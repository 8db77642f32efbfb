#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/OBBRSS.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <cmath>

#include "backend/fcl_geometry.hpp"
#include "contact_peer.hpp"
#include "mesh/core/triangle_mesh.hpp"

namespace cmb::bench {

namespace {

std::vector<fcl::Transform3d> transforms(const std::vector<Pose> &poses) {
  std::vector<fcl::Transform3d> result;
  for (const Pose &pose : poses) result.push_back(fcl_transform(pose));
  return result;
}

std::shared_ptr<fcl::CollisionGeometryd> geometry_of(const Shape &shape) {
  if (!shape.mesh) return fcl_geometry(shape);
  std::vector<fcl::Vector3d> vertices;
  std::vector<fcl::Triangle> triangles;
  for (const Vec3 &v : shape.mesh->vertices()) vertices.emplace_back(v.x, v.y, v.z);
  for (const auto &t : shape.mesh->triangles()) triangles.emplace_back(t[0], t[1], t[2]);
  auto model = std::make_shared<fcl::BVHModel<fcl::OBBRSSd>>();
  model->beginModel();
  model->addSubModel(vertices, triangles);
  model->endModel();
  return model;
}

// Those of a mesh are its crossings: all of them.
std::size_t contact_limit(const PosedPair &pair) { return pair.has_mesh() ? 1000000 : 8; }

// The bodies of a pair where they are.
class FclPair : public ContactPeer {
 protected:
  explicit FclPair(const PosedPair &pair)
      : a_(geometry_of(pair.a)),
        b_(pair.is_of_equals() ? a_ : geometry_of(pair.b)),
        at_a_(transforms(pair.pose_a)),
        at_b_(transforms(pair.pose_b)) {}

  // The other one, built on libccd, ends the program on some inputs: Debian keeps FCL's asserts.
  static constexpr fcl::GJKSolverType solver = fcl::GST_INDEP;
  std::shared_ptr<fcl::CollisionGeometryd> a_, b_;
  std::vector<fcl::Transform3d> at_a_, at_b_;
};

class FclPeer : public FclPair {
 public:
  explicit FclPeer(const PosedPair &pair) : FclPair(pair), request_(contact_limit(pair), true) { request_.gjk_solver_type = solver; }

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
  fcl::CollisionRequestd request_;
};

class FclDistance : public FclPair {
 public:
  explicit FclDistance(const PosedPair &pair) : FclPair(pair) { request_.gjk_solver_type = solver; }

  double ask(std::size_t k) override {
    fcl::DistanceResultd result;
    try {
      return fcl::distance(a_.get(), at_a_[k], b_.get(), at_b_[k], request_, result);
    } catch (const std::exception &) {
      return std::nan("");
    }
  }

 private:
  fcl::DistanceRequestd request_;
};

}  // namespace

std::unique_ptr<ContactPeer> make_fcl_collide(const PosedPair &pair) { return std::make_unique<FclPeer>(pair); }

std::unique_ptr<ContactPeer> make_fcl_distance(const PosedPair &pair) { return std::make_unique<FclDistance>(pair); }

}  // namespace cmb::bench
