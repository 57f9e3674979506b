// gonio_compile_materials FOLDER FILE: the text entries of materials_db in one SQLite file with full-text search. A
// build step; a broken entry is named and stops the build.
#include <fmt/format.h>

#include <iostream>
#include <map>

#include "base/error.h"
#include "base/files.h"
#include "materials/entry_store.h"
#include "materials/text_folder.h"

namespace {

void compile(const std::string& folder, const std::string& target) {
  const gonio::TextFolder text = gonio::read_text_folder(folder);
  for (const auto& [id, error] : text.broken) std::cerr << error << '\n';
  if (!text.broken.empty() || text.entries.empty())
    throw gonio::input_error("{}: {} entries, {} broken; expected some and none", folder, text.entries.size(),
                             text.broken.size());
  std::map<std::string, std::vector<std::string>> aliases;
  for (const auto& [alias, id] : text.aliases) aliases[id].push_back(alias);
  gonio::WholeFile file(target);  // makes it, empty: a database without tables
  gonio::EntryStore store = gonio::EntryStore::create(file.temporary());
  store.begin();
  for (const auto& [id, entry] : text.entries) store.put(entry, aliases[id]);
  store.commit();
  file.commit();
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 3) throw gonio::input_error("usage: gonio_compile_materials FOLDER FILE");
  compile(argv[1], argv[2]);
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
