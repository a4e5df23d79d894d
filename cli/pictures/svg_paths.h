// Sets as SVG path data, y downwards.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "dymsum/planar_sum.h"

namespace dymsum::cli {

/// An axis-parallel box of the drawing; nothing is in it at first.
struct Box {
  double x0 = INFINITY, y0 = INFINITY, x1 = -INFINITY, y1 = -INFINITY;

  bool empty() const { return !(x0 <= x1); }
  double width() const { return x1 - x0; }
  double height() const { return y1 - y0; }
  double size() const { return width() > height() ? width() : height(); }
  void see(Point p);
  void see(const Box& other);
  /// Grown to have area, whatever was seen. Stops with bad input outside the range of single precision, in which
  /// viewers compute: what is larger is infinite to them, and what is smaller a point.
  Box drawable() const;
};

/// The origin from which a drawing counts its coordinates: they are written with seven digits, so that a scene far from
/// the origin has an origin of its own, the corner of its box; others keep theirs.
Point origin_of(const Box& box);

/// Points that follow one another, and whether the last one leads to the first.
struct Chain {
  std::vector<Point> points;
  bool closed = false;
};

/// What a picture needs of a set, y downwards.
struct Drawn {
  std::vector<Chain> chains;  ///< rings and segments
  std::vector<Chain> tight;   ///< tight segments
  std::vector<Point> dots;    ///< isolated and tight points
  Box box;
};

/// SVG path data.
std::string path_data(const std::vector<Chain>& chains, Point origin);

/// A sum with its tight features, moved.
Drawn drawn(const PlanarSum& sum, Point moved = {});
/// A region, scaled about the origin, then moved.
Drawn drawn(const Region& region, double scale = 1, Point moved = {});

/// The colour of tight features in every picture.
inline constexpr const char* kTightColour = "#d81e3a";
/// Tight segments and isolated and tight points, in units of which `factor` make a unit of the picture; empty where
/// there are none.
std::string tight_features(const Drawn& set, Point origin, double factor);

/// A coordinate with seven digits.
std::string number(double v);
/// Text for SVG.
std::string escaped(const std::string& text);

}  // namespace dymsum::cli
