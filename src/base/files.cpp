#include "base/files.h"

#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "base/error.h"

namespace gonio {
namespace fs = std::filesystem;

WholeFile::WholeFile(fs::path target) : target_(std::move(target)) {
  temporary_ = target_;
  temporary_ += fmt::format(".{}.part", ::getpid());
  std::error_code error;
  if (fs::is_directory(target_, error))
    throw input_error("{}: is a folder; expected a file to write", target_.string());
  if (!std::ofstream(temporary_, std::ios::binary))
    throw input_error("{}: cannot be written; expected an existing folder with write permission", target_.string());
}

WholeFile::~WholeFile() {
  std::error_code error;
  if (!committed_) fs::remove(temporary_, error);
}

void WholeFile::commit() {
  std::error_code error;
  fs::rename(temporary_, target_, error);
  if (error)
    throw input_error("{}: cannot be written ({}); expected a writable file", target_.string(), error.message());
  committed_ = true;
}

void write_file(const fs::path& target, std::string_view content) {
  WholeFile file(target);
  std::ofstream out(file.temporary(), std::ios::binary);
  out.write(content.data(), static_cast<std::streamsize>(content.size()));
  out.close();
  if (!out) throw input_error("{}: writing failed; expected enough space on the disk", target.string());
  file.commit();
}

std::string read_file(const fs::path& path) {
  std::error_code error;
  if (fs::is_directory(path, error)) throw input_error("{}: is a folder; expected a file", path.string());
  std::ifstream in(path, std::ios::binary);
  if (!in) throw input_error("{}: cannot be read; expected an existing file", path.string());
  std::ostringstream content;
  content << in.rdbuf();
  if (in.bad()) throw input_error("{}: reading failed; expected a readable file", path.string());
  return std::move(content).str();
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || !fs::is_directory(folder))
    throw input_error("{}: cannot be created ({}); expected a writable folder", folder.string(),
                      error ? error.message() : "a file has that name");
}

namespace {

/// The first of $GONIO_HOME and the folders upwards from the program's that has it; empty when none has.
template <class Wanted>
fs::path beside_the_program(std::string_view name, Wanted wanted) {
  std::error_code error;
  if (const char* home = std::getenv("GONIO_HOME"))
    if (fs::path path = fs::path(home) / name; wanted(path)) return path;
  for (fs::path at = fs::read_symlink("/proc/self/exe", error).parent_path(); at != at.root_path();
       at = at.parent_path()) {
    if (fs::path path = at / name; wanted(path)) return path;
    if (fs::path path = at / "share" / "gonio" / name; wanted(path)) return path;
  }
  return {};
}

}  // namespace

fs::path data_folder(std::string_view name) {
  fs::path folder = beside_the_program(name, [](const fs::path& path) {
    std::error_code error;
    return fs::is_directory(path, error);
  });
  if (folder.empty())
    throw input_error("{}: the data folder was not found; expected it beside the program or under $GONIO_HOME", name);
  return folder;
}

std::optional<fs::path> find_data_file(std::string_view name) {
  fs::path file = beside_the_program(name, [](const fs::path& path) {
    std::error_code error;
    return fs::is_regular_file(path, error);
  });
  if (file.empty()) return std::nullopt;
  return file;
}

fs::path data_file(std::string_view name) {
  if (auto file = find_data_file(name)) return *file;
  throw input_error("{}: was not found; expected it beside the program, in share/gonio or under $GONIO_HOME", name);
}

}  // namespace gonio
