#pragma once
// The readers behind formats(): each takes a whole file.
#include <string>
#include <string_view>

#include "fit/scan.h"

namespace gonio {

bool is_astm(std::string_view head);
Measurement read_astm(std::string_view bytes, const std::string& file);

bool is_zemax(std::string_view head);
Measurement read_zemax(std::string_view bytes, const std::string& file);

bool is_lighttools(std::string_view head);
Measurement read_lighttools(std::string_view bytes, const std::string& file);

bool is_alta(std::string_view head);
Measurement read_alta(std::string_view bytes, const std::string& file);

bool is_ssdd(std::string_view head);
Measurement read_ssdd(std::string_view bytes, const std::string& file);

bool is_angle_table(std::string_view head);
Measurement read_angle_table(std::string_view bytes, const std::string& file);

/// The grid of a MERL file; another one only for tests (the files all have this one).
struct MerlGrid {
  int theta_h = 90, theta_d = 90, phi_d = 180;
  std::size_t cells() const {
    return static_cast<std::size_t>(theta_h) * static_cast<std::size_t>(theta_d) * static_cast<std::size_t>(phi_d);
  }
};

bool is_merl(std::string_view head);
Measurement read_merl(std::string_view bytes, const std::string& file);
Measurement read_merl_grid(std::string_view bytes, const std::string& file, const MerlGrid& grid);

}  // namespace gonio
