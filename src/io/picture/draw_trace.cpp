// The stages of a sum side by side, a panel each, all sum panels at one scale.
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "dymsum/region_io.h"
#include "io/picture/picture.h"
#include "io/source.h"

namespace dymsum {

namespace io {

namespace {

constexpr double kPanel = 500, kTallest = 520, kLowest = 150, kMargin = 26, kGap = 34, kTitle = 50, kPad = 10;
constexpr int kColumns = 3;

std::string coordinate(double value) {
  std::string text;
  append_rounded(text, value, 2);
  return text;
}

class TraceDrawing {
 public:
  TraceDrawing(const Region& p, const Region& q, const PlanarSum& sum)
      : p_(p), q_(q), sum_(sum), result_(rounded_data(sum)), trace_(sum.trace ? *sum.trace : PlanarTrace{}) {
    extent_.add(result_);
    for (const auto& s : trace_.convolution) extent_.add(Ring{s.from, s.to});
    for (const SumVertex& v : sum.tight_points) extent_.add(v.at);
    for (const SumSegment& s : sum.tight_segments) extent_.add(Ring{s.from.at, s.to.at});
    const double space = kPanel - 2 * kPad;
    scale_ = fitting_scale(extent_.width(), extent_.height(), space, kTallest - 2 * kPad);
    height_ = std::max(kLowest, scale_ * extent_.height() + 2 * kPad);
    const double left = kPad + (space - scale_ * extent_.width()) / 2;
    placement_ = place(extent_, scale_, left, height_ / 2 + scale_ * extent_.height() / 2);
    split_convolution();
  }

  std::string draw() {
    const int panels = sum_.trace ? 6 : 2;
    const int columns = std::min(panels, kColumns), rows = (panels + kColumns - 1) / kColumns;
    Picture picture(2 * kMargin + columns * kPanel + (columns - 1) * kGap,
                    2 * kMargin + rows * (height_ + kTitle) + (rows - 1) * kGap, "trace");
    if (sum_.trace) define_convolution(picture);
    panel(picture, "Operands", "P (amber): " + describe(p_.data()) + " · Q (green): " + describe(q_.data()),
          [&] { operands(picture); });
    if (sum_.trace) stages(picture);
    const std::string tight = describe_tight(sum_);
    panel(picture, "Result", describe(result_) + (tight.empty() ? "" : " · " + tight), [&] {
      draw_plain(picture, result_, placement_, palette::kSum, palette::kSumEdge);
      draw_tight(picture, sum_, placement_);
    });
    return std::move(picture).finish();
  }

 private:
  template <class Draw>
  void panel(Picture& picture, const std::string& title, const std::string& subtitle, Draw draw) {
    const double x = kMargin + (count_ % kColumns) * (kPanel + kGap);
    const double y = kMargin + (count_ / kColumns) * (height_ + kTitle + kGap);
    ++count_;
    picture.text(x, y + 14, 17, palette::kInk, std::to_string(count_) + "  " + title, true);
    picture.text(x, y + 36, 13, palette::kQuiet, subtitle);
    picture.open_group("transform=\"translate(" + coordinate(x) + " " + coordinate(y + kTitle) + ")\"");
    picture.raw("<rect width=\"" + coordinate(kPanel) + "\" height=\"" + coordinate(height_) +
                "\" rx=\"6\" fill=\"none\" stroke=\"" + std::string(palette::kFrame) + "\"/>\n");
    draw();
    picture.close_group();
  }

  void split_convolution() {
    CanvasPath of_p(placement_), of_q(placement_);
    for (const auto& s : trace_.convolution) {
      (s.edge_of_p ? of_p : of_q).segment(s.from, s.to);
      edges_of_p_ += s.edge_of_p;
    }
    of_p_ = of_p.data();
    of_q_ = of_q.data();
  }

  /// Written once, shown in three panels.
  void define_convolution(Picture& picture) const {
    const std::size_t count = trace_.convolution.size();
    const double width = count < 500 ? 1.2 : count < 4000 ? 0.7 : 0.5;
    const double opacity = count < 500 ? 1 : count < 4000 ? 0.85 : 0.7;
    picture.raw("<defs>\n<g id=\"convolution\">\n");
    picture.path(of_p_, line_style(palette::kPEdge, width, opacity));
    picture.path(of_q_, line_style(palette::kQEdge, width, opacity));
    picture.raw("</g>\n</defs>\n");
  }

  static void show_convolution(Picture& picture, double opacity) {
    picture.raw("<use href=\"#convolution\" opacity=\"" + coordinate(opacity) + "\"/>\n");
  }

  void operands(Picture& picture) const {
    Extent box_p, box_q;
    box_p.add(p_.data());
    box_q.add(q_.data());
    constexpr double kBetween = 24;
    const double scale = fitting_scale(box_p.width() + box_q.width(), std::max(box_p.height(), box_q.height()),
                                       kPanel - 2 * kPad - kBetween, height_ - 2 * kPad);
    const double left = (kPanel - kBetween - scale * (box_p.width() + box_q.width())) / 2;
    const auto bottom = [&](const Extent& box) { return (height_ + scale * box.height()) / 2; };
    draw_plain(picture, p_.data(), place(box_p, scale, left, bottom(box_p)), palette::kP, palette::kPEdge);
    const double left_q = left + scale * box_p.width() + kBetween;
    draw_plain(picture, q_.data(), place(box_q, scale, left_q, bottom(box_q)), palette::kQ, palette::kQEdge);
  }

  void stages(Picture& picture) {
    const std::size_t segments = trace_.convolution.size();
    panel(picture, "Convolution",
          counted(segments, "segment: ", "segments: ") + with_commas(edges_of_p_) + " edges of P (amber), " +
              with_commas(segments - edges_of_p_) + " edges of Q (green)",
          [&] { show_convolution(picture, 1); });
    panel(picture, "Masked cells",
          counted(trace_.masked_cells.size(), "run", "runs") + " of cells proved to be interior", [&] {
            CanvasPath cells(placement_);
            for (const auto& cell : trace_.masked_cells) cells.box(cell.low, cell.high);
            picture.path(cells.data(), "fill=\"" + std::string(palette::kSum) + "\" stroke=\"" +
                                           std::string(palette::kSum) + "\" stroke-width=\"0.3\"");
            show_convolution(picture, 0.45);
          });
    panel(picture, "Crossings", counted(trace_.crossings.size(), "crossing", "crossings") + " between live segments",
          [&] {
            show_convolution(picture, 0.4);
            const std::size_t count = trace_.crossings.size();
            CanvasPath dots(placement_);
            for (const Point x : trace_.crossings) dots.dot(x);
            const double diameter = count < 100 ? 5 : count < 2000 ? 3 : 1.8;
            picture.path(dots.data(), dot_style("#6a3fb5", diameter, count < 2000 ? 1 : 0.7));
          });
    panel(picture, "Loops",
          with_commas(trace_.kept_loops.size()) + " kept (blue), " + with_commas(trace_.dropped_loops.size()) +
              " dropped (grey)",
          [&] { loops(picture); });
  }

  void loops(Picture& picture) const {
    CanvasPath dropped(placement_), kept(placement_);
    std::size_t vertices = 0;
    for (const Ring& loop : trace_.dropped_loops) dropped.chain(loop, true);
    for (const Ring& loop : trace_.kept_loops) {
      kept.chain(loop, true);
      vertices += loop.size();
    }
    picture.path(dropped.data(), fill_style("#e9edf1", palette::kGrey, 1));
    picture.path(kept.data(), line_style(palette::kSumEdge, stroke_for(vertices) + 0.3));
  }

  const Region &p_, &q_;
  const PlanarSum& sum_;
  RegionData result_;
  PlanarTrace trace_;
  Extent extent_;
  double scale_ = 1, height_ = 0;
  Placement placement_;
  std::string of_p_, of_q_;
  std::size_t edges_of_p_ = 0;
  int count_ = 0;
};

}  // namespace

}  // namespace io

std::string draw_trace(const Region& p, const Region& q, const PlanarSum& sum) {
  return io::TraceDrawing(p, q, sum).draw();
}

}  // namespace dymsum
