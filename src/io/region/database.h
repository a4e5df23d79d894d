// Databases in memory, by SQLite: what GeoPackages are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

namespace dymsum::io {

/// What SQLite says of a database that it cannot read.
struct DatabaseFailure {
  std::string message;
};

/// A database that lies in memory alone: no file is opened, made or locked. Throws DatabaseFailure, std::bad_alloc.
class Database {
 public:
  /// An empty one, to be written.
  Database();
  /// That of a file, which is only read; the bytes have to outlive it. It may be a stranger's: what its views do is
  /// limited to selections of its tables without recursion and without functions that make large values, and the steps
  /// and the memory of all queries together to what its size explains.
  explicit Database(std::string_view bytes);

  /// Runs statements without results and without anything of a stranger in them.
  void run(const char* statements);
  /// The bytes of its file. With one version of SQLite the same for the same statements.
  std::string bytes() const;

 private:
  friend class Query;
  void open();
  void load(std::string_view bytes);
  void distrust();
  static int permit(void* self, int action, const char* first, const char* second, const char*, const char*);
  static int count_steps(void* self);
  [[noreturn]] void fail() const;

  struct Close {
    void operator()(sqlite3* handle) const;
  };
  std::string rollback_mode_;  ///< the bytes, where they had to be changed
  std::unique_ptr<sqlite3, Close> handle_;
  std::uint64_t size_ = 0, steps_ = 0;
  std::int64_t memory_before_ = 0;
  std::string refused_;  ///< why a query was, where it was the rules above that refused it
};

/// A statement whose rows are read one after the other; of it the columns count from 0, and what is bound from 1.
class Query {
 public:
  Query(Database& database, const std::string& statement);
  Query(const Query&) = delete;
  Query& operator=(const Query&) = delete;
  ~Query();

  /// The text or the blob has to outlive the query.
  Query& bind_text(int index, std::string_view text);
  Query& bind_blob(int index, std::string_view bytes);
  Query& bind_number(int index, std::optional<double> value);

  /// Whether there is a next row; it is the one that is read then.
  bool next();
  std::int64_t integer(int column) const;
  double number(int column) const;
  std::string text(int column) const;
  bool is_null(int column) const;
  bool is_blob(int column) const;
  /// Up to the next row.
  std::string_view blob(int column) const;

 private:
  void require_bound(int code) const;

  Database& database_;
  sqlite3_stmt* statement_ = nullptr;
};

/// A name as it stands in statements, whatever it contains.
std::string quoted_name(std::string_view name);

}  // namespace dymsum::io
