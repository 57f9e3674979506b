// `gonio materials import` from outside: the user database beside the bundled one, alone and with others.
#include "materials/user_database.h"

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files.h"
#include "catch.h"
#include "cli/json_of.h"

using namespace gonio;
using namespace gonio::test;
using Json = nlohmann::ordered_json;

namespace {

/// The user database of the commands that are run meanwhile.
struct UserDatabase {
  explicit UserDatabase(const std::string& path) { setenv("GONIO_USER_DB", path.c_str(), 1); }
  ~UserDatabase() { unsetenv("GONIO_USER_DB"); }
};

std::string table(double reflectance) {
  return fmt::format("# citation: a lab\nwavelength_nm,R\n400,{0}\n700,{0}\n", reflectance);
}

}  // namespace

TEST_CASE("What is imported is found, shown as the user's, and used like any other", "[materials]") {
  const Scratch scratch;
  const UserDatabase user(scratch.path("deep/er/user.sqlite"));
  const std::string file = scratch.file("moss.csv", table(0.25));
  CHECK(run_gonio({"materials", "import", file, "--name", "moss on stone"}).status == 0);
  const Json card = json_of({"materials", "show", "moss"});
  CHECK(card["origin"] == "user");
  CHECK(card["source"] == "a lab");
  CHECK(card["licence"] == "not stated");
  CHECK(json_of({"materials", "show", "Au"})["origin"] == "bundled");
  CHECK(json_of({"materials", "show", "moss", "--at", "500"})["R_normal"] == 0.25);
  CHECK(json_of({"materials", "search", "stone", "moss"})[0]["id"] == "moss");
  CHECK(json_of({"color", "moss"})["XYZ"][1].get<double>() == Approx(25).epsilon(1e-12));
  CHECK(json_of({"materials", "check"})["findings"].empty());
}

TEST_CASE("Bundled names cannot be taken; one's own only on purpose", "[materials]") {
  const Scratch scratch;
  const UserDatabase user(scratch.path("user.sqlite"));
  const std::string file = scratch.file("moss.csv", table(0.25)), other = scratch.file("two/moss.csv", table(0.5));
  for (const char* name : {"Au_Johnson", "Au", "D65", "perfect"})
    check_refused(scratch, {"materials", "import", file, "--id", name}, "is the name of a bundled entry");
  REQUIRE(run_gonio({"materials", "import", file}).status == 0);
  check_refused(scratch, {"materials", "import", other}, "is in the user database already");
  CHECK(json_of({"materials", "show", "moss", "--at", "500"})["R_normal"] == 0.25);
  CHECK(run_gonio({"materials", "import", other, "--replace"}).status == 0);
  CHECK(json_of({"materials", "show", "moss", "--at", "500"})["R_normal"] == 0.5);
}

TEST_CASE("One bad file hides neither the good ones nor the database", "[materials]") {
  const Scratch scratch;
  const UserDatabase user(scratch.path("user.sqlite"));
  const Outcome outcome = run_gonio({"materials", "import", scratch.file("bad.csv", "wavelength_nm,k\n1,2\n3,4\n"),
                                     scratch.file("a.csv", table(0.1)),
                                     scratch.file("b.csv",
                                                  "\x7f"
                                                  "ELF"),
                                     scratch.file("c.csv", table(0.3))});
  CHECK(outcome.status == 2);
  CHECK_THAT(outcome.err, Catch::Contains("bad.csv:1: the columns are") && Catch::Contains("b.csv:1: not text"));
  CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 2);
  CHECK(json_of({"materials", "show", "c", "--at", "400"})["R_normal"] == 0.3);
  check_refused(scratch, {"materials", "import", scratch.path("missing.csv")}, "missing.csv: cannot be read");
  check_refused(scratch, {"materials", "import", scratch.path("a.csv"), scratch.path("c.csv"), "--id", "x"},
                "expected one file");
  // A user database that is none, or holds nonsense: the bundled one goes on.
  scratch.file("user.sqlite", std::string(4096, 'x'));
  CHECK(json_of({"materials", "show", "Au"})["id"] == "Au_Johnson");
  CHECK(json_of({"materials", "list"}).size() >= 960);
  const Outcome check = run_gonio({"materials", "check"});
  CHECK(check.status == 1);
  CHECK_THAT(check.out, Catch::Contains("user.sqlite: "));
  check_refused(scratch, {"materials", "import", scratch.path("a.csv")}, "user.sqlite: ");
}

TEST_CASE("An entry of the user database that was tampered with is named, the others stay", "[materials]") {
  const Scratch scratch;
  const std::string path = scratch.path("user.sqlite");
  const UserDatabase user(path);
  Entry good;
  good.id = "good", good.name = "good", good.kind = "reflectance", good.unit = "1", good.citation = "me",
  good.licence = "CC0";
  good.confidence = "high", good.range_lo_nm = good.source_lo_nm = 400, good.range_hi_nm = good.source_hi_nm = 700;
  good.wavelength_nm = {400, 700}, good.column_names = {"reflectance"}, good.columns = {{0.5, 0.5}};
  Entry bad = good;
  bad.id = "bad", bad.columns = {{0.5, -7}};
  add_to_user_database(path, {good, bad}, false);
  check_refused(scratch, {"materials", "show", "bad"}, "bad:2: reflectance is -7");
  CHECK(json_of({"materials", "show", "good"})["origin"] == "user");
  CHECK(json_of({"materials", "search", "good"}).size() == 1);
  CHECK(run_gonio({"materials", "check"}).status == 1);
  // All of a batch or nothing of it.
  Entry third = good;
  third.id = "third";
  CHECK_THROWS_WITH(add_to_user_database(path, {third, good}, false), Catch::Contains("good is in the user database"));
  CHECK(run_gonio({"materials", "show", "third"}).status == 2);
}

TEST_CASE("Processes that import at once lose nothing", "[materials]") {
  const Scratch scratch;
  const UserDatabase user(scratch.path("user.sqlite"));
  constexpr int kProcesses = 4, kFiles = 12;
  std::vector<std::vector<std::string>> files(kProcesses);
  for (int p = 0; p < kProcesses; ++p)
    for (int i = 0; i < kFiles; ++i) files[p].push_back(scratch.file(fmt::format("p{}-{}.csv", p, i), table(0.01 * (i + 1))));
  std::vector<pid_t> children;
  for (int p = 0; p < kProcesses; ++p) {
    children.push_back(fork());
    REQUIRE(children.back() >= 0);
    if (children.back() > 0) continue;
    std::vector<std::string> arguments{"materials", "import"};
    arguments.insert(arguments.end(), files[p].begin(), files[p].end());
    _exit(run_gonio(arguments).status);
  }
  for (const pid_t child : children) {
    int status = -1;
    waitpid(child, &status, 0);
    CHECK(status == 0);
  }
  std::size_t mine = 0;
  for (const Json& entry : json_of({"materials", "list"})) mine += entry["origin"] == "user";
  CHECK(mine == kProcesses * kFiles);
  for (int p = 0; p < kProcesses; ++p)
    CHECK(json_of({"materials", "show", fmt::format("p{}-11", p), "--at", "500"})["R_normal"].get<double>() == Approx(0.12));
}
