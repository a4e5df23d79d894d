// `dymsum view` as it runs, and a viewer's file for it.
#pragma once

#include <sys/types.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "process.h"

namespace dymsum::cli_test {

/// A page with the place for data, as the viewer has it, and the data out of such a page.
inline constexpr const char* kViewer =
    "<!doctype html><html><head><script id=\"dymsum-data\" type=\"application/json\"></script></head><body>a viewer"
    "</body></html>\n";
nlohmann::json data_of(const std::string& page);

/// The program in the folder of a workplace, with viewer.html there as its viewer, from its start to its end.
class Served {
 public:
  /// Waits until the address is printed, or the program ends.
  Served(const Workplace& work, std::vector<std::string> arguments);
  ~Served();
  Served(const Served&) = delete;
  Served& operator=(const Served&) = delete;

  /// 0 where the program has not printed an address.
  int port() const { return port_; }
  /// Sends a signal and waits: the exit code, or 128 and the signal that ended it.
  int end(int signal);
  std::string told() const;  ///< on standard error

 private:
  bool has_ended();

  const Workplace& work_;
  pid_t process_ = -1;
  int port_ = 0, code_ = -1;
};

}  // namespace dymsum::cli_test
