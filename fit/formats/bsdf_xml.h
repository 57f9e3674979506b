#pragma once
// BSDF files of Radiance and LBNL WINDOW (schema BSDF-v1.4, https://windows.lbl.gov/bsdf-xml): a matrix over a Klems basis, or a tensor tree.
//
// Klems matrix (J. Klems, ASHRAE Trans. 100(1), 1994): AngleBasis lists bands of the zenith angle, each with its middle Theta and nPhis
// equal azimuths from 0 on; directions are counted band by band. IncidentDataStructure Columns: a row of the matrix is one direction
// out, Rows: one in. Incoming directions are those of travel, so the light stands at the azimuth opposite to its patch's: the
// matrix's diagonal is the mirror direction.
//
// Tensor tree (G. Ward, "Computing and applying variable-resolution data for bidirectional scattering distribution functions", LBNL 2011): { … } holds
// either 2ⁿ trees, bit k of their count choosing the half of axis k, or 2^(n·levels) values, last axis fastest. Axes: the unit square of the
// direction in (TensorTree4) or ½(1 - sin θ_i) (TensorTree3, light at azimuth 180°), then that of the direction out; squares are mapped to the
// disk of (x, y) by Shirley & Chiu's concentric map. Each leaf is read at its middle.
// Values are BRDFs in sr⁻¹.
#include <string>
#include <string_view>

#include "fit/scan.h"

namespace gonio {

/// The visible reflection of a file; the front's where both sides are given. InputError `file:line: …` for anything not whole.
Measurement read_bsdf_xml(std::string_view text, const std::string& file);

}  // namespace gonio
