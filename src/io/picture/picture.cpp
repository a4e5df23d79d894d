#include "io/picture/picture.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "dymsum/snap_rounding.h"
#include "io/source.h"
#include "planar/position/exact_source.h"

namespace dymsum::io {

namespace {

std::string number(double value, int decimals = 2) {
  std::string text;
  append_rounded(text, value, decimals);
  return text;
}

void append_escaped(std::string& out, std::string_view text) {
  for (const char c : text) {
    if (c == '<') {
      out += "&lt;";
    } else if (c == '&') {
      out += "&amp;";
    } else {
      out += c;
    }
  }
}

}  // namespace

void Extent::add(Point p) {
  if (empty) low = high = p;
  empty = false;
  low = {std::min(low.x, p.x), std::min(low.y, p.y)};
  high = {std::max(high.x, p.x), std::max(high.y, p.y)};
}

void Extent::add(const Ring& ring) {
  for (const Point p : ring) add(p);
}

void Extent::add(const RegionData& data) {
  for (const Part& part : data.parts) add(part.outer);
  for (const Polyline& line : data.polylines) add(line);
  add(data.points);
}

std::string Placement::matrix() const {
  std::string text = "matrix(";
  append_number(text, scale);
  text += " 0 0 ";
  append_number(text, -scale);
  text += ' ';
  append_number(text, dx);
  text += ' ';
  append_number(text, dy);
  return text + ")";
}

Placement place(const Extent& extent, double scale, double left, double bottom) {
  return {scale, left - scale * extent.low.x, bottom + scale * extent.low.y};
}

double fitting_scale(double width, double height, double space_width, double space_height) {
  double scale = 0;
  if (width > 0) scale = space_width / width;
  if (height > 0 && (scale == 0 || space_height / height < scale)) scale = space_height / height;
  return scale > 0 && std::isfinite(scale) ? scale : 1;
}

void append_exact_ring(std::string& d, const Ring& ring, bool closed) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    d += i == 0 ? 'M' : 'L';
    append_number(d, ring[i].x);
    d += ' ';
    append_number(d, ring[i].y);
  }
  if (closed && !ring.empty()) d += 'Z';
}

std::string exact_path(const Part& part) {
  std::string d;
  append_exact_ring(d, part.outer);
  for (const Ring& hole : part.holes) append_exact_ring(d, hole);
  return d;
}

void CanvasPath::move_to(Point p) {
  const Point q = position_(p);
  const auto hundredths = [](double v) { return std::llround(std::clamp(v, -1e9, 1e9) * 100); };
  const long long x = hundredths(q.x), y = hundredths(q.y);
  d_ += started_ ? 'm' : 'M';
  d_ += number(static_cast<double>(x - x_) / 100);
  d_ += ' ';
  d_ += number(static_cast<double>(y - y_) / 100);
  x_ = x, y_ = y;
  started_ = true;
}

void CanvasPath::line_to(Point p) {
  d_ += 'l';
  const std::size_t command = d_.size() - 1;
  move_to(p);
  d_.erase(command + 1, 1);  // the move's letter
}

CanvasPath& CanvasPath::chain(const std::vector<Point>& vertices, bool closed) {
  if (vertices.empty()) return *this;
  move_to(vertices.front());
  const long long x = x_, y = y_;
  for (std::size_t i = 1; i < vertices.size(); ++i) line_to(vertices[i]);
  if (!closed) return *this;
  d_ += 'z';
  x_ = x, y_ = y;
  return *this;
}

CanvasPath& CanvasPath::segment(Point from, Point to) {
  move_to(from);
  line_to(to);
  return *this;
}

CanvasPath& CanvasPath::dot(Point at) {
  move_to(at);
  d_ += "h0";
  return *this;
}

CanvasPath& CanvasPath::box(Point low, Point high) {
  return chain({low, {high.x, low.y}, high, {low.x, high.y}}, true);
}

Picture::Picture(double width, double height, std::string_view mark) {
  const std::string w = number(width, 0), h = number(height, 0);
  out_ = R"(<svg xmlns="http://www.w3.org/2000/svg" width=")" + w + "\" height=\"" + h + "\" viewBox=\"0 0 " + w + " " +
         h + "\"";
  out_ += " data-dymsum=\"" + std::string(mark) +
          "\" font-family=\"Inter, Helvetica, Arial, 'DejaVu Sans', sans-serif\">\n";
  out_ += "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n";
}

void Picture::text(double x, double y, double size, std::string_view fill, std::string_view text, bool bold) {
  out_ += "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\" font-size=\"" + number(size) + "\" fill=\"" +
          std::string(fill) + "\"";
  out_ += bold ? " font-weight=\"600\">" : ">";
  append_escaped(out_, text);
  out_ += "</text>\n";
}

void Picture::open_group(std::string_view attributes) {
  out_ += "<g ";
  out_ += attributes;
  out_ += ">\n";
}

void Picture::close_group() { out_ += "</g>\n"; }

void Picture::path(std::string_view d, std::string_view attributes) {
  if (d.empty()) return;
  out_ += "<path ";
  out_ += attributes;
  out_ += " d=\"";
  out_ += d;
  out_ += "\"/>\n";
}

void Picture::swatch(double x, double y, std::string_view fill, std::string_view edge, std::string_view label) {
  out_ += "<rect x=\"" + number(x) + "\" y=\"" + number(y - 11) + "\" width=\"14\" height=\"14\" rx=\"3\" fill=\"" +
          std::string(fill) + "\" stroke=\"" + std::string(edge) + "\"/>\n";
  text(x + 21, y + 1, 13, palette::kInk, label);
}

std::string Picture::finish() && { return std::move(out_) + "</svg>\n"; }

std::string fill_style(std::string_view fill, std::string_view edge, double width) {
  return "fill=\"" + std::string(fill) + "\" fill-rule=\"evenodd\" " + "stroke=\"" + std::string(edge) +
         "\" stroke-width=\"" + number(width) + "\" stroke-linejoin=\"round\" vector-effect=\"non-scaling-stroke\"";
}

std::string line_style(std::string_view edge, double width, double opacity) {
  std::string style = "fill=\"none\" stroke=\"" + std::string(edge) + "\" stroke-width=\"" + number(width) +
                      "\" stroke-linejoin=\"round\" stroke-linecap=\"round\" vector-effect=\"non-scaling-stroke\"";
  if (opacity < 1) style += " stroke-opacity=\"" + number(opacity) + "\"";
  return style;
}

std::string dot_style(std::string_view edge, double diameter, double opacity) {
  return line_style(edge, diameter, opacity);
}

double stroke_for(std::size_t vertices) { return vertices < 200 ? 1.6 : vertices < 1500 ? 1.1 : 0.7; }

std::string counted(std::size_t count, std::string_view one, std::string_view many) {
  return with_commas(count) + " " + std::string(count == 1 ? one : many);
}

std::string describe(const RegionData& data) {
  std::size_t vertices = data.points.size(), holes = 0;
  for (const Part& part : data.parts) {
    vertices += part.outer.size();
    holes += part.holes.size();
    for (const Ring& hole : part.holes) vertices += hole.size();
  }
  for (const Polyline& line : data.polylines) vertices += line.size();
  if (vertices == 0) return "empty";
  std::string text = counted(vertices, "vertex", "vertices");
  if (data.parts.size() > 1) text = counted(data.parts.size(), "part", "parts") + ", " + text;
  if (holes > 0) text += ", " + counted(holes, "hole", "holes");
  if (!data.polylines.empty()) text += ", " + counted(data.polylines.size(), "polyline", "polylines");
  if (!data.points.empty()) text += ", " + counted(data.points.size(), "point", "points");
  return text;
}

std::string describe_tight(const PlanarSum& sum) {
  std::string text;
  if (!sum.tight_segments.empty()) text = counted(sum.tight_segments.size(), "tight segment", "tight segments");
  if (sum.tight_points.empty()) return text;
  return text + (text.empty() ? "" : ", ") + counted(sum.tight_points.size(), "tight point", "tight points");
}

void draw_plain(Picture& picture, const RegionData& data, const Placement& placement, std::string_view fill,
                std::string_view edge) {
  std::size_t vertices = 0;
  std::string d;
  for (const Part& part : data.parts) {
    CanvasPath path(placement);
    path.chain(part.outer, true);
    vertices += part.outer.size();
    for (const Ring& hole : part.holes) {
      path.chain(hole, true);
      vertices += hole.size();
    }
    d += path.data();
  }
  picture.path(d, fill_style(fill, edge, stroke_for(vertices)));
  CanvasPath lines(placement), dots(placement);
  for (const Polyline& line : data.polylines) lines.chain(line, false);
  for (const Point p : data.points) dots.dot(p);
  picture.path(lines.data(), line_style(edge, 2));
  picture.path(dots.data(), dot_style(edge, 6));
}

RegionData rounded_data(const PlanarSum& sum) {
  if (!exact_source(sum)) return {};  // nothing was summed
  const planar::NearestPoint nearest(*exact_source(sum));
  const auto ring = [&](const SumRing& from) {
    Ring to;
    for (const SumVertex& v : from.vertices) to.push_back(nearest(v));
    return to;
  };
  RegionData data;
  for (const SumPart& part : sum.parts) {
    data.parts.push_back({ring(part.outer), {}});
    for (const SumRing& hole : part.holes) data.parts.back().holes.push_back(ring(hole));
  }
  for (const SumSegment& segment : sum.segments) data.polylines.push_back({nearest(segment.from), nearest(segment.to)});
  for (const SumVertex& point : sum.points) data.points.push_back(nearest(point));
  return data;
}

RegionData readable_data(const PlanarSum& sum) {
  if (!exact_source(sum)) return {};
  const Result<SnapRounded> snapped = snap_rounded(sum);
  return snapped ? snapped->region.data() : rounded_data(sum);
}

void draw_tight(Picture& picture, const PlanarSum& sum, const Placement& placement) {
  CanvasPath lines(placement), dots(placement);
  for (const SumSegment& segment : sum.tight_segments) lines.segment(segment.from.at, segment.to.at);
  for (const SumVertex& point : sum.tight_points) dots.dot(point.at);
  picture.path(lines.data(), line_style("#fff", 5));
  picture.path(dots.data(), dot_style("#fff", 12));
  picture.path(lines.data(), line_style(palette::kTight, 2.6));
  picture.path(dots.data(), dot_style(palette::kTight, 8));
}

}  // namespace dymsum::io
