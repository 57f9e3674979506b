// Any bytes as a foreign measurement; the first one picks the format (and one more value a MERL file with a small grid):
// a Measurement or an InputError, nothing else. What is read has to survive being written and read again.
#include <string>

#include "fit/formats/formats.h"
#include "fit/formats/readers.h"
#include "fit/formats/writers.h"
#include "read_measurement.h"

namespace {

const std::string kFile = "file";

gonio::Measurement read(std::size_t which, std::string_view bytes) {
  const auto formats = gonio::formats();
  which %= formats.size() + 1;
  if (which == formats.size()) return gonio::read_merl_grid(bytes, kFile, {3, 4, 5});
  (void)formats[which].recognises(bytes.substr(0, 4096));
  return formats[which].read(bytes, kFile);
}

using gonio::fuzz::check, gonio::fuzz::require;

void check_round_trip(const gonio::Measurement& scan) {
  const gonio::Measurement known = gonio::parse_measurement_yaml(gonio::measurement_yaml(scan), "m.yaml");
  const gonio::Measurement again = gonio::parse_scan(gonio::scan_csv(scan), "scan.csv", known);
  require(again.points.size() == scan.points.size());
  for (std::size_t k = 0; k < scan.points.size(); ++k) require(again.points[k].f_per_sr == scan.points[k].f_per_sr);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  gonio::Measurement scan;
  try {
    scan = read(data[0], {reinterpret_cast<const char*>(data) + 1, size - 1});
  } catch (const gonio::InputError&) {
    return 0;
  }
  check(scan);
  require(!scan.conventions.empty());
  check_round_trip(scan);  // a refusal here is a finding
  return 0;
}
