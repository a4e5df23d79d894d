// Runs the tasks of a table: what the store has is taken, the rest computed in parallel and handed to the store.
#include "dymsum/nfp_table.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <mutex>
#include <utility>

#include "base/parallel.h"
#include "base/poll.h"
#include "nesting/row_answer.h"
#include "nesting/strip_fit.h"
#include "nesting/table_store.h"

namespace dymsum {
namespace nesting {
namespace {

using Clock = std::chrono::steady_clock;

/// A moment that many seconds from now; limits beyond a century are none.
Clock::time_point after(double seconds) {
  constexpr double kCentury = 3.2e9;
  if (!(seconds < kCentury)) return Clock::time_point::max();
  return Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

bool settled(const std::optional<TableAnswer>& answer) {
  return answer && answer->status != TableAnswer::Status::timed_out;
}

class TableRunner {
 public:
  TableRunner(const NfpTable::State& table, const TableOptions& options, TableResult& result, TableStore& store)
      : table_(table), options_(options), result_(result), store_(store), end_(after(options.all_seconds)) {}

  Result<void> run() {
    std::vector<std::size_t> open;
    for (std::size_t t = options_.shard - 1; t < table_.tasks.size(); t += options_.shards) {
      ++result_.work.tasks;
      if (!done(table_.tasks[t])) open.push_back(t);
    }
    if (!open.empty() && store_.unwritable()) return *store_.unwritable();
    count_ = open.size();
    base::parallel_parts(open.size(), options_.threads, [&](std::size_t i) { run_task(table_.tasks[open[i]]); });
    const std::lock_guard<std::mutex> lock(mutex_);
    flush();
    if (error_) return *std::move(error_);
    return {};
  }

 private:
  /// Answers wait to be written together: at most so many, and only those of so short a time since the last write.
  static constexpr std::size_t kMostKept = 64;
  static constexpr std::chrono::milliseconds kLongestKept{20};

  std::uint32_t answer(std::uint32_t row) const { return table_.rows[row].answer; }

  bool done(const Task& task) const {
    return settled(result_.answers[answer(task.row)]) &&
           (task.mirror == Task::kNone || settled(result_.answers[answer(task.mirror)]));
  }

  void run_task(const Task& task) {
    if (stopped_) return;
    const Clock::time_point end = std::min(end_, after(options_.pair_seconds));
    const Progress go_on = [&](std::string_view, double) { return !stopped_ && Clock::now() < end; };
    std::array<TableAnswer, 2> answers;
    if (Clock::now() < end_) answers = answers_of(table_, task, go_on);
    else
      for (TableAnswer& a : answers) a.status = TableAnswer::Status::timed_out;
    if (!stopped_) keep(task, std::move(answers));
  }

  void keep(const Task& task, std::array<TableAnswer, 2> answers) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto put = [&](std::uint32_t row, TableAnswer&& one) {
      std::optional<TableAnswer>& slot = result_.answers[answer(row)];
      if (settled(slot)) return;
      slot = std::move(one);
      kept_.emplace_back(table_.keys[answer(row)], &*slot);
    };
    put(task.row, std::move(answers[0]));
    if (task.mirror != Task::kNone) put(task.mirror, std::move(answers[1]));
    ++(done(task) ? result_.work.computed : result_.work.timed_out);
    if (kept_.size() >= kMostKept || Clock::now() >= flushed_ + kLongestKept) flush();
    ++finished_;
    if (options_.progress && !options_.progress("pairs", static_cast<double>(finished_) / static_cast<double>(count_)))
      stop(cancelled());
  }

  void flush() {
    flushed_ = Clock::now();
    const Result<void> added = store_.add(kept_);
    kept_.clear();
    if (!added) stop(added.error());
  }

  void stop(Error error) {
    if (!error_) error_ = std::move(error);
    stopped_ = true;
  }

  const NfpTable::State& table_;
  const TableOptions& options_;
  TableResult& result_;
  TableStore& store_;
  const Clock::time_point end_;
  std::mutex mutex_;  ///< of all below, and of the answers
  std::vector<std::pair<Key, const TableAnswer*>> kept_;
  Clock::time_point flushed_ = Clock::now();
  std::size_t finished_ = 0, count_ = 0;
  std::optional<Error> error_;
  std::atomic<bool> stopped_ = false;
};

/// Strip fits are too quick to be kept. They are the last rows.
void fit_strips(const NfpTable::State& table, int threads, TableResult& result) {
  const std::size_t first = table.rows.size() - (table.answers - table.keys.size());
  base::parallel_parts(table.rows.size() - first, threads, [&](std::size_t i) {
    const TableRow& row = table.rows[first + i];
    result.answers[row.answer] = strip_answer(table, row);
  });
}

std::optional<Error> wrong(const TableOptions& options) {
  const auto out_of_range = [](const char* what) { return Error{ErrorCode::out_of_range, what, {}}; };
  if (options.shard < 1 || options.shard > options.shards)
    return out_of_range("a shard is one of 1 to the number of shards");
  if (!(options.pair_seconds > 0) || !(options.all_seconds > 0))
    return out_of_range("a limit of time has to be positive");
  return std::nullopt;
}

}  // namespace
}  // namespace nesting

Result<TableResult> compute_table(const NfpTable& table, const TableOptions& options) {
  if (std::optional<Error> error = nesting::wrong(options)) return *std::move(error);
  const NfpTable::State& state = table.state();
  TableResult result;
  result.answers.resize(state.answers);
  result.table = state.mark;
  Result<nesting::TableStore> opened = nesting::TableStore::open({options.store, options.shard, options.shards},
                                                                 options.compute, state.keys, result.answers);
  if (!opened) return opened.error();
  nesting::TableStore store = std::move(opened).value();
  result.work.store_files = store.files();
  result.work.refused_files = store.refused();
  nesting::fit_strips(state, options.threads, result);
  if (!options.compute) return result;
  if (const Result<void> done = nesting::TableRunner(state, options, result, store).run(); !done) return done.error();
  return result;
}

}  // namespace dymsum
