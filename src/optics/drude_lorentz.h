#pragma once
// The Lorentz-Drude model of a metal: a closed form of n + ik over all frequencies.
//   ε(E) = 1 - f0·Ep²/(E·(E + iΓ0)) + Σ_j f_j·Ep²/(E_j² - E² - iE·Γ_j),   E, Γ in eV.
// Parameters: A. D. Rakić, A. B. Djurišić, J. M. Elazar, M. L. Majewski. Optical properties of metallic films for
// vertical-cavity optoelectronic devices. Appl. Opt. 37, 5271-5283 (1998), doi 10.1364/AO.37.005271, tables 1 and 2.
// Fitted there from about 0.1 to 5-6 eV; beyond that the formula is still causal, which is what a Kramers-Kronig test
// needs, but no longer the metal.
#include <array>
#include <span>
#include <string_view>

#include "optics/absorption.h"

namespace gonio {

/// hc/e in eV·nm (exact in SI 2019): photon energy in eV = this / wavelength in nm.
inline constexpr double kElectronvoltNanometre = 1239.8419843320026;

struct Oscillator {
  double strength, width_ev, energy_ev;  ///< f, Γ, position (0 for the free electrons)
};

struct DrudeLorentz {
  std::string_view metal;
  double plasma_ev;
  std::array<Oscillator, 6> oscillators;  ///< the first is Drude's; unused ones have strength 0
};

inline constexpr std::array<DrudeLorentz, 11> kRakicMetals{{
    {"Ag",
     9.01,
     {{{0.845, 0.048, 0},
       {0.065, 3.886, 0.816},
       {0.124, 0.452, 4.481},
       {0.011, 0.065, 8.185},
       {0.840, 0.916, 9.083},
       {5.646, 2.419, 20.29}}}},
    {"Au",
     9.03,
     {{{0.760, 0.053, 0},
       {0.024, 0.241, 0.415},
       {0.010, 0.345, 0.830},
       {0.071, 0.870, 2.969},
       {0.601, 2.494, 4.304},
       {4.384, 2.214, 13.32}}}},
    {"Cu",
     10.83,
     {{{0.575, 0.030, 0}, {0.061, 0.378, 0.291}, {0.104, 1.056, 2.957}, {0.723, 3.213, 5.300}, {0.638, 4.305, 11.18}}}},
    {"Al",
     14.98,
     {{{0.523, 0.047, 0}, {0.227, 0.333, 0.162}, {0.050, 0.312, 1.544}, {0.166, 1.351, 1.808}, {0.030, 3.382, 3.473}}}},
    {"Be",
     18.51,
     {{{0.084, 0.035, 0}, {0.031, 1.664, 0.100}, {0.140, 3.395, 1.032}, {0.530, 4.454, 3.183}, {0.130, 1.802, 4.604}}}},
    {"Cr",
     10.75,
     {{{0.168, 0.047, 0}, {0.151, 3.175, 0.121}, {0.150, 1.305, 0.543}, {1.149, 2.676, 1.970}, {0.825, 1.335, 8.775}}}},
    {"Ni",
     15.92,
     {{{0.096, 0.048, 0}, {0.100, 4.511, 0.174}, {0.135, 1.334, 0.582}, {0.106, 2.178, 1.597}, {0.729, 6.292, 6.089}}}},
    {"Pd",
     9.72,
     {{{0.330, 0.008, 0}, {0.649, 2.950, 0.336}, {0.121, 0.555, 0.501}, {0.638, 4.621, 1.659}, {0.453, 3.236, 5.715}}}},
    {"Pt",
     9.59,
     {{{0.333, 0.080, 0}, {0.191, 0.517, 0.780}, {0.659, 1.838, 1.314}, {0.547, 3.668, 3.141}, {3.576, 8.517, 9.249}}}},
    {"Ti",
     7.29,
     {{{0.148, 0.082, 0}, {0.899, 2.276, 0.777}, {0.393, 2.518, 1.545}, {0.187, 1.663, 2.509}, {0.001, 1.762, 19.43}}}},
    {"W",
     13.22,
     {{{0.206, 0.064, 0}, {0.054, 0.530, 1.004}, {0.166, 1.281, 1.917}, {0.706, 3.332, 3.580}, {2.590, 5.836, 7.498}}}},
}};

/// n + ik at a photon energy in eV (> 0).
template <class T>
ComplexIndex<T> drude_lorentz_index(const DrudeLorentz& metal, const T& energy_ev) {
  T real(1), imaginary(0);
  for (const Oscillator& o : metal.oscillators) {
    const T detuning = square(T(o.energy_ev)) - square(energy_ev), loss = energy_ev * T(o.width_ev);
    const T scale = T(o.strength) * square(T(metal.plasma_ev)) / (square(detuning) + square(loss));
    real += scale * detuning;
    imaginary += scale * loss;
  }
  return index_of_permittivity(real, imaginary);
}

}  // namespace gonio
