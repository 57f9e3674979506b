#include <fmt/format.h>

#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files.h"
#include "cli/commands.h"
#include "reports/pages.h"

namespace gonio::cli {
namespace {

struct ReportArguments {
  std::string name, out;
  bool check = false;
};

void list_pages(bool json) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const PublishedPage& page : published_pages()) {
    list.push_back({{"name", page.name}, {"about", page.about}});
    if (!json) std::cout << fmt::format("{:16} {}\n", page.name, page.about);
  }
  if (json) std::cout << list.dump(2) << '\n';
}

void remake(const ReportArguments& arguments, Common& common) {
  const PublishedPage& page = published_page(arguments.name);
  if (arguments.check && !page.repeatable)
    throw input_error("--check: numbers of {} may change between machines; expected a page where they do not",
                      page.name);
  const std::filesystem::path published = data_folder("reports") / page.name;
  const std::string out = arguments.out.empty() ? "out/reports/" + arguments.name : arguments.out;
  page.remake(published, out, [](const std::string& part) { std::cerr << part << '\n'; });
  const std::vector<std::string> differences =
      arguments.check ? page_differences(published, out) : std::vector<std::string>{};
  if (!differences.empty()) common.exit_code = 1;
  if (common.json) {
    std::cout << nlohmann::ordered_json{{"name", page.name}, {"folder", out}, {"differences", differences}}.dump(2)
              << '\n';
    return;
  }
  for (const std::string& line : differences) std::cout << line << '\n';
  std::cout << out << (arguments.check && differences.empty() ? ": as published\n" : "\n");
}

}  // namespace

void add_report(CLI::App& app, Common& common) {
  auto* command = app.add_subcommand("report", "Remakes one published page of reports/; lists them without a name");
  command->footer("Example: gonio report interpolation --check");
  add_common(*command, common);
  auto arguments = std::make_shared<ReportArguments>();
  command->add_option("name", arguments->name, "Page to remake");
  command->add_option("-o,--out", arguments->out, "Folder for the page (out/reports/NAME)");
  command->add_flag("--check", arguments->check,
                    "Compare with the published page; exit 1 on a difference beyond rounding");
  command->callback(
      [&common, arguments] { arguments->name.empty() ? list_pages(common.json) : remake(*arguments, common); });
}

}  // namespace gonio::cli
