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
  models.push_back({"canonical", solids::truncated_icosidodecahedron(1, solids::kDemoSnap).canonical()});
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
  const std::vector<FaceColour> colours = {{{1, 0, 0.5}, {0, 3}}, {{-1, 7, 0}, {5, 999}}};
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

/// The numbers of an accessor.
template <class Number>
std::vector<Number> numbers(const Glb& glb, std::size_t which, std::size_t each) {
  const Json& accessor = glb.json["accessors"][which];
  const Json& view = glb.json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
  EXPECT_EQ(view["byteLength"], 4 * each * accessor["count"].get<std::size_t>());
  std::vector<Number> list;
  for (std::size_t i = 0; i < each * accessor["count"].get<std::size_t>(); ++i)
    list.push_back(
        io::from_bytes<Number>(glb.bytes, view["byteOffset"].get<std::size_t>() + 4 * i, std::endian::little));
  return list;
}

TEST(WriteMesh, GlbHoldsEveryTriangleInItsColourOnSharedVertices) {
  const Mesh box = solids::box(-1, -2, -3, 1, 2, 3);
  const std::vector<FaceColour> colours = {{{1, 0, 0}, {0, 1}}, {{0, 1, 0}, {2}}, {{0, 0, 1}, {}}};
  const std::vector<std::pair<std::string, std::string>> notes = {{"z", "an angle"}, {"closed", "yes"}};
  const Glb glb = opened(format_glb(box.data(), {colours, notes}));
  EXPECT_EQ(glb.json["asset"]["version"], "2.0");
  EXPECT_EQ(glb.json["asset"]["extras"]["z"], "an angle");
  EXPECT_EQ(glb.json["buffers"][0]["byteLength"], glb.bytes.size());
  EXPECT_EQ(glb.json["scenes"][glb.json["scene"].get<int>()]["nodes"], Json::array({0}));
  EXPECT_EQ(glb.json["materials"].size(), 1u);
  EXPECT_EQ(glb.json["materials"][0]["doubleSided"], true);
  ASSERT_EQ(glb.json["meshes"][0]["primitives"].size(), 1u);
  const Json& primitive = glb.json["meshes"][0]["primitives"][0];
  EXPECT_FALSE(primitive["attributes"].contains("NORMAL")) << "vertices of one place would not be merged";
  const auto positions = numbers<float>(glb, primitive["attributes"]["POSITION"], 3),
             lights = numbers<float>(glb, primitive["attributes"]["COLOR_0"], 3);
  const auto corners = numbers<std::uint32_t>(glb, primitive["indices"], 1);
  ASSERT_EQ(positions.size(), lights.size());
  EXPECT_EQ(corners.size(), 3 * box.triangle_count());
  EXPECT_LT(positions.size(), 9 * box.triangle_count());
  double area = 0, red = 0, green = 0;
  for (std::size_t t = 0; t < corners.size(); t += 3) {
    const auto d = [&](std::size_t corner, std::size_t i) {
      return double(positions[3 * corners[t + corner] + i]) - positions[3 * corners[t] + i];
    };
    const double part = std::hypot(d(1, 1) * d(2, 2) - d(1, 2) * d(2, 1), d(1, 2) * d(2, 0) - d(1, 0) * d(2, 2),
                                   d(1, 0) * d(2, 1) - d(1, 1) * d(2, 0)) /
                        2;
    area += part;
    for (std::size_t k = 1; k < 3; ++k)
      for (std::size_t i = 0; i < 3; ++i)
        EXPECT_EQ(lights[3 * corners[t + k] + i], lights[3 * corners[t] + i]) << "a triangle has one colour";
    red += lights[3 * corners[t]] == 1 ? part : 0;
    green += lights[3 * corners[t]] == 0 && lights[3 * corners[t] + 1] == 1 ? part : 0;
  }
  EXPECT_EQ(area, surface_area(box));
  EXPECT_GT(red, green);
  EXPECT_GT(green, 0);
  const Json& all = glb.json["accessors"][primitive["attributes"]["POSITION"].get<std::size_t>()];
  EXPECT_EQ(all["min"], Json::array({-1, -2, -3}));
  EXPECT_EQ(all["max"], Json::array({1, 2, 3}));
  const Glb half = opened(format_glb(box.data(), {std::vector<FaceColour>{{{0.5, 0.5, 0.5}, {0, 1, 2, 3, 4, 5}}}, {}}));
  EXPECT_NEAR(numbers<float>(half, half.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"], 3)[0], 0.214, 1e-3)
      << "half of what a screen is told is a fifth of the light";
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
  for (const MeshFormat format :
       {MeshFormat::off, MeshFormat::obj, MeshFormat::stl, MeshFormat::ply, MeshFormat::glb}) {
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

TEST(WriteMesh, APictureIsDrawnWhateverRoundingDoesToPartsOfIt) {
  const auto with_pit = [](double size) {  // a box, and a cavity of this size in it
    MeshData data = solids::box(0, 0, 0, 128, 128, 128).data();
    const MeshData pit = solids::box(64, 64, 64, 64 + size, 64 + size, 64 + size).data();
    data.vertices.insert(data.vertices.end(), pit.vertices.begin(), pit.vertices.end());
    for (const Face& face : pit.faces) {
      Face& turned = data.faces.emplace_back(face.rbegin(), face.rend());
      for (std::uint32_t& v : turned) v += 8;
    }
    return Mesh::create(data).value();
  };
  EXPECT_FALSE(rounding_error(with_pit(1), MeshFormat::stl));
  EXPECT_FALSE(rounding_error(with_pit(1), MeshFormat::glb));
  EXPECT_EQ(rounding_error(with_pit(0x1p-20), MeshFormat::stl)->code, ErrorCode::rounding_changed_topology);
  EXPECT_FALSE(rounding_error(with_pit(0x1p-20), MeshFormat::glb)) << "the box shows";
  EXPECT_EQ(numbers<std::uint32_t>(opened(format_mesh(with_pit(0x1p-20), MeshFormat::glb)), 2, 1).size(), 36u);
  const Mesh needle = solids::box(0, 64, 64, 4, 64 + 0x1p-20, 64 + 0x1p-20);
  const std::optional<Error> error = rounding_error(needle, MeshFormat::glb);
  ASSERT_TRUE(error) << "nothing would show";
  EXPECT_EQ(error->code, ErrorCode::rounding_changed_topology);
  EXPECT_FALSE(picture_error(MeshData{}));
  EXPECT_EQ(picture_error({{{0, 0, 0}, {1, 0, 0}, {0, 1e39, 0}}, {{0, 1, 2}}})->code, ErrorCode::cannot_write);
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
