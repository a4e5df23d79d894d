// The part of a planar sum near a position.
#include <cmath>
#include <string>
#include <utility>

#include "dymsum/planar_local_sum.h"
#include "io/picture/picture.h"

namespace dymsum {

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

}  // namespace dymsum
