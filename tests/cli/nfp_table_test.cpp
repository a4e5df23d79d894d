// Tables of no-fit polygons on the command line: shards, kills, limits, and what is refused.
#include <gtest/gtest.h>

#include <set>
#include <sstream>

#include "cli_fixture.h"
#include "dymsum/dymsum.h"
#include "oracles/snapped_shapes.h"

namespace dymsum::cli_test {
namespace {

std::string item_text(const std::string& name, const Region& shape, const std::string& more = "") {
  std::ostringstream text;
  text.precision(17);
  text << R"({"id":")" << name << R"(","shape":{"type":"simple_polygon","data":[)";
  const Ring& ring = shape.parts().at(0).outer;
  for (std::size_t i = 0; i < ring.size(); ++i) text << (i == 0 ? "[" : ",[") << ring[i].x << "," << ring[i].y << "]";
  text << "]}" << more << "}";
  return text.str();
}

std::string instance_text(const std::vector<std::string>& items, const std::string& more = "") {
  std::string text = R"({"items":[)";
  for (std::size_t i = 0; i < items.size(); ++i) text += (i == 0 ? "" : ",") + items[i];
  return text + "]" + more + "}";
}

class NfpTables : public CliTest {
 protected:
  NfpTables() {
    const std::string two = R"(,"allowed_orientations":[0,180])";
    work.write(
        "small.json",
        instance_text({item_text("ell", shapes::letter_l(3, 3, 1), two), item_text("u", shapes::letter_u(3, 3, 1), two),
                       item_text("star", snapped_shapes::star(5, 1, 2), R"(,"allowed_orientations":[0,22.5])")},
                      R"(,"strip_height":5,"bins":[{"shape":{"type":"rectangle","data":)"
                      R"({"x_min":0,"y_min":0,"width":8,"height":5}}}])"));
    std::vector<std::string> stars;
    for (int k = 0; k < 8; ++k)
      stars.push_back(item_text(std::to_string(k), shapes::noisy_star(60, 0.7, static_cast<std::uint64_t>(k) + 1)));
    work.write("stars.json", instance_text(stars));
  }
  Outcome done(const std::string& command) const {
    const Outcome outcome = work.run(command);
    EXPECT_EQ(outcome.code, 0) << command << "\n" << outcome.err;
    return outcome;
  }
  std::vector<Json> rows(const std::string& file) const {
    std::vector<Json> all;
    std::istringstream lines(work.read(file));
    for (std::string line; std::getline(lines, line);) all.push_back(Json::parse(line));
    return all;
  }
};

TEST_F(NfpTables, WriteRowsGeometryAndManifest) {
  done("dymsum nfp-table small.json -o rows.jsonl -o all.wkb -o table.json");
  done("dymsum nfp-table small.json -o inline.jsonl");
  const Outcome piped = done("dymsum nfp-table - -o - < small.json");
  EXPECT_EQ(piped.out, work.read("inline.jsonl"));
  const std::string geometry = work.read("all.wkb");
  const std::vector<Json> by_position = rows("rows.jsonl"), with_hex = rows("inline.jsonl");
  const Json manifest = Json::parse(work.read("table.json"));
  ASSERT_EQ(by_position.size(), with_hex.size());
  EXPECT_EQ(manifest["rows"]["all"], by_position.size());
  EXPECT_EQ(manifest["geometry"]["bytes"], geometry.size());
  EXPECT_EQ(manifest["items"][2]["degrees"], Json::parse("[0.0,22.5]"));
  std::set<std::string> kinds;
  for (std::size_t i = 0; i < by_position.size(); ++i) {
    kinds.insert(by_position[i]["kind"]);
    EXPECT_EQ(by_position[i]["status"], "done");
    if (by_position[i]["kind"] == "strip_fit") continue;
    std::string hex;
    for (const char c : geometry.substr(by_position[i]["offset"], by_position[i]["bytes"])) {
      hex += "0123456789abcdef"[static_cast<unsigned char>(c) >> 4];
      hex += "0123456789abcdef"[static_cast<unsigned char>(c) & 15];
    }
    EXPECT_EQ(with_hex[i]["wkb"], hex);
  }
  EXPECT_EQ(kinds, (std::set<std::string>{"nfp", "bin_fit", "strip_fit"}));
}

TEST_F(NfpTables, ShardsAreMergedToTheSameBytes) {
  done("dymsum nfp-table small.json -o one.jsonl -o one.json --threads 1");
  for (int shards = 1; shards <= 4; ++shards) {
    const std::string cache = " --cache c" + std::to_string(shards), n = "/" + std::to_string(shards);
    const Outcome early = work.run("dymsum nfp-table small.json --merge -o merged.jsonl" + cache);
    EXPECT_EQ(early.code, 2);
    for (int k = 1; k <= shards; ++k)
      done("dymsum nfp-table small.json --threads 2 --shard " + std::to_string(k) + n + cache);
    done("dymsum nfp-table small.json --merge -o merged.jsonl -o merged.json" + cache);
    EXPECT_EQ(work.read("merged.jsonl"), work.read("one.jsonl")) << shards;
    EXPECT_EQ(work.read("merged.json"), work.read("one.json")) << shards;
  }
  const Outcome half = done("dymsum nfp-table small.json --shard 1/2 --cache half");
  EXPECT_NE(half.out.find(" of all shards: "), std::string::npos) << half.out;
  EXPECT_NE(half.out.find(" not there yet"), std::string::npos) << half.out;
  const Outcome early = work.run("dymsum nfp-table small.json --merge --cache half -o m.jsonl");
  EXPECT_EQ(early.code, 2);
  EXPECT_NE(early.err.find("rows are missing"), std::string::npos) << early.err;
  EXPECT_FALSE(work.exists("m.jsonl"));
}

TEST_F(NfpTables, AnswersAreTakenFromAnotherInstance) {
  done("dymsum nfp-table small.json --cache c");
  work.write("other.json",
             instance_text({item_text("renamed", snapped_shapes::star(5, 1, 2), R"(,"allowed_orientations":[22.5,0])"),
                            item_text("new", shapes::rectangle(0, 0, 2, 1), R"(,"allowed_orientations":[0])")}));
  const Json report = json("dymsum nfp-table other.json --cache c --json");
  EXPECT_GT(report["computed"], 0);
  EXPECT_LT(report["computed"], report["tasks"]);
  done("dymsum nfp-table other.json -o alone.jsonl");
  done("dymsum nfp-table other.json --cache c -o cached.jsonl");
  EXPECT_EQ(work.read("cached.jsonl"), work.read("alone.jsonl"));
}

// Names and angles are the same, shapes are not: nothing of one gets into the table of the other.
TEST_F(NfpTables, TwoInstancesInOneCacheStayApart) {
  const std::string turns = R"(,"allowed_orientations":[0,90,22.5])";
  work.write("a.json", instance_text({item_text("x", shapes::letter_l(3, 3, 1), turns),
                                      item_text("y", snapped_shapes::star(5, 1, 2), turns)}));
  work.write("b.json", instance_text({item_text("x", shapes::letter_u(3, 3, 1), turns),
                                      item_text("y", snapped_shapes::star(5, 1, 2), turns)}));
  for (const std::string name : {"a", "b"}) {
    const std::string command = "dymsum nfp-table " + name + ".json ";
    done(command + "-o " + name + ".jsonl -o " + name + ".manifest.json");
    for (const std::string shard : {"1/3", "2/3"}) done(command + "--cache c --shard " + shard);
  }
  EXPECT_NE(work.read("a.jsonl"), work.read("b.jsonl"));
  // The third shards of both: one of them is not enough for the other.
  done("dymsum nfp-table a.json --cache c --shard 3/3");
  EXPECT_EQ(work.run("dymsum nfp-table b.json --cache c --merge -o m.jsonl").code, 2);
  done("dymsum nfp-table b.json --cache c --shard 3/3");
  for (const std::string name : {"a", "b"}) {
    done("dymsum nfp-table " + name + ".json --cache c --merge -o m.jsonl -o m.json");
    EXPECT_EQ(work.read("m.jsonl"), work.read(name + ".jsonl"));
    EXPECT_EQ(work.read("m.json"), work.read(name + ".manifest.json"));
  }
}

// Killed again and again, wherever it is: in the end the table is there, and its bytes are those of one run.
TEST_F(NfpTables, KillsLoseNothing) {
  const std::string command = "dymsum nfp-table stars.json --orientations 8 ";
  done(command + "-o whole.jsonl -o whole.json");
  int killed = 0, resumed = 0;
  double after = 0.02;
  for (int round = 0; round < 60; ++round, after *= 1.25) {
    const Outcome outcome = work.run("timeout -s KILL " + std::to_string(after) + " " + command +
                                     "--threads 2 --cache c -o rows.jsonl -o rows.json --json");
    if (outcome.code == 0) {
      const Json report = Json::parse(outcome.out);
      resumed += report["computed"] < report["tasks"];
      break;
    }
    ++killed;
    if (work.exists("rows.jsonl")) {
      EXPECT_EQ(work.read("rows.jsonl"), work.read("whole.jsonl")) << "half a table";
    }
  }
  EXPECT_GT(killed, 0);
  EXPECT_EQ(resumed, 1) << "nothing of what the killed runs had done was used";
  EXPECT_EQ(work.read("rows.jsonl"), work.read("whole.jsonl"));
  EXPECT_EQ(work.read("rows.json"), work.read("whole.json"));
}

TEST_F(NfpTables, LimitsOfTimeAreRowsAndTheExitCode) {
  const Outcome outcome = work.run("dymsum nfp-table stars.json --orientations 3 --time 1e-9 --cache c -o rows.jsonl");
  EXPECT_EQ(outcome.code, 5) << outcome.err;
  for (const Json& row : rows("rows.jsonl")) EXPECT_EQ(row["status"], "timed_out");
  EXPECT_EQ(work.run("dymsum nfp-table stars.json --orientations 3 --merge --cache c -o rows.jsonl").code, 5);
  done("dymsum nfp-table stars.json --orientations 3 --cache c -o rows.jsonl");
  for (const Json& row : rows("rows.jsonl")) EXPECT_EQ(row["status"], "done");
}

TEST_F(NfpTables, TheSummarySaysWhatBecameOfEveryTask) {
  const std::string command = "dymsum nfp-table stars.json --orientations 3 ";
  const auto work_line = [](const Outcome& outcome) { return outcome.out.substr(outcome.out.find('\n') + 1); };
  EXPECT_EQ(work_line(work.run(command + "--time 1e-9")), "164 tasks: 0 computed, 164 given up\n");
  EXPECT_EQ(work_line(work.run(command + "--time 1e-9 --cache c")), "164 tasks: 0 computed, 164 given up\n");
  EXPECT_EQ(json(command + "--time 1e-9 --json", 5)["timed_out"], 164);
  EXPECT_EQ(work_line(done(command + "--cache c --shard 1/2")), "82 tasks: 82 computed\n");
  EXPECT_EQ(work.run(command + "--cache c --merge").code, 5) << "the other shard has given up";
  EXPECT_EQ(work_line(done(command + "--cache c")), "164 tasks: 82 computed, 82 taken from the cache\n");
  EXPECT_EQ(work_line(done(command + "--cache c --merge")), "read from 2 files of the cache\n");
}

/// An item with so many orientations that listing their differences, 359,000 angles, takes seconds.
std::string many_angles() {
  std::string list;
  std::uint64_t state = 7;
  for (int k = 0; k < 600; ++k) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    list += (k == 0 ? "" : ",") + std::to_string((state >> 33) % 360000000) + "e-6";
  }
  return instance_text(
      {item_text("square", shapes::rectangle(0, 0, 1, 1), R"(,"allowed_orientations":[)" + list + "]")});
}

TEST_F(NfpTables, ListingTheRowsKeepsToTheLimitOfTime) {
  work.write("many.json", many_angles());
  const Outcome late = work.run("timeout -k 1 9 dymsum nfp-table many.json --time 0.1 -o rows.jsonl");
  EXPECT_EQ(late.code, 5) << late.err;
  EXPECT_NE(late.err.find("the limit of --time was reached while the rows were being listed"), std::string::npos)
      << late.err;
  EXPECT_FALSE(work.exists("rows.jsonl"));
}

TEST_F(NfpTables, CtrlCWhileTheRowsAreListed) {
  work.write("many.json", many_angles());
  const Outcome stopped =
      work.run("timeout --foreground --preserve-status -s INT -k 9 0.5 dymsum nfp-table many.json --json");
  EXPECT_EQ(stopped.code, 130) << stopped.err;
  EXPECT_EQ(Json::parse(stopped.out)["error"]["code"], "cancelled");
}

TEST_F(NfpTables, APipeThatNobodyReadsIsAnErrorAndOneThatIsReadIsWritten) {
  const Outcome unread = work.run("mkfifo table.json && timeout -k 1 20 dymsum nfp-table small.json -o table.json");
  EXPECT_EQ(unread.code, 2) << unread.err;
  EXPECT_NE(unread.err.find("table.json: nobody reads from this pipe"), std::string::npos) << unread.err;
  const Outcome read = work.run("cat table.json > copy & dymsum nfp-table small.json -o table.json; wait");
  EXPECT_EQ(read.code, 0) << read.err;
  done("dymsum nfp-table small.json -o plain.json");
  EXPECT_EQ(work.read("copy"), work.read("plain.json"));
}

TEST_F(NfpTables, WhatIsNoFileIsRefusedBeforeAnyWork) {
  const auto refused_as = [&](const std::string& preparation, const std::string& command, const std::string& named) {
    const Outcome outcome =
        work.run("rm -rf t c && " + preparation + " && timeout -k 1 9 dymsum nfp-table small.json " + command);
    EXPECT_EQ(outcome.code, 2) << preparation << ": " << outcome.err;
    EXPECT_NE(outcome.err.find(named), std::string::npos) << outcome.err;
  };
  for (const std::string kind : {"mkfifo", "ln -s /dev/zero", "ln -s /dev/null"})
    refused_as("mkdir c && " + kind + " c/shard-1-of-1.1.nfpt", "--cache c",
               "c/shard-1-of-1.1.nfpt: this is not a regular file");
  for (const std::string kind : {"mkfifo", "ln -s /dev/zero", "touch"})
    refused_as(kind + " c", "--cache c", "c: this is not a folder");
  refused_as("ln -s nowhere c", "--cache c", "c: this is a symbolic link to what is not there");
  refused_as("mkdir -p t/x.json", "-o t/x.json", "t/x.json: this is a directory");
  refused_as("mkdir t && ln -s gone/x t/x.json", "-o t/x.json", "t/x.json: no file can be made at t/gone/x");
}

TEST_F(NfpTables, DamagedCachesAreToldAndNotBelieved) {
  done("dymsum nfp-table small.json --cache c -o whole.jsonl");
  std::string bytes = work.read("c/shard-1-of-1.1.nfpt");
  bytes[bytes.size() / 2] ^= 4;
  work.write("c/shard-1-of-1.1.nfpt", bytes);
  const Outcome outcome = done("dymsum nfp-table small.json --cache c -o rows.jsonl");
  EXPECT_NE(outcome.err.find("c/shard-1-of-1.1.nfpt: not believed: it is damaged at byte"), std::string::npos);
  EXPECT_EQ(work.read("rows.jsonl"), work.read("whole.jsonl"));
}

TEST_F(NfpTables, WrongInstancesAreTold) {
  const auto bad = [&](const std::string& text, const std::string& named) {
    work.write("bad.json", text);
    const Outcome outcome = work.run("dymsum nfp-table bad.json");
    EXPECT_EQ(outcome.code, 2) << text;
    EXPECT_NE(outcome.err.find(named), std::string::npos) << outcome.err;
  };
  const std::string none = R"(,"allowed_orientations":[0])";
  bad("", "bad.json");
  bad("{}", "bad.json:1");
  bad(instance_text({item_text("a", shapes::letter_l(3, 3, 1))}), "--orientations");
  bad(R"({"items":[{"allowed_orientations":[0],"shape":{"type":"simple_polygon","data":[[0,0],[2,2],[2,0],[0,2]]}}]})",
      "bad.json#0");
  bad(R"({"items":[{"allowed_orientations":[0],"shape":{"type":"region",)"
      R"("data":{"parts":[],"polylines":[],"points":[]}}}]})",
      "empty");
  bad(instance_text({item_text("a", shapes::letter_l(3, 3, 1), none)},
                    R"(,"bins":[{"id":"b","shape":{"type":"simple_polygon","data":[[0,0],[0,1],[1,0]]}}])"),
      "bin b");
  EXPECT_EQ(work.run("dymsum nfp-table none.json").code, 2);
}

TEST_F(NfpTables, WrongUsage) {
  all_refused({"dymsum nfp-table small.json -o rows.txt", "dymsum nfp-table small.json -o small.json",
               "dymsum nfp-table small.json --shard 1/2", "dymsum nfp-table small.json --merge",
               "dymsum nfp-table small.json --shard 0/2 --cache c", "dymsum nfp-table small.json --shard 3/2 --cache c",
               "dymsum nfp-table small.json --shard 1 --cache c",
               "dymsum nfp-table small.json --shard 1/2 --cache c -o rows.jsonl",
               "dymsum nfp-table small.json --orientations 0", "dymsum nfp-table small.json --orientations 0deg,,9deg",
               "dymsum nfp-table small.json --orientations 0.5,1", "dymsum nfp-table small.json --error 0",
               "dymsum nfp-table small.json --time 0", "dymsum nfp-table small.json --threads 0",
               "dymsum nfp-table small.json --cache c --repeat 2",
               "dymsum nfp-table small.json --merge --cache c --threads 2"});
}

}  // namespace
}  // namespace dymsum::cli_test
