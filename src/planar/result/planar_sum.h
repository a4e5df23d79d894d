// A source of exact positions that are known as such: the vertices of a set that was read.
#pragma once

#include <utility>
#include <vector>

#include "planar/position/exact_source.h"

namespace dymsum::planar {

/// A vertex is named by its index, as Contact::p of its edges and as its corner.
class ListedPositions final : public ExactSource {
 public:
  explicit ListedPositions(std::vector<Homogeneous> at) : at_(std::move(at)) {}

  Position position(const SumVertex& v) const override { return reduced(at_[v.corner_p]); }
  Homogeneous homogeneous(const SumVertex& v) const override { return at_[v.corner_p]; }

 private:
  std::vector<Homogeneous> at_;
};

}  // namespace dymsum::planar
