// Scenes and studies that the tests of variation share.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/units.h"
#include "method/variation/whole_study.h"

namespace tendril::testing {

inline Section hose_section() { return Section::round(0.02, 0.012, Material::from_poisson(5e6, 0.49, 1150)); }

/// One hose between two clamps at different heights, sagging.
inline Scene one_hose(int segments = 16) {
  Scene scene({0, 0, -9.81});
  scene.add(PlacedRod("hose", Rod::uniform(1.0, hose_section(), segments), Frame::looking({0, 0, 0}, {1, 0, 0}, {0, 0, 1}),
                      Frame::looking({0.8, 0.05, -0.12}, {1, 0, 0}, {0, 0, 1})));
  return scene;
}

/// Three hoses that meet at a rigid T.
inline Scene three_hoses(int segments = 8) {
  Scene scene({0, 0, -9.81});
  const Section section = Section::round(0.026, 0.018, Material::from_poisson(5e6, 0.5, 1150));
  const Frame start = Frame::looking({0, 0, 0}, {1, 0, 0}, {0, 0, 1});
  const Rod design = Rod::uniform(0.5, section, segments);
  PlacedRod& a = scene.add(PlacedRod("a", design, start, std::nullopt));
  PlacedRod& b = scene.add(PlacedRod("b", design, std::nullopt, start.moved({0.86, 0.10, 0.10})));
  PlacedRod& c = scene.add(PlacedRod("c", design, std::nullopt, Frame::looking({0.42, 0.50, -0.15}, {0, 1, 0}, {0, 0, 1})));
  scene.join("tee",
             {{&a, 0.5, Frame{{0, 0, -0.015}, Quat::Identity()}},
              {&b, 0, Frame{{0, 0, 0.015}, Quat::Identity()}},
              {&c, 0, Frame{{0, 0.015, 0}, exp_rotation({-0.5 * units::pi, 0, 0})}}},
             std::nullopt);
  return scene;
}

inline variation::Variable number(const std::string& name, double tolerance) {
  variation::Variable variable;
  variable.name = name;
  variable.tolerance = tolerance;
  return variable;
}

inline variation::Variable cone(const std::string& name, double angle) {
  variation::Variable variable;
  variable.name = name;
  variable.cone = angle;
  return variable;
}

inline variation::Variable ball(const std::string& name, double radius) {
  variation::Variable variable;
  variable.name = name;
  variable.ball = radius;
  return variable;
}

inline variation::MeasureRequest measure(const std::string& name) {
  variation::MeasureRequest request;
  request.name = name;
  return request;
}

inline variation::MeasureRequest function(const std::string& name, std::function<double(const SceneEquilibrium&)> f) {
  variation::MeasureRequest request;
  request.name = name;
  request.function = std::move(f);
  return request;
}

inline RunContext with_seed(std::uint64_t seed, int threads = 0) {
  RunContext context;
  context.seed = seed;
  context.threads = threads;
  return context;
}

/// The same bits in every number, NaN included.
inline bool identical(const variation::Outcomes& a, const variation::Outcomes& b) {
  return a.first() == b.first() && a.csv() == b.csv();
}

}  // namespace tendril::testing
