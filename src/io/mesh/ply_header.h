// The header of a PLY file: which elements follow, and what each of them holds.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/words.h"

namespace dymsum::io {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// The type's size in bytes.
std::size_t size_of(PlyType type);
bool is_integer(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;
  std::optional<PlyType> count;  ///< of a list: the type of its length
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

enum class PlyEncoding { ascii, little_endian, big_endian };

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::ascii;
  std::vector<PlyElement> elements;
};

/// Reads the header and leaves `words` at the first byte after the line of end_header.
PlyHeader read_ply_header(Words& words);

}  // namespace dymsum::io
