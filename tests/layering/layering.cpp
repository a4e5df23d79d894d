#include "layering.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <regex>

namespace dymsum::layering {
namespace {

namespace fs = std::filesystem;

/// The rooms of src/ in their order; a folder inside a room is a room of its own only where it is named here.
const std::vector<std::string> kRooms = {"base",    "exact", "planar", "planar/scaling", "planar/rotation",
                                         "spatial", "io"};

/// Headers from outside the standard library by the room that may include them; POSIX ones for files and terminals.
const std::map<std::string, std::vector<std::string>> kForeign = {
    {"base", {"tbb/", "oneapi/"}},
    {"exact", {"boost/multiprecision/"}},
    {"planar", {"emmintrin.h"}},  // the compiler's own: vector registers, where it has them
    {"spatial", {"emmintrin.h"}},
    {"io", {"nlohmann/", "pugixml.hpp", "fcntl.h", "sys/stat.h", "unistd.h"}},
    {"cli", {"CLI/", "nlohmann/", "unistd.h"}},
};

bool is_below(const std::string& path, const std::string& folder) { return path.starts_with(folder + "/"); }

/// The room of a path below src/, or "" for a folder that is no room.
std::string room_of(const std::string& path) {
  std::string room;
  for (const std::string& candidate : kRooms) {
    if (is_below(path, candidate) && candidate.size() > room.size()) room = candidate;
  }
  return room;
}

std::size_t rank(const std::string& room) {
  return static_cast<std::size_t>(std::find(kRooms.begin(), kRooms.end(), room) - kRooms.begin());
}

bool is_standard(const std::string& name) { return name.find_first_of("/.") == std::string::npos; }

/// One include line of the file `path` (below `root`): what is wrong with it, or "".
class Judge {
 public:
  Judge(const fs::path& root, const std::string& path) : root_(root), path_(path) {
    if (is_below(path, "src/apps")) {
      room_ = "apps";
    } else if (is_below(path, "src")) {
      room_ = room_of(path.substr(4));
    } else {
      room_ = path.substr(0, path.find('/'));
    }
  }

  std::string bracketed(const std::string& name) const {
    if (is_standard(name)) return "";
    if (room_ == "examples" && name.starts_with("dymsum/")) return in_quotes(name);
    const auto foreign = kForeign.find(room_.substr(0, room_.find('/')));
    if (foreign != kForeign.end()) {
      for (const std::string& prefix : foreign->second) {
        if (name.starts_with(prefix)) return "";
      }
    }
    return "a foreign header that this room may not use";
  }

  std::string in_quotes(const std::string& name) const {
    if (name.starts_with("dymsum/")) return fs::exists(root_ / "include" / name) ? "" : "no such public header";
    if (room_ == "include") return "public headers include only the standard library and each other";
    if (fs::exists((root_ / path_).parent_path() / name) && name.find("..") == std::string::npos) return "";
    const std::string other = room_of(name);
    if (room_ == "apps" && other == "base") return fs::exists(root_ / "src" / name) ? "" : "no such file";
    if (room_ == "cli" || room_ == "apps" || room_ == "examples") return "only public headers may be used here";
    if (other.empty()) return "no such room";
    if (!fs::exists(root_ / "src" / name)) return "no such file";
    return rank(other) <= rank(room_) ? "" : "room " + other + " stands after room " + room_;
  }

  bool in_room() const { return !room_.empty(); }

 private:
  fs::path root_;
  std::string path_, room_;
};

void read_file(const fs::path& root, const std::string& path, std::vector<Violation>& found) {
  const Judge judge(root, path);
  if (!judge.in_room()) found.push_back({path, 0, "", "src/ has no such room"});
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

Reading read_tree(const fs::path& root) {
  std::vector<std::string> files;
  for (const char* top : {"include", "src", "cli", "examples"}) {
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
