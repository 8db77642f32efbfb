// What readers of mesh files refuse, and how they say so.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "mesh/io/mesh_file.hpp"

namespace mesh_refusals {

using cmb::mesh::MeshData;
using cmb::mesh::MeshError;
using cmb::mesh::read_obj;
using cmb::mesh::read_ply;
using cmb::mesh::read_stl;

using Reader = MeshData (*)(std::string_view, const std::string &);

// The message of the refusal, which has to name the file.
inline std::string refusal(Reader read, const std::string &contents) {
  try {
    read(contents, "part.mesh");
  } catch (const MeshError &error) {
    EXPECT_EQ(std::string(error.what()).find("part.mesh: "), 0u) << error.what();
    return error.what();
  }
  ADD_FAILURE() << "accepted: " << contents.substr(0, 200);
  return "";
}

inline void expect_refusal(Reader read, const std::string &contents, const std::string &part) {
  const std::string message = refusal(read, contents);
  EXPECT_NE(message.find(part), std::string::npos) << message << "\nshould say: " << part;
}

}  // namespace mesh_refusals
