#include "versus/clipper.h"

#include <polyclipping/clipper.hpp>

#ifdef DYMSUM_CLIPPER2
#include <clipper2/clipper.engine.h>
#include <clipper2/clipper.minkowski.h>
#endif

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

struct Six {
  using Path = ClipperLib::Path;
  using Paths = ClipperLib::Paths;
  static ClipperLib::IntPoint point(std::int64_t x, std::int64_t y) { return {x, y}; }
  static Path moved(Path path, ClipperLib::IntPoint by) {
    for (ClipperLib::IntPoint& p : path) p.X += by.X, p.Y += by.Y;
    return path;
  }
  static Paths sum(const Path& pattern, const Path& path) {
    Paths swept, sum;
    ClipperLib::MinkowskiSum(pattern, path, swept, true);
    ClipperLib::Clipper join;
    join.AddPaths(swept, ClipperLib::ptSubject, true);
    join.AddPath(moved(path, pattern[0]), ClipperLib::ptSubject, true);
    join.AddPath(moved(pattern, path[0]), ClipperLib::ptSubject, true);
    join.Execute(ClipperLib::ctUnion, sum, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
    return sum;
  }
  static double area(const Path& ring) { return ClipperLib::Area(ring); }
};

#ifdef DYMSUM_CLIPPER2
struct Two {
  using Path = Clipper2Lib::Path64;
  using Paths = Clipper2Lib::Paths64;
  static Clipper2Lib::Point64 point(std::int64_t x, std::int64_t y) { return {x, y}; }
  static Path moved(Path path, Clipper2Lib::Point64 by) {
    for (Clipper2Lib::Point64& p : path) p = p + by;
    return path;
  }
  static Paths sum(const Path& pattern, const Path& path) {
    Paths all = Clipper2Lib::MinkowskiSum(pattern, path, true), sum;
    all.push_back(moved(path, pattern[0]));
    all.push_back(moved(pattern, path[0]));
    Clipper2Lib::Clipper64 join;
    join.AddSubject(all);
    join.Execute(Clipper2Lib::ClipType::Union, Clipper2Lib::FillRule::NonZero, sum);
    return sum;
  }
  static double area(const Path& ring) { return Clipper2Lib::Area(ring); }
};
#endif

template <class Version>
typename Version::Path path(const RegionData& region, int exponent) {
  typename Version::Path result;
  for (const Point& p : region.parts.at(0).outer)
    result.push_back(Version::point(std::llround(std::ldexp(p.x, exponent)), std::llround(std::ldexp(p.y, exponent))));
  return result;
}

template <class Version>
RivalAnswer answer_of(const RegionData& p, const RegionData& q, const Repeats& repeats) {
  RivalAnswer answer;
  int exponent = 0;
  std::frexp(std::max(largest(p), largest(q)), &exponent);
  exponent = kBits - exponent;
  const typename Version::Path a = path<Version>(p, exponent), b = path<Version>(q, exponent);
  typename Version::Paths last;
  const Times times = measure(
      repeats, [&] { return Version::sum(a, b); }, [&](typename Version::Paths&& sum) { last = std::move(sum); });
  answer.median_ms = times.median();
  answer.min_ms = times.min();
  answer.runs = static_cast<int>(times.ms.size());
  for (const auto& ring : last) {
    const double area = Version::area(ring);
    answer.area += area;
    (area >= 0 ? answer.outer : answer.holes) += 1;
    answer.vertices += ring.size();
  }
  answer.area = std::ldexp(answer.area, -2 * exponent);
  answer.finished = true;
  return answer;
}

RivalAnswer failed(const std::string& why) {
  RivalAnswer answer;
  answer.why_not = why;
  return answer;
}

RivalAnswer query(Clipper which, const RegionData& p, const RegionData& q, const Repeats& repeats) {
  if (!p.parts.at(0).holes.empty() || !q.parts.at(0).holes.empty()) return failed("cannot take holes");
  try {
    if (which == Clipper::six) return answer_of<Six>(p, q, repeats);
#ifdef DYMSUM_CLIPPER2
    return answer_of<Two>(p, q, repeats);
#else
    return failed("not built");
#endif
  } catch (const std::exception& problem) {
    return failed(std::string("threw: ") + problem.what());
  }
}

}  // namespace

RivalAnswer clipper_sum_in_child(Clipper which, const RegionData& p, const RegionData& q, const Repeats& repeats,
                                 double limit_s) {
  return in_child([&] { return query(which, p, q, repeats); }, limit_s);
}

}  // namespace dymsum::bench
