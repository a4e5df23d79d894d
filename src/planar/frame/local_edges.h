// The pieces of segments that bound the sum: they are linked around nodes, and each patch is queried once.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "planar/boundary/collision.h"
#include "planar/frame/local_nodes.h"
#include "planar/frame/near_segments.h"

namespace dymsum::planar {

// Whether two regions at exact poses overlap when Q, reflected, is moved to a position: doubles first, then integers.

/// A position in scaled doubles, each coordinate off by at most `off`; the exact position is made when it is requested.
struct QueriedPosition {
  double x = 0, y = 0, off = 0;
  std::function<BigPosition()> exact;
};

class LocalOverlap {
 public:
  LocalOverlap(const Operand& p, const Operand& q);

  /// Whether the position lies in int P + int Q. Touching is not overlapping.
  bool holds(const PosedRegions& posed, const QueriedPosition& position);

  std::uint64_t tests() const { return tests_; }
  std::uint64_t exact_tests() const { return exact_tests_; }
  void clear_counts() { tests_ = exact_tests_ = 0; }

 private:
  struct Edges;
  struct Cone;
  bool crossed_before();
  bool boundaries_overlap();
  bool edges_overlap(std::uint32_t e, std::uint32_t f);
  bool provably_cross(const Edges& s) const;
  Edges edges(std::uint32_t e, std::uint32_t f) const;
  int side_of_p_edge(std::uint32_t e, std::uint32_t q_vertex, const Edges& s, bool end);
  int side_of_q_edge(std::uint32_t f, std::uint32_t p_vertex, const Edges& s, bool end);
  bool touch_overlapping(std::uint32_t e, std::uint32_t f, int on_p, int on_q);
  Cone cone(std::uint32_t op, std::uint32_t walk, bool along_edge) const;
  bool holds_component(std::uint32_t holder);
  bool contains(std::uint32_t holder, std::uint32_t vertex);
  int height(std::uint32_t holder, std::uint32_t walk, std::uint32_t vertex, int axis, Point seen);
  const BigPosition& exact_position();
  /// Vertex p of P plus vertex q of Q, less the position, times its denominator.
  BigPoint from_position(std::uint32_t p, std::uint32_t q);

  std::array<const Operand*, 2> operands_;
  std::array<FeatureDiscs, 2> edges_;
  const PosedRegions* posed_ = nullptr;
  const QueriedPosition* position_ = nullptr;
  std::optional<BigPosition> exact_;
  double off_ = 0;
  RecentEdges<8> witnesses_;
  std::uint64_t tests_ = 0, exact_tests_ = 0;
};

/// A piece of segments between two nodes, in the direction of its segment.
struct LocalEdge {
  std::uint32_t from = 0, to = 0;
  std::uint32_t segment = 0;
};

struct LocalEdges {
  std::vector<LocalEdge> boundary;  ///< in the box, the sum on their left
  std::vector<LocalEdge> tight;     ///< in the box, each once
  std::vector<std::uint32_t> tight_points;
};

enum class Linking : std::uint8_t {
  patches,  ///< one question for each patch; places that may be tight
  none,     ///< a question for every piece and every node: the reference
};

/// Pieces with length. Exact.
LocalEdges local_edges(const LocalNodes& nodes, LocalOverlap& overlap, Linking linking);

/// Pieces in a row on one line made one.
std::vector<LocalEdge> joined(const LocalNodes& nodes, std::vector<LocalEdge> edges);

}  // namespace dymsum::planar
