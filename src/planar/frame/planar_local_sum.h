// A part of a sum as it leaves the library: positions in order, edges by them.
#pragma once

#include <vector>

#include "planar/frame/local_edges.h"

namespace dymsum {

/// Exact positions of the vertices of a part.
struct PlanarLocalPart::Positions {
  planar::LocalUnit unit;
  std::vector<planar::BigPosition> at;
};

namespace planar {

/// Vertices and edges of a part, from joined ones. Of a disc, only those that meet it.
std::shared_ptr<const PlanarLocalPart::Positions> assemble_part(const LocalNodes& nodes, LocalEdges edges,
                                                                const PlanarDisc* disc, PlanarLocalPart& part);

}  // namespace planar
}  // namespace dymsum
