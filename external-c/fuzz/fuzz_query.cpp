// Fuzz target: two shapes at any poses. Whatever the geometry, a query gives finite numbers that fit together, the same
// for the reversed pair, and no back end brings the process down.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include "c_api/pose_check.hpp"
#include "contact_multibody.h"
#include "query/pair_query.hpp"
#include "scene/descriptor.hpp"
#include "scene/registry.hpp"

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
  switch (bytes.byte() % 12) {
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
    case 8: {  // a block of twelve triangles, its top moved
      const double x = bytes.length(), y = bytes.length(), z = bytes.length(), dx = bytes.coordinate();
      std::string text = "cmb/1 mesh vertices=";
      for (int k = 0; k < 8; ++k) {
        text += (k > 0 ? "," : "") + digits((k & 1 ? x : -x) + (k & 4 ? dx : 0.0)) + "," + digits(k & 2 ? y : -y) + "," +
                digits(k & 4 ? z : -z);
      }
      return text + " triangles=1,3,4,1,4,2,5,6,8,5,8,7,1,2,6,1,6,5,3,7,8,3,8,4,1,5,7,1,7,3,2,4,8,2,8,6";
    }
    case 9: {
      std::string text = "cmb/1 heightfield size=8,8 grid=3,3 heights=";
      for (int k = 0; k < 9; ++k) text += (k > 0 ? "," : "") + digits(0.25 * bytes.coordinate());
      return text;
    }
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

// Scenes of their own: interned ones are kept, and the registry of a long run would be full.
double ask(cmb::Scene &scene, cmb_backend backend, const std::string &a, const std::string &b, const double *position,
           const double *rotation) {
  cmb::attach_library(scene, backend, cmb::distance_library(backend));
  for (std::size_t body = 0; body < 2; ++body) {
    require(cmb::check_body_pose(body, position, rotation) == CMB_OK, cmb_last_error(), a, b, position, rotation);
  }
  cmb::QueryScratch &scratch = cmb::query_scratch();
  cmb::PairReport report;
  cmb::query_bodies(scene, 0, cmb::body_pose(position, rotation), 1,
                    cmb::body_pose(position + 3, rotation + 9), scratch, scratch.contact, report);
  cmb::merge_points(scratch.contact.points, capacity);
  const cmb::ContactSet &answer = scratch.contact;
  require(std::isfinite(answer.distance), "distance", a, b, position, rotation);
  require(std::fabs(norm(answer.normal) - 1.0) < 1e-9 && is_finite(answer.witness), "witness", a, b, position, rotation);
  require(answer.points.size() <= capacity, "capacity", a, b, position, rotation);
  double load = 0.0, deepest = 0.0;
  for (const cmb::ContactPoint &point : answer.points) {
    require(std::isfinite(point.depth) && point.depth >= 0.0, "depth", a, b, position, rotation);
    require(std::isfinite(point.weight) && point.weight >= 0.0, "weight", a, b, position, rotation);
    require(std::fabs(norm(point.normal) - 1.0) < 1e-9, "normal", a, b, position, rotation);
    require(is_finite(point.position), "point", a, b, position, rotation);
    load += point.weight * point.depth;
    deepest = std::fmax(deepest, point.depth);
  }
  require((answer.distance < 0.0) == (deepest > 0.0), "touch", a, b, position, rotation);
  // Merging averages depths, so the deepest point may be gone; the load never exceeds what the bodies allow.
  require(load < 40.0, "load", a, b, position, rotation);
  return answer.distance;
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
  cmb::Scene scene, reversed;
  scene.bodies = {cmb::parse_descriptor(a), cmb::parse_descriptor(b)};
  reversed.bodies = {scene.bodies[1], scene.bodies[0]};
  const double one = ask(scene, CMB_BACKEND_AUTO, a, b, position, rotation);
  const double other = ask(reversed, CMB_BACKEND_AUTO, b, a, swapped_position, swapped_rotation);
  // Of two meshes that touch either may be the one that pushes.
  const auto is_mesh = [](const std::string &text) {
    return text.find(" mesh ") != std::string::npos || text.find(" heightfield ") != std::string::npos;
  };
  const bool either = is_mesh(a) && is_mesh(b) && one <= 0.0 && other <= 0.0;
  require(either || std::fabs(one - other) < 1e-6, "reversed distance", a, b, position, rotation);
  const cmb_backend library = size % 2 == 0 ? CMB_BACKEND_LIBCCD : CMB_BACKEND_FCL;
  const double checked = ask(scene, library, a, b, position, rotation);
  // A library's overlap is one along its own normal: as deep as the least translation or deeper. Apart it is the distance.
  require(checked < one + 2e-3, "contact missed by a back end", a, b, position, rotation);
  require(one < 2e-3 || checked > one - 2e-3, "back end", a, b, position, rotation);
  return 0;
}
