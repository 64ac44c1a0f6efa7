// A confinement holds for the process, so each case runs in a process of its own.
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <functional>

#include "base/error.h"
#include "base/file_access.h"
#include "base/write_file.h"

namespace fs = std::filesystem;
using namespace tendril;

namespace {

struct Folders {
  Folders() {
    std::string name = (fs::temp_directory_path() / "tendril-access-XXXXXX").string();
    root = ::mkdtemp(name.data());
    for (const char* folder : {"in", "in/deep", "other", "inside"}) fs::create_directories(root / folder);
    for (const char* file : {"in/a", "in/deep/b", "other/c", "secret", "inside/d"}) write_file((root / file).string(), file);
    fs::create_symlink(root / "secret", root / "in/link");
    fs::create_symlink(root / "in/a", root / "in/inner_link");
    fs::create_symlink(root / "other", root / "in/folder_link");
    fs::create_symlink(root / "not_there", root / "in/dangling");
  }
  ~Folders() { fs::remove_all(root); }
  fs::path root;
};

/// Whether `holds` is true in a child that is confined to in/, with other/ to read.
bool holds_confined(const Folders& folders, const std::function<bool()>& holds) {
  const pid_t child = ::fork();
  if (child == 0) {
    fs::current_path(folders.root / "in");
    confine_files((folders.root / "in").string(), {(folders.root / "other").string(), (folders.root / "missing").string()});
    ::_exit(holds() ? 0 : 1);
  }
  int state = 1;
  ::waitpid(child, &state, 0);
  return WIFEXITED(state) && WEXITSTATUS(state) == 0;
}

bool refuses(const std::function<void()>& use, const std::string& name) {
  try {
    use();
    return false;
  } catch (const UsageError& error) {
    return std::string(error.what()).find("'" + name + "': outside of '") != std::string::npos;
  }
}

}  // namespace

TEST_CASE("without a confinement paths are left as they are") {
  CHECK(readable_path("../x") == "../x");
  CHECK(writable_path("/etc/x") == "/etc/x");
  CHECK(may_read("/etc/passwd"));
  CHECK_THROWS_WITH(confine_files("/no/such/folder", {}), "'/no/such/folder' is no folder to confine files to");
}

TEST_CASE("within a confinement files below the folder are read and written") {
  const Folders folders;
  CHECK(holds_confined(folders, [] { return read_file("a") == "in/a" && read_file("deep/../deep/b") == "in/deep/b"; }));
  CHECK(holds_confined(folders, [] { return read_file("inner_link") == "in/a"; }));
  CHECK(holds_confined(folders, [&] { return read_file((folders.root / "in/a").string()) == "in/a"; }));
  CHECK(holds_confined(folders, [] { return write_file("new/deep/x", "1"), read_file("new/deep/x") == "1"; }));
  CHECK(read_file((folders.root / "in/new/deep/x").string()) == "1");
}

TEST_CASE("other folders may be open for reading only") {
  const Folders folders;
  CHECK(holds_confined(folders, [] { return read_file("../other/c") == "other/c" && read_file("folder_link/c") == "other/c"; }));
  CHECK(holds_confined(folders, [] { return refuses([] { write_file("folder_link/c", "x"); }, "folder_link/c"); }));
  CHECK(read_file((folders.root / "other/c").string()) == "other/c");
}

TEST_CASE("every way out of a confinement is refused") {
  const Folders folders;
  const auto path = GENERATE(as<std::string>(), "../secret", "..", "deep/../../secret", "new/../../secret", "link", "dangling",
                             "dangling/x", "../inside/d", "/etc/passwd", "/proc/self/environ", "./../in/../secret", "deep/../link");
  INFO(path);
  CHECK(holds_confined(folders, [&] { return refuses([&] { read_file(path); }, path) && !may_read(path); }));
  CHECK(holds_confined(folders, [&] { return refuses([&] { write_file(path, "changed"); }, path); }));
  CHECK(read_file((folders.root / "secret").string()) == "secret");
  CHECK_FALSE(fs::exists(folders.root / "not_there"));
}

TEST_CASE("a name with a zero byte is refused, and a confinement cannot be taken back") {
  const Folders folders;
  CHECK(holds_confined(folders, [] { return !may_read(std::string("a\0/../../secret", 15)); }));
  CHECK(holds_confined(folders, [] {
    try {
      confine_files("/", {});
      return false;
    } catch (const UsageError& error) {
      return std::string(error.what()).ends_with("/in' already");
    }
  }));
}
