// An answer that knows nothing of scaling: at s = a / b the static engine's sum of the integer regions a P and b Q is b
// times the sum.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "dymsum/scaling_sum.h"
#include "exact/big.h"
#include "oracles/vertices_by.h"

namespace dymsum::scaling_tests {

/// The region with coordinates multiplied; exact for small integers.
inline Region multiplied(const Region& region, double fx, double fy) {
  Result<Region> result = Region::create(oracles::vertices_by(region.data(), [&](Point p) {
    return Point{p.x * fx, p.y * fy};
  }));
  if (!result.ok()) throw std::logic_error(result.error().to_string());
  return std::move(result).value();
}

/// Rings, pieces and tight features by exact positions times a factor.
inline std::vector<std::string> described(const PlanarSum& sum, const exact::BigRational& factor) {
  std::vector<std::string> text;
  const auto at = [&](const SumVertex& v) {
    const RationalPoint p = sum.exact(v);
    return exact::to_rational(exact::exact_value(p.x) * factor).to_string() + "," +
           exact::to_rational(exact::exact_value(p.y) * factor).to_string();
  };
  const auto ring = [&](const char* kind, const SumRing& r) {
    std::string line = kind;
    for (const SumVertex& v : r.vertices) line += " " + at(v);
    text.push_back(line);
  };
  for (const SumPart& part : sum.parts) {
    ring("outer", part.outer);
    for (const SumRing& hole : part.holes) ring("hole", hole);
  }
  const auto segments = [&](const char* kind, const std::vector<SumSegment>& list) {
    for (const SumSegment& s : list) text.push_back(kind + at(s.from) + " " + at(s.to));
  };
  const auto points = [&](const char* kind, const std::vector<SumVertex>& list) {
    for (const SumVertex& v : list) text.push_back(kind + at(v));
  };
  segments("segment ", sum.segments);
  points("point ", sum.points);
  segments("tight segment ", sum.tight_segments);
  points("tight point ", sum.tight_points);
  return text;
}

/// P (+) Q at scale a / b of P (of Q with `q_scales`), by the static engine on integers.
inline std::vector<std::string> static_answer(const Region& p, const Region& q, double a, double b, bool q_scales,
                                              Semantics semantics) {
  SumOptions options;
  options.semantics = semantics;
  const double fp = q_scales ? b : a, fq = q_scales ? a : b;
  const Result<PlanarSum> sum = minkowski_sum(multiplied(p, fp, fp), multiplied(q, fq, fq), options);
  return described(*sum, exact::BigRational(1));
}

/// Coordinates rounded to integers from 0 to size.
inline Region on_integers(const Region& region, double size) {
  const auto box = bounds(region);
  const double f = size / std::max(box[2] - box[0], box[3] - box[1]);
  RegionData data = region.data();
  const auto all = [&](std::vector<Point>& list) {
    for (Point& p : list) p = {std::round((p.x - box[0]) * f), std::round((p.y - box[1]) * f)};
  };
  for (Part& part : data.parts) {
    all(part.outer);
    for (Ring& hole : part.holes) all(hole);
  }
  return Region::create(std::move(data)).value();
}

inline Scale scale_of(long a, long b) { return Scale::of(*Rational::of(a, b)).value(); }

}  // namespace dymsum::scaling_tests
