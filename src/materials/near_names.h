#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace gonio {

/// ASCII letters in lower case, all else as it is.
std::string lower(std::string_view text);

/// The few names most like a mistyped one, nearest first: by edit distance without regard to case, or beginning alike.
std::vector<std::string> near_names(std::string_view typed, const std::vector<std::string>& names);

}  // namespace gonio
