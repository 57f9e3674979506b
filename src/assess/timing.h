#pragma once
#include <algorithm>
#include <chrono>

namespace gonio {

/// Nanoseconds of one call of `run`, the least over several stretches of at least `stretch_ms`: other work on the machine only adds.
template <class F>
double least_ns(F&& run, double stretch_ms = 2, int stretches = 7) {
  using Clock = std::chrono::steady_clock;
  const auto stretch = [&](long calls) {
    const auto start = Clock::now();
    for (long call = 0; call < calls; ++call) run();
    return std::chrono::duration<double, std::nano>(Clock::now() - start).count();
  };
  long calls = 1;
  double took = stretch(calls);
  while (took < stretch_ms * 1e6 && calls < (1L << 40)) took = stretch(calls *= 2);
  double least = took / static_cast<double>(calls);
  for (int i = 1; i < stretches; ++i) least = std::min(least, stretch(calls) / static_cast<double>(calls));
  return least;
}

/// Keeps a result, and what computed it, from being left out by the compiler.
template <class T>
void keep(const T& x) {
  asm volatile("" : : "g"(&x) : "memory");
}

}  // namespace gonio
