// What a single event changes, as a plan: against the edit that the geometry requests and, applied, against the slice
// from scratch just after the event.
#include "cspace/obstacle/event_plan.h"

#include <map>

#include "cspace/obstacle/event_windows.h"
#include "cspace/obstacle/obstacle_slices.h"
#include "cspace/obstacle/slice_reader.h"
#include "cspace/obstacle/tight_events.h"
#include "dymsum/shapes.h"
#include "oracles/random.h"
#include "oracles/snapped_shapes.h"
#include "planar/motion/operand_pair.h"
#include "planar/motion/orientation.h"

namespace dymsum::planar {
namespace {

using namespace testing_obstacles;
using testing_obstacles::reversed;
using Ids = std::vector<std::uint32_t>;
using Verdict = EventPlan::Verdict;

std::vector<Ids> canonical_ids(std::vector<Ids> loops) {
  for (Ids& loop : loops) {
    Ids best = loop;
    for (std::size_t k = 0; k < loop.size(); ++k) {
      std::rotate(loop.begin(), loop.begin() + 1, loop.end());
      best = std::min(best, loop);
    }
    loop = best;
  }
  std::sort(loops.begin(), loops.end());
  return loops;
}

std::vector<Ids> boundary_loops(const BoundaryGraph& graph) {
  std::vector<Ids> loops;
  std::set<std::uint32_t> seen;
  for (const std::uint32_t first : graph.alive()) {
    if (seen.count(first) != 0) continue;
    Ids& loop = loops.emplace_back();
    for (std::uint32_t n = first; seen.insert(n).second; n = graph[n].next) loop.push_back(graph[n].id);
  }
  return canonical_ids(std::move(loops));
}

/// A pair, and everything that may happen while the robot turns: no event is left out.
struct Turning {
  std::shared_ptr<const OperandPair> base;
  TurningForms forms;
  RotationCatalog catalog{forms};
  EventWindows windows{forms, catalog, true};
  SliceReader reader{forms, base};
  Turning(const Region& robot, const Region& obstacle)
      : base(pair_of_regions(obstacle, robot, PairOptions{.moved = 1, .reflect_q = true}).value()), forms(*base) {}

  std::vector<Ids> slice(const Orientation& at) const {
    std::vector<Ids> loops;
    for (const SliceLoop& loop : reader.loops(at)) loops.push_back(loop.segments);
    return canonical_ids(std::move(loops));
  }
  BoundaryGraph graph_at(const Orientation& at) const {
    BoundaryGraph graph{SegmentIndex(forms.size(0), forms.size(1))};
    graph.apply(slice_difference(graph, reader.loops(at), [](std::uint32_t) { return false; }));
    graph.begin_angle();
    graph.set_angle(0);
    return graph;
  }
};

/// All events at one angle, inside a window, with orientations between it and the angles beside it.
struct Moment {
  const Turning& turning;
  EventGroup events;
  RotationRange range;
  const OverlapFilter& filter;
  Orientation before, after;
};

template <class F>
void for_each_moment(const Turning& turning, F&& f) {
  for (int k = 0; k < turning.windows.count(); ++k)
    for (PreparedWindow& p : turning.windows.prepare(k, EventWindows::Halved::where_crowded)) {
      auto& events = p.found.events;
      const auto root = [&](RotationEvent& e) -> const exact::AlgebraicRoot& {
        return exact_root(e, turning.forms, p.range);
      };
      std::sort(events.begin(), events.end(),
                [&](RotationEvent& a, RotationEvent& b) { return exact::compare(root(a), root(b)) < 0; });
      const auto end = exact::AlgebraicRoot::of(p.range.t_high);
      exact::AlgebraicRoot last = exact::AlgebraicRoot::of(p.range.t_low);
      for (std::size_t i = 0, j = 0; i < events.size(); i = j) {
        EventGroup group;
        for (; j < events.size() && exact::compare(root(events[i]), root(events[j])) == 0; ++j)
          group.push_back(&events[j]);
        if (exact::compare(root(events[i]), end) == 0) break;  // at the border of two windows
        const auto between = [&](const exact::AlgebraicRoot& low, const exact::AlgebraicRoot& high) {
          return orientation_at(p.range.chart, exact::between(low, high));
        };
        f(Moment{turning, group, p.range, *p.filter, between(last, root(events[i])),
                 between(root(events[i]), j < events.size() ? root(events[j]) : end)});
        last = root(events[i]);
      }
    }
}

/// What planning may not touch: everything that can be read of a graph.
std::vector<std::array<std::uint32_t, 10>> contents(const BoundaryGraph& graph) {
  std::vector<std::array<std::uint32_t, 10>> all;
  for (const BoundaryGraph::Node& n : graph.nodes())
    all.push_back({n.id, n.prev, n.next, n.left, n.right, n.begin, n.end, n.next_on_segment, n.cell, n.alive});
  return all;
}

/// An edit by indices: of every run its ends and what comes between, of births their segments.
struct EditIds {
  std::vector<Ids> runs, births;
  Ids gone;
  bool loops_may_change = false;
  friend bool operator==(const EditIds&, const EditIds&) = default;
};
EditIds ids_of(const BoundaryEdit& edit, const SegmentIndex& segments) {
  const auto ids = [&](const std::vector<WalkSegment>& along) {
    Ids all;
    for (const WalkSegment& s : along) all.push_back(segments.of(s));
    return all;
  };
  EditIds found{{}, {}, edit.gone, edit.loops_may_change};
  for (const BoundaryEdit::Run& run : edit.runs) {
    found.runs.push_back(ids(run.segments));
    found.runs.back().insert(found.runs.back().begin(), {run.first, run.last});
  }
  for (const auto& loop : edit.births) found.births.push_back(ids(loop));
  return found;
}

/// How often each kind of plan was compared.
struct Compared {
  std::map<std::pair<RotationEvent::Kind, Verdict>, int> plans;
  int births = 0, whole = 0;
};

// Plans all of a moment's events one by one, as the sweep does where they are apart; applied to the slice before they
// are the slice after. A single event is planned twice.
void expect_plans(const Moment& m, Compared& compared) {
  const Turning& t = m.turning;
  BoundaryGraph graph = t.graph_at(m.before);
  const SweepScene scene{t.forms, t.catalog, graph};
  const std::vector<Ids> after = t.slice(m.after);
  std::vector<EventPlan> plans;
  bool whole = false;
  for (const EventGroup& cluster : clusters(m.events, scene)) whole |= cluster.size() > 1;
  for (RotationEvent* event : m.events) {
    const auto unchanged = contents(graph);
    plans.push_back(plan_event(*event, m.range, scene, m.filter));
    ASSERT_EQ(contents(graph), unchanged);
    ASSERT_EQ(ids_of(plans.back().edit, graph.segments()),
              ids_of(plan_event(*event, m.range, scene, m.filter).edit, graph.segments()));
    whole |= plans.back().verdict == Verdict::unsure;
  }
  if (whole) {
    ++compared.whole;
    return;
  }
  for (std::size_t k = 0; k < plans.size(); ++k) {
    const Verdict verdict = plans[k].verdict;
    ++compared.plans[{m.events[k]->kind, verdict}];
    EXPECT_EQ(plans[k].edit.empty(), verdict != Verdict::change);
    if (verdict != Verdict::change) continue;
    // Nothing but the event's own segments.
    const Ids own = segments_of(*m.events[k], scene);
    const auto is_own = [&](std::uint32_t s) { return std::find(own.begin(), own.end(), s) != own.end(); };
    const EditIds ids = ids_of(plans[k].edit, graph.segments());
    for (const Ids& run : ids.runs) EXPECT_TRUE(std::all_of(run.begin() + 2, run.end(), is_own));
    for (const Ids& loop : ids.births) EXPECT_TRUE(std::all_of(loop.begin(), loop.end(), is_own));
    for (const std::uint32_t n : ids.gone) EXPECT_TRUE(is_own(graph[n].id));
    // Later plans of the moment are of disjoint neighbourhoods, but neighbours got new names.
    BoundaryEdit edit = k == 0 ? plans[k].edit : plan_event(*m.events[k], m.range, scene, m.filter).edit;
    std::erase_if(edit.births, [&](const auto& loop) { return !t.reader.is_free(loop, m.after); });
    compared.births += !edit.births.empty();
    graph.apply(edit);
    ASSERT_NO_THROW(graph.check());
  }
  ASSERT_EQ(boundary_loops(graph), after) << "kind " << static_cast<int>(m.events[0]->kind) << " at "
                                          << m.events[0]->theta() << ", " << m.events.size() << " events";
}

TEST(EventPlan, applied_it_is_the_slice_behind_the_event) {
  const Region knife = polygon({{0, 0}, {3, 1}, {1, 2}}), square = shapes::rectangle(-1, -1, 1, 1);
  const std::vector<std::pair<Region, Region>> pairs = {
      {knife, polygon({{0, 0}, {7, 1}, {2, 6}})},
      {knife, polygon({{0, 0}, {8, 0}, {8, 7}, {4, 7}, {4, 3}, {0, 5}})},
      {square, polygon({{0, 0}, {9, 0}, {9, 7}, {6, 7}, {6, 4}, {3, 4}, {3, 8}, {0, 8}})},
      {polygon({{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 2}, {0, 2}}), shapes::grate(3, 2, 0.5, 5)},
      {snapped_shapes::star(5, 0.5, 1), snapped_shapes::star(7, 0.4, 2)},
      {snapped_shapes::star(4, 0.5, 1), snapped_shapes::star(4, 0.5, 1)},
      {square, polygon(box(-3, -3, 3, 3), {reversed(box(-1, -1, 1, 1))})},
      {square, polygon(box(-3, -3, 3, 3), {reversed(box(-1.25, -1.25, 1.25, 1.25))})},
      {shapes::rectangle(-1, -1, 1, 1), polygon(box(0, 0, 12, 12), {reversed({{3, 3}, {8, 4}, {4, 6.5}})})},
  };
  Compared compared;
  for_seeds(6, [&](Random& random) {
    const Region robot = random_shape(random, 4, 5, false), obstacle = random_shape(random, 12, 5, true);
    for_each_moment(Turning(robot, obstacle), [&](const Moment& m) {
      if (!testing::Test::HasFatalFailure()) expect_plans(m, compared);
    });
  });
  for (const auto& [robot, obstacle] : pairs)
    for_each_moment(Turning(robot, obstacle), [&](const Moment& m) {
      if (!testing::Test::HasFatalFailure()) expect_plans(m, compared);
    });
  using Kind = RotationEvent::Kind;
  for (const auto& [kind, verdict] : {std::pair{Kind::alignment, Verdict::change},
                                      {Kind::vertex_on_segment, Verdict::change},
                                      {Kind::vertex_on_segment, Verdict::doubtful},
                                      {Kind::three_segments, Verdict::change},
                                      {Kind::overlap, Verdict::change},
                                      {Kind::overlap, Verdict::nothing}})
    EXPECT_GT((compared.plans[{kind, verdict}]), 0) << static_cast<int>(kind) << ' ' << static_cast<int>(verdict);
  EXPECT_GT(compared.births, 0);
  EXPECT_GT(compared.whole, 0);
}

// Triangles: edge e of the robot from the start of edge f, and then f, become f from the start of e, and then e.
TEST(EventPlan, aligned_edges_change_their_order) {
  const Turning turning(polygon({{0, 0}, {3, 1}, {1, 2}}), polygon({{0, 0}, {7, 1}, {2, 6}}));
  int alignments = 0;
  for_each_moment(turning, [&](const Moment& m) {
    RotationEvent& event = *m.events[0];
    if (event.kind != RotationEvent::Kind::alignment) return;
    const BoundaryGraph graph = turning.graph_at(m.before);
    const SegmentIndex& index = graph.segments();
    const EventPlan plan = plan_event(event, m.range, {turning.forms, turning.catalog, graph}, m.filter);
    ASSERT_EQ(plan.verdict, Verdict::change);
    EXPECT_EQ(plan.kind, ObstacleEvent::Kind::alignment);
    const std::uint32_t e = event.e, f = event.f, e1 = (e + 1) % 3, f1 = (f + 1) % 3;
    const std::uint32_t first = graph.first_on({1, e, f}), last = graph.first_on({0, f, e1});
    const EditIds expected{{{first, last, index.of({0, f, e}), index.of({1, e, f1})}}, {}, {first, last}, false};
    EXPECT_EQ(ids_of(plan.edit, index), expected);
    ++alignments;
  });
  EXPECT_EQ(alignments, 9);
}

// The robot's tip stands in a notch one side of which is as long as the tip's, up to roundings: where they are aligned
// doubles do not determine which one is longer, and exact signs do.
TEST(EventPlan, alignments_of_edges_of_nearly_one_length_are_right) {
  oracles::Random random(65);
  Compared compared;
  for (int k = 0; k < 60 && !HasFatalFailure(); ++k) {
    const Point a{1 + 0.1 * random.signed_unit(), 0.2 + 0.1 * random.signed_unit()},
        b{1 + 0.1 * random.signed_unit(), -0.2 + 0.1 * random.signed_unit()};
    const double by = 3 * random.signed_unit();
    const auto turned = [](double angle, Point v) {
      const double c = std::cos(angle), s = std::sin(angle);
      return Point{c * v.x - s * v.y, s * v.x + c * v.y};
    };
    Ring tip{{0, 0}, b, a}, notched{turned(by - 0.5, b), {0, 0}, turned(by + 0.5, a)};
    for (int i = 0; i < 5; ++i) notched.push_back(turned(by + 0.7 + 1.2 * i, {4, 0}));
    for (Ring* ring : {&tip, &notched})  // so that differences are rounded
      for (const Point off{random.signed_unit(), random.signed_unit()}; Point & v : *ring) v.x += off.x, v.y += off.y;
    for_each_moment(Turning(polygon(tip), polygon(notched)), [&](const Moment& m) {
      if (m.events[0]->kind == RotationEvent::Kind::alignment && !HasFatalFailure()) expect_plans(m, compared);
    });
  }
  EXPECT_GT((compared.plans[{RotationEvent::Kind::alignment, Verdict::change}]), 100);
  EXPECT_EQ(compared.whole, 0);
}

/// An L whose notch a bar of width 2 dips into, and what is planned at the first angle after `theta`.
struct BarInNotch {
  Turning turning{polygon({{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 2}, {0, 2}}), shapes::rectangle(0, 0, 2, 5)};
  EventPlan plan;
  EditIds ids, expected;
  explicit BarInNotch(RotationEvent::Kind kind, double theta, const std::vector<WalkSegment>& before,
                      const std::vector<WalkSegment>& after) {
    for_each_moment(turning, [&](const Moment& m) {
      if (m.events.size() != 1 || m.events[0]->kind != kind || std::abs(m.events[0]->theta() - theta) > 1e-9) return;
      const BoundaryGraph graph = turning.graph_at(m.before);
      plan = plan_event(*m.events[0], m.range, {turning.forms, turning.catalog, graph}, m.filter);
      ids = ids_of(plan.edit, graph.segments());
      expected = {};
      for (const WalkSegment& s : before) expected.gone.push_back(graph.first_on(s));
      expected.runs = {{expected.gone.front(), expected.gone.back()}};
      for (const WalkSegment& s : after) expected.runs[0].push_back(graph.segments().of(s));
    });
    std::sort(ids.gone.begin(), ids.gone.end());
    std::sort(expected.gone.begin(), expected.gone.end());
  }
};

// The bar's end stands in the notch on the notch's edges 2 and 3, of which the second one is half as long as the bar is
// wide: at 30 degrees the tip 4 reaches the bar's end, and edge 3 touches nothing any more.
TEST(EventPlan, a_vertex_on_a_segment_ends_what_lay_between) {
  const BarInNotch bar(RotationEvent::Kind::vertex_on_segment, std::numbers::pi / 6, {{1, 2, 1}, {1, 3, 0}, {0, 0, 4}},
                       {{1, 2, 1}, {0, 0, 4}});
  EXPECT_EQ(bar.plan.verdict, Verdict::change);
  EXPECT_EQ(bar.plan.kind, ObstacleEvent::Kind::vertex_on_segment);
  EXPECT_EQ(bar.ids, bar.expected);
}

// Both tips of the L, 2 and 4, lie on one side of the bar. On either side of that angle another corner of the bar dips
// between them.
TEST(EventPlan, parallel_segments_pass_over_each_other) {
  const BarInNotch bar(RotationEvent::Kind::overlap, -std::atan(2.0), {{0, 3, 2}, {1, 3, 3}, {0, 3, 4}},
                       {{0, 3, 2}, {1, 2, 0}, {0, 3, 4}});
  EXPECT_EQ(bar.plan.verdict, Verdict::change);
  EXPECT_EQ(bar.ids, bar.expected);
}

// A square fits into a triangular hole at some angles. What is free there begins and ends with three contacts.
TEST(EventPlan, three_segments_bear_and_close_a_hole) {
  const Turning turning(shapes::rectangle(-1, -1, 1, 1),
                        polygon(box(0, 0, 12, 12), {reversed({{3, 3}, {8, 4}, {4, 6.5}})}));
  int born = 0, closed = 0;
  for_each_moment(turning, [&](const Moment& m) {
    RotationEvent& event = *m.events[0];
    if (event.kind != RotationEvent::Kind::three_segments || m.events.size() != 1) return;
    const BoundaryGraph graph = turning.graph_at(m.before);
    const EventPlan plan = plan_event(event, m.range, {turning.forms, turning.catalog, graph}, m.filter);
    if (plan.verdict != Verdict::change) return;
    EXPECT_EQ(plan.kind, ObstacleEvent::Kind::three_segments);
    EXPECT_TRUE(plan.edit.runs.empty());
    Ids own = segments_of(event, {turning.forms, turning.catalog, graph}), named;
    if (plan.edit.gone.empty()) {
      ASSERT_EQ(plan.edit.births.size(), 1U);
      for (const WalkSegment& s : plan.edit.births[0]) named.push_back(graph.segments().of(s));
      born += turning.reader.is_free(plan.edit.births[0], m.after);
    } else {
      EXPECT_TRUE(plan.edit.births.empty());
      EXPECT_TRUE(plan.edit.loops_may_change);
      for (const std::uint32_t n : plan.edit.gone) named.push_back(graph[n].id);
      ++closed;
    }
    std::sort(own.begin(), own.end());
    std::sort(named.begin(), named.end());
    EXPECT_EQ(named, own);
  });
  EXPECT_EQ(born, 8);
  EXPECT_EQ(closed, 8);
}

/// What is found to be tight at the angles of a pair, and how many of them have events that coincide.
struct TightMoments {
  std::vector<std::pair<Point, Point>> held;
  int coincident = 0;
  TightMoments(const Region& robot, const Region& obstacle) {
    const Turning turning(robot, obstacle);
    for_each_moment(turning, [&](const Moment& m) {
      BoundaryGraph graph = turning.graph_at(m.before);
      const SweepScene scene{turning.forms, turning.catalog, graph};
      for (const EventGroup& cluster : clusters(m.events, scene))
        if (cluster.size() > 1) {
          ++coincident;
          break;
        }
      graph.apply(slice_difference(graph, turning.reader.loops(m.after), [](std::uint32_t) { return false; }));
      ASSERT_EQ(boundary_loops(graph), turning.slice(m.after));
      AngleNow now(turning.forms);
      now.begin(m.events[0]->theta(), nullptr);
      now.set_exact({m.range.chart, exact_root(*m.events[0], turning.forms, m.range)}, m.events[0]->theta());
      const auto unchanged = contents(graph);
      const TightFindings found = tight_at_events(m.events, {}, scene, now, m.filter);
      EXPECT_EQ(contents(graph), unchanged);
      for (const auto& [from, to] : found.held) held.emplace_back(from.near, to.near);
    });
  }
};

// A square in its exact cavity, once for each of its sides, and a plate in a slot of its width and half its length
// longer, either way round; they are turned by the angle of a triangle of sides 3, 4 and 5.
TEST(EventPlan, what_coincides_is_a_whole_slice_and_what_is_tight_is_found_at_its_events) {
  const TightMoments square(polygon({{1, -7}, {7, 1}, {-1, 7}, {-7, -1}}),
                            polygon(box(-20, -20, 20, 20), {reversed(box(-5, -5, 5, 5))}));
  EXPECT_EQ(square.coincident, 4);
  ASSERT_EQ(square.held.size(), 4U);
  for (const auto& [from, to] : square.held) EXPECT_TRUE(from == to);
  const TightMoments plate(polygon({{10, 5}, {2, 11}, {-10, -5}, {-2, -11}}),
                           polygon(box(-30, -20, 30, 20), {reversed(box(-15, -5, 15, 5))}));
  ASSERT_EQ(plate.held.size(), 2U);
  for (const auto& [from, to] : plate.held) EXPECT_NEAR(std::abs(from.x - to.x), 10, 1e-9);
}

}  // namespace
}  // namespace dymsum::planar
