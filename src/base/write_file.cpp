#include "base/write_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "base/error.h"
#include "base/file_access.h"
#include "base/processes.h"

namespace tendril {
namespace {

[[noreturn]] void fail(const std::string& what, const std::string& path, const std::string& why) {
  throw UsageError(what + " '" + path + "': " + why);
}

void make_folder_of(const std::string& path) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  if (folder.empty()) return;
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) fail("cannot create the folder of", path, error.message());
}

bool write_all(int file, std::string_view content) {
  while (!content.empty()) {
    const ssize_t written = ::write(file, content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    content.remove_prefix(static_cast<std::size_t>(written));
  }
  return ::fsync(file) == 0 || errno == EINVAL;
}

}  // namespace

void write_file(const std::string& name, std::string_view content) {
  if (!is_first_process()) return;
  if (name.empty()) throw UsageError("cannot write a file without a name");
  const std::string path = writable_path(name);
  make_folder_of(path);
  if (std::filesystem::is_directory(path)) fail("cannot write", path, "it is a folder");
  std::string temporary = path + ".XXXXXX";
  const int file = ::mkstemp(temporary.data());
  if (file < 0) fail("cannot write", path, std::strerror(errno));
  ::fchmod(file, 0644);
  const bool written = write_all(file, content);
  const int why = errno;
  ::close(file);
  if (!written || ::rename(temporary.c_str(), path.c_str()) != 0) {
    const int reason = written ? errno : why;
    ::unlink(temporary.c_str());
    fail("cannot write", path, std::strerror(reason));
  }
}

std::string read_file(const std::string& name) {
  const std::string path = readable_path(name);
  std::error_code missing;
  const std::filesystem::file_status kind = std::filesystem::status(path, missing);
  if (std::filesystem::is_directory(kind)) fail("cannot read", path, "it is a folder");
  if (std::filesystem::is_character_file(kind) || std::filesystem::is_block_file(kind)) fail("cannot read", path, "it is a device, which may never end");
  std::ifstream in(path, std::ios::binary);
  if (!in) fail("cannot read", path, std::strerror(errno));
  // Room for the whole at once where the size is known; pipes and the like grow as they are read.
  std::error_code unknown;
  const auto size = std::filesystem::file_size(path, unknown);
  std::string content(unknown ? 0 : static_cast<std::size_t>(size), '\0');
  in.read(content.data(), static_cast<std::streamsize>(content.size()));
  content.resize(static_cast<std::size_t>(in.gcount()));
  if (in && in.peek() != std::ifstream::traits_type::eof())
    content.append(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
  if (in.bad()) fail("cannot read", path, std::strerror(errno));
  return content;
}

}  // namespace tendril
