#include "pictures/depth_trace.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <sstream>

#include "dymsum/names.h"
#include "json_report.h"
#include "pictures/svg_paths.h"

namespace dymsum::cli {
namespace {

constexpr double kLeft = 70, kWidth = 900, kRight = 30;

std::string tenths(double v) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.2f", v);
  return text.data();
}

/// A rectangle of the plot that shows numbers from `low` to `high` over the rows.
struct TracePanel {
  double top, height, low, high;
  std::size_t rows;

  double x(std::size_t k) const {
    return kLeft + (rows < 2 ? 0.5 : static_cast<double>(k) / static_cast<double>(rows - 1)) * kWidth;
  }
  double y(double v) const { return top + height * (high - v) / (high - low); }
};

/// Round numbers about a fifth of the range apart.
double tick_of(double range) {
  const double rough = range / 5, power = std::pow(10, std::floor(std::log10(rough)));
  const double fraction = rough / power;
  return power * (fraction < 1.5 ? 1 : fraction < 3.5 ? 2 : fraction < 7.5 ? 5 : 10);
}

void draw_axes(std::ostringstream& out, const TracePanel& panel, const std::string& name) {
  const double tick = tick_of(panel.high - panel.low);
  for (double v = std::ceil(panel.low / tick) * tick; v <= panel.high + 1e-9 * tick; v += tick) {
    const std::string y = tenths(panel.y(v));
    const double shown = std::abs(v) < 1e-9 * tick ? 0 : v;
    out << "<path d='M" << kLeft << " " << y << "h" << kWidth << "' stroke='#e4e4e4'/><text x='" << kLeft - 8 << "' y='"
        << y << "' dy='4' text-anchor='end'>" << shown << "</text>\n";
  }
  out << "<text x='" << kLeft << "' y='" << panel.top - 8 << "' font-weight='bold'>" << name << "</text>\n<rect x='"
      << kLeft << "' y='" << panel.top << "' width='" << kWidth << "' height='" << panel.height
      << "' fill='none' stroke='#999'/>\n";
}

using RowValue = std::function<double(const DepthRow&)>;
using RowTest = std::function<bool(const DepthRow&)>;

/// A line through the rows that overlap, interrupted where `breaks` says so.
void draw_line(std::ostringstream& out, const TracePanel& panel, const std::vector<DepthRow>& rows,
               const RowValue& value, const RowTest& breaks, const std::string& style) {
  std::string path;
  bool inside = false;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const bool overlapping = rows[k].contact.meeting == Meeting::overlapping;
    if (overlapping)
      path += (inside && !breaks(rows[k]) ? "L" : "M") + tenths(panel.x(k)) + " " + tenths(panel.y(value(rows[k])));
    inside = overlapping;
  }
  if (!path.empty()) out << "<path d='" << path << "' fill='none' " << style << "/>\n";
}

void draw_jumps(std::ostringstream& out, const TracePanel& panel, const std::vector<DepthRow>& rows) {
  const auto draw = [&](std::size_t k, const char* style, const std::string& title) {
    out << "<path d='M" << tenths(panel.x(k)) << " " << panel.top << "v" << panel.height << "' " << style << "><title>"
        << title << "</title></path>\n";
  };
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (rows[k].exact_jumps)
      draw(k, "stroke='#8c8c8c' stroke-dasharray='2 3'", "row " + std::to_string(k) + ": the shortest way out jumps");
    if (jumps(rows[k]))
      draw(k, "stroke='#d81e3a' stroke-width='1.5'",
           "row " + std::to_string(k) + ": " + std::string(name(rows[k].contact.discontinuity)));
  }
}

constexpr std::array<const char*, 3> kAxisColours = {"#0072b2", "#009e73", "#e69f00"};

double coordinate(const Point3& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

void draw_depths(std::ostringstream& out, const std::vector<DepthRow>& rows, double top) {
  double most = 0;
  for (const DepthRow& row : rows) most = std::max(most, row.contact.depth);
  const TracePanel panel{top, 240, 0, most > 0 ? 1.05 * most : 1, rows.size()};
  draw_axes(out, panel, "depth");
  draw_jumps(out, panel, rows);
  draw_line(
      out, panel, rows, [](const DepthRow& r) { return r.contact.euclidean_depth; },
      [](const DepthRow&) { return false; }, "stroke='#888' stroke-width='1.5' stroke-dasharray='5 3'");
  draw_line(
      out, panel, rows, [](const DepthRow& r) { return r.contact.depth; }, jumps, "stroke='#0072b2' stroke-width='2'");
}

void draw_directions(std::ostringstream& out, const std::vector<DepthRow>& rows, double top, bool exact) {
  const TracePanel panel{top, 150, -1.05, 1.05, rows.size()};
  draw_axes(out, panel, exact ? "direction of the shortest way out: x, y, z" : "direction, continuous: x, y, z");
  draw_jumps(out, panel, rows);
  for (int axis = 0; axis < 3; ++axis)
    draw_line(
        out, panel, rows,
        [&](const DepthRow& r) { return coordinate(exact ? r.contact.euclidean_normal : r.contact.normal, axis); },
        [&](const DepthRow& r) { return exact ? r.exact_jumps : jumps(r); },
        std::string("stroke='") + kAxisColours[static_cast<std::size_t>(axis)] + "' stroke-width='1.5'");
}

void draw_legend(std::ostringstream& out, double y) {
  double x = kLeft;
  const auto entry = [&](const std::string& style, const std::string& text) {
    out << "<path d='M" << x << " " << y << "h26' fill='none' " << style << "/><text x='" << x + 32 << "' y='" << y + 4
        << "'>" << text << "</text>\n";
    x += 52 + 7 * static_cast<double>(text.size());
  };
  entry("stroke='#0072b2' stroke-width='2'", "continuous depth");
  entry("stroke='#888' stroke-width='1.5' stroke-dasharray='5 3'", "exact depth");
  entry("stroke='#d81e3a' stroke-width='1.5'", "jump");
  entry("stroke='#8c8c8c' stroke-dasharray='2 3'", "jump of the exact direction");
  for (std::size_t k = 0; k < 3; ++k)
    entry(std::string("stroke='") + kAxisColours[k] + "' stroke-width='1.5'", std::string(1, "xyz"[k]));
}

}  // namespace

bool jumps(const DepthRow& row) {
  const Discontinuity why = row.contact.discontinuity;
  return why != Discontinuity::none && why != Discontinuity::entered;
}

std::string depth_csv(const std::vector<DepthRow>& rows) {
  std::string out =
      "x,y,z,qw,qx,qy,qz,meeting,exact_depth,depth,exact_nx,exact_ny,exact_nz,nx,ny,nz,px,py,pz,wx,wy,wz,branch,"
      "discontinuity,exact_jumps\n";
  const auto number = [&](double v) { out += Json(v).dump() + ","; };
  const auto vector = [&](const Point3& v) { number(v.x), number(v.y), number(v.z); };
  for (const DepthRow& row : rows) {
    const ContinuousContact& c = row.contact;
    vector(row.at);
    for (const std::int64_t q : row.turned.quaternion()) out += std::to_string(q) + ",";
    out += std::string(name(c.meeting)) + ",";
    number(c.euclidean_depth), number(c.depth);
    for (const Point3& v : {c.euclidean_normal, c.normal, c.witness_p, c.witness_q}) vector(v);
    out += std::to_string(c.branch) + "," + std::string(name(c.discontinuity)) + (row.exact_jumps ? ",1\n" : ",0\n");
  }
  return out;
}

std::string depth_svg(const std::vector<DepthRow>& rows, const std::string& title) {
  std::ostringstream out;
  out << "<svg xmlns='http://www.w3.org/2000/svg' width='" << kLeft + kWidth + kRight
      << "' height='760' font-family='sans-serif' font-size='13'>\n<rect width='100%' height='100%' fill='white'/>\n"
      << "<text x='" << kLeft << "' y='24' font-size='16'>" << escaped(title) << "</text>\n";
  draw_legend(out, 48);
  draw_depths(out, rows, 90);
  draw_directions(out, rows, 370, false);
  draw_directions(out, rows, 560, true);
  out << "<text x='" << kLeft << "' y='735'>row 0</text><text x='" << kLeft + kWidth
      << "' y='735' text-anchor='end'>row " << (rows.empty() ? 0 : rows.size() - 1) << "</text>\n</svg>\n";
  return out.str();
}

}  // namespace dymsum::cli
