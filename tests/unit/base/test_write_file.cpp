#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>
#include <unistd.h>

#include "base/error.h"
#include "base/write_file.h"

using namespace tendril;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

/// An empty folder that is gone after the test.
struct Folder {
  fs::path path = fs::temp_directory_path() / ("tendril_write_file_" + std::to_string(getpid()));
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
  std::string at(const char* name) const { return (path / name).string(); }
  int files() const {
    int count = 0;
    for ([[maybe_unused]] const auto& entry : fs::directory_iterator(path)) ++count;
    return count;
  }
};

}  // namespace

TEST_CASE("write_file: bytes come back as they went, and nothing else stays behind") {
  const Folder folder;
  const std::string bytes("a\0b\r\n\xff", 6);
  write_file(folder.at("x"), bytes);
  CHECK(read_file(folder.at("x")) == bytes);
  write_file(folder.at("x"), "");
  CHECK(read_file(folder.at("x")).empty());
  CHECK(folder.files() == 1);
}

TEST_CASE("write_file: missing folders are made") {
  const Folder folder;
  write_file(folder.at("a/b/c.txt"), "deep");
  CHECK(read_file(folder.at("a/b/c.txt")) == "deep");
}

TEST_CASE("write_file: a folder in the way is named and stays") {
  const Folder folder;
  fs::create_directories(folder.path / "taken" / "inside");
  CHECK_THROWS_AS(write_file(folder.at("taken"), "x"), UsageError);
  CHECK_THROWS_WITH(write_file(folder.at("taken"), "x"), Contains("taken"));
  CHECK(fs::is_directory(folder.path / "taken" / "inside"));
  CHECK(folder.files() == 1);
}

TEST_CASE("write_file: a file where a folder is needed is named and stays") {
  const Folder folder;
  write_file(folder.at("file"), "kept");
  CHECK_THROWS_WITH(write_file(folder.at("file/below"), "x"), Contains("file"));
  CHECK(read_file(folder.at("file")) == "kept");
}

TEST_CASE("write_file: an existing file is kept when the new one cannot be written") {
  if (geteuid() == 0 && !fs::exists("/dev/full")) return;
  const Folder folder;
  write_file(folder.at("x"), "old");
  fs::permissions(folder.path, fs::perms::owner_read | fs::perms::owner_exec);
  // Root may write anywhere: then the content changes, but it is never torn.
  try {
    write_file(folder.at("x"), "new");
  } catch (const UsageError& error) {
    CHECK_THAT(error.what(), Contains(folder.at("x")));
  }
  const std::string now = read_file(folder.at("x"));
  fs::permissions(folder.path, fs::perms::owner_all);
  CHECK((geteuid() == 0 ? now == "new" : now == "old"));
  CHECK(folder.files() == 1);
}

TEST_CASE("read_file: what is not there is named") {
  CHECK_THROWS_WITH(read_file("/nowhere/at/all"), Contains("/nowhere/at/all"));
  CHECK_THROWS_WITH(read_file("/"), Contains("/"));
  CHECK_THROWS_WITH(read_file("/dev/zero"), "cannot read '/dev/zero': it is a device, which may never end");
}
