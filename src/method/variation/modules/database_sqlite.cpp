// SQLite behind method/variation/database.h.
#include <sqlite3.h>

#include <cmath>
#include <map>

#include "method/variation/database.h"

namespace tendril::variation {
namespace {

class SqliteDatabase final : public Database {
 public:
  explicit SqliteDatabase(sqlite3* handle) : handle_(handle) {}
  ~SqliteDatabase() override {
    for (const auto& [text, statement] : prepared_) sqlite3_finalize(statement);
    sqlite3_close_v2(handle_);
  }

  std::string run(const std::string& text, std::span<const Cell> values, const OnRow& on_row) override {
    sqlite3_stmt*& statement = prepared_[text];
    if (!statement && sqlite3_prepare_v2(handle_, text.c_str(), -1, &statement, nullptr) != SQLITE_OK) return failure();
    for (std::size_t k = 0; k < values.size(); ++k)
      if (bind(statement, static_cast<int>(k) + 1, values[k]) != SQLITE_OK) return ended(statement, failure());
    int step = SQLITE_ROW;
    while ((step = sqlite3_step(statement)) == SQLITE_ROW)
      if (on_row) on_row(row_of(statement));
    return ended(statement, step == SQLITE_DONE ? std::string() : failure());
  }

 private:
  std::string failure() const { return sqlite3_errmsg(handle_); }

  static std::string ended(sqlite3_stmt* statement, std::string error) {
    sqlite3_reset(statement);
    sqlite3_clear_bindings(statement);
    return error;
  }

  static int bind(sqlite3_stmt* statement, int at, const Cell& cell) {
    if (const auto* whole = std::get_if<std::int64_t>(&cell)) return sqlite3_bind_int64(statement, at, *whole);
    if (const auto* number = std::get_if<double>(&cell))
      return std::isnan(*number) ? sqlite3_bind_null(statement, at) : sqlite3_bind_double(statement, at, *number);
    if (const auto* text = std::get_if<std::string>(&cell))
      return sqlite3_bind_text(statement, at, text->data(), static_cast<int>(text->size()), SQLITE_TRANSIENT);
    if (const auto* blob = std::get_if<Blob>(&cell))
      return sqlite3_bind_blob(statement, at, blob->data(), static_cast<int>(blob->size()), SQLITE_TRANSIENT);
    return sqlite3_bind_null(statement, at);
  }

  static std::vector<Cell> row_of(sqlite3_stmt* statement) {
    std::vector<Cell> row;
    for (int k = 0; k < sqlite3_column_count(statement); ++k) {
      const int size = sqlite3_column_bytes(statement, k);
      switch (sqlite3_column_type(statement, k)) {
        case SQLITE_INTEGER: row.emplace_back(static_cast<std::int64_t>(sqlite3_column_int64(statement, k))); break;
        case SQLITE_FLOAT: row.emplace_back(sqlite3_column_double(statement, k)); break;
        case SQLITE_TEXT: row.emplace_back(std::string(reinterpret_cast<const char*>(sqlite3_column_text(statement, k)), size)); break;
        case SQLITE_BLOB: {
          const auto* bytes = static_cast<const unsigned char*>(sqlite3_column_blob(statement, k));
          row.emplace_back(Blob(bytes, bytes + size));
          break;
        }
        default: row.emplace_back();
      }
    }
    return row;
  }

  sqlite3* handle_;
  std::map<std::string, sqlite3_stmt*> prepared_;
};

}  // namespace
}  // namespace tendril::variation

extern "C" tendril::variation::Database* tendril_open_database(const char* path, std::string& error) {
  sqlite3* handle = nullptr;
  if (sqlite3_open_v2(path, &handle, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, nullptr) != SQLITE_OK) {
    error = handle ? sqlite3_errmsg(handle) : "no memory";
    sqlite3_close(handle);
    return nullptr;
  }
  return new tendril::variation::SqliteDatabase(handle);
}

extern "C" const char* tendril_module_about() { return "SQLite " SQLITE_VERSION; }
