// A region as an SVG picture that reads back as the same region: the marked paths hold its own coordinates, and the
// group around them, which is for looking at only, turns y up.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "io/number_text.h"
#include "io/picture/picture.h"
#include "io/region/readers.h"

namespace dymsum {

namespace io {

namespace {

/// The width of a stroke inside the group that scales: vector-effect would do the same, but not every renderer knows
/// it.
std::string scaled_stroke(std::string_view edge, double width, double scale) {
  std::string style =
      "stroke=\"" + std::string(edge) + "\" stroke-linejoin=\"round\" stroke-linecap=\"round\" stroke-width=\"";
  append_number(style, width / scale);
  return style + "\"";
}

}  // namespace

void draw_marked(Picture& picture, const RegionData& data, const Placement& placement, std::string_view fill,
                 std::string_view edge) {
  std::size_t vertices = 0;
  for (const Part& part : data.parts) {
    vertices += part.outer.size();
    for (const Ring& hole : part.holes) vertices += hole.size();
  }
  picture.open_group("transform=\"" + placement.matrix() + "\"");
  picture.open_group("fill=\"" + std::string(fill) + "\" fill-rule=\"evenodd\" " +
                     scaled_stroke(edge, stroke_for(vertices), placement.scale));
  for (const Part& part : data.parts) picture.path(exact_path(part), "data-dymsum=\"part\"");
  picture.close_group();
  std::string lines, dots;
  for (const Polyline& line : data.polylines) append_exact_ring(lines, line, false);
  for (const Point p : data.points) {
    append_exact_ring(dots, {p}, false);
    dots += "h0";
  }
  picture.path(lines, "data-dymsum=\"polylines\" fill=\"none\" " + scaled_stroke(edge, 2, placement.scale));
  picture.path(dots, "data-dymsum=\"points\" fill=\"none\" " + scaled_stroke(edge, 6, placement.scale));
  picture.close_group();
}

std::string write_svg(const RegionData& data) {
  constexpr double kSide = 720, kMargin = 24, kCaption = 30;
  Extent extent;
  extent.add(data);
  // An extent of the largest doubles is past their range, and none of its thousandths is.
  const double unit = std::isfinite(extent.width()) && std::isfinite(extent.height()) ? 1 : 0x1p-10;
  const double across = unit * extent.high.x - unit * extent.low.x, up = unit * extent.high.y - unit * extent.low.y;
  const double fitting = fitting_scale(across, up, kSide, kSide), scale = fitting * unit;
  const double width = std::max(fitting * across, 260.0), height = std::max(fitting * up, 24.0);
  Picture picture(width + 2 * kMargin, height + 2 * kMargin + kCaption, "region");
  draw_marked(picture, data, place(extent, scale, kMargin, kMargin + height), palette::kSum, palette::kSumEdge);
  picture.text(kMargin, kMargin + height + kCaption, 13, palette::kQuiet, describe(data));
  return std::move(picture).finish();
}

}  // namespace io

std::string draw_region(const Region& region) { return io::write_svg(region.data()); }

}  // namespace dymsum
