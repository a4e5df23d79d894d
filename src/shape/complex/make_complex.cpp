#include <cmath>
#include <stdexcept>

#include "base/poll.h"
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
std::optional<Cells> certified_cells(Order& order, Candidates candidates, int threads, SiteRows::Guess kind,
                                     const Poll& poll, Work& work) {
  SiteRows rows(order.walks(), std::move(candidates), threads);
  if (!rows.close(kind, poll)) return std::nullopt;
  const bool closes = rows.closes_at_infinity();
  work.candidates = rows.work.candidates;
  work.closing_rounds = rows.work.closing_rounds;
  work.full_sites = rows.work.full_sites;
  work.signs += rows.work.signs;
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

namespace {

/// One complex from guesses, the best one last.
Complex complex_of(Walks walks, int threads, std::optional<Candidates> guess, SiteRows::Guess kind, const Poll& poll) {
  auto exact = std::make_shared<ExactComplex>();
  exact->walks = std::move(walks);
  Work work;
  if (exact->walks.sites.empty()) {
    work.certified = guess.has_value();
    return ranked({}, std::move(exact), work);
  }
  Order order(exact->walks);
  const auto cells_from = [&](Candidates candidates, SiteRows::Guess how) {
    return certified_cells(order, std::move(candidates), threads, how, poll, work);
  };
  std::optional<Cells> cells;
  if (kind == SiteRows::Guess::rough) {
    if (guess) cells = cells_from(*std::move(guess), SiteRows::Guess::rough);
    if (!cells) guess = candidates_of(exact->walks);
  }
  if (!cells && guess) cells = cells_from(*std::move(guess), SiteRows::Guess::good);
  work.certified = cells.has_value();
  if (!cells) cells = cells_from(all_pairs(exact->walks), SiteRows::Guess::good);
  if (!cells) throw std::logic_error("the cells of a complex do not match");
  poll(0.8);
  Graph graph = assemble(order, *cells);
  poll(0.85);
  work.signs += order.counts;
  return ranked(std::move(graph), std::move(exact), work);
}

}  // namespace

Complex complex_from(Walks walks, std::optional<Candidates> guess, int threads, const Poll& poll) {
  return complex_of(std::move(walks), threads, std::move(guess), SiteRows::Guess::good, poll);
}

Complex complex_from_rough(Walks walks, int threads, const Poll& poll) {
  std::optional<Candidates> guess = walks.sites.empty() ? Candidates{} : rough_candidates_of(walks);
  return complex_of(std::move(walks), threads, std::move(guess), SiteRows::Guess::rough, poll);
}

namespace {

Result<Complex> made(const Region& region, Side side, Engine engine, int threads, const Poll& poll) {
  if (side == Side::outside) {
    if (std::optional<Error> error = thin_contact(region)) return *std::move(error);
  }
  Result<Walks> walks = make_walks(region, side);
  if (!walks) return walks.error();
  if (std::optional<Error> error = too_large(*walks)) return *std::move(error);
  Complex complex = engine == Engine::fast ? complex_from_rough(std::move(walks).value(), threads, poll)
                                           : complex_from(std::move(walks).value(), std::nullopt, threads, poll);
  if (std::optional<Error> error = too_large(complex)) return *std::move(error);
  return complex;
}

}  // namespace

Result<Complex> make_complex(const Region& region, Side side, Engine engine, int threads, const Progress& progress) {
  Poll poll(progress);
  try {
    poll.stage("complex");
    return made(region, side, engine, threads, poll);
  } catch (const Cancelled&) {
    return cancelled();
  }
}

}  // namespace dymsum::shape
