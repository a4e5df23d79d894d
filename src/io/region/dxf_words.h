// What tells DXF files of our own from others, and the layers in them.
#pragma once

#include <string_view>

namespace dymsum::io {

inline constexpr std::string_view kDxfOwn = "dymsum region", kDxfOuter = "outer", kDxfHole = "hole", kDxfLine = "line",
                                  kDxfPoint = "point";

}  // namespace dymsum::io
