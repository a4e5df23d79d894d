// Drawings of sets on each other, with positions marked.
#pragma once

#include <sstream>
#include <string>

#include "pictures/svg_paths.h"

namespace dymsum::cli {

/// An SVG file of the sets in a box, y downwards.
class MarkedDrawing {
 public:
  explicit MarkedDrawing(const Box& seen);

  /// `style`: attributes of SVG. Lines are as thin in all drawings.
  void add(const Drawn& set, const std::string& style);
  /// A circle around a position, and a line to another one; the worst one is larger. y upwards.
  void mark(Point at, bool worst);
  void join(Point from, Point to);
  std::string text() const { return svg_.str() + "</g>\n</svg>\n"; }

 private:
  double factor_;
  Point origin_;
  std::ostringstream svg_;
};

}  // namespace dymsum::cli
