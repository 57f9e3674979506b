#pragma once
#include <cstdint>
#include <string_view>

namespace gonio {

/// FNV-1a, 64 bits (Fowler, Noll & Vo 1991): tells changed bytes from the same ones, no guard against malice.
inline std::uint64_t digest_of(std::string_view bytes, std::uint64_t seed = 14695981039346656037ULL) {
  for (const char byte : bytes) seed = (seed ^ static_cast<unsigned char>(byte)) * 1099511628211ULL;
  return seed;
}

}  // namespace gonio
