// What contacts with different normals carry together.
#pragma once

#include <array>
#include <cstddef>

#include "math/vector3.hpp"

namespace cmb::mesh {

using convex::Vec3;

// Contacts of one ball with several places of a surface.
//
// The smallest translation u that frees the ball of all contacts (n_i . u >= depth_i for each) is a sum of loads times
// normals, u = sum load_i n_i with load_i >= 0. These loads count what two contacts have in common once: two that
// push the same way carry together what one would, two at right angles carry their full depths, and one that the
// others' translation frees already carries nothing, so that it may vanish without a jump. No contact carries more
// than its depth, which settles opposite contacts. Loads are the solution of
//   maximise  sum load_i depth_i - 1/2 load . G load,   0 <= load_i <= depth_i,
// with G_ii = 1 and G_ij = (1 - 1e-6) n_i . n_j: positive definite, so that the loads are unique and continuous.
class SharedLoad {
 public:
  static constexpr std::size_t capacity = 48;

  struct Contact {
    double depth = 0.0;  // m, > 0
    Vec3 normal;  // unit
    Vec3 push;    // unit, the way of what it carries: the normal, but from behind the rim of a sheet
    Vec3 position;
    double load = 0.0;
  };

  void clear() { count_ = 0; }
  std::size_t size() const { return count_; }
  const Contact &operator[](std::size_t i) const { return contacts_[i]; }

  // Contacts of one place (to `same`, m) with one normal count once; where there are too many the shallowest go.
  void add(const Contact &contact, double same);
  void solve();
  // The translation, of what was solved.
  Vec3 translation() const;

 private:
  double gram(std::size_t i, std::size_t j) const;
  std::array<Contact, capacity> contacts_;
  std::size_t count_ = 0;
};

}  // namespace cmb::mesh
