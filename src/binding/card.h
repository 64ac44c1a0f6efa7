// Results as cards: aligned rows of names and values with units an engineer reads without counting zeros.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tendril {

/// A value in the multiple of its SI unit that suits its size, 4 significant digits: quantity(0.0123, "m") is
/// "12.3 mm", quantity(2.5e-5, "s") "25 us". Units scaled: m, s, N, J, Pa, kg, N m, kg/m; rad is shown in deg; every other
/// unit as it is. Infinity is "infinite", NaN "unknown".
std::string quantity(double value, std::string_view unit);

/// A plain number with 4 significant digits, without an exponent from 1e-4 up to 1e6.
std::string plain_number(double value);

class Card {
 public:
  explicit Card(std::string title) : title_(std::move(title)) {}

  /// `note` stands behind the value, in its own column.
  Card& row(std::string name, std::string value, std::string note = "");
  Card& row(std::string name, double value, std::string_view unit, std::string note = "");

  /// The title, then one line a row; no newline at the end.
  std::string text() const;

 private:
  struct Row {
    std::string name, value, note;
  };
  std::string title_;
  std::vector<Row> rows_;
};

/// A table with a head line: columns aligned, the first to the left, numbers to the right. Rows shorter than the head
/// are filled up. No newline at the end.
std::string table_text(const std::vector<std::string>& head, const std::vector<std::vector<std::string>>& rows);

/// Numbers as a row of bars on a logarithmic scale, the largest the highest; zero and less are the lowest. Of more than `most` as
/// many evenly spread ones, the last among them. `unicode`: block characters, else ASCII.
std::string sparkline(const std::vector<double>& values, bool unicode, std::size_t most = 40);

}  // namespace tendril
