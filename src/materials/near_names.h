#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace gonio {

/// The few names most like a mistyped one, nearest first: by edit distance without regard to case, or beginning alike.
std::vector<std::string> near_names(std::string_view typed, const std::vector<std::string>& names);

/// Whether the text has every word of the query, without regard to (ASCII) case.
bool has_every_word(std::string_view text, std::string_view words);

}  // namespace gonio
