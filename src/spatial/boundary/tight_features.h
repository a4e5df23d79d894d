// Positions outside the open sum that nothing outside the closed sum comes near: passages exactly as wide as the part.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/parallel.h"
#include "spatial/arrangement/contacts.h"
#include "spatial/arrangement/solid_arrangement.h"
#include "spatial/boundary/collision.h"
#include "spatial/convolution/reduced_facets.h"

namespace dymsum::spatial {

// Contacts of two solids in single points: no edge of one is parallel to a face of the other there.

/// Answers to questions that are asked several times, by several threads.
class Answers {
 public:
  explicit Answers(std::size_t count) : known_(count, 0) {}

  /// find() has to be the same whenever it is called.
  template <class F>
  bool get(std::size_t k, F find) {
    std::uint8_t answer = base::shared_byte(known_[k]);
    if (answer == 0) base::set_shared_byte(known_[k], answer = find() ? 2 : 1);
    return answer == 2;
  }

 private:
  std::vector<std::uint8_t> known_;  // 0 not known yet, 1 no, 2 yes
};

/// Whether a face is parallel to an edge is decided exactly: nearly parallel ones, of which turned solids are full, are
/// not. Directions that lead apart are looked for in doubles with a bound, so a "no" may also mean that none was found.
/// "Yes" is a proof. Terms and use: docs/design/solid-sum.md, "Tight features". Threads may ask at once: answers are
/// remembered, and all of them find the same.
class LoneContacts {
 public:
  LoneContacts(const SumSpace& space, const FacetTable& table, const SolidOperand& p, const SolidOperand& q);

  /// An edge of two faces and a vertex of the other operand that touch inside the edge and overlap nowhere near touch
  /// nowhere else near, and there is an open set of ways to move apart.
  bool edge(EdgeId edge);
  /// The same of two vertices.
  bool corner(SumPoint corner);
  /// Whether a facet's contacts are lone ones: inside it the features that it is made from touch nowhere else near.
  bool facet(std::uint32_t facet);
  /// An edge of sums is not parallel to a plane.
  bool crosses(EdgeId edge, PlaneId plane) const;

 private:
  /// An edge of an operand as a direction, by name and in doubles.
  struct Line {
    DirectionSource direction;
    Direction near;
  };
  struct Side {
    DirectionSource::Of of;
    const SolidOperand& solid;
    const std::vector<Vec3>& at;
    double radius;
    std::vector<Direction> normals;
    Answers tame;  // per vertex

    Side(const SumSpace& space, DirectionSource::Of of, const SolidOperand& operand, const std::vector<Vec3>& vertices);
    Line line(std::uint32_t from, std::uint32_t to) const {
      return {{of, from, to}, edge_direction(at[from], at[to], radius)};
    }
    template <class F>
    bool all_triangles(std::uint32_t vertex, F f) const;
    template <class F>
    bool all_edges(std::uint32_t vertex, F f) const;
    bool has_free_direction(std::uint32_t vertex);
  };
  bool parallel(const Side& faces, std::uint32_t triangle, const Line& line) const;
  bool lone(const Side& edges, std::uint32_t from, std::uint32_t to, const Side& vertices, std::uint32_t v) const;
  bool lone(const Side& faces, std::uint32_t vertex, const Side& edges, std::uint32_t v) const;

  const SumSpace& space_;
  const FacetTable& table_;
  Side p_, q_;
  Answers edge_;
};

struct TightFeatures {
  std::vector<std::uint32_t> cells;              ///< of the arrangement
  std::vector<std::array<PointId, 2>> segments;  ///< edges of the arrangement that bound no tight cell
  std::vector<PointId> points;                   ///< that end no tight segment
  std::uint64_t tests = 0;
};

/// `boundary` tells of every cell whether it bounds the regular part of the sum's complement. `every_position` leaves
/// out no test, for reference. Statement and what is left out without a test: docs/design/solid-sum.md, "Tight
/// features". With a scope only what is in it is looked at; around its points everything has to be. Exact.
TightFeatures tight_features(const SumSpace& space, const FacetTable& table, const SolidArrangement& arrangement,
                             const std::vector<bool>& boundary, const Collision& collision, bool every_position,
                             StageWatch& watch, const ArrangementScope* scope = nullptr);

}  // namespace dymsum::spatial
