#include "nesting/rounded_row.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include "io/region/sum_json.h"
#include "planar/position/exact_source.h"

namespace dymsum::nesting {
namespace {

using exact::BigInteger;

/// n / w where that is a double.
std::optional<double> exact_double(BigInteger n, BigInteger w) {
  if (n.is_zero()) return 0;
  const auto twos = static_cast<int>(lsb(w));
  w >>= twos;
  if (w != 1) {
    if (!BigInteger(n % w).is_zero()) return std::nullopt;
    n /= w;
  }
  const bool negative = n.sign() < 0;
  if (negative) n = -n;
  const auto shift = static_cast<int>(lsb(n));
  const int low = shift - twos, high = static_cast<int>(msb(n)) - twos;
  using Limits = std::numeric_limits<double>;
  if (high - low >= Limits::digits || high >= Limits::max_exponent || low < Limits::min_exponent - Limits::digits)
    return std::nullopt;
  const double value = std::ldexp(static_cast<double>(static_cast<std::uint64_t>(n >> shift)), low);
  return negative ? -value : value;
}

/// A sum whose vertices are all pairs of doubles, as it is: nothing is rounded, so nothing can go wrong.
class ExactData {
 public:
  explicit ExactData(const PlanarSum& sum) : source_(*exact_source(sum)) {
    good_ = take(sum.parts) && take(sum.segments, set_.polylines) && take(sum.points, set_.points) &&
            take(sum.tight_segments, tight_.polylines) && take(sum.tight_points, tight_.points);
  }
  /// The closed set with its tight features, or nothing.
  std::optional<RegionData> data() && {
    if (!good_) return std::nullopt;
    return io::with_tight(std::move(set_), tight_);
  }

 private:
  bool take(const SumVertex& vertex, Point& at) const {
    ExactSource::Homogeneous exact = source_.homogeneous(vertex);
    const std::optional<double> x = exact_double(std::move(exact.x), exact.w);
    const std::optional<double> y = x ? exact_double(std::move(exact.y), std::move(exact.w)) : std::nullopt;
    if (y) at = {*x, *y};
    return y.has_value();
  }
  bool take(const SumRing& ring, Ring& to) const { return take(ring.vertices, to); }
  bool take(const SumSegment& segment, Polyline& to) const {
    to.resize(2);
    return take(segment.from, to[0]) && take(segment.to, to[1]);
  }
  template <class From, class To>
  bool take(const std::vector<From>& from, std::vector<To>& to) const {
    to.reserve(from.size());
    return std::all_of(from.begin(), from.end(), [&](const From& one) { return take(one, to.emplace_back()); });
  }
  bool take(const std::vector<SumPart>& parts) {
    return std::all_of(parts.begin(), parts.end(), [&](const SumPart& part) {
      Part& to = set_.parts.emplace_back();
      return take(part.outer, to.outer) && take(part.holes, to.holes);
    });
  }

  const ExactSource& source_;
  RegionData set_, tight_;
  bool good_ = false;
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
  if (std::optional<RegionData> exact = ExactData(sum).data()) {
    row.data = *std::move(exact);
    return row;
  }
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
  }
  row.data = io::with_tight(rounded->data(), io::tight_data(sum));
  return row;
}

}  // namespace dymsum::nesting
