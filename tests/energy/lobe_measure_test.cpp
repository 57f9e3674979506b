// A lobe's spread over cos_d against the adaptive quadrature of E, which knows the material.
#include "base/error.h"
#include "catch.h"
#include "energy/cos_nodes.h"
#include "energy/directional_reflectance.h"
#include "materials/surfaces.h"

using namespace gonio;

namespace {

ModelSpec spec_of(const char* name, const char* shadowing) {
  ModelSpec spec;
  spec.id = model(name).id;
  if (*shadowing) set_shadowing(spec, shadowing);
  return spec;
}

Lobe<double> lobe_of(const ModelSpec& spec, double m) {
  std::vector<double> values;
  for (const ParameterInfo& p : spec.info().parameters) values.push_back(p.fallback.value_or(m));
  return make_lobe<double>(spec, values);
}

/// Dielectrics to metals, water to the steepest of the database.
const std::vector<Interface<double>> kSurfaces{{1.33, 0, false},   {1.5, 0, false},   {2.4, 0, false},
                                               {0.05, 3.5, false}, {3.5, 3.3, false}, {1.4, 7.5, false},
                                               {0.3, 0.6, false}};

}  // namespace

TEST_CASE("twenty fixed cosines give E of any material", "[energy][tables]") {
  double worst_points = 0, worst_nodes = 0;
  for (const auto& [name, shadowing] : {std::pair("torrance-sparrow", "smith-correlated"),
                                        {"torrance-sparrow", "v-cavity"},
                                        {"ggx", "smith-correlated"}})
    for (const double m : {0.01, 0.05, 0.2, 0.5, 1.0, 1.4})
      for (const double theta : {0.0, 20.0, 45.0, 60.0, 75.0, 85.0, 89.0, 89.9}) {
        const Lobe<double> lobe = lobe_of(spec_of(name, shadowing), m);
        const SpectralSurface all{kSurfaces, std::vector<double>(kSurfaces.size(), 0.55)};
        const std::vector<Estimate> truth = directional_reflectance(lobe, theta, all, 1e-7);
        const LobeMeasure measure = lobe_measure(lobe, theta);
        const NodeValues weights = node_weights(measure);
        for (std::size_t s = 0; s < kSurfaces.size(); ++s) {
          double sum = 0;
          for (std::size_t i = 0; i < measure.cos_d.size(); ++i)
            sum += measure.weight[i] * kSurfaces[s].reflectance(measure.cos_d[i]);
          worst_points = std::max(worst_points, std::abs(sum - truth[s].value));
          const double of_nodes = sum_of_products(weights, reflectance_at_nodes(lobe, kSurfaces[s])) - truth[s].value;
          worst_nodes = std::max(worst_nodes, std::abs(of_nodes));
          if (std::abs(of_nodes) > 4e-6 || std::abs(sum - truth[s].value) > 1e-6)
            UNSCOPED_INFO(name << " " << shadowing << " m " << m << " theta " << theta << " n " << kSurfaces[s].n
                               << ": points " << sum - truth[s].value << " nodes " << of_nodes);
        }
      }
  INFO("worst: points " << worst_points << ", nodes " << worst_nodes);
  CHECK(worst_points < 1e-6);
  CHECK(worst_nodes < 4e-6);
}

TEST_CASE("the weights add up to E of white facets; lobes without facets have none", "[energy][tables]") {
  const Lobe<double> lobe = lobe_of(spec_of("torrance-sparrow", "smith-correlated"), 0.3);
  const NodeValues weights = node_weights(lobe_measure(lobe, 50));
  const Estimate white = directional_reflectance(lobe, 50, {{perfect_interface<double>()}, {0.55}})[0];
  double sum = 0;
  for (const double weight : weights) sum += weight;
  CHECK(sum == Approx(white.value).epsilon(1e-7));
  CHECK_THROWS_AS(lobe_measure(lobe_of(spec_of("phong-1975", ""), 20), 30), InputError);
  CHECK_THROWS_AS(lobe_measure(lobe_of(spec_of("beckmann-kirchhoff", ""), 1), 30), InputError);
}

TEST_CASE("the nodes hold R of nearly every solid and liquid; where they do not they say so", "[energy][tables]") {
  const Lobe<double> lobe = lobe_of(spec_of("torrance-sparrow", "smith-correlated"), 0.3);
  const std::vector<NamedSurface> all = database_surfaces();
  std::size_t beyond = 0;
  for (const NamedSurface& one : all) {
    const NodeValues r = reflectance_at_nodes(lobe, one.interface);
    if (node_error(lobe, one.interface, r) > kMostNodeError) ++beyond;
  }
  INFO(beyond << " of " << all.size());
  CHECK(all.size() > 15000);
  CHECK(beyond <= 12);  // alkali metals next to their plasma edges
  // The kink of total reflection, and of a reflectance of nothing, are seen.
  for (const Interface<double>& kink : {Interface<double>{0.7, 0, false}, {1.00001, 0, false}, {900, 0, false}})
    CHECK(node_error(lobe, kink, reflectance_at_nodes(lobe, kink)) > 1e-3);
}
