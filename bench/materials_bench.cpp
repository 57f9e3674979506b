// What the database costs: opening it and looking one entry up, inside the process and as the whole command.
#include <benchmark/benchmark.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>

#include "base/files.h"
#include "materials/database.h"

using namespace gonio;

namespace {

const std::string& compiled() {
  static const std::string path = data_file("materials.sqlite").string();
  return path;
}

void open_and_find(benchmark::State& state) {
  for (auto _ : state) {
    const Database database(compiled());
    benchmark::DoNotOptimize(database.find("Au").at(550));
  }
}

void find_again(benchmark::State& state) {
  const Database database(compiled());
  for (auto _ : state) benchmark::DoNotOptimize(&database.find("Au"));
}

void read_every_entry(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(Database(compiled()).all().size());
}

void search_words(benchmark::State& state) {
  const Database database(compiled());
  for (auto _ : state) benchmark::DoNotOptimize(database.search("gold johnson").size());
}

/// Wall time of `gonio materials show Au --at 550`.
void show_command(benchmark::State& state) {
  char command[] = GONIO_COMMAND, materials[] = "materials", show[] = "show", id[] = "Au", at[] = "--at", nm[] = "550";
  char* arguments[] = {command, materials, show, id, at, nm, nullptr};
  posix_spawn_file_actions_t quiet;
  posix_spawn_file_actions_init(&quiet);
  posix_spawn_file_actions_addopen(&quiet, 1, "/dev/null", 1 /* O_WRONLY */, 0);
  for (auto _ : state) {
    pid_t child = 0;
    int status = -1;
    if (posix_spawn(&child, command, &quiet, nullptr, arguments, environ) == 0) waitpid(child, &status, 0);
    if (status != 0) state.SkipWithError("the command failed");
  }
  posix_spawn_file_actions_destroy(&quiet);
}

BENCHMARK(open_and_find)->Unit(benchmark::kMillisecond);
BENCHMARK(find_again)->Unit(benchmark::kMicrosecond);
BENCHMARK(search_words)->Unit(benchmark::kMicrosecond);
BENCHMARK(read_every_entry)->Unit(benchmark::kMillisecond);
BENCHMARK(show_command)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
