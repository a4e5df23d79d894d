#include "versus/clipper.h"

#include <polyclipping/clipper.hpp>

#include <algorithm>
#include <cmath>
#include <exception>

#include "versus/child.h"

namespace dymsum::bench {
namespace {

/// Sums stay below 2^30, where Clipper compares in 64 bits; beyond it is slower.
constexpr int kBits = 28;

double largest(const RegionData& region) {
  double size = 0;
  for (const Point& p : region.parts.at(0).outer) size = std::max({size, std::fabs(p.x), std::fabs(p.y)});
  return size;
}

ClipperLib::Path path(const RegionData& region, int exponent) {
  ClipperLib::Path result;
  for (const Point& p : region.parts.at(0).outer) {
    result.push_back({std::llround(std::ldexp(p.x, exponent)), std::llround(std::ldexp(p.y, exponent))});
  }
  return result;
}

ClipperLib::Path moved(ClipperLib::Path path, ClipperLib::IntPoint by) {
  for (ClipperLib::IntPoint& p : path) {
    p.X += by.X;
    p.Y += by.Y;
  }
  return path;
}

ClipperLib::Paths compute(const ClipperLib::Path& pattern, const ClipperLib::Path& path) {
  ClipperLib::Paths swept;
  ClipperLib::MinkowskiSum(pattern, path, swept, true);
  ClipperLib::Clipper join;
  join.AddPaths(swept, ClipperLib::ptSubject, true);
  join.AddPath(moved(path, pattern[0]), ClipperLib::ptSubject, true);
  join.AddPath(moved(pattern, path[0]), ClipperLib::ptSubject, true);
  ClipperLib::Paths sum;
  join.Execute(ClipperLib::ctUnion, sum, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
  return sum;
}

}  // namespace

struct ClipperOperands::Paths {
  ClipperLib::Path p, q;
  int exponent = 0;
  bool has_holes = false;
};

ClipperOperands::ClipperOperands(const RegionData& p, const RegionData& q) : paths_(new Paths) {
  int exponent = 0;
  std::frexp(std::max(largest(p), largest(q)), &exponent);
  paths_->exponent = kBits - exponent;
  paths_->p = path(p, paths_->exponent);
  paths_->q = path(q, paths_->exponent);
  paths_->has_holes = !p.parts.at(0).holes.empty() || !q.parts.at(0).holes.empty();
}
ClipperOperands::~ClipperOperands() = default;

RivalAnswer ClipperOperands::sum(const Repeats& repeats) const {
  RivalAnswer answer;
  if (paths_->has_holes) {
    answer.why_not = "cannot take holes";
    return answer;
  }
  try {
    ClipperLib::Paths last;
    const Times times = measure(
        repeats, [&] { return compute(paths_->p, paths_->q); },
        [&](ClipperLib::Paths&& sum) { last = std::move(sum); });
    answer.median_ms = times.median();
    answer.min_ms = times.min();
    answer.runs = static_cast<int>(times.ms.size());
    for (const ClipperLib::Path& ring : last) {
      answer.area += ClipperLib::Area(ring);
      (ClipperLib::Orientation(ring) ? answer.outer : answer.holes) += 1;
      answer.vertices += ring.size();
    }
    answer.area = std::ldexp(answer.area, -2 * paths_->exponent);
    answer.finished = true;
  } catch (const std::exception& problem) {
    answer = RivalAnswer{};
    answer.why_not = std::string("threw: ") + problem.what();
  }
  return answer;
}

RivalAnswer ClipperOperands::sum_in_child(const Repeats& repeats, double limit_s) const {
  return in_child([&] { return sum(repeats); }, limit_s);
}

}  // namespace dymsum::bench
