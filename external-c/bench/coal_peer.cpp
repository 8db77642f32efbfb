// A module of its own, loaded by coal_loader.cpp.
#include <coal/collision.h>
#include <coal/contact_patch.h>

#include <cmath>

#include "backend/coal_geometry.hpp"
#include "contact_peer.hpp"

namespace cmb::bench {

namespace {

std::vector<coal::Transform3s> transforms(const std::vector<Pose> &poses) {
  std::vector<coal::Transform3s> result;
  for (const Pose &pose : poses) result.push_back(coal_transform(pose));
  return result;
}

// coal's settings are its own; its functors, which look the pair's solver up once, are the quick way to ask it.
class CoalPeer : public ContactPeer {
 public:
  CoalPeer(const PosedPair &pair, bool with_patch)
      : a_(coal_geometry(pair.a)),
        b_(pair.is_of_equals() ? a_ : coal_geometry(pair.b)),
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

extern "C" __attribute__((visibility("default"))) cmb::bench::ContactPeer *cmb_bench_coal_peer(
    const cmb::bench::PosedPair *pair, int with_patch) {
  return new cmb::bench::CoalPeer(*pair, with_patch != 0);
}
