#include "io/mesh/ply_header.h"

#include <array>
#include <utility>

namespace dymsum::io {

namespace {

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

}  // namespace

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

PlyHeader read_ply_header(Words& words) { return HeaderReader(words).read(); }

}  // namespace dymsum::io
