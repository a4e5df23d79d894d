// Well-known binary, read as the standard says: a second opinion on what the table writes.
#pragma once

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string_view>

#include "dymsum/region.h"

namespace dymsum::nesting_test {

class WkbReader {
 public:
  explicit WkbReader(std::string_view bytes) : rest_(bytes) {}

  RegionData read() {
    geometry();
    if (!rest_.empty()) throw std::runtime_error("bytes behind the geometry");
    return data_;
  }

 private:
  template <class T>
  T take() {
    if (rest_.size() < sizeof(T)) throw std::runtime_error("too short");
    T value;
    std::memcpy(&value, rest_.data(), sizeof(T));
    rest_.remove_prefix(sizeof(T));
    return value;
  }
  Point position() {
    const double x = take<double>();
    return {x, take<double>()};
  }
  std::vector<Point> positions() {
    std::vector<Point> points(take<std::uint32_t>());
    for (Point& p : points) p = position();
    return points;
  }
  Ring ring() {
    Ring points = positions();
    if (points.size() < 4 || points.front() != points.back()) throw std::runtime_error("a ring that is not closed");
    points.pop_back();
    return points;
  }
  void polygon() {
    Part part;
    for (auto rings = take<std::uint32_t>(); rings > 0; --rings) {
      if (part.outer.empty()) part.outer = ring();
      else part.holes.push_back(ring());
    }
    data_.parts.push_back(part);
  }
  void geometry() {
    if (take<std::uint8_t>() != 1) throw std::runtime_error("another order of bytes");
    switch (take<std::uint32_t>()) {
      case 1:
        data_.points.push_back(position());
        return;
      case 2:
        data_.polylines.push_back(positions());
        return;
      case 3:
        polygon();
        return;
      case 4:
      case 5:
      case 6:
      case 7:
        for (auto items = take<std::uint32_t>(); items > 0; --items) geometry();
        return;
      default:
        throw std::runtime_error("an unknown kind");
    }
  }

  std::string_view rest_;
  RegionData data_;
};

}  // namespace dymsum::nesting_test
