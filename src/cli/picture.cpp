#include "cli/picture.h"

#include "base/error.h"
#include "base/files.h"
#include "fit/gnuplot.h"

namespace gonio::cli {

void write_picture(const std::string& file, const std::string& script, int width, int height) {
  const bool png = file.ends_with(".png");
  if (!png && !file.ends_with(".svg"))
    throw input_error("--out {}: unknown format; expected FILE.svg or FILE.png", file);
  write_file(file, png ? gnuplot_png(script, width, height) : gnuplot_svg(script, width, height));
}

}  // namespace gonio::cli
