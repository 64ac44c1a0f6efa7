// A database in one file, as little of it as a study needs. SQLite lies in a module that loads when first used.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace tendril::variation {

using Blob = std::vector<unsigned char>;
using Cell = std::variant<std::monostate, std::int64_t, double, std::string, Blob>;  ///< nothing: NULL; NaN is stored as that

class Database {
 public:
  virtual ~Database() = default;
  using OnRow = std::function<void(std::span<const Cell> row)>;
  /// Runs one statement with values for its question marks and calls `on_row` for each row of the answer. Returns what went
  /// wrong, else an empty text.
  virtual std::string run(const std::string& statement, std::span<const Cell> values, const OnRow& on_row) = 0;
};

/// The module's entry: a database, created when the file does not exist; else null and the reason in `error`.
using OpenDatabase = Database* (*)(const char* path, std::string& error);
inline constexpr const char* database_entry = "tendril_open_database";

}  // namespace tendril::variation
