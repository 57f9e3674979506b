#pragma once
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <cstddef>

namespace gonio {

/// f(i) for i = 0 … count - 1, in any order, on several threads where there is much to do.
template <class F>
void for_each_index(std::size_t count, F&& f) {
  constexpr std::size_t kGrain = 2048;
  if (count <= kGrain) {
    for (std::size_t i = 0; i < count; ++i) f(i);
    return;
  }
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, kGrain), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) f(i);
  });
}

}  // namespace gonio
