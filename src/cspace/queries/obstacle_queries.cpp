#include "dymsum/obstacle_queries.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <vector>

#include "base/doubles.h"
#include "base/parallel.h"
#include "cspace/queries/clearance_search.h"
#include "cspace/queries/free_angles.h"
#include "cspace/queries/patch_forms.h"

namespace dymsum::cspace {
namespace {

// The containment of configurations, by counting the patches that a ray meets.

/// Angles are cut into bins, positions in every bin into rows; each cell lists the patches that pass through it. Relies
/// on this: between event angles every position without freedom lies on a patch.
class ContainmentIndex {
 public:
  ContainmentIndex(const CspaceObstacle& obstacle, const PatchForms& forms);

  /// Whether the configuration lies in the obstacle; nothing where doubles do not prove it: on the boundary, near it,
  /// or near an event angle. `theta` in [-pi, pi] is within 2^-49 of the exact angle.
  std::optional<bool> contains(double x, double y, double theta) const;

  std::size_t bytes() const;

 private:
  struct Entry {
    std::uint32_t patch = 0;
    float farthest = 0;  ///< no x of it is larger
  };
  struct Bounds {
    std::uint32_t begin = 0, end = 0;
  };

  std::size_t bin_of(double theta) const;
  std::optional<std::uint32_t> slab(std::size_t bin, double theta) const;
  bool alive(std::uint32_t patch, std::uint32_t slab) const;
  std::optional<bool> meets_ray(std::uint32_t patch, const Turn& turn, Point q) const;
  void build(const CspaceObstacle& obstacle);

  const PatchForms& forms_;
  std::vector<double> angles_;              ///< of the events
  std::vector<std::uint32_t> first_angle_;  ///< per bin: the first event angle in it or after it
  std::vector<Bounds> alive_;               ///< slabs of the patches
  std::size_t bins_ = 0, rows_ = 0;
  std::vector<std::uint32_t> first_;  ///< per cell: its first entry
  std::vector<Entry> entries_;
};

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

}  // namespace
}  // namespace dymsum::cspace

namespace dymsum {
namespace {

// The root of the mean square distance of the robot's points from the origin: of its parts, else of its polylines, else
// of its points.
double turning_radius(const Region& robot) {
  if (!robot.parts().empty()) return radius_of_gyration(robot);
  // A segment counts with its midpoint and its length; the mean is by lengths.
  double size = 0, radius = 0;
  const auto add = [&](double more, double mean) {
    if (!(more > 0)) return;
    size += more;
    radius = std::hypot(radius * std::sqrt((size - more) / size), mean * std::sqrt(more / size));
  };
  for (const Polyline& line : robot.polylines())
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
      const Point a = line[k], b = line[k + 1];
      const double length = std::hypot(b.x - a.x, b.y - a.y);
      add(length, base::hypot3((a.x + b.x) / 2, (a.y + b.y) / 2, length / std::sqrt(12)));
    }
  if (robot.polylines().empty())
    for (const Point& p : robot.points()) add(1, std::hypot(p.x, p.y));
  return radius;
}

// The angle in [-pi, pi], within 2^-51 of the angle of Orientation::nearest.
double reduced(double theta) {
  return std::abs(theta) <= std::numbers::pi ? theta : Orientation::nearest(theta).value().radians();
}

}  // namespace

class ObstacleQueries::State {
 public:
  explicit State(const CspaceObstacle& o)
      : obstacle(o),
        forms(o),
        index(o, forms),
        gyration(turning_radius(o.robot())),
        tree(o, forms, forms.in_units(gyration)) {}

  // A curve of tight placements may be free in what is inside by the patches.
  std::optional<bool> proved(double x, double y, double theta) const {
    const std::optional<bool> by_patches = index.contains(x, y, theta);
    return by_patches == true && obstacle.may_have_tight_curves() ? std::nullopt : by_patches;
  }
  bool exact(double x, double y, const Orientation& theta) const {
    exact_answers.fetch_add(1, std::memory_order_relaxed);
    return obstacle.contains(x, y, theta);
  }

  const CspaceObstacle& obstacle;
  cspace::PatchForms forms;
  cspace::ContainmentIndex index;
  double gyration = 0;
  cspace::PatchTree tree;
  mutable std::atomic<std::uint64_t> exact_answers{0}, bounds{0};
};

ObstacleQueries::ObstacleQueries(const CspaceObstacle& obstacle) : state_(std::make_unique<State>(obstacle)) {}
ObstacleQueries::ObstacleQueries(ObstacleQueries&&) noexcept = default;
ObstacleQueries& ObstacleQueries::operator=(ObstacleQueries&&) noexcept = default;
ObstacleQueries::~ObstacleQueries() = default;

bool ObstacleQueries::contains(const Configuration& at) const {
  const State& s = *state_;
  if (std::abs(at.theta) <= std::numbers::pi)
    if (const std::optional<bool> proved = s.proved(at.x, at.y, at.theta)) return *proved;
  if (!std::isfinite(at.theta)) throw std::invalid_argument("ObstacleQueries::contains: theta is not finite");
  return contains(at.x, at.y, Orientation::nearest(at.theta).value());
}

bool ObstacleQueries::contains(double x, double y, const Orientation& theta) const {
  const State& s = *state_;
  if (!std::isfinite(x) || !std::isfinite(y)) return false;
  const std::optional<bool> proved = s.proved(x, y, theta.radians());
  return proved ? *proved : s.exact(x, y, theta);
}

std::vector<std::uint8_t> ObstacleQueries::contains(std::span<const Configuration> at, int threads) const {
  constexpr std::size_t kBlock = 1024;
  std::vector<std::uint8_t> result(at.size());
  base::parallel_parts((at.size() + kBlock - 1) / kBlock, threads, [&](std::size_t block) {
    const std::size_t last = std::min(at.size(), (block + 1) * kBlock);
    for (std::size_t k = block * kBlock; k < last; ++k) result[k] = contains(at[k]) ? 1 : 0;
  });
  return result;
}

std::uint64_t ObstacleQueries::exact_answers() const { return state_->exact_answers; }
double ObstacleQueries::gyration_radius() const { return state_->gyration; }
std::uint64_t ObstacleQueries::bounds_evaluated() const { return state_->bounds; }

std::vector<FreeAngles> ObstacleQueries::free_angles(double x, double y) const {
  if (!std::isfinite(x) || !std::isfinite(y))
    throw std::invalid_argument("ObstacleQueries::free_angles: the position is not finite");
  const State& s = *state_;
  return cspace::free_angles(s.obstacle, s.forms, {x, y}, [&](double theta) { return !contains({x, y, theta}); });
}

double ObstacleQueries::largest_weight() const { return 0x1p40 * state_->forms.size() * state_->forms.unit(); }

Clearance ObstacleQueries::clearance(const Configuration& from, double weight, Touching touching) const {
  if (!(weight >= 0) || !std::isfinite(from.x) || !std::isfinite(from.y) || !std::isfinite(from.theta))
    throw std::invalid_argument("clearance: the weight is negative or an argument is not a number");
  if (weight > largest_weight() && !std::isinf(weight))
    throw std::invalid_argument("clearance: the weight is larger than largest_weight(), but not infinite");
  const State& s = *state_;
  const Configuration at{from.x, from.y, reduced(from.theta)};
  const std::optional<bool> proved = s.proved(at.x, at.y, at.theta);
  const bool overlaps = proved ? *proved : contains(from);
  const auto found = cspace::ClearanceSearch(s.obstacle, s.forms, s.tree)
                         .run({at, from.theta, weight, touching, overlaps, proved == false});
  s.bounds.fetch_add(found.bounds, std::memory_order_relaxed);
  return found.clearance;
}

std::size_t ObstacleQueries::bytes() const { return state_->index.bytes() + state_->tree.bytes(); }

}  // namespace dymsum
