#include "method/variation/rows_as_bytes.h"

#include <cstdint>
#include <cstring>

#include "base/error.h"

namespace tendril::variation {
namespace {

class Writer {
 public:
  std::string bytes;
  void add(std::int64_t value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); }
  void add(std::span<const double> values) {
    bytes.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
  }
  void add(const std::string& text) {
    add(static_cast<std::int64_t>(text.size()));
    bytes += text;
  }
};

class Reader {
 public:
  explicit Reader(const std::string& bytes) : bytes_(bytes) {}
  bool at_end() const { return at_ == bytes_.size(); }
  std::int64_t number() {
    std::int64_t value;
    std::memcpy(&value, take(sizeof value), sizeof value);
    return value;
  }
  std::vector<double> numbers(std::size_t count) {
    std::vector<double> values(count);
    const char* from = take(count * sizeof(double));
    if (count > 0) std::memcpy(values.data(), from, count * sizeof(double));
    return values;
  }
  std::string text() {
    const std::int64_t size = number();
    if (size < 0) fail();
    const char* from = take(static_cast<std::size_t>(size));
    return std::string(from, static_cast<std::size_t>(size));
  }

 private:
  [[noreturn]] static void fail() {
    throw UsageError("method.variation: another process sent something else than outcomes; do all of them run the same script?");
  }
  const char* take(std::size_t size) {
    if (size > bytes_.size() - at_) fail();
    const char* here = bytes_.data() + at_;
    at_ += size;
    return here;
  }
  const std::string& bytes_;
  std::size_t at_ = 0;
};

}  // namespace

std::string bytes_of(const Outcomes& outcomes) {
  Writer out;
  out.add(std::int64_t{outcomes.first()});
  out.add(std::int64_t{outcomes.size()});
  for (int k = outcomes.first(); k < outcomes.last(); ++k) {
    out.add(static_cast<std::int64_t>(outcomes.status(k)));
    out.add(outcomes.variables_of(k));
    out.add(outcomes.measures_of(k));
    out.add(outcomes.effects_of(k));
    out.add(outcomes.message(k));
  }
  return std::move(out.bytes);
}

Outcomes rows_of(const std::string& bytes, const Study& study) {
  Reader in(bytes);
  const auto first = static_cast<int>(in.number()), size = static_cast<int>(in.number());
  Outcomes out(first, size, study.variables(), study.measures(), study.effect_numbers());
  for (int k = first; k < first + size; ++k) {
    const auto status = static_cast<OutcomeStatus>(in.number());
    const std::vector<double> variables = in.numbers(study.variables().size()), measures = in.numbers(study.measures().size()),
                              effects = in.numbers(study.effect_numbers());
    std::string message = in.text();
    if (status != OutcomeStatus::unsolved) out.set(k, status, variables, measures, effects, std::move(message));
  }
  return out;
}

void append_part(const std::string& part, std::string& whole) {
  const std::uint64_t size = part.size();
  whole.append(reinterpret_cast<const char*>(&size), sizeof size);
  whole += part;
}

std::vector<std::string> parts_of(const std::string& whole) {
  std::vector<std::string> parts;
  Reader in(whole);
  while (!in.at_end()) parts.push_back(in.text());
  return parts;
}

}  // namespace tendril::variation
