#include "cli/command.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "catch.h"

namespace gonio::test {
namespace fs = std::filesystem;
namespace {

/// In the child: the three streams are files, so that no pipe can fill up.
[[noreturn]] void become_gonio(const std::vector<std::string>& arguments, const fs::path& in, const fs::path& out,
                               const fs::path& err) {
  const int flags = O_WRONLY | O_CREAT | O_TRUNC;
  if (dup2(open(in.c_str(), O_RDONLY), 0) != 0 || dup2(open(out.c_str(), flags, 0600), 1) != 1 ||
      dup2(open(err.c_str(), flags, 0600), 2) != 2)
    _exit(126);
  std::vector<char*> argv{const_cast<char*>("gonio")};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  setenv("GONIO_HOME", GONIO_SOURCE_DIR, 0);  // for a build folder outside the source tree
  execv(GONIO_COMMAND, argv.data());
  _exit(127);
}

}  // namespace

std::string content_of(const fs::path& path) {
  std::ostringstream content;
  content << std::ifstream(path, std::ios::binary).rdbuf();
  return std::move(content).str();
}

Outcome run_gonio(const std::vector<std::string>& arguments, std::string_view input, std::string_view out_file) {
  const Scratch streams;
  const fs::path in = streams.file("in", input),
                 out = out_file.empty() ? fs::path(streams.path("out")) : fs::path(out_file), err = streams.path("err");
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("fork failed");
  if (child == 0) become_gonio(arguments, in, out, err);
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 127) throw std::runtime_error(GONIO_COMMAND " cannot be run");
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
          out_file.empty() ? content_of(out) : std::string(), content_of(err)};
}

Scratch::Scratch() {
  std::string name = (fs::temp_directory_path() / "gonio-test-XXXXXX").string();
  if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
  folder_ = name;
}

Scratch::~Scratch() {
  std::error_code error;
  fs::remove_all(folder_, error);
}

std::string Scratch::file(std::string_view name, std::string_view content) const {
  const fs::path path = folder_ / name;
  fs::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary).write(content.data(), static_cast<std::streamsize>(content.size()));
  return path.string();
}

std::vector<std::string> Scratch::listing() const {
  std::vector<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder_)) names.push_back(entry.path().string());
  std::sort(names.begin(), names.end());
  return names;
}

void check_refused(const Scratch& scratch, const std::vector<std::string>& arguments, std::string_view words,
                   std::string_view input) {
  std::string line = "gonio";
  for (const std::string& argument : arguments) line += " " + argument;
  const std::vector<std::string> before = scratch.listing();
  const Outcome outcome = run_gonio(arguments, input);
  const auto lines = std::count(outcome.err.begin(), outcome.err.end(), '\n');
  std::string wrong;
  if (outcome.status != 2) wrong += "exit status " + std::to_string(outcome.status) + " instead of 2; ";
  if (!outcome.out.empty()) wrong += "standard output is not empty; ";
  if (lines != 1 || !outcome.err.ends_with('\n')) wrong += std::to_string(lines) + " lines of error instead of 1; ";
  if (outcome.err.find(words) == outcome.err.npos) wrong += "the error lacks `" + std::string(words) + "`; ";
  for (const std::string& name : scratch.listing())
    if (!std::binary_search(before.begin(), before.end(), name)) wrong += "left behind: " + name + "; ";
  INFO(line << "\nstderr: " << outcome.err);
  CHECK(wrong == "");
}

}  // namespace gonio::test
