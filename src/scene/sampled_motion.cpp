#include "scene/sampled_motion.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "base/error.h"
#include "base/number_text.h"
#include "base/printable.h"
#include "base/write_file.h"

namespace tendril {
namespace {

constexpr double largest_quaternion_error = 1e-2;  // of its length: more is no rotation
constexpr double largest_number = 1e9;             // of any kind: the difference of two is finite, as are its powers

std::string_view trimmed(std::string_view text) {
  const std::string_view blank = " \t\r\"";
  const std::size_t begin = text.find_first_not_of(blank);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(blank) - begin + 1);
}

std::vector<std::string_view> cells_of(std::string_view line, char separator) {
  std::vector<std::string_view> cells;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(separator, begin), line.size());
    cells.push_back(trimmed(line.substr(begin, end - begin)));
    begin = end + 1;
  }
  return cells;
}

/// Where the columns with these names stand in a row; empty when the first one is missing.
class Columns {
 public:
  Columns(const std::vector<std::string_view>& head, std::vector<std::string> names, const std::string& who) {
    for (const std::string& name : names) {
      const auto found = std::find(head.begin(), head.end(), name);
      if (found == head.end() && places_.empty()) return;
      if (found == head.end()) throw UsageError(who + ": column '" + name + "' is missing beside '" + names.front() + "'");
      places_.push_back(found - head.begin());
    }
  }
  explicit operator bool() const { return !places_.empty(); }
  double number(const std::vector<std::string_view>& row, int k, const std::string& where) const {
    const std::string_view cell = places_[k] < row.size() ? row[places_[k]] : std::string_view();
    double value = 0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (cell.empty() || error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(value))
      throw UsageError(where + ": got '" + printable(cell) + "', expected a finite number");
    if (std::abs(value) > largest_number) throw UsageError(where + ": got " + number_text(value) + ", expected at most 1e9");
    return value;
  }

 private:
  std::vector<std::size_t> places_;
};

struct Reader {
  Columns time, place, quaternion, turn;

  Reader(const std::vector<std::string_view>& head, const std::string& who)
      : time(head, {"t"}, who), place(head, {"x", "y", "z"}, who), quaternion(head, {"qw", "qx", "qy", "qz"}, who),
        turn(head, {"rx", "ry", "rz"}, who) {
    if (!time || !place) throw UsageError(who + ": the head line names no columns t, x, y, z");
    if (quaternion && turn) throw UsageError(who + ": has both a quaternion and a rotation vector; one of them says how the body turns");
  }

  Frame frame(const std::vector<std::string_view>& row, double unit, const std::string& where) const {
    Frame out;
    for (int k = 0; k < 3; ++k) out.at[k] = unit * place.number(row, k, where);
    if (turn) out.rotation = exp_rotation({turn.number(row, 0, where), turn.number(row, 1, where), turn.number(row, 2, where)});
    if (!quaternion) return out;
    const Quat q(quaternion.number(row, 0, where), quaternion.number(row, 1, where), quaternion.number(row, 2, where),
                 quaternion.number(row, 3, where));
    if (std::abs(q.norm() - 1) > largest_quaternion_error)
      throw UsageError(where + ": the quaternion has length " + number_text(q.norm()) + ", expected 1");
    out.rotation = q.normalized();
    return out;
  }
};

}  // namespace

Frame SampledMotion::at(double time) const {
  const auto after = std::upper_bound(times.begin(), times.end(), time);
  if (after == times.begin()) return frames.front();
  if (after == times.end()) return frames.back();
  const std::size_t i = after - times.begin() - 1;
  const double share = (time - times[i]) / (times[i + 1] - times[i]);
  const Vec3 turn = log_rotation(frames[i].rotation.conjugate() * frames[i + 1].rotation);
  return {(1 - share) * frames[i].at + share * frames[i + 1].at, frames[i].rotation * exp_rotation(share * turn)};
}

std::vector<Frame> SampledMotion::carried(const Frame& place) const {
  const Frame on_body = frames.front().inverse() * place;
  std::vector<Frame> out;
  for (const Frame& frame : frames) out.push_back(frame * on_body);
  return out;
}

SampledMotion parse_motion(std::string_view text, double unit, const std::string& who) {
  SampledMotion motion;
  std::optional<Reader> reader;
  char separator = ',';
  int number = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = text.substr(begin, end - begin);
    begin = end + 1;
    ++number;
    const std::string_view content = trimmed(line);
    if (content.empty() || content.front() == '#') continue;
    const std::string where = who + ", line " + std::to_string(number);
    if (!reader) {
      separator = line.find(';') != std::string_view::npos ? ';' : ',';
      reader.emplace(cells_of(line, separator), where);
      continue;
    }
    const std::vector<std::string_view> row = cells_of(line, separator);
    const double time = reader->time.number(row, 0, where);
    if (!motion.times.empty() && !(time > motion.times.back()))
      throw UsageError(where + ": time " + number_text(time) + " s does not rise above " + number_text(motion.times.back()) + " s");
    motion.times.push_back(time);
    motion.frames.push_back(reader->frame(row, unit, where));
  }
  if (motion.times.empty()) throw UsageError(who + ": holds no samples; expected a head line t, x, y, z, ... and a line for each time");
  return motion;
}

SampledMotion read_motion(const std::string& path, double unit) { return parse_motion(read_file(path), unit, "motion '" + path + "'"); }

}  // namespace tendril
