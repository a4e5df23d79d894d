// Pair finding: which pieces of a window may meet, and when they cross.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "planar/scaling/window_pieces.h"

namespace dymsum::planar {

class CoverMemory;
class EdgeSearch;

/// How crossings inside the sum are found, to be left out.
struct CoverSearch {
  EdgeSearch* edges = nullptr;    ///< none: they are not
  CoverMemory* memory = nullptr;  ///< of windows before, if there is one
};

/// Fills in a window's candidates, and what touches at every scale. Returns for every touch its pair of vertices;
/// nothing where more boxes of pieces meet than the settings allow, or where it is stopped. `search` leaves out
/// crossings that two edges prove covered while they exist.
std::optional<std::vector<WalkPair>> find_candidates(Window& window, const WindowFrame& swept, const SweptMask& mask,
                                                     const Array<PieceEnds>& ends, const WindowSettings& settings,
                                                     const CoverSearch& search);

}  // namespace dymsum::planar
