// The tests' main. They find the data of the source tree wherever they were built.
#include <cstdlib>

#if __has_include(<catch2/catch_session.hpp>)
#include <catch2/catch_session.hpp>  // Catch2 3
#else
#define CATCH_CONFIG_RUNNER  // Catch2 2.13, Debian 12
#include <catch2/catch.hpp>
#endif

int main(int argc, char** argv) {
  setenv("GONIO_HOME", GONIO_SOURCE_DIR, 0);
  return Catch::Session().run(argc, argv);
}
