// The published pages are what the code makes today, and the comparison can tell.
#include "reports/pages.h"

#include <unistd.h>

#include <filesystem>

#include "base/error.h"
#include "base/files.h"
#include "catch.h"

using namespace gonio;
namespace fs = std::filesystem;

namespace {

/// A folder of its own, gone afterwards.
struct Scratch {
  fs::path folder = fs::temp_directory_path() / fs::path("gonio-pages-" + std::to_string(::getpid()));
  Scratch() { fs::create_directories(folder); }
  ~Scratch() { fs::remove_all(folder); }
};

std::vector<std::string> differences(const Scratch& scratch, const std::string& published, const std::string& remade) {
  for (const auto& [name, text] : {std::pair{"old", published}, std::pair{"new", remade}}) {
    fs::create_directories(scratch.folder / name);
    write_file(scratch.folder / name / "a.csv", text);
  }
  return page_differences(scratch.folder / "old", scratch.folder / "new");
}

}  // namespace

TEST_CASE("Pages: a difference is what rounding cannot explain", "[reports]") {
  const Scratch scratch;
  CHECK(differences(scratch, "a,1.234e-05\nb,3\n", "a,1.235e-05\nb,3\n").empty());
  CHECK(differences(scratch, "a,0.10\n", "a,0.11\n").empty());
  CHECK(differences(scratch, "a,0.10\n", "a,0.12\n").size() == 1);
  CHECK(differences(scratch, "a,1.234e-05\n", "a,1.244e-05\n").size() == 1);
  CHECK(differences(scratch, "a,3\n", "a,4\n").size() == 1);  // a count
  CHECK(differences(scratch, "a,1.5\n", "b,1.5\n").size() == 1);
  CHECK(differences(scratch, "a,1.5\n", "a,1.5,2\n").size() == 1);
  CHECK(differences(scratch, "a,1.5\n", "a,1.5\nb,2\n").size() == 1);
  CHECK(differences(scratch, "a,1.5\n", "a,nan\n").size() == 1);
  write_file(scratch.folder / "new" / "b.svg", "x");
  CHECK(page_differences(scratch.folder / "old", scratch.folder / "new").size() == 2);
  CHECK_THROWS_AS(published_page("nothing"), InputError);
}

TEST_CASE("Pages: every published one is remade without a difference beyond rounding", "[reports][slow]") {
  const Scratch scratch;
  for (const PublishedPage& page : published_pages()) {
    if (!page.repeatable) continue;
    const fs::path published = data_folder("reports") / page.name;
    page.remake(published, scratch.folder / page.name, [](const std::string&) {});
    const std::vector<std::string> found = page_differences(published, scratch.folder / page.name);
    INFO(page.name << ": " << (found.empty() ? "" : found.front()));
    CHECK(found.empty());
  }
}
