#include "materials/database.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <mutex>

#include "base/error.h"
#include "base/files.h"
#include "materials/entry_checks.h"
#include "materials/entry_store.h"
#include "materials/near_names.h"
#include "materials/text_folder.h"
#include "materials/user_database.h"

namespace gonio {
namespace fs = std::filesystem;

namespace {

/// One file of entries; of a folder of text, those that cannot be read are kept by their error.
struct Layer {
  EntryStore store;
  bool user = false;
  std::map<std::string, std::string, std::less<>> broken;
};

Layer layer_of_folder(const fs::path& folder) {
  TextFolder text = read_text_folder(folder);
  std::map<std::string, std::vector<std::string>> aliases;
  for (const auto& [alias, id] : text.aliases) aliases[id].push_back(alias);
  Layer layer{EntryStore::create(":memory:"), false, {text.broken.begin(), text.broken.end()}};
  layer.store.begin();
  for (const auto& [id, entry] : text.entries) layer.store.put(entry, aliases[id]);
  layer.store.commit();
  return layer;
}

bool is_file(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

}  // namespace

struct Database::State {
  /// The layer that holds it and its full id there; bundled ones come first.
  std::pair<Layer*, std::string> place_of(std::string_view id_or_alias) {
    for (Layer& layer : layers) {
      if (auto id = layer.store.full_id(id_or_alias)) return {&layer, *id};
      if (layer.broken.contains(id_or_alias)) return {&layer, std::string(id_or_alias)};
    }
    return {nullptr, ""};
  }

  const Entry& entry_of(Layer& layer, const std::string& id) {
    if (const auto known = entries.find(id); known != entries.end()) return *known->second;
    if (const auto broken = layer.broken.find(id); broken != layer.broken.end()) throw InputError(broken->second);
    auto entry = std::make_unique<Entry>(layer.store.entry(id));
    entry->user = layer.user;
    if (layer.user) check_whole_entry(*entry);  // anybody may have written it
    return *entries.emplace(id, std::move(entry)).first->second;
  }

  void add_user_database(const fs::path& path) {
    if (!fs::exists(path)) return;
    try {
      layers.push_back({EntryStore::open(path), true, {}});
    } catch (const InputError& error) {
      unreadable.emplace_back(error.what());
    }
  }

  std::vector<std::string> ids() const {
    std::vector<std::string> ids;
    for (const Layer& layer : layers) {
      const std::vector<std::string> more = layer.store.ids();
      ids.insert(ids.end(), more.begin(), more.end());
      for (const auto& [id, error] : layer.broken) ids.push_back(id);
    }
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    return ids;
  }

  std::vector<Layer> layers;
  std::vector<std::string> unreadable;  ///< user databases that are none
  std::map<std::string, std::unique_ptr<Entry>, std::less<>> entries;  ///< read, by id
  std::map<std::string, const Entry*, std::less<>> found;              ///< by the ids and aliases asked for
  std::mutex mutex;
};

const Database& Database::bundled() {
  static const Database database = [] {
    auto state = std::make_unique<State>();
    state->layers.push_back({EntryStore::open(data_file("materials.sqlite")), false, {}});
    if (const fs::path user = user_database_path(); !user.empty()) state->add_user_database(user);
    return Database(std::move(state));
  }();
  return database;
}

Database::Database(std::unique_ptr<State> state) : state_(std::move(state)) {}

Database::Database(const std::string& path) : state_(std::make_unique<State>()) {
  if (is_file(path))
    state_->layers.push_back({EntryStore::open(path), false, {}});
  else
    state_->layers.push_back(layer_of_folder(path));
}

Database::~Database() = default;

bool Database::contains(std::string_view id_or_alias) const {
  const std::scoped_lock lock(state_->mutex);
  return state_->place_of(id_or_alias).first != nullptr;
}

std::string Database::full_id(std::string_view id_or_alias) const {
  const std::scoped_lock lock(state_->mutex);
  if (const auto [layer, id] = state_->place_of(id_or_alias); layer) return id;
  std::vector<std::string> names = state_->ids();
  for (const Layer& layer : state_->layers)
    for (const auto& [alias, id] : layer.store.aliases()) names.push_back(alias);
  const std::vector<std::string> near = near_names(id_or_alias, names);
  const std::string also = state_->unreadable.empty() ? "" : " (" + state_->unreadable.front() + ")";
  if (near.empty())
    throw input_error("no entry '{}' in the database{}; expected an id or alias of `gonio materials list`", id_or_alias,
                      also);
  throw input_error("no entry '{}' in the database{}; near: {}", id_or_alias, also, fmt::join(near, ", "));
}

const Entry& Database::find(std::string_view id_or_alias) const {
  {
    const std::scoped_lock lock(state_->mutex);
    if (const auto known = state_->found.find(id_or_alias); known != state_->found.end()) return *known->second;
  }
  const std::string id = full_id(id_or_alias);
  const std::scoped_lock lock(state_->mutex);
  const Entry& entry = state_->entry_of(*state_->place_of(id).first, id);
  state_->found.emplace(id_or_alias, &entry);
  return entry;
}

std::vector<std::string> Database::ids() const {
  const std::scoped_lock lock(state_->mutex);
  return state_->ids();
}

std::vector<std::string> Database::aliases_of(std::string_view id) const {
  const std::scoped_lock lock(state_->mutex);
  std::vector<std::string> aliases;
  for (const Layer& layer : state_->layers)
    for (const auto& [alias, target] : layer.store.aliases())
      if (target == id) aliases.push_back(alias);
  return aliases;
}

std::vector<const Entry*> Database::all() const {
  std::vector<const Entry*> entries;
  for (const std::string& id : ids()) try {
      entries.push_back(&find(id));
    } catch (const InputError&) {  // findings() tells
    }
  return entries;
}

std::vector<const Entry*> Database::search(std::string_view words) const {
  std::vector<std::string> ids;
  {
    const std::scoped_lock lock(state_->mutex);
    for (const Layer& layer : state_->layers)
      for (std::string& id : layer.store.search(words)) ids.push_back(std::move(id));
  }
  std::vector<const Entry*> found;
  for (const std::string& id : ids) try {
      const Entry* entry = &find(id);
      if (std::find(found.begin(), found.end(), entry) == found.end()) found.push_back(entry);
    } catch (const InputError&) {
    }
  return found;
}

std::vector<std::string> Database::findings() const {
  std::vector<std::string> findings = state_->unreadable;
  for (const std::string& id : ids()) try {
      check_whole_entry(find(id));
    } catch (const InputError& error) {
      findings.emplace_back(error.what());
    }
  const std::scoped_lock lock(state_->mutex);
  for (const Layer& layer : state_->layers)
    for (const std::string& id : layer.store.ids())
      if (layer.user && state_->place_of(id).first != &layer)
        findings.push_back(
            fmt::format("{}: {} hides behind a bundled name; expected another id", layer.store.path(), id));
  return findings;
}

}  // namespace gonio
