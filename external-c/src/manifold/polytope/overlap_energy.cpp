#include "manifold/polytope/overlap_energy.hpp"

namespace cmb {

namespace {

// Integrals over the surface of a quadric, and of place times quadric; places are from the overlap's middle.
class SurfaceIntegral {
 public:
  explicit SurfaceIntegral(const Quadric &quadric) : q_(quadric) {}

  void add(const OverlapSolid &solid, const OverlapSolid::Piece &piece) {
    const Vec3 *const corners = solid.points().data() + piece.first, middle = solid.middle();
    double whole = 0.0;
    Vec3 places;
    const Corner p = corner(corners[0] - middle);
    Corner q = corner(corners[1] - middle);
    for (std::size_t i = 2; i < piece.count; ++i) {
      const Corner r = corner(corners[i] - middle);
      const double area = 0.5 * dot(piece.normal, cross(q.at - p.at, r.at - p.at));
      if (piece.fades == nullptr) {
        add_triangle(area, p, q, r, whole, places);
      } else {
        add_faded(area, p.at, q.at, r.at, solid, *piece.fades, whole, places);
      }
      q = r;
    }
    force_ = force_ + whole * piece.normal;
    torque_ = torque_ + cross(places, piece.normal);
  }

  const Vec3 &force() const { return force_; }
  const Vec3 &torque() const { return torque_; }

 private:
  // A place with the quadric's polar plane and value there.
  struct Corner {
    Vec3 at, gradient;
    double rest, value;
  };
  Corner corner(const Vec3 &p) const {
    const Vec3 gradient = convex::times(q_.squares, p) - q_.linear;
    const double rest = q_.constant - dot(q_.linear, p);
    return {p, gradient, rest, dot(gradient, p) + rest};
  }

  // Exact: integrals of products of two and three barycentric coordinates are area/12 and area/60, twice that where two are
  // equal, six times where three are.
  static void add_triangle(double area, const Corner &p, const Corner &q, const Corner &r, double &whole, Vec3 &places) {
    const Vec3 sum = p.at + q.at + r.at, gradient = p.gradient + q.gradient + r.gradient;
    const double rest = p.rest + q.rest + r.rest;
    const double with_p = dot(gradient, p.at) + rest, with_q = dot(gradient, q.at) + rest, with_r = dot(gradient, r.at) + rest;
    const double all = with_p + with_q + with_r + p.value + q.value + r.value, part = area / 60.0;
    whole += 5.0 * part * all;
    places = places + (part * all) * sum + (2.0 * part * (with_p + p.value)) * p.at + (2.0 * part * (with_q + q.value)) * q.at +
             (2.0 * part * (with_r + r.value)) * r.at;
  }

  // Times a share that grows linearly: by the rule of six places that is exact to the fourth degree (Dunavant 1985).
  void add_faded(double area, const Vec3 &p, const Vec3 &q, const Vec3 &r, const OverlapSolid &solid,
                 const OverlapSolid::Plane &fades, double &whole, Vec3 &places) const {
    constexpr struct {
      double weight, near;
    } rule[2] = {{0.223381589678011, 0.445948490915965}, {0.109951743655322, 0.091576213509771}};
    const Vec3 sum = p + q + r;
    for (const auto &node : rule) {
      for (const Vec3 *apart : {&p, &q, &r}) {
        const Vec3 at = node.near * (sum - *apart) + (1.0 - 2.0 * node.near) * *apart;
        const double part = node.weight * area * solid.share(fades, at + solid.middle()) * corner(at).value;
        whole += part;
        places = places + part * at;
      }
    }
  }

  const Quadric q_;
  Vec3 force_, torque_;
};

}  // namespace

// The means over the overlap O of B's squares q_B have the gradient, by A's motion v, of the integral of (q_B - mean) n.v / |O| over A's
// surface in B; those of A's squares change as if B moved by -v. Both are sums over one of the two surfaces, as an integral over all of
// the overlap's surface is one over its inside.
void OverlapEnergy::find(const OverlapSolid &solid, const ContactPolytope &a, const Pose &a_in_axes, const ContactPolytope &b,
                         const Pose &b_in_axes) {
  of_a_.find(solid.middle(), solid.spread(), a, a_in_axes);
  of_b_.find(solid.middle(), solid.spread(), b, b_in_axes);
  energy_ = 0.75 * (of_a_.least() + of_b_.least());
  Quadric both = of_a_.squares();
  both.squares.add(1.0, of_b_.squares().squares);
  both.linear = both.linear + of_b_.squares().linear;
  both.constant += of_b_.squares().constant - of_a_.least() - of_b_.least();
  const bool over_b = solid.fades() || solid.pieces_b().size() <= solid.pieces_a().size();
  SurfaceIntegral surface(both);
  for (const OverlapSolid::Piece &piece : over_b ? solid.pieces_b() : solid.pieces_a()) {
    if (piece.carries) surface.add(solid, piece);
  }
  const double sense = over_b ? 0.75 : -0.75, part = sense / solid.volume();
  const DepthBelowFaces &inside = over_b ? of_b_ : of_a_;
  force_ = part * surface.force() + (2.0 * sense) * inside.squares().linear;
  torque_ = part * surface.torque() - sense * inside.moment();
}

}  // namespace cmb
