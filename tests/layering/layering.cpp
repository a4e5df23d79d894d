#include "layering.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <regex>

namespace dymsum::layering {
namespace {

namespace fs = std::filesystem;

/// Every folder of src/ that may hold files, in their order: a file in any other is a violation.
const std::vector<std::string> kRooms = {
    "base",
    "exact",
    "planar/region",
    "planar/shapes",
    "planar/position",
    "planar/operand",
    "planar/convolution",
    "planar/mask",
    "planar/arrangement",
    "planar/boundary",
    "planar/result",
    "planar/sum",
    "planar/boolean",
    "planar/composed",
    "planar/motion",
    "planar/window",
    "planar/frame",
    "planar/family",
    "planar/edit",
    "cspace/events",
    "cspace/boundary",
    "cspace/obstacle",
    "cspace/motion",
    "cspace/planner",
    "cspace/queries",
    "cspace/mesh",
    "cspace/family",
    "spatial/mesh",
    "spatial/solids",
    "spatial/gauss",
    "spatial/convex",
    "spatial/convolution",
    "spatial/arrangement",
    "spatial/boundary",
    "spatial/sum",
    "spatial/boolean",
    "spatial/motion",
    "spatial/moving",
    "spatial/edit",
    "spatial/events",
    "spatial/family",
    "spatial/local",
    "spatial/erode",
    "spatial/offset",
    "spatial/slice",
    "depth",
    "fit",
    "io",
    "io/region",
    "io/mesh",
    "io/picture",
    "io/obstacle",
    "io/family",
    "io/edit",
    "nesting",
    "placement",
    "check",
    "uncertain",
    "shape/complex",
    "shape/disc",
    "shape/features",
    "shape/decompose",
};

/// Rooms that may not use one that stands before them: the arrangement works on labelled segments.
const std::map<std::string, std::string> kUnheard = {{"planar/arrangement", "planar/convolution"}};

/// Those of the other trees. The folders of the command line include each other freely; the WebAssembly module has its
/// writers.
const std::vector<std::string> kOtherRooms = {
    "include/dymsum", "cli",        "cli/verbs",        "cli/planar",           "cli/solid",
    "cli/pictures",   "cli/viewer", "examples",         "adapters/ompl/dymsum", "adapters/ompl/dymsum/ompl",
    "python/src",     "web/wasm",   "web/wasm/further", "web/wasm/library"};

/// Headers from outside the standard library by the first folder of the rooms that may include them. What the operating
/// system has for files and terminals is in `base` and `cli`: elsewhere another system finds nothing to replace.
const std::map<std::string, std::vector<std::string>> kForeign = {
    {"base",
     {"tbb/", "oneapi/", "fast_float/", "fmt/", "emmintrin.h", "wasm_simd128.h", "fcntl.h", "pthread.h", "sys/file.h",
      "sys/stat.h", "unistd.h"}},  // the compiler's own: vector registers, where it has them
    {"exact", {"boost/multiprecision/"}},
    {"planar", {"emmintrin.h"}},
    {"spatial", {"emmintrin.h"}},
    {"io", {"nlohmann/", "pugixml.hpp", "sqlite3.h", "zip.h", "zlib.h"}},
    {"nesting", {"nlohmann/"}},
    {"shape", {"boost/polygon/"}},
    {"cli", {"CLI/", "httplib.h", "malloc.h", "nlohmann/", "sys/socket.h", "unistd.h"}},
    {"adapters", {"ompl/"}},
    {"examples", {"ompl/"}},
    {"python", {"cxxabi.h", "nanobind/"}},
    {"web", {"__iterator/", "emscripten/"}},  // libc++ itself, whose sorts are replaced
};

/// The folder of a path if it is one of these rooms, or "".
std::string room_in(const std::vector<std::string>& rooms, const std::string& path) {
  const std::string folder = path.substr(0, std::min(path.rfind('/'), path.size()));
  return std::find(rooms.begin(), rooms.end(), folder) != rooms.end() ? folder : "";
}

std::size_t rank(const std::string& room) {
  return static_cast<std::size_t>(std::find(kRooms.begin(), kRooms.end(), room) - kRooms.begin());
}

bool is_standard(const std::string& name) { return name.find_first_of("/.") == std::string::npos; }

/// One include line of the file `path` (below `root`): what is wrong with it, or "".
class Judge {
 public:
  Judge(const fs::path& root, const std::string& path) : root_(root), path_(path) {
    top_ = path.substr(0, path.find('/'));
    room_ = top_ == "src" ? room_in(kRooms, path.substr(4)) : room_in(kOtherRooms, path);
  }

  std::string bracketed(const std::string& name) const {
    if (is_standard(name)) return "";
    if (top_ == "examples" && name.starts_with("dymsum/")) return in_quotes(name);
    const auto foreign = kForeign.find(room_.substr(0, room_.find('/')));
    if (foreign != kForeign.end()) {
      for (const std::string& prefix : foreign->second) {
        if (name.starts_with(prefix)) return "";
      }
    }
    return "a foreign header that this room may not use";
  }

  std::string in_quotes(const std::string& name) const {
    if (name.starts_with("dymsum/")) {
      const bool found = fs::exists(root_ / "include" / name) ||
                         ((top_ == "adapters" || top_ == "examples") && fs::exists(root_ / "adapters/ompl" / name));
      return found ? "" : "no such public header";
    }
    if (top_ == "include") return "public headers include only the standard library and each other";
    if (fs::exists((root_ / path_).parent_path() / name) && name.find("..") == std::string::npos) return "";
    if ((top_ == "cli" || top_ == "web") && fs::exists(root_ / "cli" / name)) return "";
    if (room_ == "web/wasm/further" && fs::exists(root_ / "web/wasm" / name)) return "";
    if (top_ != "src") return "only public headers may be used here";
    const std::string other = room_in(kRooms, name);
    if (other.empty()) return "no such room";
    if (!fs::exists(root_ / "src" / name)) return "no such file";
    if (const auto unheard = kUnheard.find(room_); unheard != kUnheard.end() && unheard->second == other)
      return "room " + room_ + " knows nothing of room " + other;
    return rank(other) <= rank(room_) ? "" : "room " + other + " stands after room " + room_;
  }

  bool in_room() const { return !room_.empty(); }

 private:
  fs::path root_;
  std::string path_, top_, room_;
};

void read_file(const fs::path& root, const std::string& path, std::vector<Violation>& found) {
  const Judge judge(root, path);
  if (!judge.in_room()) found.push_back({path, 0, "", "no such room"});
  static const std::regex kInclude(R"re(^\s*#\s*include\s*(["<])([^">]+)[">].*)re");
  std::ifstream in(root / path);
  std::string text;
  for (int line = 1; std::getline(in, text); ++line) {
    std::smatch match;
    if (!std::regex_match(text, match, kInclude)) continue;
    const bool quotes = match[1] == "\"";
    const std::string name = match[2];
    const std::string why = quotes ? judge.in_quotes(name) : judge.bracketed(name);
    if (!why.empty()) found.push_back({path, line, quotes ? '"' + name + '"' : '<' + name + '>', why});
  }
}

}  // namespace

const std::vector<std::string>& rooms() { return kRooms; }
const std::vector<std::string>& other_rooms() { return kOtherRooms; }

Reading read_tree(const fs::path& root) {
  std::vector<std::string> files;
  for (const char* top : {"include", "src", "cli", "adapters", "examples", "python", "web/wasm"}) {
    if (!fs::exists(root / top)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
      const std::string extension = entry.path().extension().string();
      if (entry.is_regular_file() && (extension == ".h" || extension == ".cpp")) {
        files.push_back(fs::relative(entry.path(), root).generic_string());
      }
    }
  }
  std::sort(files.begin(), files.end());
  Reading reading;
  reading.files = files.size();
  for (const std::string& file : files) read_file(root, file, reading.violations);
  return reading;
}

}  // namespace dymsum::layering
