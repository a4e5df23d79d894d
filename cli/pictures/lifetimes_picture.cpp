#include "pictures/lifetimes_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <sstream>

#include "pictures/svg_paths.h"
#include "planar/family_answers.h"
#include "report.h"

namespace dymsum::cli {
namespace {

constexpr double kLivesLeft = 80, kLivesWidth = 880, kLivesRight = 30;
constexpr double kTicksTop = 70, kTicksHeight = 24, kCountTop = 124, kCountHeight = 150, kHolesTop = 310;

/// Scales from `low` to `high` along the picture.
struct ScaleAxis {
  double low, high;
  double x(double s) const {
    const double range = std::log(high / low);
    return kLivesLeft + kLivesWidth * (range > 0 ? std::clamp(std::log(s / low) / range, 0.0, 1.0) : 0.5);
  }
};

ScaleAxis axis_of(const ScalingFamily& family) { return {family.low().approx(), family.high().approx()}; }

/// 1, 2, 5, 10 and so on; of many decades powers of ten alone, of very many not all.
std::vector<double> digits_of_decades(const ScaleAxis& axis) {
  constexpr int kMostDecades = 6, kMostPowers = 14;
  std::vector<double> scales;
  const int least = static_cast<int>(std::floor(std::log10(axis.low)));
  const int most = static_cast<int>(std::ceil(std::log10(axis.high)));
  const int every = 1 + (most - least) / kMostPowers;
  for (int power = least; power <= most; ++power)
    for (const double digit : {1.0, 2.0, 5.0})
      if (digit == 1 ? power % every == 0 : most - least <= kMostDecades)
        scales.push_back(digit * std::pow(10.0, power));
  return scales;
}

/// Multiples of a round number, not more than eight.
std::vector<double> multiples_in(const ScaleAxis& axis) {
  const double range = axis.high - axis.low;
  if (!(range > 0)) return {axis.low};
  double step = std::pow(10.0, std::floor(std::log10(range)) - 1);
  for (int k = 0; range / step > 8; ++k) step *= k % 3 == 1 ? 2.5 : 2;
  std::vector<double> scales;
  for (double n = std::ceil(axis.low / step); n * step <= axis.high; ++n) scales.push_back(n * step);
  return scales;
}

/// Round scales of the interval.
std::vector<double> labelled_scales(const ScaleAxis& axis) {
  constexpr double kFewDecades = 8;
  std::vector<double> scales = axis.high / axis.low < kFewDecades ? multiples_in(axis) : digits_of_decades(axis);
  std::erase_if(scales, [&](double s) { return s < axis.low || s > axis.high; });
  return scales;
}

std::string short_number(double v) {
  std::ostringstream text;
  text.precision(4);
  text << v;
  return text.str();
}

void draw_scales(std::ostringstream& svg, const ScaleAxis& axis, double bottom) {
  for (const double s : labelled_scales(axis))
    svg << "<path d='M" << number(axis.x(s)) << " " << kTicksTop << "V" << number(bottom)
        << "' stroke='#e4e4e4'/><text x='" << number(axis.x(s)) << "' y='" << number(bottom + 18)
        << "' text-anchor='middle'>" << short_number(s) << "</text>\n";
  svg << "<text x='" << kLivesLeft + kLivesWidth / 2 << "' y='" << number(bottom + 38)
      << "' text-anchor='middle'>scale s</text>\n";
}

void draw_events(std::ostringstream& svg, const ScalingFamily& family, const ScaleAxis& axis, double bottom) {
  svg << "<text x='" << kLivesLeft - 10 << "' y='" << kTicksTop + 16 << "' text-anchor='end'>events</text>\n";
  for (const ScaleEvent& e : family.events()) {
    if (!e.visible) continue;
    svg << "<path d='M" << number(axis.x(e.approx)) << " " << kTicksTop;
    if (e.topology) svg << "V" << number(bottom) << "' stroke='" << kTightColour << "'";
    else svg << "v" << kTicksHeight << "' stroke='#555' stroke-opacity='0.6'";
    svg << "><title>s = " << escaped(shown(e.parameter)) << (e.topology ? ", the topology changes" : "")
        << "</title></path>\n";
  }
}

/// The number of vertices in every cell.
std::vector<std::size_t> vertex_counts(const ScalingFamily& family, const std::vector<Lifetime>& lifetimes) {
  std::vector<std::size_t> counts(family.work().cells, 0);
  for (const Lifetime& life : lifetimes)
    if (life.feature == FamilyFeature::vertex)
      for (std::uint32_t cell = life.first_cell; cell <= life.last_cell; ++cell) ++counts[cell];
  return counts;
}

void draw_counts(std::ostringstream& svg, const ScalingFamily& family, const std::vector<Lifetime>& lifetimes,
                 const ScaleAxis& axis) {
  const std::vector<std::size_t> counts = vertex_counts(family, lifetimes);
  const std::size_t most = std::max<std::size_t>(1, *std::max_element(counts.begin(), counts.end()));
  const double bottom = kCountTop + kCountHeight;
  svg << "<path d='M" << number(kLivesLeft) << " " << number(bottom);
  for (std::uint32_t cell = 0; cell < counts.size(); ++cell)
    svg << "V" << number(bottom - kCountHeight * static_cast<double>(counts[cell]) / static_cast<double>(most)) << "H"
        << number(cell + 1 == counts.size() ? kLivesLeft + kLivesWidth : axis.x(end_of_cell(family, cell).to_double()));
  svg << "V" << number(bottom) << "Z' fill='#cfe3f3' stroke='#0072b2'/>\n<text x='" << kLivesLeft - 10 << "' y='"
      << kCountTop + 5 << "' text-anchor='end'>" << most << "</text><text x='" << kLivesLeft - 10 << "' y='" << bottom
      << "' text-anchor='end'>0</text><text x='" << kLivesLeft - 10 << "' y='" << kCountTop + kCountHeight / 2
      << "' text-anchor='end'>vertices</text>\n";
}

/// The rows of holes, in the order in which they come.
std::map<std::uint64_t, std::size_t> rows_of(const std::vector<Lifetime>& lifetimes) {
  std::map<std::uint64_t, std::size_t> rows;
  for (const Lifetime& life : lifetimes)
    if (life.feature == FamilyFeature::hole) rows.try_emplace(life.hole, rows.size());
  return rows;
}

double row_height(std::size_t rows) { return std::clamp(900.0 / static_cast<double>(rows + 1), 3.0, 18.0); }

void draw_holes(std::ostringstream& svg, const ScalingFamily& family, const std::vector<Lifetime>& lifetimes,
                const ScaleAxis& axis) {
  const std::map<std::uint64_t, std::size_t> rows = rows_of(lifetimes);
  const double height = row_height(rows.size());
  svg << "<text x='" << kLivesLeft - 10 << "' y='" << kHolesTop - 8 << "' text-anchor='end'>"
      << (rows.empty() ? "no hole" : "holes") << "</text>\n";
  for (const Lifetime& life : lifetimes) {
    if (life.feature != FamilyFeature::hole) continue;
    const Rational from = begin_of_cell(family, life.first_cell), to = end_of_cell(family, life.last_cell);
    const double x = axis.x(from.to_double()), y = kHolesTop + height * static_cast<double>(rows.at(life.hole));
    svg << "<rect x='" << number(x) << "' y='" << number(y + 0.1 * height) << "' width='"
        << number(std::max(2.0, axis.x(to.to_double()) - x)) << "' height='" << number(0.8 * height)
        << "' fill='#009e73'><title>hole " << life.hole << ": " << escaped(shown(from)) << " to " << escaped(shown(to))
        << "</title></rect>\n";
  }
  if (height < 10) return;
  for (const auto& [hole, row] : rows)
    svg << "<text x='" << kLivesLeft - 10 << "' y='" << number(kHolesTop + height * (static_cast<double>(row) + 0.8))
        << "' text-anchor='end'>" << hole << "</text>\n";
}

void draw_lives_legend(std::ostringstream& svg) {
  svg << "<g transform='translate(" << kLivesLeft
      << ",44)'><path d='M0 -4v-10' stroke='#555'/><text x='8' y='-4'>visible event</text><path d='M120 -4v-10' "
         "stroke='"
      << kTightColour
      << "'/><text x='128' y='-4'>the topology changes</text><rect x='290' y='-13' width='18' height='9' "
      << "fill='#cfe3f3' stroke='#0072b2'/><text x='314' y='-4'>vertices of the sum</text><rect x='460' y='-13' "
      << "width='18' height='9' fill='#009e73'/><text x='484' y='-4'>lifetime of a hole</text></g>\n";
}

}  // namespace

std::string lifetimes_picture(const ScalingFamily& family, const std::vector<Lifetime>& lifetimes,
                              const std::string& title) {
  const ScaleAxis axis = axis_of(family);
  const std::size_t rows = rows_of(lifetimes).size();
  const double bottom =
      rows == 0 ? kCountTop + kCountHeight : kHolesTop + row_height(rows) * static_cast<double>(rows) + 6;
  const double foot = std::max(bottom, kHolesTop);
  std::ostringstream svg;
  svg << "<svg xmlns='http://www.w3.org/2000/svg' width='" << kLivesLeft + kLivesWidth + kLivesRight << "' height='"
      << number(foot + 54) << "' font-family='sans-serif' font-size='12'>\n<rect width='100%' height='100%' "
      << "fill='white'/>\n<text x='" << kLivesLeft << "' y='22' font-size='15'>" << escaped(title) << "</text>\n";
  draw_lives_legend(svg);
  draw_scales(svg, axis, foot);
  draw_counts(svg, family, lifetimes, axis);
  draw_events(svg, family, axis, foot);
  draw_holes(svg, family, lifetimes, axis);
  svg << "<path d='M" << kLivesLeft << " " << number(foot) << "h" << kLivesWidth << "' stroke='#999'/>\n</svg>\n";
  return svg.str();
}

}  // namespace dymsum::cli
