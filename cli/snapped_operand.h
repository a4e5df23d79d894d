// --snap, and the hint that it would help.
#pragma once

#include <optional>
#include <string>

#include "dymsum/snapping.h"
#include "inputs.h"

namespace dymsum::cli {

/// Puts the coordinates on the grid of --snap, and says on standard error and in the notes what that moved. Without
/// it: says where coordinates are off a grid by rounding alone. Stops with wrong usage for a grid that is none.
template <class Data>
std::optional<Error> snap_operand(Data& data, const std::string& file, const InputOptions& options,
                                  ReadingNotes& notes);

}  // namespace dymsum::cli
