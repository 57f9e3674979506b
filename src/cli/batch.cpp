#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "base/digest.h"
#include "base/error.h"
#include "base/files.h"
#include "cli/arguments.h"
#include "cli/choice_report.h"
#include "cli/commands.h"
#include "cli/diagnosed.h"
#include "cli/fit_options.h"
#include "fit/fit.h"
#include "fit/formats/formats.h"
#include "fit/plots.h"
#include "reports/html.h"

namespace gonio::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::string_view kAuto = "auto";  ///< in place of a model: the simplest that will do (fit/choose.h)

struct BatchArguments {
  std::vector<std::string> measurements, models;
  std::string out;
  FitOptions options;
  bool refit = false;
};

/// One measurement, one model: where it goes and what became of it.
struct Task {
  fs::path measurement, folder;  ///< folder: below the batch's
  std::string name, model;
  std::string status, reason;  ///< fitted, kept, not converged, failed (with its reason)
  Json fit;                    ///< of fit.json; null where it failed
};

bool is_measurement(const fs::path& path) {
  return fs::is_regular_file(path) || fs::exists(path / "scan.csv") || fs::exists(path / "measurement.yaml");
}

/// CSV, or what looks like a format of others and has its ending.
bool may_be_scan(const fs::path& file) {
  if (file.extension() == ".csv") return true;
  const Format* format = format_of(file);
  return format && file.extension() == format->extension;
}

/// A measurement as it is; of any other folder, the measurements and scans in it, by name.
std::vector<fs::path> measurements_in(const fs::path& path) {
  if (!fs::exists(path))
    throw input_error("{}: does not exist; expected a measurement or a folder of them", path.string());
  if (is_measurement(path)) return {path};
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(path))
    if (entry.is_directory() ? is_measurement(entry.path()) : may_be_scan(entry.path())) found.push_back(entry.path());
  if (found.empty())
    throw input_error("{}: holds no measurement; expected folders with scan.csv, CSV files or foreign ones",
                      path.string());
  std::sort(found.begin(), found.end());
  return found;
}

/// The name of a measurement's own folder or file.
std::string own_name(const fs::path& measurement) {
  const fs::path whole = fs::canonical(measurement);
  return (fs::is_directory(whole) ? whole.filename() : whole.stem()).string();
}

/// Everything that decides a fit: the bytes of the measurement's files, the options, the format of this record.
std::string inputs_digest(const Task& task, const BatchArguments& a, std::uint64_t seed) {
  std::vector<fs::path> files;
  if (fs::is_regular_file(task.measurement))
    files.push_back(task.measurement);
  else
    for (const auto& entry : fs::directory_iterator(task.measurement))
      if (entry.is_regular_file()) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::uint64_t digest = digest_of(fmt::format("gonio batch 2|{}|{}|{}", task.model, a.options.words(), seed));
  for (const fs::path& file : files) {
    const std::string content = read_file(file);
    digest = digest_of(fmt::format("|{}|{}|", file.filename().string(), content.size()), digest);
    digest = digest_of(content, digest);
  }
  return fmt::format("{:016x}", digest);
}

/// The fit that an earlier call left for the same inputs; null where there is none.
Json kept_fit(const fs::path& folder, const std::string& digest) {
  if (!fs::exists(folder / "inputs.json") || !fs::exists(folder / "fit.json")) return nullptr;
  const Json inputs = Json::parse(read_file(folder / "inputs.json"), nullptr, false);
  if (!inputs.is_object() || inputs.value("digest", std::string()) != digest) return nullptr;
  const Json fit = Json::parse(read_file(folder / "fit.json"), nullptr, false);
  return fit.is_object() ? fit : Json(nullptr);
}

/// The record of the inputs is removed first and written last: an interrupted fit is fitted again.
void fit_anew(Task& task, const FitOptions& options, std::uint64_t seed, const fs::path& folder,
              const std::string& digest) {
  const Measurement scan = cleaned(read_any(task.measurement), options);
  FitResult result;
  std::string choice;
  if (task.model == kAuto) {
    ChosenFit chosen = chosen_fit(scan, options, seed, {});
    result = std::move(chosen.result), task.fit = std::move(chosen.json), choice = choice_csv(chosen.choice, {});
  } else {
    result = fit(scan, request_for(options, task.model, seed, scan.aperture_deg));
    task.fit = diagnosed(scan, options, result);
  }
  make_folder(folder);
  for (const char* stale : {"inputs.json", "in-plane-log.svg", "in-plane-linear.svg", "residuals.svg"})
    fs::remove(folder / stale);
  write_plots(result, folder);
  if (!choice.empty()) write_file(folder / "choice.csv", choice);
  write_file(folder / "fit.json", task.fit.dump(2) + "\n");
  const Json inputs{{"gonio_batch", 1}, {"digest", digest}, {"measurement", task.measurement.string()}};
  write_file(folder / "inputs.json", inputs.dump(2) + "\n");
}

std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return text;
}

void run_task(Task& task, const BatchArguments& a, std::uint64_t seed) {
  try {
    const std::string digest = inputs_digest(task, a, seed);
    const fs::path folder = fs::path(a.out) / task.folder;
    if (!a.refit) task.fit = kept_fit(folder, digest);
    const bool kept = !task.fit.is_null();
    if (!kept) fit_anew(task, a.options, seed, folder, digest);
    task.status = !task.fit.value("converged", false) ? "not converged" : kept ? "kept" : "fitted";
  } catch (const std::exception& error) {
    task.status = "failed", task.reason = one_line(error.what()), task.fit = nullptr;
  }
}

/// A number of fit.json, or one for each wavelength, in `digits` digits; empty for null.
std::string number(const Json& value, int digits) {
  if (value.is_array()) {
    std::string text;
    for (const Json& one : value) text += (text.empty() ? "" : " ") + number(one, digits);
    return text;
  }
  return value.is_number() ? fmt::format("{:.{}g}", value.get<double>(), digits) : std::string();
}

/// One end (0 or 1) of [lo, hi], or of an array of them.
Json end_of(const Json& interval, std::size_t end) {
  if (interval.empty() || !interval[0].is_array()) return interval.at(end);
  Json ends = Json::array();
  for (const Json& one : interval) ends.push_back(one.at(end));
  return ends;
}

Json error_of(const Task& task, bool held_out) {
  if (task.fit.is_null()) return nullptr;
  const Json& residuals = task.fit.at("residuals");
  if (!held_out) return residuals.at("rms_log10");
  if (task.fit.contains("choice")) {
    const Json& choice = task.fit.at("choice");
    return choice.at("candidates").at(choice.at("chosen").get<std::size_t>()).at("held_out_rms_log10");
  }
  return residuals.at("held_out").is_null() ? Json(nullptr) : residuals.at("held_out").at("rms_log10");
}

/// What was fitted in the end: of auto the model that it chose.
std::string fitted_model(const Task& task) {
  return task.fit.is_null() ? std::string() : task.fit.at("model").get<std::string>();
}

/// A cell of a CSV, quoted where it must be (RFC 4180).
std::string cell(const std::string& text) {
  if (text.find_first_of(",\"\n") == text.npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

/// Parameters of all the fits, in the order in which they are met.
std::vector<std::string> parameter_names(const std::vector<Task>& tasks) {
  std::vector<std::string> names;
  for (const Task& task : tasks) {
    if (task.fit.is_null()) continue;
    for (const auto& [name, p] : task.fit.at("parameters").items())
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return names;
}

/// One row a fit; a parameter has three columns, which hold one number for each wavelength where it has several.
std::string summary_csv(const std::vector<Task>& tasks) {
  const std::vector<std::string> names = parameter_names(tasks);
  std::string csv = "measurement,model,status,rms_log10,held_out_rms_log10,points,fitted_model";
  for (const std::string& name : names) csv += fmt::format(",{0},{0}_lo95,{0}_hi95", name);
  csv += ",reason\n";
  for (const Task& task : tasks) {
    csv += fmt::format("{},{},{},{},{},{},{}", cell(task.name), task.model, task.status,
                       number(error_of(task, false), 17), number(error_of(task, true), 17),
                       task.fit.is_null() ? "" : number(task.fit.at("points").at("used"), 17), fitted_model(task));
    for (const std::string& name : names) {
      const bool has = !task.fit.is_null() && task.fit.at("parameters").contains(name);
      const Json p = has ? task.fit.at("parameters").at(name) : Json(nullptr);
      csv += !has ? ",,,"
                  : fmt::format(",{},{},{}", number(p.at("value"), 17), number(end_of(p.at("interval95"), 0), 17),
                                number(end_of(p.at("interval95"), 1), 17));
    }
    csv += "," + cell(task.reason) + "\n";
  }
  return csv;
}

/// A path as a link: what a URL or HTML would take for its own is percent-encoded (RFC 3986).
std::string link_to(const fs::path& path) {
  std::string link;
  for (const char c : path.generic_string())
    link += std::string_view("%?#&<>\"' ").find(c) == std::string_view::npos
                ? std::string(1, c)
                : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  return link;
}

std::string parameters_html(const Json& fit) {
  std::string lines;
  for (const auto& [name, p] : fit.at("parameters").items()) {
    const std::string unit = p.at("unit") == "1" ? "" : " " + p.at("unit").get<std::string>();
    lines += fmt::format("{}{} = {}{}", lines.empty() ? "" : "<br>", html::escape(name), number(p.at("value"), 6),
                         html::escape(unit));
    if (!p.at("standard_error").is_null())
      lines += fmt::format(
          " <span class=\"note\">({})</span>",
          fmt::format("{} to {}", number(end_of(p.at("interval95"), 0), 4), number(end_of(p.at("interval95"), 1), 4)));
  }
  return lines;
}

std::string sentence_html(const Json& fit) {
  if (!fit.contains("choice")) return "";
  return "<br>" + html::escape(fit.at("choice").at("sentence").get<std::string>());
}

/// Every fit in a table, then its plots; they stay beside the page, which would be large with them inside.
std::string gallery(const std::vector<Task>& tasks, const fs::path& out) {
  std::vector<std::vector<std::string>> rows;
  std::string figures, before;
  for (const Task& task : tasks) {
    const std::string folder = link_to(task.folder), status = html::escape(task.status);
    const bool has = !task.fit.is_null();
    rows.push_back({html::escape(task.name),
                    has ? fmt::format("<a href=\"{}/fit.json\">{}</a>{}", folder, task.model,
                                      task.model == kAuto ? ": " + fitted_model(task) : std::string())
                        : task.model,
                    has ? status : status + ": " + html::escape(task.reason), number(error_of(task, false), 4),
                    number(error_of(task, true), 4), has ? parameters_html(task.fit) + sentence_html(task.fit) : ""});
    if (!has) continue;
    if (task.name != before) figures += fmt::format("<h2>{}</h2>\n", html::escape(task.name));
    before = task.name;
    const char* plot =
        fs::exists(out / task.folder / "in-plane-log.svg") ? "in-plane-log.svg" : "fitted-against-measured.svg";
    figures += fmt::format(
        "<figure><a href=\"{0}/fit.json\"><img loading=\"lazy\" width=\"480\" alt=\"{1}\" "
        "src=\"{0}/{2}\"></a><figcaption>{1}, "
        "rms_log10 {3}</figcaption></figure>\n",
        folder, task.model, plot, number(error_of(task, false), 3));
  }
  return html::page("gonio batch", "<h1>Fits</h1>\n" +
                                       html::table({"measurement", "model", "status", "rms_log10",
                                                    "left out: rms_log10", "parameters (95 %)"},
                                                   rows) +
                                       figures);
}

Json row_of(const Task& task) {
  return {{"measurement", task.name},
          {"model", task.model},
          {"status", task.status},
          {"reason", task.reason.empty() ? Json(nullptr) : Json(task.reason)},
          {"folder", task.fit.is_null() ? Json(nullptr) : Json(task.folder.generic_string())},
          {"rms_log10", error_of(task, false)},
          {"held_out_rms_log10", error_of(task, true)},
          {"parameters", task.fit.is_null() ? Json::object() : task.fit.at("parameters")}};
}

/// Measurement by measurement, model by model; two of one name would share a folder and are refused.
std::vector<Task> tasks_of(const BatchArguments& a) {
  std::vector<Task> tasks;
  std::set<std::string> names;
  for (const std::string& given : a.measurements)
    for (const fs::path& path : measurements_in(given)) {
      const std::string name = own_name(path);
      if (!names.insert(name).second)
        throw input_error("{}: two measurements have this name; expected one folder each", name);
      for (const std::string& model_name : a.models) {
        if (model_name != kAuto) lobe_sum(model_name);  // refuses an unknown one
        tasks.push_back({path, fs::path(name) / model_name, name, model_name, {}, {}, nullptr});
      }
    }
  return tasks;
}

void run_batch(const BatchArguments& a, Common& common) {
  std::vector<Task> tasks = tasks_of(a);
  if (tasks.front().model == kAuto)
    refuse_own_options(a.options);
  else
    request_for(a.options, tasks.front().model, common.seed, 1.0);  // refuses options that no fit can take
  make_folder(a.out);
  int done = 0;
  for (Task& task : tasks) {
    run_task(task, a, common.seed);
    std::cerr << fmt::format("[{}/{}] {}: {}: {}{}\n", ++done, tasks.size(), task.name, task.model, task.status,
                             task.reason.empty() ? "" : ": " + task.reason);
    if (task.status == "failed" || task.status == "not converged") common.exit_code = 1;
  }
  write_file(fs::path(a.out) / "summary.csv", summary_csv(tasks));
  write_file(fs::path(a.out) / "index.html", gallery(tasks, a.out));
  Json rows = Json::array();
  std::size_t width = 0;
  for (const Task& task : tasks) width = std::max(width, task.name.size());
  for (const Task& task : tasks) {
    rows.push_back(row_of(task));
    if (!common.json)
      std::cout << fmt::format("{:<{}} {:<22} {:<14} {:>10} {:>10} {}\n", task.name, width, task.model, task.status,
                               number(error_of(task, false), 4), number(error_of(task, true), 4), task.reason);
  }
  if (common.json) std::cout << rows.dump(2) << '\n';
}

}  // namespace

void add_batch(CLI::App& app, Common& common) {
  auto* command = app.add_subcommand("batch", "Fit every model to every measurement, resumably, with a summary");
  command->footer(
      "Example: gonio batch measurements --model torrance-sparrow ggx --out out/batch\n"
      "Writes OUT/MEASUREMENT/MODEL/fit.json and plots, OUT/summary.csv and OUT/index.html. A finished fit of the "
      "same\n"
      "files and options is kept (its digest lies beside it in inputs.json; a changed material database is not seen:\n"
      "--refit). What fails is listed with its reason and stops nothing else. Exit 1: a fit failed or did not "
      "converge.");
  add_common(*command, common);
  auto a = std::make_shared<BatchArguments>();
  command->add_option("measurements", a->measurements, "Measurements, or folders that hold measurements")->required();
  command
      ->add_option("--model", a->models,
                   "One or more models, see `gonio models`, sums a+b, or auto: the simplest that will do")
      ->required();
  add_fit_options(*command, a->options);
  command->add_flag("--refit", a->refit, "Fit again what is finished");
  command->add_option("-o,--out", a->out, "Folder to write")->required();
  command->callback([&common, a] { run_batch(*a, common); });
}

}  // namespace gonio::cli
