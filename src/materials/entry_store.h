#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "materials/database.h"
#include "materials/sqlite.h"

namespace gonio {

/// Entries and aliases in one SQLite file, with full-text search over id, aliases, name, kind and citation. Numbers are
/// stored as their bits.
class EntryStore {
 public:
  /// An existing file, to read.
  static EntryStore open(const std::filesystem::path& path);
  /// A file to read and to write; made when it does not exist. `:memory:` for one that is never written.
  static EntryStore create(const std::filesystem::path& path);

  const std::string& path() const { return file_.path(); }
  std::vector<std::string> ids() const;
  /// alias and full id, by alias.
  std::vector<std::pair<std::string, std::string>> aliases() const;
  /// The full id of an id or alias; nothing when it is neither.
  std::optional<std::string> full_id(std::string_view id_or_alias) const;
  /// InputError when there is none, or what is stored is no entry.
  Entry entry(const std::string& id) const;
  /// Ids of the entries that have a word beginning with each of the query's words, best first.
  std::vector<std::string> search(std::string_view words) const;

  /// Everything put until commit() is written together, or nothing of it. Other writers wait from here on.
  void begin() { file_.execute("BEGIN IMMEDIATE"); }
  void put(const Entry& entry, const std::vector<std::string>& aliases);
  void remove(const std::string& id);
  void commit() { file_.execute("COMMIT"); }

 private:
  explicit EntryStore(SqlFile file) : file_(std::move(file)) {}
  SqlFile file_;
};

}  // namespace gonio
