#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

struct sqlite3;
struct sqlite3_stmt;

namespace gonio {

/// One SQL statement of a connection; its parameters are ?1, ?2, …, its result columns 0, 1, ….
class SqlStatement {
 public:
  SqlStatement(sqlite3* connection, const std::string& file, std::string_view sql);
  SqlStatement& bind(int parameter, std::string_view text);
  SqlStatement& bind(int parameter, double number);
  SqlStatement& bind(int parameter, const std::vector<double>& numbers);  ///< as a blob of their bytes
  bool step();                                                            ///< to the next row; false when there is none
  std::string text(int column) const;
  double number(int column) const;
  std::vector<double> numbers(int column) const;
  /// Ready for new parameters.
  void reset();

 private:
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const;
  };
  [[noreturn]] void fail() const;
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
  std::string file_;
};

/// A connection to an SQLite file (or `:memory:`). Everything throws InputError `FILE: …`. Waits up to a minute for
/// other processes that write.
class SqlFile {
 public:
  enum class Mode { kRead, kCreate };
  SqlFile(const std::filesystem::path& path, Mode mode);
  void execute(const std::string& sql);
  SqlStatement prepare(std::string_view sql) const { return {connection_.get(), path_, sql}; }
  const std::string& path() const { return path_; }

 private:
  struct Close {
    void operator()(sqlite3* connection) const;
  };
  std::unique_ptr<sqlite3, Close> connection_;
  std::string path_;
};

}  // namespace gonio
