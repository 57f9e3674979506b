#include "materials/user_database.h"

#include <cstdlib>

#include "base/error.h"
#include "base/files.h"
#include "materials/entry_store.h"

namespace gonio {
namespace fs = std::filesystem;

fs::path user_database_path() {
  const auto variable = [](const char* name) {
    const char* value = std::getenv(name);
    return value ? std::string(value) : std::string();
  };
  if (const std::string path = variable("GONIO_USER_DB"); !path.empty()) return path;
  if (const std::string data = variable("XDG_DATA_HOME"); !data.empty()) return fs::path(data) / "gonio/user.sqlite";
  if (const std::string home = variable("HOME"); !home.empty())
    return fs::path(home) / ".local/share/gonio/user.sqlite";
  return {};
}

void add_to_user_database(const fs::path& path, const std::vector<Entry>& entries, bool replace) {
  if (path.empty()) throw input_error("no home for a user database; expected $GONIO_USER_DB, $XDG_DATA_HOME or $HOME");
  if (path.has_parent_path()) make_folder(path.parent_path());
  EntryStore store = EntryStore::create(path);
  store.begin();
  for (const Entry& entry : entries) {
    if (store.full_id(entry.id)) {
      if (!replace)
        throw input_error("{}: {} is in the user database already; expected another --id, or --replace", entry.file,
                          entry.id);
      store.remove(entry.id);
    }
    store.put(entry, {});
  }
  store.commit();
}

}  // namespace gonio
