// What a query of a whole scene found, for those that follow with some bodies at the same poses.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "contact_multibody.h"
#include "scene/scene.hpp"

namespace cmb {

// The answers of one query, pair by pair. Where both bodies of a pair stand exactly as they stood then, a query would find
// the same bits: it is a function of the poses. Derivatives by difference quotients move one body or limb at a time, and
// integrators come back to a point. One for each thread.
class QueryMemory {
 public:
  // A query begins: compares poses, which have been checked, with those that are remembered.
  void begin(const Scene &scene, const cmb_poses &poses, double exact_within, std::size_t point_capacity);

  // Whether the answer for a pair (0-based) is known; writes it then.
  bool recall(std::size_t pair, const cmb_contact_points &points);

  // The query has ended, its answer is in `points`: remembers it where little of it was known, so that what is one body's
  // move away from many queries stays.
  void end(const cmb_poses &poses, const cmb_contact_points &points);

 private:
  std::uint64_t scene_number_ = 0;  // 0: nothing is remembered
  const Scene *scene_ = nullptr;    // that is asked, during a query
  double exact_within_ = 0.0;
  std::size_t point_capacity_ = 0, recalled_ = 0;
  std::vector<double> position_, rotation_;                        // as callers give them
  std::vector<double> distance_, depth_, weight_, normal_, point_;  // as callers get them
  std::vector<char> stands_;                                       // of each body: it stands as it did
};

}  // namespace cmb
