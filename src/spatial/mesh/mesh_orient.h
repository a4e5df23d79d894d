// The orientation of faces and shells, made right: a part of the named repair.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "dymsum/named_repairs.h"

namespace dymsum::spatial {

/// Whether every face is valid by itself, and has no vertex twice.
bool all_faces_valid(const MeshData& data);

/// Turns single faces over until all agree with their neighbours, as few as that takes. Only across edges of two faces;
/// what contradicts itself is left as it is. Returns those that were turned. O(n log n).
std::vector<std::uint32_t> turn_faces(MeshData& data);

/// What may be done to shells.
struct ShellRepairs {
  bool reverse = true;  ///< those that are inside out are reversed
  std::optional<NestedShells> nested =
      NestedShells::cavity;  ///< what one inside another one becomes that runs as that does
};

/// What was done to shells, by one face of each.
struct TurnedShells {
  std::vector<std::uint32_t> turned;    ///< that were inside out
  std::vector<std::uint32_t> cavities;  ///< inside others, that ran as these do: they bound cavities now
  std::vector<std::uint32_t> bodies;    ///< inside others, which they add nothing to
  std::vector<bool> dropped;            ///< the faces of these; empty where there are none
};

/// Reverses whole shells. Does nothing where the surface is not closed, or a face not valid. With NestedShells::solid a
/// shell bounds the solid exactly where the shells around it, each +1 where it runs outward and -1 inward, add up to 0
/// on one side of it alone.
TurnedShells turn_shells(MeshData& data, const ShellRepairs& repairs);

}  // namespace dymsum::spatial
