#include "shape/complex/site_rows.h"

#include <algorithm>
#include <mutex>
#include <numeric>

#include "base/parallel.h"
#include "shape/complex/exact_complex.h"

namespace dymsum::shape {

/// Two pieces in turn along a walk.
struct SiteRows::Ends {
  Section before_section, after_section;
  const Piece &before, &after;
};

namespace {

/// The fractions of a complex's work: rows begin and end about there.
constexpr double kFirstFraction = 0.4, kLastFraction = 0.8;

/// The size of the disc that touches site j: its radius at a position of an edge, 1 / radius at a vertex.
template <class T>
T size_at(const Formulas<T>& formulas, const Section& s, const Mark& at, std::uint32_t j) {
  if (j == kNoIndex) return T(0);
  const Quadratic<T> f = formulas.function(s, j);
  const T x = formulas.value(s, at), value = (f.a * x + f.b) * x + f.c;
  return formulas.is_edge(s.site) ? value / sqrt(T(formulas.frame(s.site).length2)) : value / (T(1) + x * x);
}

}  // namespace

SiteRows::SiteRows(const Walks& walks, Candidates candidates, int threads)
    : walks_(walks), order_(walks), candidates_(std::move(candidates)), threads_(threads), full_(walks.sites.size()) {
  for (std::uint32_t s = 0; s < walks.sites.size(); ++s) {
    first_section_.push_back(static_cast<std::uint32_t>(sections_.size()));
    for (const Section& section : sections_of(walks, s)) sections_.push_back(section);
  }
  first_section_.push_back(static_cast<std::uint32_t>(sections_.size()));
  rows_.resize(sections_.size());
}

bool SiteRows::close(Guess guess, const Poll& poll) {
  constexpr std::uint64_t kRounds = 3;
  std::vector<std::uint32_t> sites(walks_.sites.size());
  std::iota(sites.begin(), sites.end(), 0U);
  while (!sites.empty()) {
    make_rows(sites, poll);
    sites = extend();
    if (!sites.empty()) ++work.closing_rounds;
    const bool costly = work.closing_rounds > kRounds || std::find(full_.begin(), full_.end(), 1) != full_.end();
    if (guess == Guess::rough && costly) return false;
  }
  for (const std::vector<std::uint32_t>& list : candidates_) work.candidates += list.size();
  work.full_sites = static_cast<std::uint64_t>(std::count(full_.begin(), full_.end(), 1));
  work.signs += order_.counts;
  return true;
}

/// Makes rows in batches: between them the caller is queried whether to go on.
void SiteRows::make_rows(const std::vector<std::uint32_t>& sites, const Poll& poll) {
  constexpr std::size_t kSitesPerBatch = 16384;
  for (std::size_t i = 0; i < sites.size(); i += kSitesPerBatch) {
    const double done = work.closing_rounds > 0 ? 1 : static_cast<double>(i) / static_cast<double>(sites.size());
    poll(kFirstFraction + (kLastFraction - kFirstFraction) * done);
    make_some_rows(sites.data() + i, sites.data() + std::min(sites.size(), i + kSitesPerBatch));
  }
}

void SiteRows::make_some_rows(const std::uint32_t* first, const std::uint32_t* last) {
  constexpr std::size_t kSitesPerPart = 256;
  std::mutex mutex;
  const auto count = static_cast<std::size_t>(last - first);
  const auto part = [&](std::size_t p) {
    Order order(walks_);
    for (std::size_t i = p * kSitesPerPart; i < std::min(count, (p + 1) * kSitesPerPart); ++i) {
      const std::uint32_t s = first[i];
      for (std::uint32_t k = first_section_[s]; k < first_section_[s + 1]; ++k) {
        Envelope envelope(order, sections_[k]);
        for (const std::uint32_t j : candidates_[s]) envelope.insert(j);
        rows_[k] = envelope.pieces();
      }
    }
    const std::lock_guard<std::mutex> lock(mutex);
    work.signs += order.counts;
  };
  base::parallel_parts((count + kSitesPerPart - 1) / kSitesPerPart, threads_, part);
}

/// Looks at all pairs of pieces in turn. The sites that have new candidates.
std::vector<std::uint32_t> SiteRows::extend() {
  const auto look = [&](auto&& at) {
    for (const SiteLoop& loop : walks_.loops) {
      const std::uint32_t first = first_section_[loop.first], last = first_section_[loop.last];
      for (std::uint32_t k = first; k < last; ++k) {
        const std::vector<Piece>& row = rows_[k];
        for (std::size_t i = 0; i + 1 < row.size(); ++i) at(Ends{sections_[k], sections_[k], row[i], row[i + 1]});
        const std::uint32_t next = k + 1 == last ? first : k + 1;
        at(Ends{sections_[k], sections_[next], row.back(), rows_[next].front()});
      }
    }
  };
  look([&](const Ends& e) { query_about(e); });
  std::vector<std::uint32_t> changed = take_queried();
  if (!changed.empty()) return changed;
  look([&](const Ends& e) {
    if (is_continuous(e)) return;
    query_at_jump(e.before_section.site, e.before.other);
    query_at_jump(e.after_section.site, e.after.other);
  });
  return take_queried();
}

void SiteRows::query(std::uint32_t s, std::uint32_t j) {
  if (s == j || s == kNoIndex || j == kNoIndex) return;
  // No disc that touches an edge inside touches its end.
  const bool edge_and_end =
      walks_.is_edge(s) != walks_.is_edge(j) && (walks_.ends[s].next == j || walks_.ends[s].prev == j);
  if (edge_and_end) return;
  const std::vector<std::uint32_t>& list = candidates_[s];
  if (!std::binary_search(list.begin(), list.end(), j)) queried_.emplace_back(s, j);
}

/// The disc there touches up to four sites: each is a candidate of the others.
void SiteRows::query_about(const Ends& e) {
  const std::array<std::uint32_t, 4> sites{e.before_section.site, e.after_section.site, e.before.other, e.after.other};
  for (std::size_t a = 0; a < 4; ++a) {
    for (std::size_t b = 0; b < 4; ++b) {
      if (a < 2 && b < 2) continue;  // neighbours in the walk
      query(sites[a], sites[b]);
    }
  }
}

/// s wants what continues the site that it lost, or else all others.
void SiteRows::query_at_jump(std::uint32_t s, std::uint32_t other) {
  if (full_[s]) return;
  const std::size_t before = queried_.size();
  if (other != kNoIndex) {
    const SiteEnds& ends = walks_.ends[other];
    for (const std::uint32_t j : {ends.prev, ends.next, walks_.ends[ends.prev].prev, walks_.ends[ends.next].next})
      query(s, j);
  }
  if (queried_.size() > before) return;
  full_[s] = 1;
  for (std::uint32_t j = 0; j < walks_.sites.size(); ++j) query(s, j);
}

/// Whether the two discs at the end of one piece and the beginning of the next are the same.
bool SiteRows::is_continuous(const Ends& e) {
  const std::uint32_t s = e.before_section.site, i = e.before.other, j = e.after.other;
  const Mark& m = e.before.to;
  const bool same_section = s == e.after_section.site && e.before_section.axis == e.after_section.axis;
  if (i == j && (i != kNoIndex || !walks_.is_edge(s) || same_section || !walks_.is_edge(e.after_section.site)))
    return true;
  if (same_section) {
    if (m.kind == Mark::Kind::crossing && m.i == std::min(i, j) && m.j == std::max(i, j)) return true;
    const bool pass = i != kNoIndex && j != kNoIndex && (walks_.ends[i].next == j || walks_.ends[i].prev == j);
    if (pass && m.kind == Mark::Kind::tangent && walks_.is_edge(i) != walks_.is_edge(j)) return true;
  } else if (walks_.is_edge(s) && walks_.is_edge(e.after_section.site)) {
    return i == e.after_section.site && j == s;  // a reflex vertex
  }
  const bool alike = walks_.is_edge(s) == walks_.is_edge(e.after_section.site);
  const bool half_plane_before = walks_.is_edge(s) && i == kNoIndex;
  const bool half_plane_after = walks_.is_edge(e.after_section.site) && j == kNoIndex;
  if (alike && (half_plane_before || half_plane_after)) return false;
  return order_.sign([&](const auto& formulas) {
    const auto before = size_at(formulas, e.before_section, m, i);
    const auto after = size_at(formulas, e.after_section, e.after.from, j);
    using T = std::decay_t<decltype(before)>;
    // Radii along edges, curvatures about vertices; the curvature of a half-plane along an edge is 0.
    if (half_plane_before) return T(after);
    if (half_plane_after) return T(before);
    return alike ? T(before - after) : T(before * after - T(1));
  }) == 0;
}

std::vector<std::uint32_t> SiteRows::take_queried() {
  std::sort(queried_.begin(), queried_.end());
  queried_.erase(std::unique(queried_.begin(), queried_.end()), queried_.end());
  std::vector<std::uint32_t> changed;
  for (const auto& [s, j] : queried_) {
    if (changed.empty() || changed.back() != s) changed.push_back(s);
    candidates_[s].push_back(j);
  }
  for (const std::uint32_t s : changed) std::sort(candidates_[s].begin(), candidates_[s].end());
  queried_.clear();
  return changed;
}

bool SiteRows::closes_at_infinity() {
  std::uint32_t rounds = 0;
  for (std::uint32_t k = 0; k < rows_.size(); ++k) {
    for (const Piece& p : rows_[k]) {
      if (p.other != kNoIndex) continue;
      if (walks_.side == Side::inside) return false;
      const Section& s = sections_[k];
      if (walks_.is_edge(s.site) || s.axis == 2) continue;
      // Whether direction +x lies in it, half open.
      const int x = s.axis == 0 ? 0 : s.axis == 1 ? -1 : 1;
      const auto sign = [&](const Mark& m) {
        return order_.sign([&](const auto& formulas) {
          const auto value = formulas.value(s, m);
          return value - std::decay_t<decltype(value)>(x);
        });
      };
      if (sign(p.from) <= 0 && sign(p.to) > 0) ++rounds;
    }
  }
  return rounds == (walks_.side == Side::outside ? 1 : 0);
}

}  // namespace dymsum::shape
