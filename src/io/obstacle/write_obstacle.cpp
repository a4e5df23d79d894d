#include <stdexcept>

#include "cspace/boundary/obstacle_state.h"
#include "dymsum/obstacle_file.h"
#include "io/obstacle/obstacle_text.h"

namespace dymsum {
namespace {

using Json = nlohmann::json;
using exact::AlgebraicRoot;

// The polynomial, an interval, and which of its roots there; a double is its own interval.
Json angle_json(const planar::ExactAngle& angle, const EventAngle& known) {
  const AlgebraicRoot& t = angle.t;
  Json coefficients = Json::array();
  for (int k = 0; k <= t.polynomial().degree(); ++k) coefficients.push_back(t.polynomial()[k].value().str());
  std::size_t number = 0;
  if (t.low() != t.high()) {
    const std::vector<AlgebraicRoot> roots = exact::roots_in(t.polynomial(), t.low(), t.high());
    while (number < roots.size() && exact::compare(roots[number], t) != 0) ++number;
    if (number == roots.size()) throw std::logic_error("format_obstacle: an angle is no root of its polynomial");
  }
  return Json::array({angle.chart, t.low(), t.high(), number, coefficients, known.theta, known.low, known.high});
}

void add_contact(Json& to, const Contact& c) {
  to.push_back(c.kind == Contact::Kind::edge_of_p ? 0 : 1);
  to.push_back(c.p);
  to.push_back(c.q);
}

Json patch_json(const Patch& p) {
  Json json = Json::array();
  for (const Contact* c : {&p.contact, &p.left, &p.right}) add_contact(json, *c);
  for (const std::uint32_t n : {p.left_corner ? 1u : 0u, p.right_corner ? 1u : 0u, p.begin, p.end, p.shell})
    json.push_back(n);
  return json;
}

Json pairs_json(const std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs) {
  Json flat = Json::array();
  for (const auto& [a, b] : pairs) {
    flat.push_back(a);
    flat.push_back(b);
  }
  return flat;
}

Json work_json(const ObstacleWork& w) {
  return Json::array({w.windows, w.segments, w.candidate_pairs, w.candidate_triples, w.surfaces, w.potential_events,
                      w.visible_events, w.alignments, w.vertex_events, w.triple_events, w.tight_events, w.local_updates,
                      w.slices, w.exact_signs, w.collision_tests});
}

template <class List, class F>
Json list_json(const List& list, F&& f) {
  Json all = Json::array();
  for (const auto& x : list) all.push_back(f(x));
  return all;
}

}  // namespace

std::string format_obstacle(const CspaceObstacle& obstacle) {
  const planar::ObstacleState& s = planar::ObstacleInternals::of(obstacle);
  Json content;
  content["robot"] = io::region_json(s.robot);
  content["obstacle"] = io::region_json(s.obstacle);
  content["angles"] = Json::array();
  for (std::size_t k = 0; k < s.angles.size(); ++k)
    content["angles"].push_back(angle_json(s.exact_angles[k], s.angles[k]));
  content["events"] = list_json(s.events, [](const ObstacleEvent& e) {
    return Json::array({static_cast<int>(e.kind), e.angle, e.at.x, e.at.y});
  });
  content["tight"] = list_json(s.tight, [](const TightFeature& t) {
    return Json::array({t.angle, t.from.x, t.from.y, t.to.x, t.to.y, t.error});
  });
  content["always_concurrent"] = s.always_concurrent ? 1 : 0;
  content["patches"] = list_json(s.patches, patch_json);
  content["shells"] = list_json(s.shells, [](const Shell& x) {
    return Json::array({x.outer ? 1 : 0, x.patches, x.euler, x.free_component});
  });
  content["free_cells"] = list_json(s.cells, [](const FreeCell& c) {
    return Json::array({c.begin, c.end, c.unbounded ? 1 : 0, c.component});
  });
  content["patch_cells"] = list_json(s.patch_cells, pairs_json);
  content["touching_cells"] = pairs_json(s.touching_cells);
  content["work"] = work_json(s.work);
  return io::format_checked(io::kObstacleFormat, content);
}

}  // namespace dymsum
