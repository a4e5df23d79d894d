#include "io/obstacle/obstacle_text.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

#include "cspace/boundary/obstacle_state.h"
#include "cspace/events/walked_rings.h"
#include "dymsum/obstacle_file.h"
#include "io/read_file.h"
#include "planar/motion/orientation.h"

namespace dymsum {

// Every index is looked at, so that a file that is not what was written is refused before anything is asked of it.

namespace {

using Json = nlohmann::json;
using exact::AlgebraicRoot;
using io::array;
using io::demand;
using io::flag;
using io::index;
using io::list;
using io::number;
using io::whole;

std::uint32_t index_or_none(const Json& j, std::size_t count) {
  return j == Patch::kNone ? Patch::kNone : index(j, count);
}

exact::Big coefficient(const Json& j) {
  const std::string& digits = io::text(j);
  const std::size_t sign = digits.starts_with('-') ? 1 : 0;
  demand(digits.size() > sign && digits.find_first_not_of("0123456789", sign) == std::string::npos,
         "a coefficient is a string of digits");
  demand(digits[sign] != '0' || digits.size() == sign + 1, "a coefficient begins with a zero");
  return exact::Big(exact::BigInteger(digits));
}

planar::ExactAngle angle_of(const Json& j) {
  array(j, 8);
  const double low = number(j[1]), high = number(j[2]);
  demand(low >= -1 && low <= high && high <= 1, "an angle is a half tangent between -1 and 1");
  std::vector<exact::Big> coefficients;
  for (const Json& c : list(j[4])) coefficients.push_back(coefficient(c));
  demand(coefficients.size() >= 2 && coefficients.size() <= exact::Polynomial::kMaxDegree + 1,
         "a polynomial has a degree from 1 to 6");
  const exact::Polynomial p(std::move(coefficients));
  const int chart = static_cast<int>(whole(j[0], 2));
  if (low == high) {
    demand(!p.is_zero() && p.sign_at(exact::exact_value(low)) == 0, "an angle is no root of its polynomial");
    return {chart, AlgebraicRoot::of(low)};
  }
  const std::vector<AlgebraicRoot> roots = exact::roots_in(p, low, high);
  return {chart, roots.at(whole(j[3], roots.size()))};
}

class ContentReader {
 public:
  ContentReader(const Json& content, planar::ObstacleState& state) : j_(content), s_(state) {}

  void run() {
    read_angles();
    for (const Json& c : list(j_.at("free_cells"))) {
      array(c, 4);
      s_.cells.push_back({index_or_none(c[0], angles_), index_or_none(c[1], angles_), flag(c[2]),
                          index(c[3], j_.at("free_cells").size())});
    }
    for (const Json& x : list(j_.at("shells"))) {
      array(x, 4);
      demand(x[2].is_number_integer(), "an Euler number is whole");
      s_.shells.push_back(
          {flag(x[0]), index(x[1], Patch::kNone), x[2].get<std::int64_t>(), index(x[3], s_.cells.size())});
    }
    read_patches();
    for (const Json& e : list(j_.at("events"))) {
      array(e, 4);
      s_.events.push_back(
          {static_cast<ObstacleEvent::Kind>(whole(e[0], 4)), index(e[1], angles_), {number(e[2]), number(e[3])}});
    }
    for (const Json& t : list(j_.at("tight"))) {
      array(t, 6);
      demand(number(t[5]) >= 0, "an error is not negative");
      s_.tight.push_back(
          {index(t[0], angles_), {number(t[1]), number(t[2])}, {number(t[3]), number(t[4])}, number(t[5])});
    }
    s_.always_concurrent = flag(j_.at("always_concurrent"));
    s_.touching_cells = pairs(j_.at("touching_cells"), s_.cells.size(), s_.cells.size());
    read_work();
  }

 private:
  void read_angles() {
    for (const Json& j : list(j_.at("angles"))) {
      s_.exact_angles.push_back(angle_of(j));
      const std::size_t n = s_.exact_angles.size();
      demand(n == 1 || planar::compare(s_.exact_angles[n - 2], s_.exact_angles[n - 1]) < 0, "angles are not in order");
      EventAngle angle = planar::event_angle(s_.exact_angles.back());
      const double theta = number(j[5]), low = number(j[6]), high = number(j[7]);
      demand(low <= theta && theta <= high && low <= angle.high && angle.low <= high,
             "an angle is not where its doubles say");
      angle.theta = theta;
      angle.low = low;
      angle.high = high;
      s_.angles.push_back(angle);
    }
    angles_ = s_.angles.size();
  }
  Contact contact(const Json& j, std::size_t at) const {
    const bool fixed = !flag(j[at]);
    return {fixed ? Contact::Kind::edge_of_p : Contact::Kind::edge_of_q,
            index(j[at + 1], planar::walked_vertices(s_.obstacle)),
            index(j[at + 2], planar::walked_vertices(s_.robot))};
  }
  void read_patches() {
    for (const Json& j : list(j_.at("patches"))) {
      array(j, 14);
      Patch p{contact(j, 0), contact(j, 3), contact(j, 6), flag(j[9]), flag(j[10])};
      p.begin = index_or_none(j[11], angles_);
      p.end = index_or_none(j[12], angles_);
      demand((p.begin == Patch::kNone) == (p.end == Patch::kNone), "a patch has one end");
      p.shell = index(j[13], s_.shells.size());
      s_.patches.push_back(p);
    }
    for (const Json& flat : array(j_.at("patch_cells"), s_.patches.size())) {
      s_.patch_cells.push_back(pairs(flat, std::max<std::size_t>(angles_, 1), s_.cells.size()));
      demand(!s_.patch_cells.back().empty(), "a patch has no free cell");
    }
  }
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs(const Json& flat, std::size_t first,
                                                             std::size_t second) const {
    demand(flat.is_array() && flat.size() % 2 == 0, "a list of pairs is expected");
    std::vector<std::pair<std::uint32_t, std::uint32_t>> all;
    for (std::size_t k = 0; k < flat.size(); k += 2)
      all.emplace_back(index(flat[k], first), index(flat[k + 1], second));
    return all;
  }
  void read_work() {
    const Json& j = j_.at("work");
    demand(j.is_array() && (j.size() == 15 || j.size() == 16), "a list has the wrong length");  // with a time, once
    ObstacleWork& w = s_.work;
    std::size_t k = 0;
    for (std::uint64_t* n : {&w.windows, &w.segments, &w.candidate_pairs, &w.candidate_triples, &w.surfaces,
                             &w.potential_events, &w.visible_events, &w.alignments, &w.vertex_events, &w.triple_events,
                             &w.tight_events, &w.local_updates, &w.slices, &w.exact_signs, &w.collision_tests})
      *n = whole(j[k++], ~std::uint64_t{0});
  }

  const Json& j_;
  planar::ObstacleState& s_;
  std::size_t angles_ = 0;
};

Result<CspaceObstacle> obstacle_of(const Json& content) {
  const Result<Region> robot = io::region_of(content.at("robot")), obstacle = io::region_of(content.at("obstacle"));
  if (!robot) return robot.error();
  if (!obstacle) return obstacle.error();
  auto state = planar::start_obstacle(*robot, *obstacle);
  if (!state) return state.error();
  ContentReader(content, **state).run();
  return planar::ObstacleState::finish(std::move(state).value());
}

}  // namespace

Result<CspaceObstacle> parse_obstacle(std::string_view text, std::string_view name_for_errors) {
  std::optional<CspaceObstacle> read;
  const auto use = [&](const Json& content) -> Result<void> {
    Result<CspaceObstacle> made = obstacle_of(content);
    if (!made) return made.error();
    read = *std::move(made);
    return {};
  };
  const Result<void> done = io::read_checked(io::kObstacleFormat, text, name_for_errors, use);
  if (!done) return done.error();
  return *std::move(read);
}

Result<CspaceObstacle> read_obstacle(const std::string& path) {
  const Result<std::string> text = io::read_file(path);
  if (!text) return text.error();
  return parse_obstacle(*text, path);
}

namespace {

using Json = nlohmann::json;

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
