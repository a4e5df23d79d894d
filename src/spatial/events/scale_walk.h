// All scales at which something happens to the sum of two solids one of which scales, and the sums between them: what
// SolidScaleEvents and families of solids have in common.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "dymsum/solid_scale_events.h"
#include "exact/big.h"
#include "spatial/events/scale_judge.h"
#include "spatial/moving/moving_solid_sum.h"
#include "spatial/moving/sum_shape.h"

namespace dymsum::spatial {

/// The error of operands, or options, that have no scale events.
std::optional<Error> scaling_refusal(const Mesh& p, const Mesh& q, int threads);

/// Which scales are listed.
enum class ListedScales : std::uint8_t {
  visible,  ///< at which the sum differs
  all,  ///< at which facets meet outside of the open sum: between two neighbours what touches where is constant, too
};

/// Queries may run at the same time.
class ScaleWalk {
 public:
  /// Requires no thin parts. Throws std::invalid_argument for more than 8,192 bits.
  ScaleWalk(const Mesh& p, const Mesh& q, const SolidScaleOptions& options);
  ScaleWalk(const ScaleWalk&) = delete;  // parts refer to each other
  ScaleWalk& operator=(const ScaleWalk&) = delete;

  std::size_t facet_count() const { return facets_ ? facets_->facets().size() : 0; }
  /// The operands as they are given.
  const ScalingPair& given() const { return given_; }

  /// The sum at a scale; `corners` as of assemble. Throws Cancelled, std::invalid_argument.
  SpatialSum at(const Scale& s, const Progress& progress, CornerContacts* corners = nullptr) const {
    return sum_of(given_, s, progress, options_.threads, corners);
  }
  SumShape shape(const Scale& s, const Progress& progress) const { return shape_of_sum(given_, s, progress); }

  /// All events in [a, b], in order, each scale once. Throws Cancelled, std::invalid_argument, BeyondScales.
  std::vector<ScaleEvent> events(const exact::BigRational& a, const exact::BigRational& b, ListedScales listed,
                                 const Progress& progress, SolidEventWork& work) const;
  /// Ends of ranges in which facets move by about their own size.
  std::vector<exact::BigRational> steps(const exact::BigRational& from, const exact::BigRational& to) const;

 private:
  /// The convolution is that of edge vectors and normals, and refers to vertices by indices.
  SpatialSum sum_of(const ScalingPair& of, const Scale& s, const Progress& progress, int threads,
                    CornerContacts* corners = nullptr) const;
  SumShape shape_of_sum(const ScalingPair& of, const Scale& s, const Progress& progress) const;
  using Shapes = std::map<exact::BigRational, SumShape>;
  Shapes shapes_at(const std::vector<exact::BigRational>& scales, StageWatch& watch) const;

  SolidScaleOptions options_;
  ScalingPair given_;
  SpatialOptions stages_;
  /// Facets of the operands beside the origin, the events of which are those of the given ones: (P + c) + s (Q + d) is
  /// P + s Q moved by c + s d.
  std::optional<MovingFacets> facets_;
  std::optional<ScaledOverlap> overlap_;
};

}  // namespace dymsum::spatial
