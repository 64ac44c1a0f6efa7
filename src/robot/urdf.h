// Robots from URDF files (http://wiki.ros.org/urdf/XML).
#pragma once

#include <memory>
#include <string>

#include "robot/robot.h"

namespace tendril {

/// Reads links with their visual and collision bodies (meshes, boxes, cylinders, spheres) and joints that are fixed,
/// revolute, continuous or prismatic, with limits and mimicry. What a robot's dynamics and looks are made of (inertial,
/// transmission, material, sensors, safety_controller, efforts) is left out. A limit on velocity of 0 means that none is
/// stated. Mesh files are in metres times their `scale`, whatever unit they say themselves; they are looked for
/// at once (package_path.h) and read when first used.
///
/// Throws UsageError naming the file and, wherever there is one, the line: a file that is missing or no XML, missing
/// elements, unknown names, links given twice, carried twice or in a circle, several bases, numbers that are none or
/// not finite, limits that are missing or in the wrong order, joints of other kinds, missing mesh files.
std::shared_ptr<const Robot> load_urdf(const std::string& path);

/// The same of a text; `path` stands in messages, and its folder is where meshes are looked for.
std::shared_ptr<const Robot> parse_urdf(const std::string& text, const std::string& path);

}  // namespace tendril
