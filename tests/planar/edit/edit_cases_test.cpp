// Edits with known answers: undone, refused, far away, at a distance, degenerate.
#include <gtest/gtest.h>

#include <array>
#include <numeric>
#include <span>

#include "dymsum/shapes.h"
#include "planar/edit/edited_same.h"
#include "planar/edit/region_edits.h"

namespace dymsum {
namespace {

using namespace edit_tests;

constexpr MovingOperand kP = MovingOperand::p, kQ = MovingOperand::q;

EditOptions updates() {
  EditOptions options;
  options.mode = FrameMode::window;
  return options;
}

std::string compared(const EditableSum& sum, const EditOptions& options = updates()) {
  return difference(sum.sum(), fresh_sum(sum.p(), sum.q(), options), false);
}

TEST(EditCases, undo_and_redo_restore_the_identical_state) {
  EditableSum sum =
      EditableSum::create(shapes::random_polygon(60, 2, 5), shapes::noisy_star(20, 0.6, 4), updates()).value();
  struct State {
    PlanarSum sum;
    RegionData p, q;
    std::vector<std::uint64_t> p_names, q_names;
    std::uint64_t hash;
  };
  const auto state = [&]() -> State {
    return {sum.sum(), sum.p().data(), sum.q().data(), sum.vertex_names(kP), sum.vertex_names(kQ), sum.hash()};
  };
  std::vector<State> states{state()};
  oracles::Random random(3);
  while (states.size() < 40) {
    const Result<FrameChanges> made = sum.edit(random_edit(random, sum, {0.1, 0}));
    if (made) states.push_back(state());
  }
  const auto expect_state = [&](const State& was) {
    EXPECT_EQ(difference(sum.sum(), was.sum, true), "");
    EXPECT_EQ(sum.p().data(), was.p);
    EXPECT_EQ(sum.q().data(), was.q);
    EXPECT_EQ(sum.vertex_names(kP), was.p_names);
    EXPECT_EQ(sum.vertex_names(kQ), was.q_names);
    EXPECT_EQ(sum.hash(), was.hash);
  };
  for (std::size_t k = states.size() - 1; k-- > 0;) {
    ASSERT_TRUE(sum.undo().ok());
    expect_state(states[k]);
  }
  EXPECT_EQ(sum.undo_count(), 0u);
  EXPECT_EQ(sum.undo().error().code, ErrorCode::out_of_range);
  for (std::size_t k = 1; k < states.size(); ++k) {
    ASSERT_TRUE(sum.redo().ok());
    expect_state(states[k]);
  }
  EXPECT_EQ(sum.redo().error().code, ErrorCode::out_of_range);
}

TEST(EditCases, both_operands_may_be_one_region) {
  const Region disc = shapes::disc(9, 1);
  EditableSum sum = EditableSum::create(disc, disc, updates()).value();
  EXPECT_EQ(compared(sum), "");
  ASSERT_TRUE(sum.edit(Edit::move(kQ, 0, {1.25, 0.25})).ok());
  EXPECT_EQ(sum.p(), disc);
  EXPECT_EQ(compared(sum), "");
}

Region region_of(std::vector<Ring> outer) {
  RegionData data;
  for (Ring& ring : outer) data.parts.push_back({std::move(ring), {}});
  return Region::create(std::move(data)).value();
}

// Regular sums list no tight features, and their rings are joined anew where these show all the same.
TEST(EditCases, a_regular_sum_in_which_a_tight_feature_shows) {
  EditOptions regular = updates();
  regular.semantics = Semantics::regular;
  EditableSum sum = EditableSum::create(region_of({{{2, 3}, {6, 0}, {6, 3}, {1, 6}, {1, 3}}}),
                                        region_of({{{4, 1}, {1, 4}, {3, 1}, {1, 0}, {4, 0}}}), regular)
                        .value();
  ASSERT_TRUE(sum.edit(Edit::insert(kQ, 2, {1, 3})).ok());
  EXPECT_EQ(sum.sum().parts.size(), 1u);
  EXPECT_EQ(compared(sum, regular), "");
}

TEST(EditCases, a_vertex_that_comes_to_lie_on_an_edge_cuts_it) {
  EditableSum sum = EditableSum::create(region_of({{{2, 4}, {0, 4}, {3, 2}}, {{5, 2}, {4, 4}, {4, 0}}}),
                                        region_of({{{3, 4}, {4, 5}, {2, 5}, {2, 4}, {1, 3}, {3, 1}}}), updates())
                        .value();
  const std::vector<Edit> edits{Edit::move(kP, 2, {2, 1}), Edit::move(kQ, 3, {3, 3})};
  ASSERT_TRUE(sum.edit(edits).ok());
  EXPECT_FALSE(sum.q().touching_points().empty());
  EXPECT_EQ(compared(sum), "");
}

TEST(EditCases, refused_edits_give_the_evidence_of_create_and_change_nothing) {
  EditableSum sum = EditableSum::create(shapes::random_polygon(30, 2, 5), shapes::disc(8, 0.1), updates()).value();
  oracles::Random random(9);
  const std::uint64_t hash = sum.hash();
  const Region p = sum.p();
  int refused = 0;
  for (int k = 0; k < 300; ++k) {
    const Edit edit = Edit::move(kP, static_cast<std::uint32_t>(random.below(static_cast<int>(p.vertex_count()))),
                                 {random.signed_unit(), random.signed_unit()});
    planar::EditedData edited{p.data(), {planar::VertexOrigins(p.vertex_count()), {}}};
    std::iota(edited.changes.origins.begin(), edited.changes.origins.end(), 0u);
    ASSERT_TRUE(planar::apply(edit, edited).ok());
    const Result<Region> whole = Region::create(edited.data);
    const Result<FrameChanges> made = sum.edit(edit);
    ASSERT_EQ(made.ok(), whole.ok()) << k;
    if (made) {
      ASSERT_TRUE(sum.undo().ok());
      continue;
    }
    ++refused;
    EXPECT_EQ(made.error(), whole.error());
    EXPECT_EQ(sum.p().data(), p.data());
  }
  EXPECT_EQ(sum.hash(), hash);
  EXPECT_GT(refused, 50);
  EXPECT_EQ(sum.edit(Edit::move(kQ, 99, {0, 0})).error().code, ErrorCode::out_of_range);
  EXPECT_EQ(sum.edit(Edit::remove_part(kQ, 1)).error().code, ErrorCode::out_of_range);
  EXPECT_EQ(sum.edit(Edit::remove_hole(kQ, 0, 0)).error().code, ErrorCode::out_of_range);
  const std::array both{Edit::move(kP, 0, p.parts()[0].outer[0]), Edit::move(kQ, 99, {0, 0})};
  EXPECT_FALSE(sum.edit(both).ok());
  EXPECT_EQ(sum.hash(), hash);
}

TEST(EditCases, a_step_without_edits_is_none) {
  EditableSum sum = EditableSum::create(shapes::disc(9, 1), shapes::disc(5, 0.5), updates()).value();
  ASSERT_TRUE(sum.edit(Edit::move(kQ, 0, {1.25, 0.25})).ok());
  ASSERT_TRUE(sum.undo().ok());
  const std::uint64_t hash = sum.hash();
  ASSERT_TRUE(sum.edit(std::span<const Edit>()).ok());
  EXPECT_EQ(sum.hash(), hash);
  EXPECT_EQ(sum.undo_count(), 0u);
  EXPECT_EQ(sum.redo_count(), 1u);
  ASSERT_TRUE(sum.redo().ok());
  EXPECT_EQ(compared(sum), "");
}

TEST(EditCases, a_triangle_may_lose_a_vertex_and_gain_another_in_one_step) {
  EditableSum sum = EditableSum::create(region_of({{{0, 0}, {4, 0}, {0, 3}}}), shapes::disc(5, 0.5), updates()).value();
  EXPECT_EQ(sum.edit(Edit::remove(kP, 1)).error().code, ErrorCode::too_few_vertices);
  const std::array all{Edit::remove(kP, 2), Edit::remove(kP, 1), Edit::remove(kP, 0)};
  EXPECT_EQ(sum.edit(all).error().code, ErrorCode::out_of_range);
  const std::array other{Edit::remove(kP, 2), Edit::remove(kP, 1), Edit::insert(kP, 0, {5, 1}),
                         Edit::insert(kP, 1, {1, 4})};
  ASSERT_TRUE(sum.edit(other).ok());
  EXPECT_EQ(sum.p().parts()[0].outer, (Ring{{0, 0}, {5, 1}, {1, 4}}));
  EXPECT_EQ(compared(sum), "");
  ASSERT_TRUE(sum.undo().ok());
  EXPECT_EQ(compared(sum), "");
}

TEST(EditCases, vertices_of_polylines_and_points_are_only_moved) {
  RegionData data;
  data.polylines.push_back({{0, 0}, {1, 0}, {1, 1}});
  data.points.push_back({3, 3});
  EditableSum sum =
      EditableSum::create(Region::create(std::move(data)).value(), shapes::disc(5, 0.5), updates()).value();
  for (const Edit& edit : {Edit::insert(kP, 0, {0.5, 0.5}), Edit::remove(kP, 1), Edit::remove(kP, 3),
                           Edit::invert(kP, 1), Edit::extrude(kP, 0, 1, {0, 1})}) {
    const auto made = sum.edit(edit);
    ASSERT_FALSE(made.ok());
    EXPECT_EQ(made.error().code, ErrorCode::out_of_range);
    EXPECT_NE(made.error().message.find("is a point or on a polyline, and can only be moved"), std::string::npos);
  }
  ASSERT_TRUE(sum.edit(Edit::move(kP, 1, {2, 0})).ok());
  EXPECT_EQ(compared(sum), "");
}

TEST(EditCases, an_edit_that_does_not_show_does_nothing_again) {
  // The small hole is filled by Q: nothing of it is in the convolution.
  RegionData data = shapes::noisy_star(60, 0.2, 1).data();
  data.parts[0].holes.push_back({{0, 0}, {0, 0.01}, {0.01, 0.01}, {0.01, 0}});
  EditableSum sum =
      EditableSum::create(Region::create(data).value(), shapes::noisy_star(40, 0.5, 2), updates()).value();
  const std::uint64_t hash = sum.hash();
  const Result<FrameChanges> changes = sum.edit(Edit::move(kP, 62, {0.012, 0.011}));
  ASSERT_TRUE(changes.ok());
  EXPECT_FALSE(sum.work().rebuilt);
  EXPECT_EQ(sum.work().segments_removed, 0u);
  EXPECT_EQ(sum.work().segments_added, 0u);
  EXPECT_EQ(sum.work().events_changed, 0u);
  EXPECT_EQ(sum.work().loops_traced, 0u);
  EXPECT_TRUE(changes->rings.empty());
  EXPECT_EQ(sum.hash(), hash);
  EXPECT_EQ(compared(sum), "");
}

// A frame with a tongue of a given length into its hole, and a square that fits beside it or not.
EditableSum tongue(double length) {
  const Ring outer{{0, 0}, {20, 0}, {20, 20}, {0, 20}};
  const Ring hole{{5, 5}, {5, 7}, {5 + length, 7}, {5 + length, 13}, {5, 13}, {5, 15}, {15, 15}, {15, 5}};
  const Region p = Region::create({{{outer, {hole}}}, {}, {}}).value();
  return EditableSum::create(p, shapes::rectangle(0, 0, 4, 4), updates()).value();
}

FrameChanges reach_to(EditableSum& sum, double length) {
  const std::array both{Edit::move(kP, 6, {5 + length, 7}), Edit::move(kP, 7, {5 + length, 13})};
  return sum.edit(both).value();
}

TEST(EditCases, a_hole_opens_and_closes_where_nothing_was_edited) {
  EditableSum sum = tongue(8);
  EXPECT_EQ(sum.sum().hole_count(), 0u);
  const FrameChanges opened = reach_to(sum, 1);
  EXPECT_FALSE(sum.work().rebuilt);
  EXPECT_EQ(sum.sum().hole_count(), 1u);
  EXPECT_TRUE(opened.topology);
  EXPECT_EQ(compared(sum), "");
  reach_to(sum, 8);
  EXPECT_FALSE(sum.work().rebuilt);
  EXPECT_EQ(sum.sum().hole_count(), 0u);
  EXPECT_EQ(compared(sum), "");
}

// A square fits into a chamber with room to spare; a needle in a channel below it reaches in, or not. All edges around
// the positions that are free without the needle stay as they are, and nothing of the needle crosses them.
TEST(EditCases, a_hole_opens_and_closes_whose_edges_all_stay) {
  const auto at = [](double x, double y) { return Point{x, y}; };
  const Ring outer{{-10, -10}, {15, -10}, {15, 15}, {-10, 15}};
  const Ring chamber{{0, 0},    {0, 5},   {5, 5},    {5, 0},     {3, 0},  {3, -3},
                     {2.5, -3}, {2.5, 2}, {2.25, 2}, {2.25, -3}, {2, -3}, {2, 0}};
  const Region p = Region::create({{{outer, {chamber}}}, {}, {}}).value();
  EditableSum sum = EditableSum::create(p, shapes::rectangle(0, 0, 4, 4), updates()).value();
  EXPECT_EQ(sum.sum().hole_count(), 0u);
  const std::array out{Edit::move(kP, 11, at(2.5, -2)), Edit::move(kP, 12, at(2.25, -2))};
  const std::array in{Edit::move(kP, 11, at(2.5, 2)), Edit::move(kP, 12, at(2.25, 2))};
  for (int k = 0; k < 3; ++k) {
    const FrameChanges opened = sum.edit(out).value();
    EXPECT_EQ(sum.sum().hole_count(), 1u);
    EXPECT_TRUE(opened.topology);
    EXPECT_FALSE(sum.work().rebuilt);
    EXPECT_EQ(sum.work().loops_traced, 0u);
    EXPECT_EQ(compared(sum), "");
    const FrameChanges closed = sum.edit(in).value();
    EXPECT_EQ(sum.sum().hole_count(), 0u);
    EXPECT_EQ(closed.rings.size(), 1u);
    EXPECT_EQ(compared(sum), "");
  }
}

TEST(EditCases, exact_fits_show_and_go) {
  EditableSum sum = tongue(8);
  const FrameChanges fits = reach_to(sum, 6);  // 4 are left beside the tongue
  EXPECT_EQ(fits.tight_segments, 1);
  EXPECT_TRUE(sum.work().degenerate);
  EXPECT_EQ(compared(sum), "");
  reach_to(sum, 6.25);
  EXPECT_EQ(sum.sum().tight_segments.size(), 0u);
  EXPECT_EQ(compared(sum), "");
  for (const double length : {6.0, 5.75, 6.0, 2.0, 6.5}) {
    reach_to(sum, length);
    EXPECT_EQ(compared(sum), "") << length;
  }
}

TEST(EditCases, vertices_come_and_go_on_lines) {
  EditableSum sum = tongue(3);
  const auto count = sum.sum().vertex_count();
  ASSERT_TRUE(sum.edit(Edit::insert(kP, 0, {10, 0})).ok());  // collinear
  EXPECT_EQ(sum.sum().vertex_count(), count);
  EXPECT_EQ(compared(sum), "");
  ASSERT_TRUE(sum.edit(Edit::move(kP, 1, {10, 1})).ok());
  EXPECT_EQ(compared(sum), "");
  ASSERT_TRUE(sum.edit(Edit::invert(kP, 1)).ok());
  EXPECT_EQ(compared(sum), "");
  ASSERT_TRUE(sum.edit(Edit::move(kP, 1, {10, 0})).ok());
  EXPECT_EQ(compared(sum), "");
  ASSERT_TRUE(sum.edit(Edit::extrude(kP, 2, 3, {3, 0})).ok());
  EXPECT_EQ(compared(sum), "");
  ASSERT_TRUE(sum.edit(Edit::add_hole(kP, 0, {{16, 1}, {16, 3}, {19, 3}, {19, 1}})).ok());
  EXPECT_EQ(compared(sum), "");
  ASSERT_TRUE(sum.edit(Edit::add_part(kP, {{{30, 0}, {31, 0}, {30, 1}}, {}})).ok());
  EXPECT_EQ(sum.sum().parts.size(), 2u);
  EXPECT_EQ(compared(sum), "");
  ASSERT_TRUE(sum.edit(Edit::remove_hole(kP, 0, 1)).ok());
  ASSERT_TRUE(sum.edit(Edit::remove_part(kP, 1)).ok());
  EXPECT_EQ(compared(sum), "");
}

TEST(EditCases, an_extreme_vertex_moves_by_an_update) {
  EditableSum sum =
      EditableSum::create(shapes::noisy_star(60, 0.3, 1), shapes::noisy_star(40, 0.5, 2), updates()).value();
  std::uint32_t leftmost = 0;
  for (std::uint32_t v = 0; v < 60; ++v)
    if (vertex_at(sum.p(), v).x < vertex_at(sum.p(), leftmost).x) leftmost = v;
  const Point at = vertex_at(sum.p(), leftmost);
  for (const double by : {0.01, -0.02, 0.03}) {
    ASSERT_TRUE(sum.edit(Edit::move(kP, leftmost, {at.x + by, at.y})).ok());
    EXPECT_FALSE(sum.work().rebuilt);
    EXPECT_EQ(difference(sum.sum(), fresh_sum(sum.p(), sum.q(), updates()), true), "");
  }
  const PlanarSum held = sum.sum();  // what refers to operands keeps them as they were
  const PlanarSum fresh = fresh_sum(sum.p(), sum.q(), updates());
  for (int k = 0; k < 4; ++k) ASSERT_TRUE(sum.edit(Edit::move(kP, leftmost, {at.x + 0.01 * k, at.y})).ok());
  EXPECT_EQ(held, fresh);
  for (std::size_t i = 0; i < held.parts[0].outer.vertices.size(); ++i)
    EXPECT_EQ(held.exact(held.parts[0].outer.vertices[i]), fresh.exact(fresh.parts[0].outer.vertices[i]));
}

TEST(EditCases, names_of_vertices_last) {
  EditableSum sum = tongue(3);
  const std::vector<std::uint64_t> before = sum.vertex_names(kP);
  const std::array edits{Edit::insert(kP, 0, {19, -1}), Edit::remove(kP, 2)};
  ASSERT_TRUE(sum.edit(edits).ok());
  const std::vector<std::uint64_t>& after = sum.vertex_names(kP);
  ASSERT_EQ(after.size(), before.size());
  EXPECT_EQ(after[0], before[0]);
  EXPECT_EQ(std::count(before.begin(), before.end(), after[1]), 0);
  for (std::size_t v = 2; v < before.size(); ++v) EXPECT_EQ(after[v], before[v]);
  ASSERT_TRUE(sum.undo().ok());
  EXPECT_EQ(sum.vertex_names(kP), before);
}

}  // namespace
}  // namespace dymsum
