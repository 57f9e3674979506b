#pragma once
#include <yaml-cpp/yaml.h>

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "scene/scene.h"

namespace gonio {

/// Text of a file as YAML; InputError `file:line: …` when it is none.
YAML::Node parse_yaml(const std::string& text, const std::string& file);

/// Text of a file as an error shows it: on one line, cut when longer than so many bytes.
std::string shown(std::string text, std::size_t longest = 60);

/// A mapping of a YAML file, read strictly: every value is asked for by name, with its range; finish() refuses what
/// nobody asked for. Every error is `file:line: what is wrong; what was expected`.
class YamlMap {
 public:
  /// InputError when the node is no mapping, a key is no plain text, or a key appears twice.
  YamlMap(const YAML::Node& node, std::string file, std::string what);

  /// Whether a key is there; asking makes it a known one.
  bool has(std::string_view key);
  /// The value of a key that must be there.
  YAML::Node at(std::string_view key);
  YamlMap map(std::string_view key) { return {at(key), file_, std::string(key)}; }
  double number(std::string_view key, double lo, double hi);
  double number_or(std::string_view key, double lo, double hi, double fallback);
  int integer(std::string_view key, int lo, int hi);
  std::string text(std::string_view key);
  std::string text_or(std::string_view key, std::string fallback);
  Vector point(std::string_view key);
  /// Every key in the file's order.
  const std::vector<std::string>& keys() const { return keys_; }
  /// InputError naming the first key that was not asked for, and those that were.
  void finish() const;

  const std::string& file() const { return file_; }
  /// Where a key's value stands; where the mapping starts when it is not there.
  int line(std::string_view key = "") const;
  /// `file:line: {what}; expected {expected}` at a node (or at the mapping).
  InputError error(const YAML::Node& node, std::string_view what, std::string_view expected) const;
  double number_of(const YAML::Node& node, std::string_view key, double lo, double hi) const;

 private:
  YAML::Node node_;
  std::string file_, what_;
  std::vector<std::string> keys_;
  std::set<std::string, std::less<>> asked_;
};

}  // namespace gonio
