// .3mf, .glb and compressed files: what is written reads back, what others write reads as they mean it, and what is
// broken or made to fill memory is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "dymsum/region_io.h"
#include "dymsum/solids.h"
#include "io/archive.h"
#include "io/bytes.h"
#include "io/mesh_reading.h"
#include "io/read_file.h"
#include "io/reading.h"

namespace dymsum::io_test {
namespace {

constexpr const char* kRelationships =
    R"(<Relationships><Relationship Target="/3D/a.model" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>)";

/// A .3mf file with this model, and perhaps another part.
std::string package(const std::string& model, const std::string& other = "") {
  std::vector<io::ZipEntry> entries = {{"_rels/.rels", kRelationships}, {"3D/a.model", model}};
  if (!other.empty()) entries.push_back({"3D/other.model", other});
  return io::zip_of(entries).value();
}

/// A tetrahedron as the object of this id, with what its element says besides.
std::string object(int id, const std::string& more = "") {
  return "<object id=\"" + std::to_string(id) + "\" " + more +
         "><mesh><vertices><vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\"0.1\" y=\"0\" z=\"0\"/>"
         "<vertex x=\"0\" y=\"1e0\" z=\"0\"/><vertex x=\"0\" y=\"0\" z=\"1\"/></vertices><triangles>"
         "<triangle v1=\"0\" v2=\"2\" v3=\"1\"/><triangle v1=\"0\" v2=\"1\" v3=\"3\"/>"
         "<triangle v1=\"1\" v2=\"2\" v3=\"3\"/><triangle v1=\"2\" v2=\"0\" v3=\"3\"/></triangles></mesh></object>";
}

std::string model(const std::string& resources, const std::string& build) {
  return "<model unit=\"inch\"><resources>" + resources + "</resources><build>" + build + "</build></model>";
}

TEST(ArchivedMesh, SolidsComeBackFrom3mf) {
  auto models = solids::thesis_models();
  models.push_back({"box of decimals", solids::box(0, 0, 0, 0.1, 1.0 / 3, 2)});
  models.push_back({"empty", Mesh()});
  for (const solids::NamedMesh& named : models) {
    const Mesh triangles = triangulated(named.mesh).mesh;
    const std::string bytes = format_mesh(triangles, MeshFormat::three_mf);
    EXPECT_EQ(read_mesh_text(bytes, MeshFormat::three_mf), triangles.data()) << named.name;
    EXPECT_EQ(format_mesh(triangles, MeshFormat::three_mf), bytes) << "the same solid, other bytes";
    EXPECT_FALSE(rounding_error(named.mesh, MeshFormat::three_mf)) << named.name;
  }
}

TEST(ArchivedMesh, PlacedPartsOf3mfStandWhereTheyArePlaced) {
  const std::string components =
      "<object id=\"2\"><components><component objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 0 0 5\"/>"
      "<component objectid=\"1\" transform=\"-1 0 0 0 1 0 0 0 1 -7 0 0\"/></components></object>";
  const MeshData data = read_mesh_text(
      package(model(object(1) + components + object(3, "type=\"support\""),
                    "<item objectid=\"2\" transform=\"0 1 0 -1 0 0 0 0 1 0 0 0\"/><item objectid=\"3\"/>")),
      MeshFormat::three_mf);
  ASSERT_EQ(data.vertices.size(), 8U);
  EXPECT_EQ(data.vertices[1], (Point3{0, 0.1, 5}));         // (0.1, 0, 5) turned about z
  EXPECT_EQ(data.vertices[5], (Point3{0, -7.1, 0}));        // mirrored to (-7.1, 0, 0)
  EXPECT_EQ(Mesh::create(data).value().shell_count(), 2U);  // both outward
}

TEST(ArchivedMesh, PartsOf3mfMayStandInFilesOfTheirOwn) {
  const std::string other = model(object(7), "");
  const MeshData data = read_mesh_text(
      package(
          "<model xmlns:p=\"x\"><resources/><build><item objectid=\"7\" p:path=\"/3D/other.model\"/></build></model>",
          other),
      MeshFormat::three_mf);
  EXPECT_EQ(data.faces.size(), 4U);
}

TEST(ArchivedMesh, Broken3mfIsRefusedWithItsPlace) {
  const auto refused = [](const std::string& bytes, ErrorCode code, const char* words) {
    expect_mesh_refused(bytes, MeshFormat::three_mf, code, 0, words);
  };
  refused("solid", ErrorCode::malformed, "this is none");
  refused("PK\x03\x04 and nothing", ErrorCode::malformed, "no sound .zip file");
  const std::vector<io::ZipEntry> none = {{"a.txt", "a"}};
  refused(io::zip_of(none).value(), ErrorCode::malformed, "'_rels/.rels'");
  refused(package("<model>"), ErrorCode::malformed, "XML");
  refused(package(model(object(1), "<item objectid=\"2\"/>")), ErrorCode::malformed, "no object '2'");
  std::string bad = object(1);
  refused(package(model(bad.replace(bad.find("0.1"), 3, "0,1"), "\n<item objectid=\"1\"/>")), ErrorCode::malformed,
          "(line 1 of its 3D/a.model)");
  bad = object(1);
  refused(package(model(bad.replace(bad.find("v2=\"2\""), 6, "v2=\"4\""), "<item objectid=\"1\"/>")),
          ErrorCode::bad_index, "vertex 4 of 4");
  bad = object(1);
  refused(package(model(bad.replace(bad.find("0.1"), 3, "NaN"), "<item objectid=\"1\"/>")), ErrorCode::not_finite,
          "finite");
  refused(package(model("<object id=\"1\"><components><component objectid=\"1\"/></components></object>",
                        "<item objectid=\"1\"/>")),
          ErrorCode::malformed, "circle");
  refused(package(model(object(1), "<item objectid=\"1\" transform=\"1 0 0\"/>")), ErrorCode::malformed, "twelve");
}

TEST(ArchivedMesh, CopiesOfCopiesDoNotFillMemory) {
  std::string resources = object(1);
  for (int id = 2; id <= 40; ++id) {
    const std::string below = "<component objectid=\"" + std::to_string(id - 1) + "\"/>";
    resources += "<object id=\"" + std::to_string(id) + "\"><components>" + below + below + "</components></object>";
  }
  expect_mesh_refused(package(model(resources, "<item objectid=\"40\"/>")), MeshFormat::three_mf,
                      ErrorCode::out_of_memory, 0, "copies");
}

TEST(ArchivedMesh, EmptyCopiesOfCopiesEnd) {
  std::string resources = "<object id=\"1\"><mesh/></object>";
  for (int id = 2; id <= 60; ++id) {
    const std::string below = "<component objectid=\"" + std::to_string(id - 1) + "\"/>";
    resources += "<object id=\"" + std::to_string(id) + "\"><components>" + below + below + "</components></object>";
  }
  expect_mesh_refused(package(model(resources, "<item objectid=\"60\"/>")), MeshFormat::three_mf,
                      ErrorCode::out_of_memory, 0, "placed");
}

TEST(ArchivedMesh, OwnPicturesReadAsTheSolid) {
  for (const solids::NamedMesh& named : solids::thesis_models()) {
    const std::vector<FaceColour> colours = {{{1, 0, 0}, {0}}};
    const MeshData data = read_mesh_text(format_mesh(named.mesh, MeshFormat::glb, colours), MeshFormat::glb);
    const std::string stl = format_mesh(named.mesh, MeshFormat::stl);  // the same triangles in single precision
    EXPECT_EQ(Mesh::create(data).value().canonical(),
              Mesh::create(read_mesh_text(stl, MeshFormat::stl)).value().canonical())
        << named.name;
  }
}

/// A .glb file of these positions and 16-bit indices, with what its primitive and its node say besides.
std::string glb(const std::vector<float>& positions, const std::vector<std::uint16_t>& indices,
                const std::string& primitive = "", const std::string& node = "", const std::string& top = "") {
  std::string binary;
  for (const float value : positions) io::append_bytes(binary, value);
  const std::size_t split = binary.size();
  for (const std::uint16_t index : indices) io::append_bytes(binary, index);
  const auto text = [](std::size_t n) { return std::to_string(n); };
  std::string json = R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0)" + node +
                     R"(}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1)" + primitive +
                     R"(}]}],"accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":)" +
                     text(positions.size() / 3) + R"(},{"bufferView":1,"componentType":5123,"type":"SCALAR","count":)" +
                     text(indices.size()) + R"(}],"bufferViews":[{"buffer":0,"byteLength":)" + text(split) +
                     R"(},{"buffer":0,"byteOffset":)" + text(split) + R"(,"byteLength":)" +
                     text(binary.size() - split) + R"(}],"buffers":[{"byteLength":)" + text(binary.size()) + "}]" +
                     top + "}";
  json.append((4 - json.size() % 4) % 4, ' ');
  binary.append((4 - binary.size() % 4) % 4, '\0');
  std::string out;
  for (const std::uint32_t word : {0x46546C67U, 2U, static_cast<std::uint32_t>(28 + json.size() + binary.size()),
                                   static_cast<std::uint32_t>(json.size()), 0x4E4F534AU})
    io::append_bytes(out, word);
  out += json;
  io::append_bytes(out, static_cast<std::uint32_t>(binary.size()));
  io::append_bytes(out, std::uint32_t{0x004E4942});
  return out + binary;
}

const std::vector<float> kCornerPositions = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
const std::vector<std::uint16_t> kCornerIndices = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};

TEST(ArchivedMesh, NodesOfGlbPlaceTheirMeshes) {
  const MeshData plain = read_mesh_text(glb(kCornerPositions, kCornerIndices), MeshFormat::glb);
  EXPECT_EQ(plain.vertices[2], (Point3{0, 0, 1}));  // y is up in the file
  EXPECT_EQ(Mesh::create(plain).value().shell_count(), 1U);
  const MeshData moved = read_mesh_text(
      glb(kCornerPositions, kCornerIndices, "", R"(,"translation":[5,0,0],"scale":[-2,1,1])"), MeshFormat::glb);
  EXPECT_EQ(moved.vertices[1], (Point3{3, 0, 0}));
  EXPECT_EQ(Mesh::create(moved).value().shell_count(), 1U);  // mirrored, and still outward
  const MeshData matrix = read_mesh_text(
      glb(kCornerPositions, kCornerIndices, "", R"(,"matrix":[0,1,0,0,-1,0,0,0,0,0,1,0,0,0,7,1])"), MeshFormat::glb);
  EXPECT_EQ(matrix.vertices[1], (Point3{0, -7, 1}));
  EXPECT_EQ(read_mesh_text(glb(kCornerPositions, {1, 0, 2, 3, 1, 0}, R"(,"mode":5)"), MeshFormat::glb).faces.size(),
            4U);
  EXPECT_EQ(read_mesh_text(glb(kCornerPositions, {3, 0, 1, 2}, R"(,"mode":6)"), MeshFormat::glb).faces.size(), 2U);
}

TEST(ArchivedMesh, BrokenGlbIsRefused) {
  const auto refused = [](const std::string& bytes, ErrorCode code, const char* words) {
    expect_mesh_refused(bytes, MeshFormat::glb, code, 0, words);
  };
  refused("", ErrorCode::truncated, "early");
  refused("solid of no kind", ErrorCode::malformed, "'glTF'");
  refused(glb(kCornerPositions, kCornerIndices).substr(0, 300), ErrorCode::truncated, "announces");
  refused(glb(kCornerPositions, {0, 1, 4}), ErrorCode::bad_index, "vertex 4 of 4");
  refused(glb(kCornerPositions, {0, 1}), ErrorCode::malformed, "multiple of three");
  refused(glb(kCornerPositions, kCornerIndices, R"(,"mode":1)"), ErrorCode::malformed, "lines");
  refused(glb(kCornerPositions, kCornerIndices, R"(,"mode":"x")"), ErrorCode::malformed, "JSON");
  refused(glb(kCornerPositions, kCornerIndices, R"(,"targets":[])"), ErrorCode::malformed, "morph");
  refused(glb(kCornerPositions, kCornerIndices, "", R"(,"children":[0])"), ErrorCode::malformed, "below itself");
  refused(glb(kCornerPositions, kCornerIndices, "", "", R"(,"scenes":[{"nodes":[0,0]}])"), ErrorCode::malformed,
          "two places");
  refused(glb(kCornerPositions, kCornerIndices, "", "", R"(,"scenes":[{"nodes":[9]}])"), ErrorCode::malformed, "JSON");
  refused(glb(kCornerPositions, kCornerIndices, "", "", R"(,"extensionsRequired":["KHR_draco_mesh_compression"])"),
          ErrorCode::unsupported_format, "draco");
  refused(glb({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, INFINITY}, kCornerIndices), ErrorCode::not_finite, "finite");
}

/// Files that are damaged anywhere are read or refused.
TEST(ArchivedMesh, DamagedFilesAreReadOrRefused) {
  std::mt19937 random(20261129);
  const Mesh box = solids::box(0, 0, 0, 1, 2, 3);
  std::size_t refused = 0;
  for (const MeshFormat format : {MeshFormat::glb, MeshFormat::three_mf}) {
    const std::string sound = format_mesh(box, format);
    for (int round = 0; round < 2000; ++round) {
      std::string bytes = sound;
      const std::size_t changes = 1 + random() % 4;
      for (std::size_t k = 0; k < changes; ++k) bytes[random() % bytes.size()] = static_cast<char>(random());
      if (random() % 4 == 0) bytes.resize(random() % bytes.size());
      refused += !parse_mesh(bytes, format).ok();
    }
  }
  EXPECT_GT(refused, 1000U);
}

TEST(ArchivedMesh, CompressedFilesReadAsWhatTheyHold) {
  const Folder folder("gz");
  const Mesh box = solids::box(0, 0, 0, 0.1, 1, 1);
  ASSERT_TRUE(write_mesh(box, folder / "box.off.gz"));
  EXPECT_TRUE(io::is_gzip(io::read_file(folder / "box.off.gz").value()) == false);
  EXPECT_EQ(read_mesh(folder / "box.off.gz").value(), box.data());
  ASSERT_TRUE(write_file(folder / "square.wkt.gz", "POLYGON((0 0,1 0,1 1,0 1,0 0))"));
  EXPECT_EQ(read_shapes(folder / "square.wkt.gz").value().size(), 1U);
  EXPECT_EQ(io::gz_of("abc").value(), io::gz_of("abc").value());
  const std::string two = io::gz_of("abc").value() + io::gz_of("def").value();
  EXPECT_EQ(io::unzipped_gz(two, "f").value(), "abcdef");
  std::string text;
  for (const int k : {0, 1, 1000, 3'000'000}) {
    text.resize(static_cast<std::size_t>(k), 'x');
    EXPECT_EQ(io::unzipped_gz(io::gz_of(text).value(), "f").value(), text);
  }
}

TEST(ArchivedMesh, BrokenCompressedFilesAreRefused) {
  const std::string packed = io::gz_of(std::string(1000, 'x') + "yz").value();
  EXPECT_EQ(name(io::unzipped_gz(packed.substr(0, packed.size() - 9), "f").error().code), "truncated");
  EXPECT_EQ(name(io::unzipped_gz("\x1f\x8bxxxxxxxxxxx", "f").error().code), "malformed");
  EXPECT_EQ(name(io::unzipped_gz("\x1f\x8b", "f").error().code), "truncated");
  std::string bad = packed;
  bad[bad.size() - 6] = static_cast<char>(bad[bad.size() - 6] + 1);  // the sum of its bytes
  EXPECT_EQ(name(io::unzipped_gz(bad, "f").error().code), "malformed");
  const std::string bomb = io::gz_of(std::string(std::size_t{1} << 28, '\0')).value();
  ASSERT_LT(bomb.size(), std::size_t{1} << 21);
  EXPECT_EQ(name(io::unzipped_gz(bomb, "f").error().code), "out_of_memory");
}

/// What is written of solids with any coordinates reads back as the same triangles.
TEST(ArchivedMesh, AnyCoordinatesComeBackFrom3mf) {
  std::mt19937_64 random(7);
  std::size_t checked = 0;
  for (int round = 0; round < 60; ++round) {
    MeshData data = solids::geodesic_sphere(2, 1).data();
    for (Point3& p : data.vertices) {
      const auto off = [&](double c) {
        return std::ldexp(c * (1 + 1e-3 * double(random() % 1000) / 1000), int(round % 40) - 20);
      };
      p = {off(p.x), off(p.y), off(p.z)};
    }
    const auto mesh = Mesh::create(data);
    if (!mesh) continue;
    ++checked;
    EXPECT_EQ(read_mesh_text(format_mesh(*mesh, MeshFormat::three_mf), MeshFormat::three_mf), data);
  }
  EXPECT_GT(checked, 50U);
}

}  // namespace
}  // namespace dymsum::io_test
