// The viewer's one file: where it is, and data put into it.
#pragma once

#include <optional>
#include <string>

namespace dymsum::cli {

/// The path of the viewer's file: DYMSUM_VIEWER (empty: there is none), else where an installation has it, else where
/// `./run web` leaves it in the build tree of this program; nothing where it is in none of these places.
std::optional<std::string> find_viewer();

/// The viewer's text, without data. Stops with bad input that says where it was looked for and what builds it, and for
/// a file that has no place for data.
std::string viewer_text();

/// The viewer with data inside: JSON text without "<", as viewer_json makes it. Requires: text of viewer_text().
std::string viewer_with(const std::string& viewer, const std::string& data);

}  // namespace dymsum::cli
