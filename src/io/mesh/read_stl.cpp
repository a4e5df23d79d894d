// STL: triangles with coordinates of their own. Text: solid, facet, outer loop, vertex, endloop, endfacet, endsolid.
// Binary: 80 bytes of anything, a count, and per triangle a normal, three vertices and two bytes. A file whose size is
// the one that its count announces is binary, whatever it begins with. Normals are not used.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "io/bytes.h"
#include "io/mesh/mesh_files.h"
#include "io/read_file.h"
#include "io/source.h"
#include "spatial/mesh/vec3.h"

namespace dymsum::io {

namespace {

constexpr std::size_t kHeader = 84, kTriangle = 50;

void add_triangle(MeshData& data) {
  const auto first = static_cast<std::uint32_t>(data.vertices.size() - 3);
  data.faces.push_back({first, first + 1, first + 2});
}

class TextReader {
 public:
  explicit TextReader(const Source& source) : words_(source, false) {}

  MeshData read() {
    do {
      words_.expect("solid");
      words_.skip_line();  // its name
      while (same_word(words_.peek(), "facet")) read_facet();
      words_.expect("endsolid");
      words_.skip_line();
    } while (!words_.at_end());
    return std::move(data_);
  }

 private:
  void read_facet() {
    const Evidence face = at_face(data_.faces.size());
    words_.expect("facet");
    words_.expect("normal");
    for (int i = 0; i < 3; ++i) words_.number("a normal", face);
    words_.expect("outer");
    words_.expect("loop");
    for (int i = 0; i < 3; ++i) {
      words_.expect("vertex");
      const double x = words_.coordinate(face), y = words_.coordinate(face), z = words_.coordinate(face);
      data_.vertices.push_back({x, y, z});
    }
    words_.expect("endloop");
    words_.expect("endfacet");
    add_triangle(data_);
  }

  Words words_;
  MeshData data_;
};

[[noreturn]] void fail_at_byte(const Source& source, ErrorCode code, std::string message, std::size_t byte,
                               Evidence evidence = {}) {
  evidence.file = source.file;
  throw ReadFailure{Error{code, std::move(message) + " (byte " + std::to_string(byte) + ")", std::move(evidence)}};
}

std::uint64_t announced_triangles(std::string_view bytes) {
  return from_bytes<std::uint32_t>(bytes, 80, std::endian::little);
}

MeshData read_binary(const Source& source) {
  const std::string_view bytes = source.text;
  if (bytes.size() < kHeader) {
    fail_at_byte(source, ErrorCode::truncated, "the file ends before the number of triangles", bytes.size());
  }
  const std::uint64_t count = announced_triangles(bytes), room = (bytes.size() - kHeader) / kTriangle;
  if (count > room) {
    const std::string announces = "the file announces " + std::to_string(count) + " triangles";
    fail_at_byte(source, ErrorCode::truncated, announces + " and has room for " + std::to_string(room), bytes.size());
  }
  if (kHeader + count * kTriangle != bytes.size()) {
    fail_at_byte(source, ErrorCode::malformed, "bytes follow the last triangle", kHeader + count * kTriangle);
  }
  MeshData data;
  data.vertices.reserve(3 * count);
  data.faces.reserve(count);
  for (std::size_t f = 0; f < count; ++f) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t at = kHeader + f * kTriangle + 12 * (k + 1);
      const auto coordinate = [&](std::size_t i) {
        const float value = from_bytes<float>(bytes, at + 4 * i, std::endian::little);
        if (std::isfinite(value)) return static_cast<double>(value);
        fail_at_byte(source, ErrorCode::not_finite, "a coordinate is not a finite number", at + 4 * i, at_face(f));
      };
      data.vertices.push_back({coordinate(0), coordinate(1), coordinate(2)});
    }
    add_triangle(data);
  }
  return data;
}

bool has_announced_size(std::string_view bytes) {
  return bytes.size() >= kHeader && kHeader + kTriangle * announced_triangles(bytes) == bytes.size();
}

/// Whether it begins as text does, or holds nothing. Binary files that were cut off may begin so, too.
bool is_text(std::string_view text) {
  const auto first = static_cast<std::size_t>(std::find_if_not(text.begin(), text.end(), is_blank) - text.begin());
  return first == text.size() ||
         (same_word(text.substr(first, 5), "solid") && text.find('\0') == std::string_view::npos);
}

/// Whether text stands where a binary file has its number of triangles: another format under this name.
bool counts_in_letters(std::string_view bytes) {
  const std::string_view count = bytes.substr(std::min(bytes.size(), kHeader - 4), 4);
  return count.size() == 4 &&
         std::all_of(count.begin(), count.end(), [](char c) { return is_blank(c) || (c >= ' ' && c <= '~'); });
}

MeshData read_triangles(const Source& source) {
  if (has_announced_size(source.text)) return read_binary(source);
  const PlainText plain(source.text);
  if (is_text(plain.view()) || counts_in_letters(source.text)) return TextReader({plain.view(), source.file}).read();
  return read_binary(source);
}

}  // namespace

void merge_equal_vertices(MeshData& data) {
  std::vector<std::uint32_t> index = spatial::first_at_position(data.vertices);
  // The first of each keeps its position in the order of the file.
  std::vector<Point3> kept;
  for (std::uint32_t v = 0; v < index.size(); ++v) {
    if (index[v] != v) {
      index[v] = index[index[v]];
      continue;
    }
    index[v] = static_cast<std::uint32_t>(kept.size());
    kept.push_back(data.vertices[v]);
  }
  data.vertices = std::move(kept);
  for (Face& face : data.faces) {
    for (std::uint32_t& v : face) v = index[v];
  }
}

MeshData read_stl(const Source& source) {
  MeshData data = read_triangles(source);
  merge_equal_vertices(data);
  return data;
}

}  // namespace dymsum::io
