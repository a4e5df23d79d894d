// The vertex at which a loop of a face begins.
#pragma once

#include <cstdint>
#include <vector>

namespace dymsum::spatial {

/// Rotates the loop to its smallest rotation: it begins at its smallest vertex; where it comes by that several times,
/// at the visit after which it goes on smallest.
void start_at_smallest(std::vector<std::uint32_t>& loop);

}  // namespace dymsum::spatial
