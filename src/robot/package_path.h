// Where the meshes of a robot description lie.
#pragma once

#include <string>

namespace tendril {

/// The file that a description in `file` means by `name`:
///   package://NAME/REST   REST in the package NAME: the folder, from the description's own upwards, whose package.xml says
///                         so, else one that is called NAME (or holds a folder of that name). Packages are often copied
///                         without their upper folders: where REST is not there, its shorter ends are looked for too.
///   file://PATH           PATH
///   other                 PATH, from the description's folder on when it is relative
/// Throws UsageError naming what was looked for and where, when there is no such file.
std::string resolve_mesh_path(const std::string& name, const std::string& file);

/// The text between <name> and </name> of a package.xml; empty without one.
std::string package_name(const std::string& package_xml);

}  // namespace tendril
