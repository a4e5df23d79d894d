// The folder of answers: shards, deaths, damage.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "base/output_file.h"
#include "dymsum/nfp_table.h"
#include "dymsum/shapes.h"
#include "io/reading.h"
#include "nesting/answer_record.h"
#include "oracles/snapped_shapes.h"

namespace dymsum {
namespace {

namespace fs = std::filesystem;
using io_test::Folder;

NfpTable store_table() {
  TableInput input;
  std::vector<Rational> degrees;
  for (const int d : {0, 45, 90}) degrees.emplace_back(d);
  input.items = {{"a", snapped_shapes::star(5, 1, 2), degrees},
                 {"b", shapes::letter_u(3, 3, 1), degrees},
                 {"c", snapped_shapes::gear(6, 2, 3), degrees}};
  input.bins = {{"bin", shapes::rectangle(0, 0, 9, 9)}};
  return NfpTable::create(input).value();
}

TableResult run(const NfpTable& table, const std::string& store, TableOptions options = {}) {
  options.store = store;
  Result<TableResult> result = compute_table(table, options);
  if (!result) throw std::runtime_error(result.error().to_string());
  return std::move(result).value();
}

std::string text_of(const NfpTable& table, const TableResult& result) {
  const std::string rows = table_rows(table, result, true);
  return rows + table_manifest(table, result, rows, table_geometry(table, result));
}

std::string plain_text() {
  static const std::string text = text_of(store_table(), compute_table(store_table()).value());
  return text;
}

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

void write_bytes(const fs::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
}

constexpr const char* kFirst = "shard-1-of-1.1.nfpt";

TEST(TableStore, a_second_run_computes_nothing) {
  const Folder folder("store");
  const NfpTable table = store_table();
  EXPECT_EQ(run(table, folder / "x").work.computed, table.task_count());
  const TableResult again = run(table, folder / "x");
  EXPECT_EQ(again.work.computed, 0u);
  EXPECT_TRUE(again.work.refused_files.empty());
  EXPECT_EQ(text_of(table, again), plain_text());
}

TEST(TableStore, shards_make_the_same_bytes) {
  const NfpTable table = store_table();
  for (std::uint32_t shards = 1; shards <= 4; ++shards) {
    for (const int threads : {1, 2}) {
      const Folder folder("shards");
      std::uint64_t tasks = 0;
      for (std::uint32_t shard = shards; shard >= 1; --shard) {
        const TableResult part = run(table, folder / "x", {.threads = threads, .shard = shard, .shards = shards});
        EXPECT_EQ(part.work.computed, part.work.tasks);
        tasks += part.work.tasks;
      }
      EXPECT_EQ(tasks, table.task_count());
      const TableResult merged = run(table, folder / "x", {.compute = false});
      EXPECT_EQ(text_of(table, merged), plain_text()) << shards;
    }
  }
}

TEST(TableStore, what_is_missing_has_no_answer) {
  const Folder folder("missing");
  const NfpTable table = store_table();
  run(table, folder / "x", {.shard = 1, .shards = 2});
  const TableResult merged = run(table, folder / "x", {.compute = false});
  const auto missing = std::count(merged.answers.begin(), merged.answers.end(), std::nullopt);
  EXPECT_GT(missing, 0);
  EXPECT_THROW(table_rows(table, merged, true), std::invalid_argument);
}

// Cut off anywhere, as kill -9 may leave it: everything before is kept, and the file goes on.
TEST(TableStore, every_beginning_of_a_file_is_continued) {
  const Folder folder("cut");
  const NfpTable table = store_table();
  run(table, folder / "whole");
  const std::string whole = bytes_of(fs::path(folder / "whole") / kFirst);
  std::uint64_t before = table.task_count();
  fs::create_directories(folder / "cut");
  const fs::path file = fs::path(folder / "cut") / kFirst;
  for (std::size_t size = 0; size <= whole.size(); size += size < 60 ? 1 : 997) {
    write_bytes(file, whole.substr(0, size));
    const TableResult result = run(table, folder / "cut");
    ASSERT_EQ(text_of(table, result), plain_text()) << size;
    ASSERT_LE(result.work.computed, before) << size;
    before = result.work.computed;
    ASSERT_EQ(run(table, folder / "cut").work.computed, 0u) << size;
  }
  EXPECT_LT(before, table.task_count());
}

// A changed byte anywhere: what it is part of is not believed, and the answers stay right.
TEST(TableStore, damage_is_found_and_mended) {
  const Folder folder("damage");
  const NfpTable table = store_table();
  run(table, folder / "whole");
  const std::string whole = bytes_of(fs::path(folder / "whole") / kFirst);
  fs::create_directories(folder / "hurt");
  const fs::path file = fs::path(folder / "hurt") / kFirst;
  for (std::size_t at = 0; at < whole.size(); at += at < 100 ? 1 : 1009) {
    std::string hurt = whole;
    hurt[at] = static_cast<char>(hurt[at] ^ (1 << (at % 8)));
    write_bytes(file, hurt);
    const TableResult result = run(table, folder / "hurt");
    ASSERT_EQ(result.work.refused_files.size(), 1u) << at;
    ASSERT_GT(result.work.computed, 0u) << at;
    ASSERT_EQ(text_of(table, result), plain_text()) << at;
  }
}

TEST(TableStore, foreign_files_are_told_and_left_alone) {
  const Folder folder("foreign");
  const NfpTable table = store_table();
  fs::create_directories(folder / "x");
  const fs::path foreign = fs::path(folder / "x") / "other.nfpt";
  write_bytes(foreign, "not one of ours");
  write_bytes(fs::path(folder / "x") / "note.txt", "not read");
  const TableResult result = run(table, folder / "x");
  ASSERT_EQ(result.work.refused_files.size(), 1u);
  EXPECT_EQ(result.work.refused_files[0].file, foreign.string());
  EXPECT_EQ(bytes_of(foreign), "not one of ours");
  EXPECT_EQ(text_of(table, result), plain_text());
}

TEST(TableStore, only_regular_files_are_read) {
  const Folder folder("irregular");
  const NfpTable table = store_table();
  const fs::path store = folder / "x";
  fs::create_directories(store / "folder.nfpt");
  fs::create_symlink("/dev/zero", store / "endless.nfpt");
  fs::create_symlink("nowhere", store / "dangling.nfpt");
  const TableResult result = run(table, folder / "x");
  EXPECT_EQ(result.work.refused_files.size(), 3u);
  EXPECT_EQ(text_of(table, result), plain_text());
}

/// What may stand where a process would make its file, with a name for each.
void put_irregular(const std::string& kind, const fs::path& at) {
  if (kind == "pipe") ASSERT_EQ(::mkfifo(at.c_str(), 0666), 0);
  else if (kind == "folder") fs::create_directories(at);
  else if (kind == "link to nowhere") fs::create_symlink("nowhere/file", at);
  else if (kind == "link to itself") fs::create_symlink(at.filename(), at);
  else fs::create_symlink(kind, at);
}

constexpr const char* kIrregular[] = {"pipe", "folder", "link to nowhere", "link to itself", "/dev/null", "/dev/zero"};

// Neither do they hang or fill the memory, nor are answers lost in them.
TEST(TableStore, what_is_no_file_cannot_be_the_own_one) {
  const NfpTable table = store_table();
  for (const std::string kind : kIrregular) {
    SCOPED_TRACE(kind);
    const Folder folder("own");
    const fs::path store = folder / "x";
    fs::create_directories(store);
    put_irregular(kind, store / kFirst);
    const auto refused = compute_table(table, {.store = store});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::cannot_write);
    EXPECT_EQ(refused.error().evidence.file, (store / kFirst).string());
  }
}

TEST(TableStore, a_link_to_a_file_that_is_not_there_yet_is_followed) {
  const NfpTable table = store_table();
  const Folder folder("link");
  const fs::path store = folder / "x";
  fs::create_directories(store);
  fs::create_symlink(folder / "elsewhere", store / kFirst);
  EXPECT_EQ(text_of(table, run(table, store)), plain_text());
  EXPECT_GT(fs::file_size(folder / "elsewhere"), 0u);
  EXPECT_EQ(run(table, store).work.computed, 0u);
}

// As on a medium that is read only: nothing would have to be written.
TEST(TableStore, a_whole_store_need_not_be_writable) {
  const NfpTable table = store_table();
  const Folder folder("whole");
  const fs::path store = folder / "x";
  run(table, store, {.shard = 1, .shards = 2});
  fs::create_directories(store / kFirst);
  EXPECT_EQ(compute_table(table, {.store = store}).error().code, ErrorCode::cannot_write);
  run(table, store, {.shard = 2, .shards = 2});
  const TableResult whole = run(table, store);
  EXPECT_EQ(whole.work.computed, 0u);
  EXPECT_EQ(text_of(table, whole), plain_text());
  EXPECT_EQ(text_of(table, run(table, store, {.compute = false})), plain_text());
}

TEST(TableStore, a_file_that_somebody_else_writes_to_is_not_shared) {
  const Folder folder("locked");
  const NfpTable table = store_table();
  fs::create_directories(folder / "x");
  const auto held = base::AppendFile::open((fs::path(folder / "x") / kFirst).string()).value();
  ASSERT_TRUE(held.has_value());
  EXPECT_EQ(text_of(table, run(table, folder / "x")), plain_text());
  EXPECT_TRUE(fs::exists(fs::path(folder / "x") / "shard-1-of-1.2.nfpt"));
  EXPECT_EQ(fs::file_size(fs::path(folder / "x") / kFirst), 0u);
}

TEST(TableStore, pairs_that_ran_out_of_time_are_computed_again) {
  const Folder folder("time");
  const NfpTable table = store_table();
  const TableWork late = run(table, folder / "x", {.all_seconds = 1e-9}).work;
  EXPECT_EQ(late.computed, 0u);
  EXPECT_EQ(late.timed_out, table.task_count());
  const TableResult merged = run(table, folder / "x", {.compute = false});
  for (const TableRow& row : table.rows())
    EXPECT_EQ(merged.answers[row.answer]->status, TableAnswer::Status::timed_out);
  EXPECT_NE(table_rows(table, merged, true).find(R"("status":"timed_out"})"), std::string::npos);
  EXPECT_EQ(text_of(table, run(table, folder / "x")), plain_text());
  EXPECT_EQ(text_of(table, run(table, folder / "x", {.compute = false})), plain_text());
}

TEST(TableStore, folders_that_cannot_be_used) {
  const Folder folder("cannot");
  write_bytes(folder / "file", "");
  const NfpTable table = store_table();
  EXPECT_EQ(compute_table(table, {.store = folder / "file"}).error().code, ErrorCode::cannot_write);
  EXPECT_EQ(compute_table(table, {.store = folder / "none", .compute = false}).error().code, ErrorCode::cannot_open);
  for (const std::string kind : kIrregular) {
    if (kind == "folder") continue;
    const fs::path store = folder / "x";
    put_irregular(kind, store);
    const std::string why =
        kind.starts_with("link") ? "this is a symbolic link to what is not there" : "this is not a folder";
    for (const bool compute : {true, false}) {
      const auto refused = compute_table(table, {.store = store, .compute = compute});
      ASSERT_FALSE(refused) << kind;
      EXPECT_EQ(refused.error().code, compute ? ErrorCode::cannot_write : ErrorCode::cannot_open) << kind;
      EXPECT_EQ(refused.error().message, why) << kind;
    }
    fs::remove(store);
  }
}

TEST(AnswerRecord, answers_come_back) {
  TableAnswer answer;
  answer.status = TableAnswer::Status::refused;
  answer.rounding = TableAnswer::Rounding::repaired;
  answer.vertices = 5;
  answer.holes = 1ULL << 40;
  answer.wkb = std::string("\0a", 2);
  answer.error = Error{ErrorCode::out_of_memory, "why", {}};
  std::string bytes;
  nesting::append_answer(bytes, answer);
  const TableAnswer back = nesting::answer_in(bytes).value();
  EXPECT_EQ(back.wkb, answer.wkb);
  EXPECT_EQ(back.error, answer.error);
  EXPECT_EQ(back.holes, answer.holes);
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_FALSE(nesting::answer_in(bytes.substr(0, size)).has_value());
  EXPECT_FALSE(nesting::answer_in(bytes + "x").has_value());
  bytes[0] = 3;
  EXPECT_FALSE(nesting::answer_in(bytes).has_value());
}

TEST(AnswerRecord, checksums_see_every_bit) {
  const std::string text = "a text of a few words, of thirty-odd bytes";
  for (std::size_t bit = 0; bit < 8 * text.size(); ++bit) {
    std::string other = text;
    other[bit / 8] = static_cast<char>(other[bit / 8] ^ (1 << (bit % 8)));
    EXPECT_NE(nesting::checksum(other), nesting::checksum(text)) << bit;
  }
  EXPECT_NE(nesting::checksum(std::string(8, '\0')), nesting::checksum(std::string(9, '\0')));
}

}  // namespace
}  // namespace dymsum
