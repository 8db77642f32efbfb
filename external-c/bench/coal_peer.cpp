// A module of its own, loaded by coal_loader.cpp.
#include <coal/BV/OBBRSS.h>
#include <coal/BVH/BVH_model.h>
#include <coal/collision.h>
#include <coal/contact_patch.h>
#include <coal/distance.h>

#include <cmath>
#include <memory>

#include "backend/coal_geometry.hpp"
#include "contact_peer.hpp"
#include "mesh/core/triangle_mesh.hpp"

namespace cmb::bench {

namespace {

std::vector<coal::Transform3s> transforms(const std::vector<Pose> &poses) {
  std::vector<coal::Transform3s> result;
  for (const Pose &pose : poses) result.push_back(coal_transform(pose));
  return result;
}

std::shared_ptr<coal::CollisionGeometry> geometry_of(const Shape &shape) {
  if (!shape.mesh) return coal_geometry(shape);
  std::vector<coal::Vec3s> vertices;
  std::vector<coal::Triangle> triangles;
  for (const Vec3 &v : shape.mesh->vertices()) vertices.emplace_back(v.x, v.y, v.z);
  for (const auto &t : shape.mesh->triangles()) triangles.emplace_back(t[0], t[1], t[2]);
  auto model = std::make_shared<coal::BVHModel<coal::OBBRSS>>();
  model->beginModel();
  model->addSubModel(vertices, triangles);
  model->endModel();
  return model;
}

// The bodies of a pair where they are.
class CoalPair : public ContactPeer {
 protected:
  explicit CoalPair(const PosedPair &pair)
      : a_(geometry_of(pair.a)),
        b_(pair.is_of_equals() ? a_ : geometry_of(pair.b)),
        at_a_(transforms(pair.pose_a)),
        at_b_(transforms(pair.pose_b)) {}

  std::shared_ptr<coal::CollisionGeometry> a_, b_;
  std::vector<coal::Transform3s> at_a_, at_b_;
};

// coal's settings are its own; its functors, which look the pair's solver up once, are the quick way to ask it.
class CoalPeer : public CoalPair {
 public:
  CoalPeer(const PosedPair &pair, bool with_patch)
      : CoalPair(pair),
        collide_(a_.get(), b_.get()),
        request_(coal::CONTACT, pair.has_mesh() ? 1000000 : 1) {
    if (with_patch && !pair.has_mesh()) find_patch_ = std::make_unique<coal::ComputeContactPatch>(a_.get(), b_.get());
  }

  double ask(std::size_t k) override {
    result_.clear();
    collide_(at_a_[k], at_b_[k], request_, result_);
    if (!result_.isCollision()) return std::nan("");
    if (find_patch_) {
      patches_.clear();
      (*find_patch_)(at_a_[k], at_b_[k], result_, patch_request_, patches_);
    }
    return result_.getContact(0).penetration_depth;  // negative inside
  }

 private:
  coal::ComputeCollision collide_;
  std::unique_ptr<coal::ComputeContactPatch> find_patch_;  // null: none is asked for
  coal::CollisionRequest request_;
  coal::CollisionResult result_;
  coal::ContactPatchRequest patch_request_;
  coal::ContactPatchResult patches_;
};

class CoalDistance : public CoalPair {
 public:
  explicit CoalDistance(const PosedPair &pair) : CoalPair(pair), find_(a_.get(), b_.get()) {}

  double ask(std::size_t k) override {
    result_.clear();
    return find_(at_a_[k], at_b_[k], request_, result_);
  }

 private:
  coal::ComputeDistance find_;
  coal::DistanceRequest request_;
  coal::DistanceResult result_;
};

}  // namespace

}  // namespace cmb::bench

extern "C" __attribute__((visibility("default"))) cmb::bench::ContactPeer *cmb_bench_coal_peer(
    const cmb::bench::PosedPair *pair, int with_patch) {
  return new cmb::bench::CoalPeer(*pair, with_patch != 0);
}

extern "C" __attribute__((visibility("default"))) cmb::bench::ContactPeer *cmb_bench_coal_distance(const cmb::bench::PosedPair *pair) {
  return new cmb::bench::CoalDistance(*pair);
}
