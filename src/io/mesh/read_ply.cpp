// PLY, text and binary: the elements vertex (x, y, z), face (a list of indices of vertices) and edge (vertex1,
// vertex2), of which those of faces say nothing new; others are skipped. Every property that is read takes at least a
// byte of the file, and elements without properties are not counted through, so that announced numbers cost neither
// time nor memory.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/bytes.h"
#include "io/mesh/mesh_files.h"
#include "io/read_file.h"
#include "io/source.h"

namespace dymsum::io {
namespace {

// The header of a PLY file: which elements follow, and what each of them holds.

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

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

struct TypeName {
  std::string_view name;
  PlyType type;
};

constexpr std::array<TypeName, 16> kTypes = {{{"char", PlyType::int8},
                                              {"int8", PlyType::int8},
                                              {"uchar", PlyType::uint8},
                                              {"uint8", PlyType::uint8},
                                              {"short", PlyType::int16},
                                              {"int16", PlyType::int16},
                                              {"ushort", PlyType::uint16},
                                              {"uint16", PlyType::uint16},
                                              {"int", PlyType::int32},
                                              {"int32", PlyType::int32},
                                              {"uint", PlyType::uint32},
                                              {"uint32", PlyType::uint32},
                                              {"float", PlyType::float32},
                                              {"float32", PlyType::float32},
                                              {"double", PlyType::float64},
                                              {"float64", PlyType::float64}}};

class HeaderReader {
 public:
  explicit HeaderReader(Words& words) : words_(words) {}

  PlyHeader read() {
    words_.expect("ply");
    words_.expect("format");
    read_encoding();
    for (;;) {
      words_.peek();
      const std::size_t start = words_.offset();
      const std::string_view keyword = words_.take("'end_header'");
      if (keyword == "end_header") break;
      if (keyword == "comment" || keyword == "obj_info") {
        words_.skip_line();
      } else if (keyword == "element") {
        read_element();
      } else if (keyword == "property") {
        read_property(start);
      } else {
        words_.fail_at(start, ErrorCode::malformed, "no line of a PLY header begins with " + in_quotes(keyword));
      }
    }
    words_.skip_line();
    return std::move(header_);
  }

 private:
  void read_encoding() {
    words_.peek();
    const std::size_t start = words_.offset();
    const std::string_view name = words_.take("the encoding");
    if (name == "ascii") {
      header_.encoding = PlyEncoding::ascii;
    } else if (name == "binary_little_endian") {
      header_.encoding = PlyEncoding::little_endian;
    } else if (name == "binary_big_endian") {
      header_.encoding = PlyEncoding::big_endian;
    } else {
      words_.fail_at(start, ErrorCode::malformed, "no encoding is called " + in_quotes(name));
    }
    words_.take("the version");
  }

  void read_element() {
    PlyElement element;
    element.name = words_.take("an element's name");
    element.count = words_.count("the number of elements");
    header_.elements.push_back(std::move(element));
  }

  PlyType read_type() {
    const std::string_view name = words_.take("a type");
    for (const TypeName& known : kTypes) {
      if (known.name == name) return known.type;
    }
    words_.fail_at(words_.offset() - 1, ErrorCode::malformed, "no type is called " + in_quotes(name));
  }

  void read_property(std::size_t start) {
    if (header_.elements.empty()) words_.fail_at(start, ErrorCode::malformed, "a property before the first element");
    PlyProperty property;
    if (words_.peek() == "list") {
      words_.take("");
      property.count = read_type();
      if (!is_integer(*property.count))
        words_.fail_at(start, ErrorCode::malformed, "the length of a list is no integer");
    }
    property.type = read_type();
    property.name = words_.take("a property's name");
    header_.elements.back().properties.push_back(std::move(property));
  }

  Words& words_;
  PlyHeader header_;
};

/// The type's size in bytes.
std::size_t size_of(PlyType type) {
  switch (type) {
    case PlyType::int8:
    case PlyType::uint8:
      return 1;
    case PlyType::int16:
    case PlyType::uint16:
      return 2;
    case PlyType::int32:
    case PlyType::uint32:
    case PlyType::float32:
      return 4;
    case PlyType::float64:
      break;
  }
  return 8;
}

bool is_integer(PlyType type) { return type != PlyType::float32 && type != PlyType::float64; }

/// Reads the header and leaves `words` at the first byte after the line of end_header.
PlyHeader read_ply_header(Words& words) { return HeaderReader(words).read(); }

}  // namespace

// PLY, text and binary: the elements vertex (x, y, z), face (a list of indices of vertices) and edge (vertex1,
// vertex2), of which those of faces say nothing new; others are skipped. Every property that is read takes at least a
// byte of the file, and elements without properties are not counted through, so that announced numbers cost neither
// time nor memory.

namespace {

/// The numbers after the header, as text.
class TextNumbers {
 public:
  TextNumbers(const Source& source, std::size_t start) : words_(source, false) { words_.go_to(start); }

  double next(PlyType, const Evidence& evidence) { return words_.number("a number", evidence); }
  /// How many more numbers the file can hold.
  std::uint64_t room(PlyType, std::size_t size) const { return (size - words_.offset()) / 2 + 1; }
  [[noreturn]] void fail(ErrorCode code, std::string message, Evidence evidence) const {
    words_.fail_at(words_.offset() - 1, code, std::move(message), std::move(evidence));
  }
  void finish() {
    if (words_.at_end()) return;
    words_.fail(ErrorCode::malformed, "unexpected " + in_quotes(words_.peek()) + " after the last element");
  }

 private:
  Words words_;
};

/// The same as bytes.
class BinaryNumbers {
 public:
  BinaryNumbers(const Source& source, std::size_t start, std::endian order)
      : source_(source), order_(order), at_(start) {}

  double next(PlyType type, const Evidence& evidence) {
    if (source_.text.size() - at_ < size_of(type)) {
      fail_at(source_.text.size(), ErrorCode::truncated, "the file ends before what it announces", evidence);
    }
    last_ = at_;
    at_ += size_of(type);
    switch (type) {
      case PlyType::int8:
        return value<std::int8_t>();
      case PlyType::uint8:
        return value<std::uint8_t>();
      case PlyType::int16:
        return value<std::int16_t>();
      case PlyType::uint16:
        return value<std::uint16_t>();
      case PlyType::int32:
        return value<std::int32_t>();
      case PlyType::uint32:
        return value<std::uint32_t>();
      case PlyType::float32:
        return value<float>();
      case PlyType::float64:
        break;
    }
    return value<double>();
  }
  std::uint64_t room(PlyType type, std::size_t size) const { return (size - at_) / size_of(type); }
  [[noreturn]] void fail(ErrorCode code, std::string message, Evidence evidence) const {
    fail_at(last_, code, std::move(message), std::move(evidence));
  }
  void finish() const {
    if (at_ < source_.text.size()) fail_at(at_, ErrorCode::malformed, "bytes follow the last element", {});
  }

 private:
  template <class T>
  double value() const {
    return static_cast<double>(from_bytes<T>(source_.text, last_, order_));
  }
  [[noreturn]] void fail_at(std::size_t byte, ErrorCode code, std::string message, Evidence evidence) const {
    evidence.file = source_.file;
    throw ReadFailure{Error{code, std::move(message) + " (byte " + std::to_string(byte) + ")", std::move(evidence)}};
  }

  const Source& source_;
  std::endian order_;
  std::size_t at_ = 0, last_ = 0;
};

bool is_corner_list(const PlyProperty& property) {
  return property.count && (property.name == "vertex_indices" || property.name == "vertex_index");
}

/// Whether an element is an edge with two ends; others say nothing.
bool is_edge(const PlyElement& element) {
  const auto has = [&](std::string_view name) {
    return std::any_of(element.properties.begin(), element.properties.end(),
                       [&](const PlyProperty& property) { return property.name == name && !property.count; });
  };
  return element.name == "edge" && has("vertex1") && has("vertex2");
}

template <class Numbers>
class BodyReader {
 public:
  BodyReader(Numbers numbers, const PlyHeader& header, std::size_t size)
      : numbers_(std::move(numbers)), header_(header), size_(size) {
    for (const PlyElement& element : header.elements) {
      if (element.name == "vertex") vertices_ += element.count;
    }
  }

  MeshData read() {
    for (const PlyElement& element : header_.elements) {
      if (element.properties.empty()) continue;
      for (std::uint64_t i = 0; i < element.count; ++i) read_item(element);
    }
    numbers_.finish();
    add_edges();
    return std::move(data_);
  }

 private:
  /// Edges that no face has are segments by themselves.
  void add_edges() {
    if (edges_.empty()) return;
    const FaceEdges known(data_.faces);
    for (Face& edge : edges_)
      if (!known.has(edge)) data_.faces.push_back(std::move(edge));
  }

  void read_item(const PlyElement& element) {
    const bool vertex = element.name == "vertex", face = element.name == "face", edge = is_edge(element);
    Evidence evidence;
    if (vertex) evidence = at_vertex(data_.vertices.size());
    if (face) evidence = at_face(data_.faces.size());
    Point3 p;
    Face ends(2);
    for (const PlyProperty& property : element.properties) {
      if (property.count) {
        read_list(property, face && is_corner_list(property), evidence);
        continue;
      }
      const double value = numbers_.next(property.type, evidence);
      if (vertex) store(p, property.name, value, evidence);
      if (edge && property.name == "vertex1") ends[0] = corner(value, "an edge", evidence);
      if (edge && property.name == "vertex2") ends[1] = corner(value, "an edge", evidence);
    }
    if (vertex) data_.vertices.push_back(p);
    if (edge) edges_.push_back(std::move(ends));
  }

  void store(Point3& p, const std::string& name, double value, const Evidence& evidence) {
    double* const position = name == "x" ? &p.x : name == "y" ? &p.y : name == "z" ? &p.z : nullptr;
    if (!position) return;
    if (!std::isfinite(value)) numbers_.fail(ErrorCode::not_finite, "a coordinate is not a finite number", evidence);
    *position = value;
  }

  void read_list(const PlyProperty& property, bool corners, const Evidence& evidence) {
    const double length = numbers_.next(*property.count, evidence);
    if (!(length >= 0 && length == std::floor(length))) {
      numbers_.fail(ErrorCode::malformed, "the length of a list is no count", evidence);
    }
    if (length > static_cast<double>(numbers_.room(property.type, size_))) {
      numbers_.fail(ErrorCode::truncated, "a list is longer than the rest of the file", evidence);
    }
    Face face;
    for (auto left = static_cast<std::uint64_t>(length); left > 0; --left) {
      const double value = numbers_.next(property.type, evidence);
      if (corners) face.push_back(corner(value, "a face", evidence));
    }
    if (corners) data_.faces.push_back(std::move(face));
  }

  /// The index of a vertex that `of` names.
  std::uint32_t corner(double value, const char* of, Evidence evidence) {
    if (!std::isfinite(value) || value != std::floor(value))
      numbers_.fail(ErrorCode::malformed, "the index of a vertex is no integer", evidence);
    if (value >= 0 && value < static_cast<double>(std::min<std::uint64_t>(vertices_, UINT32_MAX))) {
      return static_cast<std::uint32_t>(value);
    }
    if (value >= 0 && value < 0x1p62) evidence.vertex = static_cast<std::int64_t>(value);
    std::string named;
    append_number(named, value);
    numbers_.fail(ErrorCode::bad_index, std::string(of) + " names a vertex that does not exist: " + named,
                  std::move(evidence));
  }

  Numbers numbers_;
  const PlyHeader& header_;
  std::size_t size_;
  std::uint64_t vertices_ = 0;
  MeshData data_;
  std::vector<Face> edges_;
};

/// Vertices have places, and faces corners, or the file is none of a mesh.
void check_elements(const PlyHeader& header, const Words& words) {
  for (const PlyElement& element : header.elements) {
    const auto has = [&](auto wanted) {
      return std::count_if(element.properties.begin(), element.properties.end(), wanted) == 1;
    };
    const auto scalar = [&](std::string_view name) {
      return has([&](const PlyProperty& property) { return property.name == name && !property.count; });
    };
    if (element.name == "vertex" && !(scalar("x") && scalar("y") && scalar("z"))) {
      words.fail_at(words.offset() - 1, ErrorCode::malformed, "the element vertex does not have one x, y and z each");
    }
    if (element.name == "tristrips" && element.count > 0) {
      words.fail_at(words.offset() - 1, ErrorCode::malformed,
                    "the element tristrips holds strips of triangles, which cannot be read: write them as faces");
    }
    if (element.name == "face" && !has(is_corner_list)) {
      words.fail_at(words.offset() - 1, ErrorCode::malformed, "the element face does not have one list vertex_indices");
    }
  }
}

/// How many bytes are text: those of the header with one behind it, which ends the line, where the numbers are none.
std::size_t text_of(std::string_view bytes) {
  constexpr std::string_view kEnd = "end_header";
  const std::size_t end = bytes.find(kEnd);
  if (end == std::string_view::npos || bytes.substr(0, end).find("binary_") == std::string_view::npos)
    return bytes.size();
  return std::min(end + kEnd.size() + 1, bytes.size());
}

}  // namespace

MeshData read_ply(const Source& given) {
  const PlainText plain(given.text, text_of(given.text));
  const Source source{plain.view(), given.file};
  Words words(source, false);
  const PlyHeader header = read_ply_header(words);
  check_elements(header, words);
  const std::size_t start = words.offset(), size = source.text.size();
  if (header.encoding == PlyEncoding::ascii) return BodyReader(TextNumbers(source, start), header, size).read();
  const std::endian order = header.encoding == PlyEncoding::big_endian ? std::endian::big : std::endian::little;
  return BodyReader(BinaryNumbers(source, start, order), header, size).read();
}

}  // namespace dymsum::io
