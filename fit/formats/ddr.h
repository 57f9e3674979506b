#pragma once
// Integra's diffuse distribution, .ddr: a table of luminance (or intensity) around the mirror direction, as text.
//
// Lines from `;` on are comments; words in any case. Header: `Source …`, `TypeSym AxiSymmetrical | DirSymmetrical | PlaneSymmetrical |
// ASymmetrical [4D]`, `TypeColorModel BW | RGB | spectral N`, `TypeData Luminance | Intensity, Absolute | Relative`; then lists `NAME count
// values` in degrees: psi (azimuth of incidence, 4D only), sigma (angle of incidence), phi and theta. Then a block a channel: `bw`, or `red`, `gre`,
// `blu`, or `wl NM` N times: optionally `kbdf` and one factor for each psi and sigma (faster), then `def`, values by psi, sigma, phi, theta
// (fastest), `enddef`.
//
// Angles (M. Kopylov et al.; https://resources.mpi-inf.mpg.de/atrium/brdfdata.html): theta from the mirror direction, phi around it
// counter-clockwise, psi around the normal counter-clockwise. phi = 0 leans from the mirror direction towards the normal.
// Absolute luminance: π·f_r·1/kbdf, 1 for the perfect diffuser; intensity: f_r·cos_o/kbdf per sr; relative: up to a factor a psi and sigma.
#include <string>
#include <string_view>

#include "fit/scan.h"

namespace gonio {

/// InputError `file:line: …` for anything but a whole table. Directions below the horizon are left out and counted.
Measurement read_ddr(std::string_view text, const std::string& file);

}  // namespace gonio
