// What the tests of the readers of meshes share.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include <gtest/gtest.h>

#include "dymsum/mesh_io.h"
#include "io/refusal.h"

namespace dymsum::io_test {

inline constexpr MeshFormat kMeshFormats[] = {MeshFormat::off, MeshFormat::obj, MeshFormat::stl, MeshFormat::ply};

inline std::string_view extension(MeshFormat format) {
  constexpr std::string_view kNames[] = {".off", ".obj", ".stl", ".ply", ".glb", ".3mf"};
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
  return expect_refusal(parse_mesh(text, format, kRefusedFile), text, code, line, words);
}

}  // namespace dymsum::io_test
