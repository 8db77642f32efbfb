#include "manifold/polytope/overlap_energy.hpp"

#include <cmath>

namespace cmb {

namespace {

double fourth(double x) { return x * x * x * x; }

// Integrals over the surface of a quadric, and of place times quadric.
class SurfaceIntegral {
 public:
  explicit SurfaceIntegral(const Quadric &quadric) : q_(quadric) {}

  void add(const OverlapSolid &solid, const OverlapSolid::Piece &piece) {
    const Vec3 *const corners = solid.points().data() + piece.first;
    double whole = 0.0;
    Vec3 places;
    const Corner p = corner(corners[0]);
    Corner q = corner(corners[1]);
    for (std::size_t i = 2; i < piece.count; ++i) {
      const Corner r = corner(corners[i]);
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
    const Vec3 gradient{q_.xx * p.x + q_.xy * p.y + q_.zx * p.z + q_.linear.x, q_.xy * p.x + q_.yy * p.y + q_.yz * p.z + q_.linear.y,
                        q_.zx * p.x + q_.yz * p.y + q_.zz * p.z + q_.linear.z};
    const double rest = dot(q_.linear, p) + q_.constant;
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
        const double part = node.weight * area * solid.share(fades, at) * corner(at).value;
        whole += part;
        places = places + part * at;
      }
    }
  }

  const Quadric q_;
  Vec3 force_, torque_;
};

}  // namespace

void OverlapEnergy::weigh(const OverlapSolid &solid, const ContactPolytope &body, const Pose &in_axes, Depth &depth) {
  const std::vector<convex::Polytope::Face> &faces = body.geometry().faces();
  const Vec3 &middle = solid.middle();
  const double(&m)[6] = solid.spread();
  const Vec3 own_middle = transposed_times(in_axes.rotation, middle + solid.origin() - in_axes.translation);
  const auto mean_square = [&](const Vec3 &n, double below) {
    return below * below + n.x * (n.x * m[0] + 2.0 * n.y * m[5]) + n.y * (n.y * m[1] + 2.0 * n.z * m[3]) +
           n.z * (n.z * m[2] + 2.0 * n.x * m[4]);
  };
  below_.resize(faces.size());
  std::size_t nearest = 0;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    below_[f] = faces[f].offset - dot(faces[f].normal, own_middle);
    nearest = below_[f] < below_[nearest] ? f : nearest;
  }
  // Faces farther than this have weights below 1e-11.
  constexpr double farthest = 40.0;
  const Vec3 first = in_axes.rotation * faces[nearest].normal;
  const double limit = farthest * mean_square(first, below_[nearest]);
  const Vec3 to_origin = in_axes.translation - solid.origin();
  faces_.clear();
  double least = HUGE_VAL;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (below_[f] * below_[f] > limit) continue;
    const Vec3 normal = in_axes.rotation * faces[f].normal;
    const double offset = faces[f].offset + dot(normal, to_origin);
    faces_.push_back({normal, offset, mean_square(normal, offset - dot(normal, middle))});
    least = faces_.back().mean_square < least ? faces_.back().mean_square : least;
  }
  double sum = 0.0, raised = 0.0;  // of e^-8 and of e^-7, in units of the least
  for (const Face &face : faces_) {
    const double part = least / face.mean_square, weight = fourth(part * part);
    sum += weight;
    raised += weight * (face.mean_square / least);
  }
  depth.least = least * raised / sum;
  depth.squares = {};
  depth.slope = depth.moment = {};
  for (const Face &face : faces_) {
    const double part = least / face.mean_square;
    const double weight = fourth(part * part) * (8.0 * depth.least / face.mean_square - 7.0) / sum;
    const Vec3 &n = face.normal;
    depth.squares.add_square(weight, n, face.offset);
    const double below = face.offset - dot(n, middle);
    depth.slope = depth.slope - (2.0 * weight * below) * n;
    // The mean of below * place.
    const Vec3 places = below * middle - Vec3{m[0] * n.x + m[5] * n.y + m[4] * n.z, m[5] * n.x + m[1] * n.y + m[3] * n.z,
                                              m[4] * n.x + m[3] * n.y + m[2] * n.z};
    depth.moment = depth.moment - cross((2.0 * weight) * places, n);
  }
}

// The means over the overlap O of B's squares q_B have the gradient, by A's motion v, of the integral of (q_B - mean) n.v / |O| over A's
// surface in B; those of A's squares change as if B moved by -v. Both are sums over one of the two surfaces, as an integral over all of
// the overlap's surface is one over its inside.
void OverlapEnergy::find(const OverlapSolid &solid, const ContactPolytope &a, const Pose &a_in_axes, const ContactPolytope &b,
                         const Pose &b_in_axes) {
  Depth of_a, of_b;
  weigh(solid, a, a_in_axes, of_a);
  weigh(solid, b, b_in_axes, of_b);
  energy_ = 0.75 * (of_a.least + of_b.least);
  Quadric both = of_a.squares;
  const Quadric &other = of_b.squares;
  both.xx += other.xx, both.yy += other.yy, both.zz += other.zz, both.yz += other.yz, both.zx += other.zx, both.xy += other.xy;
  both.linear = both.linear + other.linear;
  both.constant += other.constant - of_a.least - of_b.least;
  const bool over_b = solid.fades() || solid.pieces_b().size() <= solid.pieces_a().size();
  SurfaceIntegral surface(both);
  for (const OverlapSolid::Piece &piece : over_b ? solid.pieces_b() : solid.pieces_a()) {
    if (piece.carries) surface.add(solid, piece);
  }
  const double sense = over_b ? 0.75 : -0.75, part = sense / solid.volume();
  const Depth &inside = over_b ? of_b : of_a;
  force_ = part * surface.force() - sense * inside.slope;
  torque_ = part * surface.torque() - sense * inside.moment;
}

}  // namespace cmb
