#include "energy/limits_json.h"

#include <cmath>

namespace gonio {
namespace {
using Json = nlohmann::ordered_json;

Json wavelength(double nm) { return nm > 0 ? Json(nm) : Json(nullptr); }
}  // namespace

Json to_json(const Limits& limits) {
  Json rows = Json::array();
  for (const LimitRow& row : limits.rows)
    rows.push_back({{"theta_deg", row.theta_deg},
                    {"E", row.e.value},
                    {"error", row.e.error},
                    {"wavelength_nm", wavelength(row.wavelength_nm)},
                    {"coherent_energy", row.coherent},
                    {"total", row.total}});
  return {{"ks_max", std::isfinite(limits.ks_max) ? Json(limits.ks_max) : Json(nullptr)},
          {"kd_max", limits.kd_max},
          {"E", rows},
          {"coherent_energy", limits.coherent_energy},
          {"range_nm", limits.range_lo_nm > 0 ? Json({limits.range_lo_nm, limits.range_hi_nm}) : Json(nullptr)},
          {"conserving_to_deg", limits.theta_max_deg},
          {"worst",
           {{"total", limits.worst_total},
            {"theta_deg", limits.worst_theta_deg},
            {"wavelength_nm", wavelength(limits.worst_wavelength_nm)}}},
          {"behaviour", limits.behaviour()},
          {"kd_rho_d_min", limits.diffuse_least},
          {"ks_E_max", limits.lobes_most},
          {"holds", limits.holds()}};
}

}  // namespace gonio
