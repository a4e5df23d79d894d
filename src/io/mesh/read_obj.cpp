// OBJ: one statement per line, or several that backslashes join; of these `v`, `f`, `l` (polylines, but for
// the edges of faces) and `p` (points) make the mesh. A face's corners
// are indices of vertices from 1 on, or from -1 backwards from the last vertex so far, each perhaps followed by
// /texture/normal, which is skipped.
#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "io/mesh/mesh_files.h"
#include "io/source.h"

namespace dymsum::io {

namespace {

/// What says nothing about vertices and faces.
constexpr std::array<std::string_view, 11> kSkipped = {"vt", "vn",     "vp",     "g",      "o",     "s",
                                                       "mg", "mtllib", "usemtl", "usemap", "maplib"};

class ObjReader {
 public:
  explicit ObjReader(const Source& source)
      : words_(source, true, true), blank_(std::all_of(source.text.begin(), source.text.end(), is_blank)) {}

  MeshData read() {
    // A statement is not needed, for solids without faces; but a file that was cut off at its beginning is none.
    if (blank_) words_.fail(ErrorCode::truncated, "the file is empty");
    while (!words_.at_end()) {
      const std::size_t start = words_.offset();
      const std::string_view keyword = words_.take("a statement");
      if (keyword == "v") {
        read_vertex();
      } else if (keyword == "f" || keyword == "l" || keyword == "p") {
        read_face(start, keyword);
      } else if (std::find(kSkipped.begin(), kSkipped.end(), keyword) != kSkipped.end()) {
        words_.skip_line();
      } else {
        words_.fail_at(start, ErrorCode::malformed, "no statement of an OBJ file begins with " + in_quotes(keyword));
      }
    }
    check_indices();
    drop_edges_of_faces();
    return std::move(data_);
  }

 private:
  void need_more(const std::string& what, const Evidence& evidence) {
    if (words_.at_line_end()) words_.fail(ErrorCode::malformed, "the line ends before " + what, evidence);
  }

  /// x y z, and a weight or a colour, which are skipped.
  void read_vertex() {
    const Evidence evidence = at_vertex(data_.vertices.size());
    std::array<double, 3> p;
    for (double& coordinate : p) {
      need_more("a coordinate", evidence);
      coordinate = words_.coordinate(evidence);
    }
    while (!words_.at_line_end()) words_.number("a number", evidence);
    data_.vertices.push_back({p[0], p[1], p[2]});
  }

  /// A face; a polyline as one segment after another; points.
  void read_face(std::size_t start, std::string_view keyword) {
    const Evidence evidence = at_face(data_.faces.size());
    Face face;
    need_more("the index of a vertex", evidence);
    while (!words_.at_line_end()) face.push_back(read_corner(evidence));
    const std::size_t corners = keyword == "f" ? face.size() : keyword == "l" ? 2 : 1;
    if (keyword == "l" && face.size() < 2)
      words_.fail_at(start, ErrorCode::malformed, "a line needs at least two vertices", evidence);
    for (std::size_t k = 0; k + corners <= face.size(); ++k) {
      data_.faces.emplace_back(face.begin() + static_cast<std::ptrdiff_t>(k),
                               face.begin() + static_cast<std::ptrdiff_t>(k + corners));
      face_offset_.push_back(start);
      is_line_.push_back(keyword == "l");
    }
  }

  void drop_edges_of_faces() {
    if (std::find(is_line_.begin(), is_line_.end(), true) == is_line_.end()) return;
    const FaceEdges known(data_.faces);
    std::size_t kept = 0;
    for (std::size_t f = 0; f < data_.faces.size(); ++f) {
      if (is_line_[f] && known.has(data_.faces[f])) continue;
      if (kept != f) data_.faces[kept] = std::move(data_.faces[f]);
      ++kept;
    }
    data_.faces.resize(kept);
  }

  std::uint32_t read_corner(Evidence evidence) {
    const std::size_t start = words_.offset();
    std::string_view text = words_.take("the index of a vertex");
    const std::string_view word = text;
    const bool backwards = text.starts_with('-');
    if (backwards) text.remove_prefix(1);
    const ScannedCount number = scan_count(text);
    const bool ends = number.length == text.size() || (number.length > 0 && text[number.length] == '/');
    if (number.length == 0 || !ends) {
      words_.fail_at(start, ErrorCode::malformed, "expected the index of a vertex instead of " + in_quotes(word),
                     evidence);
    }
    const std::uint64_t so_far = data_.vertices.size();
    // later vertices may be named, too: check_indices looks when all are known
    const bool exists = number.value > 0 && (backwards ? number.value <= so_far : number.value < UINT32_MAX);
    if (exists) return static_cast<std::uint32_t>(backwards ? so_far - number.value : number.value - 1);
    words_.fail_at(start, ErrorCode::bad_index, "a face names a vertex that does not exist: " + in_quotes(word),
                   evidence);
  }

  void check_indices() const {
    for (std::size_t f = 0; f < data_.faces.size(); ++f) {
      for (const std::uint32_t v : data_.faces[f]) {
        if (v < data_.vertices.size()) continue;
        Evidence evidence = at_face(f);
        evidence.vertex = v;
        // The file counts from 1.
        const std::string named = in_quotes(std::to_string(std::uint64_t{v} + 1));
        words_.fail_at(face_offset_[f], ErrorCode::bad_index, "a face names a vertex that does not exist: " + named,
                       evidence);
      }
    }
  }

  Words words_;
  bool blank_;
  MeshData data_;
  std::vector<std::size_t> face_offset_;
  std::vector<bool> is_line_;  // per face
};

}  // namespace

MeshData read_obj(const Source& source) { return ObjReader(source).read(); }

}  // namespace dymsum::io
