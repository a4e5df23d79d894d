// A source of exact positions for hand-made sums: a list. A vertex names its place in the list by its contacts.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <memory>
#include <utility>
#include <vector>

#include "planar/position/exact_source.h"

namespace dymsum {

class ListedSource : public ExactSource {
 public:
  Position position(const SumVertex& vertex) const override {
    ++queried;
    return positions.at(vertex.in.p);
  }

  /// A vertex at (x, y) whose `at` is off by (dx, dy).
  SumVertex add(exact::BigRational x, exact::BigRational y, double dx = 0, double dy = 0) {
    const auto number = static_cast<std::uint32_t>(positions.size());
    positions.push_back({std::move(x), std::move(y)});
    const Point nearest = planar::make_spot(positions.back()).nearest;
    SumVertex v;
    v.at = {nearest.x + dx, nearest.y + dy};
    v.in = v.out = {Contact::Kind::edge_of_p, number, 0};
    return v;
  }
  SumRing ring(std::initializer_list<std::pair<exact::BigRational, exact::BigRational>> points) {
    SumRing r;
    for (const auto& [x, y] : points) r.vertices.push_back(add(x, y));
    return r;
  }

  std::vector<Position> positions;
  mutable std::size_t queried = 0;  ///< how often a position was computed
};

/// 2^exponent.
inline exact::BigRational power_of_two(int exponent) {
  const exact::BigInteger power = exact::BigInteger(1) << (exponent < 0 ? -exponent : exponent);
  return exponent < 0 ? exact::BigRational(1, power) : exact::BigRational(power, 1);
}

}  // namespace dymsum
