// What somebody may have meant by a word that is none of ours.
#pragma once

#include <string>
#include <vector>

namespace dymsum::cli {

/// The candidate that is closest to the word by insertions, deletions, replacements and swapped neighbours, where that
/// is at most a third of its letters (and at least two are allowed), or the first one that begins with it; else "".
std::string closest(const std::string& word, const std::vector<std::string>& candidates);

/// "; did you mean sum?", or nothing.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace dymsum::cli
