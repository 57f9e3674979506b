#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace gonio {

/// A file that appears whole or not at all: write to temporary(), then commit() renames it into place. Without commit
/// nothing is left behind. Throws InputError when the folder cannot be written.
class WholeFile {
 public:
  explicit WholeFile(std::filesystem::path target);
  ~WholeFile();
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;
  const std::filesystem::path& temporary() const { return temporary_; }
  void commit();

 private:
  std::filesystem::path target_, temporary_;
  bool committed_ = false;
};

void write_file(const std::filesystem::path& target, std::string_view content);

/// The whole file as bytes; InputError when it cannot be read.
std::string read_file(const std::filesystem::path& path);

/// Makes the folder (and its parents); InputError `PATH: cannot be created; …` when that fails or it is a file.
void make_folder(const std::filesystem::path& folder);

/// The data that comes with gonio (materials_db, measurements, scenes): beside the source tree's build, the installed
/// share/gonio, or $GONIO_HOME. Throws InputError when it is not found.
std::filesystem::path data_folder(std::string_view name);

/// A file made by the build for the program (materials.sqlite): found as data_folder() finds folders.
std::filesystem::path data_file(std::string_view name);
/// The same; empty where there is none.
std::optional<std::filesystem::path> find_data_file(std::string_view name);

}  // namespace gonio
