// Structures of sums: rings and pieces as names of vertices, without positions. Sums of one structure differ by where
// their vertices are.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "dymsum/family.h"
#include "dymsum/planar_sum.h"

namespace dymsum::planar {

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
  std::uint32_t name(const SumVertex& vertex);
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

}  // namespace dymsum::planar
