// Any bytes as an Integra table: a Measurement that can be fitted or an InputError, nothing else.
#include "fit/formats/ddr.h"
#include "read_measurement.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return gonio::fuzz::foreign_file(data, size, gonio::read_ddr);
}
