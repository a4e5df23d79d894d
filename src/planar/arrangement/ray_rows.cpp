#include "planar/arrangement/ray_rows.h"

namespace dymsum::planar {
namespace {

constexpr double kListed = 8;  // times as many entries as segments, about
constexpr double kMostRows = 1 << 16;

}  // namespace

RayRows::RayRows(const Soup& soup) : soup_(soup) {
  margin_ = 2 * soup.point_error + kSumHeight * soup.lattice.span;
  double high = 0, heights = 0;
  if (soup.size() > 0) low_ = high = soup.boxes[0].ay;
  for (const SoupBox& b : soup.boxes) {
    low_ = std::min({low_, b.ay, b.by});
    high = std::max({high, b.ay, b.by});
    heights += std::abs(b.dy);
  }
  const auto n = static_cast<double>(soup.size());
  const double most = heights > 0 ? (kListed - 1) * n * ((high - low_) / heights) : 1;
  const double rows = std::floor(std::clamp(std::min(most, n), 1.0, kMostRows));
  last_ = rows - 1;
  const double per_row = high > low_ ? rows / (high - low_) : 0;
  per_row_ = std::isfinite(per_row) ? per_row : 0;
  const auto each_row = [&](const SoupBox& b, auto&& f) {
    const std::size_t last = row(std::max(b.ay, b.by) + margin_);
    for (std::size_t r = row(std::min(b.ay, b.by) - margin_); r <= last; ++r) f(r);
  };
  first_.assign(static_cast<std::size_t>(rows) + 1, 0);
  for (const SoupBox& b : soup.boxes) each_row(b, [&](std::size_t r) { ++first_[r + 1]; });
  for (std::size_t r = 0; r + 1 < first_.size(); ++r) first_[r + 1] += first_[r];
  listed_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::uint32_t s = 0; s < soup.size(); ++s)
    each_row(soup.boxes[s], [&](std::size_t r) { listed_[next[r]++] = s; });
}

}  // namespace dymsum::planar
