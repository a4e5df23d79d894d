#include "memory_limit.h"

#include <CLI/CLI.hpp>
#include <atomic>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <new>

#include "counted_new.h"
#include "exit_code.h"
#include "options.h"
#include "solid/solid_limits.h"

namespace dymsum::cli {
namespace {

std::string megabytes_text(std::uint64_t bytes) { return std::to_string((bytes + 999999) / 1000000) + " MB"; }

/// Ends the program where an array is wanted in code that no exception may leave, as where a report is taken apart.
/// Texts need some memory, too.
[[noreturn]] void end_at_limit() {
  lift_memory_limit();
  const std::string reached = memory_limit_reached();
  if (!reached.empty()) {
    std::cerr << "out of memory: " << reached << "\n";
    std::_Exit(kBadInput);
  }
  std::abort();
}

}  // namespace

void add_memory_limit(CLI::App& verb, double& megabytes) {
  within(verb.add_option("--memory", megabytes, "Stop with an error before more than MB megabytes are held"), 1, 1e9)
      ->type_name("MB");
}

void limit_memory(double megabytes) {
  if (megabytes == 0) return;
  std::set_terminate(end_at_limit);
  count_memory(memory_bytes(megabytes));
}

void lift_memory_limit() { count_memory(0); }

std::string memory_limit_reached() {
  const CountedMemory counted = counted_memory();
  if (counted.refused == 0) return "";
  return "the limit of --memory is " + megabytes_text(counted.limit) + ", and " + megabytes_text(counted.refused) +
         " would be held";
}

}  // namespace dymsum::cli
