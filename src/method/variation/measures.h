// The measures of a study, resolved: what is read off an outcome, and what for that must be known of it.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "method/variation/options.h"
#include "method/variation/outcomes.h"
#include "method/variation/rod_reader.h"
#include "scene/scene_equilibrium.h"

namespace tendril::variation {

/// One system of an outcome, either as a batch left it or as an equilibrium of its own.
struct SystemOutcome {
  const SystemProblem* problem = nullptr;
  const SystemEquilibrium* equilibrium = nullptr;  ///< null: `reader` stands at the outcome
  RodReader* reader = nullptr;
  const BatchResults* results = nullptr;
  int row = 0;

  const Equilibrium& rod(int rod, bool stress) const { return equilibrium ? equilibrium->rods[rod] : reader->rod(rod, stress); }
};

class Measures {
 public:
  /// Throws UsageError for names that do not exist, with the nearest, and for measures that mean nothing here.
  Measures(const SceneEquilibrium& nominal, const Options& options);

  const std::vector<Column>& columns() const { return columns_; }
  int count() const { return static_cast<int>(columns_.size()); }
  bool has_functions() const;
  /// Something of this system is measured; ... that only a whole equilibrium knows.
  bool reads(int system) const;
  bool needs_equilibrium(int system) const;

  /// The measures of one system that are built in.
  void read(int system, const SystemOutcome& outcome, std::span<double> values) const;
  /// The functions, in their order.
  void call(const SceneEquilibrium& outcome, std::span<double> values) const;

 private:
  struct Entry {
    enum class Kind { built_in, clearance, contact_length, function } kind = Kind::built_in;
    SceneMeasure measure;
    int obstacle = -1;
    bool at_finish = false;
    const std::function<double(const SceneEquilibrium&)>* function = nullptr;
  };
  void add(const SceneEquilibrium& nominal, const MeasureRequest& request);
  void add_clearance(const SceneEquilibrium& nominal, const std::string& name, const std::string& rod, const std::string& to);
  void add_contact_length(const SceneEquilibrium& nominal, const std::string& name, const std::string& rod);
  double clearance(const Entry& entry, const SystemOutcome& outcome) const;

  std::vector<Column> columns_;
  std::vector<Entry> entries_;
  const SceneEquilibrium& nominal_;
};

}  // namespace tendril::variation
