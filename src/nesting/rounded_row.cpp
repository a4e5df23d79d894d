#include "nesting/rounded_row.h"

#include <cmath>
#include <optional>
#include <utility>

#include "io/region/tight_data.h"
#include "planar/position/exact_source.h"
#include "planar/position/nearest_point.h"

namespace dymsum::nesting {
namespace {

using exact::BigInteger;

/// n / w is the double `value`.
bool is_exactly(const BigInteger& n, const BigInteger& w, double value) {
  if (!std::isfinite(value)) return false;
  constexpr int kDigits = 53;
  int exponent = 0;
  const BigInteger digits = static_cast<std::int64_t>(std::ldexp(std::frexp(value, &exponent), kDigits));
  exponent -= kDigits;
  const auto shift = static_cast<unsigned>(std::abs(exponent));
  if (exponent >= 0) return BigInteger(digits << shift) * w == n;
  return digits * w == BigInteger(n << shift);
}

/// Whether vertices are pairs of doubles.
class ExactVertices {
 public:
  explicit ExactVertices(const ExactSource& source) : source_(source), nearest_(source) {}

  bool operator()(const SumVertex& vertex) const {
    const ExactSource::Homogeneous exact = source_.homogeneous(vertex);
    const Point at = nearest_(vertex);
    return is_exactly(exact.x, exact.w, at.x) && is_exactly(exact.y, exact.w, at.y);
  }
  bool operator()(const SumSegment& segment) const { return (*this)(segment.from) && (*this)(segment.to); }
  bool operator()(const SumRing& ring) const { return (*this)(ring.vertices); }
  bool operator()(const SumPart& part) const { return (*this)(part.outer) && (*this)(part.holes); }
  template <class T>
  bool operator()(const std::vector<T>& items) const {
    for (const T& item : items)
      if (!(*this)(item)) return false;
    return true;
  }
  bool operator()(const PlanarSum& sum) const {
    return (*this)(sum.parts) && (*this)(sum.segments) && (*this)(sum.points) && (*this)(sum.tight_segments) &&
           (*this)(sum.tight_points);
  }

 private:
  const ExactSource& source_;
  planar::NearestPoint nearest_;
};

bool is_empty(const PlanarSum& sum) {
  return sum.parts.empty() && sum.segments.empty() && sum.points.empty() && sum.tight_segments.empty() &&
         sum.tight_points.empty();
}

}  // namespace

RoundedRow rounded_row(const PlanarSum& sum) {
  RoundedRow row;
  TableAnswer& answer = row.answer;
  answer.vertices = sum.vertex_count();
  answer.holes = sum.hole_count();
  answer.tight_segments = sum.tight_segments.size();
  answer.tight_points = sum.tight_points.size();
  if (is_empty(sum)) return row;
  answer.rounding = TableAnswer::Rounding::nearest;
  Result<Region> rounded = sum.rounded();
  if (!rounded) {
    Result<Repaired> repaired = sum.rounded_with_repair();
    if (!repaired) {
      answer = {};
      answer.status = TableAnswer::Status::refused;
      answer.error = Error{repaired.error().code, repaired.error().to_string(), {}};
      return row;
    }
    answer.rounding = TableAnswer::Rounding::repaired;
    rounded = std::move(repaired).value().region;
  } else if (ExactVertices(*exact_source(sum))(sum)) {
    answer.rounding = TableAnswer::Rounding::none;
  }
  row.data = io::closed_data(sum, *rounded);
  return row;
}

}  // namespace dymsum::nesting
