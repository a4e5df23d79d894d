#include "spatial/turning/facet_cells.h"

#include <algorithm>

namespace dymsum::spatial {

using exact::AlgebraicRoot;

namespace {

/// Fewer slants at one angle are not worth a search of its own.
constexpr std::size_t kCrowd = 32;
constexpr std::size_t kMostCrowded = 63;

bool is_before(const AlgebraicRoot& a, const AlgebraicRoot& b) { return exact::compare(a, b) < 0; }

bool is_turned_over(const SlantCondition& a, const SlantCondition& b) { return a.way.from != b.way.from; }

std::vector<AlgebraicRoot> crowded_angles(const WindowSlants& slants) {
  std::vector<AlgebraicRoot> all, crowded;
  for (const WindowSlant& s : slants.all()) all.insert(all.end(), s.roots.begin(), s.roots.end());
  std::sort(all.begin(), all.end(), is_before);
  for (std::size_t i = 0, j; i < all.size(); i = j) {
    for (j = i + 1; j < all.size() && exact::compare(all[i], all[j]) == 0;) ++j;
    if (j - i >= kCrowd && crowded.size() < kMostCrowded && exact::rational_value(all[i])) crowded.push_back(all[i]);
  }
  return crowded;
}

/// The cells in which sense times the slant is negative or zero at some angle.
TurnCells cells_of(const WindowSlant& slant, int sense, const std::vector<AlgebraicRoot>& ends) {
  const TurnCells all = ~TurnCells{0} >> (63 - ends.size());
  const auto from = [&](std::size_t cell) { return all >> cell << cell; };
  if (slant.sign == 0) return all;
  TurnCells cells = 0;
  std::size_t first = 0;  // the cell in which the slant has the sign
  int sign = sense * slant.sign;
  for (const AlgebraicRoot& root : slant.roots) {
    const auto end =
        static_cast<std::size_t>(std::lower_bound(ends.begin(), ends.end(), root, is_before) - ends.begin());
    const bool at_end = end < ends.size() && exact::compare(ends[end], root) == 0;
    if (sign < 0) cells |= from(first) & ~(end == 63 ? 0 : from(end + 1));
    if (!at_end) cells |= TurnCells{1} << end;
    first = at_end ? end + 1 : end;
    if (root.changes_sign()) sign = -sign;
  }
  return sign < 0 ? cells | from(first) : cells;
}

}  // namespace

WindowSlants::Key WindowSlants::key(const SlantCondition& c) {
  return {static_cast<std::uint32_t>(c.op), c.triangle, std::min(c.way.from, c.way.to), std::max(c.way.from, c.way.to)};
}

WindowSlants::WindowSlants(const TurningPair& pair, const std::vector<WindowFacet>& facets, const JetFrame& jets,
                           const TurnRangeOfT& range, WindowRoots& roots, const std::function<void()>& again) {
  const PolynomialFrame frame(pair, range.chart);
  const TurnSigns<PolynomialFrame> exact(frame);
  const TurnSigns<JetFrame> near(jets);
  std::vector<exact::Polynomial> forms;
  for (const WindowFacet& f : facets)
    for (const SlantCondition& c : f.unsure) {
      if (!index_.emplace(key(c), all_.size()).second) continue;
      if (all_.size() % 256 == 0) again();
      const Triangle& t = pair.operand(c.op).triangles[c.triangle];
      WindowSlant slant{c, near.slant(c.op, t, c.way).sign(), {}};
      forms.emplace_back();
      if (slant.sign == 0) {
        forms.back() = roots.polynomial(exact.slant(c.op, t, c.way).terms());
        slant.roots = roots.of(forms.back());
      }
      all_.push_back(std::move(slant));
    }
  find_signs(range, forms);
}

/// At one angle before all of their roots.
void WindowSlants::find_signs(const TurnRangeOfT& range, const std::vector<exact::Polynomial>& forms) {
  AlgebraicRoot first = AlgebraicRoot::rational(range.high);
  for (const WindowSlant& s : all_)
    if (!s.roots.empty() && is_before(s.roots.front(), first)) first = s.roots.front();
  const exact::BigRational before = exact::between(AlgebraicRoot::rational(range.low), first);
  for (std::size_t k = 0; k < all_.size(); ++k)
    if (!forms[k].is_zero()) all_[k].sign = forms[k].sign_at(before);
}

FacetCells::FacetCells(const std::vector<WindowFacet>& facets, const WindowSlants& slants)
    : crowded(crowded_angles(slants)) {
  for (const WindowFacet& f : facets) {
    TurnCells cells = ~TurnCells{0} >> (63 - crowded.size());
    for (const SlantCondition& c : f.unsure) {
      const WindowSlant& slant = slants.of(c);
      cells &= cells_of(slant, is_turned_over(c, slant.of) ? -c.sense : c.sense, crowded);
    }
    of.push_back(cells);
  }
}

bool FacetCells::is_crowded(const AlgebraicRoot& root) const {
  return std::any_of(crowded.begin(), crowded.end(),
                     [&](const AlgebraicRoot& c) { return exact::compare(c, root) == 0; });
}

}  // namespace dymsum::spatial
