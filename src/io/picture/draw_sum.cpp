// P and Q beside their sum, all at one scale; the sum's rings are marked, so the picture reads back as the rounded sum.
#include <algorithm>
#include <string>
#include <utility>

#include "dymsum/region_io.h"
#include "io/picture/picture.h"

namespace dymsum {
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

}  // namespace dymsum
