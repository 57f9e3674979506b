// Any bytes as a scan (and, after the first NUL byte, as its measurement.yaml): a Measurement or an InputError, nothing
// else.
#include <string>

#include "read_measurement.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  const std::size_t split = text.find('\0');
  try {
    gonio::Measurement known;
    if (split != text.npos) known = gonio::parse_measurement_yaml(text.substr(split + 1), "measurement.yaml");
    const gonio::Measurement scan = gonio::parse_scan(std::string_view(text).substr(0, split), "scan.csv", known);
    gonio::fuzz::check(scan);
  } catch (const gonio::InputError&) {
  }
  return 0;
}
