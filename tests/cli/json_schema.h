// As much of JSON Schema (2020-12) as docs/guide/report.schema.json uses. A keyword that is not known throws.
#pragma once

#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

namespace dymsum::cli_test {

/// What is wrong with a value: "/answers/0/at: ..." for each violation; empty when it follows `$defs/NAME` of the
/// schema.
std::vector<std::string> violations(const nlohmann::json& schema, const std::string& name, const nlohmann::json& value);

}  // namespace dymsum::cli_test
