// Edits of the boundary graph: its invariants hold after every one, and cells and shells follow the loops.
#include "cspace/boundary/boundary_graph.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace dymsum::planar {
namespace {

constexpr std::uint32_t kSize = 4;

WalkSegment segment(std::uint32_t id) { return SegmentIndex(kSize, kSize).segment(id); }

bool nothing_parted(std::uint32_t) { return false; }

/// A graph whose angles are 0, 1, ...; the loops at the start are slices of segments by id.
struct Sweep {
  BoundaryGraph graph{SegmentIndex(kSize, kSize)};
  std::uint32_t angle = 0;

  explicit Sweep(const std::vector<SliceLoop>& loops) { slice(loops); }
  void slice(const std::vector<SliceLoop>& loops) {
    graph.apply(slice_difference(graph, loops, nothing_parted));
    graph.check();
  }
  template <class Edit>
  void at_next_angle(const Edit& edit) {
    graph.begin_angle();
    graph.set_angle(angle++);
    graph.apply(edit);
    graph.check();
  }
  std::uint32_t on(std::uint32_t id) const { return graph.first_on(id); }
  // Of the loop through a node, from it on.
  std::vector<std::uint32_t> loop(std::uint32_t first) const {
    std::vector<std::uint32_t> ids;
    std::uint32_t n = first;
    do ids.push_back(graph[n].id);
    while ((n = graph[n].next) != first);
    return ids;
  }
};

using Ids = std::vector<std::uint32_t>;

// A loop a b c d whose a and c cross: a leads to c, and c to a.
BoundaryEdit crossing(std::uint32_t a, std::uint32_t c, const BoundaryGraph& graph) {
  BoundaryEdit edit;
  edit.runs = {{a, c, {graph[a].segment, graph[c].segment}}, {c, a, {graph[c].segment, graph[a].segment}}};
  edit.gone = {a, c};
  edit.loops_may_change = true;
  return edit;
}

TEST(SegmentIndex, SegmentsAndIndicesAreInverse) {
  const SegmentIndex index(3, 5);
  EXPECT_EQ(index.count(), 30U);
  for (std::uint32_t k = 0; k < index.count(); ++k) {
    const WalkSegment s = index.segment(k);
    EXPECT_LT(s.edge, s.side == 0 ? 3U : 5U);
    EXPECT_LT(s.vertex, s.side == 0 ? 5U : 3U);
    EXPECT_EQ(index.of(s), k);
  }
}

TEST(Partition, ClassesAreNamedByTheirSmallestElement) {
  Partition p(5);
  p.join(4, 2);
  p.join(3, 4);
  EXPECT_EQ(p.find(3), 2U);
  EXPECT_EQ(p.find(0), 0U);
  EXPECT_EQ(p.add(), 5U);
  p.join(5, 0);
  p.join(5, 3);
  for (const std::uint32_t k : {0U, 2U, 3U, 4U, 5U}) EXPECT_EQ(p.find(k), 0U);
  EXPECT_EQ(p.find(1), 1U);
}

TEST(BoundaryGraph, FirstSliceIsTheBoundary) {
  const Sweep s({{{1, 2, 3, 4}, true}, {{8, 9, 10}, false}});
  EXPECT_EQ(s.loop(s.on(1)), (Ids{1, 2, 3, 4}));
  EXPECT_EQ(s.loop(s.on(9)), (Ids{9, 10, 8}));
  ASSERT_EQ(s.graph.cells().size(), 2U);
  EXPECT_TRUE(s.graph.cells()[s.graph[s.on(1)].cell].unbounded);
  EXPECT_FALSE(s.graph.cells()[s.graph[s.on(8)].cell].unbounded);
  EXPECT_NE(s.graph.shell_of(s.on(1)), s.graph.shell_of(s.on(8)));
}

TEST(BoundaryGraph, NeighboursOfARunAreOtherPatches) {
  Sweep s({{{1, 2, 3, 4}, true}});
  const std::uint32_t one = s.on(1), two = s.on(2), three = s.on(3), four = s.on(4);
  BoundaryEdit edit;
  edit.runs = {{two, two, {segment(5), segment(6)}}};
  edit.gone = {two};
  s.at_next_angle(edit);
  EXPECT_EQ(s.loop(s.on(1)), (Ids{1, 5, 6, 3, 4}));
  EXPECT_NE(s.on(1), one);  // next to another segment
  EXPECT_NE(s.on(3), three);
  EXPECT_EQ(s.on(4), four);
  EXPECT_EQ(s.graph[two].end, 0U);
  EXPECT_EQ(s.graph[s.on(5)].begin, 0U);
  EXPECT_EQ(s.graph.cells().size(), 1U);
  EXPECT_EQ(s.graph.shell_of(s.on(5)), s.graph.shell_of(two));
  EXPECT_TRUE(s.graph.changed());
}

TEST(BoundaryGraph, SplitLoopsHaveNewCellsOfOneComponent) {
  Sweep s({{{1, 2, 3, 4}, true}});
  s.at_next_angle(crossing(s.on(1), s.on(3), s.graph));
  EXPECT_EQ(s.loop(s.on(2)).size(), 3U);
  EXPECT_EQ(s.loop(s.on(4)).size(), 3U);
  const std::uint32_t a = s.graph[s.on(2)].cell, b = s.graph[s.on(4)].cell;
  EXPECT_NE(a, b);
  EXPECT_EQ(s.graph.cells()[0].end, 0U);
  EXPECT_EQ(s.graph.components().find(a), s.graph.components().find(b));
  EXPECT_EQ(s.graph.cell_links().size(), 2U);
  EXPECT_EQ(s.graph.shell_of(s.on(2)), s.graph.shell_of(s.on(4)));
  EXPECT_EQ(s.graph.loops_born(), 0U);
}

TEST(BoundaryGraph, CheckFindsLoopsThatShareACell) {
  Sweep s({{{1, 2, 3, 4}, true}});
  BoundaryEdit edit = crossing(s.on(1), s.on(3), s.graph);
  edit.loops_may_change = false;  // not true
  EXPECT_THROW(s.at_next_angle(edit), std::logic_error);
}

TEST(BoundaryGraph, LoopsAreBornAndVanish) {
  Sweep s({{{1, 2, 3, 4}, true}});
  BoundaryEdit birth;
  birth.births = {{segment(8), segment(9), segment(10)}};
  s.at_next_angle(birth);
  EXPECT_EQ(s.graph.loops_born(), 1U);
  EXPECT_EQ(s.loop(s.on(8)), (Ids{8, 9, 10}));
  const std::uint32_t cell = s.graph[s.on(8)].cell;
  EXPECT_EQ(s.graph.cells()[cell].begin, 0U);
  EXPECT_NE(s.graph.components().find(cell), s.graph.components().find(s.graph[s.on(1)].cell));
  EXPECT_NE(s.graph.shell_of(s.on(8)), s.graph.shell_of(s.on(1)));
  BoundaryEdit death;
  death.gone = {s.on(8), s.on(9), s.on(10)};
  death.loops_may_change = true;
  s.at_next_angle(death);
  EXPECT_EQ(s.graph.cells()[cell].end, 1U);
  EXPECT_EQ(s.graph.alive().size(), 4U);
  // What began and ended is the start again.
  EXPECT_TRUE(s.graph.close());
}

TEST(BoundaryGraph, AFullTurnLeadsBackToItsStart) {
  Sweep s({{{1, 2, 3, 4}, true}});
  const std::uint32_t two = s.on(2);
  s.at_next_angle(slice_difference(s.graph, {{{1, 5, 3, 4}, true}}, nothing_parted));
  EXPECT_FALSE(BoundaryGraph(s.graph).close());
  s.at_next_angle(slice_difference(s.graph, {{{1, 2, 3, 4}, true}}, nothing_parted));
  EXPECT_NE(s.on(2), two);
  ASSERT_TRUE(s.graph.close());
  EXPECT_EQ(s.graph.continued(s.on(2)), two);
  EXPECT_EQ(s.graph.continued(two), two);
  EXPECT_EQ(s.graph.shell_of(s.on(2)), s.graph.shell_of(two));
}

TEST(SliceDifference, WhatHasItsNeighboursStays) {
  const Sweep s({{{1, 2, 3, 4, 5, 6}, true}, {{8, 9, 10}, false}});
  const SliceEdit edit = slice_difference(s.graph, {{{9, 10, 8}, false}, {{1, 2, 7, 4, 5, 6}, true}}, nothing_parted);
  std::vector<std::uint32_t> stay, fresh;
  for (const SliceEdit::Loop& loop : edit.loops)
    for (const SliceEdit::Position& p : loop.positions) (p.stays == kNobody ? fresh : stay).push_back(p.segment);
  EXPECT_EQ(stay, (Ids{9, 10, 8, 1, 5, 6}));
  EXPECT_EQ(fresh, (Ids{2, 7, 4}));
  EXPECT_EQ(edit.ended, (Ids{s.on(2), s.on(3), s.on(4)}));
  EXPECT_TRUE(edit.touching.empty());
}

TEST(SliceDifference, ApplyingItIsTheSlice) {
  Sweep s({{{1, 2, 3, 4, 5, 6}, true}, {{8, 9, 10}, false}});
  s.at_next_angle(slice_difference(s.graph, {{{1, 2, 9, 10, 5, 6}, true}, {{3, 4, 8}, false}}, nothing_parted));
  EXPECT_EQ(s.loop(s.on(1)), (Ids{1, 2, 9, 10, 5, 6}));
  EXPECT_EQ(s.loop(s.on(3)), (Ids{3, 4, 8}));
  EXPECT_EQ(s.graph.alive().size(), 9U);
}

// Two pieces of a loop in a box whose ends are led on crosswise; what is outside stays.
TEST(SliceEdit, PiecesOfLoopsAreLinkedToWhatIsOutside) {
  Sweep s({{{1, 2, 3, 4, 5, 6}, true}});
  const std::uint32_t one = s.on(1), four = s.on(4), two = s.on(2);
  SliceEdit edit;
  const auto add = [&](SliceEdit::Position from, SliceEdit::Position to, std::uint32_t outside) {
    SliceEdit::Loop& piece = edit.loops.emplace_back();
    piece.positions = {from, to};
    piece.open = true;
    piece.before.node = piece.after.node = outside;
  };
  add({2, 1, 6, kNobody}, {6, 2, 1, kNobody}, one);
  add({5, 4, 3, kNobody}, {3, 5, 4, kNobody}, four);
  edit.ended = {s.on(2), s.on(3), s.on(5), s.on(6)};
  edit.continued = {{s.on(2), 0}, {s.on(6), 1}, {s.on(5), 2}, {s.on(3), 3}};
  s.at_next_angle(edit);
  EXPECT_EQ(s.loop(one), (Ids{1, 2, 6}));
  EXPECT_EQ(s.loop(four), (Ids{4, 5, 3}));
  EXPECT_EQ(s.on(1), one);
  EXPECT_EQ(s.graph.shell_of(s.on(2)), s.graph.shell_of(two));
  EXPECT_NE(s.graph[one].cell, s.graph[four].cell);
  EXPECT_EQ(s.graph.cells()[0].end, 0U);
  EXPECT_EQ(s.graph.components().find(s.graph[one].cell), s.graph.components().find(s.graph[four].cell));
}

// A piece that comes in where another one has left the box: the two are linked by their new nodes.
TEST(SliceEdit, PiecesThatFollowEachOtherAreLinked) {
  Sweep s({{{1, 2, 3, 4}, true}});
  const std::uint32_t cell = s.graph[s.on(1)].cell;
  SliceEdit edit;
  edit.loops_may_change = false;
  edit.loops.resize(2);
  for (SliceEdit::Loop& piece : edit.loops) piece.open = true, piece.cell = cell;
  edit.loops[0].positions = {{1, 4, 5, kNobody}, {5, 1, 2, kNobody}, {2, 5, 3, kNobody}};
  edit.loops[1].positions = {{3, 2, 6, kNobody}, {6, 3, 4, kNobody}, {4, 6, 1, kNobody}};
  edit.loops[0].before.position = 5, edit.loops[0].after.position = 3;
  edit.loops[1].before.position = 2, edit.loops[1].after.position = 0;
  edit.ended = {s.on(1), s.on(2), s.on(3), s.on(4)};
  s.at_next_angle(edit);
  EXPECT_EQ(s.loop(s.on(1)), (Ids{1, 5, 2, 3, 6, 4}));
  EXPECT_EQ(s.graph.cells().size(), 1U);
  EXPECT_EQ(s.graph[s.on(6)].cell, cell);
}

// Walls of a passage that is shut at the angle: what lies before and after it touches there, and is not connected.
TEST(SliceDifference, ShutPassagesPart) {
  Sweep s({{{1, 2, 3}, true}, {{8, 9, 10}, false}});
  const std::uint32_t cell = s.graph[s.on(8)].cell, eight = s.on(8);
  const auto inner = [&](std::uint32_t n) { return s.graph[n].cell == cell; };
  const SliceEdit edit = slice_difference(s.graph, {{{1, 2, 3}, true}, {{8, 9, 10}, false}}, inner);
  EXPECT_EQ(edit.ended.size(), 3U);
  EXPECT_EQ(edit.touching.size(), 3U);
  s.at_next_angle(edit);
  EXPECT_NE(s.on(8), eight);
  EXPECT_NE(s.graph.shell_of(s.on(8)), s.graph.shell_of(eight));
  EXPECT_EQ(s.graph.cells()[cell].end, 0U);
  ASSERT_EQ(s.graph.touching_cells().size(), 3U);
  EXPECT_EQ(s.graph.touching_cells()[0], (std::pair{cell, s.graph[s.on(8)].cell}));
}

}  // namespace
}  // namespace dymsum::planar
