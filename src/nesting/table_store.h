// Answers in a folder of files that only grow: what was finished survives, what is damaged is not believed.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/output_file.h"
#include "dymsum/nfp_table.h"
#include "nesting/table_plan.h"

namespace dymsum::nesting {

/// The file by which a process adds to a store: the first file "shard-I-of-N.K.nfpt", K = 1, 2, ..., that nobody else
/// writes to.
struct StorePath {
  std::string folder;  ///< empty: nowhere
  std::uint32_t shard = 1, shards = 1;
};

class TableStore {
 public:
  /// Reads the answers to `keys` from all files of the folder into `answers`, by the indices of the keys, answers that
  /// are done or refused before those that timed out. `writable`: more may be added; the folder is made where it is not
  /// there. Errors: cannot_open, cannot_write.
  static Result<TableStore> open(const StorePath& position, bool writable, const std::vector<Key>& keys,
                                 std::vector<std::optional<TableAnswer>>& answers);

  /// Why nothing can be added, though it was to be writable.
  const std::optional<Error>& unwritable() const { return unwritable_; }
  /// Keeps answers; several at once are one write. Requires: not unwritable. Errors: cannot_write.
  Result<void> add(const std::vector<std::pair<Key, const TableAnswer*>>& answers);

  std::uint64_t files() const { return files_; }
  const std::vector<RefusedFile>& refused() const { return refused_; }

 private:
  friend class StoreReader;
  std::optional<base::AppendFile> own_;
  bool begun_ = false;  ///< the own file has its header
  std::optional<Error> unwritable_;
  std::uint64_t files_ = 0;
  std::vector<RefusedFile> refused_;
};

}  // namespace dymsum::nesting
