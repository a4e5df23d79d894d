// The text inside SVG's path, points, transform, viewBox and style attributes.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "dymsum/region.h"
#include "io/region/curves.h"
#include "io/source.h"

namespace dymsum::io {

/// An attribute's value, and where to find it again in the file when something is wrong with it.
struct SvgText {
  std::string_view value;
  std::string_view name;
  std::size_t tag = 0;  ///< offset of the element's name
};

/// A run of lines and curves; a closed one does not repeat its first vertex.
struct Subpath {
  ChordChain chain;
  bool closed = false;
};

/// The subpaths of path data where `placement` puts them. Curves that are plainly straight (control points at the ends,
/// radius zero) are lines; others become chords as the options of the source say. Throws CurveFailure.
std::vector<Subpath> parse_path(const Source& source, const SvgText& text, const PlaneTransform& placement);

/// The points of polygon and polyline elements.
std::vector<Point> parse_points(const Source& source, const SvgText& text);

/// A length: a number, optionally in px.
double parse_length(const Source& source, const SvgText& text);

/// A list of translate, scale, rotate, skewX, skewY and matrix.
PlaneTransform parse_transform(const Source& source, const SvgText& text);

/// The rectangle of a nested svg element, in the coordinates around it.
struct SvgViewport {
  double x = 0, y = 0, width = 0, height = 0;
};

/// What a viewBox makes of the coordinates inside a viewport. Malformed for a size that is not positive, and for what
/// cuts off: `slice`.
PlaneTransform parse_view_box(const Source& source, const SvgText& text, const SvgViewport& viewport,
                              std::string_view preserve_aspect_ratio);

/// The value of a property: what the `style` attribute says, else the attribute of that name. Without blanks; empty
/// where neither does.
std::string_view svg_property(std::string_view style, std::string_view name, std::string_view attribute);

}  // namespace dymsum::io
