// The manual page against what the program says and reads.
#include <catch2/catch.hpp>
#include <filesystem>
#include <regex>
#include <set>

#include "base/write_file.h"
#include "shell/arguments.h"

namespace fs = std::filesystem;

namespace {

/// The page without its marks: "\-\-help" is "--help".
std::string page() {
  std::string text;
  for (const char c : tendril::read_file("man/tendril.1"))
    if (c != '\\') text += c;
  return text;
}

std::set<std::string> all_matches(const std::string& text, const std::regex& pattern) {
  std::set<std::string> found;
  for (std::sregex_iterator it(text.begin(), text.end(), pattern), end; it != end; ++it) found.insert((*it)[1]);
  return found;
}

/// Every variable that the sources read, but for those by which MPI's launchers say which process this is.
std::set<std::string> variables_read() {
  std::set<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator("src"))
    if (entry.path().extension() == ".cpp") {
      const std::string source = tendril::read_file(entry.path().string());
      names.merge(all_matches(source, std::regex("getenv\\(\"([A-Z_]+)\"\\)")));
      names.merge(all_matches(source, std::regex("\"(TENDRIL_[A-Z]+)\"")));
    }
  return names;
}

}  // namespace

TEST_CASE("the manual page names every option of --help") {
  const std::string manual = page();
  const std::set<std::string> options = all_matches(tendril::shell::usage(), std::regex("(?:\n  |, )(--?[A-Za-z]*)(?= )"));
  CHECK(options.size() >= 11);
  for (const std::string& option : options) {
    INFO(option);
    CHECK(std::regex_search(manual, std::regex("\n\\.BI? " + option + "[ \n]|\n\\.BR .*" + option + "[ \n]")));
  }
}

TEST_CASE("the manual page and --help name every variable of the environment that is read") {
  const std::string manual = page(), usage = tendril::shell::usage();
  const std::set<std::string> names = variables_read();
  CHECK(names.size() >= 8);
  for (const std::string& name : names) {
    INFO(name);
    if (name.starts_with("TENDRIL_")) CHECK(usage.find(name) != std::string::npos);
    CHECK(std::regex_search(manual, std::regex("\n\\.B " + name + "\n|\n\\.BR .*" + name + "[ \n]")));
  }
}

TEST_CASE("the manual page names every exit code of --help and the version") {
  const std::string manual = page();
  for (const char* code : {"0", "1", "2", "130"}) CHECK(manual.find(std::string("\n.B ") + code + "\n") != std::string::npos);
  const auto version = all_matches(tendril::read_file("CMakeLists.txt"), std::regex("project\\(tendril VERSION ([0-9.]+)"));
  REQUIRE(version.size() == 1);
  CHECK(manual.find("\"tendril " + *version.begin() + "\"") != std::string::npos);
}
