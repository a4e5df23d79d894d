// The text inside SVG's path, points, transform, viewBox and style attributes.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "dymsum/region.h"
#include "io/source.h"

namespace dymsum::io {

/// An attribute's value, and where to find it again in the file when something is wrong with it.
struct SvgText {
  std::string_view value;
  std::string_view name;
  std::size_t tag = 0;  ///< offset of the element's name
};

/// A run of straight lines; a closed one does not repeat its first vertex.
struct Subpath {
  std::vector<Point> vertices;
  bool closed = false;
};

/// The subpaths of path data. Curves that are plainly straight (control points at the ends, radius zero) are lines;
/// other curves fail as malformed, naming the command.
std::vector<Subpath> parse_path(const Source& source, const SvgText& text);

/// The points of polygon and polyline elements.
std::vector<Point> parse_points(const Source& source, const SvgText& text);

/// A length: a number, optionally in px.
double parse_length(const Source& source, const SvgText& text);

/// (x, y) -> (a x + c y + e, b x + d y + f).
struct SvgTransform {
  double a = 1, b = 0, c = 0, d = 1, e = 0, f = 0;

  bool identity() const { return a == 1 && b == 0 && c == 0 && d == 1 && e == 0 && f == 0; }
  /// This after `inner`.
  SvgTransform after(const SvgTransform& inner) const;
  /// Coordinates are rounded as they are computed, except under the identity, and infinite past the double range.
  Point apply(Point p) const;
};

/// A list of translate, scale and matrix. Rotations and skews, which are inexact, fail as malformed.
SvgTransform parse_transform(const Source& source, const SvgText& text);

/// The rectangle of a nested svg element, in the coordinates around it.
struct SvgViewport {
  double x = 0, y = 0, width = 0, height = 0;
};

/// What a viewBox makes of the coordinates inside a viewport. Malformed for a size that is not positive, and for what
/// cuts off: `slice`.
SvgTransform parse_view_box(const Source& source, const SvgText& text, const SvgViewport& viewport,
                            std::string_view preserve_aspect_ratio);

/// The value of a property: what the `style` attribute says, else the attribute of that name. Without blanks; empty
/// where neither does.
std::string_view svg_property(std::string_view style, std::string_view name, std::string_view attribute);

}  // namespace dymsum::io
