// What no verb takes, whatever its options are.
#pragma once

namespace CLI {
class App;
}

namespace dymsum::cli {

/// Stops with wrong usage where an operand or the value of an option is empty, where -o names one place twice, and
/// where standard input is to be read twice; with bad input, before any long work, where an output cannot be written.
void check_arguments(const CLI::App& verb);

}  // namespace dymsum::cli
