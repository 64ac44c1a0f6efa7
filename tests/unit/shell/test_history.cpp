#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "base/write_file.h"
#include "shell/history.h"

using tendril::read_file;
using tendril::shell::History;
using tendril::shell::history_path;

namespace {
struct Folder {
  Folder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "tendril_history_XXXXXX").string();
    REQUIRE(::mkdtemp(pattern.data()) != nullptr);
    path = pattern;
  }
  ~Folder() { std::filesystem::remove_all(path); }
  std::string path;
};
}  // namespace

TEST_CASE("lines are kept in order, without repeats and empty ones") {
  const Folder folder;
  const std::string file = folder.path + "/new/state/history";
  {
    History history(file);
    CHECK(history.lines().empty());
    for (const char* line : {"a", "a", "", "  ", "b", "a"}) history.add(line);
  }
  CHECK(read_file(file) == "a\nb\na\n");
  CHECK(History(file).lines() == std::vector<std::string>{"a", "b", "a"});
}

TEST_CASE("only its owner can read the history") {
  const Folder folder;
  const std::string file = folder.path + "/history";
  History(file).add("secret");
  struct stat found {};
  REQUIRE(::stat(file.c_str(), &found) == 0);
  CHECK((found.st_mode & 0777) == 0600);
}

TEST_CASE("a long history is shortened to its last lines") {
  const Folder folder;
  const std::string file = folder.path + "/history";
  std::string content;
  for (std::size_t i = 1; i <= 2 * History::most_lines; ++i) content += "line " + std::to_string(i) + "\n";
  tendril::write_file(file, content);
  const History history(file);
  CHECK(history.lines().size() == History::most_lines);
  CHECK(history.lines().back() == "line " + std::to_string(2 * History::most_lines));
  CHECK(History(file).lines() == history.lines());
  CHECK(read_file(file).substr(0, 10) == "line 5001\n");
}

TEST_CASE("without a file the lines are kept for the session") {
  History history("");
  history.add("a");
  CHECK(history.lines() == std::vector<std::string>{"a"});
}

TEST_CASE("where the history is") {
  const char* const home = std::getenv("HOME");
  const std::string kept_home = home ? home : "";
  ::setenv("XDG_STATE_HOME", "/state", 1);
  CHECK(history_path() == "/state/tendril/history");
  ::setenv("XDG_STATE_HOME", "relative", 1);  // not valid: ignored
  ::setenv("HOME", "/home/me", 1);
  CHECK(history_path() == "/home/me/.local/state/tendril/history");
  ::unsetenv("XDG_STATE_HOME");
  ::unsetenv("HOME");
  CHECK(history_path().empty());
  if (home) ::setenv("HOME", kept_home.c_str(), 1);
}
