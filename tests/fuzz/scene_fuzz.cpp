// Any bytes as a scene file: a scene that can be rendered, or an InputError of one line, nothing else.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "base/error.h"
#include "scene/scene_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    gonio::check(gonio::parse_scene(std::string(reinterpret_cast<const char*>(data), size), "fuzz"));
  } catch (const gonio::InputError& error) {
    if (std::string(error.what()).find('\n') != std::string::npos) std::abort();
  }
  return 0;
}
