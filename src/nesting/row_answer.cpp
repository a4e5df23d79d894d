#include "nesting/row_answer.h"

#include <optional>
#include <utility>

#include "dymsum/cspace_obstacle.h"
#include "dymsum/orientation_sum.h"
#include "dymsum/planar_operand.h"
#include "dymsum/planar_sum.h"
#include "io/region/write_wkb.h"
#include "nesting/canonical_order.h"
#include "nesting/quarter_turn.h"
#include "nesting/rounded_row.h"

namespace dymsum::nesting {
namespace {

/// Of exact results, which growing by a distance and turning make.
Result<PlanarSum> row_at_distance(const NfpTable::State& table, const TableRow& row, const SumOptions& options) {
  std::optional<PlanarSum> turned;
  const std::optional<int> quarters = table.quarters[row.angle];
  if (!quarters) {
    const Region origin = Region::create({{}, {}, {Point{0, 0}}}).value();
    Result<PlanarSum> made =
        rotated_sum(table.input.items[row.moving].shape, origin, table.angles[row.angle].orientation, options);
    if (!made) return made;
    turned = *std::move(made);
  }
  const PlanarOperand moving =
      turned ? PlanarOperand(*turned) : *table.turned[row.moving][static_cast<std::size_t>(*quarters)];
  if (row.kind == TableRow::Kind::nfp) {
    const Result<PlanarSum>& grown = table.grown[row.fixed];
    return grown ? nfp(*grown, moving, options) : grown;
  }
  const Result<PlanarSum> kept_clear = minkowski_sum(moving, *table.margin, options);
  return kept_clear ? erode(table.input.bins[row.fixed].shape, *kept_clear, options) : kept_clear;
}

Result<PlanarSum> exact_row(const NfpTable::State& table, const TableRow& row, const SumOptions& options) {
  const bool nfp_row = row.kind == TableRow::Kind::nfp;
  if (nfp_row ? table.spacing : table.margin) return row_at_distance(table, row, options);
  const Region& fixed = nfp_row ? table.input.items[row.fixed].shape : table.input.bins[row.fixed].shape;
  if (const std::optional<int> quarters = table.quarters[row.angle]) {
    const Region& moving = *table.turned[row.moving][static_cast<std::size_t>(*quarters)];
    return nfp_row ? nfp(fixed, moving, options) : erode(fixed, moving, options);
  }
  const Region& moving = table.input.items[row.moving].shape;
  const Orientation& theta = table.angles[row.angle].orientation;
  return nfp_row ? cspace_slice(moving, fixed, theta, options) : rotated_erode(fixed, moving, theta, options);
}

TableAnswer failed(const Error& error) {
  TableAnswer answer;
  const bool stopped = error.code == ErrorCode::cancelled;
  answer.status = stopped ? TableAnswer::Status::timed_out : TableAnswer::Status::refused;
  // The error has its evidence in words: that is all that is kept.
  if (!stopped) answer.error = Error{error.code, error.to_string(), {}};
  return answer;
}

TableAnswer with_geometry(TableAnswer answer, RegionData data) {
  put_in_order(data);
  io::append_wkb(answer.wkb, data);
  return answer;
}

/// -R(-d) of the row's set: d quarter turns.
RegionData mirrored(const RegionData& data, int quarters) { return turned(data, (6 - quarters) % 4); }

}  // namespace

std::array<TableAnswer, 2> answers_of(const NfpTable::State& table, const Task& task, const Progress& progress) {
  const TableRow& row = table.rows[task.row];
  SumOptions options;
  options.progress = progress;
  std::array<TableAnswer, 2> answers;
  const Result<PlanarSum> sum = exact_row(table, row, options);
  if (!sum) {
    answers.fill(failed(sum.error()));
    return answers;
  }
  RoundedRow rounded = rounded_row(*sum);
  if (task.mirror != Task::kNone) {
    // Rounding to nearest commutes with quarter turns; of repairs nothing is promised.
    if (rounded.answer.status != TableAnswer::Status::done ||
        rounded.answer.rounding == TableAnswer::Rounding::repaired)
      answers[1] = answers_of(table, {task.mirror, Task::kNone}, progress)[0];
    else answers[1] = with_geometry(rounded.answer, mirrored(rounded.data, *table.quarters[row.angle]));
  }
  answers[0] = rounded.answer.status == TableAnswer::Status::done
                   ? with_geometry(std::move(rounded.answer), std::move(rounded.data))
                   : std::move(rounded.answer);
  return answers;
}

}  // namespace dymsum::nesting
