#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "contact_multibody.h"
#include "contact_peer.hpp"
#include "support/engine_calls.hpp"

namespace cmb::bench {

namespace {

constexpr std::size_t capacity = 8;
constexpr double hardly_apart = 1e-9;  // m; whose bounds are farther apart than twice this do not touch

class EnginePeer : public ContactPeer {
 public:
  EnginePeer(const PosedPair &pair, double exact_within) : exact_within_(exact_within) {
    const char *geometry[] = {pair.descriptor_a.c_str(), pair.descriptor_b.c_str()};
    const int pairs[] = {1, 2};
    if (cmb::test::intern_scene(geometry, 2, pairs, 1, CMB_BACKEND_AUTO, &scene_) != CMB_OK) {
      std::fprintf(stderr, "%s\n", cmb_last_error());
      std::exit(1);
    }
    for (std::size_t k = 0; k < pair.pose_a.size(); ++k) {
      for (const Pose *pose : {&pair.pose_a[k], &pair.pose_b[k]}) {
        for (int i = 0; i < 3; ++i) position_.push_back(pose->translation[i]);
        for (int i = 0; i < 3; ++i) {
          for (int j = 0; j < 3; ++j) rotation_.push_back(pose->rotation.row[j][i]);
        }
      }
    }
  }

  double ask(std::size_t k) override {
    double distance = 0.0;
    const cmb_status status = cmb::test::query_scene(scene_, &position_[6 * k], &rotation_[18 * k], 2, 1, capacity, &distance, depth_,
                                                     weight_, normal_, point_, exact_within_);
    if (status != CMB_OK) {  // to refuse is quicker than to answer
      std::fprintf(stderr, "%s\n", cmb_last_error());
      std::exit(1);
    }
    return distance;
  }

 private:
  double exact_within_;  // m
  cmb_scene scene_{};
  std::vector<double> position_, rotation_;
  double depth_[capacity], weight_[capacity], normal_[3 * capacity], point_[3 * capacity];
};

}  // namespace

std::unique_ptr<ContactPeer> make_engine(const PosedPair &pair) { return std::make_unique<EnginePeer>(pair, HUGE_VAL); }

std::unique_ptr<ContactPeer> make_engine_within_bounds(const PosedPair &pair) { return std::make_unique<EnginePeer>(pair, hardly_apart); }

}  // namespace cmb::bench
