#include "response/effective_mass.hpp"

#include <cmath>

namespace cmb {

namespace {

// v . I^-1 v by the Cholesky factors of I.
double inverse_form(const double *tensor, const Vec3 &v) {
  const double l00 = std::sqrt(tensor[0]);
  const double l10 = tensor[3] / l00, l20 = tensor[6] / l00;
  const double l11 = std::sqrt(tensor[4] - l10 * l10);
  const double l21 = (tensor[7] - l20 * l10) / l11;
  const double l22 = std::sqrt(tensor[8] - l20 * l20 - l21 * l21);
  const double x = v.x / l00;
  const double y = (v.y - l10 * x) / l11;
  const double z = (v.z - l20 * x - l21 * y) / l22;
  return x * x + y * y + z * z;
}

double inverse_mass(const ContactCenter &contact, const Inertia &body) {
  if (body.fixed) return 0.0;
  const Vec3 turning = transposed_times(*body.to_world, cross(contact.point - body.center, contact.normal));
  return 1.0 / body.mass + inverse_form(body.tensor, turning);
}

}  // namespace

ContactCenter contact_center(const std::vector<ContactPoint> &points) {
  double deepest = 0.0;
  for (const ContactPoint &p : points) deepest = std::fmax(deepest, p.depth);
  double load = 0.0, square = 0.0;
  Vec3 point, normal;
  for (const ContactPoint &p : points) {
    const double depth = p.depth / deepest;  // squares of the smallest depths would be 0
    const double share = p.weight * depth;
    load += share;
    square += share * depth;
    point = point + share * p.position;
    normal = normal + share * p.normal;
  }
  return {(1.0 / load) * point, normalized(normal, points.front().normal), load * load / square};
}

double effective_mass(const ContactCenter &contact, const Inertia &a, const Inertia &b) {
  return 1.0 / ((inverse_mass(contact, a) + inverse_mass(contact, b)) * contact.weight);
}

}  // namespace cmb
