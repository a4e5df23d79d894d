// Layouts from drawings, in which nothing says what a part is but how it is drawn.
#pragma once

#include <string>
#include <vector>

#include "dymsum/layout_check.h"
#include "io/source.h"

namespace dymsum::io {

/// DXF: every closed ring with the rings inside it, which are its holes (and rings inside these parts again), is a
/// part. Rings that cross others are parts; which way rings run means nothing. SVG, as SVGnest writes it: every shape
/// element is a part, a group with elements of the class `hole` one, without these; elements of the class `bin` are
/// containers, and the parts of their group theirs. Throws ReadFailure.
std::vector<Layout> dxf_layouts(const Source& source, const LayoutReadOptions& options);
std::vector<Layout> svg_layouts(const Source& source, const LayoutReadOptions& options);

}  // namespace dymsum::io
