// Fuzz target: two shapes at any poses. Whatever the geometry, a query gives finite numbers that fit together, the same
// for the reversed pair, and no back end brings the process down.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include "contact_multibody.h"

namespace {

// Reads numbers off the fuzzer's bytes; zeros where they end.
class Bytes {
 public:
  Bytes(const std::uint8_t *data, std::size_t size) : data_(data), size_(size) {}
  unsigned byte() { return next_ < size_ ? data_[next_++] : 0u; }
  // Multiples of 1/4 or finer: coincidences are what breaks geometry.
  double coordinate() {
    const unsigned kind = byte(), value = byte();
    const double coarse = (static_cast<double>(value) - 128.0) / 64.0;
    return kind < 128 ? coarse : coarse + (static_cast<double>(byte()) - 128.0) * std::pow(10.0, -1.0 - (kind % 12));
  }
  double length() { return 0.25 * (1 + byte() % 8); }

 private:
  const std::uint8_t *data_;
  std::size_t size_, next_ = 0;
};

std::string digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

std::string shape(Bytes &bytes) {
  switch (bytes.byte() % 9) {
    case 0: return "cmb/1 halfspace";
    case 1: return "cmb/1 sphere radius=" + digits(bytes.length());
    case 2:
    case 3:
      return "cmb/1 box size=" + digits(bytes.length()) + "," + digits(bytes.length()) + "," + digits(bytes.length());
    case 4: return "cmb/1 capsule radius=" + digits(bytes.length()) + " length=" + digits(bytes.length());
    case 5: return "cmb/1 cylinder radius=" + digits(bytes.length()) + " length=" + digits(bytes.length());
    case 6: return "cmb/1 cone radius=" + digits(bytes.length()) + " length=" + digits(bytes.length());
    case 7:
      return "cmb/1 ellipsoid size=" + digits(bytes.length()) + "," + digits(bytes.length()) + "," +
             digits(bytes.length());
    default: {
      std::string text = "cmb/1 hull vertices=0,0,0,1,0,0,0,1,0,0,0,1";
      for (unsigned count = bytes.byte() % 12; count > 0; --count) {
        for (int i = 0; i < 3; ++i) text += "," + digits(bytes.coordinate());
      }
      return text;
    }
  }
}

void pose(Bytes &bytes, double *position, double *rotation) {
  for (int i = 0; i < 3; ++i) position[i] = bytes.coordinate();
  double q[4];
  double sum = 0.0;
  for (double &x : q) {
    x = bytes.byte() < 100 ? 0.0 : bytes.coordinate();
    sum += x * x;
  }
  if (!(sum > 1e-6)) q[0] = sum = 1.0, q[1] = q[2] = q[3] = 0.0;
  for (double &x : q) x /= std::sqrt(sum);
  const double w = q[0], x = q[1], y = q[2], z = q[3];
  const double r[9] = {1 - 2 * (y * y + z * z), 2 * (x * y + w * z),     2 * (x * z - w * y),
                       2 * (x * y - w * z),     1 - 2 * (x * x + z * z), 2 * (y * z + w * x),
                       2 * (x * z + w * y),     2 * (y * z - w * x),     1 - 2 * (x * x + y * y)};
  std::memcpy(rotation, r, sizeof r);
}

void require(bool holds, const char *what, const std::string &a, const std::string &b, const double *position,
             const double *rotation) {
  if (holds) return;
  std::fprintf(stderr, "%s\n%s\n%s\n", what, a.c_str(), b.c_str());
  for (int i = 0; i < 6; ++i) std::fprintf(stderr, "%.17g ", position[i]);
  for (int i = 0; i < 18; ++i) std::fprintf(stderr, "%.17g ", rotation[i]);
  std::fprintf(stderr, "\n");
  std::abort();
}

constexpr std::size_t capacity = 6;

struct Answer {
  double distance, depth[capacity], weight[capacity], normal[3 * capacity], point[3 * capacity];
};

Answer ask(const std::string &a, const std::string &b, cmb_backend backend, const double *position,
           const double *rotation) {
  const char *geometry[] = {a.c_str(), b.c_str()};
  const int pairs[] = {1, 2};
  cmb_scene scene = 0;
  const cmb_status interned = cmb_intern(geometry, 2, pairs, 1, backend, &scene);
  // The registry of a long run fills up.
  if (interned == CMB_ERROR_MEMORY) std::exit(0);
  require(interned == CMB_OK, cmb_last_error(), a, b, position, rotation);
  Answer answer;
  const cmb_status asked = cmb_query_scene(scene, position, rotation, 2, 1, capacity, &answer.distance, answer.depth,
                                           answer.weight, answer.normal, answer.point);
  require(asked == CMB_OK, cmb_last_error(), a, b, position, rotation);
  require(std::isfinite(answer.distance), "distance", a, b, position, rotation);
  double load = 0.0, deepest = 0.0;
  for (std::size_t k = 0; k < capacity; ++k) {
    const double *n = answer.normal + 3 * k, *p = answer.point + 3 * k;
    require(std::isfinite(answer.depth[k]) && answer.depth[k] >= 0.0, "depth", a, b, position, rotation);
    require(std::isfinite(answer.weight[k]) && answer.weight[k] >= 0.0, "weight", a, b, position, rotation);
    require(std::fabs(n[0] * n[0] + n[1] * n[1] + n[2] * n[2] - 1.0) < 1e-9, "normal", a, b, position, rotation);
    require(std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]), "point", a, b, position, rotation);
    load += answer.weight[k] * answer.depth[k];
    deepest = std::fmax(deepest, answer.depth[k]);
  }
  require((answer.distance < 0.0) == (deepest > 0.0), "touch", a, b, position, rotation);
  // Merging averages depths, so the deepest point may be gone; the load never exceeds what the bodies allow.
  require(load < 40.0, "load", a, b, position, rotation);
  return answer;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
  Bytes bytes(data, size);
  const std::string a = shape(bytes), b = shape(bytes);
  double position[6], rotation[18], swapped_position[6], swapped_rotation[18];
  for (int body = 0; body < 2; ++body) {
    pose(bytes, position + 3 * body, rotation + 9 * body);
    std::memcpy(swapped_position + 3 * (1 - body), position + 3 * body, 3 * sizeof(double));
    std::memcpy(swapped_rotation + 9 * (1 - body), rotation + 9 * body, 9 * sizeof(double));
  }
  const Answer one = ask(a, b, CMB_BACKEND_AUTO, position, rotation);
  const Answer other = ask(b, a, CMB_BACKEND_AUTO, swapped_position, swapped_rotation);
  require(std::fabs(one.distance - other.distance) < 1e-6, "reversed distance", a, b, position, rotation);
  const Answer checked = ask(a, b, size % 2 == 0 ? CMB_BACKEND_LIBCCD : CMB_BACKEND_FCL, position, rotation);
  require(std::fabs(one.distance - checked.distance) < 2e-3, "back end", a, b, position, rotation);
  return 0;
}
