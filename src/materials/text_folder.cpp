#include "materials/text_folder.h"

#include <algorithm>

#include "base/error.h"
#include "base/files.h"
#include "materials/entry_reader.h"

namespace gonio {
namespace fs = std::filesystem;

namespace {

/// The text files of its sub-folders, by id.
std::map<std::string, fs::path> entry_files(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error))
    throw input_error("{}: is no folder; expected a materials database", folder.string());
  std::map<std::string, fs::path> files;
  for (const fs::directory_entry& kind : fs::directory_iterator(folder)) {
    if (!kind.is_directory()) continue;
    for (const fs::directory_entry& file : fs::directory_iterator(kind.path())) {
      if (file.path().extension() != ".txt") continue;
      const auto [at, fresh] = files.emplace(file.path().stem().string(), file.path());
      if (!fresh)
        throw input_error("{}: id {} is also {}; expected each id once", file.path().string(), at->first,
                          at->second.string());
    }
  }
  return files;
}

Entry read_file_of(const std::string& id, const fs::path& path) {
  Entry entry = read_entry(read_file(path), path.string());
  const std::string kind = path.parent_path().filename().string();
  if (entry.id != id) throw input_error("{}: id is '{}'; expected the file's name, {}", path.string(), entry.id, id);
  if (entry.kind != kind)
    throw input_error("{}: kind is '{}'; expected the folder's name, {}", path.string(), entry.kind, kind);
  return entry;
}

std::map<std::string, std::string> read_aliases(const fs::path& path, const std::map<std::string, fs::path>& files) {
  if (!fs::exists(path)) return {};
  const std::string text = read_file(path), file = path.string();
  std::map<std::string, std::string> aliases;
  int number = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view line = trimmed(std::string_view(text).substr(at, end - at));
    at = end + 1, ++number;
    if (line.empty() || line.front() == '#') continue;
    const auto colon = line.find(": ");
    if (colon == std::string_view::npos) throw input_error("{}:{}: no colon; expected `alias: id`", file, number);
    const std::string alias(trimmed(line.substr(0, colon))), id(trimmed(line.substr(colon + 1)));
    if (!files.contains(id))
      throw input_error("{}:{}: {} points to {}; expected the id of an entry", file, number, alias, id);
    if (files.contains(alias))
      throw input_error("{}:{}: {} is the id of an entry; expected another alias", file, number, alias);
    if (!aliases.emplace(alias, id).second)
      throw input_error("{}:{}: {} given again; expected once", file, number, alias);
  }
  return aliases;
}

}  // namespace

TextFolder read_text_folder(const fs::path& folder) {
  TextFolder read;
  const std::map<std::string, fs::path> files = entry_files(folder);
  for (const auto& [id, path] : files) try {
      Entry entry = read_file_of(id, path);
      entry.file = fmt::format("{}/{}", entry.kind, path.filename().string());
      read.entries.emplace(id, std::move(entry));
    } catch (const InputError& error) {
      read.broken.emplace(id, error.what());
    }
  read.aliases = read_aliases(folder / "aliases.txt", files);
  return read;
}

}  // namespace gonio
