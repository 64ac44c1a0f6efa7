// A rod cut into segments: where the vertices lie and what each segment is.
#pragma once

#include <vector>

#include "statics/problem.h"

namespace tendril {

/// One segment between two vertices.
struct MeshSegment {
  double start, length;    ///< m
  Section section;
  Frame reference;         ///< end's frame seen from the start's in the unstressed shape
  Quat to_middle;          ///< section orientation at the segment's middle seen from the start's, unstressed
};

/// Vertices lie at every hold, load, spring, joined place, change of section and break of the reference shape; between those the segments are
/// as equal as the number asked for allows. Rods that slip through a hold have none at the breaks of their shape.
struct RodMesh {
  std::vector<double> s;               ///< segments + 1
  std::vector<MeshSegment> segments;
  std::vector<int> hold_vertex;        ///< per hold of the problem
  std::vector<int> load_vertex;        ///< per load
  std::vector<int> spring_vertex;      ///< per spring
  std::vector<int> joint_vertex;       ///< per joined place

  int vertices() const { return static_cast<int>(s.size()); }
};

/// Throws nothing for a problem that passed check(). `segments`: how many to aim at; at least one between two breaks.
/// `refinement`: each of those is cut again into so many equal ones. `joined`: arc lengths (m) where the rod belongs to
/// branch points.
RodMesh cut_into_segments(const RodProblem& problem, int segments, int refinement = 1, const std::vector<double>& joined = {});

}  // namespace tendril
