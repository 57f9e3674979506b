#include "materials/sqlite.h"

#include <sqlite3.h>

#include <cstring>

#include "base/error.h"

namespace gonio {
namespace {

[[noreturn]] void fail(sqlite3* connection, const std::string& file) {
  throw input_error("{}: {}; expected a materials database that can be used", file,
                    connection ? sqlite3_errmsg(connection) : "not enough memory");
}

}  // namespace

void SqlStatement::Finalize::operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
void SqlFile::Close::operator()(sqlite3* connection) const { sqlite3_close_v2(connection); }

void SqlStatement::fail() const { gonio::fail(sqlite3_db_handle(statement_.get()), file_); }

SqlStatement::SqlStatement(sqlite3* connection, const std::string& file, std::string_view sql) : file_(file) {
  sqlite3_stmt* statement = nullptr;
  if (sqlite3_prepare_v2(connection, sql.data(), static_cast<int>(sql.size()), &statement, nullptr) != SQLITE_OK)
    gonio::fail(connection, file);
  statement_.reset(statement);
}

SqlStatement& SqlStatement::bind(int parameter, std::string_view text) {
  const char* data = text.empty() ? "" : text.data();  // a null pointer would bind NULL
  if (sqlite3_bind_text64(statement_.get(), parameter, data, text.size(), SQLITE_TRANSIENT, SQLITE_UTF8) != SQLITE_OK)
    fail();
  return *this;
}

SqlStatement& SqlStatement::bind(int parameter, double number) {
  if (sqlite3_bind_double(statement_.get(), parameter, number) != SQLITE_OK) fail();
  return *this;
}

SqlStatement& SqlStatement::bind(int parameter, const std::vector<double>& numbers) {
  const void* data = numbers.empty() ? static_cast<const void*>("") : numbers.data();
  if (sqlite3_bind_blob64(statement_.get(), parameter, data, numbers.size() * sizeof(double), SQLITE_TRANSIENT) !=
      SQLITE_OK)
    fail();
  return *this;
}

bool SqlStatement::step() {
  const int outcome = sqlite3_step(statement_.get());
  if (outcome != SQLITE_ROW && outcome != SQLITE_DONE) fail();
  return outcome == SQLITE_ROW;
}

std::string SqlStatement::text(int column) const {
  const void* data = sqlite3_column_text(statement_.get(), column);
  const auto size = static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column));
  return data ? std::string(static_cast<const char*>(data), size) : std::string();
}

double SqlStatement::number(int column) const { return sqlite3_column_double(statement_.get(), column); }

std::vector<double> SqlStatement::numbers(int column) const {
  const void* data = sqlite3_column_blob(statement_.get(), column);
  const auto bytes = static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column));
  std::vector<double> numbers(bytes / sizeof(double));
  if (!numbers.empty()) std::memcpy(numbers.data(), data, numbers.size() * sizeof(double));
  return numbers;
}

void SqlStatement::reset() {
  sqlite3_reset(statement_.get());
  sqlite3_clear_bindings(statement_.get());
}

SqlFile::SqlFile(const std::filesystem::path& path, Mode mode) : path_(path.string()) {
  constexpr int kWaitMs = 60000;
  const int flags = mode == Mode::kRead ? SQLITE_OPEN_READONLY : SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
  sqlite3* connection = nullptr;
  const int outcome = sqlite3_open_v2(path_.c_str(), &connection, flags | SQLITE_OPEN_NOMUTEX, nullptr);
  connection_.reset(connection);
  if (outcome != SQLITE_OK) fail(connection, path_);
  sqlite3_busy_timeout(connection, kWaitMs);
}

void SqlFile::execute(const std::string& sql) {
  if (sqlite3_exec(connection_.get(), sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK)
    fail(connection_.get(), path_);
}

}  // namespace gonio
