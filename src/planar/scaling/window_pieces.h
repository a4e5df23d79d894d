// Cutting: segments of a window lose what lies in covered cells throughout.
#pragma once

#include "base/scratch.h"
#include "planar/scaling/window.h"

namespace dymsum::planar {

/// The ends a and b of a piece, each coordinate at both ends of the window, in the window's frame.
struct PieceEnds {
  Two ax, ay, bx, by;
  double dx, dy;  ///< the unscaled edge vector
  double error;   ///< of the side of a point of another piece
};

/// Gives a window's segments their pieces. `swept`: the frame of the mask. Returns the ends of the pieces.
Array<PieceEnds> cut_pieces(Window& window, const WindowFrame& swept, const SweptMask& mask, Scratch* memory);

}  // namespace dymsum::planar
