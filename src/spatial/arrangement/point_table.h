// Points, each once, whatever it was made from.
#pragma once

#include <span>
#include <vector>

#include "spatial/convolution/stage_watch.h"
#include "spatial/convolution/sum_space.h"

namespace dymsum::spatial {

class PointTable {
 public:
  explicit PointTable(const SumSpace& space) : space_(space) {}

  /// The ids of points, new ones for those that are not there yet. Exact: found by their names, else by a hash of the
  /// position, compared exactly where sources differ.
  std::vector<PointId> add(std::span<const PointSource> sources, StageWatch& watch);

  std::size_t size() const { return sources_.size(); }
  const PointSource& source(PointId id) const { return sources_[id]; }
  const Approx& approx(PointId id) const { return approx_[id]; }
  exact::Residue hash(PointId id) const { return hash_[id]; }
  const std::vector<PointSource>& sources() const { return sources_; }

 private:
  /// Adds points whose sources are named but once.
  std::vector<PointId> add_named_once(std::span<const PointSource> sources, StageWatch& watch);
  void rehash(std::size_t slots);

  const SumSpace& space_;
  std::vector<PointSource> sources_;
  std::vector<Approx> approx_;
  std::vector<exact::Residue> hash_;
  std::vector<PointId> slots_;  // open addressing by hash, a power of two
};

}  // namespace dymsum::spatial
