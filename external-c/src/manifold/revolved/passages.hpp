// Where a plane side's border goes over to a curve, or comes from there.
#pragma once

#include <vector>

#include "math/vector3.hpp"

namespace cmb {

struct Passage {
  double key = 0.0;  // grows counter-clockwise about the side
  double angle = 0.0, height = 0.0;
  bool to_curve = false;
  convex::Vec3 corner{};  // where it is, in the axes of the surface's nodes, where edges are fitted
};

// The passages of one curve about one side.
class Passages {
 public:
  void clear() { list_.clear(); }
  bool empty() const { return list_.empty(); }
  void add(const Passage &passage) { list_.push_back(passage); }

  struct Arc {
    Passage from, to;
    bool round = false;  // passes where keys begin
    bool empty = false;  // as good as: by rounding it may lead back
  };
  // Takes out the next passage to the curve and that from it where the curve leads. Those that are no farther apart than `rounding` are
  // one place: the arc is empty. False where none fits.
  bool take_arc(double rounding, Arc &arc);

 private:
  std::vector<Passage> list_;
};

}  // namespace cmb
