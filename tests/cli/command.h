#pragma once
// tests/cli: the built command from outside, as a person or a script meets it.
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace gonio::test {

struct Outcome {
  int status = -1;  ///< exit status; 128 + signal when killed
  std::string out, err;
};

/// Runs the built `gonio` with these arguments and this standard input; its output goes to `out_file` where one is
/// named.
Outcome run_gonio(const std::vector<std::string>& arguments, std::string_view input = {},
                  std::string_view out_file = {});

/// A file as bytes; empty when there is none.
std::string content_of(const std::filesystem::path& path);

/// A folder of its own for one test, removed at its end.
class Scratch {
 public:
  Scratch();
  ~Scratch();
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  std::string path(std::string_view name = {}) const { return (folder_ / name).string(); }
  /// Writes a file into the folder; its path.
  std::string file(std::string_view name, std::string_view content) const;
  /// Every file and folder below, sorted: to see that nothing was left behind.
  std::vector<std::string> listing() const;

 private:
  std::filesystem::path folder_;
};

/// What every refusal looks like: exit 2, nothing on standard output, exactly one line on standard error that holds
/// `words`, and nothing new in the scratch folder.
void check_refused(const Scratch& scratch, const std::vector<std::string>& arguments, std::string_view words,
                   std::string_view input = {});

}  // namespace gonio::test
