// What the writers write reads back, and pictures follow glTF 2.0.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "dymsum/solids.h"
#include "io/bytes.h"
#include "io/mesh_reading.h"
#include "io/reading.h"

namespace dymsum::io_test {
namespace {

using Json = nlohmann::json;

TEST(WriteMesh, EveryModelComesBackFromEveryFormat) {
  auto models = solids::thesis_models();
  models.push_back({"box", solids::box(-1, -2, -3, 1, 2, 3)});
  models.push_back({"canonical", solids::truncated_icosidodecahedron(1).canonical()});
  models.push_back({"empty", Mesh()});
  for (const solids::NamedMesh& model : models) {
    for (const MeshFormat format : {MeshFormat::off, MeshFormat::obj, MeshFormat::ply}) {
      EXPECT_EQ(read_mesh_text(format_mesh(model.mesh, format), format), model.mesh.data()) << model.name;
    }
    const MeshData stl = read_mesh_text(format_mesh(model.mesh, MeshFormat::stl), MeshFormat::stl);
    EXPECT_EQ(*Mesh::create(stl), model.mesh) << model.name;
  }
}

TEST(WriteMesh, TextKeepsEveryBitOfACoordinate) {
  MeshData data = solids::box(0, 0, 0, 1, 1, 1).data();
  for (Point3& p : data.vertices) p = {p.x / 3, p.y * 1e-310, p.z * std::numeric_limits<double>::max()};
  const Mesh mesh = *Mesh::create(data);
  for (const MeshFormat format : {MeshFormat::off, MeshFormat::obj, MeshFormat::ply}) {
    EXPECT_EQ(read_mesh_text(format_mesh(mesh, format), format), data) << extension(format);
  }
}

TEST(WriteMesh, ColoursDoNotDisturbReaders) {
  const Mesh box = solids::box(0, 0, 0, 1, 1, 1);
  const std::vector<FaceColour> colours = {{{1, 0, 0.5f}, {0, 3}}, {{-1, 7, 0}, {5, 999}}};
  const std::string off = format_mesh(box, MeshFormat::off, colours), ply = format_mesh(box, MeshFormat::ply, colours);
  EXPECT_EQ(read_mesh_text(off, MeshFormat::off), box.data());
  EXPECT_EQ(read_mesh_text(ply, MeshFormat::ply), box.data());
  EXPECT_NE(off.find(" 255 0 128\n"), std::string::npos);
  EXPECT_NE(off.find(" 0 255 0\n"), std::string::npos);
  EXPECT_NE(off.find(" 153 191 230\n"), std::string::npos);  // the colour of faces that none was given
}

/// The parts of a .glb file.
struct Glb {
  Json json;
  std::string bytes;
};

Glb opened(const std::string& file) {
  const auto word = [&](std::size_t at) { return io::from_bytes<std::uint32_t>(file, at, std::endian::little); };
  EXPECT_EQ(file.substr(0, 4), "glTF");
  EXPECT_EQ(word(4), 2u);
  EXPECT_EQ(word(8), file.size());
  const std::size_t json_size = word(12);
  EXPECT_EQ(file.substr(16, 4), "JSON");
  EXPECT_EQ(json_size % 4, 0u);
  Glb glb{Json::parse(file.substr(20, json_size)), ""};
  if (20 + json_size == file.size()) return glb;
  EXPECT_EQ(file.substr(24 + json_size, 4), std::string("BIN\0", 4));
  EXPECT_EQ(word(20 + json_size), file.size() - 28 - json_size);
  glb.bytes = file.substr(28 + json_size);
  return glb;
}

TEST(WriteMesh, GlbHoldsEveryTriangleWithItsNormal) {
  const Mesh box = solids::box(-1, -2, -3, 1, 2, 3);
  const std::vector<FaceColour> colours = {{{1, 0, 0}, {0, 1}}, {{0, 1, 0}, {2}}, {{0, 0, 1}, {}}};
  const Glb glb = opened(format_mesh(box, MeshFormat::glb, colours));
  EXPECT_EQ(glb.json["asset"]["version"], "2.0");
  EXPECT_EQ(glb.json["buffers"][0]["byteLength"], glb.bytes.size());
  EXPECT_EQ(glb.json["scenes"][glb.json["scene"].get<int>()]["nodes"], Json::array({0}));
  const Json& primitives = glb.json["meshes"][0]["primitives"];
  ASSERT_EQ(primitives.size(), 3u);  // two colours and what has none; an empty colour makes nothing
  double area = 0;
  std::size_t triangles = 0;
  for (const Json& primitive : primitives) {
    const auto values = [&](const char* what) {
      const Json& accessor = glb.json["accessors"][primitive["attributes"][what].get<std::size_t>()];
      const Json& view = glb.json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
      EXPECT_EQ(accessor["componentType"], 5126);
      EXPECT_EQ(accessor["type"], "VEC3");
      EXPECT_EQ(view["byteLength"], 12 * accessor["count"].get<std::size_t>());
      std::vector<float> floats;
      for (std::size_t i = 0; i < 3 * accessor["count"].get<std::size_t>(); ++i) {
        floats.push_back(io::from_bytes<float>(glb.bytes, view["byteOffset"].get<std::size_t>() + 4 * i, std::endian::little));
      }
      return floats;
    };
    const std::vector<float> p = values("POSITION"), n = values("NORMAL");
    ASSERT_EQ(p.size(), n.size());
    for (std::size_t t = 0; t < p.size(); t += 9, ++triangles) {
      const auto d = [&](std::size_t corner, std::size_t i) { return double(p[t + 3 * corner + i]) - p[t + i]; };
      const double normal[3] = {d(1, 1) * d(2, 2) - d(1, 2) * d(2, 1), d(1, 2) * d(2, 0) - d(1, 0) * d(2, 2),
                                d(1, 0) * d(2, 1) - d(1, 1) * d(2, 0)};
      const double length = std::hypot(normal[0], normal[1], normal[2]);
      area += length / 2;
      for (std::size_t i = 0; i < 9; ++i) EXPECT_EQ(n[t + i], normal[i % 3] / length);
    }
  }
  EXPECT_EQ(triangles, box.triangle_count());
  EXPECT_EQ(area, surface_area(box));
  EXPECT_EQ(glb.json["materials"].size(), 3u);
  EXPECT_EQ(glb.json["materials"][1]["pbrMetallicRoughness"]["baseColorFactor"], Json::array({0, 1, 0, 1}));
  const Json& all = glb.json["accessors"][primitives[2]["attributes"]["POSITION"].get<std::size_t>()];
  EXPECT_EQ(all["min"], Json::array({-1, -2, -3}));
  EXPECT_EQ(all["max"], Json::array({1, 2, 3}));
}

TEST(WriteMesh, FacesOfOneNumberLookSmoothAndNotesAreKept) {
  const MeshData cube = solids::box(-1, -1, -1, 1, 1, 1).data();
  const std::vector<std::pair<std::string, std::string>> notes = {{"z", "an angle"}, {"closed", "yes"}};
  const auto normals = [&](const std::vector<std::uint32_t>& smooth) {
    const Glb glb = opened(format_glb(cube, {{}, smooth, notes}));
    EXPECT_EQ(glb.json["asset"]["extras"]["z"], "an angle");
    EXPECT_EQ(glb.json["asset"]["extras"]["closed"], "yes");
    const Json& primitive = glb.json["meshes"][0]["primitives"][0];
    const Json& accessor = glb.json["accessors"][primitive["attributes"]["NORMAL"].get<std::size_t>()];
    const Json& view = glb.json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
    std::vector<float> floats;
    for (std::size_t i = 0; i < 3 * accessor["count"].get<std::size_t>(); ++i)
      floats.push_back(
          io::from_bytes<float>(glb.bytes, view["byteOffset"].get<std::size_t>() + 4 * i, std::endian::little));
    return floats;
  };
  // Three faces with right angles meet at every corner, however they are split.
  for (const float part : normals({0, 0, 0, 0, 0, 0})) EXPECT_NEAR(std::abs(part), std::sqrt(1.0 / 3), 1e-6);
  EXPECT_EQ(normals({0, 1, 2, 3, 4, 5}), normals({})) << "creases everywhere";
}

TEST(WriteMesh, TheEmptyMeshIsAnEmptyScene) {
  const Glb glb = opened(format_mesh(Mesh(), MeshFormat::glb));
  EXPECT_FALSE(glb.json.contains("meshes"));
  EXPECT_EQ(glb.json["scenes"].size(), 1u);
  EXPECT_TRUE(glb.json["scenes"][0].is_object());
}

TEST(WriteMesh, FilesAreReplacedAsAWhole) {
  const Folder folder("write_mesh");
  const Mesh box = solids::box(0, 0, 0, 1, 2, 3);
  for (const MeshFormat format : {MeshFormat::off, MeshFormat::obj, MeshFormat::stl, MeshFormat::ply, MeshFormat::glb}) {
    const std::string path = folder / ("box" + std::string(extension(format)));
    const Result<std::size_t> written = write_mesh(box, path);
    ASSERT_TRUE(written.ok()) << written.error().to_string();
    EXPECT_EQ(*written, std::filesystem::file_size(path));
    EXPECT_EQ(*written, format_mesh(box, format).size());
    if (format == MeshFormat::glb) continue;
    EXPECT_EQ(*Mesh::create(*read_mesh(path)), box);
  }
  EXPECT_EQ(folder.file_count(), 5u);
  EXPECT_EQ(name(write_mesh(box, folder / "box.wkt").error().code), "unsupported_format");
  EXPECT_EQ(name(write_mesh(box, folder / "no/such/box.off").error().code), "cannot_write");
  EXPECT_EQ(folder.file_count(), 5u);
}

TEST(WriteMesh, WhatSinglePrecisionCannotHoldIsRefused) {
  const Folder folder("write_mesh");
  const Mesh large = *scaled(solids::box(0, 0, 0, 1, 1, 1), 1, 1e39, 1);
  for (const char* file : {"a.stl", "a.glb"}) {
    EXPECT_EQ(name(write_mesh(large, folder / file).error().code), "cannot_write");
  }
  EXPECT_EQ(folder.file_count(), 0u);
  EXPECT_TRUE(write_mesh(large, folder / "a.off").ok());
}

}  // namespace
}  // namespace dymsum::io_test
