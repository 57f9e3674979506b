// Mueller matrices of the models against a second computation with vectors: each facet's plane from cross products, Fresnel's
// amplitudes of the textbooks, 50 digits where the directions nearly coincide.
#include "brdf/polarised.h"

#include <Eigen/Dense>
#include <complex>
#include <random>

#include "base/dual.h"
#include "base/jet.h"
#include "brdf/lanes.h"
#include "catch.h"
#include "reference/digits50.h"
#include "reference/reference.h"

using namespace gonio;

namespace {

using V = Eigen::Vector3d;
using C = std::complex<double>;
using M4 = Eigen::Matrix4d;
using M2 = Eigen::Matrix2cd;

V direction(double theta_deg, double phi_deg) {
  const double p = phi_deg * kPi<double> / 180;
  return {sin_deg(theta_deg) * std::cos(p), sin_deg(theta_deg) * std::sin(p), cos_deg(theta_deg)};
}

/// s and p of a direction of propagation in the plane with `normal`.
struct Frame {
  V s, p;
};
Frame frame(const V& k, const V& normal) {
  const V s = k.cross(normal).normalized();
  return {s, k.cross(s)};
}

/// J = Σ r_j (out·j_out)(j_in·in) with the facet's frames: amplitudes r_s, r_p of a facet of normal h.
M2 facet_jones_by_vectors(const V& i, const V& o, const V& h, C r_s, C r_p) {
  const Frame in = frame(-i, V::UnitZ()), out = frame(o, V::UnitZ()), facet_in = frame(-i, h), facet_out = frame(o, h);
  const auto element = [&](const V& b, const V& a) {
    return r_s * b.dot(facet_out.s) * facet_in.s.dot(a) + r_p * b.dot(facet_out.p) * facet_in.p.dot(a);
  };
  M2 j;
  j << element(out.s, in.s), element(out.s, in.p), element(out.p, in.s), element(out.p, in.p);
  return j;
}

std::pair<C, C> amplitudes(double c, double n, double k) {
  const C index(n, k);
  C w = std::sqrt(index * index - (1 - c * c));
  if (w.imag() < 0) w = -w;
  return {(c - w) / (c + w), (index * index * c - w) / (index * index * c + w)};
}

/// M = A (J ⊗ J*) A⁻¹ (Chipman), rows I, Q, U, V of the vector (E_s E_s*, E_s E_p*, E_p E_s*, E_p E_p*).
M4 mueller_by_kronecker(const M2& j) {
  Eigen::Matrix4cd a, k;
  const C i(0, 1);
  a << 1, 0, 0, 1, 1, 0, 0, -1, 0, 1, 1, 0, 0, -i, i, 0;
  for (int r = 0; r < 2; ++r)
    for (int c = 0; c < 2; ++c) k.block<2, 2>(2 * r, 2 * c) = j(r, c) * j.conjugate();
  return (a * k * a.inverse()).real();
}

M4 matrix(const Mueller<double>& m) {
  M4 out;
  for (int r = 0; r < 4; ++r)
    for (int c = 0; c < 4; ++c) out(r, c) = m.m[r][c];
  return out;
}

/// The smallest eigenvalue of Cloude's coherency matrix over its trace: >= 0 for what light can undergo.
double least_eigenvalue(const M4& m) {
  const C i(0, 1);
  std::array<M2, 4> sigma;
  sigma[0] << 1, 0, 0, 1;
  sigma[1] << 1, 0, 0, -1;
  sigma[2] << 0, 1, 1, 0;
  sigma[3] << 0, -i, i, 0;
  Eigen::Matrix4cd h = Eigen::Matrix4cd::Zero();
  for (int r = 0; r < 4; ++r)
    for (int c = 0; c < 4; ++c) {
      Eigen::Matrix4cd k;
      const M2 conjugate = sigma[c].conjugate();
      for (int a = 0; a < 2; ++a)
        for (int b = 0; b < 2; ++b) k.block<2, 2>(2 * a, 2 * b) = sigma[r](a, b) * conjugate;
      h += m(r, c) * k;
    }
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix4cd>(h).eigenvalues().minCoeff() / h.trace().real();
}

/// Every model and variant that states polarisation, at middling parameters.
struct Named {
  ModelSpec spec;
  std::vector<double> values;
};
std::vector<Named> stated(double kd = 0.2) {
  std::vector<Named> all;
  for (const ModelInfo& info : models())
    for (std::size_t form = 0; form < info.variants.size(); ++form) {
      ModelSpec spec;
      spec.id = info.id, spec.form = form;
      if (!info.shadowings.empty()) set_shadowing(spec, info.shadowings[0]);
      std::vector<double> values;
      for (const ParameterInfo& p : info.parameters)
        values.push_back(p.linear ? (p.name == "kd" ? kd : 0.7) : std::pow(p.fit_lo * p.fit_hi * p.fit_hi, 1.0 / 3));
      if (states_polarisation(make_brdf<double>(spec, values))) all.push_back({spec, values});
    }
  return all;
}

const Interface<double> kSurfaces[] = {{1.5, 0}, {0.97, 6.7}, {0.2, 3.3}, {1 / 1.5, 0}, {1.001, 0}, {4, 0.05}};
constexpr double kUm = 0.55;

double worst_element(const M4& a, const M4& b) { return (a - b).cwiseAbs().maxCoeff(); }

}  // namespace

TEST_CASE("A facet's Mueller matrix equals the one from its plane by cross products", "[polarised]") {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> uniform(0, 1);
  double worst = 0, worst_components = 0;
  for (const Interface<double>& surface : kSurfaces)
    for (int draw = 0; draw < 300; ++draw) {
      const double ti = 1 + 88 * uniform(random), to = 1 + 88 * uniform(random), phi = 3 + 354 * uniform(random),
                   phi_i = 360 * uniform(random);
      const V i = direction(ti, phi_i), o = direction(to, phi_i + phi), h = (i + o).normalized();
      const auto [r_s, r_p] = amplitudes(i.dot(h), surface.n, surface.k);
      const M4 truth = mueller_by_kronecker(facet_jones_by_vectors(i, o, h, r_s, r_p));
      const auto w = directions_from_deg(ti, to, phi, phi_i);
      const M4 ours = matrix(facet_polarisation(w, azimuth_from_deg(phi), surface));
      CHECK(truth(0, 0) == Approx(surface.reflectance(w.cos_d)).epsilon(1e-10));
      worst = std::max(worst, worst_element(ours, truth / truth(0, 0)));
      worst_components =
          std::max(worst_components, worst_element(ours, matrix(facet_polarisation(w, azimuth_of(w), surface))));
    }
  INFO("largest difference " << worst << "; azimuth from components " << worst_components);
  CHECK(worst < 1e-10);  // of the vectors' cross products
  CHECK(worst_components < 1e-12);
}

TEST_CASE("Every model that states polarisation: m11 is evaluate(), matrices are realisable and reciprocal",
          "[polarised]") {
  const M4 q = Eigen::Vector4d(1, 1, -1, 1)
                   .asDiagonal();  // a field run backwards, in frames of its own: J → Z·Jᵀ·Z, Z = diag(1, -1)
  REQUIRE(stated().size() > 25);
  for (const Named& one : stated()) {
    const Brdf<double> brdf = make_brdf<double>(one.spec, one.values);
    for (const Interface<double>& surface : kSurfaces)
      for (const double ti : {0.0, 1e-5, 35.0, 56.31, 89.9})
        for (const double to : {0.0, 35.0, 70.0, 89.9})
          for (const double phi : {0.0, 1e-6, 77.0, 180.0, 301.0}) {
            INFO(one.spec.info().name << " " << one.spec.variant() << " n " << surface.n << " k " << surface.k << " at "
                                      << ti << " " << to << " " << phi);
            const auto w = directions_from_deg(ti, to, phi);
            const double f = evaluate(brdf, w, surface, kUm);
            const Mueller<double> raw = evaluate_mueller(brdf, w, azimuth_from_deg(phi), surface, kUm);
            REQUIRE(raw.m[0][0] == f);
            if (f < 1e-250) continue;
            const M4 m = matrix(raw) / f;
            REQUIRE(m.allFinite());
            REQUIRE(m.cwiseAbs().maxCoeff() <= 1 + 1e-14);
            REQUIRE(least_eigenvalue(m) > -1e-14);
            if (!one.spec.reciprocal()) continue;
            const M4 back = matrix(evaluate_mueller(brdf, directions_from_deg(to, ti, -phi), azimuth_from_deg(-phi),
                                                    surface, kUm)) /
                            f;
            REQUIRE(worst_element(back, q * m.transpose() * q) < 1e-11);
          }
  }
}

TEST_CASE("Planes that are not defined: normal, retro-reflection, mirror", "[polarised]") {
  const auto at = [](double ti, double to, double phi, const Interface<double>& surface) {
    return matrix(facet_polarisation(directions_from_deg(ti, to, phi), azimuth_from_deg(phi), surface));
  };
  const M4 turned_over = Eigen::Vector4d(1, 1, -1, -1).asDiagonal();
  for (const Interface<double>& surface : kSurfaces) {
    CHECK(worst_element(at(0, 0, 180, surface), turned_over) < 1e-15);
    for (const double theta : {0.0, 1e-8, 10.0, 56.31, 89.9999}) {
      INFO(surface.n << " + " << surface.k << "i at " << theta);
      CHECK(worst_element(at(theta, theta, 0, surface), turned_over) < 1e-14);  // i = o exactly
      const Mueller<double> mirror = reflection_mueller(cos_deg(theta), surface);
      CHECK(worst_element(at(theta, theta, 180, surface), matrix(mirror) / mirror.m[0][0]) <
            1e-13);  // h = normal exactly
    }
    // Continuous through them.
    for (const double phi : {0.0, 90.0, 200.0})
      CHECK(worst_element(at(0, 40, phi, surface), at(1e-7, 40, phi, surface)) < 1e-6);
    for (const double step : {1e-4, 1e-7, 1e-10})
      for (const auto& [dt, dp] : {std::pair{1.0, 0.0}, {0.0, 1.0}, {0.6, -0.8}})
        CHECK(worst_element(at(40, 40, 0, surface), at(40 + dt * step, 40, dp * step, surface)) < 0.1 * step);
  }
  CHECK(worst_element(at(50, 20, 40, perfect_interface<double>()), at(50, 20, 40, {1, 1e6})) < 1e-5);
  // Components alone: the azimuth of a direction along the normal is put on the mirror side.
  const auto normal = reduce(0.0, 0.0, 1.0, 0.6, 0.0, 0.8);
  CHECK(azimuth_of(normal).cos_phi() == -1);
  CHECK(matrix(facet_polarisation(normal, azimuth_of(normal), kSurfaces[0])).allFinite());
}

TEST_CASE("Brewster's angle on a rough dielectric: the mirror direction is fully s, m12 = +1", "[polarised]") {
  const double brewster = std::atan(1.5) * 180 / kPi<double>;
  const auto m =
      facet_polarisation(directions_from_deg(brewster, brewster, 180.0), azimuth_from_deg(180.0), kSurfaces[0]);
  CHECK(m.m[0][1] == Approx(1).epsilon(1e-14));
  CHECK(m.m[1][0] == Approx(1).epsilon(1e-14));
  const Brdf<double> brdf{TorranceSparrow<double>{0.3}, 0, 1};
  const auto linear = [&](double cosine, double sine) {
    return evaluate_linear(brdf, directions_from_deg(brewster, brewster, 180.0), azimuth_from_deg(180.0), kSurfaces[0],
                           kUm, {cosine, sine});
  };
  CHECK(linear(0, 1) < 1e-28 * linear(1, 0));
}

TEST_CASE("Linear light at any azimuth; its mean is the unpolarised value", "[polarised]") {
  for (const Named& one : stated()) {
    const Brdf<double> brdf = make_brdf<double>(one.spec, one.values);
    const double phi = 140;
    const auto w = directions_from_deg(50.0, 35.0, phi);
    const Mueller<double> m = evaluate_mueller(brdf, w, azimuth_from_deg(phi), kSurfaces[1], kUm);
    double mean = 0;
    for (int step = 0; step < 9; ++step) {
      const LinearLight<double> light{std::cos(kPi<double> * step / 9), std::sin(kPi<double> * step / 9)};
      const double f = evaluate_linear(brdf, w, azimuth_from_deg(phi), kSurfaces[1], kUm, light);
      CHECK(f == Approx((m * light.stokes())[0]).epsilon(1e-13));
      mean += f / 9;
    }
    INFO(one.spec.info().name);
    CHECK(mean == Approx(evaluate(brdf, w, kSurfaces[1], kUm)).epsilon(1e-13));
  }
}

TEST_CASE("Stogryn 1967: the thesis's two expressions out of the plane, R_s and R_p in it", "[polarised]") {
  const double alpha = 0.4;
  const Brdf<double> exact{Stogryn<double>{alpha}, 0, 1};
  for (const Interface<double>& surface : kSurfaces)
    for (const double ti : {5.0, 40.0, 80.0})
      for (const double to : {10.0, 55.0, 85.0})
        for (const double phi : {0.0, 30.0, 120.0, 180.0}) {
          INFO(ti << " " << to << " " << phi);
          const auto w = directions_from_deg(ti, to, phi);
          const auto azimuth = azimuth_from_deg(phi);
          // As printed, with vectors: q_ip = cos_i·x + sin_i·z, q_is = -y, the light arriving along (sin_i, 0, -cos_i).
          const double s = sin_deg(ti), c = cos_deg(ti);
          const V q_i(s, 0, -c), q_ip(c, 0, s), q_is(0, -1, 0), q_r = direction(to, 180 + phi);
          const Frame q_rf = frame(q_r, V::UnitZ());
          const Polarised<double> r = fresnel(w.cos_d, surface.n, surface.k);
          const double divisor = square(q_rf.p.dot(q_i)) + square(q_rf.s.dot(q_i)), p2 = square(q_ip.dot(q_r)),
                       s2 = square(q_is.dot(q_r));
          const double rough = BeckmannKirchhoff<double>{1e4 * alpha, 2e4, KirchhoffForm::rough_limit}.shape(w, kUm);
          const auto given = [&](double ca, double sa) {
            return evaluate_linear(exact, w, azimuth, surface, kUm, {ca, sa});
          };
          CHECK(given(1, 0) == Approx(rough * (r.s * p2 + r.p * s2) / divisor).epsilon(1e-9).margin(1e-12 * rough));
          CHECK(given(0, 1) == Approx(rough * (r.p * p2 + r.s * s2) / divisor).epsilon(1e-9).margin(1e-12 * rough));
          const Polarised<double> out = stogryn_out_of_plane(w, azimuth.sin_phi, azimuth.cos_phi(), surface);
          CHECK(given(1, 0) == Approx(rough * out.s).epsilon(1e-9).margin(1e-12 * rough));
          CHECK(given(0, 1) == Approx(rough * out.p).epsilon(1e-9).margin(1e-12 * rough));
          const auto in_plane = [&](StogrynForm form) {
            return evaluate(Brdf<double>{Stogryn<double>{alpha, form}, 0, 1}, w, surface, kUm);
          };
          CHECK(in_plane(StogrynForm::in_plane_s) == Approx(rough * r.s).epsilon(1e-12));
          CHECK(in_plane(StogrynForm::in_plane_p) == Approx(rough * r.p).epsilon(1e-12));
          if (phi == 0 || phi == 180) CHECK(given(1, 0) == Approx(in_plane(StogrynForm::in_plane_s)).epsilon(1e-9));
        }
  // Retro-reflection is R at normal incidence for both.
  const Polarised<double> retro = stogryn_out_of_plane(directions_from_deg(50.0, 50.0, 0.0), 0.0, 1.0, kSurfaces[1]);
  CHECK(retro.s == Approx(kSurfaces[1].r0()).epsilon(1e-13));
  CHECK(retro.p == Approx(kSurfaces[1].r0()).epsilon(1e-13));
}

TEST_CASE("He 1991 polarised: the separated form with its s and p vectors", "[polarised]") {
  const Brdf<double> he{HeTorrance<double>{0.28, 2}, 0, 1};
  for (const Interface<double>& surface : kSurfaces)
    for (const double ti : {10.0, 60.0})
      for (const double to : {12.0, 75.0})
        for (const double phi : {25.0, 100.0, 179.0}) {
          const V k_i = -direction(ti, 0), k_r = direction(to, phi);
          const Frame i = frame(k_i, V::UnitZ()), r = frame(k_r, V::UnitZ());
          const auto w = directions_from_deg(ti, to, phi);
          const auto [r_s, r_p] = amplitudes(w.cos_d, surface.n, surface.k);
          const double s_ir = i.s.dot(k_r), p_ir = i.p.dot(k_r), s_ri = r.s.dot(k_i), p_ri = r.p.dot(k_i);
          M2 f;  // rows received s, p; columns incident s, p
          f << -(r_s * p_ir * p_ri + r_p * s_ir * s_ri), r_s * s_ir * p_ri - r_p * p_ir * s_ri,
              r_s * p_ir * s_ri - r_p * s_ir * p_ri, -(r_s * s_ir * s_ri + r_p * p_ir * p_ri);
          f /= k_r.cross(k_i).squaredNorm();
          const double shape = std::get<HeTorrance<double>>(he.lobe).shape(w, kUm);
          const M4 truth = shape * mueller_by_kronecker(f);
          const M4 ours = matrix(evaluate_mueller(he, w, azimuth_from_deg(phi), surface, kUm));
          INFO(ti << " " << to << " " << phi << "\n" << ours / ours(0, 0) << "\n\n" << truth / truth(0, 0));
          CHECK(worst_element(ours, truth) < 1e-10 * truth(0, 0));
        }
}

TEST_CASE("Refracted light keeps the facet's plane: vectors, and straight on", "[polarised]") {
  std::mt19937_64 random(12);
  std::uniform_real_distribution<double> uniform(0, 1);
  int compared = 0;
  for (int draw = 0; draw < 2000; ++draw) {
    const double n = draw % 2 ? 1.5 : 1 / 1.33, phi = 360 * uniform(random);
    const double ti = 89 * uniform(random), to = 91 + 88 * uniform(random);
    const V i = direction(ti, 0), above = direction(180 - to, phi), o(above.x(), above.y(), -above.z());
    V h = i + n * o;
    if (n > 1) h = -h;
    h.normalize();
    const double c = i.dot(h);
    if (c <= 0.01 || o.dot(h) >= -0.01 || h.z() <= 0) continue;  // no facet refracts i into o
    const auto t = transmission_amplitudes(c, n);
    const M4 truth = mueller_by_kronecker(facet_jones_by_vectors(i, o, h, t.s.re, t.p.re));
    const UnitVector<double> a{i.x(), i.y(), i.z()}, b{o.x(), o.y(), o.z()};
    const M4 ours = matrix(normalised_mueller(refraction_jones(a, b, azimuth_from_deg(phi))));
    REQUIRE(worst_element(ours, truth / truth(0, 0)) < 1e-9);
    ++compared;
  }
  CHECK(compared > 200);
  const UnitVector<double> down{0.6, 0, 0.8}, on{-0.6, 0, -0.8};
  CHECK(worst_element(matrix(normalised_mueller(refraction_jones(down, on, azimuth_from_deg(180.0)))), M4::Identity()) <
        1e-15);
}

TEST_CASE("Polarised values in float lanes, double and 50 digits; derivatives", "[polarised]") {
  std::mt19937_64 random(13);
  std::uniform_real_distribution<double> uniform(0, 1);
  double worst_double = 0, worst_float = 0, worst_linear = 0;
  for (const Interface<double>& surface : kSurfaces)
    for (int draw = 0; draw < 150; ++draw) {
      const double near = std::pow(10.0, -8 * uniform(random));
      const double ti = draw % 5 == 0 ? 90 - near : 89.9 * uniform(random);
      const double to = draw % 2 ? 89.9 * uniform(random) : std::min(89.9999, ti + near);
      const double phi = draw % 3 == 0 ? 360 * uniform(random) : (draw % 3 == 1 ? 180 : 0) + near;
      const auto w = directions_from_deg(ti, to, phi);
      const auto azimuth = azimuth_from_deg(phi);
      const Digits50 theta_i(ti), theta_o(to), phi50(phi);
      const Interface<Digits50> wide{Digits50(surface.n), Digits50(surface.k)};
      const auto exact =
          facet_polarisation(directions_from_deg(theta_i, theta_o, phi50), azimuth_from_deg(phi50), wide);
      const auto ours = facet_polarisation(w, azimuth, surface);
      // Float at exactly the numbers it received.
      const auto f = [](double x) { return double(float(x)); };
      const Directions<double> wf{f(w.cos_i), f(w.cos_o), f(w.cos_d), f(w.tan2_h), f(w.tan2_i), f(w.tan2_o),
                                  f(w.ix),    f(w.iy),    f(w.ox),    f(w.oy),     f(w.hx),     f(w.hy)};
      const Azimuth<double> af{f(azimuth.sin_phi), f(azimuth.one_plus_cos)};
      const Interface<double> sf{f(surface.n), f(surface.k)};
      const auto rounded = facet_polarisation(wf, af, sf);
      const auto fast =
          facet_polarisation(spread<FloatLanes>(w), spread<FloatLanes>(azimuth), spread<FloatLanes>(surface));
      for (int r = 0; r < 4; ++r)
        for (int c = 0; c < 4; ++c) {
          worst_double = std::max(worst_double, std::abs(ours.m[r][c] - exact.m[r][c].convert_to<double>()));
          worst_float = std::max(worst_float, std::abs(fast.m[r][c].get(0) - rounded.m[r][c]));
        }
      const std::vector<double> values{0.2, 0.1, 0.9};
      const ModelSpec spec{ModelId::torrance_sparrow};
      const LinearLight<double> light{0.6, 0.8};
      const auto reference = reference_polarised(spec, values, ti, to, phi, surface, kUm, 0, light);
      const double linear = evaluate_linear(make_brdf<double>(spec, values), w, azimuth, surface, kUm, light);
      worst_linear = std::max(worst_linear, std::abs(linear - reference.linear) / reference.linear);
    }
  INFO("normalised elements: double " << worst_double << ", float " << worst_float << "; linear light, relative "
                                      << worst_linear);
  CHECK(worst_double < 1e-12);
  CHECK(worst_float < 5e-6);
  CHECK(worst_linear < 1e-12);

  using J = Jet<2>;
  const auto w = directions_from_deg(50.0, 42.0, 150.0);
  const auto azimuth = azimuth_from_deg(150.0);
  const auto jets = facet_polarisation(w, azimuth, Interface<J>{J(0.9, 0), J(2.3, 1)});
  using D = Dual<double, 2>;
  const auto duals = facet_polarisation(w, azimuth, Interface<D>{D(0.9, 0), D(2.3, 1)});
  const double step = 1e-6;
  for (int v = 0; v < 2; ++v) {
    const auto shifted = [&](double by) {
      return facet_polarisation(w, azimuth, Interface<double>{0.9 + (v == 0) * by, 2.3 + (v == 1) * by});
    };
    const auto above = shifted(step), below = shifted(-step);
    for (int r = 0; r < 4; ++r)
      for (int c = 0; c < 4; ++c) {
        const double difference = (above.m[r][c] - below.m[r][c]) / (2 * step);
        CHECK(jets.m[r][c].v[v] == Approx(difference).epsilon(1e-6).margin(1e-8));
        CHECK(duals.m[r][c].v[v] == Approx(difference).epsilon(1e-6).margin(1e-8));
      }
  }
}

TEST_CASE("What depolarises, what polarises, and what does not say", "[polarised]") {
  const Brdf<double> lambert{Lambert{}, 0.5, 0};
  const auto w = directions_from_deg(50.0, 20.0, 30.0);
  const M4 diffuse = matrix(evaluate_mueller(lambert, w, azimuth_from_deg(30.0), kSurfaces[0], kUm));
  CHECK(diffuse(0, 0) == Approx(0.5 / kPi<double>));
  CHECK(diffuse.cwiseAbs().sum() == diffuse(0, 0));
  const std::vector<double> alphas{0.2, 0.2, 0.1, 0.9}, one{0.3, 0.1, 0.9};
  CHECK_FALSE(states_polarisation(make_brdf<double>({ModelId::ward_1992}, alphas)));
  CHECK(states_polarisation(make_brdf<double>({ModelId::ggx}, alphas)));
  CHECK(states_polarisation(make_brdf<double>({ModelId::oren_nayar}, one)));
  ModelSpec turned{ModelId::torrance_sparrow};
  turned.retro = true;
  CHECK_FALSE(states_polarisation(make_brdf<double>(turned, one)));
  ModelSpec in_plane{ModelId::stogryn_1967};
  set_variant(in_plane, "in-plane-p");
  CHECK_FALSE(states_polarisation(make_brdf<double>(in_plane, one)));
  // A mirror's delta: energies of the interface.
  const Brdf<double> mirror{Mirror{}, 0, 0.5};
  CHECK(worst_element(matrix(coherent_mueller(mirror, 0.4, kSurfaces[0], kUm)),
                      0.5 * matrix(reflection_mueller(0.4, kSurfaces[0]))) < 1e-16);
}
