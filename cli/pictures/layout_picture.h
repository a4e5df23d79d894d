// A picture of a layout with what is wrong with it.
#pragma once

#include <string>

#include "dymsum/layout_check.h"

namespace dymsum::cli {

/// The container, the parts, those at fault coloured, and a ring around the position of each fault, the worst one
/// thick; SVG text.
std::string layout_picture(const Layout& layout, const LayoutCheck& check);

}  // namespace dymsum::cli
