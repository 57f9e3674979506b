#include "spectrum/sensor.h"

#include <algorithm>

#include "base/error.h"

namespace gonio {
namespace {

double whole(const Spectrum& light, const Spectrum& curve) {
  double sum = 0;
  for (double nm = std::ceil(curve.lo_nm()); nm <= curve.hi_nm(); ++nm)
    sum += std::abs(light.at(std::clamp(nm, light.lo_nm(), light.hi_nm())) * curve.at(nm));
  return sum;
}

Response response_of(const Factor& data, const Spectrum& light, const Spectrum& curve, const std::string& channel) {
  const double lo = std::ceil(std::max({data.lo_nm, light.lo_nm(), curve.lo_nm()}));
  const double hi = std::min({data.hi_nm, light.hi_nm(), curve.hi_nm()});
  double sum = 0, white = 0, seen = 0;
  for (double nm = lo; nm <= hi; ++nm) {
    const double weight = light.at(nm) * curve.at(nm);
    sum += weight * data.at(nm), white += weight, seen += std::abs(weight);
  }
  if (!(white > 0))
    throw input_error("{}: channel {} sees nothing of the light from {} to {} nm; expected some", data.name, channel,
                      lo, hi);
  return {channel, 100 * sum / white, std::max(0.0, 1 - seen / whole(light, curve))};
}

}  // namespace

std::vector<Response> responses_of(const Factor& data, const Spectrum& light, const Sensor& sensor,
                                   bool allow_partial) {
  std::vector<Response> responses;
  for (std::size_t c = 0; c < sensor.channel.size(); ++c) {
    responses.push_back(response_of(data, light, {sensor.wavelength_nm, sensor.curve[c]}, sensor.channel[c]));
    const Response& last = responses.back();
    if (last.share_left_out > kMostLeftOut && !allow_partial)
      throw input_error(
          "{}: {:.2f} % of what channel {} sees is left out; expected at most {:g} % (allow with --allow-partial)",
          data.name, 100 * last.share_left_out, last.channel, 100 * kMostLeftOut);
  }
  return responses;
}

bool is_colorimetric(const Sensor& sensor) {
  return sensor.channel == std::vector<std::string>{"xbar", "ybar", "zbar"};
}

Observer colorimetric(const Sensor& sensor) {
  return {sensor.wavelength_nm, sensor.curve[0], sensor.curve[1], sensor.curve[2]};
}

}  // namespace gonio
