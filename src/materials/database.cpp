#include "materials/database.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <mutex>

#include "base/error.h"
#include "base/files.h"
#include "materials/entry_reader.h"
#include "materials/near_names.h"

namespace gonio {
namespace fs = std::filesystem;

namespace {

struct Slot {
  std::string file, kind;
  std::unique_ptr<Entry> entry;  ///< read when first asked for
};
using Slots = std::map<std::string, Slot, std::less<>>;
using Aliases = std::map<std::string, std::string, std::less<>>;

/// Which entries there are, from file names alone.
Slots list_slots(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error))
    throw input_error("{}: is no folder; expected a materials database", folder.string());
  Slots slots;
  for (const fs::directory_entry& kind : fs::directory_iterator(folder)) {
    if (!kind.is_directory()) continue;
    for (const fs::directory_entry& file : fs::directory_iterator(kind.path())) {
      if (file.path().extension() != ".txt") continue;
      const std::string id = file.path().stem().string();
      const auto [at, fresh] =
          slots.try_emplace(id, Slot{file.path().string(), kind.path().filename().string(), nullptr});
      if (!fresh)
        throw input_error("{}: id {} is also {}; expected each id once", file.path().string(), id, at->second.file);
    }
  }
  return slots;
}

Aliases read_aliases(const fs::path& folder, const Slots& slots) {
  const fs::path path = folder / "aliases.txt";
  if (!fs::exists(path)) return {};
  const std::string text = read_file(path), file = path.string();
  Aliases aliases;
  int number = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view line = trimmed(std::string_view(text).substr(at, end - at));
    at = end + 1, ++number;
    if (line.empty() || line.front() == '#') continue;
    const auto colon = line.find(": ");
    if (colon == std::string_view::npos) throw input_error("{}:{}: no colon; expected `alias: id`", file, number);
    const std::string alias(trimmed(line.substr(0, colon))), id(trimmed(line.substr(colon + 1)));
    if (!slots.contains(id))
      throw input_error("{}:{}: {} points to {}; expected the id of an entry", file, number, alias, id);
    if (slots.contains(alias))
      throw input_error("{}:{}: {} is the id of an entry; expected another alias", file, number, alias);
    if (!aliases.emplace(alias, id).second)
      throw input_error("{}:{}: {} given again; expected once", file, number, alias);
  }
  return aliases;
}

}  // namespace

struct Database::State {
  explicit State(const fs::path& folder) : slots(list_slots(folder)), aliases(read_aliases(folder, slots)) {}

  const Entry& entry_of(const std::string& id, Slot& slot) {
    const std::scoped_lock lock(mutex);
    if (slot.entry) return *slot.entry;
    auto entry = std::make_unique<Entry>(read_entry(read_file(slot.file), slot.file));
    if (entry->id != id) throw input_error("{}: id is '{}'; expected the file's name, {}", slot.file, entry->id, id);
    if (entry->kind != slot.kind)
      throw input_error("{}: kind is '{}'; expected the folder's name, {}", slot.file, entry->kind, slot.kind);
    slot.entry = std::move(entry);
    return *slot.entry;
  }

  Slot* slot_of(std::string_view id_or_alias) {
    const auto alias = aliases.find(id_or_alias);
    const auto slot = slots.find(alias == aliases.end() ? id_or_alias : std::string_view(alias->second));
    return slot == slots.end() ? nullptr : &slot->second;
  }

  Slots slots;
  Aliases aliases;
  std::mutex mutex;
};

const Database& Database::bundled() {
  static const Database database(data_folder("materials_db").string());
  return database;
}

Database::Database(std::string folder) : state_(std::make_unique<State>(folder)) {}
Database::~Database() = default;

bool Database::contains(std::string_view id_or_alias) const { return state_->slot_of(id_or_alias) != nullptr; }

std::string Database::full_id(std::string_view id_or_alias) const {
  if (const auto alias = state_->aliases.find(id_or_alias); alias != state_->aliases.end()) return alias->second;
  if (const auto slot = state_->slots.find(id_or_alias); slot != state_->slots.end()) return slot->first;
  std::vector<std::string> names;
  for (const auto& [id, slot] : state_->slots) names.push_back(id);
  for (const auto& [alias, id] : state_->aliases) names.push_back(alias);
  const std::vector<std::string> near = near_names(id_or_alias, names);
  if (near.empty())
    throw input_error("no entry '{}' in the database; expected an id or alias of `gonio materials list`", id_or_alias);
  throw input_error("no entry '{}' in the database; near: {}", id_or_alias, fmt::join(near, ", "));
}

const Entry& Database::find(std::string_view id_or_alias) const {
  const std::string id = full_id(id_or_alias);
  return state_->entry_of(id, *state_->slot_of(id));
}

std::vector<std::string> Database::ids() const {
  std::vector<std::string> ids;
  for (const auto& [id, slot] : state_->slots) ids.push_back(id);
  return ids;
}

std::vector<std::string> Database::aliases_of(std::string_view id) const {
  std::vector<std::string> aliases;
  for (const auto& [alias, target] : state_->aliases)
    if (target == id) aliases.push_back(alias);
  return aliases;
}

std::vector<const Entry*> Database::all() const {
  std::vector<const Entry*> entries;
  for (auto& [id, slot] : state_->slots) entries.push_back(&state_->entry_of(id, slot));
  return entries;
}

std::vector<const Entry*> Database::search(std::string_view words) const {
  std::vector<const Entry*> found;
  for (const Entry* entry : all()) {
    const std::string text = fmt::format("{} {} {} {} {}", entry->id, fmt::join(aliases_of(entry->id), " "),
                                         entry->name, entry->kind, entry->citation);
    if (has_every_word(text, words)) found.push_back(entry);
  }
  return found;
}

}  // namespace gonio
