#include "assess/brdf_points.h"

#include <algorithm>
#include <array>
#include <boost/random/sobol.hpp>
#include <cmath>
#include <random>

namespace gonio {
namespace {

/// Uniform in [0, 1), the same on every machine.
class Uniform {
 public:
  explicit Uniform(std::uint64_t seed) : engine_(seed) {}
  double operator()() { return double(engine_() >> 11) * 0x1p-53; }
  double log_between(double lo, double hi) { return lo * std::pow(hi / lo, (*this)()); }

 private:
  std::mt19937_64 engine_;
};

double between(double lo, double hi, double u) {
  if (lo > 0 && hi > 4 * lo) return std::clamp(lo * std::pow(hi / lo, u), lo, hi);
  if (lo == 0) return u < 0.06 ? 0 : std::clamp(hi * std::pow(1e-8, 1.0 - (u - 0.06) / 0.94), lo, hi);
  return lo + (hi - lo) * u;
}

/// Below the edge of the box by rounding is outside it.
double inside(double x, const ParameterInfo& p, Precision precision) {
  double r = rounded(x, precision);
  if (precision == Precision::single) {
    if (r < p.lo) r = std::nextafter(float(r), 3e38f);
    if (r > p.hi) r = std::nextafter(float(r), -3e38f);
  }
  return r;
}

/// Of four sets one is a corner (each parameter at an end of its box or of the fit's), one from the fit's box, the
/// others follow `u` over the documented one.
std::vector<double> parameters(const ModelSpec& spec, std::size_t set, const std::vector<double>& u, Uniform& random,
                               Precision precision, const PointOptions& options) {
  const ModelInfo& info = spec.info();
  std::vector<double> values;
  const bool corner = set % 4 == 1, scaled = set % 4 == 3;
  for (std::size_t p = 0; p < info.parameters.size(); ++p) {
    const ParameterInfo& one = info.parameters[p];
    const bool usual = options.fit_box || set % 4 == 2;
    double hi = usual ? one.fit_hi : one.hi;
    const double lo = usual ? one.fit_lo : one.lo;
    const bool rational_d = spec.variant() == "schlick-d" || spec.variant() == "schlick";
    if (rational_d && one.name == "m") hi = std::min(hi, 0.5);
    double value;
    if (one.name == "kd" || one.name == "ks") {
      const double plain = one.name == "ks" || spec.id == ModelId::lambert ? 1 : 0;
      value = scaled ? std::pow(10, 3 * u[p] - 2) : plain;
    } else if (corner) {
      const std::array<double, 4> ends{lo, hi, std::max(lo, one.fit_lo), std::min(hi, one.fit_hi)};
      value = ends[std::size_t(random() * 4)];
    } else {
      value = between(lo, hi, u[p]);
    }
    values.push_back(inside(value, one, precision));
  }
  return values;
}

/// Index matched to 1e-15 or 1e-7, thinner media with and without total reflection, glasses, weak and strong absorbers,
/// metals.
Interface<double> material(std::size_t set, Uniform& random, Precision precision) {
  double n = 1.5, k = 0;
  switch (set % 8) {
    case 0:
      n = random.log_between(0.05, 5), k = random.log_between(0.5, 12);
      break;
    case 1:
      n = 1 + (random() < 0.5 ? -1 : 1) * random.log_between(1e-15, 0.3);
      break;
    case 2:
      n = random.log_between(0.3, 0.99);
      break;
    case 3:
      n = random.log_between(1.0, 5), k = random.log_between(1e-9, 1e-2);
      break;
    case 4:
      n = random.log_between(0.01, 10), k = random.log_between(1e-6, 100);
      break;
    case 5:
      n = 1, k = random.log_between(1e-12, 100);
      break;
    case 6:
      return perfect_interface<double>();
    default:
      n = random.log_between(1.0, 10);
      break;
  }
  return {rounded(n, precision), rounded(k, precision)};
}

using V = UnitVector<double>;

V direction(double theta, double phi) {
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
          theta < 0.8 ? std::cos(theta) : std::sin(kPi<double> / 2 - theta)};
}

/// Mirror image of v about the unit vector along (x, y, 1).
V reflected(const V& v, double x, double y) {
  const double twice = 2 * (v.x * x + v.y * y + v.z) / (x * x + y * y + 1);
  return {twice * x - v.x, twice * y - v.y, twice - v.z};
}

constexpr double kRightAngle = 1.5707963267948966, kGrazing = kRightAngle / 900000;  // 1e-4 degrees

struct Pair {
  V i, o;
};

class Directions16 {
 public:
  Directions16(const LobeWidth& width, Uniform& random) : width_(width), random_(random) {}

  Pair next(std::size_t kind) {
    const V o = direction(std::acos(1 - random_()), turn());
    switch (kind % 16) {
      case 0:
        return {direction(std::acos(1 - random_()), turn()), o};
      case 1:
      case 2:
      case 3:
        return on_lobe(o, 1e-3, 14);
      case 4:
        return on_lobe(o, 14, 100);
      case 5:
        return on_lobe(o, 100, 700);
      case 6:
        return about({-o.x, -o.y, o.z}, o, random_.log_between(1e-12, 1e-2));
      case 7:
        return about(o, o, random_.log_between(1e-12, 1e-2));
      case 8:
        return {o, o};
      case 9:
        return {{-o.x, -o.y, o.z}, o};
      case 10:
        return on_lobe({0, 0, 1}, 1e-3, 60);
      case 11:
        return {{0, 0, 1}, random_() < 0.3 ? V{0, 0, 1} : o};
      case 12:
        return grazing(kPi<double>);
      case 13:
        return grazing(random_() < 0.5 ? 0 : kRightAngle);
      case 14:
        return on_lobe(low(), 1e-3, 60);
      default:
        return {low(), o};
    }
  }

 private:
  const LobeWidth width_;
  Uniform& random_;

  double turn() { return random_() < 0.2 ? kRightAngle * std::floor(4 * random_()) : 2 * kPi<double> * random_(); }
  V low() {
    const double left = random_() < 0.2 ? kGrazing : random_.log_between(kGrazing, 0.2), phi = turn();
    return {std::cos(left) * std::cos(phi), std::cos(left) * std::sin(phi), std::sin(left)};
  }
  /// The half vector where a Gaussian of the lobe's width has fallen to exp(-E), E from lo to hi.
  Pair on_lobe(const V& o, double lo, double hi) {
    for (int attempt = 0; attempt < 8; ++attempt) {
      const double r = std::sqrt(random_.log_between(lo, hi) / 0.7), phi = turn();
      const V i = reflected(o, width_.x * r * std::cos(phi), width_.y * r * std::sin(phi));
      if (i.z > 1e-6) return {i, o};
    }
    return {{-o.x, -o.y, o.z}, o};
  }
  Pair about(const V& centre, const V& o, double radius) {
    const double phi = turn();
    V i{centre.x + radius * std::cos(phi), centre.y + radius * std::sin(phi), centre.z + radius * (random_() - 0.5)};
    i.z = std::max(i.z, 2e-6);
    return {normalised(i.x, i.y, i.z), o};
  }
  Pair grazing(double side) {
    const double phi = turn(), a = random_() < 0.3 ? kGrazing : random_.log_between(kGrazing, 0.2),
                 b = random_() < 0.3 ? a : random_.log_between(kGrazing, 0.2);
    const double beside = random_() < 0.3 ? 0 : random_.log_between(1e-9, 1), other = phi + side + beside;
    return {{std::cos(a) * std::cos(phi), std::cos(a) * std::sin(phi), std::sin(a)},
            {std::cos(b) * std::cos(other), std::cos(b) * std::sin(other), std::sin(b)}};
  }
};

V rounded(const V& v, Precision precision) {
  const V u = normalised(v.x, v.y, v.z);
  return {rounded(u.x, precision), rounded(u.y, precision), rounded(u.z, precision)};
}

}  // namespace

double rounded(double x, Precision precision) {
  if (precision == Precision::twofold) return x;
  volatile float single = float(x);  // GCC 12 drops the pair of conversions where it vectorises them
  return double(single);
}

std::string case_name(const ModelSpec& spec) {
  std::string name(spec.info().name);
  if (!spec.info().shadowings.empty()) name += " " + std::string(name_of(spec.shadowing));
  if (spec.info().variants.size() > 1) name += " " + std::string(spec.variant());
  return spec.retro ? name + " retro" : name;
}

std::vector<ModelSpec> brdf_cases() {
  std::vector<ModelSpec> cases;
  for (const ModelInfo& info : models()) {
    std::vector<ModelSpec> shadowed;
    for (const auto name : info.shadowings) set_shadowing(shadowed.emplace_back(ModelSpec{info.id}), name);
    if (shadowed.empty()) shadowed.push_back({info.id});
    for (ModelSpec spec : shadowed)
      for (spec.form = 0; spec.form < info.variants.size(); ++spec.form) {
        const bool own_g = spec.variant() == "schlick-g" || spec.variant() == "schlick" || spec.variant() == "walter-g";
        if (!own_g || spec.shadowing == shadowed.front().shadowing) cases.push_back(spec);
      }
    if (info.id == ModelId::lambert || info.id == ModelId::mirror) continue;
    cases.push_back(shadowed.front());
    cases.back().retro = true;
  }
  return cases;
}

LobeWidth lobe_width(const ModelSpec& spec, const std::vector<double>& values, const Interface<double>& surface,
                     double wavelength_um) {
  ModelSpec upright = spec;
  upright.retro = false;
  Brdf<double> brdf = make_brdf<double>(upright, values);
  brdf.kd = 0;
  // i = o = h: whatever a lobe is written about, half vector or mirror direction, it falls from there.
  const auto f = [&](double x, double y) {
    const V v = normalised(x, y, 1.0);
    return evaluate(brdf, reduce(v.x, v.y, v.z, v.x, v.y, v.z), surface, wavelength_um);
  };
  const double top = f(0, 0);
  if (!(top > 0)) return {1, 1};
  const auto half = [&](bool along_x) {
    double lo = -9, hi = 1;
    for (int step = 0; step < 40; ++step) {
      const double middle = 0.5 * (lo + hi), tangent = std::pow(10, middle);
      (f(along_x ? tangent : 0, along_x ? 0 : tangent) > 0.5 * top ? lo : hi) = middle;
    }
    return std::min(1.0, std::pow(10, lo));
  };
  return {half(true), half(false)};
}

std::vector<BrdfPoint> brdf_points(const ModelSpec& spec, Precision precision, const PointOptions& options) {
  const std::size_t count = spec.info().parameters.size();
  boost::random::sobol_engine<std::uint64_t, 53> sobol(count + 1);
  Uniform random(options.seed * 1000003 + std::uint64_t(spec.id) * 101 + spec.form);
  std::vector<double> shift(count + 1);
  for (double& s : shift) s = random();
  std::vector<BrdfPoint> points;
  for (std::size_t set = 0; set < options.sets; ++set) {
    std::vector<double> u(count + 1);
    for (std::size_t d = 0; d <= count; ++d) {
      u[d] = double(sobol()) * 0x1p-53 + shift[d];
      u[d] -= std::floor(u[d]);
    }
    BrdfPoint point;
    point.set = set;
    point.values = parameters(spec, set, u, random, precision, options);
    const Interface<double> metal{rounded(0.96, precision), rounded(6.7, precision)};
    point.surface = options.faceted_materials ? material(set / 2 + set / 16, random, precision) : metal;
    point.wavelength_um = rounded(0.3 * std::pow(8.0, u[count]), precision);
    const LobeWidth width = lobe_width(spec, point.values, perfect_interface<double>(), point.wavelength_um);
    Directions16 directions(width, random);
    for (std::size_t d = 0; d < options.directions; ++d) {
      Pair pair = d == 0 ? Pair{{0, 0, 1}, {0, 0, 1}} : directions.next(d);
      if (spec.retro) pair.i.x = -pair.i.x, pair.i.y = -pair.i.y;
      point.i = rounded(pair.i, precision);
      point.o = rounded(pair.o, precision);
      points.push_back(point);
    }
  }
  return points;
}

}  // namespace gonio
