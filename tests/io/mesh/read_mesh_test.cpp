// The readers of meshes, text by text.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>

#include "io/mesh_reading.h"
#include "io/reading.h"

namespace dymsum::io_test {
namespace {

const MeshData kTetrahedron = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                               {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};

std::string corpus(const std::string& file) {
  std::ifstream stream(std::filesystem::path(DYMSUM_CORPUS_DIR) / file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

TEST(ReadMesh, TheCorpusHoldsOneCubeInEveryFormat) {
  const MeshData cube = read_mesh_text(corpus("read_off/cube.off"), MeshFormat::off);
  EXPECT_EQ(cube.vertices.size(), 8u);
  EXPECT_EQ(cube.faces.size(), 6u);
  const Mesh mesh = *Mesh::create(cube);
  EXPECT_EQ(read_mesh_text(corpus("read_obj/cube.obj"), MeshFormat::obj), cube);
  for (const char* file : {"cube_text.ply", "cube_little.ply", "cube_big.ply"}) {
    EXPECT_EQ(read_mesh_text(corpus(std::string("read_ply/") + file), MeshFormat::ply), cube) << file;
  }
  for (const char* file : {"cube_text.stl", "cube_binary.stl", "binary_that_says_solid.stl"}) {
    const MeshData data = read_mesh_text(corpus(std::string("read_stl/") + file), MeshFormat::stl);
    EXPECT_EQ(data.vertices.size(), 8u) << file;
    EXPECT_EQ(*Mesh::create(data), mesh) << file;
  }
}

TEST(ReadMesh, TheCorpusHoldsOneTetrahedronInEveryVariant) {
  EXPECT_EQ(read_mesh_text(corpus("read_off/coloured.off"), MeshFormat::off), kTetrahedron);
  EXPECT_EQ(read_mesh_text(corpus("read_off/no_keyword_on_one_line.off"), MeshFormat::off), kTetrahedron);
  EXPECT_EQ(read_mesh_text(corpus("read_obj/backwards.obj"), MeshFormat::obj), kTetrahedron);
  EXPECT_EQ(read_mesh_text(corpus("read_obj/faces_first.obj"), MeshFormat::obj), kTetrahedron);
  EXPECT_EQ(read_mesh_text(corpus("read_obj/continued_lines.obj"), MeshFormat::obj), kTetrahedron);
  EXPECT_EQ(read_mesh_text(corpus("read_ply/faces_first.ply"), MeshFormat::ply), kTetrahedron);
}

TEST(ReadMesh, PointsAndSegmentsAreFacesWithOneVertexAndWithTwo) {
  const MeshData obj = read_mesh_text(corpus("read_obj/lines_and_points.obj"), MeshFormat::obj);
  EXPECT_EQ(obj.faces, (std::vector<Face>{{0, 1, 2}, {1, 3}, {3, 4}, {5}, {6}}));
  const MeshData ply = read_mesh_text(corpus("read_ply/loose_edge.ply"), MeshFormat::ply);
  EXPECT_EQ(ply.faces, (std::vector<Face>{{0, 1, 2}, {3, 4}})) << "an edge of the face says nothing new";
  const MeshData off = read_mesh_text(corpus("read_off/point_and_segment.off"), MeshFormat::off);
  EXPECT_EQ(off.faces, (std::vector<Face>{{0, 1, 2}, {3, 4}, {5}}));
  for (const MeshData& data : {obj, ply, off}) {
    const Mesh mesh = Mesh::with_thin_parts(data).value();
    for (const MeshFormat format : {MeshFormat::off, MeshFormat::obj, MeshFormat::ply})
      EXPECT_EQ(read_mesh_text(format_mesh(mesh, format), format), data);
    for (const MeshFormat format : {MeshFormat::stl, MeshFormat::glb, MeshFormat::three_mf}) {
      const std::optional<Error> error = rounding_error(mesh, format);
      ASSERT_TRUE(error);
      EXPECT_EQ(error->code, ErrorCode::cannot_write);
      EXPECT_EQ(error->evidence.face, 1);
    }
  }
  const MeshData sheet{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  EXPECT_FALSE(rounding_error(Mesh::with_thin_parts(sheet).value(), MeshFormat::stl));
  expect_mesh_refused("v 0 0 0\nl 1\n", MeshFormat::obj, ErrorCode::malformed, 2, "two vertices");
  expect_mesh_refused("v 0 0 0\np 2\n", MeshFormat::obj, ErrorCode::bad_index, 2, "does not exist");
}

TEST(ReadMesh, NumbersAreTheNearestDoubles) {
  const std::vector<Point3> expected = {{0.1, -0.0, 3.3778}, {2, 0.5, 5e-324}, {1e308, 0, -4}};
  EXPECT_EQ(read_mesh_text("OFF\n3 0 0\n0.1 -1e-400 3.3778\n+2 .5 5e-324\n1e308 -0 -4.\n", MeshFormat::off).vertices,
            expected);
}

/// expect_mesh_refused for one format.
struct Refused {
  MeshFormat format;
  Evidence operator()(std::string_view text, ErrorCode code, std::int64_t line, std::string_view words) const {
    return expect_mesh_refused(text, format, code, line, words);
  }
};

TEST(ReadMesh, OffErrors) {
  const Refused refused{MeshFormat::off};
  refused("", ErrorCode::truncated, 1, "'OFF'");
  refused("PLY\n", ErrorCode::malformed, 1, "'PLY'");
  refused("4OFF\n1 1 1\n", ErrorCode::malformed, 1, "three-dimensional");
  refused("OFF BINARY\n", ErrorCode::malformed, 1, "binary");
  refused("OFF\n3\n", ErrorCode::truncated, 2, "number of faces");
  refused("OFF\n3 -1 0\n", ErrorCode::malformed, 2, "'-1'");
  EXPECT_EQ(refused("OFF\n2 0 0\n0 0 0\n", ErrorCode::truncated, 3, "ends after 1").vertex, 1);
  EXPECT_EQ(refused("OFF\n2 0 0\n0 0 0\n0 1\n", ErrorCode::truncated, 4, "a coordinate").vertex, 1);
  EXPECT_EQ(refused("OFF\n1 0 0\n0 0 nan\n", ErrorCode::not_finite, 3, "finite").vertex, 0);
  refused("OFF\n1 0 0\n0 0 1e999\n", ErrorCode::not_finite, 3, "finite");
  refused("OFF\n1 0 0\n0 0 1.5.2\n", ErrorCode::malformed, 3, "'1.5.2'");
  const Evidence index =
      refused("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", ErrorCode::bad_index, 6, "does not exist");
  EXPECT_EQ(index.face, 0);
  EXPECT_EQ(index.vertex, 3);
  refused("OFF\n1 1 0\n0 0 0\n3 0 0 -1\n", ErrorCode::malformed, 4, "'-1'");
  EXPECT_FALSE(refused("OFF\n1 1 0\n0 0 0\n3 0 0 99999999999999999999\n", ErrorCode::bad_index, 4,
                       "does not exist: '99999999999999999999'")
                   .vertex);
  refused("OFF\n1 1 0\n0 0 0\n3 0 0 0 1 2 3 4 5\n", ErrorCode::malformed, 4, "more than a colour");
  EXPECT_EQ(refused("OFF\n1 2 0\n0 0 0\n1 0\n", ErrorCode::truncated, 4, "announces 2 faces").face, 1);
  refused("OFF\n1 0 0\n0 0 0\nrest\n", ErrorCode::malformed, 4, "'rest'");
  refused(corpus("read_off/huge_count.off"), ErrorCode::truncated, 3, "18446744073709551615 vertices");
}

TEST(ReadMesh, ObjErrors) {
  const Refused refused{MeshFormat::obj};
  refused("v 0 0\n", ErrorCode::malformed, 1, "the line ends");
  refused("v 0 0 0\nv 0 0 x\n", ErrorCode::malformed, 2, "'x'");
  EXPECT_EQ(refused("v 0 0 0\nv 0 inf 0\n", ErrorCode::not_finite, 2, "finite").vertex, 1);
  refused("v 0 0 0\nf\n", ErrorCode::malformed, 2, "the line ends");
  EXPECT_EQ(refused("v 0 0 0\nf 0 1 1\n", ErrorCode::bad_index, 2, "'0'").face, 0);
  refused("v 0 0 0\nf -2 1 1\n", ErrorCode::bad_index, 2, "'-2'");
  refused("v 0 0 0\nf 1/x 1x 1\n", ErrorCode::malformed, 2, "'1x'");
  refused("v 0 0 0\nf 1 1 99999999999999999999\n", ErrorCode::bad_index, 2, "'99999999999999999999'");
  const Evidence late = refused("v 0 0 0\n\nf 1 1 2\n", ErrorCode::bad_index, 3, "does not exist: '2'");
  EXPECT_EQ(late.vertex, 1);
  EXPECT_EQ(late.face, 0);
  refused("curv 0 1\n", ErrorCode::malformed, 1, "'curv'");
  refused("v 0 0 \\\nx\n", ErrorCode::malformed, 2, "'x'");
  refused("v 0 0 \\ 1\n", ErrorCode::malformed, 1, "'\\'");
  refused("v 0 0 0\nf 1 3 \\\n\nv 1 0 0\n", ErrorCode::bad_index, 2, "does not exist");
  refused("v 0 0 \\", ErrorCode::malformed, 1, "'\\'");
  for (const char* const nothing : {"", " \n"}) refused(nothing, ErrorCode::truncated, 1, "empty");
  EXPECT_EQ(read_mesh_text("# nothing\n", MeshFormat::obj), MeshData{});
}

TEST(ReadMesh, StlErrors) {
  const Refused refused{MeshFormat::stl};
  refused("", ErrorCode::truncated, 1, "'solid'");
  refused("solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0\n", ErrorCode::truncated, 4, "coordinate");
  refused("solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 nan\n", ErrorCode::not_finite, 4, "finite");
  refused("solid x\nfacet normal 0 0 1\nloop\n", ErrorCode::malformed, 3, "'outer'");
  refused("solid x\n", ErrorCode::truncated, 1, "'endsolid'");
  refused("solid x\nendsolid\nfacet\n", ErrorCode::malformed, 3, "'solid'");
  // binary: a byte instead of a line
  const std::string cube = corpus("read_stl/cube_binary.stl");
  refused(cube.substr(0, 50), ErrorCode::truncated, 0, "(byte 50)");
  refused(cube.substr(0, 200), ErrorCode::truncated, 0, "12 triangles and has room for 2 (byte 200)");
  refused(cube + "!", ErrorCode::malformed, 0, "(byte 684)");
  std::string bad = cube;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::memcpy(&bad[84 + 50 + 12 + 4], &nan, 4);
  EXPECT_EQ(refused(bad, ErrorCode::not_finite, 0, "(byte 150)").face, 1);
  std::string huge = cube;
  std::memset(&huge[80], 0xff, 4);
  refused(huge, ErrorCode::truncated, 0, "4294967295 triangles");
  std::string named = cube.substr(0, 200);
  named.replace(0, 10, "solid cube");
  refused(named, ErrorCode::truncated, 0, "12 triangles and has room for 2");
  refused(corpus("read_obj/cube.obj"), ErrorCode::malformed, 1, "expected 'solid' instead of ");
}

TEST(ReadMesh, PlyErrors) {
  const Refused refused{MeshFormat::ply};
  const std::string start = "ply\nformat ascii 1.0\n";
  const std::string vertex = "element vertex 1\nproperty float x\nproperty float y\nproperty float z\n";
  const std::string face = "element face 1\nproperty list uchar int vertex_indices\n";
  refused("", ErrorCode::truncated, 1, "'ply'");
  refused("plx\n", ErrorCode::malformed, 1, "'plx'");
  refused("ply\nformat text 1.0\n", ErrorCode::malformed, 2, "'text'");
  refused(start + "elements\n", ErrorCode::malformed, 3, "'elements'");
  refused(start + "property float x\n", ErrorCode::malformed, 3, "before the first element");
  refused(start + "element vertex 1\nproperty real x\n", ErrorCode::malformed, 4, "'real'");
  refused(start + "element vertex 1\nproperty list float int x\n", ErrorCode::malformed, 4, "no integer");
  refused(start + "element vertex 1\nproperty float x\nend_header\n", ErrorCode::malformed, 5, "one x, y and z");
  refused(start + vertex + "property float z\nend_header\n", ErrorCode::malformed, 8, "one x, y and z");
  refused(start + "element face 1\nproperty int a\nend_header\n", ErrorCode::malformed, 5, "vertex_indices");
  refused(start + vertex, ErrorCode::truncated, 6, "'end_header'");
  refused(start + vertex + "end_header\n0 0\n", ErrorCode::truncated, 8, "a number");
  EXPECT_EQ(refused(start + vertex + "end_header\n0 inf 0\n", ErrorCode::not_finite, 8, "finite").vertex, 0);
  refused(start + vertex + "end_header\n0 0 0 0\n", ErrorCode::malformed, 8, "after the last");
  const Evidence index =
      refused(start + vertex + face + "end_header\n0 0 0\n3 0 0 1\n", ErrorCode::bad_index, 11, "exist");
  EXPECT_EQ(index.face, 0);
  EXPECT_EQ(index.vertex, 1);
  const Evidence negative =
      refused(start + vertex + face + "end_header\n0 0 0\n3 0 0 -1\n", ErrorCode::bad_index, 11, "exist: -1");
  EXPECT_EQ(negative.face, 0);
  EXPECT_FALSE(negative.vertex) << "there is none of that index";
  for (const char* const number : {"inf", "nan", "1e400"})
    refused(start + vertex + face + "end_header\n0 0 0\n3 0 0 " + number + "\n", ErrorCode::malformed, 11,
            "no integer");
  refused(start + vertex + "element edge 1\nproperty int vertex1\nproperty int vertex2\nend_header\n0 0 0\n0 7\n",
          ErrorCode::bad_index, 12, "an edge names a vertex that does not exist: 7");
  refused(start + vertex + face + "end_header\n0 0 0\n3 0 0 0.5\n", ErrorCode::malformed, 11, "no integer");
  refused(start + vertex + face + "end_header\n0 0 0\n-3 0 0 0\n", ErrorCode::malformed, 11, "no count");
  refused(start + vertex + face + "end_header\n0 0 0\n1e300 0 0 0\n", ErrorCode::truncated, 11, "longer than the rest");
  const std::string binary = corpus("read_ply/cube_big.ply");
  refused(binary.substr(0, binary.size() - 1), ErrorCode::truncated, 0,
          "a list is longer than the rest of the file (byte ");
  refused(binary.substr(0, binary.size() - 18), ErrorCode::truncated, 0,
          "(byte " + std::to_string(binary.size() - 18) + ")");
  refused(binary + "!", ErrorCode::malformed, 0, "(byte " + std::to_string(binary.size()) + ")");
}

/// The text with other ends of its lines, or with something in front.
std::string with_line_ends(const std::string& text, const std::string& end) {
  std::string out;
  for (const char c : text) out += c == '\n' ? end : std::string(1, c);
  return out;
}

TEST(ReadMesh, LinesMayEndInAnyWayAndBeginBehindAMark) {
  const std::string mark = "\xEF\xBB\xBF";
  const std::string comment = "# a comment does not hide the rest\n";
  for (const auto& [file, format] :
       std::vector<std::pair<std::string, MeshFormat>>{{"read_off/cube.off", MeshFormat::off},
                                                       {"read_obj/cube.obj", MeshFormat::obj},
                                                       {"read_stl/cube_text.stl", MeshFormat::stl},
                                                       {"read_ply/cube_text.ply", MeshFormat::ply}}) {
    const bool comments = format == MeshFormat::off || format == MeshFormat::obj;
    const std::string text = (comments ? comment : "") + corpus(file);
    const MeshData expected = read_mesh_text(text, format);
    EXPECT_EQ(expected.vertices.size(), 8u) << file;
    for (const char* const end : {"\n", "\r\n", "\r"}) {
      const std::string other = with_line_ends(text, end);
      EXPECT_EQ(read_mesh_text(other, format), expected) << file;
      EXPECT_EQ(read_mesh_text(mark + other, format), expected) << file << " behind a mark";
      EXPECT_EQ(read_mesh_text(mark + end + " " + end + other, format), expected) << file << " behind blank lines";
    }
  }
  expect_mesh_refused("# a\rv 0 0 0\rx\r", MeshFormat::obj, ErrorCode::malformed, 3, "'x'");
  const std::string binary = corpus("read_ply/cube_little.ply");
  const std::size_t body = binary.find("end_header\n") + 11;
  for (const char* const end : {"\r\n", "\r"})
    EXPECT_EQ(read_mesh_text(with_line_ends(binary.substr(0, body), end) + binary.substr(body), MeshFormat::ply),
              read_mesh_text(binary, MeshFormat::ply));
}

TEST(ReadMesh, KeywordsHaveAnyCase) {
  const std::string text = corpus("read_off/cube.off");
  const MeshData cube = read_mesh_text(text, MeshFormat::off);
  ASSERT_TRUE(text.starts_with("OFF"));
  for (const char* const word : {"off", "Off"})
    EXPECT_EQ(read_mesh_text(word + text.substr(3), MeshFormat::off), cube) << word;
  const std::string coloured = "\n1 0 0\n1 2 3 0.5 0.5 0.5 1\n";
  for (const char* const word : {"COFF", "coff", "stOFF", "STCNoff"})
    EXPECT_EQ(read_mesh_text(word + coloured, MeshFormat::off).vertices, (std::vector<Point3>{{1, 2, 3}})) << word;
  expect_mesh_refused("nOFF\n3\n1 0 0\n", MeshFormat::off, ErrorCode::malformed, 1, "three-dimensional");
  expect_mesh_refused("noff\n3\n1 0 0\n", MeshFormat::off, ErrorCode::malformed, 1, "three-dimensional");
}

TEST(ReadMesh, PathsAndFormats) {
  for (const MeshFormat format :
       {MeshFormat::off, MeshFormat::obj, MeshFormat::stl, MeshFormat::ply, MeshFormat::glb, MeshFormat::three_mf}) {
    EXPECT_EQ(mesh_format("a.b/c" + std::string(extension(format))).value(), format);
  }
  EXPECT_EQ(mesh_format("A.STL").value(), MeshFormat::stl);
  EXPECT_EQ(name(mesh_format("off").error().code), "unsupported_format");
  EXPECT_EQ(name(mesh_format("a.off/b").error().code), "unsupported_format");
  EXPECT_EQ(name(read_mesh("no/such/file.off").error().code), "cannot_open");
  EXPECT_EQ(name(read_mesh("a.wkt").error().code), "unsupported_format");
  EXPECT_EQ(name(parse_mesh("glTF", MeshFormat::glb, "a.glb").error().code), "truncated");
  const Folder folder("mesh");
  std::filesystem::create_directory(folder / "x.off");
  EXPECT_EQ(name(read_mesh(folder / "x.off").error().code), "cannot_open");
}

}  // namespace
}  // namespace dymsum::io_test
