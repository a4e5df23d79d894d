#include "spatial/slice/slice_rings.h"

#include <unordered_map>

namespace dymsum::spatial {

namespace {

class Tracer {
 public:
  Tracer(const PlaneCells& cells, const std::function<bool(std::uint32_t)>& taken)
      : cells_(cells), next_(2 * cells.edges.size(), kNoId), inside_(next_.size()), seen_(next_.size()) {
    for (std::uint32_t c = 0; c < cells.cells.size(); ++c) {
      const bool in = taken(c);
      for (std::uint32_t l = cells.cells[c].first_loop; l < cells.cells[c].last_loop; ++l) {
        const std::uint32_t begin = cells.loops[l], end = cells.loops[l + 1];
        for (std::uint32_t k = begin; k < end; ++k) {
          next_[cells.half_edges[k]] = cells.half_edges[k + 1 < end ? k + 1 : begin];
          inside_[cells.half_edges[k]] = in;
        }
      }
    }
  }

  std::vector<std::vector<std::uint32_t>> run() {
    for (std::uint32_t h = 0; h < next_.size(); ++h)
      if (is_boundary(h) && !seen_[h]) follow(h);
    return std::move(rings_);
  }

 private:
  bool is_boundary(std::uint32_t h) const { return inside_[h] && !inside_[h ^ 1]; }

  /// Follows a ring from edge to edge through what is taken at the point between them: the parts that meet there in a
  /// point only stay apart.
  void follow(std::uint32_t start) {
    std::vector<std::uint32_t> path;
    std::unordered_map<PointId, std::size_t> length_at;  // of the path up to a point
    std::uint32_t h = start;
    do {
      const PointId from = start_of(cells_, h);
      if (const auto here = length_at.find(from); here != length_at.end()) cut(path, length_at, here->second);
      length_at[from] = path.size();
      seen_[h] = true;
      path.push_back(h);
      h = next_[h];
      while (!is_boundary(h)) h = next_[h ^ 1];
    } while (h != start);
    rings_.push_back(std::move(path));
  }
  /// A path that comes back to a point leaves a ring of its own.
  void cut(std::vector<std::uint32_t>& path, std::unordered_map<PointId, std::size_t>& length_at, std::size_t first) {
    rings_.emplace_back(path.begin() + static_cast<std::ptrdiff_t>(first), path.end());
    for (const std::uint32_t h : rings_.back()) length_at.erase(start_of(cells_, h));
    path.resize(first);
  }

  const PlaneCells& cells_;
  std::vector<std::uint32_t> next_;
  std::vector<bool> inside_, seen_;
  std::vector<std::vector<std::uint32_t>> rings_;
};

}  // namespace

std::vector<std::vector<std::uint32_t>> rings_around(const PlaneCells& cells,
                                                     const std::function<bool(std::uint32_t)>& taken) {
  return Tracer(cells, taken).run();
}

}  // namespace dymsum::spatial
