// A planar set alone, with its tight features.
#include <algorithm>
#include <string>
#include <utility>

#include "dymsum/region_io.h"
#include "io/picture/picture.h"

namespace dymsum {

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
