// Tables with distances: items at the positions of a table are as far apart, and as far from their bins and the strip,
// as was requested, by the distances of all pairs of edges.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "dymsum/nfp_table.h"
#include "dymsum/shapes.h"
#include "nesting/wkb_reading.h"
#include "oracles/coordinate_kinds.h"
#include "oracles/sanitized.h"
#include "oracles/vertices_by.h"

namespace dymsum {
namespace {

using nesting_test::WkbReader;

Point turned_by(Point p, const Orientation& o) {
  const double a = o.radians(), c = std::cos(a), s = std::sin(a);
  return {c * p.x - s * p.y, s * p.x + c * p.y};
}
RegionData placed(const Region& shape, const Orientation& o, Point at) {
  return oracles::vertices_by(shape.data(), [&](Point p) {
    const Point q = turned_by(p, o);
    return Point{q.x + at.x, q.y + at.y};
  });
}

using Edge = std::pair<Point, Point>;
std::vector<Edge> edges_of(const RegionData& data) {
  std::vector<Edge> edges;
  const auto add = [&](const Ring& ring) {
    for (std::size_t k = 0; k < ring.size(); ++k) edges.emplace_back(ring[k], ring[(k + 1) % ring.size()]);
  };
  for (const Part& part : data.parts) {
    add(part.outer);
    for (const Ring& hole : part.holes) add(hole);
  }
  return edges;
}
double cross_of(Point a, Point b, Point c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }
bool cross_each_other(const Edge& e, const Edge& f) {
  return cross_of(e.first, e.second, f.first) * cross_of(e.first, e.second, f.second) < 0 &&
         cross_of(f.first, f.second, e.first) * cross_of(f.first, f.second, e.second) < 0;
}
double distance(Point p, const Edge& e) {
  const double x = e.second.x - e.first.x, y = e.second.y - e.first.y;
  const double t = std::clamp(((p.x - e.first.x) * x + (p.y - e.first.y) * y) / (x * x + y * y), 0.0, 1.0);
  return std::hypot(p.x - e.first.x - t * x, p.y - e.first.y - t * y);
}
/// Of two boundaries: 0 where they cross.
double distance(const RegionData& a, const RegionData& b) {
  double least = std::numeric_limits<double>::infinity();
  for (const Edge& e : edges_of(a)) {
    for (const Edge& f : edges_of(b)) {
      if (cross_each_other(e, f)) return 0;
      least =
          std::min({least, distance(e.first, f), distance(e.second, f), distance(f.first, e), distance(f.second, e)});
    }
  }
  return least;
}
/// Even-odd.
bool contains(const RegionData& set, Point p) {
  bool inside = false;
  for (const auto& [a, b] : edges_of(set))
    if ((a.y > p.y) != (b.y > p.y) && cross_of(a, b, p) * (b.y - a.y) > 0) inside = !inside;
  return inside;
}
std::vector<Point> vertices_of(const RegionData& set) {
  std::vector<Point> all = set.points;
  for (const auto& [a, b] : edges_of(set)) all.push_back(a);
  for (const Polyline& line : set.polylines) all.insert(all.end(), line.begin(), line.end());
  return all;
}

std::vector<Rational> whole_degrees(const std::vector<int>& values) { return {values.begin(), values.end()}; }

TableInput input_of(CoordinateKind kind) {
  std::mt19937_64 random(11);
  const auto made = [&](RegionData data) { return Region::create(of_kind(std::move(data), kind, random)).value(); };
  const RegionData frame{
      {{{{-4, -4}, {4, -4}, {4, 4}, {-4, 4}}, {{{-2.5, -2.5}, {-2.5, 2.5}, {2.5, 2.5}, {2.5, -2.5}}}}}, {}, {}};
  TableInput input;
  input.items = {{"ell", made(shapes::letter_l(3, 3, 1).data()), whole_degrees({0, 90, 31})},
                 {"frame", made(frame), whole_degrees({0, 180})},
                 {"small", made(shapes::rectangle(0, 0, 1, 0.5).data()), whole_degrees({0, 90})}};
  const RegionData sheet{{{{{-9, -7}, {9, -7}, {9, 7}, {-9, 7}}, {{{1, 1}, {1, 2}, {3, 2}, {3, 1}}}}}, {}, {}};
  input.bins = {{"sheet", made(sheet)}, {"narrow", made(shapes::rectangle(0, 0, 12, 5).data())}};
  input.strip_height = 9;
  return input;
}

/// Rows of these distances with at least one position.
struct Counts {
  std::size_t pairs = 0, in_holes = 0, in_bins = 0, refused = 0;
};

void check_row(const TableInput& input, const NfpTable& table, const TableRow& row, const RegionData& positions,
               Counts& counts) {
  constexpr double kRounding = 1e-9;
  const Orientation& o = table.angles()[row.angle].orientation;
  const Region& moving = input.items[row.moving].shape;
  double least = std::numeric_limits<double>::infinity();
  const bool pair = row.kind == TableRow::Kind::nfp;
  const double asked = pair ? input.spacing : input.margin;
  if (asked == 0) return;  // they touch
  const RegionData& fixed = pair ? input.items[row.fixed].shape.data() : input.bins[row.fixed].shape.data();
  for (const Point at : vertices_of(positions)) {
    const RegionData part = placed(moving, o, at);
    const double found = distance(fixed, part);
    least = std::min(least, found);
    EXPECT_GE(found, asked - kRounding) << at.x << " " << at.y;
    for (const Point p : vertices_of(part)) EXPECT_EQ(contains(fixed, p), !pair) << p.x << " " << p.y;
    counts.in_holes += pair && row.fixed == 1 && std::abs(at.x) < 2.5;
  }
  if (!std::isfinite(least)) return;
  EXPECT_LE(least, asked * 1.01 + kRounding);
  ++(pair ? counts.pairs : counts.in_bins);
}

TEST(TableSpacing, placements_at_the_vertices_of_a_table_keep_their_distances) {
  for (const CoordinateKind kind : kCoordinateKinds) {
    if (kind == CoordinateKind::turned_far) continue;  // the distances below are not exact there
    SCOPED_TRACE(name_of(kind));
    for (const auto& [spacing, margin] : {std::pair{0.25, 0.5}, std::pair{0.1, 0.0}, std::pair{0.0, 1.0 / 3}}) {
      TableInput input = input_of(kind);
      input.spacing = spacing, input.margin = margin;
      const NfpTable table = NfpTable::create(input).value();
      const TableResult result = compute_table(table).value();
      Counts counts;
      for (const TableRow& row : table.rows()) {
        const TableAnswer& answer = result.answers[row.answer].value();
        if (answer.status ==
            TableAnswer::Status::refused) {  // slivers of turned coordinates, which rounding turns over
          EXPECT_EQ(answer.error.value().code, ErrorCode::rounding_changed_topology);
          EXPECT_EQ(kind, CoordinateKind::turned);
          ++counts.refused;
          continue;
        }
        ASSERT_EQ(answer.status, TableAnswer::Status::done);
        if (row.kind != TableRow::Kind::strip_fit) check_row(input, table, row, WkbReader(answer.wkb).read(), counts);
      }
      EXPECT_EQ(counts.pairs > 20, spacing > 0) << counts.pairs;
      EXPECT_EQ(counts.in_bins > 4, margin > 0) << counts.in_bins;
      EXPECT_EQ(counts.in_holes > 0, spacing > 0);
      EXPECT_LE(counts.refused, 2u);
    }
  }
}

TEST(TableSpacing, strips_have_exact_margins) {
  TableInput input;
  input.items = {{"box", shapes::rectangle(1, 2, 3, 5), whole_degrees({0, 90})}};
  input.strip_height = 4, input.margin = 0.5;
  const NfpTable table = NfpTable::create(input).value();
  const TableResult result = compute_table(table).value();
  const TableAnswer &plain = *result.answers[table.rows()[table.rows().size() - 2].answer],
                    &quarter = *result.answers[table.rows().back().answer];
  EXPECT_EQ(plain.strip->fits, true);
  EXPECT_EQ((std::array{plain.strip->x_min, plain.strip->y_min, plain.strip->y_max}), (std::array{-0.5, -1.5, -1.5}));
  EXPECT_EQ((std::array{quarter.strip->x_min, quarter.strip->y_min, quarter.strip->y_max}),
            (std::array{5.5, -0.5, 0.5}));
  input.margin = 0.75;
  const NfpTable narrow = NfpTable::create(input).value();
  const TableResult none = compute_table(narrow).value();
  EXPECT_FALSE(none.answers[narrow.rows()[narrow.rows().size() - 2].answer]->strip->fits);
}

TEST(TableSpacing, mirrored_rows_are_what_they_are_alone) {
  TableInput input = input_of(CoordinateKind::grid);
  input.spacing = 0.25;
  const NfpTable both = NfpTable::create(input).value();
  const TableResult all = compute_table(both).value();
  std::swap(input.items[0], input.items[2]);
  const NfpTable swapped = NfpTable::create(input).value();
  const TableResult again = compute_table(swapped).value();
  const auto other = [](std::uint32_t item) { return item == 1 ? 1 : 2 - item; };
  std::size_t compared = 0;
  for (const TableRow& row : both.rows()) {
    if (row.kind != TableRow::Kind::nfp) continue;
    for (const TableRow& twin : swapped.rows()) {
      if (twin.kind != row.kind || twin.fixed != other(row.fixed) || twin.moving != other(row.moving) ||
          both.angles()[row.angle].degrees != swapped.angles()[twin.angle].degrees)
        continue;
      EXPECT_EQ(all.answers[row.answer]->wkb, again.answers[twin.answer]->wkb);
      ++compared;
    }
  }
  EXPECT_GT(compared, 20u);
}

TEST(TableSpacing, distances_are_part_of_what_a_store_knows) {
  TableInput input = input_of(CoordinateKind::grid);
  const NfpTable plain = NfpTable::create(input).value();
  input.spacing = 0.25;
  const NfpTable spaced = NfpTable::create(input).value();
  input.spacing = 0.5;
  const NfpTable wider = NfpTable::create(input).value();
  EXPECT_NE(compute_table(plain)->table, compute_table(spaced)->table);
  EXPECT_NE(compute_table(wider)->table, compute_table(spaced)->table);
}

TEST(TableSpacing, distances_that_are_none_are_errors) {
  for (const double wrong : {-1.0, std::nan(""), std::numeric_limits<double>::infinity(), 1e-300}) {
    TableInput input = input_of(CoordinateKind::grid);
    input.spacing = wrong;
    EXPECT_EQ(NfpTable::create(input).error().code, ErrorCode::out_of_range);
    input.spacing = 0, input.margin = wrong;
    EXPECT_EQ(NfpTable::create(input).error().code, ErrorCode::out_of_range);
  }
}

}  // namespace
}  // namespace dymsum
