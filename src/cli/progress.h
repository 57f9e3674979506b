#pragma once
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <mutex>
#include <string>

namespace gonio::cli {

/// On stderr: a bar on a terminal, a line every tenth elsewhere; nothing in the first second. From any thread.
class Progress {
 public:
  explicit Progress(std::string what) : what_(std::move(what)) {}

  void show(double done) {
    const std::lock_guard lock(mutex_);
    if (std::chrono::steady_clock::now() - start_ < std::chrono::seconds(1)) return;
    const int step = terminal_ ? static_cast<int>(done * 100) : static_cast<int>(done * 10) * 10;
    if (step <= shown_) return;
    shown_ = step;
    if (terminal_)
      std::fprintf(stderr, "\r%s [%-25.*s] %3d %%%s", what_.c_str(), step / 4, "#########################", step,
                   step == 100 ? "\n" : "");
    else
      std::fprintf(stderr, "%s: %d %%\n", what_.c_str(), step);
  }

 private:
  std::mutex mutex_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  const std::string what_;
  const bool terminal_ = isatty(2) != 0;
  int shown_ = 0;
};

}  // namespace gonio::cli
