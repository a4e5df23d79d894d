// A region under its sum with a disc, or a set made with one: true arcs.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "dymsum/growing_disc.h"
#include "io/picture/picture.h"
#include "io/source.h"

namespace dymsum {

namespace {

using io::append_rounded;
using io::Picture;
using io::Placement;

/// Path data on the canvas, where y points down: what turns counter-clockwise is swept with flag 0.
class ArcPath {
 public:
  ArcPath(const Placement& placement, double radius) : position_(placement), radius_(radius) {}

  void ring(const DiscRing& ring) {
    if (ring.pieces.front().from.kind == DiscCorner::Kind::none) {
      circle(ring.pieces.front());
      return;
    }
    command('M', ring.pieces.front().from.at);
    for (std::size_t i = 0; i < ring.pieces.size(); ++i) {
      const DiscPiece& piece = ring.pieces[i];
      const Point to = ring.pieces[(i + 1) % ring.pieces.size()].from.at;
      if (piece.of == DiscPiece::Of::edge) command('L', to);
      else arc(piece, to);
    }
    d_ += 'Z';
  }
  void segment(Point from, Point to) {
    command('M', from);
    command('L', to);
  }
  void dot(Point at) {
    command('M', at);
    d_ += "h0";
  }
  const std::string& data() const { return d_; }

 private:
  void number(double v) { append_rounded(d_, v, 3); }
  void command(char letter, Point p) {
    const Point q = position_(p);
    d_ += letter;
    number(q.x);
    d_ += ' ';
    number(q.y);
  }
  Point on_circle(const DiscPiece& piece, double angle) const {
    return {piece.centre.x + radius_ * std::cos(angle), piece.centre.y + radius_ * std::sin(angle)};
  }
  void arc_command(double sweep, Point to) {
    d_ += 'A';
    number(radius_ * position_.scale);
    d_ += ' ';
    number(radius_ * position_.scale);
    d_ += " 0 ";
    d_ += std::abs(sweep) > std::numbers::pi ? "1 " : "0 ";
    d_ += sweep > 0 ? "0 " : "1 ";
    const Point q = position_(to);
    number(q.x);
    d_ += ' ';
    number(q.y);
  }
  /// The arc is drawn in two halves where it is nearly all of a circle: an arc is determined by its ends, which are
  /// close together then.
  void arc(const DiscPiece& piece, Point to) {
    if (std::abs(piece.sweep) > 1.5 * std::numbers::pi)
      arc_command(piece.sweep / 2, on_circle(piece, piece.from_angle + piece.sweep / 2));
    arc_command(std::abs(piece.sweep) > 1.5 * std::numbers::pi ? piece.sweep / 2 : piece.sweep, to);
  }
  void circle(const DiscPiece& piece) {
    const Point start = on_circle(piece, 0);
    command('M', start);
    arc_command(piece.sweep / 2, on_circle(piece, std::numbers::pi));
    arc_command(piece.sweep / 2, start);
    d_ += 'Z';
  }

  Placement position_;
  double radius_;
  std::string d_;
};

void draw_set(Picture& picture, const DiscSet& set, const Placement& placement) {
  using namespace io;
  ArcPath lines(placement, set.radius), dots(placement, set.radius), tight(placement, set.radius),
      tight_dots(placement, set.radius);
  std::string parts;
  for (const DiscPart& part : set.parts) {
    ArcPath path(placement, set.radius);
    path.ring(part.outer);
    for (const DiscRing& hole : part.holes) path.ring(hole);
    parts += path.data();
  }
  picture.path(parts, fill_style(palette::kSum, palette::kSumEdge, stroke_for(set.piece_count())));
  for (const DiscSegment& s : set.segments) lines.segment(s.from.at, s.to.at);
  for (const DiscCorner& p : set.points) dots.dot(p.at);
  for (const DiscSegment& s : set.tight_segments) tight.segment(s.from.at, s.to.at);
  for (const DiscCorner& p : set.tight_points) tight_dots.dot(p.at);
  picture.path(lines.data(), line_style(palette::kSumEdge, 2));
  picture.path(dots.data(), dot_style(palette::kSumEdge, 6));
  picture.path(tight.data(), line_style("#fff", 5));
  picture.path(tight.data(), line_style(palette::kTight, 2.4));
  picture.path(tight_dots.data(), dot_style("#fff", 9));
  picture.path(tight_dots.data(), dot_style(palette::kTight, 6));
}

std::string describe_set(const DiscSet& set) {
  if (set.parts.empty() && set.segments.empty() && set.points.empty()) return "empty";
  std::string text =
      io::counted(set.parts.size(), "part", "parts") + ", " + io::counted(set.piece_count(), "piece", "pieces");
  if (set.hole_count() > 0) text += ", " + io::counted(set.hole_count(), "hole", "holes");
  return text;
}

}  // namespace

std::string draw_disc_set(const Region& p, const DiscSet& set) {
  using namespace io;
  constexpr double kSide = 760, kMargin = 28, kLegend = 60;
  Extent box;
  box.add(p.data());
  if (!set.parts.empty()) {
    const auto b = bounds(set);
    box.add(Ring{{b[0], b[1]}, {b[2], b[3]}});
  }
  const double scale = fitting_scale(box.width(), box.height(), kSide, kSide);
  const double width = std::max(scale * box.width(), 420.0), height = std::max(scale * box.height(), 24.0);
  Picture picture(width + 2 * kMargin, height + 2 * kMargin + kLegend, "disc");
  const Placement placement = place(box, scale, kMargin, kMargin + height);
  draw_plain(picture, p.data(), placement, palette::kP, palette::kPEdge);
  draw_set(picture, set, placement);
  draw_plain(picture, p.data(), placement, "none", palette::kPEdge);
  std::string caption = "radius ";
  append_rounded(caption, set.radius, 6);
  picture.text(kMargin, kMargin + height + 24, 13, palette::kQuiet, caption + ": " + describe_set(set));
  const double y = kMargin + height + 44;
  picture.swatch(kMargin, y, palette::kP, palette::kPEdge, "P");
  picture.swatch(kMargin + 80, y, palette::kSum, palette::kSumEdge, "result");
  if (!set.tight_segments.empty() || !set.tight_points.empty())
    picture.swatch(kMargin + 180, y, palette::kTight, palette::kTight, "tight");
  return std::move(picture).finish();
}

}  // namespace dymsum
