#pragma once
#include <string>

namespace gonio::cli {

/// Draws a gnuplot script (without `set terminal`) into FILE.svg or FILE.png, whole or not at all. InputError for
/// another ending.
void write_picture(const std::string& file, const std::string& script, int width, int height);

}  // namespace gonio::cli
