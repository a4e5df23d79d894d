// Tables: every row is what the library's own functions say, however the work is divided.
#include "dymsum/nfp_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <stdexcept>

#include "dymsum/cspace_obstacle.h"
#include "dymsum/orientation_sum.h"
#include "dymsum/planar_sum.h"
#include "dymsum/shapes.h"
#include "nesting/wkb_reading.h"
#include "oracles/tiny_regions.h"

namespace dymsum {
namespace {

using nesting_test::WkbReader;

Region made_region(const RegionData& data) { return Region::create(data).value(); }

std::vector<Rational> degrees_of(const std::vector<double>& values) {
  std::vector<Rational> degrees;
  for (const double v : values) degrees.push_back(Rational::of(v).value());
  return degrees;
}

/// Convex, with a notch, with a hole in which the first one fits exactly, and one of them once more.
TableInput small_input() {
  const Region square = shapes::rectangle(0, 0, 2, 2), ell = shapes::letter_l(3, 3, 1);
  const Region frame =
      made_region({{{{{-1, -1}, {6, -1}, {6, 6}, {-1, 6}}, {{{1, 1}, {1, 3}, {3, 3}, {3, 1}}}}}, {}, {}});
  TableInput input;
  const std::vector<Rational> four = degrees_of({0, 90, 180, 270}), two = degrees_of({0, 30.5});
  input.items = {{"square", square, four}, {"ell", ell, two}, {"frame", frame, four}, {"again", ell, two}};
  input.bins = {{"room", frame}, {"small", shapes::rectangle(-1, 0, 1, 3)}};
  input.strip_height = 3;
  return input;
}

Result<PlanarSum> sum_of_row(const TableInput& input, const NfpTable& table, const TableRow& row) {
  const Orientation& o = table.angles()[row.angle].orientation;
  const Region& moving = input.items[row.moving].shape;
  if (row.kind == TableRow::Kind::nfp) return cspace_slice(moving, input.items[row.fixed].shape, o);
  return rotated_erode(input.bins[row.fixed].shape, moving, o);
}

TEST(NfpTable, rows_are_the_rounded_sums) {
  const TableInput input = small_input();
  const NfpTable table = NfpTable::create(input).value();
  const TableResult result = compute_table(table).value();
  std::size_t exact = 0, tight = 0, empty = 0;
  for (const TableRow& row : table.rows()) {
    const TableAnswer& answer = result.answers[row.answer].value();
    ASSERT_EQ(answer.status, TableAnswer::Status::done);
    if (row.kind == TableRow::Kind::strip_fit) continue;
    const PlanarSum sum = sum_of_row(input, table, row).value();
    const Region rounded = sum.rounded().value();
    RegionData data = rounded.data();
    EXPECT_EQ(answer.vertices, sum.vertex_count());
    EXPECT_EQ(answer.tight_points, sum.tight_points.size());
    EXPECT_EQ(answer.tight_segments, sum.tight_segments.size());
    if (row.kind == TableRow::Kind::nfp) {
      for (const SumVertex& v : sum.tight_points) data.points.push_back(v.at);
      for (const SumSegment& s : sum.tight_segments) data.polylines.push_back({s.from.at, s.to.at});
    }
    EXPECT_EQ(made_region(WkbReader(answer.wkb).read()), made_region(data)) << row.fixed << " " << row.moving;
    exact += answer.rounding == TableAnswer::Rounding::none;
    tight += answer.tight_points + answer.tight_segments > 0;
    empty += data == RegionData{};
  }
  EXPECT_GT(exact, 20u);
  EXPECT_LT(exact, table.rows().size());
  EXPECT_GT(tight, 0u);
  EXPECT_GT(empty, 0u);
}

// 4 x 4 pairs: with relative angles 0, 90, 180, 270 of those that take four, 0, 30.5, 329.5 of those that take two,
// and 0, 90, 180, 270, 30.5, ... between them.
TEST(NfpTable, the_angles_are_the_differences_of_orientations) {
  const NfpTable table = NfpTable::create(small_input()).value();
  const auto degrees_between = [&](std::uint32_t fixed, std::uint32_t moving) {
    std::vector<double> degrees;
    for (const TableRow& row : table.rows())
      if (row.kind == TableRow::Kind::nfp && row.fixed == fixed && row.moving == moving)
        degrees.push_back(table.angles()[row.angle].degrees.to_double());
    return degrees;
  };
  EXPECT_EQ(degrees_between(0, 2), (std::vector<double>{0, 90, 180, 270}));
  EXPECT_EQ(degrees_between(1, 3), (std::vector<double>{0, 30.5, 329.5}));
  EXPECT_EQ(degrees_between(0, 1), (std::vector<double>{0, 30.5, 90, 120.5, 180, 210.5, 270, 300.5}));
  EXPECT_EQ(degrees_between(1, 0), (std::vector<double>{0, 59.5, 90, 149.5, 180, 239.5, 270, 329.5}));
  for (const TableAngle& angle : table.angles()) {
    const double queried = reduced_degrees(angle.degrees);
    EXPECT_LE(std::abs(angle.orientation.radians() - queried), angle.error + 0x1p-49);
    EXPECT_EQ(angle.error == 0, (angle.degrees / Rational(90)).is_integer());
  }
  // "ell" and "again" are one shape: nothing is computed twice.
  EXPECT_LT(table.task_count(), table.rows().size() / 2);
}

// Denominators are tried one by one. Of the allowed error a hundredth is kept for rounding.
TEST(NfpTable, angles_have_the_simplest_tangents) {
  constexpr double kError = 1e-3;
  std::vector<double> degrees;
  for (int k = 0; k < 180; ++k) degrees.push_back(k + 0.25);
  TableInput input;
  input.items = {{"one", shapes::rectangle(0, 0, 1, 1), degrees_of({0})},
                 {"other", shapes::rectangle(0, 0, 1, 2), degrees_of(degrees)}};
  input.angle_error = kError;
  std::size_t tried = 0;
  const NfpTable table = NfpTable::create(input).value();
  for (const TableAngle& angle : table.angles()) {
    const double theta = angle.degrees.to_double() * std::numbers::pi / 180;
    if (theta <= kError || theta >= std::numbers::pi - kError) continue;
    const double low = std::tan((theta - 0.99 * kError) / 2), high = std::tan((theta + 0.99 * kError) / 2);
    std::int64_t d = 1;
    while (std::ceil(low * static_cast<double>(d)) > high * static_cast<double>(d)) ++d;
    const auto n = static_cast<std::int64_t>(std::ceil(low * static_cast<double>(d)));
    EXPECT_EQ(angle.orientation.tan_half(), Rational::of(n, d).value()) << angle.degrees.to_string();
    ++tried;
  }
  EXPECT_GE(tried, 180u);
}

TEST(NfpTable, quarter_turns_are_exact) {
  TableInput input = small_input();
  input.angle_error = 0.1;
  const NfpTable table = NfpTable::create(input).value();
  std::map<Rational, Orientation> found;
  for (const TableAngle& angle : table.angles()) found.emplace(angle.degrees, angle.orientation);
  EXPECT_EQ(found.at(0).tan_half(), 0);
  EXPECT_EQ(found.at(90).tan_half(), 1);
  EXPECT_TRUE(found.at(180).is_half_turn());
  EXPECT_EQ(found.at(270).tan_half(), -1);
}

// Both orders of two items: one of each pair of rows is computed, the other one mirrored, and the other way round.
TEST(NfpTable, mirrored_rows_are_the_computed_ones) {
  std::size_t mirrored = 0, touching = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    SCOPED_TRACE(seed);
    oracles::Random random(seed);
    const oracles::Pair pair = oracles::random_pair(random, 4 + static_cast<int>(seed % 3));
    const TableItem a{"a", made_region(pair.p), degrees_of({0, 90})}, b{"b", made_region(pair.q), degrees_of({0, 180})};
    const NfpTable one = NfpTable::create({{a, b}, {}, {}}).value(), other = NfpTable::create({{b, a}, {}, {}}).value();
    mirrored += one.answer_count() - one.task_count();
    const TableResult of_one = compute_table(one).value(), of_other = compute_table(other).value();
    for (const TableRow& row : one.rows()) {
      for (const TableRow& same : other.rows()) {
        if (row.fixed != 1 - same.fixed || row.moving != 1 - same.moving ||
            one.angles()[row.angle].degrees != other.angles()[same.angle].degrees)
          continue;
        const TableAnswer &x = *of_one.answers[row.answer], &y = *of_other.answers[same.answer];
        ASSERT_EQ(x.wkb, y.wkb);
        ASSERT_EQ(x.rounding, y.rounding);
        touching += !Region::create(WkbReader(x.wkb).read()).value().touching_points().empty();
      }
    }
  }
  EXPECT_GT(mirrored, 400u);
  EXPECT_GT(touching, 50u);
}

std::vector<std::string> texts_of(const NfpTable& table, const TableResult& result) {
  const std::string rows = table_rows(table, result, true), geometry = table_geometry(table, result);
  return {rows, table_rows(table, result, false), geometry, table_manifest(table, result, rows, geometry)};
}

TEST(NfpTable, same_bytes_with_any_number_of_threads) {
  const NfpTable table = NfpTable::create(small_input()).value();
  const std::vector<std::string> one = texts_of(table, compute_table(table, {.threads = 1}).value());
  EXPECT_EQ(texts_of(table, compute_table(table, {.threads = 2}).value()), one);
  EXPECT_NE(one[0].find(R"("kind":"nfp","fixed":"square","moving":"frame")"), std::string::npos);
}

TEST(NfpTable, answers_of_another_table_are_refused) {
  const NfpTable table = NfpTable::create(small_input()).value();
  const TableResult result = compute_table(table).value();
  std::vector<TableInput> others(4, small_input());
  std::swap(others[0].items[0].shape, others[0].items[1].shape);  // as many rows and answers
  others[1].strip_height = 4;
  others[2].items[1].degrees = others[2].items[3].degrees = degrees_of({0, 31});
  others[3].items.pop_back();
  for (const TableInput& input : others) {
    const NfpTable other = NfpTable::create(input).value();
    EXPECT_THROW(table_rows(other, result, true), std::invalid_argument);
    EXPECT_THROW(table_geometry(other, result), std::invalid_argument);
    EXPECT_THROW(table_manifest(other, result, "", ""), std::invalid_argument);
  }
  const NfpTable same = NfpTable::create(small_input()).value();
  EXPECT_EQ(texts_of(same, result), texts_of(table, result));
}

TEST(NfpTable, strips_are_fitted_exactly) {
  TableInput input;
  // A third of a unit less high than the strip when it lies, exactly as high when it stands.
  input.items = {{"bar", shapes::rectangle(1, 0.25, 4, 1), degrees_of({0, 45, 90, 180})},
                 {"tall", shapes::rectangle(0, 0, 1, 4), degrees_of({0, 90})}};
  input.strip_height = 3;
  const NfpTable table = NfpTable::create(input).value();
  const TableResult result = compute_table(table).value();
  std::vector<StripFit> fits;
  for (const TableRow& row : table.rows())
    if (row.kind == TableRow::Kind::strip_fit) fits.push_back(*result.answers[row.answer]->strip);
  ASSERT_EQ(fits.size(), 6u);
  EXPECT_TRUE(fits[0].fits && fits[0].x_min == -1 && fits[0].y_min == -0.25 && fits[0].y_max == 2);
  EXPECT_TRUE(fits[1].fits);
  EXPECT_NEAR(fits[1].x_min, 0, 1e-8);
  EXPECT_TRUE(fits[2].fits && fits[2].x_min == 1 && fits[2].y_min == -1 && fits[2].y_max == -1) << "it fits exactly";
  EXPECT_TRUE(fits[3].fits && fits[3].x_min == 4 && fits[3].y_min == 1 && fits[3].y_max == 3.25);
  EXPECT_FALSE(fits[4].fits);
  EXPECT_TRUE(fits[5].fits);
}

TEST(NfpTable, refused_pairs_do_not_stop_the_others) {
  TableInput input;
  input.items = {{"huge", shapes::rectangle(0, 0, 0x1p1001, 1), degrees_of({0})},
                 {"square", shapes::rectangle(0, 0, 1, 1), degrees_of({0})}};
  const NfpTable table = NfpTable::create(input).value();
  const TableResult result = compute_table(table).value();
  std::size_t refused = 0, done = 0;
  for (const TableRow& row : table.rows()) {
    const TableAnswer& answer = *result.answers[row.answer];
    if (answer.status == TableAnswer::Status::done) {
      ++done;
      continue;
    }
    ++refused;
    ASSERT_EQ(answer.status, TableAnswer::Status::refused);
    EXPECT_EQ(answer.error->code, ErrorCode::unsupported_operand);
  }
  EXPECT_EQ(refused, 3u);
  EXPECT_EQ(done, 1u);
  EXPECT_NE(table_rows(table, result, true).find(R"("status":"refused","error":{"code":"unsupported_operand")"),
            std::string::npos);
}

TEST(NfpTable, limits_of_time_give_pairs_up) {
  TableInput input;
  input.items = {{"star", shapes::noisy_star(600, 0.9, 5), degrees_of({0, 10})},
                 {"square", shapes::rectangle(0, 0, 1, 1), degrees_of({0})}};
  const NfpTable table = NfpTable::create(input).value();
  const auto timed_out = [&](const TableOptions& options) {
    const TableResult result = compute_table(table, options).value();
    std::size_t count = 0;
    for (const TableRow& row : table.rows())
      count += result.answers[row.answer]->status == TableAnswer::Status::timed_out;
    return count;
  };
  EXPECT_EQ(timed_out({}), 0u);
  EXPECT_EQ(timed_out({.threads = 1, .all_seconds = 1e-9}), table.rows().size());
  const std::size_t of_pairs = timed_out({.threads = 1, .pair_seconds = 1e-6});
  EXPECT_GT(of_pairs, 0u);
}

TEST(NfpTable, cancelled_by_its_progress) {
  const NfpTable table = NfpTable::create(small_input()).value();
  TableOptions options;
  double last = 0;
  options.progress = [&](std::string_view, double fraction) {
    EXPECT_GE(fraction, last);
    last = fraction;
    return fraction < 0.5;
  };
  EXPECT_EQ(compute_table(table, options).error().code, ErrorCode::cancelled);
}

/// 66 orientations whose differences are all others: more than 4,096 angles.
TableInput many_angles(std::int64_t denominator) {
  std::vector<Rational> degrees;
  std::uint64_t state = 7;
  for (std::int64_t k = 0; k < 66; ++k) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    degrees.push_back(Rational::of(static_cast<std::int64_t>((state >> 32) % 359000), 1000).value() +
                      Rational::of(k + 1, denominator).value());
  }
  return {{{"square", shapes::rectangle(0, 0, 1, 1), degrees}}, {}, {}};
}

TEST(NfpTable, planning_can_be_cancelled_in_every_stage) {
  for (const std::int64_t denominator : {std::int64_t{1} << 30, (std::int64_t{1} << 60) - 1}) {
    const TableInput input = many_angles(denominator);
    std::set<std::string> stages;
    const Progress watching = [&](std::string_view stage, double fraction) {
      EXPECT_TRUE(fraction >= 0 && fraction <= 1) << fraction;
      stages.emplace(stage);
      return true;
    };
    EXPECT_GT(NfpTable::create(input, watching).value().angles().size(), 4096u);
    EXPECT_EQ(stages, (std::set<std::string>{"differences of angles", "orientations", "keys"}));
    for (const std::string& last : stages) {
      const auto stopped = NfpTable::create(input, [&](std::string_view stage, double) { return stage != last; });
      ASSERT_FALSE(stopped) << last;
      EXPECT_EQ(stopped.error().code, ErrorCode::cancelled) << last;
    }
  }
}

TEST(NfpTable, small_tables_are_planned_whatever_the_limit) {
  EXPECT_TRUE(NfpTable::create(small_input(), [](std::string_view, double) { return false; }));
}

TEST(NfpTable, wrong_input_is_refused) {
  const auto code = [](const TableInput& input) { return NfpTable::create(input).error().code; };
  TableInput input = small_input();
  input.items[1].shape = Region();
  EXPECT_EQ(code(input), ErrorCode::unsupported_operand);
  input = small_input();
  input.items[0].degrees.clear();
  EXPECT_EQ(code(input), ErrorCode::unsupported_operand);
  input.items[0].degrees.assign(3601, Rational(1));
  EXPECT_EQ(code(input), ErrorCode::unsupported_operand);
  input = small_input();
  input.bins[0].shape = made_region({{}, {}, {{0, 0}}});
  EXPECT_EQ(code(input), ErrorCode::unsupported_operand);
  for (const double height : {0.0, -1.0, std::numeric_limits<double>::infinity()}) {
    input = small_input();
    input.strip_height = height;
    EXPECT_EQ(code(input), ErrorCode::out_of_range);
  }
  for (const double error : {0.0, 0x1p-50, std::numeric_limits<double>::quiet_NaN()}) {
    input = small_input();
    input.angle_error = error;
    EXPECT_EQ(code(input), ErrorCode::out_of_range);
  }
  const NfpTable table = NfpTable::create(small_input()).value();
  EXPECT_EQ(compute_table(table, {.shard = 0}).error().code, ErrorCode::out_of_range);
  EXPECT_EQ(compute_table(table, {.shard = 3, .shards = 2}).error().code, ErrorCode::out_of_range);
  EXPECT_EQ(compute_table(table, {.pair_seconds = 0}).error().code, ErrorCode::out_of_range);
}

TEST(NfpTable, of_nothing_is_empty) {
  const NfpTable table = NfpTable::create({}).value();
  const TableResult result = compute_table(table).value();
  EXPECT_EQ(table_rows(table, result, true), "");
}

}  // namespace
}  // namespace dymsum
