#include "nesting/rounded_row.h"

#include <limits>
#include <utility>

#include "io/region/tight_data.h"
#include "planar/position/exact_source.h"

namespace dymsum::nesting {
namespace {

using exact::BigInteger;

/// Whether n / w is a double.
bool is_double(BigInteger n, BigInteger w) {
  if (n.is_zero()) return true;
  const auto twos = static_cast<int>(lsb(w));
  w >>= twos;
  if (w != 1) {
    if (!BigInteger(n % w).is_zero()) return false;
    n /= w;
  }
  n = abs(n);
  const int low = static_cast<int>(lsb(n)) - twos, high = static_cast<int>(msb(n)) - twos;
  using Limits = std::numeric_limits<double>;
  return high - low < Limits::digits && high < Limits::max_exponent && low >= Limits::min_exponent - Limits::digits;
}

/// Whether vertices are pairs of doubles.
class ExactVertices {
 public:
  explicit ExactVertices(const ExactSource& source) : source_(source) {}

  bool operator()(const SumVertex& vertex) const {
    ExactSource::Homogeneous exact = source_.homogeneous(vertex);
    return is_double(std::move(exact.x), exact.w) && is_double(std::move(exact.y), std::move(exact.w));
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
