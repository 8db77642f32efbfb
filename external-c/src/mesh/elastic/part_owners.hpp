// What the overlap behind a flat face counts as where there is little of it beside what is behind its neighbours.
#pragma once

#include <cstddef>
#include <vector>

#include "mesh/core/face_relations.hpp"
#include "mesh/elastic/wedge_integrals.hpp"

namespace cmb::mesh {

// Places in the plane between two wedges are equally deep behind both faces. If these counted together with different others, the energy of a place would
// be another one on either side, and a flat side of the body in that plane would change the force at once. So of what is behind a face, as long as
// that is little, all counts as what is behind the neighbours it goes over into (FaceRelations), in proportion to the squares of their I2; of more and more
// of it less and less does. What is little because it is shallow beside them, as of a body that just touches a floor, counts by itself.
class PartOwners {
 public:
  // Takes the parts' I2 and I4. `radius`: of the body.
  void assign(const FaceRelations &relations, const std::vector<WedgeIntegrals::Part> &parts, double radius);

  // Calls act(i, j, share): the share of part i that counts as part j, i = j included; where it is not 0.
  template <typename Act>
  void visit(Act &&act) const {
    for (std::size_t i = 0; i < own_.size(); ++i) {
      if (own_[i].kept > 0.0) act(i, i, own_[i].kept);
    }
    for (const Given &given : given_) {
      if (const double share = share_of(given); share > 0.0) act(given.from, given.to, share);
    }
  }
  // Adds the derivatives by the parts' I2 and I4 of the sum of share(i, j) * gain(i, j) over all.
  template <typename Gain>
  void add_derivatives(Gain &&gain, std::vector<double> &by_second, std::vector<double> &by_fourth) {
    for (Own &own : own_) own.gained = 0.0;
    for (const Given &given : given_) {
      Own &own = own_[given.from];
      const Own &other = own_[given.to];
      const double more = gain(given.from, given.to) - gain(given.from, given.from);
      const double square = other.content * other.content, by_alike = own.little * square / own.beside * more * given.slope;
      own.gained += square * given.alike * more;
      by_second[given.to] += 2.0 * own.little * given.alike * square / own.beside * more * other.by_second;
      by_second[given.to] += by_alike * other.by_second, by_fourth[given.to] -= by_alike * other.by_fourth;
      by_second[given.from] -= by_alike * own.by_second, by_fourth[given.from] += by_alike * own.by_fourth;
    }
    for (const Given &given : given_) {
      const Own &own = own_[given.from], &other = own_[given.to];
      const double square = other.content * other.content, ratio = own.content * own.content / own.beside;
      by_second[given.to] -= 2.0 * (own.slope * ratio + own.little) * own.gained / own.beside * square / own.beside * other.by_second;
    }
    for (std::size_t i = 0; i < own_.size(); ++i) {
      const Own &own = own_[i];
      if (own.gained != 0.0) by_second[i] += 2.0 * own.slope * (own.content * own.content / own.beside) * own.gained / own.beside * own.by_second;
    }
  }

 private:
  struct Own {
    double content = 0.0;                      // I2 by the greatest of all
    double by_second = 0.0, by_fourth = 0.0;   // 1 by I2 and I4: the derivatives of their logarithms
    double beside = 0.0;                       // the sum of the neighbours' squares of content
    double little = 0.0, slope = 0.0;          // 1 where the content is next to nothing, and its derivative by content^2 / beside
    double kept = 1.0;                         // the share that counts as itself
    double gained = 0.0;                       // room
  };
  struct Given {
    std::size_t from, to;
    double alike = 0.0, slope = 0.0;  // 0 where the one is much less deep, and its derivative by the logarithm of I4/I2
  };
  double share_of(const Given &given) const {
    const Own &own = own_[given.from], &other = own_[given.to];
    return own.little > 0.0 ? own.little * given.alike * other.content * other.content / own.beside : 0.0;
  }

  std::vector<Own> own_;
  std::vector<Given> given_;
};

}  // namespace cmb::mesh
