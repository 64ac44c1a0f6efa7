// Writes the engine bay, or those of its parts whose names begin with PREFIX: make_engine_bay fine|light FILE.ply [PREFIX]
// The list of parts goes beside it: FILE.parts.
#include <cstdio>
#include <cstring>
#include <exception>

#include "base/error.h"
#include "base/write_file.h"
#include "engine_bay/bay.h"
#include "engine_bay/ply.h"

int main(int argc, char** argv) {
  using namespace tendril;
  if (argc < 3 || argc > 4 || (std::strcmp(argv[1], "fine") && std::strcmp(argv[1], "light"))) {
    std::fputs("usage: make_engine_bay fine|light FILE.ply [PREFIX]\n", stderr);
    return 2;
  }
  try {
    auto parts = engine_bay::engine_bay(std::strcmp(argv[1], "fine") == 0 ? engine_bay::fine() : engine_bay::light());
    if (argc == 4) {
      std::erase_if(parts, [&](const engine_bay::Part& part) { return !part.name.starts_with(argv[3]); });
      if (parts.empty()) throw UsageError(std::string("no part's name begins with '") + argv[3] + "'");
    }
    const std::string path = argv[2];
    write_file(path, engine_bay::ply(parts));
    write_file(path.substr(0, path.rfind('.')) + ".parts", engine_bay::part_list(parts));
  } catch (const std::exception& e) {
    std::fprintf(stderr, "make_engine_bay: %s\n", e.what());
    return 1;
  }
  return 0;
}
