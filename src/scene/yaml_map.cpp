#include "scene/yaml_map.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace gonio {
namespace {

int line_of(const YAML::Node& node) { return std::max(0, node.Mark().line) + 1; }

}  // namespace

std::string shown(std::string text, std::size_t longest) {
  if (text.size() > longest) text = text.substr(0, longest) + "…";
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 32) c = ' ';
  return text;
}

YAML::Node parse_yaml(const std::string& text, const std::string& file) try {
  return YAML::Load(text);
} catch (const YAML::Exception& error) {
  throw input_error("{}:{}: is no YAML ({}); expected a mapping of `key: value`", file,
                    std::max(0, error.mark.line) + 1, shown(error.msg));
}

YamlMap::YamlMap(const YAML::Node& node, std::string file, std::string what)
    : node_(node), file_(std::move(file)), what_(shown(std::move(what))) {
  if (!node_.IsMap()) throw error(node_, fmt::format("{} is no mapping", what_), "`key: value` pairs");
  for (const auto& pair : node_) {
    if (!pair.first.IsScalar()) throw error(pair.first, fmt::format("a key of {} is no plain text", what_), "a name");
    const std::string key = pair.first.Scalar();
    if (std::find(keys_.begin(), keys_.end(), key) != keys_.end())
      throw error(pair.first, fmt::format("`{}` appears twice in {}", shown(key), what_), "it once");
    keys_.push_back(key);
  }
}

int YamlMap::line(std::string_view key) const {
  for (const auto& pair : node_)
    if (pair.first.Scalar() == key) return line_of(pair.second);
  return line_of(node_);
}

InputError YamlMap::error(const YAML::Node& node, std::string_view what, std::string_view expected) const {
  return input_error("{}:{}: {}; expected {}", file_, line_of(node), what, expected);
}

bool YamlMap::has(std::string_view key) {
  asked_.emplace(key);
  return std::find(keys_.begin(), keys_.end(), key) != keys_.end();
}

YAML::Node YamlMap::at(std::string_view key) {
  asked_.emplace(key);
  for (const auto& pair : node_)
    if (pair.first.Scalar() == key) return pair.second;
  throw error(node_, fmt::format("{} has no `{}`", what_, key), "it to be given");
}

double YamlMap::number_of(const YAML::Node& node, std::string_view key, double lo, double hi) const {
  const std::string text = node.IsScalar() ? node.Scalar() : "";
  double value = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (code != std::errc() || end != text.data() + text.size() || !(value >= lo && value <= hi))
    throw error(node, fmt::format("{} of {} is `{}`", key, what_, shown(text)), fmt::format("{} to {}", lo, hi));
  return value;
}

double YamlMap::number(std::string_view key, double lo, double hi) { return number_of(at(key), key, lo, hi); }

double YamlMap::number_or(std::string_view key, double lo, double hi, double fallback) {
  return has(key) ? number(key, lo, hi) : fallback;
}

int YamlMap::integer(std::string_view key, int lo, int hi) {
  const double value = number(key, lo, hi);
  if (value != std::floor(value)) throw error(at(key), fmt::format("{} is {}", key, value), "a whole number");
  return static_cast<int>(value);
}

std::string YamlMap::text(std::string_view key) {
  const YAML::Node node = at(key);
  if (!node.IsScalar() || node.Scalar().empty())
    throw error(node, fmt::format("{} of {} is no plain text", key, what_), "one value");
  return node.Scalar();
}

std::string YamlMap::text_or(std::string_view key, std::string fallback) {
  return has(key) ? text(key) : std::move(fallback);
}

Vector YamlMap::point(std::string_view key) {
  const YAML::Node node = at(key);
  if (!node.IsSequence() || node.size() != 3)
    throw error(node, fmt::format("{} of {} is no point", key, what_), "[x, y, z]");
  return {number_of(node[0], key, -1e4, 1e4), number_of(node[1], key, -1e4, 1e4), number_of(node[2], key, -1e4, 1e4)};
}

void YamlMap::finish() const {
  for (const auto& pair : node_)
    if (!asked_.contains(pair.first.Scalar()))
      throw error(pair.first, fmt::format("unknown key `{}` in {}", shown(pair.first.Scalar()), what_),
                  fmt::format("{}", fmt::join(asked_, ", ")));
}

}  // namespace gonio
