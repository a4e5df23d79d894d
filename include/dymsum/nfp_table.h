// Tables of no-fit polygons: all pairs of the items of a nesting instance, and the inner fits of its bins and its
// strip. Rows are computed once for whatever shapes are the same, on several threads, in shards, kept in a folder, and
// written as the same bytes whatever the history was (docs/design/nfp-table.md).
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dymsum/orientation.h"
#include "dymsum/progress.h"
#include "dymsum/rational.h"
#include "dymsum/region.h"
#include "dymsum/result.h"

namespace dymsum {

struct TableItem {
  std::string name;
  Region shape;
  std::vector<Rational> degrees;  ///< the orientations it may take
};

struct TableBin {
  std::string name;
  Region shape;
};

struct TableInput {
  std::vector<TableItem> items;
  std::vector<TableBin> bins;
  std::optional<double> strip_height;
  double angle_error = 1e-9;  ///< radians; quarter turns are exact. Smaller ones make larger numbers and slower rows
  double spacing = 0;         ///< the least distance of two items, also in each other's holes
  double margin = 0;  ///< the least distance of an item from the outside of its bin and its holes, or from the strip's
};

/// An angle that rows have: the decimal one in [0, 360), and the exact one that shapes are turned by.
struct TableAngle {
  Rational degrees;
  Orientation orientation;
  double error = 0;  ///< proved: they differ by at most so many radians; 0 for quarter turns
};

/// With a spacing, no-fit polygons are those of the fixed item grown by a polygon of 32 sides around the disc of that
/// radius, which no position within the spacing is outside of, and which reaches at most 1 % further; with a margin,
/// inner fits are those of the moving item grown so. Both are exact sets, and margins in the strip exact distances.
struct TableRow {
  enum class Kind : std::uint8_t {
    nfp,        ///< item `fixed` (+) -R(angle) item `moving`, in the frame of the fixed one, which is not turned
    bin_fit,    ///< bin `fixed` (-) R(angle) item `moving`
    strip_fit,  ///< the strip (-) R(angle) item `moving`
  };
  static constexpr std::uint32_t kNone = 0xffffffff;
  Kind kind = Kind::nfp;
  std::uint32_t fixed = kNone;  ///< index of an item or a bin
  std::uint32_t moving = 0;     ///< index of an item
  std::uint32_t angle = 0;      ///< index in NfpTable::angles()
  std::uint32_t answer = 0;     ///< index of the answer, which rows with the same shapes share
};

/// The positions at which a part lies in the strip { x >= 0, 0 <= y <= H }: x >= x_min and y_min <= y <= y_max, each
/// correctly rounded.
struct StripFit {
  bool fits = false;  ///< exactly; else the numbers are 0
  double x_min = 0, y_min = 0, y_max = 0;
};

struct TableAnswer {
  enum class Status : std::uint8_t {
    done,
    refused,    ///< by the library, with an error
    timed_out,  ///< a limit of time was reached
  };
  enum class Rounding : std::uint8_t {
    none,      ///< every vertex is exact
    nearest,   ///< every vertex is the nearest pair of doubles, and the topology is the exact one
    repaired,  ///< that would have changed the topology: vertices that met were merged, what collapsed was dropped
  };
  Status status = Status::done;
  Rounding rounding = Rounding::none;
  std::uint64_t vertices = 0, holes = 0;  ///< of the exact polygons
  std::uint64_t tight_segments = 0, tight_points = 0;
  std::optional<StripFit> strip;  ///< of strip fits, which have no geometry
  /// Well-known binary: the closed set with its tight features as lines and points; GEOMETRYCOLLECTION EMPTY where
  /// nothing fits. Rings begin at their smallest vertex; everything is sorted.
  std::string wkb;
  std::optional<Error> error;  ///< where it was refused
};

/// What a table consists of. A value; thread-safe.
class NfpTable {
 public:
  /// Rows in the order of their indices: nfp by fixed item, moving item, relative angle; then bins, then the strip. The
  /// relative angles of A and B are the differences of an orientation of B and one of A, which serve all such pairs:
  /// turned by R(a), row(A, B, b - a) is the no-fit polygon of A turned by a and B turned by b. O(rows), and a hash of
  /// every shape. `progress` is queried once in some thousands of angles and of rows: smaller tables are planned at
  /// once. Errors: unsupported_operand for an item or a bin that is empty, for an item without orientations or with
  /// more than 3600, for a bin with polylines or points; out_of_range for angle errors below 2^-49, strip heights that
  /// are not positive and finite, a spacing or margin that is neither 0 nor from 2^-900 to 2^400, and more than 2^32 -
  /// 2 rows; cancelled.
  static Result<NfpTable> create(TableInput input, const Progress& progress = {});

  const TableInput& input() const;
  const std::vector<TableAngle>& angles() const;
  const std::vector<TableRow>& rows() const;
  std::size_t answer_count() const;
  /// What shards divide: one answer, or two that mirror each other.
  std::size_t task_count() const;

  struct State;
  const State& state() const { return *state_; }

 private:
  NfpTable() = default;
  std::shared_ptr<const State> state_;
};

struct TableOptions {
  int threads = 0;                      ///< 0: as many as there are cores; the answers do not depend on it
  std::uint32_t shard = 1, shards = 1;  ///< compute the tasks of one shard alone, from 1 on
  double pair_seconds = std::numeric_limits<double>::infinity();  ///< for a task
  double all_seconds = std::numeric_limits<double>::infinity();   ///< for all tasks
  /// A folder, made where it is not there, that answers are taken from and added to; empty: none.
  std::string store = {};
  bool compute = true;     ///< else only what the store has is taken
  Progress progress = {};  ///< called by one thread at a time
};

/// A file of the store of which not everything could be believed; what is missing is computed again.
struct RefusedFile {
  std::string file, why;
};

struct TableWork {
  std::uint64_t tasks = 0;      ///< of this shard
  std::uint64_t computed = 0;   ///< of these, by this call
  std::uint64_t timed_out = 0;  ///< of these, given up; the others were in the store
  std::uint64_t store_files = 0;
  std::vector<RefusedFile> refused_files;
};

struct TableResult {
  std::vector<std::optional<TableAnswer>> answers;  ///< nothing where another shard has it, or nobody
  TableWork work;
  std::uint64_t table = 0;  ///< a hash of the rows and shapes of the table that these answers belong to
};

/// The answers of a table. Answers that are done or refused are kept; those of tasks that ran out of time are computed
/// again by the next call. Killed at any moment, the store keeps what was finished. A store that has all answers may be
/// one that cannot be written to. Errors: out_of_range for a shard that is not one of 1 to `shards`, and limits of time
/// that are not positive; cannot_open, cannot_write for the store; cancelled. Cost: tasks times that of nfp, and of
/// reading the whole store.
Result<TableResult> compute_table(const NfpTable& table, const TableOptions& options = {});

/// Rows as JSON lines, one object each (docs/guide/nesting.md). With `inline_geometry` each holds its geometry in
/// hexadecimal digits as `wkb`, else where it is in table_geometry(): `offset` and `bytes`. Requires: an answer to
/// every row, of this very table or of one with the same rows and shapes (else std::invalid_argument).
std::string table_rows(const NfpTable& table, const TableResult& result, bool inline_geometry);
/// The geometry of all rows, one after the other. Requires the same.
std::string table_geometry(const NfpTable& table, const TableResult& result);
/// The table as one JSON object: items, bins, angles, counts of rows by status, and the sizes and SHA-256 of both
/// texts, as they were made of this result. Requires the same.
std::string table_manifest(const NfpTable& table, const TableResult& result, std::string_view rows,
                           std::string_view geometry);

}  // namespace dymsum
