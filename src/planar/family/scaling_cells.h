// The cells of a scaling family: the events of its interval, the structure of the sum between each two, and the sum at
// a scale.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "dymsum/event.h"
#include "dymsum/family.h"
#include "dymsum/planar_sum.h"
#include "dymsum/scale.h"
#include "planar/frame/event_walk.h"
#include "planar/motion/operand_pair.h"
#include "planar/operand/lattice.h"

namespace dymsum::planar {

// Structures of sums: rings and pieces as names of vertices, without positions. Sums of one structure differ by where
// their vertices are.

/// The structures of the cells of a family, one after the other. Cells have names in common: a vertex is an index.
class SumStructures {
 public:
  /// Structures are kept in at most so many bytes; 0: all of them.
  explicit SumStructures(std::uint64_t most_bytes = 0) : most_bytes_(most_bytes) {}

  /// Appends the structure of a sum as that of the next cell. `rings`: identities of its rings, part by part, outer
  /// ring first, or none. Returns the first new name.
  std::uint32_t add(const PlanarSum& sum, std::span<const std::uint64_t> rings);

  /// Appends a cell whose structure is not kept.
  void add_dropped() { cells_.push_back({0, 0, {}, false}); }

  /// The name of a vertex, or none: another sum has it.
  static constexpr std::uint32_t kNoName = 0xffffffff;
  std::uint32_t name_of(const SumVertex& vertex) const;

  /// The vertices that are named; `at` of each is where it stood when it was first named.
  const std::vector<SumVertex>& names() const { return names_; }
  std::uint32_t cell_count() const { return static_cast<std::uint32_t>(cells_.size()); }
  bool kept(std::uint32_t cell) const { return cells_[cell].kept; }
  std::uint32_t kept_count() const { return kept_; }
  std::size_t bytes() const;

  /// A ring of vertices: names()[items[first .. last)].
  struct Ring {
    std::uint32_t first = 0, last = 0;
    std::uint32_t part = 0;
    bool hole = false;
    std::uint64_t identity = 0;
  };
  std::span<const Ring> rings(std::uint32_t cell) const;
  std::span<const std::uint32_t> vertices(const Ring& ring) const {
    return std::span(items_).subspan(ring.first, ring.last - ring.first);
  }

  /// What a sum has beside rings: names of segments, points, tight segments and tight points, in this order.
  struct Pieces {
    std::uint32_t first = 0, segments = 0, points = 0, tight_segments = 0, tight_points = 0;
    std::uint32_t count() const { return 2 * (segments + tight_segments) + points + tight_points; }
  };
  const Pieces& pieces(std::uint32_t cell) const { return cells_[cell].pieces; }
  std::span<const std::uint32_t> vertices(const Pieces& pieces) const {
    return std::span(items_).subspan(pieces.first, pieces.count());
  }

  /// The sum of a cell, put(name, vertex) makes a name a vertex at its position and returns the error of that. Not in
  /// canonical order: rings begin where they did when they were added. Requires: the structure is kept.
  template <class Put>
  void write(std::uint32_t cell, const Put& put, PlanarSum& sum) const;

 private:
  struct Cell {
    std::uint32_t first_ring = 0, last_ring = 0;
    Pieces pieces;
    bool kept = true;
  };
  std::uint32_t made_name(const SumVertex& vertex);
  void add_ring(const SumRing& ring, std::uint32_t part, bool hole, std::uint64_t identity);
  Pieces add_pieces(const PlanarSum& sum);

  std::uint64_t most_bytes_;
  std::uint32_t kept_ = 0;
  std::vector<SumVertex> names_;
  std::unordered_multimap<std::uint64_t, std::uint32_t> index_;  // of names, by their keys
  std::vector<std::uint32_t> items_;
  std::vector<Ring> rings_;
  std::vector<Cell> cells_;
};

template <class Put>
void SumStructures::write(std::uint32_t cell, const Put& put, PlanarSum& sum) const {
  const Cell& of = cells_[cell];
  double error = 0;
  const auto set_vertex = [&](std::uint32_t item, SumVertex& to) {
    const double e = put(item, to);
    error = e > error ? e : error;
  };
  for (const Ring& ring : rings(cell)) {
    if (!ring.hole) sum.parts.emplace_back();
    SumRing& to = ring.hole ? sum.parts[ring.part].holes.emplace_back() : sum.parts[ring.part].outer;
    to.vertices.resize(ring.last - ring.first);
    SumVertex* vertex = to.vertices.data();
    for (const std::uint32_t item : vertices(ring)) set_vertex(item, *vertex++);
  }
  const std::uint32_t* next = items_.data() + of.pieces.first;
  const auto segments = [&](std::uint32_t count, std::vector<SumSegment>& to) {
    for (std::uint32_t k = 0; k < count; ++k) {
      SumSegment& segment = to.emplace_back();
      set_vertex(*next++, segment.from);
      set_vertex(*next++, segment.to);
    }
  };
  const auto points = [&](std::uint32_t count, std::vector<SumVertex>& to) {
    for (std::uint32_t k = 0; k < count; ++k) set_vertex(*next++, to.emplace_back());
  };
  segments(of.pieces.segments, sum.segments);
  points(of.pieces.points, sum.points);
  segments(of.pieces.tight_segments, sum.tight_segments);
  points(of.pieces.tight_points, sum.tight_points);
  sum.at_error = error;
}

/// When what is there: of all names, edges and holes, in order of their first cells. Requires: all structures are kept.
std::vector<Lifetime> lifetimes_of(const SumStructures& structures);

// Where the vertices of a scaling family stand at any scale: linear functions of it, exact ones rounded once.

/// A vertex of a sum that scales: the sum of two vertices, or the crossing of two lines of fixed directions whose
/// heights are linear in the scale. So its coordinates are a + b (s - at), with a and b the doubles nearest to the
/// exact numbers, and `at` a scale at which the vertex is on the boundary: |a| and what is added to it are then no
/// larger than the sum is wide.
class ScaledPositions {
 public:
  explicit ScaledPositions(std::shared_ptr<const OperandPair> base);

  /// Adds the next vertices; they are on the boundary at the scale `at`.
  void add(std::span<const SumVertex> vertices, double at);

  /// Moves vertex k to where it stands at a scale, of which s is the nearest double. Returns a bound on the error of
  /// both coordinates, which is infinite where doubles know too little.
  double put(std::uint32_t k, double s, SumVertex& to) const {
    const Path& path = paths_[k];
    const double gap = s - path.at;
    to.at = {path.x + path.dx * gap, path.y + path.dy * gap};
    const double error = kPath * (path.size + path.speed * (s + std::abs(gap))) + exact::kSubnormal;
    return error <= kPoorPosition * (still_ + moved_ * s) ? error : INFINITY;
  }

 private:
  struct Path {
    double x = 0, y = 0, dx = 0, dy = 0, at = 0;
    double size = 0, speed = 0;  ///< the larger one of |x|, |y|; of |dx|, |dy|
  };
  Path corner(const SumVertex& v) const;
  Path crossing(const SumVertex& v, double at) const;

  // In roundings: of a 1 and of the sum, which is at most |a| + |b| |gap|, 1; of b 3 where a stretched coordinate is
  // rounded, of the gap and its product 1 each; the scale 1.
  static constexpr double kPath = exact::rounding_bound(6, 8);

  std::shared_ptr<const OperandPair> base_;
  std::array<FrameSource, 2> ends_;  ///< at the scales 1 and 2
  double still_ = 0, moved_ = 0;     ///< how wide the operands are, or how far from the origin
  std::vector<Path> paths_;
};

struct ScalingCells {
  ScalingPath path;
  exact::BigRational unit;  ///< the scale of `path` over that of the family
  bool unit_is_one = true;
  std::vector<ScaleEvent> events;  ///< of the family, in order
  SumStructures structures;        ///< of cell k, between events k - 1 and k
  std::vector<double> named_at;    ///< of cell k: the scale of `path` at which its new names stand on the boundary
  std::unique_ptr<ScaledPositions> positions;

  struct Location {
    std::uint32_t index = 0;
    bool event = false;
  };
  /// The event that a scale is, or its cell. O(log n).
  Location locate(const Scale& s) const;
  /// The scales along both axes at a scale t of `path`. Errors: bad_scale.
  Result<std::array<Scale, 2>> scales(const exact::BigRational& t) const;
  /// Takes over the structure of the next cell: that of a sum in it, at a scale of `path`.
  void add_cell(const PlanarSum& sum, std::span<const std::uint64_t> rings, double at);
  /// The next cell, whose structure is not kept.
  void add_dropped_cell();
  /// The sum at a scale. Requires: it lies in the interval. Errors: as sums from scratch.
  Result<PlanarSum> at(const Scale& s, Semantics semantics) const;
  /// The identities of the rings of a sum at a scale: of each that of the first ring with which it has a vertex in
  /// common, of the scale's cell, or of those before and after the event; 0 where there is none.
  std::vector<std::uint64_t> ring_ids(const PlanarSum& sum, const Scale& s) const;

 private:
  /// The scale of the path. Requires: s lies in the interval.
  Scale of_path(const Scale& s) const;
  Result<PlanarSum> from_scratch(const Scale& s, Semantics semantics) const;
  PlanarSum in_cell(std::uint32_t cell, const Scale& s) const;
};

/// A family without events and cells yet. Errors: those of ScalingFamily::create for operands and ratio.
Result<ScalingCells> empty_cells(const Region& p, const Region& q, const Scale& ratio, const FamilyOptions& options);

/// Errors: those of ScalingFamily::create.
Result<ScalingCells> scaling_cells(const Region& p, const Region& q, const Scale& low, const Scale& high,
                                   const Scale& ratio, const FamilyOptions& options);

}  // namespace dymsum::planar
