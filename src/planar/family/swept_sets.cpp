#include "planar/family/swept_sets.h"

#include <algorithm>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "planar/boolean/boolean_terms.h"
#include "planar/position/position_signs.h"
#include "planar/result/result_region.h"

namespace dymsum::planar {

using exact::BigRational;
using exact::HomogeneousPoint;

namespace {

/// Rings at exact positions for a Boolean operation.
class ExactRings {
 public:
  ExactRings() { set_.fill = Fill::positive; }

  /// Adds a ring as it is.
  void add(const std::vector<HomogeneousPoint>& ring) {
    Ring& rounded = set_.rings.emplace_back();
    for (const HomogeneousPoint& v : ring) {
      const Position at = reduced(v);
      rounded.push_back({exact::round_to_double(at.x), exact::round_to_double(at.y)});
      set_.fractions.push_back(exact::in_lowest_terms(v));
      doubles_ &= is_double(set_.fractions.back(), rounded.back());
    }
  }
  /// Adds a quadrangle counter-clockwise; nothing where it has no area. Requires: it does not cross itself.
  void add_quadrangle(std::vector<HomogeneousPoint> ring) {
    const BigRational area = twice_area(ring);
    if (area == 0) return;
    if (area < 0) std::reverse(ring.begin(), ring.end());
    add(ring);
  }
  BooleanTerms terms() && {
    if (doubles_) set_.fractions.clear();
    BooleanTerms terms;
    terms.inputs.push_back(std::make_shared<const RingSet>(std::move(set_)));
    terms.steps = {0};
    return terms;
  }

 private:
  static BigRational twice_area(const std::vector<HomogeneousPoint>& ring) {
    BigRational sum = 0;
    Position last = reduced(ring.back());
    for (const HomogeneousPoint& v : ring) {
      Position at = reduced(v);
      sum += last.x * at.y - last.y * at.x;
      last = std::move(at);
    }
    return sum;
  }

  RingSet set_;
  bool doubles_ = true;
};

SumOptions of_semantics(Semantics semantics) {
  SumOptions options;
  options.semantics = semantics;
  return options;
}

}  // namespace

Result<PlanarSum> swept_region(const Region& region, const Factors& factors, const BigRational& a,
                               const BigRational& b) {
  const BigRational x = rational(factors.x), y = rational(factors.y);
  const auto at = [&](Point v, const BigRational& s) {
    return homogeneous(Position{exact::exact_value(v.x) * x * s, exact::exact_value(v.y) * y * s});
  };
  ExactRings rings;
  const auto add = [&](const Ring& ring) {
    for (const BigRational& s : {a, b}) {
      std::vector<HomogeneousPoint> placed;
      for (const Point& v : ring) placed.push_back(at(v, s));
      rings.add(placed);
    }
    for (std::size_t k = 0; k < ring.size() && a != b; ++k) {
      const Point from = ring[k], to = ring[(k + 1) % ring.size()];
      rings.add_quadrangle({at(from, a), at(to, a), at(to, b), at(from, b)});
    }
  };
  for (const Part& part : region.parts()) {
    add(part.outer);
    std::for_each(part.holes.begin(), part.holes.end(), add);
  }
  return evaluate(std::move(rings).terms(), of_semantics(Semantics::closed));
}

namespace {

/// The edges of the boundary, and the cells in which each is there.
struct LivingEdge {
  std::uint32_t from = 0, to = 0;  // names
  std::uint32_t first_cell = 0, last_cell = 0;
};

std::vector<LivingEdge> edges_in(const SumStructures& structures, std::uint32_t first_cell, std::uint32_t last_cell) {
  std::vector<LivingEdge> edges;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> last;
  for (std::uint32_t cell = first_cell; cell <= last_cell; ++cell)
    for (const SumStructures::Ring& ring : structures.rings(cell)) {
      const auto vertices = structures.vertices(ring);
      for (std::size_t k = 0; k < vertices.size(); ++k) {
        const std::uint32_t from = vertices[k], to = vertices[(k + 1) % vertices.size()];
        const auto [at, fresh] = last.try_emplace({from, to}, edges.size());
        if (!fresh && edges[at->second].last_cell + 1 >= cell) {
          edges[at->second].last_cell = cell;
          continue;
        }
        at->second = edges.size();
        edges.push_back({from, to, cell, cell});
      }
    }
  return edges;
}

/// Exact positions of a family's vertices where cells begin and end.
class PositionsAtEnds {
 public:
  PositionsAtEnds(const ScalingCells& cells, const BigRational& a, const BigRational& b)
      : cells_(cells), a_(a), b_(b) {}

  /// Before event k, which is event 0 at the beginning of cell 0; within [a, b].
  HomogeneousPoint begin(std::uint32_t cell, std::uint32_t name) {
    return at(cell == 0 ? a_ : std::max(a_, scale_of(cell - 1)), name);
  }
  HomogeneousPoint end(std::uint32_t cell, std::uint32_t name) {
    return at(cell == cells_.events.size() ? b_ : std::min(b_, scale_of(cell)), name);
  }

 private:
  BigRational scale_of(std::uint32_t event) const {
    return exact::exact_value(cells_.events[event].parameter) * cells_.unit;
  }
  HomogeneousPoint at(const BigRational& t, std::uint32_t name) {
    std::unique_ptr<FrameSource>& source = sources_[t];
    if (source == nullptr)
      source = std::make_unique<FrameSource>(cells_.path.swept, cells_.path.swept->lattice_scale(scale_value(t)));
    return source->homogeneous(cells_.structures.names()[name]);
  }

  const ScalingCells& cells_;
  BigRational a_, b_;
  std::map<BigRational, std::unique_ptr<FrameSource>> sources_;
};

}  // namespace

Result<PlanarSum> common_set(const ScalingCells& cells, const PlanarSum& first, const BigRational& a,
                             const BigRational& b) {
  const auto cell_of = [&](const BigRational& t, bool after) {
    std::uint32_t cell = 0;
    for (const ScaleEvent& e : cells.events) {
      const BigRational at = exact::exact_value(e.parameter) * cells.unit;
      if (at > t || (at == t && !after)) break;
      ++cell;
    }
    return cell;
  };
  const std::uint32_t first_cell = cell_of(a, true), last_cell = std::max(first_cell, cell_of(b, false));
  PositionsAtEnds positions(cells, a, b);
  ExactRings passed;
  for (const LivingEdge& edge : edges_in(cells.structures, first_cell, last_cell))
    passed.add_quadrangle({positions.begin(edge.first_cell, edge.from), positions.begin(edge.first_cell, edge.to),
                           positions.end(edge.last_cell, edge.to), positions.end(edge.last_cell, edge.from)});
  BooleanTerms terms;
  append_difference(terms_of_parts(first), std::move(passed).terms(), terms);
  return evaluate(std::move(terms), of_semantics(Semantics::regular));
}

}  // namespace dymsum::planar
