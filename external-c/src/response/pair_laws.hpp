// The laws of all pairs of bodies, kept as long as what they follow from stays the same.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "broadphase/collision_filter.hpp"
#include "contact_multibody_scene.h"
#include "response/damping_factor.hpp"
#include "response/pair_law.hpp"

namespace cmb {

// What a law chooses, and which properties are given.
using LawChoices = std::array<double, 16>;

// An integrator asks again and again with the same materials. So they are checked once, and combined once for each pair of
// materials; whether they are the same is seen by a comparison of all numbers. What is kept saves time and changes no answer.
class PairLaws {
 public:
  // Before the laws of pairs are asked for. Throws ResponseError where something is missing or out of its range. Law and
  // properties are borrowed until the next call.
  void prepare(const cmb_contact_law &law, const cmb_body_properties &properties, const CollisionFilter &filter);

  // The same before the laws of pairs among some bodies, 0-based: those of others need not be as they were, and are not looked at
  // where what is kept does for these.
  void prepare_among(const cmb_contact_law &law, const cmb_body_properties &properties, const CollisionFilter &filter,
                     const std::vector<std::uint32_t> &bodies);

  // Bodies are 0-based. Valid until the next call. Throws ResponseError where the stiffness is not finite.
  const PairLaw &of(std::size_t a, std::size_t b);

 private:
  bool holds_among(const LawChoices &choices, const CollisionFilter &filter,
                   const std::vector<std::uint32_t> &bodies) const;
  bool holds(const LawChoices &choices, const CollisionFilter &filter) const;
  void keep(const LawChoices &choices, const CollisionFilter &filter);
  void sort_materials();

  const cmb_contact_law *law_ = nullptr;
  const cmb_body_properties *properties_ = nullptr;
  DampingMemory damping_;

  bool kept_ = false;
  LawChoices choices_{};         // of the law
  std::vector<double> numbers_;  // of all bodies
  std::vector<char> fixed_;
  std::vector<std::uint32_t> material_;  // of each body, by what tells its laws; empty where there are too many
  std::size_t material_count_ = 0;
  std::vector<PairLaw> laws_;  // [material_count_][material_count_], where known
  std::vector<char> known_;
  PairLaw single_;
};

}  // namespace cmb
