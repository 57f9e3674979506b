// Any bytes as a Radiance or LBNL BSDF file (XML): a Measurement that can be fitted or an InputError, nothing else.
#include "fit/formats/bsdf_xml.h"
#include "read_measurement.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return gonio::fuzz::foreign_file(data, size, gonio::read_bsdf_xml);
}
