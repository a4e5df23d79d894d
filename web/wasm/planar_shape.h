// What planar sums look like to JavaScript: shared by static sums and those that move.
#pragma once

#include <cstddef>

#include "bind.h"
#include "dymsum/planar_sum.h"

namespace dymsum::web {

/// SumShape of index.d.ts: vertices of rings, then of segments, points, tight segments and tight points.
val sum_shape(const PlanarSum& sum);
/// The vertex of an index in that shape. Error bad_index beyond.
const SumVertex& vertex_at(const PlanarSum& sum, std::size_t index);
/// Rings of parts alone.
val part_rings(const std::vector<SumPart>& parts);

}  // namespace dymsum::web
