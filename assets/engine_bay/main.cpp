// Writes the engine bay: make_engine_bay fine|light FILE.ply (and FILE.parts beside it).
#include <cstdio>
#include <cstring>
#include <exception>

#include "base/write_file.h"
#include "engine_bay/bay.h"
#include "engine_bay/ply.h"

int main(int argc, char** argv) {
  using namespace tendril;
  if (argc != 3 || (std::strcmp(argv[1], "fine") && std::strcmp(argv[1], "light"))) {
    std::fputs("usage: make_engine_bay fine|light FILE.ply\n", stderr);
    return 2;
  }
  try {
    const auto parts = engine_bay::engine_bay(std::strcmp(argv[1], "fine") == 0 ? engine_bay::fine() : engine_bay::light());
    const std::string path = argv[2];
    write_file(path, engine_bay::ply(parts));
    write_file(path.substr(0, path.rfind('.')) + ".parts", engine_bay::part_list(parts));
  } catch (const std::exception& e) {
    std::fprintf(stderr, "make_engine_bay: %s\n", e.what());
    return 1;
  }
  return 0;
}
