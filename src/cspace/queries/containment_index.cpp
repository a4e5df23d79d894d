#include "cspace/queries/containment_index.h"

#include <algorithm>
#include <limits>
#include <numbers>

namespace dymsum::cspace {
namespace {

// About a dozen patches begin in a bin.
std::size_t bins_for(std::size_t patches) {
  std::size_t bins = 32;
  while (bins < 1024 && bins * 12 < patches) bins *= 2;
  return bins;
}

struct CellEntry {
  std::uint32_t cell = 0, patch = 0;
  float farthest = 0;
};

}  // namespace

ContainmentIndex::ContainmentIndex(const CspaceObstacle& obstacle, const PatchForms& forms)
    : forms_(forms), bins_(bins_for(obstacle.patches().size())), rows_(64) {
  for (const EventAngle& a : obstacle.angles()) angles_.push_back(a.theta);
  for (const Patch& p : obstacle.patches()) alive_.push_back({p.begin, p.end});
  for (std::size_t bin = 0; bin < bins_; ++bin) {
    const double low = -std::numbers::pi +
                       2 * std::numbers::pi * static_cast<double>(bin) / static_cast<double>(bins_) -
                       forms_.angle_margin();
    const auto first = std::lower_bound(angles_.begin(), angles_.end(), low);
    first_angle_.push_back(static_cast<std::uint32_t>(first - angles_.begin()));
  }
  first_angle_.push_back(static_cast<std::uint32_t>(angles_.size()));
  build(obstacle);
}

std::size_t ContainmentIndex::bin_of(double theta) const {
  const double at = (theta + std::numbers::pi) * (static_cast<double>(bins_) / (2 * std::numbers::pi));
  return at > 0 ? std::min(bins_ - 1, static_cast<std::size_t>(at)) : 0;
}

// Every patch goes to the rows of its box over the angles that it shares with a bin.
void ContainmentIndex::build(const CspaceObstacle& obstacle) {
  const double width = 2 * std::numbers::pi / static_cast<double>(bins_), size = forms_.size(),
               margin = forms_.angle_margin();
  const double per_row = static_cast<double>(rows_) / (2 * size);
  const auto row_of = [&](double y) {
    return static_cast<std::uint32_t>(std::clamp((y + size) * per_row, 0.0, static_cast<double>(rows_) - 1));
  };
  std::vector<CellEntry> found;
  std::vector<PatchPiece> pieces;
  for (std::uint32_t p = 0; p < forms_.forms().size(); ++p) {
    pieces.clear();
    PatchForms::split(obstacle, p, 4 * std::numbers::pi, pieces);
    for (const PatchPiece& piece : pieces)
      for (std::size_t bin = bin_of(piece.low - margin); bin <= bin_of(piece.high + margin); ++bin) {
        const double from = -std::numbers::pi + static_cast<double>(bin) * width;
        const double low = std::max(from, piece.low) - margin;
        const double high = std::min(from + width, piece.high) + margin;
        const PointRange box = forms_.box(forms_[p], (low + high) / 2, std::max(high - low, 0.0) / 2);
        for (std::uint32_t row = row_of(box.y.low); row <= row_of(box.y.high); ++row)
          found.push_back({static_cast<std::uint32_t>(bin * rows_ + row), p,
                           std::nextafter(static_cast<float>(box.x.high), std::numeric_limits<float>::infinity())});
      }
  }
  first_.assign(bins_ * rows_ + 1, 0);
  for (const CellEntry& e : found) ++first_[e.cell + 1];
  for (std::size_t c = 0; c < bins_ * rows_; ++c) first_[c + 1] += first_[c];
  entries_.resize(found.size());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (const CellEntry& e : found) entries_[next[e.cell]++] = {e.patch, e.farthest};
  // The patches farthest to the right first: a question stops at the first one on its left.
  for (std::size_t c = 0; c < bins_ * rows_; ++c)
    std::sort(entries_.begin() + first_[c], entries_.begin() + first_[c + 1], [](const Entry& a, const Entry& b) {
      return a.farthest != b.farthest ? a.farthest > b.farthest : a.patch < b.patch;
    });
}

std::size_t ContainmentIndex::bytes() const {
  return entries_.size() * sizeof(Entry) + first_.size() * 4 + forms_.forms().size() * sizeof(PatchForm);
}

std::optional<std::uint32_t> ContainmentIndex::slab(std::size_t bin, double theta) const {
  if (angles_.empty()) return 0;
  const double margin = forms_.angle_margin();
  const auto first = angles_.begin() + first_angle_[bin], last = angles_.begin() + first_angle_[bin + 1];
  // Bins overlap by the margin; a neighbouring bin's angles may count too.
  auto after = std::upper_bound(first, last, theta);
  while (after != angles_.end() && *after <= theta) ++after;
  const auto near = [&](double angle) { return std::abs(angle - theta) <= margin; };
  const auto before = after == angles_.begin() ? angles_.end() : after;
  if ((after != angles_.end() && near(*after)) || near(*(before - 1))) return std::nullopt;
  if (theta > std::numbers::pi - margin || theta < -std::numbers::pi + margin) return std::nullopt;
  return static_cast<std::uint32_t>(before - angles_.begin()) - 1;
}

bool ContainmentIndex::alive(std::uint32_t patch, std::uint32_t slab) const {
  const auto [begin, end] = alive_[patch];
  if (begin < end) return begin <= slab && slab < end;
  return begin == Patch::kNone || slab >= begin || slab < end;
}

// Whether the ray from q to the right crosses the patch.
std::optional<bool> ContainmentIndex::meets_ray(std::uint32_t patch, const Turn& turn, Point q) const {
  const PatchForm& form = forms_[patch];
  const PlacedEnd a = forms_.end(form, form.left, turn), b = forms_.end(form, form.right, turn);
  const double error = 2 * std::max(a.error, b.error);  // and of q
  const double ya = a.at.y - q.y, yb = b.at.y - q.y;
  if ((ya > error && yb > error) || (ya < -error && yb < -error)) return false;
  if (!(std::abs(ya) > error && std::abs(yb) > error)) return std::nullopt;
  const double xa = a.at.x - q.x, xb = b.at.x - q.x;
  if (xa > error && xb > error) return true;
  if (xa < -error && xb < -error) return false;
  const double area = xa * yb - ya * xb;
  const double bound =
      2 * error * (std::abs(xa) + std::abs(xb) + std::abs(ya) + std::abs(yb) + error) + exact::kUnderflow;
  if (!(std::abs(area) > bound)) return std::nullopt;
  return (area > 0) == (yb > ya);
}

std::optional<bool> ContainmentIndex::contains(double x, double y, double theta) const {
  const Point q = forms_.relative({x, y});
  const double size = forms_.size() * exact::kOutwards;
  if (!(std::abs(q.x) <= size && std::abs(q.y) <= size)) return false;
  const std::size_t bin = bin_of(theta);
  const std::optional<std::uint32_t> at = slab(bin, theta);
  if (!at) return std::nullopt;
  const Turn turn(theta);
  const double row = std::clamp((q.y + forms_.size()) * (static_cast<double>(rows_) / (2 * forms_.size())), 0.0,
                                static_cast<double>(rows_) - 1);
  const std::size_t cell = bin * rows_ + static_cast<std::size_t>(row);
  bool inside = false;
  for (std::uint32_t k = first_[cell]; k < first_[cell + 1] && entries_[k].farthest >= q.x; ++k) {
    if (!alive(entries_[k].patch, *at)) continue;
    const std::optional<bool> meets = meets_ray(entries_[k].patch, turn, q);
    if (!meets) return std::nullopt;
    inside ^= *meets;
  }
  return inside;
}

}  // namespace dymsum::cspace
