// What the tests of the readers of meshes share.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include <gtest/gtest.h>

#include "dymsum/mesh_io.h"

namespace dymsum::io_test {

inline constexpr MeshFormat kMeshFormats[] = {MeshFormat::off, MeshFormat::obj, MeshFormat::stl, MeshFormat::ply};

inline std::string_view extension(MeshFormat format) {
  constexpr std::string_view kNames[] = {".off", ".obj", ".stl", ".ply", ".glb"};
  return kNames[static_cast<int>(format)];
}

inline MeshData read_mesh_text(std::string_view text, MeshFormat format) {
  auto data = parse_mesh(text, format, "test");
  if (!data) {
    ADD_FAILURE() << data.error().to_string() << "\n" << text.substr(0, 400);
    return {};
  }
  return std::move(data).value();
}

/// The reader refuses the text with this code, at this line (0: none), and a sentence that contains `words`. Returns
/// the evidence.
inline Evidence expect_mesh_refused(std::string_view text, MeshFormat format, ErrorCode code, std::int64_t line,
                                    std::string_view words) {
  const auto data = parse_mesh(text, format, "dir/test.file");
  if (data) {
    ADD_FAILURE() << "accepted:\n" << text.substr(0, 400);
    return {};
  }
  const Error& error = data.error();
  EXPECT_EQ(name(error.code), name(code)) << error.to_string() << "\n" << text.substr(0, 400);
  EXPECT_EQ(error.evidence.file, "dir/test.file");
  EXPECT_EQ(error.evidence.line.value_or(0), line) << error.to_string() << "\n" << text.substr(0, 400);
  EXPECT_NE(error.message.find(words), std::string::npos) << error.to_string();
  return error.evidence;
}

}  // namespace dymsum::io_test
