#pragma once
#include <filesystem>
#include <vector>

#include "materials/database.h"

namespace gonio {

/// Where the user's own entries live: $GONIO_USER_DB, else $XDG_DATA_HOME/gonio/user.sqlite, else
/// ~/.local/share/gonio/user.sqlite; empty where there is no home.
std::filesystem::path user_database_path();

/// Adds entries, all of them or none; the file and its folder are made when missing. Any number of processes may do so
/// at once. An id that is there already is an InputError unless it may be replaced.
void add_to_user_database(const std::filesystem::path& path, const std::vector<Entry>& entries, bool replace);

}  // namespace gonio
