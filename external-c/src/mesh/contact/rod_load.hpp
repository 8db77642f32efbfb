// What places of a surface carry of a rod together.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "math/vector3.hpp"

namespace cmb::mesh {

using convex::Vec3;

// Contacts of a capsule's axis with several places of a surface, each at a part s of the way along it.
//
// The ends move by u0 and u1, what is between by (1 - s) u0 + s u1. Sought is the least such motion, by (|u0|^2 + |u1|^2) / 4,
// that frees the axis of all contacts, n_i . u(s_i) >= need_i; its multipliers are the loads. With the features
// phi_i = sqrt(2) ((1 - s_i) n_i, s_i n_i) they are the solution of
//   maximise  sum load_i need_i - 1/2 |sum load_i phi_i|^2,   load_i >= 0.
// A contact that others imply carries nothing: of a plane, whatever lies between the two ends of the stretch over it; of an
// edge or a corner, what lies in the shadow of its neighbours. So contacts come and go without a jump, and it does not matter
// how a face is cut into triangles. Lying, a rod in the middle of a plane carries half of each end's depth. Inclined, what
// is near the lower end counts more by the ends' shares on a half-space: on a plane the loads are those of a half-space.
//
// Contacts that push against each other cannot all be freed; so the sum of load_i |phi_i|^2 / need_i is at most `most_loads`,
// which contacts that do not oppose each other never reach. The off-diagonal products count 1 - 1e-9 times, so that the
// loads are unique and continuous.
class RodLoad {
 public:
  struct Contact {
    double part = 0.0;   // along the axis, 0 to 1
    double place = 0.0;  // the same of the load: nearer to the lower end of an inclined rod
    double need = 0.0;  // m, > 0: the depth, times a share beside the rim of a sheet
    double depth = 0.0, load = 0.0;
    Vec3 normal;  // unit
    std::array<double, 6> feature{};
    double norm2 = 0.0;  // of the feature
  };

  // `axis`: unit, from the end at part 0 to that at part 1.
  void clear(const Vec3 &axis);
  std::size_t size() const { return contacts_.size(); }
  const Contact &operator[](std::size_t i) const { return contacts_[i]; }

  // `share`, 0 to 1: of the depth, that counts. Where nothing counts nothing is added.
  void add(double part, const Vec3 &normal, double depth, double share = 1.0);
  void solve();

  // What the loads lack as a gradient, because shares change with the inclination: the sum of loads times a shift of their
  // points (m2, perpendicular to the normals).
  Vec3 missing() const { return missing_; }

 private:
  static constexpr std::size_t most_active = 32;
  double solve_with(double relief);
  void share_by_inclination();
  bool solve_active(std::size_t count, std::array<double, most_active> &solution) const;
  double need(std::size_t i, double relief) const {
    return contacts_[i].need - relief * contacts_[i].norm2 / contacts_[i].need;
  }

  Vec3 axis_, missing_;
  std::vector<Contact> contacts_;
  std::vector<double> needs_;
  std::vector<unsigned char> is_active_;
  std::array<std::size_t, most_active> active_{};
};

}  // namespace cmb::mesh
