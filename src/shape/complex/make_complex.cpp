#include <stdexcept>

#include "shape/complex/assemble.h"

namespace dymsum::shape {
namespace {

/// The cells of the brute engine.
Cells brute_cells(Order& order) {
  const Walks& walks = order.walks();
  std::vector<Section> sections;
  std::vector<std::vector<Piece>> rows;
  for (std::uint32_t s = 0; s < walks.sites.size(); ++s) {
    for (const Section& section : sections_of(walks, s)) {
      Envelope envelope(order, section);
      for (std::uint32_t j = 0; j < walks.sites.size(); ++j) {
        if (j != s) envelope.insert(j);
      }
      sections.push_back(section);
      rows.push_back(envelope.pieces());
    }
  }
  Cells cells = join_cells(walks, sections, rows);
  if (!match_cells(order, cells)) throw std::logic_error("cells of a complex do not match");
  return cells;
}

}  // namespace

Result<Complex> make_complex(const Region& region, Side side, Engine, int) {
  Result<Walks> walks = make_walks(region, side);
  if (!walks) return walks.error();
  auto exact = std::make_shared<ExactComplex>();
  exact->walks = std::move(walks).value();
  Order order(exact->walks);
  Graph graph = assemble(order, brute_cells(order));
  return ranked(std::move(graph), std::move(exact), order.counts);
}

}  // namespace dymsum::shape
