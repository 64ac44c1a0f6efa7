// The parts of the bay by group. Axes: x to the car's left seen from the front, y to the rear, z up; mm.
#pragma once

#include <string>

#include "engine_bay/detail.h"
#include "engine_bay/mesh.h"

namespace tendril::engine_bay {

struct Part {
  std::string name;
  bool closed;  ///< a body without open edges; else a thin sheet
  Mesh mesh;
};

class Parts {
 public:
  void body(std::string name, Mesh mesh) { all.push_back({std::move(name), true, std::move(mesh)}); }
  void sheet(std::string name, Mesh mesh) { all.push_back({std::move(name), false, std::move(mesh)}); }

  std::vector<Part> all;
};

/// A coolant connection: the tip of a stub that a hose is pushed over.
struct Connection {
  const char* name;
  Vec3 tip;          ///< mm
  Vec3 along;        ///< out of the stub
  double radius;     ///< of the stub, mm
};

/// The connections that the parts below build their stubs at.
const std::vector<Connection>& connections();
const Connection& connection(const std::string& name);

/// A stub with its bore and bead; `length` behind the tip.
Mesh stub(const Connection& at, double length, const Detail& detail);

void add_structure(Parts& parts, const Detail& detail);     ///< firewall, fenders, towers, rails, trays
void add_engine(Parts& parts, const Detail& detail);        ///< block, head, covers
void add_transmission(Parts& parts, const Detail& detail);  ///< gearbox, shafts, mounts, starter
void add_breathing(Parts& parts, const Detail& detail);     ///< intake, air filter, exhaust
void add_belt_drive(Parts& parts, const Detail& detail);    ///< pulleys, belt, alternator, compressor
void add_cooling(Parts& parts, const Detail& detail);       ///< radiator, fans, expansion tank, stubs
void add_electrics(Parts& parts, const Detail& detail);     ///< battery, boxes, conduits
void add_fluids(Parts& parts, const Detail& detail);        ///< brakes, reservoirs, lines
void add_fasteners(Parts& parts, const Detail& detail);     ///< bolts by pattern

}  // namespace tendril::engine_bay
