// Pictures of sets that were checked.
#pragma once

#include <string>

#include "dymsum/set_check.h"

namespace dymsum::cli {

/// The right set grey; what is missing of it red, what is too much orange, the furthest positions marked.
std::string set_picture(const PlanarOperand& right, const PlanarOperand& made, const PlanarSetCheck& check);
/// A grey, the set made of it, the same colours for what is no offset and what lies between; the least and the largest
/// distance marked.
std::string offset_picture(const PlanarOperand& a, const PlanarOperand& made, const PlanarOffsetCheck& check);

}  // namespace dymsum::cli
