// P and Q beside their sum, all at one scale; the sum's rings are marked, so the picture reads back as the rounded sum.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "dymsum/planar_local_sum.h"
#include "dymsum/region_io.h"
#include "io/picture/picture.h"
#include "io/region/read_shapes.h"
#include "io/source.h"

namespace dymsum {

// A region as an SVG picture that reads back as the same region: the marked paths hold its own coordinates, and the
// group around them, which is for looking at only, turns y up.

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

// P and Q beside their sum, all at one scale; the sum's rings are marked, so the picture reads back as the rounded sum.

namespace {

std::string drawn(const Region& p, const Region& q, const PlanarSum& sum, const RegionData& result,
                  const SumNames& names) {
  using namespace io;
  constexpr double kMargin = 28, kGap = 48, kTitle = 46, kLegend = 44, kWidth = 1240, kHeight = 860;
  Extent box_p, box_q, box_sum;
  box_p.add(p.data());
  box_q.add(q.data());
  box_sum.add(result);
  for (const SumVertex& v : sum.tight_points) box_sum.add(v.at);
  for (const SumSegment& s : sum.tight_segments) box_sum.add(Ring{s.from.at, s.to.at});

  const double width_left = std::max(box_p.width(), box_q.width());
  const double height_left = box_p.height() + box_q.height();
  const double scale = fitting_scale(width_left + box_sum.width(), std::max(height_left, box_sum.height()),
                                     kWidth - 2 * kMargin - kGap, kHeight - 2 * kMargin - 2 * kTitle - kLegend);
  constexpr double kCharacter = 7.2;  // of the captions, on average
  const double captions =
      kCharacter * static_cast<double>(std::max(describe(p.data()).size(), describe(q.data()).size()));
  const double left = std::max(scale * width_left, captions);
  const double height_p = scale * box_p.height(), height_q = scale * box_q.height(),
               height_sum = scale * box_sum.height();
  const double inner = std::max(height_p + height_q + 2 * kTitle + kGap / 2, height_sum + kTitle);
  const double x_sum = kMargin + left + kGap;
  const double width = x_sum + std::max(scale * box_sum.width(), 300.0) + kMargin;

  Picture picture(width, inner + 2 * kMargin + kLegend, "sum");
  picture.text(kMargin, kMargin + 16, 19, palette::kPEdge, names.p, true);
  picture.text(kMargin, kMargin + 34, 13, palette::kQuiet, describe(p.data()));
  const double bottom_p = kMargin + kTitle + height_p;
  draw_plain(picture, p.data(), place(box_p, scale, kMargin, bottom_p), palette::kP, palette::kPEdge);

  const double top_q = bottom_p + kGap / 2;
  picture.text(kMargin, top_q + 16, 19, palette::kQEdge, names.q, true);
  picture.text(kMargin, top_q + 34, 13, palette::kQuiet, describe(q.data()));
  draw_plain(picture, q.data(), place(box_q, scale, kMargin, top_q + kTitle + height_q), palette::kQ, palette::kQEdge);

  picture.text(x_sum, kMargin + 16, 19, palette::kSumEdge, names.sum, true);
  picture.text(x_sum, kMargin + 34, 13, palette::kQuiet, describe(result));
  const Placement placement = place(box_sum, scale, x_sum, kMargin + kTitle + height_sum);
  draw_marked(picture, result, placement, palette::kSum, palette::kSumEdge);
  draw_tight(picture, sum, placement);

  const double y_legend = inner + 2 * kMargin + 12;
  picture.swatch(kMargin, y_legend, palette::kP, palette::kPEdge, names.p);
  picture.swatch(kMargin + 70, y_legend, palette::kQ, palette::kQEdge, names.q);
  picture.swatch(kMargin + 140, y_legend, palette::kSum, palette::kSumEdge, names.sum);
  const std::string tight = describe_tight(sum);
  if (!tight.empty()) picture.swatch(kMargin + 250, y_legend, palette::kTight, palette::kTight, tight);
  return std::move(picture).finish();
}

}  // namespace

std::string draw_sum(const Region& p, const Region& q, const PlanarSum& sum, const SumNames& names) {
  return drawn(p, q, sum, io::readable_data(sum), names);
}

std::string draw_sum(const Region& p, const Region& q, const PlanarSum& sum, const Region& rounded,
                     const SumNames& names) {
  return drawn(p, q, sum, rounded.data(), names);
}

// The part of a planar sum near a position.

namespace {

using io::CanvasPath;
using io::Placement;

constexpr double kCanvas = 640, kMargin = 30, kHeading = 34, kBand = 7;

/// Edges moved to their left by half the band, which then ends at them.
std::string band_of(const PlanarLocalPart& part, const Placement& placement) {
  CanvasPath path(placement);
  for (const PlanarLocalPart::Edge& e : part.edges) {
    const Point a = part.vertices[e.from], b = part.vertices[e.to];
    const double dx = b.x - a.x, dy = b.y - a.y, by = 0.5 * kBand / placement.scale / std::hypot(dx, dy);
    path.segment({a.x - dy * by, a.y + dx * by}, {b.x - dy * by, b.y + dx * by});
  }
  return path.data();
}

std::string lines_of(const PlanarLocalPart& part, const std::vector<PlanarLocalPart::Edge>& edges,
                     const Placement& placement) {
  CanvasPath path(placement);
  for (const PlanarLocalPart::Edge& e : edges) path.segment(part.vertices[e.from], part.vertices[e.to]);
  return path.data();
}

std::string heading_of(const PlanarLocalPart& part) {
  if (part.where == PlanarLocalPart::Where::inside) return "inside the sum";
  if (part.where == PlanarLocalPart::Where::outside) return "outside the sum";
  return io::counted(part.edges.size(), "edge", "edges") +
         "; tight: " + io::counted(part.tight_segments.size(), "segment", "segments") + ", " +
         io::counted(part.tight_points.size(), "point", "points");
}

}  // namespace

std::string part_svg(const PlanarLocalPart& part) {
  using namespace io;
  Extent extent;
  extent.add(part.box.low), extent.add(part.box.high);
  const double scale = fitting_scale(extent.width(), extent.height(), kCanvas, kCanvas);
  const double width = extent.width() * scale + 2 * kMargin, height = extent.height() * scale + kHeading + 2 * kMargin;
  Picture picture(width, height, "part");
  picture.text(kMargin, kMargin, 15, palette::kInk, heading_of(part), true);
  const Placement placement = place(extent, scale, kMargin, height - kMargin);
  const bool inside = part.where == PlanarLocalPart::Where::inside;
  picture.path(CanvasPath(placement).box(part.box.low, part.box.high).data(),
               fill_style(inside ? palette::kSum : "#fff", palette::kFrame, 1.5));
  picture.path(band_of(part, placement), line_style(palette::kSum, kBand, 0.8));
  picture.path(lines_of(part, part.edges, placement), line_style(palette::kSumEdge, 2));
  const std::string tight = lines_of(part, part.tight_segments, placement);
  picture.path(tight, line_style(palette::kTight, 2.4));
  CanvasPath dots(placement);
  for (const std::uint32_t v : part.tight_points) dots.dot(part.vertices[v]);
  picture.path(dots.data(), dot_style("#fff", 9));
  picture.path(dots.data(), dot_style(palette::kTight, 6));
  return std::move(picture).finish();
}

// A planar set alone, with its tight features.

std::string draw_section(const PlanarSum& sum, const std::vector<SumPart>& touching) {
  using namespace io;
  constexpr double kSide = 760, kMargin = 28, kLegend = 60;
  const RegionData result = readable_data(sum);
  PlanarSum only_touching = sum;
  only_touching.parts = touching;
  only_touching.segments.clear();
  only_touching.points.clear();
  Extent box;
  box.add(result);
  for (const SumVertex& v : sum.tight_points) box.add(v.at);
  for (const SumSegment& s : sum.tight_segments) box.add(Ring{s.from.at, s.to.at});
  const double scale = fitting_scale(box.width(), box.height(), kSide, kSide);
  const double width = std::max(scale * box.width(), 420.0), height = std::max(scale * box.height(), 24.0);
  Picture picture(width + 2 * kMargin, height + 2 * kMargin + kLegend, "sum");
  const Placement placement = place(box, scale, kMargin, kMargin + height);
  draw_marked(picture, result, placement, palette::kSum, palette::kSumEdge);
  if (!touching.empty()) draw_plain(picture, rounded_data(only_touching), placement, "#f6b8c1", palette::kTight);
  draw_tight(picture, sum, placement);
  picture.text(kMargin, kMargin + height + 24, 13, palette::kQuiet, describe(result));
  const double y = kMargin + height + 44;
  picture.swatch(kMargin, y, palette::kSum, palette::kSumEdge, "sum");
  if (!touching.empty()) picture.swatch(kMargin + 80, y, "#f6b8c1", palette::kTight, "touching only");
  const std::string tight = describe_tight(sum);
  if (!tight.empty()) picture.swatch(kMargin + 220, y, palette::kTight, palette::kTight, tight);
  return std::move(picture).finish();
}

}  // namespace dymsum
