#include <stdexcept>

#include "shape/complex/assemble.h"
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

}  // namespace

Result<Complex> make_complex(const Region& region, Side side, Engine engine, int threads) {
  if (side == Side::outside) {
    if (std::optional<Error> error = thin_contact(region)) return *std::move(error);
  }
  Result<Walks> walks = make_walks(region, side);
  if (!walks) return walks.error();
  auto exact = std::make_shared<ExactComplex>();
  exact->walks = std::move(walks).value();
  if (exact->walks.sites.empty()) return ranked({}, std::move(exact), {});
  Order order(exact->walks);
  Work work;
  std::optional<Cells> cells;
  if (engine == Engine::fast) {
    cells = certified_cells(order, candidates_of(exact->walks), threads, work);
    work.certified = cells.has_value();
  }
  if (!cells) cells = certified_cells(order, all_pairs(exact->walks), threads, work);
  if (!cells) throw std::logic_error("the cells of a complex do not match");
  Graph graph = assemble(order, *cells);
  work.filtered += order.counts.filtered;
  work.exact += order.counts.exact;
  return ranked(std::move(graph), std::move(exact), work);
}

}  // namespace dymsum::shape
