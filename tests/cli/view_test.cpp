// dymsum view: what is served, to whom, and what happens when a file changes.
#include <gtest/gtest.h>
#include <httplib.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <future>
#include <map>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "cli_fixture.h"
#include "dymsum/dymsum.h"
#include "served.h"

namespace dymsum::cli_test {
namespace {

class View : public CliTest {
 protected:
  View() {
    work.write("viewer.html", kViewer);
    work.write("slot.wkt", kSlot);
    work.write("peg.wkt", kPeg);
    work.write("bow.wkt", kBow);
    work.write("cube.off", kCube);
    work.write("open.off", kOpen);
  }
  static httplib::Result get(const Served& served, const std::string& path, const httplib::Headers& headers = {}) {
    httplib::Client client("127.0.0.1", served.port());
    return client.Get(path, headers);
  }
  static Json data(const Served& served) {
    const auto answer = get(served, "/data.json");
    if (!answer) throw std::runtime_error("no answer: " + served.told());
    return Json::parse(answer->body);
  }
  /// How a stream of events begins, up to `what` in it.
  static std::string events_until(const Served& served, const std::string& what, const std::string& path,
                                  const httplib::Headers& headers = {}) {
    httplib::Client client("127.0.0.1", served.port());
    client.set_read_timeout(30);
    std::string heard;
    client.Get(path, headers, [&](const char* text, std::size_t size) {
      heard.append(text, size);
      return heard.find(what) == std::string::npos;
    });
    return heard;
  }
};

TEST_F(View, ThePageHoldsTheFilesAndOptions) {
  Served served(work, {"slot.wkt", "peg.wkt"});
  const auto page = get(served, "/"), alone = get(served, "/data.json");
  ASSERT_TRUE(page && alone) << served.told();
  EXPECT_EQ(page->status, 200);
  EXPECT_EQ(page->get_header_value("Content-Type"), "text/html; charset=utf-8");
  EXPECT_EQ(alone->get_header_value("Content-Type"), "application/json");
  EXPECT_TRUE(page->body.ends_with("<body>a viewer</body></html>\n"));
  const Json data = data_of(page->body);
  EXPECT_EQ(data, Json::parse(alone->body));
  EXPECT_EQ(data["format"], 1);
  EXPECT_EQ(data["page"], "sum");
  EXPECT_EQ(data["live"], true);
  EXPECT_EQ(data["revision"], 0);
  EXPECT_EQ(data["inputs"], Json::parse(R"([{"name": "slot.wkt"}, {"name": "peg.wkt"}])")
                                .patch({{{"op", "add"}, {"path", "/0/text"}, {"value", kSlot}},
                                        {{"op", "add"}, {"path", "/1/text"}, {"value", kPeg}}}));
  EXPECT_EQ(data["parameters"], Json({{"verb", "view"}}));
}

TEST_F(View, NothingElseIsLoadedAndNobodyElseReads) {
  Served served(work, {"slot.wkt"});
  const auto page = get(served, "/");
  ASSERT_TRUE(page) << served.told();
  const std::string policy = page->get_header_value("Content-Security-Policy");
  EXPECT_TRUE(policy.starts_with("default-src 'none';")) << policy;
  EXPECT_EQ(policy.find("http"), std::string::npos) << policy;
  EXPECT_NE(policy.find("frame-ancestors 'none'"), std::string::npos) << policy;
  EXPECT_EQ(page->get_header_value("Cross-Origin-Resource-Policy"), "same-origin");
  EXPECT_EQ(page->get_header_value("Cross-Origin-Opener-Policy"), "same-origin");
  EXPECT_EQ(page->get_header_value("Cross-Origin-Embedder-Policy"), "require-corp");
  EXPECT_EQ(page->get_header_value("X-Content-Type-Options"), "nosniff");
  EXPECT_EQ(page->get_header_value("Cache-Control"), "no-store");
}

TEST_F(View, NoPathNamesAFile) {
  Served served(work, {"slot.wkt", "peg.wkt"});
  for (const char* path : {"/slot.wkt", "/viewer.html", "/../slot.wkt", "/../../../../../../etc/passwd",
                           "/%2e%2e/%2e%2e/%2e%2e/etc/passwd", "/..%2f..%2f..%2fetc/passwd", "/index.html", "/events/x",
                           "/dataXjson", "/data.json/../slot.wkt", "//etc/passwd", "/./"}) {
    const auto answer = get(served, path);
    ASSERT_TRUE(answer) << path;
    EXPECT_EQ(answer->status, 404) << path << "\n" << answer->body;
    EXPECT_EQ(answer->body, "There is nothing here.\n") << path;
  }
}

TEST_F(View, ItIsOnlyRead) {
  Served served(work, {"slot.wkt"});
  httplib::Client client("127.0.0.1", served.port());
  for (const auto& answer : {client.Post("/", "", "text/plain"), client.Put("/data.json", "", "text/plain"),
                             client.Delete("/"), client.Options("/")}) {
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->status, 405);
    EXPECT_EQ(answer->get_header_value("Allow"), "GET, HEAD");
  }
  const auto head = client.Head("/");
  ASSERT_TRUE(head);
  EXPECT_EQ(head->status, 200);
  EXPECT_EQ(head->body, "");
}

// A name of another site that leads to the loopback (DNS rebinding) has that name as its host.
TEST_F(View, OnlyTheLoopbackIsAnsweredByName) {
  Served served(work, {"slot.wkt"});
  const std::string port = ":" + std::to_string(served.port());
  const std::map<std::string, int> hosts = {{"127.0.0.1" + port, 200},
                                            {"localhost" + port, 200},
                                            {"evil.example" + port, 403},
                                            {"evil.example", 403},
                                            {"127.0.0.1", 403},
                                            {"127.0.0.1:1", 403},
                                            {"", 403},
                                            {"127.0.0.1.evil.example" + port, 403},
                                            {"localhost.evil.example" + port, 403}};
  for (const auto& [host, status] : hosts) {
    for (const char* path : {"/", "/data.json", "/nothing"}) {
      const auto answer = get(served, path, {{"Host", host}});
      ASSERT_TRUE(answer) << host;
      EXPECT_EQ(answer->status, status == 200 && path == std::string("/nothing") ? 404 : status) << host << path;
      EXPECT_EQ(answer->body.find("POLYGON") == std::string::npos, answer->status != 200) << host << path;
    }
  }
}

TEST_F(View, AChangedFileIsTold) {
  Served served(work, {"slot.wkt", "peg.wkt"});
  auto heard = std::async(std::launch::async, [&] { return events_until(served, "change", "/events?revision=0"); });
  std::this_thread::sleep_for(std::chrono::milliseconds(700));
  work.write("peg.wkt", kSquare);
  EXPECT_NE(heard.get().find("id: 1\nevent: change\ndata: {\"revision\": 1}\n\n"), std::string::npos);
  const Json now = data(served);
  EXPECT_EQ(now["revision"], 1);
  EXPECT_EQ(now["inputs"][0]["text"], kSlot);
  EXPECT_EQ(now["inputs"][1]["text"], kSquare);
  EXPECT_EQ(data_of(get(served, "/")->body), now);
  EXPECT_NE(served.told().find("peg.wkt has changed\n"), std::string::npos) << served.told();
}

TEST_F(View, WhoMissedAChangeIsToldAtOnce) {
  Served served(work, {"peg.wkt"});
  work.write("peg.wkt", kSquare);
  const std::string told = "id: 1\nevent: change\ndata: {\"revision\": 1}\n\n";
  EXPECT_NE(events_until(served, told, "/events?revision=0").find(told), std::string::npos);
  EXPECT_NE(events_until(served, told, "/events?revision=1", {{"Last-Event-ID", "0"}}).find(told), std::string::npos);
  EXPECT_NE(events_until(served, told, "/events?revision=9").find(told), std::string::npos) << "of an earlier server";
  // Who knows it is told nothing: comments keep the stream open.
  EXPECT_EQ(events_until(served, ":\n\n:\n\n", "/events?revision=1"), ":\n\n:\n\n");
}

TEST_F(View, AFileThatIsWrittenAnewWithTheSameTextIsNoChange) {
  Served served(work, {"peg.wkt"});
  for (int i = 0; i < 3; ++i) {
    work.write("peg.wkt", kPeg);
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
  }
  EXPECT_EQ(data(served)["revision"], 0);
}

TEST_F(View, AChangeToABadFileIsShownAndTold) {
  Served served(work, {"peg.wkt"});
  work.write("peg.wkt", kBow);
  EXPECT_NE(events_until(served, "change", "/events?revision=0").find("\"revision\": 1"), std::string::npos);
  EXPECT_EQ(data(served)["inputs"][0]["text"], kBow);
  const Outcome info = work.run("dymsum info peg.wkt");
  EXPECT_EQ(info.code, 2);
  EXPECT_NE(served.told().find(info.err), std::string::npos) << served.told();
}

TEST_F(View, AFileThatIsGoneForAWhileChangesNothing) {
  Served served(work, {"peg.wkt"});
  EXPECT_EQ(work.run("rm peg.wkt; sleep 0.8").code, 0);
  EXPECT_EQ(data(served)["revision"], 0);
  EXPECT_EQ(data(served)["inputs"][0]["text"], kPeg);
  work.write("new.wkt", kSquare);
  EXPECT_EQ(work.run("mv new.wkt peg.wkt").code, 0);
  EXPECT_NE(events_until(served, "change", "/events?revision=0").find("\"revision\": 1"), std::string::npos);
  EXPECT_EQ(data(served)["inputs"][0]["text"], kSquare);
}

TEST_F(View, AFileThatBecomesAPipeOrADeviceChangesNothing) {
  Served served(work, {"peg.wkt", "slot.wkt"});
  EXPECT_EQ(work.run("rm peg.wkt slot.wkt; mkfifo peg.wkt; ln -s /dev/zero slot.wkt; sleep 0.8").code, 0);
  EXPECT_EQ(data(served)["revision"], 0);
  EXPECT_EQ(data(served)["inputs"][0]["text"], kPeg);
  work.write("new.wkt", kSquare);
  EXPECT_EQ(work.run("mv new.wkt peg.wkt").code, 0);
  EXPECT_NE(events_until(served, "change", "/events?revision=0").find("\"revision\": 1"), std::string::npos);
  EXPECT_EQ(data(served)["inputs"][0]["text"], kSquare);
}

TEST_F(View, SignalsEndItWhileStreamsAreOpen) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    Served served(work, {"slot.wkt"});
    ASSERT_NE(served.port(), 0) << served.told();
    auto stream = std::async(std::launch::async, [&] { return events_until(served, "nothing", "/events?revision=0"); });
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(served.end(signal), 0) << signal << served.told();
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5)) << signal;
    EXPECT_EQ(stream.get().find("change"), std::string::npos);
  }
}

TEST_F(View, ManyStreamsLeaveTheOthersAnswered) {
  Served served(work, {"slot.wkt"});
  std::atomic<int> answered = 0;
  std::vector<std::future<int>> streams;
  for (int i = 0; i < 30; ++i) {
    streams.push_back(std::async(std::launch::async, [&] {
      httplib::Client client("127.0.0.1", served.port());
      client.set_read_timeout(30);
      const auto seen = [&](const httplib::Response&) { return ++answered, true; };
      const auto answer = client.Get("/events", {}, seen, [](const char*, std::size_t) { return true; });
      return answer ? answer->status : 0;
    }));
    while (answered <= i && streams.back().wait_for(std::chrono::milliseconds(5)) != std::future_status::ready)
      continue;
  }
  EXPECT_EQ(data(served)["revision"], 0);
  EXPECT_EQ(served.end(SIGINT), 0);
  std::map<int, int> answers;
  for (auto& stream : streams) ++answers[stream.get()];
  EXPECT_EQ(answers, (std::map<int, int>{{200, 24}, {503, 6}}));
}

TEST_F(View, APortThatIsTakenIsAnError) {
  Served served(work, {"slot.wkt"});
  const std::string port = std::to_string(served.port());
  const Outcome second = work.run("DYMSUM_VIEWER=viewer.html dymsum view slot.wkt --no-open --port " + port);
  EXPECT_EQ(second.code, 2);
  EXPECT_EQ(second.out, "");
  EXPECT_EQ(second.err,
            "dymsum: port " + port + " of 127.0.0.1 is taken by another program; without --port a free one is found\n");
  EXPECT_EQ(served.end(SIGINT), 0);
  Served third(work, {"slot.wkt", "--port", port});
  EXPECT_EQ(std::to_string(third.port()), port) << "an address that was just left can be taken again";
}

TEST_F(View, ThePageFollowsFromTheFiles) {
  work.write("parts.json", R"({"items":[{"shape":{"type":"simple_polygon","data":[[0,0],[3,0],[3,1]]}},
                                        {"shape":{"type":"simple_polygon","data":[[0,0],[1,0],[0,1]]}}]})");
  const std::map<std::string, std::vector<std::string>> pages = {
      {"home", {}},
      {"sum", {"slot.wkt"}},
      {"solids", {"cube.off", "cube.off"}},
      {"nesting", {"parts.json"}},
      {"obstacle", {"peg.wkt", "slot.wkt", "--page", "obstacle"}},
      {"discs", {"slot.wkt", "--page", "discs"}}};
  for (const auto& [page, arguments] : pages) {
    Served served(work, arguments);
    ASSERT_NE(served.port(), 0) << page << served.told();
    EXPECT_EQ(data(served)["page"], page);
  }
  Served served(work, {"slot.wkt", "peg.wkt", "slot.wkt"});
  EXPECT_EQ(data(served)["page"], "nesting");
}

TEST_F(View, PagesThatDoNotFitTheFilesAreRefused) {
  const auto wrong = [&](const std::string& rest, const std::string& named) {
    refused("DYMSUM_VIEWER=viewer.html timeout 9 dymsum view --no-open " + rest, named);
  };
  wrong("cube.off --page sum", "--page sum shows regions, not solids: cube.off");
  wrong("slot.wkt --page solids", "--page solids shows solids, not regions: slot.wkt");
  wrong("slot.wkt cube.off", "all operands have to be solids, or none");
  wrong("cube.off cube.off cube.off", "the page solids shows at most 2 files, not 3");
  wrong("slot.wkt peg.wkt --page discs", "the page discs shows at most 1 file, not 2");
  wrong("slot.wkt --page picture", "picture");
  wrong("slot.wkt --port 65536", "--port wants a whole number from 0 to 65535");
  wrong("slot.wkt --from wkt", "--from is the format of standard input");
}

TEST_F(View, BadFilesAreToldAsEverywhere) {
  for (const char* file : {"absent.wkt", "bow.wkt", "open.off", "picture.gif"}) {
    const Outcome view = work.run("DYMSUM_VIEWER=viewer.html timeout 9 dymsum view --no-open " + std::string(file));
    const Outcome info = work.run("dymsum info " + std::string(file));
    EXPECT_EQ(view.code, 2) << file << view.err;
    EXPECT_EQ(view.out, "") << file;
    EXPECT_EQ(view.err, info.err) << file;
  }
}

TEST_F(View, WithoutAViewerItSaysWhatBuildsOne) {
  const Outcome none = work.run("DYMSUM_VIEWER= timeout 9 dymsum view slot.wkt --no-open");
  EXPECT_EQ(none.code, 2);
  EXPECT_NE(none.err.find("`./run web` builds it"), std::string::npos) << none.err;
  const Outcome absent = work.run("DYMSUM_VIEWER=absent.html timeout 9 dymsum view slot.wkt --no-open");
  EXPECT_EQ(absent.code, 2);
  EXPECT_NE(absent.err.find("absent.html: no such file"), std::string::npos) << absent.err;
  const Outcome other = work.run("DYMSUM_VIEWER=slot.wkt timeout 9 dymsum view slot.wkt --no-open");
  EXPECT_EQ(other.code, 2);
  EXPECT_NE(other.err.find("slot.wkt: not a viewer of dymsum"), std::string::npos) << other.err;
}

TEST_F(View, TheBrowserIsOpenedAtTheAddress) {
  EXPECT_EQ(
      work.run("mkdir bin && printf '#!/bin/sh\\necho \"$1\" > opened\\n' > bin/xdg-open && chmod +x bin/xdg-open")
          .code,
      0);
  const std::string view = "DYMSUM_VIEWER=viewer.html timeout -s INT 2 dymsum view slot.wkt";
  const Outcome opened = work.run("PATH=$PWD/bin:$PATH " + view);
  EXPECT_TRUE(opened.out.starts_with("http://127.0.0.1:")) << opened.err;
  EXPECT_EQ(work.read("opened"), opened.out);
  const Outcome without = work.run(
      "mkdir few && ln -s $(command -v sh) $(command -v timeout) $(command -v dymsum) few/ && PATH=$PWD/few " + view);
  EXPECT_NE(without.err.find("there is no xdg-open here: open the address in a browser"), std::string::npos)
      << without.err;
}

TEST_F(View, NoInputEndsTheElementOfTheData) {
  const std::string svg =
      "<svg xmlns=\"http://www.w3.org/2000/svg\"><!-- </script><script> --><path d=\"M0 0H1V1Z\"/></svg>";
  work.write("path.svg", svg);
  Served served(work, {"path.svg"});
  const auto page = get(served, "/");
  ASSERT_TRUE(page) << served.told();
  EXPECT_EQ(data_of(page->body)["inputs"][0]["text"], svg);
}

TEST_F(View, BytesThatAreNoTextAreGivenAsBase64) {
  work.write("cube.stl", format_mesh(solids::box(0, 0, 0, 1, 2, 3).data(), MeshFormat::stl));
  Served served(work, {"cube.stl"});
  const Json input = data(served)["inputs"][0];
  ASSERT_TRUE(input.contains("base64")) << input;
  work.write("cube.base64", input["base64"].get<std::string>());
  EXPECT_EQ(work.run("base64 -d cube.base64 | cmp - cube.stl").code, 0);
}

}  // namespace
}  // namespace dymsum::cli_test
