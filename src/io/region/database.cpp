#include "io/region/database.h"

#include <sqlite3.h>

#include <algorithm>
#include <array>
#include <memory>
#include <new>

namespace dymsum::io {

namespace {

// Where a header says how a database is written: 1 with a journal that undoes, 2 with one of what is to be done, which
// is a second file. In memory there is none.
constexpr std::size_t kWriteMode = 18, kReadMode = 19;

/// A query may take so many steps of SQLite's machine: those that rows take, several times over.
constexpr std::uint64_t most_steps(std::uint64_t bytes) { return 1'000'000 + 32 * bytes; }
constexpr int kStepsAtOnce = 100;

/// So much memory may SQLite use: nothing that is honest sorts more than the file. It counts what the whole process has,
/// so the limit leaves room for others that read at the same time.
constexpr std::int64_t most_memory(std::uint64_t bytes) {
  return (std::int64_t{1} << 28) + 2 * static_cast<std::int64_t>(bytes);
}

/// Functions that views may call: none makes a value that is larger than what it is given.
constexpr std::array<std::string_view, 18> kFunctions = {"abs", "avg",    "coalesce", "count", "glob",  "ifnull",
                                                         "iif", "instr",  "length",   "like",  "lower", "max",
                                                         "min", "nullif", "round",    "sum",   "trim",  "upper"};

int clipped(std::uint64_t size) { return static_cast<int>(std::min<std::uint64_t>(size, 1'000'000'000)); }

}  // namespace

void Database::Close::operator()(sqlite3* handle) const { sqlite3_close(handle); }

void Database::open() {
  sqlite3* handle = nullptr;
  const int code = sqlite3_open_v2(":memory:", &handle, SQLITE_OPEN_READWRITE | SQLITE_OPEN_NOMUTEX, nullptr);
  handle_.reset(handle);
  if (handle == nullptr) throw std::bad_alloc();
  if (code != SQLITE_OK) fail();
}

Database::Database() { open(); }

Database::Database(std::string_view bytes) : size_(bytes.size()) {
  open();
  load(bytes);
  distrust();
}

void Database::load(std::string_view bytes) {
  if (bytes.size() > kReadMode && (bytes[kWriteMode] == 2 || bytes[kReadMode] == 2)) {
    rollback_mode_ = bytes;
    rollback_mode_[kWriteMode] = rollback_mode_[kReadMode] = 1;
    bytes = rollback_mode_;
  }
  // SQLite takes pointers to what may change, and changes nothing of what is read only.
  auto* const data = reinterpret_cast<unsigned char*>(const_cast<char*>(bytes.data()));
  const auto size = static_cast<sqlite3_int64>(bytes.size());
  if (sqlite3_deserialize(handle_.get(), "main", data, size, size, SQLITE_DESERIALIZE_READONLY) != SQLITE_OK) fail();
}

void Database::distrust() {
  if (sqlite3_db_config(handle_.get(), SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr) != SQLITE_OK) fail();
  for (const int off : {SQLITE_DBCONFIG_TRUSTED_SCHEMA, SQLITE_DBCONFIG_ENABLE_TRIGGER,
                        SQLITE_DBCONFIG_ENABLE_LOAD_EXTENSION, SQLITE_DBCONFIG_DQS_DML})
    if (sqlite3_db_config(handle_.get(), off, 0, nullptr) != SQLITE_OK) fail();
  sqlite3_limit(handle_.get(), SQLITE_LIMIT_LENGTH, clipped(1'000'000 + size_));
  sqlite3_limit(handle_.get(), SQLITE_LIMIT_SQL_LENGTH, 1'000'000);
  sqlite3_limit(handle_.get(), SQLITE_LIMIT_EXPR_DEPTH, 100);
  sqlite3_limit(handle_.get(), SQLITE_LIMIT_COMPOUND_SELECT, 50);
  sqlite3_limit(handle_.get(), SQLITE_LIMIT_VDBE_OP, 100'000);
  sqlite3_limit(handle_.get(), SQLITE_LIMIT_ATTACHED, 0);
  sqlite3_limit(handle_.get(), SQLITE_LIMIT_LIKE_PATTERN_LENGTH, 50);
  // Nothing is sorted on the disk.
  run("PRAGMA cell_size_check = ON; PRAGMA temp_store = MEMORY");
  memory_before_ = sqlite3_memory_used();
  sqlite3_progress_handler(handle_.get(), kStepsAtOnce, &Database::count_steps, this);
  sqlite3_set_authorizer(handle_.get(), &Database::permit, this);
}

int Database::count_steps(void* self) {
  auto& database = *static_cast<Database*>(self);
  database.steps_ += kStepsAtOnce;
  if (database.steps_ > most_steps(database.size_)) {
    database.refused_ = "it takes more steps to read than " + std::to_string(database.size_) + " bytes explain";
    return 1;
  }
  if (sqlite3_memory_used() - database.memory_before_ > most_memory(database.size_)) {
    database.refused_ = "it takes more memory to read than " + std::to_string(database.size_) + " bytes explain";
    return 1;
  }
  return 0;
}

int Database::permit(void* self, int action, const char*, const char* second, const char*, const char*) {
  if (action == SQLITE_SELECT || action == SQLITE_READ) return SQLITE_OK;
  auto& database = *static_cast<Database*>(self);
  if (action == SQLITE_FUNCTION) {
    const std::string_view name = second == nullptr ? "" : second;
    if (std::find(kFunctions.begin(), kFunctions.end(), name) != kFunctions.end()) return SQLITE_OK;
    database.refused_ = "a view calls the function " + std::string(name.substr(0, 64));
  } else {
    database.refused_ = action == SQLITE_RECURSIVE ? "a view is recursive" : "a view does more than to select rows";
  }
  return SQLITE_DENY;
}

void Database::fail() const {
  if (!refused_.empty()) throw DatabaseFailure{refused_};
  if (sqlite3_errcode(handle_.get()) == SQLITE_NOMEM) throw std::bad_alloc();
  throw DatabaseFailure{sqlite3_errmsg(handle_.get())};
}

void Database::run(const char* statements) {
  if (sqlite3_exec(handle_.get(), statements, nullptr, nullptr, nullptr) != SQLITE_OK) fail();
}

std::string Database::bytes() const {
  sqlite3_int64 size = 0;
  const std::unique_ptr<unsigned char, decltype(&sqlite3_free)> data(sqlite3_serialize(handle_.get(), "main", &size, 0),
                                                                     &sqlite3_free);
  if (!data) throw std::bad_alloc();
  return {reinterpret_cast<const char*>(data.get()), static_cast<std::size_t>(size)};
}

Query::Query(Database& database, const std::string& statement) : database_(database) {
  if (sqlite3_prepare_v2(database.handle_.get(), statement.c_str(), -1, &statement_, nullptr) != SQLITE_OK)
    database.fail();
}

Query::~Query() { sqlite3_finalize(statement_); }

void Query::require_bound(int code) const {
  if (code != SQLITE_OK) database_.fail();
}

Query& Query::bind_text(int index, std::string_view text) {
  require_bound(sqlite3_bind_text64(statement_, index, text.data(), text.size(), SQLITE_STATIC, SQLITE_UTF8));
  return *this;
}

Query& Query::bind_blob(int index, std::string_view bytes) {
  require_bound(sqlite3_bind_blob64(statement_, index, bytes.data(), bytes.size(), SQLITE_STATIC));
  return *this;
}

Query& Query::bind_number(int index, std::optional<double> value) {
  require_bound(value ? sqlite3_bind_double(statement_, index, *value) : sqlite3_bind_null(statement_, index));
  return *this;
}

bool Query::next() {
  const int code = sqlite3_step(statement_);
  if (code != SQLITE_ROW && code != SQLITE_DONE) database_.fail();
  return code == SQLITE_ROW;
}

std::int64_t Query::integer(int column) const { return sqlite3_column_int64(statement_, column); }
double Query::number(int column) const { return sqlite3_column_double(statement_, column); }
bool Query::is_null(int column) const { return sqlite3_column_type(statement_, column) == SQLITE_NULL; }
bool Query::is_blob(int column) const { return sqlite3_column_type(statement_, column) == SQLITE_BLOB; }

std::string Query::text(int column) const {
  const auto* const text = reinterpret_cast<const char*>(sqlite3_column_text(statement_, column));
  if (text == nullptr) return {};
  return {text, static_cast<std::size_t>(sqlite3_column_bytes(statement_, column))};
}

std::string_view Query::blob(int column) const {
  const auto* const bytes = static_cast<const char*>(sqlite3_column_blob(statement_, column));
  if (bytes == nullptr) return {};
  return {bytes, static_cast<std::size_t>(sqlite3_column_bytes(statement_, column))};
}

std::string quoted_name(std::string_view name) {
  std::string quoted = "\"";
  for (const char c : name) quoted.append(c == '"' ? 2 : 1, c);
  return quoted + '"';
}

}  // namespace dymsum::io
