// Parts at exact positions in a container, and the positions that are left for the next one: its inner fit without the
// open no-fit polygons of what is placed (docs/design/placement.md).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "dymsum/orientation.h"
#include "dymsum/planar_operand.h"
#include "dymsum/planar_sum.h"
#include "dymsum/rational.h"
#include "dymsum/region.h"
#include "dymsum/result.h"

namespace dymsum {

/// A placed part. Indices are never used again.
struct PlacedPart {
  std::uint32_t part = 0;   ///< its index
  std::uint32_t shape = 0;  ///< index of its shape
  RationalPoint at;         ///< of the reference point: the origin of the shape's coordinates
  friend bool operator==(const PlacedPart&, const PlacedPart&) = default;
};

/// A position at which a part touches what is around it.
struct CandidatePosition {
  enum class Kind : std::uint8_t {
    corner,   ///< a vertex of a part of the feasible set
    segment,  ///< the end of a segment: the part fits exactly between others and can slide
    point,    ///< the part fits exactly and cannot move
  };
  static constexpr std::uint32_t kContainer = 0xffffffff;
  Kind kind = Kind::corner;
  SumVertex vertex;                    ///< of FeasiblePositions::set, which has its exact position
  std::vector<std::uint32_t> touches;  ///< indices of parts, ascending, then kContainer: all it touches there
};

/// Where a shape can be placed without overlap: touching is allowed, so the set is closed.
struct FeasiblePositions {
  /// Parts with holes, segments and points; the latter are listed as tight too. Vertices name themselves, as those of
  /// results that were read.
  PlanarSum set;
  std::vector<CandidatePosition> candidates;  ///< all vertices of the set once, by x, then y, exactly
};

struct PlacementOptions {
  double spacing = 0;  ///< the least distance of two parts
  double margin = 0;   ///< the least distance of a part from the outside of the container, and from its holes
};

/// A value: what a copy places changes nothing elsewhere. Not thread-safe.
///
/// Everything is exact: shapes are turned by exact orientations and placed at rational positions, so a vertex of a
/// feasible set is a position for the next part. Distances are kept by polygons of 32 sides around the disc of that
/// radius: never less than what is requested is left between two parts, and never more than 1 % more is asked for.
class Placement {
 public:
  /// An empty container is an error, as one with polylines or points is (unsupported_operand); out_of_range for a
  /// spacing or margin that is negative or not finite. Others: those of erode.
  static Result<Placement> create(const Region& container, const PlacementOptions& options = {});

  /// A shape that parts may have, turned about the origin; its index, from 0 on. Errors: unsupported_operand for an
  /// empty shape, and those of minkowski_sum and erode.
  Result<std::uint32_t> add_shape(const Region& shape, const Orientation& orientation = {});
  std::size_t shape_count() const;

  /// The positions at which the shape lies in the container and overlaps no part. Only what was placed, moved or taken
  /// out since the last call for this shape is looked at, with what meets it; no-fit polygons of two shapes are
  /// computed once. Errors: bad_index; those of nfp.
  Result<FeasiblePositions> feasible(std::uint32_t shape);
  /// Whether it does so at one position. Errors: as feasible.
  Result<bool> is_free(std::uint32_t shape, const RationalPoint& at);
  /// A free position in doubles nearby, of few digits, where there is one among those that are looked at: multiples of
  /// `grid`, a power of two, at most three of them away in each coordinate. Parts that stand at such positions keep the
  /// numbers of later ones short, and are written without rounding. Errors: as feasible; out_of_range for the grid.
  Result<std::optional<Point>> free_beside(std::uint32_t shape, const RationalPoint& at, double grid);

  /// The index of the part. It may overlap others: nothing is checked. Errors: bad_index.
  Result<std::uint32_t> add_part(std::uint32_t shape, const RationalPoint& at);
  /// Errors: bad_index where there is no such part.
  Result<void> move_part(std::uint32_t part, const RationalPoint& at);
  Result<void> remove_part(std::uint32_t part);
  std::vector<PlacedPart> parts() const;  ///< ascending

  Placement(const Placement& other);
  Placement& operator=(const Placement& other);
  Placement(Placement&&) noexcept;
  Placement& operator=(Placement&&) noexcept;
  ~Placement();

 private:
  struct State;
  explicit Placement(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace dymsum
