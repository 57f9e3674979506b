#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "catch.h"
#include "cli/command.h"

namespace gonio::test {

/// What `gonio … --json` prints; the command must succeed.
inline nlohmann::ordered_json json_of(std::vector<std::string> arguments) {
  arguments.push_back("--json");
  const Outcome outcome = run_gonio(arguments);
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  return nlohmann::ordered_json::parse(outcome.out);
}

}  // namespace gonio::test
