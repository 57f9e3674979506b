// Any bytes as a file to import, read as YAML or as a table by the first byte: an Entry that is whole, or an InputError
// of one line, nothing else.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "base/error.h"
#include "materials/entry_checks.h"
#include "materials/import.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string text(reinterpret_cast<const char*>(data) + 1, size - 1);
  gonio::ImportOptions options;
  options.citation = "fuzz";
  try {
    const gonio::Entry entry = gonio::read_import(text, data[0] & 1 ? "fuzz.yml" : "fuzz.csv", options);
    try {
      gonio::check_whole_entry(entry);
      if (!(entry.at(entry.range_lo_nm) >= 0 || entry.kind == "daylight-basis" || entry.kind == "rgb-observer"))
        std::abort();
    } catch (const gonio::InputError&) {
      std::abort();
    }
  } catch (const gonio::InputError& error) {
    if (std::string(error.what()).find('\n') != std::string::npos) std::abort();
  }
  return 0;
}
