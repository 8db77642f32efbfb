// Writes meshes in the formats that are read, for round trips.
#pragma once

#include <cstdio>
#include <cstring>
#include <string>

#include "mesh/core/mesh_data.hpp"

namespace mesh_writers {

using cmb::convex::Vec3;
using cmb::mesh::MeshData;
using cmb::mesh::Triangle;

template <typename Number>
void put(std::string &out, Number value, bool big_endian = false) {
  char bytes[sizeof value];
  std::memcpy(bytes, &value, sizeof value);
  const std::uint16_t probe = 1;
  char first;
  std::memcpy(&first, &probe, 1);
  const bool swap = (first == 1) == big_endian;
  for (std::size_t i = 0; i < sizeof value; ++i) out += bytes[swap ? sizeof value - 1 - i : i];
}

inline std::string text(const Vec3 &p) {
  char buffer[96];
  std::snprintf(buffer, sizeof buffer, "%.17g %.17g %.17g", p.x, p.y, p.z);
  return buffer;
}

inline std::string stl_ascii(const MeshData &data, const std::string &line_end = "\n") {
  std::string out = "solid a name of words" + line_end;
  for (const Triangle &t : data.triangles) {
    out += "facet normal 0 0 nan" + line_end + "  outer loop" + line_end;
    for (const std::uint32_t v : t) out += "    vertex " + text(data.vertices[v]) + line_end;
    out += "  endloop" + line_end + "endfacet" + line_end;
  }
  return out + "endsolid a name of words" + line_end;
}

inline std::string stl_binary(const MeshData &data, const std::string &title = "solid") {
  std::string out = title;
  out.resize(80, ' ');
  put(out, static_cast<std::uint32_t>(data.triangles.size()));
  for (const Triangle &t : data.triangles) {
    out.append(12, '\0');
    for (const std::uint32_t v : t) {
      for (int k = 0; k < 3; ++k) put(out, static_cast<float>(data.vertices[v][k]));
    }
    out.append(2, '\0');
  }
  return out;
}

inline std::string obj(const MeshData &data) {
  std::string out = "# comment\no part\n";
  for (const Vec3 &p : data.vertices) out += "v " + text(p) + "\n";
  for (const Triangle &t : data.triangles) {
    out += "f";
    for (const std::uint32_t v : t) out += " " + std::to_string(v + 1) + "/7/9";
    out += "\n";
  }
  return out;
}

// `format`: ascii, binary_little_endian or binary_big_endian.
inline std::string ply(const MeshData &data, const std::string &format) {
  std::string out = "ply\nformat " + format + " 1.0\ncomment made by hand\nelement vertex " +
                    std::to_string(data.vertices.size()) +
                    "\nproperty double x\nproperty double y\nproperty uchar red\nproperty double z\nelement face " +
                    std::to_string(data.triangles.size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
  const bool ascii = format == "ascii", big = format == "binary_big_endian";
  char buffer[128];
  for (const Vec3 &p : data.vertices) {
    if (ascii) {
      std::snprintf(buffer, sizeof buffer, "%.17g %.17g 200 %.17g\n", p.x, p.y, p.z);
      out += buffer;
    } else {
      put(out, p.x, big);
      put(out, p.y, big);
      put(out, static_cast<std::uint8_t>(200));
      put(out, p.z, big);
    }
  }
  for (const Triangle &t : data.triangles) {
    if (ascii) {
      out += "3 " + std::to_string(t[0]) + " " + std::to_string(t[1]) + " " + std::to_string(t[2]) + "\n";
    } else {
      put(out, static_cast<std::uint8_t>(3));
      for (const std::uint32_t v : t) put(out, static_cast<std::int32_t>(v), big);
    }
  }
  return out;
}

}  // namespace mesh_writers
