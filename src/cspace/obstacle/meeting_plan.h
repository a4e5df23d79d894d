// Two or three segments that meet at one position, just after the angle at which they do: their crossings in order
// along each of them, which of the pieces between are visible, and how visible pieces lead from what comes in to what
// goes out. Signs only, no coordinates.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "cspace/boundary/boundary_graph.h"

namespace dymsum::planar {

struct LocalArrangement {
  /// The position at which another segment crosses a segment or, `chain`, where it goes on after this one's end or ends
  /// before its start; -1 where a chain's other segment does not exist.
  struct Vertex {
    int other = -1;
    bool chain = false;
  };
  struct Member {
    WalkSegment segment;
    bool opens = false, closes = false;  ///< it starts, or ends, here
    int count = 0;                       ///< vertices after the event, in order
    std::array<Vertex, 2> vertices{};
    std::uint32_t in = kNobody, out = kNobody;  ///< visible nodes that come here and that leave
    void add(Vertex v) { vertices[static_cast<std::size_t>(count++)] = v; }
  };
  /// Visible pieces from a node that comes in to one that goes out, by members.
  struct Path {
    std::uint32_t in = kNobody, out = kNobody;
    std::vector<int> members;
  };
  struct Routes {
    std::optional<std::vector<Path>>
        paths;                             ///< nothing where pieces do not lead from all that comes in to all that goes
    std::vector<std::vector<int>> cycles;  ///< of visible pieces: a hole may be born
  };

  int size = 0;
  std::array<Member, 3> members;
  std::array<std::array<int, 3>, 3> cross{};  ///< signs of direction x direction
  std::vector<std::uint32_t> vanish;          ///< nodes that shrink to the position

  /// Whether a visible node comes here.
  bool any() const;
  Routes routes() const;

 private:
  struct Piece {
    int member = -1, index = 0;
  };
  using Seen = std::array<std::array<bool, 3>, 3>;
  bool visible(Piece p) const;
  bool starts_visible(Piece p) const;
  bool ends_visible(Piece p) const;
  Piece successor(Piece p) const;
  std::optional<std::vector<Path>> paths(Seen& seen) const;
  std::vector<std::vector<int>> cycles(Seen& seen) const;
};

}  // namespace dymsum::planar
