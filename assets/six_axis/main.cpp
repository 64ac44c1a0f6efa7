// Writes the six-axis robot: make_six_axis FOLDER
#include <cstdio>
#include <exception>

#include "base/write_file.h"
#include "six_axis/arm.h"

int main(int argc, char** argv) {
  using namespace tendril;
  if (argc != 2) {
    std::fputs("usage: make_six_axis FOLDER\n", stderr);
    return 2;
  }
  try {
    const std::string folder = argv[1];
    for (const six_axis::Body& body : six_axis::bodies(six_axis::usual()))
      write_file(folder + "/meshes/" + body.link + ".stl", six_axis::stl(body.mesh));
    write_file(folder + "/package.xml", six_axis::package_xml());
    write_file(folder + "/six_axis.urdf", six_axis::urdf());
  } catch (const std::exception& e) {
    std::fprintf(stderr, "make_six_axis: %s\n", e.what());
    return 1;
  }
  return 0;
}
