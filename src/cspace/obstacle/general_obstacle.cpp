#include "cspace/obstacle/general_obstacle.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>

#include "base/parallel.h"
#include "cspace/events/quarter_turn.h"
#include "cspace/events/walk_numbers.h"
#include "cspace/obstacle/cut_patches.h"
#include "cspace/obstacle/obstacle_sweep.h"
#include "planar/turning/exact_angle.h"
#include "planar/turning/turn.h"

namespace dymsum::planar {
namespace {

constexpr std::uint32_t kNobody = ObstacleSweep::kNobody;

/// Windows of a half turn, by the number of pairs of an edge and a vertex: fewer sweep too far, more cost too much
/// each. Even, so that quarter turns are between two.
int windows_for(double pairs) { return 2 * std::clamp(static_cast<int>(std::ceil(0.4 * std::sqrt(pairs))), 8, 256); }
int cells_for(double pairs) { return std::clamp(static_cast<int>(2.25 * std::sqrt(pairs)), 24, 160); }

/// All pairs of them are looked at for every window. Less than all edges of a star leave whole sectors of the sum
/// without dead cells.
constexpr std::size_t kLongEdges = 96;

/// Twice the area by the perimeter: how wide a bar, or a comb's teeth, are.
double thickness(const TurningForms& forms, std::uint32_t op) {
  const Operand& o = forms.operand(op);
  double area2 = 0, perimeter = 0;
  for (std::uint32_t i = 0; i < o.size(); ++i) {
    const Point a = forms.points(op)[i], b = forms.points(op)[o.next[i]];
    area2 += a.x * b.y - a.y * b.x;
    perimeter += std::hypot(b.x - a.x, b.y - a.y);
  }
  return std::abs(area2) / perimeter;
}

/// Where edges crowd at quarter turns, most pairs are of segments that are covered, but for thin places only: cells
/// there are less than half as wide as the operands are thick, or hardly one would lie inside.
int cells_for_crowd(const TurningForms& forms, double pairs) {
  const double thin = std::min(thickness(forms, 0), thickness(forms, 1));
  const int usual = cells_for(pairs);
  return thin > 0 ? std::max(usual, static_cast<int>(std::min(640.0, 2.5 * forms.span() / thin))) : usual;
}

// By theta in (-pi, pi]: the sweep runs from -pi / 2 to 3 pi / 2.
struct AngleOrder {
  std::vector<std::uint32_t> number;  ///< of the sweep's angles
  explicit AngleOrder(const std::vector<ExactAngle>& angles) : number(angles.size()) {
    std::uint32_t behind = 0;
    const auto passes_pi = [&](const ExactAngle& a) {
      return a.chart == 1 && exact::compare(a.t, exact::BigRational(0)) > 0;
    };
    for (const ExactAngle& a : angles) behind += passes_pi(a);
    std::uint32_t first = behind, wrapped = 0;
    for (std::size_t k = 0; k < angles.size(); ++k) number[k] = passes_pi(angles[k]) ? wrapped++ : first++;
  }
  std::uint32_t of(std::uint32_t k) const { return k == kNobody ? kNobody : number[k]; }
};

class Export {
 public:
  Export(const ObstacleSweep& sweep, const TurningForms& forms, planar::ObstacleState& state)
      : sweep_(sweep),
        forms_(forms),
        state_(state),
        order_(sweep.angles),
        edge_ends_{EdgeEnds(state.obstacle, state.base->operands[0]), EdgeEnds(state.robot, state.base->operands[1])} {}

  void run() {
    add_angles();
    if (state_.robot.touching_points().empty() && state_.obstacle.touching_points().empty()) add_patches();
    else add_cut_patches();
    add_cells();
    add_shells();
    for (ObstacleEvent event : sweep_.events) {
      event.angle = order_.of(event.angle);
      state_.events.push_back(event);
    }
    for (TightFeature feature : sweep_.tight) {
      feature.angle = order_.of(feature.angle);
      state_.tight.push_back(feature);
    }
    std::stable_sort(state_.tight.begin(), state_.tight.end(),
                     [](const TightFeature& a, const TightFeature& b) { return a.angle < b.angle; });
    std::stable_sort(state_.events.begin(), state_.events.end(),
                     [](const ObstacleEvent& a, const ObstacleEvent& b) { return a.angle < b.angle; });
  }

 private:
  void add_angles() {
    state_.angles.resize(sweep_.angles.size());
    std::vector<const ExactAngle*> sorted(sweep_.angles.size());
    for (std::uint32_t k = 0; k < sweep_.angles.size(); ++k) sorted[order_.of(k)] = &sweep_.angles[k];
    for (std::size_t k = 0; k < sorted.size(); ++k) {
      state_.exact_angles.push_back(*sorted[k]);
      state_.angles[k] = event_angle(*sorted[k]);
    }
  }

  Contact contact(std::uint32_t id) const {
    const std::uint32_t n0 = forms_.size(0), n1 = forms_.size(1);
    const Operand &p = state_.base->operands[0], &q = state_.base->operands[1];
    if (id < n0 * n1) return {Contact::Kind::edge_of_p, p.edge_number[id / n1], q.vertex_number[id % n1]};
    const std::uint32_t k = id - n0 * n1;
    return {Contact::Kind::edge_of_q, p.vertex_number[k % n0], q.edge_number[k / n0]};
  }
  WalkSegment segment(std::uint32_t id) const {
    const std::uint32_t n0 = forms_.size(0), n1 = forms_.size(1);
    return id < n0 * n1 ? WalkSegment{0, id / n1, id % n1} : WalkSegment{1, (id - n0 * n1) / n0, (id - n0 * n1) % n0};
  }
  // Whether the second segment follows the first one at an end of both. At a cut, which is no vertex of its edge, they
  // cross.
  bool corner(std::uint32_t first, std::uint32_t second) const {
    const WalkSegment a = segment(first), b = segment(second);
    return meet_at_ends(forms_, a, b) && edge_ends_[a.side].ends(a.edge) && edge_ends_[b.side].starts(b.edge);
  }

  void add_patches() {
    const std::vector<ObstacleSweep::Node>& nodes = sweep_.nodes();
    patch_of_.assign(nodes.size(), kNobody);
    for (std::uint32_t n = 0; n < nodes.size(); ++n) {
      // A node that goes on behind the end of the turn belongs to the patch of the one it becomes.
      if (sweep_.continued(n) != n) continue;
      if (nodes[n].begin != kNobody && nodes[n].begin == nodes[n].end) continue;  // came and went at one angle
      patch_of_[n] = static_cast<std::uint32_t>(state_.patches.size());
      Patch patch;
      patch.contact = contact(nodes[n].id);
      patch.left = contact(nodes[n].left);
      patch.right = contact(nodes[n].right);
      patch.left_corner = corner(nodes[n].left, nodes[n].id);
      patch.right_corner = corner(nodes[n].id, nodes[n].right);
      patch.begin = order_.of(nodes[n].begin);
      patch.end = order_.of(nodes[n].end);
      state_.patches.push_back(patch);
      state_.patch_cells.push_back({});
      source_.push_back({n});
    }
    for (std::uint32_t n = 0; n < nodes.size(); ++n) {
      const std::uint32_t to = sweep_.continued(n);
      if (to == n || to == kNobody) continue;
      patch_of_[n] = patch_of_[to];
      Patch& patch = state_.patches[patch_of_[to]];
      patch.begin = order_.of(nodes[n].begin);
      source_[patch_of_[to]].insert(source_[patch_of_[to]].begin(), n);
      if (nodes[to].end == kNobody && nodes[n].begin == kNobody) patch.begin = patch.end = Patch::kNone;
    }
  }

  void add_cut_patches() {
    const ContactNames names{[this](std::uint32_t id) { return contact(id); },
                             [this](std::uint32_t a, std::uint32_t b) { return corner(a, b); }};
    cut_ = cut_patches(sweep_, names);
    for (CutPatch& cut : cut_) {
      cut.patch.begin = order_.of(cut.begin);
      cut.patch.end = order_.of(cut.end);
      state_.patches.push_back(cut.patch);
      state_.patch_cells.push_back({});
      source_.push_back({cut.node});
    }
  }
  // In the order of slabs from the patch's beginning, or from slab 0.
  void add_cells_of_cut_patches(const std::vector<std::uint32_t>& number) {
    for (std::size_t p = 0; p < cut_.size(); ++p) {
      auto& cells = state_.patch_cells[p];
      for (const auto& [angle, cell] : cut_[p].cells)
        cells.emplace_back(sweep_.angles.empty() ? 0 : order_.of(angle), number[cell]);
      if (cut_[p].begin != kNobody) continue;
      std::sort(cells.begin(), cells.end());
      cells.insert(cells.begin(), {0, cells.back().second});
    }
  }

  // Cells at the end of the turn go on as those at its start.
  void add_cells() {
    const std::vector<ObstacleSweep::Node>& nodes = sweep_.nodes();
    std::vector<std::uint32_t> same(sweep_.cells().size());
    for (std::uint32_t c = 0; c < same.size(); ++c) same[c] = c;
    for (std::uint32_t n = 0; n < nodes.size(); ++n)
      if (const std::uint32_t to = sweep_.continued(n); to != n) {
        const std::uint32_t first = nodes[to].cells.empty() ? nodes[to].cell : first_cell(to);
        same[nodes[n].cell] = first;
        component_.emplace_back(nodes[n].cell, first);
      }
    std::vector<std::uint32_t> number(same.size(), kNobody);
    for (std::uint32_t c = 0; c < same.size(); ++c) {
      if (same[c] != c) continue;
      number[c] = static_cast<std::uint32_t>(state_.cells.size());
      const ObstacleSweep::Cell& cell = sweep_.cells()[c];
      state_.cells.push_back({order_.of(cell.begin), order_.of(cell.end), cell.unbounded, 0});
    }
    for (std::uint32_t c = 0; c < same.size(); ++c)
      if (same[c] != c) {
        number[c] = number[same[c]];
        state_.cells[number[c]].begin = order_.of(sweep_.cells()[c].begin);
      }
    number_components(same, number);
    for (const auto& [a, b] : sweep_.touching_cells()) state_.touching_cells.emplace_back(number[a], number[b]);
    if (!cut_.empty()) return add_cells_of_cut_patches(number);
    const auto slab = [&](std::uint32_t angle) {
      if (angle != kNobody) return order_.of(angle);
      return sweep_.angles.empty() ? 0 : order_.of(static_cast<std::uint32_t>(sweep_.angles.size() - 1));
    };
    for (std::size_t p = 0; p < source_.size(); ++p)
      for (const std::uint32_t n : source_[p]) {
        state_.patch_cells[p].emplace_back(slab(nodes[n].begin), number[first_cell(n)]);
        for (const auto& [angle, cell] : nodes[n].cells) state_.patch_cells[p].emplace_back(slab(angle), number[cell]);
      }
  }
  std::uint32_t first_cell(std::uint32_t n) const { return sweep_.first_cell(n); }

  void number_components(const std::vector<std::uint32_t>& same, const std::vector<std::uint32_t>& number) {
    // Joined by the sweep, and by the end of the turn.
    std::vector<std::uint32_t> root(same.size());
    for (std::uint32_t c = 0; c < root.size(); ++c) root[c] = sweep_.component_of(c);
    bool changed = true;
    while (changed) {
      changed = false;
      for (const auto& [a, b] : component_) {
        const std::uint32_t low = std::min(root[a], root[b]), high = std::max(root[a], root[b]);
        if (low == high) continue;
        changed = true;
        for (std::uint32_t& r : root)
          if (r == high) r = low;
      }
    }
    std::map<std::uint32_t, std::uint32_t> names;
    for (std::uint32_t c = 0; c < same.size(); ++c)
      state_.cells[number[c]].component =
          names.emplace(root[c], static_cast<std::uint32_t>(names.size())).first->second;
  }

  void add_shells() {
    std::map<std::uint32_t, std::uint32_t> names;
    for (std::size_t p = 0; p < state_.patches.size(); ++p) {
      const std::uint32_t root = sweep_.shell_of(source_[p].back());
      const auto [it, fresh] = names.emplace(root, static_cast<std::uint32_t>(names.size()));
      if (fresh) state_.shells.push_back({});
      Shell& shell = state_.shells[it->second];
      state_.patches[p].shell = it->second;
      const FreeCell& cell = state_.cells[state_.patch_cells[p].front().second];
      if (fresh) {
        shell.outer = false;
        shell.free_component = cell.component;
      }
      ++shell.patches;
    }
    // A component of free space that reaches infinity somewhere.
    std::vector<std::uint8_t> open;
    for (const FreeCell& c : state_.cells) {
      if (open.size() <= c.component) open.resize(c.component + 1, 0);
      open[c.component] |= c.unbounded;
    }
    for (Shell& shell : state_.shells) shell.outer = open[shell.free_component] != 0;
    for (FreeCell& c : state_.cells) c.unbounded = open[c.component] != 0;
    add_euler(names);
  }

  // Over a range of angles without events a shell is made of tubes, which count nothing. At single events a loop is
  // born or vanishes (1) or splits (-1): a place where a + b tubes end and begin gains 2 - (a + b). Elsewhere limits of
  // the boundary tell.
  void add_euler(const std::map<std::uint32_t, std::uint32_t>& shell_names) {
    const auto by_limits = [&](std::uint32_t angle) {
      return std::binary_search(sweep_.limit_angles().begin(), sweep_.limit_angles().end(), angle);
    };
    const std::vector<ObstacleSweep::Cell>& cells = sweep_.cells();
    const auto count = static_cast<std::uint32_t>(cells.size());
    // A cell at its beginning and at its end: 2 c and 2 c + 1.
    std::vector<std::uint32_t> place(2 * count);
    for (std::uint32_t k = 0; k < place.size(); ++k) place[k] = k;
    const auto find = [&](std::uint32_t k) {
      while (place[k] != k) k = place[k] = place[place[k]];
      return k;
    };
    for (const ObstacleSweep::CellLink& link : sweep_.cell_links()) place[find(2 * link.from + 1)] = find(2 * link.to);
    std::vector<std::uint32_t> shell_of_cell(count, kNobody);
    for (std::uint32_t n = 0; n < sweep_.nodes().size(); ++n) {
      const std::uint32_t shell = shell_names.at(sweep_.shell_of(n));
      shell_of_cell[sweep_.first_cell(n)] = shell;
      for (const auto& [angle, cell] : sweep_.nodes()[n].cells) shell_of_cell[cell] = shell;
    }
    std::map<std::uint32_t, std::pair<std::int64_t, std::uint32_t>> ends;  // place -> tubes that end there, their shell
    for (std::uint32_t c = 0; c < count; ++c)
      for (const bool at_end : {false, true}) {
        const std::uint32_t angle = at_end ? cells[c].end : cells[c].begin;
        if (angle == kNobody || shell_of_cell[c] == kNobody || by_limits(angle)) continue;
        auto& entry = ends[find(2 * c + at_end)];
        ++entry.first;
        entry.second = shell_of_cell[c];
      }
    for (const auto& [at, entry] : ends) state_.shells[entry.second].euler += 2 - entry.first;
    std::vector<std::int64_t> halves(state_.shells.size());
    for (const auto& [node, more] : sweep_.limit_halves()) halves[shell_names.at(sweep_.shell_of(node))] += more;
    for (std::size_t s = 0; s < halves.size(); ++s) state_.shells[s].euler += halves[s] / 2;
  }

  const ObstacleSweep& sweep_;
  const TurningForms& forms_;
  planar::ObstacleState& state_;
  AngleOrder order_;
  std::array<EdgeEnds, 2> edge_ends_;
  std::vector<std::uint32_t> patch_of_;
  std::vector<CutPatch> cut_;                       // where rings touch
  std::vector<std::vector<std::uint32_t>> source_;  // per patch: its nodes in the order of the turn
  std::vector<std::pair<std::uint32_t, std::uint32_t>> component_;
};

TurnRange range_of(int k, int windows) {
  const int chart = k / windows, i = k % windows;
  // Equal angles, rounded to short dyadic tangents.
  const auto end = [&](int j) {
    if (j == 0 || j == windows) return j == 0 ? -1.0 : 1.0;
    return std::nearbyint(std::tan((-0.5 + static_cast<double>(j) / windows) * std::numbers::pi / 2) * 0x1p20) *
           0x1p-20;
  };
  return {chart, end(i), end(i + 1)};
}

/// A window with its events.
struct Prepared {
  TurnRange range;
  std::unique_ptr<TurnWindow> window;
  std::unique_ptr<OverlapFilter> filter;
  TurnEvents found;
  const CrowdedQuarter* at_end = nullptr;  ///< where it ends with one
};

void count(const TurnWindow& window, const TurnEvents& found, ObstacleWork& work) {
  ++work.windows;
  work.segments += window.segments.size();
  work.candidate_pairs += found.pairs;
  work.candidate_triples += found.triples;
  work.potential_events += found.events.size();
}

/// Ranges of angles one after the other, with their windows and events.
class Preparation {
 public:
  Preparation(const TurningForms& forms, const TurnCatalog& catalog, bool reference)
      : forms_(forms),
        catalog_(catalog),
        reference_(reference),
        pairs_(static_cast<double>(forms.size(0)) * forms.size(1)),
        all_(alignments(forms, catalog)) {
    if (!reference) crowded_.emplace(forms, all_);
    grid_.emplace(forms, crowded_ && crowded_->any() ? cells_for_crowd(forms, pairs_) : cells_for(pairs_), kLongEdges);
  }

  int windows() const { return 2 * windows_for(pairs_); }
  /// `halved`: in two parts at least, without asking.
  std::vector<Prepared> range(int i, bool halved) const {
    std::vector<Prepared> parts;
    add(range_of(i, windows() / 2), 0, halved, parts);
    return parts;
  }

 private:
  // Triples grow with the square of the pairs: where segments meet more than some others each, a range is halved.
  // Beside a quarter turn at which much is aligned they do for certain. Fewer than twelve others are mostly real
  // crossings, of which half a range has as many.
  void add(const TurnRange& range, int depth, bool halved, std::vector<Prepared>& parts) const {
    constexpr std::size_t kMost = 12;
    const double middle = std::nearbyint(0.5 * (range.t_low + range.t_high) * 0x1p24) * 0x1p-24;
    const bool divides = depth < 3 && middle > range.t_low && middle < range.t_high;
    const auto halve = [&] {
      add({range.chart, range.t_low, middle}, depth + 1, false, parts);
      add({range.chart, middle, range.t_high}, depth + 1, false, parts);
    };
    if (divides && (halved || beside_crowd(range))) return halve();
    Prepared p;
    p.range = range;
    p.window = std::make_unique<TurnWindow>(*grid_, catalog_, range, !reference_ && pairs_ > 100);
    if (divides && p.window->meetings.size() > kMost * p.window->segments.size()) return halve();
    p.filter = std::make_unique<OverlapFilter>(forms_, *p.window);
    QuarterEnds ends;
    if (crowded_) {
      if (const CrowdedQuarter* low = crowded_->at(range.chart, range.t_low)) ends.low = &low->turn;
      p.at_end = crowded_->at(range.chart, range.t_high);
      if (p.at_end != nullptr) ends.high = &p.at_end->turn;
    }
    p.found = events_in(*p.window, forms_, catalog_, all_, reference_ ? nullptr : p.filter.get(), ends);
    parts.push_back(std::move(p));
  }
  bool beside_crowd(const TurnRange& range) const {
    constexpr double kCrowd = 2;
    const auto crowd = [&](double t) {
      const CrowdedQuarter* quarter = crowded_ ? crowded_->at(range.chart, t) : nullptr;
      return quarter != nullptr && quarter->per_edge > kCrowd;
    };
    return crowd(range.t_low) || crowd(range.t_high);
  }

  const TurningForms& forms_;
  const TurnCatalog& catalog_;
  bool reference_;
  double pairs_;
  std::vector<Alignment> all_;
  std::optional<CrowdedQuarters> crowded_;
  std::optional<TurnGrid> grid_;
};

// Ranges are prepared side by side, some at a time, and passed one after the other. False where that was cancelled.
bool pass_turn(const TurningForms& forms, const TurnCatalog& catalog, ObstacleSweep& sweep, bool reference,
               const Progress& progress) {
  constexpr int kAtATime = 16;
  const Preparation preparation(forms, catalog, reference);
  const int ranges = preparation.windows();
  std::vector<std::vector<Prepared>> some(kAtATime);
  bool started = false, halved = false;
  for (int first = 0; first < ranges; first += kAtATime) {
    if (progress && !progress("angles", static_cast<double>(first) / ranges)) return false;
    const int last = std::min(ranges, first + kAtATime);
    base::parallel_parts(static_cast<std::size_t>(last - first), 0, [&](std::size_t k) {
      some[k] = preparation.range(first + static_cast<int>(k), halved && k > 0);
    });
    // Where all of some ranges had to be halved the next ones will have to be as well; their first one is asked.
    halved = std::all_of(some.begin(), some.begin() + (last - first),
                         [](const std::vector<Prepared>& parts) { return parts.size() > 1; });
    for (int k = 0; k < last - first; ++k)
      for (Prepared& p : some[static_cast<std::size_t>(k)]) {
        count(*p.window, p.found, sweep.work);
        if (!started) sweep.start(p.range, p.found, *p.filter);
        started = true;
        sweep.pass(p.range, std::move(p.found), *p.filter, p.at_end);
      }
    if (last == ranges) sweep.close(*some[static_cast<std::size_t>(last - first - 1)].back().filter);
  }
  return true;
}

std::uint64_t surfaces(const TurningForms& forms, const TurnCatalog& catalog) {
  std::uint64_t n = 0;
  for (std::uint32_t side = 0; side < 2; ++side)
    for (std::uint32_t e = 0; e < forms.size(side); ++e)
      for (std::uint32_t v = 0; v < forms.size(1 - side); ++v) n += catalog.may_exist({side, e, v});
  return n;
}

}  // namespace

Result<bool> general_obstacle(planar::ObstacleState& state, const ObstacleOptions& options) {
  const bool touching = !state.robot.touching_points().empty() || !state.obstacle.touching_points().empty();
  const std::shared_ptr<const OperandPair> base = touching ? numbered_by_walk(*state.base) : state.base;
  const TurningForms forms(*base);
  const TurnCatalog catalog(forms);
  if (static_cast<double>(forms.size(0)) * forms.size(1) > 0x1p27)
    return Error{ErrorCode::unsupported_operand, "more than 2^27 pairs of vertices", {}};
  ObstacleSweep sweep(forms, catalog, base, options.reference);
  sweep.keeps_all_angles = options.reference;
  if (!pass_turn(forms, catalog, sweep, options.reference, options.progress))
    return Error{ErrorCode::cancelled, "stopped on request", {}};
  if (!sweep.closed_turn()) throw std::logic_error("general_obstacle: a full turn does not lead back to its start");
  Export(sweep, forms, state).run();
  state.always_concurrent = sweep.always_concurrent;
  state.work = sweep.work;
  state.work.surfaces = surfaces(forms, catalog);
  for (const ObstacleEvent& e : sweep.events) {
    state.work.alignments += e.kind == ObstacleEvent::Kind::alignment;
    state.work.vertex_events += e.kind == ObstacleEvent::Kind::vertex_on_segment;
    state.work.triple_events += e.kind == ObstacleEvent::Kind::three_segments;
    state.work.tight_events += e.kind == ObstacleEvent::Kind::tight;
  }
  state.work.visible_events = sweep.events.size();
  return true;
}

}  // namespace dymsum::planar
