#include "reports/html.h"

#include <fmt/format.h>

#include "base/files.h"

namespace gonio::html {
namespace {

constexpr std::string_view kStyle = R"(
body{font:16px/1.5 system-ui,sans-serif;color:#1c1c1c;max-width:1060px;margin:2em auto;padding:0 1em}
h1{font-size:1.7em}h2{margin-top:2.2em;border-top:3px solid #1f4e79;padding-top:.5em}h3{margin-top:1.6em}
table{border-collapse:collapse;margin:.8em 0;font-size:.92em}th,td{padding:.25em .7em;border-bottom:1px solid #ccc;text-align:left;vertical-align:top}
th{border-bottom:2px solid #555}td{font-variant-numeric:tabular-nums}
figure{display:inline-block;margin:.4em .8em .8em 0;vertical-align:top;max-width:100%}figure img{max-width:100%;border:1px solid #ddd}
figcaption{font-size:.86em;color:#444;max-width:34em}
.bad{background:#fdeceb;border-left:5px solid #b3261e;padding:.5em .9em;margin:.7em 0}
.good{background:#e9f5ec;border-left:5px solid #2e7d32;padding:.5em .9em;margin:.7em 0}
.note{color:#555;font-size:.9em}tr.chosen td{font-weight:600;background:#eef4fa}
)";

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) { return i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u; };
    const unsigned three = byte(0) << 16 | byte(1) << 8 | byte(2);
    for (int k = 0; k < 4; ++k)
      text += i + static_cast<std::size_t>(k) > bytes.size() ? '=' : kDigits[three >> (18 - 6 * k) & 63];
  }
  return text;
}

}  // namespace

std::string escape(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '&') out += "&amp;";
    else if (c == '<') out += "&lt;";
    else if (c == '>') out += "&gt;";
    else if (c == '"') out += "&quot;";
    else out += c;
  }
  return out;
}

std::string figure(const std::filesystem::path& file, std::string_view caption) {
  const std::string_view type = file.extension() == ".svg" ? "image/svg+xml" : "image/png";
  return fmt::format("<figure><img alt=\"{0}\" src=\"data:{1};base64,{2}\"><figcaption>{0}</figcaption></figure>\n", escape(caption), type,
                     base64(read_file(file)));
}

std::string table(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows) {
  std::string out = "<table><tr>";
  for (const auto& cell : header) out += fmt::format("<th>{}</th>", cell);
  out += "</tr>\n";
  for (const auto& row : rows) {
    out += "<tr>";
    for (const auto& cell : row) out += fmt::format("<td>{}</td>", cell);
    out += "</tr>\n";
  }
  return out + "</table>\n";
}

std::string page(std::string_view title, std::string_view body) {
  return fmt::format("<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
                     "content=\"width=device-width\"><title>{}</title><style>{}</style></head><body>\n{}</body></html>\n",
                     escape(title), kStyle, body);
}

}  // namespace gonio::html
