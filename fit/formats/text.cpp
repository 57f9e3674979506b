#include "fit/formats/text.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/error.h"
#include "base/number.h"
#include "fit/csv.h"

namespace gonio {
namespace {

bool blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

void require_printable(std::string_view text, const std::string& file, int line) {
  for (const unsigned char c : text)
    if ((c < 32 && c != '\t' && c != '\r') || c == 127)
      throw input_error("{}:{}: is not text (byte {}); expected a text file", file, line, int(c));
}

std::vector<std::string_view> split_at_blanks(std::string_view text) {
  std::vector<std::string_view> words;
  for (std::size_t at = 0; at < text.size();) {
    while (at < text.size() && blank(text[at])) ++at;
    const std::size_t start = at;
    while (at < text.size() && !blank(text[at])) ++at;
    if (at > start) words.push_back(text.substr(start, at - start));
  }
  return words;
}

}  // namespace

std::vector<TextLine> text_lines(std::string_view bytes, const std::string& file) {
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);  // byte order mark
  std::vector<TextLine> lines;
  while (!bytes.empty()) {
    const std::size_t end = bytes.find('\n');
    const int line = static_cast<int>(lines.size()) + 1;
    require_printable(bytes.substr(0, end), file, line);
    lines.push_back({line, without_blanks(bytes.substr(0, end))});
    bytes.remove_prefix(end == bytes.npos ? bytes.size() : end + 1);
  }
  if (std::all_of(lines.begin(), lines.end(), [](const TextLine& line) { return line.text.empty(); }))
    throw input_error("{}:1: is empty; expected a text file", file);
  return lines;
}

std::vector<std::string_view> words_of(std::string_view text) {
  return text.find(',') == text.npos ? split_at_blanks(text) : split_at_commas(text);
}

std::string printable(std::string_view text) {
  std::string shown(text.substr(0, 40));
  for (char& c : shown)
    if (static_cast<unsigned char>(c) < 32 || static_cast<unsigned char>(c) > 126) c = '?';
  return shown;
}

long whole_number(std::string_view text, std::string_view name, long most, const std::string& file, int line) {
  long value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < 0 || value > most)
    throw input_error("{}:{}: {} is `{}`; expected a whole number from 0 to {}", file, line, printable(name),
                      printable(text), most);
  return value;
}

double zenith_deg(double angle, bool radians, std::string_view name, const std::string& file, int line) {
  constexpr double kRounding = 1e-4;
  const double most = radians ? kPi<double> / 2 + kRounding : 90.0;
  if (!(angle >= 0 && angle <= most))
    throw input_error("{}:{}: {} is {}; expected 0 to {}", file, line, printable(name), angle,
                      radians ? "pi/2 radians" : "90 degrees");
  return radians ? std::min(90.0, angle * (180 / kPi<double>)) : angle;
}

Words::Words(std::string_view bytes, const std::string& file, char comment) : file_(file) {
  for (const TextLine& line : text_lines(bytes, file)) {
    if (line.text.empty() || line.text.front() == comment) continue;
    for (const std::string_view word : split_at_blanks(line.text)) words_.push_back({line.line, word});
  }
  if (words_.empty()) throw input_error("{}:1: holds comments alone; expected data", file);
}

Words::Word Words::next(std::string_view expected) {
  if (end()) throw input_error("{}:{}: the file ends here; expected {}", file_, words_.back().line, expected);
  return words_[at_++];
}

double Words::number(std::string_view name) {
  const Word word = next(name);
  return csv_number(word.text, name, file_, word.line);
}

void Words::expect(std::string_view name) {
  const Word word = next(name);
  if (word.text != name)
    throw input_error("{}:{}: `{}` stands here; expected {}", file_, word.line, printable(word.text), name);
}

std::vector<double> Words::counted_list(std::string_view name, double lo, double hi) {
  const Word word = next(fmt::format("the number of {}", name));
  const auto count = static_cast<std::size_t>(whole_number(word.text, name, 1000000, file_, word.line));
  if (count == 0) throw input_error("{}:{}: {} counts 0 angles; expected 1 or more", file_, word.line, name);
  if (count > left())
    throw input_error("{}:{}: {} counts {} angles, but the file ends before; expected as many", file_, word.line, name,
                      count);
  std::vector<double> list;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = number(name);
    if (!(angle >= lo && angle <= hi) || (!list.empty() && !(angle > list.back())))
      throw input_error("{}:{}: {} holds {}; expected increasing angles from {} to {} degrees", file_, line(), name,
                        angle, lo, hi);
    list.push_back(angle);
  }
  return list;
}

}  // namespace gonio
