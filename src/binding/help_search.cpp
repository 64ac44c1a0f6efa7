#include "binding/help_search.h"

#include <algorithm>
#include <cctype>
#include <set>

namespace tendril::lua {
namespace {

constexpr std::string_view option_mark = "option ";

/// Small letters and digits; everything else parts words.
std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words(1);
  for (const char c : text) {
    const auto letter = static_cast<unsigned char>(c);
    if (std::isalnum(letter)) words.back() += static_cast<char>(std::tolower(letter));
    else if (!words.back().empty()) words.emplace_back();
  }
  if (words.back().empty()) words.pop_back();
  return words;
}

/// Letters to change, add, leave out or exchange with their neighbour, but no more than `most`.
int distance(const std::string& a, const std::string& b, int most) {
  const int n = static_cast<int>(a.size()), m = static_cast<int>(b.size());
  if (std::abs(n - m) > most) return most + 1;
  std::vector<std::vector<int>> d(n + 1, std::vector<int>(m + 1));
  for (int i = 0; i <= n; ++i) d[i][0] = i;
  for (int j = 0; j <= m; ++j) d[0][j] = j;
  for (int i = 1; i <= n; ++i)
    for (int j = 1; j <= m; ++j) {
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  return d[n][m];
}

int slips_allowed(const std::string& word) { return word.size() >= 7 ? 2 : word.size() >= 4 ? 1 : 0; }

/// 1: the same word; less the less alike they are; 0: another word.
double likeness(const std::string& asked, const std::string& word) {
  if (asked == word) return 1;
  const bool long_enough = asked.size() >= 3;
  if (long_enough && word.starts_with(asked)) return 0.8;
  if (asked.size() >= 5 && asked.starts_with(word) && word.size() + 2 >= asked.size()) return 0.7;  // "tolerances", "tolerance"
  const int slips = distance(asked, word, slips_allowed(asked));
  if (slips <= slips_allowed(asked)) return 0.7 - 0.15 * slips;
  // With a slip in its beginning: "toler" of "tolernce" is not looked for, "tolernc" of "tolerance" is.
  if (asked.size() >= 6 && word.size() > asked.size() && distance(asked, word.substr(0, asked.size()), 1) <= 1) return 0.45;
  return long_enough && word.find(asked) != std::string::npos ? 0.4 : 0;
}

double best_likeness(const std::string& asked, const std::vector<std::string>& words) {
  double best = 0;
  for (const std::string& word : words) best = std::max(best, likeness(asked, word));
  return best;
}

class Search {
 public:
  explicit Search(const std::string& query) : asked_(words_of(query)) {}

  /// `members`: names of options or properties that belong to it, with their texts.
  void look_at(const std::string& name, const std::string& text, const std::vector<std::pair<std::string, std::string>>& members,
               double weight = 1) {
    HelpMatch match{name, text, 0};
    const std::vector<std::string> own = words_of(name), told = words_of(text);
    std::vector<std::vector<std::string>> member_names, member_texts;
    for (const auto& [member, meaning] : members) {
      member_names.push_back(words_of(member.starts_with(option_mark) ? member.substr(option_mark.size()) : member));
      member_texts.push_back(words_of(meaning));
    }
    std::size_t found = 0;
    double best_member = 0;
    for (const std::string& asked : asked_) {
      double best = std::max(10 * best_likeness(asked, own), 4 * best_likeness(asked, told));
      for (std::size_t i = 0; i < members.size(); ++i) {
        const double score = std::max(6 * best_likeness(asked, member_names[i]), 2 * best_likeness(asked, member_texts[i]));
        if (score <= best) continue;
        best = score;
        if (score > best_member) {
          best_member = score;
          match.text = members[i].first + ": " + members[i].second;
        }
      }
      found += best > 0;
      match.score += best;
    }
    if (found == 0 || 3 * found < 2 * asked_.size()) return;
    match.score *= weight / (1 + 0.02 * static_cast<double>(own.size()));  // of equals the shorter name first
    matches.push_back(std::move(match));
  }

  std::vector<HelpMatch> matches;

 private:
  std::vector<std::string> asked_;
};

}  // namespace

std::vector<HelpMatch> search_help(const Registry& registry, const std::string& query, std::size_t most) {
  constexpr double of_something = 0.92, what_is_given = 0.8;  // methods, and classes, whose objects functions give
  Search search(query);
  for (const auto& function : registry.functions) {
    std::vector<std::pair<std::string, std::string>> options;
    for (const Option& option : function->options.entries()) options.emplace_back(std::string(option_mark) + option.name, option.text);
    search.look_at(function->name, function->text, options, function->call == FunctionRecord::Call::method ? of_something : 1);
  }
  for (const auto& record : registry.classes) {
    std::vector<std::pair<std::string, std::string>> properties;
    for (const auto& [name, property] : record->properties) properties.emplace_back("." + name, property.text);
    search.look_at(record->name, record->text, properties, what_is_given);
  }
  for (const auto& module : registry.modules) {
    if (module->name.empty()) continue;
    std::vector<std::pair<std::string, std::string>> constants;
    for (const PropertyRecord& constant : module->constants) constants.emplace_back(module->name + "." + constant.name, constant.text);
    search.look_at(module->name, module->text, constants);
  }
  std::stable_sort(search.matches.begin(), search.matches.end(), [](const HelpMatch& a, const HelpMatch& b) {
    return a.score != b.score ? a.score > b.score : a.name < b.name;
  });
  std::set<std::string> names;  // a module and a class of one name stand once
  std::vector<HelpMatch> result;
  for (HelpMatch& match : search.matches)
    if (result.size() < most && names.insert(match.name).second) result.push_back(std::move(match));
  return result;
}

}  // namespace tendril::lua
