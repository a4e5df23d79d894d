#include "io/region/write_wkb.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/doubles.h"
#include "io/bytes.h"

namespace dymsum::io {
namespace {

// The numbers are those of OGC and ISO; the kind of several is three more than that of one.
constexpr std::uint32_t kPoint = 1, kLineString = 2, kPolygon = 3, kSeveral = 3, kCollection = 7;

void append_count(std::string& out, std::size_t count) { append_bytes(out, static_cast<std::uint32_t>(count)); }

void append_kind(std::string& out, std::uint32_t kind) {
  out += '\x01';  // the lowest byte first
  append_bytes(out, kind);
}

/// Positions are nearly all of a geometry: eight bytes at once.
void put_coordinate(char* to, double value) {
  const auto bits = base::bit_cast<std::uint64_t>(value + 0.0);
  for (unsigned i = 0; i < 8; ++i) to[i] = static_cast<char>((bits >> (8 * i)) & 0xff);
}

void append_position(std::string& out, Point p) {
  std::array<char, 16> bytes;
  put_coordinate(bytes.data(), p.x);
  put_coordinate(bytes.data() + 8, p.y);
  out.append(bytes.data(), bytes.size());
}

void append_closed(std::string& out, const Ring& ring) {
  append_count(out, ring.size() + 1);
  for (const Point p : ring) append_position(out, p);
  append_position(out, ring.front());
}

void append_one(std::string& out, const Part& part) {
  append_kind(out, kPolygon);
  append_count(out, 1 + part.holes.size());
  append_closed(out, part.outer);
  for (const Ring& hole : part.holes) append_closed(out, hole);
}

void append_one(std::string& out, const Polyline& line) {
  append_kind(out, kLineString);
  append_count(out, line.size());
  for (const Point p : line) append_position(out, p);
}

void append_one(std::string& out, Point p) {
  append_kind(out, kPoint);
  append_position(out, p);
}

/// One geometry of a kind, or several as one.
template <class T>
void append_all(std::string& out, const std::vector<T>& items, std::uint32_t kind) {
  if (items.size() > 1) {
    append_kind(out, kind + kSeveral);
    append_count(out, items.size());
  }
  for (const T& item : items) append_one(out, item);
}

}  // namespace

void append_wkb(std::string& out, const RegionData& data) {
  const int kinds = int{!data.parts.empty()} + int{!data.polylines.empty()} + int{!data.points.empty()};
  if (kinds != 1) {
    append_kind(out, kCollection);
    append_count(out, static_cast<std::size_t>(kinds));
  }
  append_all(out, data.parts, kPolygon);
  append_all(out, data.polylines, kLineString);
  append_all(out, data.points, kPoint);
}

}  // namespace dymsum::io
