#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "materials/database.h"

namespace gonio {

/// A folder of text entries as materials_db: <kind>/<id>.txt and aliases.txt.
struct TextFolder {
  std::map<std::string, Entry> entries;       ///< by id
  std::map<std::string, std::string> broken;  ///< id of an entry that cannot be read: why, in one line
  std::map<std::string, std::string> aliases;
};

/// Reads all of it; one broken entry hides no other. InputError for the folder itself, an id in two places, or aliases
/// that cannot be used.
TextFolder read_text_folder(const std::filesystem::path& folder);

}  // namespace gonio
