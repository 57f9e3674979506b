#pragma once
#include <string>

namespace gonio {

/// Runs a gnuplot script (without `set terminal`/`set output`) and returns the SVG it draws, `width` × `height` pixels.
/// InputError when gnuplot cannot be run. The same script gives the same bytes: nothing of the user's settings is read.
std::string gnuplot_svg(const std::string& script, int width, int height);

/// The same as a PNG.
std::string gnuplot_png(const std::string& script, int width, int height);

/// Text for gnuplot between single quotes, with its markup characters taken literally.
std::string gnuplot_text(const std::string& text);

}  // namespace gonio
