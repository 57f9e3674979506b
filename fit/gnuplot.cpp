#include "fit/gnuplot.h"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string_view>

#include "base/error.h"

namespace gonio {
namespace {

/// A script on disk while gnuplot reads it.
class Script {
 public:
  explicit Script(const std::string& content) {
    path_ = (std::filesystem::temp_directory_path() / "gonio-plot-XXXXXX").string();
    const int file = ::mkstemp(path_.data());
    if (file < 0) throw input_error("{}: cannot be written; expected a temporary folder with write permission", path_);
    const bool whole = ::write(file, content.data(), content.size()) == static_cast<ssize_t>(content.size());
    ::close(file);
    if (whole) return;
    ::unlink(path_.c_str());
    throw input_error("{}: writing failed; expected enough space on the disk", path_);
  }
  ~Script() { ::unlink(path_.c_str()); }
  Script(const Script&) = delete;
  Script& operator=(const Script&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// For the shell: a path of any characters as one word.
std::string quoted(const std::string& path) {
  std::string word(1, '\'');
  for (const char c : path) {
    if (c == '\'') word += "'\\'";  // closes the quotes, writes one, and the line below opens them again
    word += c;
  }
  word += '\'';
  return word;
}

/// What gnuplot draws to its standard output; `mark` is in every whole picture.
std::string drawn(const std::string& terminal, const std::string& script, std::string_view mark) {
  const Script file(fmt::format("set terminal {}\nset encoding utf8\n{}", terminal, script));
  const std::string command = "LC_ALL=C.UTF-8 gnuplot -d " + quoted(file.path()) + " 2>/dev/null";
  std::FILE* pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) throw input_error("gnuplot: cannot be started; expected gnuplot 5 (package gnuplot-nox)");
  std::string picture;
  char part[4096];
  for (std::size_t count; (count = std::fread(part, 1, sizeof part, pipe)) > 0;) picture.append(part, count);
  if (::pclose(pipe) != 0 || picture.find(mark) == picture.npos)
    throw input_error("gnuplot: failed to draw; expected gnuplot 5 (package gnuplot-nox)");
  return picture;
}

}  // namespace

std::string gnuplot_svg(const std::string& script, int width, int height) {
  return drawn(fmt::format("svg size {},{} fixed enhanced font 'sans-serif,14' background '#ffffff' name 'gonio'",
                           width, height),
               script, "</svg>");
}

std::string gnuplot_png(const std::string& script, int width, int height) {
  return drawn(fmt::format("pngcairo size {},{} enhanced font 'sans-serif,10' background '#ffffff'", width, height),
               script, "IEND");
}

std::string gnuplot_text(const std::string& text) {
  std::string literal;
  for (const char c : text) {
    if (c == '\'')
      literal += "''";
    else if (c == '_' || c == '^' || c == '@' || c == '{' || c == '}' || c == '~' || c == '&' || c == '\\')
      literal += std::string("\\") + c;
    else if (c == '\n' || c == '\r')
      literal += ' ';
    else
      literal += c;
  }
  return literal;
}

}  // namespace gonio
