#include "spatial/events/facet_cells.h"

#include <algorithm>

namespace dymsum::spatial {

using exact::AlgebraicRoot;

namespace {

/// Fewer slants at one angle are not worth a search of its own.
constexpr std::size_t kCrowd = 32;
constexpr std::size_t kMostCrowded = 63;

bool is_turned_over(const SlantCondition& a, const SlantCondition& b) { return a.direction.from != b.direction.from; }

std::vector<std::uint32_t> crowded_angles(const WindowSlants& slants, const RootOrder& angles) {
  std::vector<std::size_t> count(angles.size());
  for (const WindowSlant& s : slants.all())
    for (const FormRoot& root : s.roots) ++count[root.angle];
  std::vector<std::uint32_t> crowded;
  for (const std::uint32_t a : angles.ascending())
    if (count[a] >= kCrowd && crowded.size() < kMostCrowded && exact::rational_value(angles[a])) crowded.push_back(a);
  return crowded;
}

/// The cells in which sense times the slant is negative or zero at some angle.
RotationCells cells_of(const WindowSlant& slant, int sense, const std::vector<std::uint32_t>& ends,
                       const RootOrder& angles) {
  const RotationCells all = ~RotationCells{0} >> (kMostCrowded - ends.size());
  const auto from = [&](std::size_t cell) { return cell > kMostCrowded ? 0 : all >> cell << cell; };
  if (slant.sign == 0) return all;
  RotationCells cells = 0;
  std::size_t first = 0;  // the cell in which the slant has the sign
  int sign = sense * slant.sign;
  for (const FormRoot& root : slant.roots) {
    const auto at = std::lower_bound(ends.begin(), ends.end(), root.angle,
                                     [&](std::uint32_t a, std::uint32_t b) { return angles.is_before(a, b); });
    const auto cell = static_cast<std::size_t>(at - ends.begin());
    const bool at_end = at != ends.end() && *at == root.angle;
    if (sign < 0) cells |= from(first) & ~from(cell + 1);
    if (!at_end) cells |= RotationCells{1} << cell;
    first = at_end ? cell + 1 : cell;
    if (root.changes_sign) sign = -sign;
  }
  return sign < 0 ? cells | from(first) : cells;
}

}  // namespace

WindowSlants::Key WindowSlants::key(const SlantCondition& c) {
  return {static_cast<std::uint32_t>(c.op), c.triangle, std::min(c.direction.from, c.direction.to),
          std::max(c.direction.from, c.direction.to)};
}

WindowSlants::WindowSlants(const RotatingPair& pair, const std::vector<WindowFacet>& facets,
                           const ProvedSign& proved_sign, const RotationRange& range, WindowRoots& roots,
                           const std::function<void()>& again) {
  const PolynomialFrame frame(pair, range.chart);
  const RotationSigns<PolynomialFrame> exact(frame);
  std::vector<exact::Polynomial> forms;
  for (const WindowFacet& f : facets)
    for (const SlantCondition& c : f.unsure) {
      if (!index_.emplace(key(c), all_.size()).second) continue;
      if (all_.size() % 256 == 0) again();
      const Triangle& t = pair.operand(c.op).triangles[c.triangle];
      WindowSlant slant{c, proved_sign(c), {}};
      forms.emplace_back();
      if (slant.sign == 0) {
        forms.back() = roots.polynomial(exact.slant(c.op, t, c.direction).terms());
        slant.roots = roots.of(forms.back());
      }
      all_.push_back(std::move(slant));
    }
  find_signs(range, roots.angles(), forms);
}

/// Finds the signs at one angle before all of their roots.
void WindowSlants::find_signs(const RotationRange& range, const RootOrder& angles,
                              const std::vector<exact::Polynomial>& forms) {
  const AlgebraicRoot first =
      angles.size() > 0 ? angles[angles.ascending().front()] : AlgebraicRoot::rational(range.high);
  const exact::BigRational before = exact::between(AlgebraicRoot::rational(range.low), first);
  for (std::size_t k = 0; k < all_.size(); ++k)
    if (!forms[k].is_zero()) all_[k].sign = forms[k].sign_at(before);
}

namespace {

/// Slants that vanish at one angle, or at two so near to each other that a window is this many times as wide.
struct SlantsAt {
  std::uint32_t angle = 0;
  std::size_t count = 0;
};
constexpr double kCrowdWidth = 0x1p-20, kRoomBesideCrowd = 0x1p10;
/// The width, in t times |axis|, of windows in which boxes and positions decide nothing more.
constexpr double kNarrow = 0x1p-20;
constexpr std::size_t kSlantsOfPart = 16;

std::vector<exact::BigRational> around_crowds(const std::vector<SlantsAt>& at, const RootOrder& angles,
                                              const RotationRange& range) {
  const double low = exact::round_to_double(range.low), high = exact::round_to_double(range.high),
               near = (high - low) * kCrowdWidth;
  std::vector<exact::BigRational> parts;
  const auto add = [&](double t) {
    exact::BigRational end = exact::exact_value(t);
    if (end > range.low && end < range.high && (parts.empty() || end > parts.back())) parts.push_back(std::move(end));
  };
  for (std::size_t first = 0, next = 0; first < at.size(); first = next) {
    std::size_t count = 0;
    for (next = first; next < at.size(); ++next) {
      if (next > first && angles[at[next].angle].low() - angles[at[next - 1].angle].high() > near) break;
      count += at[next].count;
    }
    if (next - first < 2 || count < kCrowd) continue;
    const double begin = angles[at[first].angle].low(), end = angles[at[next - 1].angle].high(),
                 room = (end - begin) * kRoomBesideCrowd;
    const double before = first == 0 ? low : angles[at[first - 1].angle].high(),
                 after = next == at.size() ? high : angles[at[next].angle].low();
    add(begin - std::min(room, (begin - before) / 2)), add(end + std::min(room, (after - end) / 2));
  }
  return parts;
}

/// A rational angle at which so many slants vanish that it is searched on its own, as that at which an operand lies as
/// it does in itself, has a window of its own between the others: next to nothing else happens there.
std::vector<exact::BigRational> around_crowded_angles(const std::vector<SlantsAt>& at, const RootOrder& angles,
                                                      const RotationRange& range) {
  std::vector<exact::BigRational> parts;
  for (std::size_t k = 0; k < at.size(); ++k) {
    if (at[k].count < kCrowd) continue;
    const std::optional<exact::BigRational> t = exact::rational_value(angles[at[k].angle]);
    if (!t) continue;
    const exact::BigRational before = k == 0 ? range.low : exact::exact_value(angles[at[k - 1].angle].high()),
                             after =
                                 k + 1 == at.size() ? range.high : exact::exact_value(angles[at[k + 1].angle].low());
    if (before >= *t || after <= *t) continue;
    const double room =
        exact::round_to_double(std::min<exact::BigRational>(*t - before, after - *t)) / kRoomBesideCrowd;
    const auto beside = [&](const exact::BigRational& end) {
      const AlgebraicRoot at_end = AlgebraicRoot::rational(end), at_t = AlgebraicRoot::rational(*t);
      return end < *t ? exact::between(at_end, at_t) : exact::between(at_t, at_end);
    };
    const exact::BigRational by = exact::exact_value(room);
    for (const exact::BigRational& end : {beside(*t - by), beside(*t + by)})
      if (parts.empty() || end > parts.back()) parts.push_back(end);
  }
  return parts;
}

}  // namespace

std::vector<exact::BigRational> parts_of(const WindowSlants& slants, const RootOrder& angles,
                                         const RotationRange& range) {
  std::vector<std::size_t> count(angles.size());
  for (const WindowSlant& s : slants.all())
    for (const FormRoot& root : s.roots) ++count[root.angle];
  std::vector<SlantsAt> at;
  std::size_t all = 0;
  for (const std::uint32_t a : angles.ascending())
    if (count[a] > 0) at.push_back({a, count[a]}), all += count[a];
  if (all < kCrowd || at.size() < 2) return {};
  std::vector<exact::BigRational> parts = around_crowds(at, angles, range);
  if (!parts.empty() || !(exact::round_to_double(range.high - range.low) < kNarrow)) return parts;
  parts = around_crowded_angles(at, angles, range);
  if (!parts.empty()) return parts;
  std::size_t here = 0;
  for (std::size_t k = 0; k + 1 < at.size(); ++k) {
    here += at[k].count;
    if (here < kSlantsOfPart) continue;
    exact::BigRational end = exact::between(angles[at[k].angle], angles[at[k + 1].angle]);
    parts.push_back(std::move(end));
    here = 0;
  }
  return parts;
}

FacetCells::FacetCells(const std::vector<WindowFacet>& facets, const WindowSlants& slants, const RootOrder& angles)
    : crowded(crowded_angles(slants, angles)) {
  for (const WindowFacet& f : facets) {
    RotationCells cells = ~RotationCells{0} >> (kMostCrowded - crowded.size());
    for (const SlantCondition& c : f.unsure) {
      const WindowSlant& slant = slants.of(c);
      cells &= cells_of(slant, is_turned_over(c, slant.of) ? -c.sense : c.sense, crowded, angles);
    }
    of.push_back(cells);
  }
}

bool FacetCells::is_crowded(std::uint32_t angle) const {
  return std::find(crowded.begin(), crowded.end(), angle) != crowded.end();
}

}  // namespace dymsum::spatial
