// Running the command line tool as a person would, in a folder of its own.
#pragma once

#include <filesystem>
#include <string>

namespace dymsum::cli_test {

struct Outcome {
  int code = -1;
  std::string out, err;
};

/// A fresh folder, removed at the end; commands run inside it with `dymsum` on the path, and
/// without a viewer, whether one is built or not.
class Workplace {
 public:
  Workplace();
  ~Workplace();
  Workplace(const Workplace&) = delete;
  Workplace& operator=(const Workplace&) = delete;

  /// Runs a shell command.
  Outcome run(const std::string& command) const;

  void write(const std::string& file, const std::string& text) const;
  std::string read(const std::string& file) const;
  bool exists(const std::string& file) const;
  std::size_t file_count() const;
  const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path folder_;
};

std::string read_text(const std::filesystem::path& file);

}  // namespace dymsum::cli_test
