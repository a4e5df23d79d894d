#include <cmath>
#include <stdexcept>

#include "shape/complex/assemble.h"
#include "shape/complex/from_candidates.h"
#include "shape/complex/site_rows.h"
#include "shape/complex/thin_contacts.h"

namespace dymsum::shape {
namespace {

Candidates all_pairs(const Walks& walks) {
  const auto n = static_cast<std::uint32_t>(walks.sites.size());
  Candidates all(n);
  for (std::uint32_t s = 0; s < n; ++s) {
    for (std::uint32_t j = 0; j < n; ++j) {
      if (j != s) all[s].push_back(j);
    }
  }
  return all;
}

/// Matched cells, or nothing where the certificate fails.
std::optional<Cells> certified_cells(Order& order, Candidates candidates, int threads, Work& work) {
  SiteRows rows(order.walks(), std::move(candidates), threads);
  rows.close();
  const bool closes = rows.closes_at_infinity();
  work.candidates = rows.work.candidates;
  work.closing_rounds = rows.work.closing_rounds;
  work.full_sites = rows.work.full_sites;
  work.filtered += rows.work.filtered;
  work.exact += rows.work.exact;
  if (!closes) return std::nullopt;
  Cells cells = join_cells(order.walks(), rows.sections(), rows.rows());
  if (!match_cells(order, cells)) return std::nullopt;
  return cells;
}

Error beyond_range(const std::string& what, Point at) {
  Error error{ErrorCode::out_of_range, what, {}};
  error.evidence.x = at.x;
  error.evidence.y = at.y;
  return error;
}

std::optional<Error> too_large(const Walks& walks) {
  constexpr double kLargest = 0x1p1000;
  for (const BoundaryPoint& p : walks.points) {
    if (std::abs(p.input.x) > kLargest || std::abs(p.input.y) > kLargest)
      return beyond_range("discs want coordinates of at most 2^1000", p.input);
  }
  return std::nullopt;
}

/// Discs that almost are half-planes can be larger than any double.
std::optional<Error> too_large(const Complex& c) {
  for (std::uint32_t n = 0; n < c.nodes.size(); ++n) {
    const Node& node = c.nodes[n];
    if (!std::isfinite(node.radius) || !std::isfinite(node.centre.x) || !std::isfinite(node.centre.y))
      return beyond_range("a disc that touches three places is larger than doubles reach",
                          c.sites[c.exact->contacts[n][0]].a);
  }
  return std::nullopt;
}

}  // namespace

Complex complex_from(Walks walks, std::optional<Candidates> guess, int threads) {
  auto exact = std::make_shared<ExactComplex>();
  exact->walks = std::move(walks);
  Work work;
  work.certified = guess.has_value();
  if (exact->walks.sites.empty()) return ranked({}, std::move(exact), work);
  Order order(exact->walks);
  std::optional<Cells> cells;
  if (guess) {
    cells = certified_cells(order, *std::move(guess), threads, work);
    work.certified = cells.has_value();
  }
  if (!cells) cells = certified_cells(order, all_pairs(exact->walks), threads, work);
  if (!cells) throw std::logic_error("the cells of a complex do not match");
  Graph graph = assemble(order, *cells);
  work.filtered += order.counts.filtered;
  work.exact += order.counts.exact;
  return ranked(std::move(graph), std::move(exact), work);
}

Result<Complex> make_complex(const Region& region, Side side, Engine engine, int threads) {
  if (side == Side::outside) {
    if (std::optional<Error> error = thin_contact(region)) return *std::move(error);
  }
  Result<Walks> walks = make_walks(region, side);
  if (!walks) return walks.error();
  if (std::optional<Error> error = too_large(*walks)) return *std::move(error);
  std::optional<Candidates> guess;
  if (engine == Engine::fast) guess = walks->sites.empty() ? Candidates{} : candidates_of(*walks);
  Complex made = complex_from(std::move(walks).value(), std::move(guess), threads);
  if (std::optional<Error> error = too_large(made)) return *std::move(error);
  return made;
}

}  // namespace dymsum::shape
