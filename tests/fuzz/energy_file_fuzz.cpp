// Tables of E: an OpenEXR file of anybody's is read or refused.
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <string>

#include "base/error.h"
#include "base/files.h"
#include "energy/energy_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("gonio-fuzz-" + std::to_string(getpid()) + ".exr");
  gonio::write_file(file, {reinterpret_cast<const char*>(data), size});
  try {
    gonio::read_energy_table(file);
  } catch (const gonio::InputError&) {
  }
  return 0;
}
