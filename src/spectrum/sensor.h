#pragma once
// Any curves as an observer: a film, a camera, cones. What they answer to is a response a channel, not a colour.
#include <string>
#include <vector>

#include "spectrum/colorimetry.h"

namespace gonio {

struct Sensor {
  std::vector<std::string> channel;        ///< names
  std::vector<double> wavelength_nm;       ///< increasing
  std::vector<std::vector<double>> curve;  ///< curve[channel][point]; may be negative (colour-matching functions)
  std::string name = "sensor";             ///< for messages
};

struct Response {
  std::string channel;
  double value;           ///< 100 for the perfect diffuser
  double share_left_out;  ///< of ∫|S·curve| over the curve's range; the light's nearest value stands in outside its own
};

/// A response a channel to what is lit and seen, relative to the perfect diffuser (an exposure balanced for the light),
/// summed at whole nanometres common to light, data and curve. InputError when they share none, when a channel is blind
/// to the light, or when more than kMostLeftOut is left out of a channel and `allow_partial` is false.
std::vector<Response> responses_of(const Factor& data, const Spectrum& light, const Sensor& sensor,
                                   bool allow_partial = false);

/// The sensor as a colorimetric observer: when its channels are xbar, ybar, zbar.
bool is_colorimetric(const Sensor& sensor);
Observer colorimetric(const Sensor& sensor);

}  // namespace gonio
