// OFF: a keyword in any case, counts of vertices, faces and edges, the vertices, and per face a count, indices
// and perhaps a colour up to the line's end. In front of OFF, ST, C and N announce texture coordinates, colours and
// normals at the vertices: they are skipped up to the line's end. (A small n would announce other dimensions.)
#include <algorithm>
#include <cstdint>
#include <string>

#include "io/mesh/mesh_files.h"
#include "io/source.h"

namespace dymsum::io {

namespace {

class OffReader {
 public:
  explicit OffReader(const Source& source) : size_(source.text.size()), words_(source, true) {}

  MeshData read() {
    read_keyword();
    const std::uint64_t vertices = words_.count("the number of vertices");
    const std::uint64_t faces = words_.count("the number of faces");
    if (!words_.at_line_end()) words_.count("the number of edges");
    read_vertices(vertices);
    read_faces(faces, vertices);
    if (!words_.at_end())
      words_.fail(ErrorCode::malformed, "unexpected " + in_quotes(words_.peek()) + " after the last face");
    return std::move(data_);
  }

 private:
  void read_keyword() {
    const std::string_view word = words_.peek();
    if (!word.empty() && is_digit(word[0]) && scan_count(word).length == word.size()) return;  // it may be missing
    const std::size_t start = words_.offset();
    std::string_view prefix = words_.take("'OFF'");
    // The first count may follow at once, as in OFF8 12 18.
    const std::size_t letters = prefix.find_last_not_of("0123456789") + 1;
    if (letters < prefix.size() && letters >= 3 && same_word(prefix.substr(letters - 3, 3), "OFF")) {
      words_.go_to(start + letters);
      prefix = prefix.substr(0, letters);
    }
    if (prefix.size() < 3 || !same_word(prefix.substr(prefix.size() - 3), "OFF"))
      words_.fail_at(start, ErrorCode::malformed, "expected 'OFF' instead of " + in_quotes(word));
    prefix.remove_suffix(3);
    extras_ = !prefix.empty();
    for (const std::string_view part : {"ST", "C"}) {
      if (same_word(prefix.substr(0, part.size()), part)) prefix.remove_prefix(part.size());
    }
    if (prefix.starts_with('N')) prefix.remove_prefix(1);
    if (!prefix.empty()) {
      words_.fail_at(start, ErrorCode::malformed, in_quotes(word) + " files are not read, only three-dimensional ones");
    }
    if (same_word(words_.peek(), "BINARY")) words_.fail(ErrorCode::malformed, "binary OFF files are not read");
  }

  void read_vertices(std::uint64_t count) {
    // a vertex takes at least six characters
    data_.vertices.reserve(std::min<std::uint64_t>(count, size_ / 6 + 1));
    for (std::uint64_t i = 0; i < count; ++i) {
      const Evidence evidence = at_vertex(i);
      if (words_.at_end()) fail_short("vertices", count, i, evidence);
      const double x = words_.coordinate(evidence), y = words_.coordinate(evidence), z = words_.coordinate(evidence);
      data_.vertices.push_back({x, y, z});
      while (extras_ && !words_.at_line_end()) words_.number("a number", evidence);
    }
  }

  void read_faces(std::uint64_t count, std::uint64_t vertices) {
    data_.faces.reserve(std::min<std::uint64_t>(count, size_ / 2 + 1));
    for (std::uint64_t i = 0; i < count; ++i) {
      const Evidence evidence = at_face(i);
      if (words_.at_end()) fail_short("faces", count, i, evidence);
      const std::uint64_t corners = words_.count("a face's number of vertices", evidence);
      Face& face = data_.faces.emplace_back();
      for (std::uint64_t k = 0; k < corners; ++k) face.push_back(words_.index(vertices, evidence));
      for (int part = 0; !words_.at_line_end(); ++part) {
        if (part == 4) words_.fail(ErrorCode::malformed, "a face is followed by more than a colour", evidence);
        words_.number("a part of a colour", evidence);
      }
    }
  }

  [[noreturn]] void fail_short(const std::string& what, std::uint64_t announced, std::uint64_t found,
                               const Evidence& evidence) {
    const std::string announces = "the file announces " + std::to_string(announced) + " " + what;
    words_.fail(ErrorCode::truncated, announces + " and ends after " + std::to_string(found), evidence);
  }

  std::size_t size_;
  Words words_;
  bool extras_ = false;
  MeshData data_;
};

}  // namespace

MeshData read_off(const Source& source) { return OffReader(source).read(); }

}  // namespace dymsum::io
