#include "binding/card.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <span>

#include "base/units.h"

namespace tendril {
namespace {

struct Scale {
  double factor;
  const char* unit;
};

/// From large to small. A value is shown in the first multiple it reaches.
std::span<const Scale> scales_of(std::string_view unit) {
  static constexpr Scale length[] = {{1, "m"}, {1e-3, "mm"}, {1e-6, "um"}, {1e-9, "nm"}};
  static constexpr Scale seconds[] = {{1, "s"}, {1e-3, "ms"}, {1e-6, "us"}, {1e-9, "ns"}};
  static constexpr Scale force[] = {{1e3, "kN"}, {1, "N"}, {1e-3, "mN"}, {1e-6, "uN"}, {1e-9, "nN"}};
  static constexpr Scale energy[] = {{1e3, "kJ"}, {1, "J"}, {1e-3, "mJ"}, {1e-6, "uJ"}, {1e-9, "nJ"}};
  static constexpr Scale pressure[] = {{1e9, "GPa"}, {1e6, "MPa"}, {1e3, "kPa"}, {1, "Pa"}};
  static constexpr Scale mass[] = {{1, "kg"}, {1e-3, "g"}, {1e-6, "mg"}};
  static constexpr Scale moment[] = {{1e3, "kN m"}, {1, "N m"}, {1e-3, "mN m"}, {1e-6, "uN m"}, {1e-9, "nN m"}};
  static constexpr Scale line_mass[] = {{1, "kg/m"}, {1e-3, "g/m"}, {1e-6, "mg/m"}};
  if (unit == "m") return length;
  if (unit == "s") return seconds;
  if (unit == "N") return force;
  if (unit == "J") return energy;
  if (unit == "Pa") return pressure;
  if (unit == "kg") return mass;
  if (unit == "N m") return moment;
  if (unit == "kg/m") return line_mass;
  return {};
}

double rounded(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3e", value);
  return std::strtod(text, nullptr);
}

/// Characters that take a column on the screen: UTF-8 continuation bytes do not.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](unsigned char c) { return (c & 0xC0) != 0x80; }));
}

std::string padded(const std::string& text, std::size_t columns, bool right = false) {
  const std::string space(columns > width(text) ? columns - width(text) : 0, ' ');
  return right ? space + text : text + space;
}

bool is_number(const std::string& text) {
  return !text.empty() && (std::isdigit(static_cast<unsigned char>(text[0])) || text[0] == '-' || text[0] == '+');
}

}  // namespace

std::string plain_number(double value) {
  if (std::isnan(value)) return "unknown";
  if (std::isinf(value)) return value > 0 ? "infinite" : "-infinite";
  if (value == 0) return "0";
  const double shown = rounded(value), size = std::abs(shown);
  char text[64];
  if (size < 1e-4 || size >= 1e6) {
    std::snprintf(text, sizeof text, "%.4g", shown);
  } else {
    const int decimals = std::max(0, 3 - static_cast<int>(std::floor(std::log10(size))));
    std::snprintf(text, sizeof text, "%.*f", decimals, shown);
    if (decimals > 0) {
      std::string trimmed = text;
      trimmed.erase(trimmed.find_last_not_of('0') + 1);
      if (trimmed.back() == '.') trimmed.pop_back();
      return trimmed;
    }
  }
  return text;
}

std::string quantity(double value, std::string_view unit) {
  if (!std::isfinite(value)) return plain_number(value);
  if (unit.empty()) return plain_number(value);
  if (unit == "rad") return plain_number(value / units::deg) + " deg";
  const std::span<const Scale> scales = scales_of(unit);
  if (scales.empty() || value == 0) return plain_number(value) + " " + std::string(unit);
  const double size = std::abs(rounded(value));  // first rounded: 0.99999 m is 1 m, not 1000 mm
  const auto reached = std::find_if(scales.begin(), scales.end(), [&](const Scale& s) { return size >= s.factor * (1 - 1e-12); });
  const Scale& scale = reached == scales.end() ? scales.back() : *reached;
  return plain_number(value / scale.factor) + " " + scale.unit;
}

Card& Card::row(std::string name, std::string value, std::string note) {
  rows_.push_back({std::move(name), std::move(value), std::move(note)});
  return *this;
}

Card& Card::row(std::string name, double value, std::string_view unit, std::string note) {
  return row(std::move(name), quantity(value, unit), std::move(note));
}

std::string Card::text() const {
  std::size_t names = 0, values = 0;
  for (const Row& row : rows_) {
    names = std::max(names, width(row.name));
    if (!row.note.empty()) values = std::max(values, width(row.value));
  }
  std::string text = title_;
  for (const Row& row : rows_) {
    text += "\n  " + padded(row.name, names) + "  ";
    text += row.note.empty() ? row.value : padded(row.value, values) + "  " + row.note;
  }
  return text;
}

std::string sparkline(const std::vector<double>& values, bool unicode, std::size_t most) {
  static constexpr const char* blocks[] = {"\u2581", "\u2582", "\u2583", "\u2584", "\u2585", "\u2586", "\u2587", "\u2588"};
  static constexpr const char* letters[] = {"_", ".", "-", "~", "=", "+", "*", "#"};
  const std::size_t count = std::min(values.size(), std::max<std::size_t>(2, most));
  std::vector<double> shown;
  for (std::size_t i = 0; i < count; ++i) shown.push_back(values[count < 2 ? i : i * (values.size() - 1) / (count - 1)]);
  double low = INFINITY, high = -INFINITY;
  for (double& value : shown) {
    value = value > 0 ? std::log10(value) : -INFINITY;
    if (!std::isfinite(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  std::string text;
  for (const double value : shown) {
    const double share = std::isfinite(value) ? (high > low ? (value - low) / (high - low) : 1) : value > 0 ? 1 : 0;
    const int level = std::clamp(static_cast<int>(share * 8), 0, 7);
    text += unicode ? blocks[level] : letters[level];
  }
  return text;
}

std::string table_text(const std::vector<std::string>& head, const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> columns;
  std::vector<bool> numeric(head.size(), true);
  for (const std::string& title : head) columns.push_back(width(title));
  for (const auto& row : rows)
    for (std::size_t c = 0; c < std::min(row.size(), head.size()); ++c) {
      columns[c] = std::max(columns[c], width(row[c]));
      if (!row[c].empty() && !is_number(row[c])) numeric[c] = false;
    }
  const auto line = [&](const std::vector<std::string>& cells) {
    std::string text;
    for (std::size_t c = 0; c < head.size(); ++c)
      text += (c ? "  " : "") + padded(c < cells.size() ? cells[c] : "", columns[c], c > 0 && numeric[c]);
    text.erase(text.find_last_not_of(' ') + 1);
    return text;
  };
  std::string text = line(head);
  for (const auto& row : rows) text += "\n" + line(row);
  return text;
}

}  // namespace tendril
