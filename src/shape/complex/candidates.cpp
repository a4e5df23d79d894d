#include "shape/complex/candidates.h"

#include <algorithm>
#include <boost/polygon/voronoi.hpp>

#include "shape/complex/rough_numbers.h"
#include "shape/complex/rounded_sites.h"

// Boost.Polygon takes points and segments of any type that says how.
namespace boost::polygon {
template <>
struct geometry_concept<dymsum::shape::RoundedPoint> {
  using type = point_concept;
};
template <>
struct point_traits<dymsum::shape::RoundedPoint> {
  using coordinate_type = std::int32_t;
  static coordinate_type get(const dymsum::shape::RoundedPoint& p, orientation_2d orient) {
    return orient == HORIZONTAL ? p.x : p.y;
  }
};
}  // namespace boost::polygon

namespace dymsum::shape {
namespace {

namespace bp = boost::polygon;
using Diagram = bp::voronoi_diagram<double>;

/// Sites by the cells of a diagram.
class Neighbours {
 public:
  Neighbours(const Walks& walks, const RoundedSites& rounded) : walks_(walks), rounded_(rounded) {
    for (std::uint32_t s = 0; s < walks.sites.size(); ++s) {
      if (!walks.is_edge(s)) vertices_.emplace_back(rounded.points[walks.ends[s].a], s);
    }
    std::sort(vertices_.begin(), vertices_.end());
  }

  template <class Builder>
  Candidates of_segments() {
    Builder builder;
    const std::vector<RoundedSegment>& list = rounded_.segments;
    for (std::size_t i = 0; i < list.size(); ++i) {
      if (i > 0 && list[i].a == list[i - 1].a && list[i].b == list[i - 1].b) {
        inputs_.back().push_back(list[i].site);
        continue;
      }
      inputs_.push_back({list[i].site});
      starts_.push_back(list[i].a);
      ends_.push_back(list[i].b);
      builder.insert_segment(list[i].a.x, list[i].a.y, list[i].b.x, list[i].b.y);
    }
    // Points that no segment ends at.
    std::vector<RoundedPoint> taken(starts_);
    taken.insert(taken.end(), ends_.begin(), ends_.end());
    std::sort(taken.begin(), taken.end());
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
      const RoundedPoint p = vertices_[i].first;
      if ((i > 0 && vertices_[i - 1].first == p) || std::binary_search(taken.begin(), taken.end(), p)) continue;
      inputs_.push_back({});
      starts_.push_back(p);
      ends_.push_back(p);
      builder.insert_point(p.x, p.y);
    }
    return pairs(builder);
  }

  Candidates of_points() {
    std::vector<std::pair<RoundedPoint, std::uint32_t>> points;
    for (std::uint32_t s = 0; s < walks_.sites.size(); ++s) {
      const RoundedPoint a = rounded_.points[walks_.ends[s].a], b = rounded_.points[walks_.ends[s].b];
      points.emplace_back(a, s);
      if (a != b) {
        points.emplace_back(b, s);
        points.emplace_back(RoundedPoint{a.x / 2 + b.x / 2, a.y / 2 + b.y / 2}, s);
      }
    }
    std::sort(points.begin(), points.end());
    bp::voronoi_builder<std::int32_t> builder;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (i > 0 && points[i].first == points[i - 1].first) {
        inputs_.back().push_back(points[i].second);
        continue;
      }
      inputs_.push_back({points[i].second});
      builder.insert_point(points[i].first.x, points[i].first.y);
    }
    all_points_ = true;
    return pairs(builder);
  }

 private:
  template <class Builder>
  Candidates pairs(Builder& builder) {
    Diagram diagram;
    builder.construct(&diagram);
    Candidates out(walks_.sites.size());
    for (const Diagram::edge_type& e : diagram.edges()) {
      if (!e.is_primary() || e.cell() > e.twin()->cell()) continue;
      for (const std::uint32_t s : sites_of(*e.cell())) {
        for (const std::uint32_t j : sites_of(*e.twin()->cell())) {
          if (s == j) continue;
          out[s].push_back(j);
          out[j].push_back(s);
        }
      }
    }
    for (std::vector<std::uint32_t>& list : out) {
      std::sort(list.begin(), list.end());
      list.erase(std::unique(list.begin(), list.end()), list.end());
    }
    return out;
  }

  std::vector<std::uint32_t> sites_of(const Diagram::cell_type& cell) const {
    const std::size_t i = cell.source_index();
    if (all_points_ || cell.contains_segment()) return inputs_[i];
    const bool end = cell.source_category() == bp::SOURCE_CATEGORY_SEGMENT_END_POINT;
    const RoundedPoint p = end ? ends_[i] : starts_[i];
    std::vector<std::uint32_t> out;
    for (auto v = std::lower_bound(vertices_.begin(), vertices_.end(), std::make_pair(p, std::uint32_t{0}));
         v != vertices_.end() && v->first == p; ++v)
      out.push_back(v->second);
    return out;
  }

  const Walks& walks_;
  const RoundedSites& rounded_;
  std::vector<std::pair<RoundedPoint, std::uint32_t>> vertices_;  // vertex sites
  std::vector<std::vector<std::uint32_t>> inputs_;                // of the diagram -> sites
  std::vector<RoundedPoint> starts_, ends_;
  bool all_points_ = false;
};

}  // namespace

Candidates candidates_of(const Walks& walks) {
  const RoundedSites rounded = round_sites(walks, kMostBits);
  Neighbours neighbours(walks, rounded);
  return is_planar(rounded) ? neighbours.of_segments<bp::voronoi_builder<std::int32_t>>() : neighbours.of_points();
}

std::optional<Candidates> rough_candidates_of(const Walks& walks) {
  const RoundedSites rounded = round_sites(walks, rough::kBits);
  if (!is_planar(rounded)) return std::nullopt;
  return Neighbours(walks, rounded).of_segments<rough::Builder>();
}

}  // namespace dymsum::shape
