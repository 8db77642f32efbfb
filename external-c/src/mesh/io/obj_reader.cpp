// Wavefront OBJ: vertices and polygons.
#include "mesh/io/mesh_file.hpp"
#include "mesh/io/polygon_reader.hpp"
#include "mesh/io/text_scanner.hpp"

namespace cmb::mesh {

namespace {

void read_vertex(TextScanner &text, MeshData &data) {
  if (data.vertices.size() >= MeshLimits::vertices) {
    text.fail("more than " + std::to_string(MeshLimits::vertices) + " vertices", "export with a coarser tolerance");
  }
  Vec3 p;
  for (int axis = 0; axis < 3; ++axis) p.set(axis, text.number(text.word()));
  data.vertices.push_back(p);  // a weight or colours may follow
}

void read_face(TextScanner &text, MeshData &data, PolygonReader &polygon) {
  const auto count = static_cast<std::int64_t>(data.vertices.size());
  polygon.begin(text.line());
  for (std::string_view word = text.word(); !word.empty(); word = text.word()) {
    // vertex/texture/normal: the first counts; negative numbers count back from the last vertex so far.
    const std::int64_t given = text.whole_number(word.substr(0, word.find('/')));
    const std::int64_t number = given < 0 ? count + given : given - 1;
    if (given == 0 || number < 0 || number >= count) {
      text.fail("there is no vertex " + std::to_string(given), "the file is damaged: export it again");
    }
    if (!polygon.add(static_cast<std::uint32_t>(number))) {
      const auto [problem, remedy] = PolygonReader::limit_reached();
      text.fail(problem, remedy);
    }
  }
  if (polygon.count() < 3) text.fail("a face of fewer than three corners", "the file is damaged: export it again");
}

}  // namespace

MeshData read_obj(std::string_view contents, const std::string &source) {
  TextScanner text(contents, source);
  MeshData data;
  PolygonReader polygon(data.triangles);
  do {
    const std::string_view word = text.word();
    if (word == "v") read_vertex(text, data);
    if (word == "f") read_face(text, data, polygon);
  } while (text.next_line());
  if (data.triangles.empty()) text.fail("no faces", "export the body's surface as triangles");
  polygon.unfold_all(data, [&](std::size_t line) {
    const auto [problem, remedy] = PolygonReader::not_a_polygon();
    throw MeshError(source, "line " + std::to_string(line) + ": " + problem, remedy);
  });
  return data;
}

}  // namespace cmb::mesh
