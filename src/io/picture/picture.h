// Pieces of SVG pictures: y points up, strokes legible at any scale, a small palette.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "dymsum/planar_sum.h"
#include "dymsum/region.h"

namespace dymsum::io {

namespace palette {
inline constexpr std::string_view kInk = "#243447";
inline constexpr std::string_view kQuiet = "#8593a1";
inline constexpr std::string_view kFrame = "#dfe5ea";
inline constexpr std::string_view kGrey = "#aab4be";
inline constexpr std::string_view kP = "#e8a33d", kPEdge = "#a8650a";
inline constexpr std::string_view kQ = "#5bb98c", kQEdge = "#1f7a52";
inline constexpr std::string_view kSum = "#9cc3ea", kSumEdge = "#1f5fa3";
inline constexpr std::string_view kTight = "#d81e3a";
}  // namespace palette

/// An axis-parallel box, empty until something is added.
struct Extent {
  Point low, high;
  bool empty = true;

  void add(Point p);
  void add(const Ring& ring);
  void add(const RegionData& data);
  double width() const { return empty ? 0 : high.x - low.x; }
  double height() const { return empty ? 0 : high.y - low.y; }
};

/// The map of the plane to the canvas: x -> scale x + dx, y -> dy - scale y.
struct Placement {
  double scale = 1, dx = 0, dy = 0;

  Point operator()(Point p) const { return {scale * p.x + dx, dy - scale * p.y}; }
  /// The same as the value of an SVG transform attribute.
  std::string matrix() const;
};

/// The lower left corner of `extent` at canvas position (left, bottom).
Placement place(const Extent& extent, double scale, double left, double bottom);

/// The largest scale at which a width and a height fit into a space; 1 when both are zero.
double fitting_scale(double width, double height, double space_width, double space_height);

/// Path data through exact coordinates, each ring closed.
void append_exact_ring(std::string& d, const Ring& ring, bool closed = true);
std::string exact_path(const Part& part);

/// Path data on the canvas, coordinates shortened to hundredths of a pixel, later ones relative.
class CanvasPath {
 public:
  explicit CanvasPath(const Placement& placement) : position_(placement) {}
  CanvasPath& chain(const std::vector<Point>& vertices, bool closed);
  CanvasPath& segment(Point from, Point to);
  CanvasPath& dot(Point at);
  CanvasPath& box(Point low, Point high);
  const std::string& data() const { return d_; }

 private:
  void move_to(Point p);
  void line_to(Point p);
  Placement position_;
  std::string d_;
  long long x_ = 0, y_ = 0;  // in hundredths
  bool started_ = false;
};

/// An SVG document that is written from front to back.
class Picture {
 public:
  /// `mark` becomes the data-dymsum attribute, which tells our own reader what to read.
  Picture(double width, double height, std::string_view mark);

  void text(double x, double y, double size, std::string_view fill, std::string_view text, bool bold = false);
  void open_group(std::string_view attributes);
  void close_group();
  /// Nothing when the path data is empty.
  void path(std::string_view d, std::string_view attributes);
  void swatch(double x, double y, std::string_view fill, std::string_view edge, std::string_view text);
  void raw(std::string_view svg) { out_ += svg; }
  std::string finish() &&;

 private:
  std::string out_;
};

std::string fill_style(std::string_view fill, std::string_view edge, double width);
std::string line_style(std::string_view edge, double width, double opacity = 1);
std::string dot_style(std::string_view edge, double diameter, double opacity = 1);

/// A stroke width that suits a number of vertices.
double stroke_for(std::size_t vertices);

/// "3 holes", "1 hole".
std::string counted(std::size_t count, std::string_view one, std::string_view many);
std::string describe(const RegionData& data);
std::string describe_tight(const PlanarSum& sum);

/// A region, on a canvas and not to be read back.
void draw_plain(Picture& picture, const RegionData& data, const Placement& placement, std::string_view fill,
                std::string_view edge);

/// A region whose paths carry data-dymsum marks and exact coordinates: what read_svg reads back.
void draw_marked(Picture& picture, const RegionData& data, const Placement& placement, std::string_view fill,
                 std::string_view edge);

/// A sum's rings as plain lists, every vertex the nearest double; its lower-dimensional pieces as polylines and points.
RegionData rounded_data(const PlanarSum& sum);
/// The same where that is a region; else the region of snap_rounded().
RegionData readable_data(const PlanarSum& sum);

/// Tight features, drawn to be seen: red lines and dots on a white rim.
void draw_tight(Picture& picture, const PlanarSum& sum, const Placement& placement);

}  // namespace dymsum::io
