#include "contact_families.h"

#include <cmath>
#include <map>

#include "base/units.h"
#include "statics/first_guess.h"

namespace tendril::test {

using units::pi;

void SheetMesh::add(const SheetMesh& other) {
  const int base = static_cast<int>(vertices.size());
  vertices.insert(vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const auto& t : other.triangles) triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
}

SheetMesh SheetMesh::grid(int nu, int nv, const std::function<Vec3(double, double)>& place) {
  SheetMesh mesh;
  for (int i = 0; i <= nu; ++i)
    for (int j = 0; j <= nv; ++j) mesh.vertices.push_back(place(double(i) / nu, double(j) / nv));
  for (int i = 0; i < nu; ++i)
    for (int j = 0; j < nv; ++j) {
      const int a = i * (nv + 1) + j, b = a + nv + 1;
      mesh.triangles.push_back({a, b, b + 1});
      mesh.triangles.push_back({a, b + 1, a + 1});
    }
  return mesh;
}

SheetMesh SheetMesh::box(const Vec3& low, const Vec3& high, int cuts) {
  // Six grids on one lattice of welded vertices.
  SheetMesh mesh;
  std::map<std::array<int, 3>, int> index;
  const auto vertex = [&](const std::array<int, 3>& at) {
    const auto [found, added] = index.insert({at, static_cast<int>(mesh.vertices.size())});
    if (added) {
      Vec3 v;
      for (int k = 0; k < 3; ++k) v[k] = low[k] + (high[k] - low[k]) * at[k] / cuts;
      mesh.vertices.push_back(v);
    }
    return found->second;
  };
  for (int axis = 0; axis < 3; ++axis)
    for (int side : {0, cuts})
      for (int i = 0; i < cuts; ++i)
        for (int j = 0; j < cuts; ++j) {
          const auto corner = [&](int di, int dj) {
            std::array<int, 3> at{};
            at[axis] = side;
            at[(axis + 1) % 3] = i + di;
            at[(axis + 2) % 3] = j + dj;
            return vertex(at);
          };
          const int a = corner(0, 0), b = corner(1, 0), c = corner(1, 1), d = corner(0, 1);
          mesh.triangles.push_back({a, b, c});
          mesh.triangles.push_back({a, c, d});
        }
  return mesh;
}

MakeField every_triangle() {
  return [](const SheetMesh& mesh) { return std::make_shared<TriangleSheet>(mesh.vertices, mesh.triangles); };
}

namespace {

double uniform(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

/// A hose of 1 m: radius 5 ... 20 mm, E 2 ... 20 MPa.
Rod random_rod(std::mt19937_64& random) {
  const double radius = uniform(random, 0.005, 0.02);
  const double young = 2e6 * std::pow(10.0, uniform(random, 0, 1));
  return Rod::uniform(1.0, Section::round(2 * radius, 0, Material::from_poisson(young, 0.49, 1100)), 40);
}

/// A direction within `cone` (rad) of `axis`.
Vec3 near(const Vec3& axis, double cone, std::mt19937_64& random) {
  Vec3 v;
  do v = Vec3(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1));
  while (v.squaredNorm() > 1 || v.squaredNorm() < 1e-4);
  const Vec3 axis_of_turn = axis.cross(v).normalized();
  return Eigen::AngleAxisd(uniform(random, 0, cone), axis_of_turn) * axis;
}

void clamp(RodProblem& problem, double at, const Vec3& place, const Vec3& along) {
  Hold hold;
  hold.at = at;
  hold.frame = Frame::looking(place, along);
  problem.holds.push_back(hold);
}

/// A hose between two clamps at the heights za, zb, sagging along gravity.
RodProblem hanging(std::mt19937_64& random, double za, double zb, double chord) {
  RodProblem problem;
  problem.rod = random_rod(random);
  problem.gravity = {0, 0, -9.81};
  clamp(problem, 0, {-chord / 2, 0, za}, near(Vec3::UnitX(), 0.4, random));
  clamp(problem, 1, {chord / 2, uniform(random, -0.1, 0.1), zb}, near(Vec3::UnitX(), 0.4, random));
  return problem;
}

using Height = std::function<double(double, double)>;

/// Below the surface z = height(x, y) at any place of the centre line between its vertices.
std::function<bool(const Equilibrium&)> under(Height height) {
  return [height](const Equilibrium& eq) {
    for (const auto& sample : eq.sampled(0.002))
      if (sample.frame.at.z() < height(sample.frame.at.x(), sample.frame.at.y())) return true;
    return false;
  };
}

std::function<bool(const Equilibrium&)> inside(std::function<bool(const Vec3&)> solid) {
  return [solid](const Equilibrium& eq) {
    for (const auto& sample : eq.sampled(0.002))
      if (solid(sample.frame.at)) return true;
    return false;
  };
}

ContactCase finished(RodProblem problem, std::shared_ptr<ContactField> field,
                     std::function<bool(const Equilibrium&)> tunnelled) {
  problem.surroundings = field.get();
  return {std::move(problem), std::move(field), std::move(tunnelled)};
}

SheetMesh surface(int cells, double half, const Height& height) {
  return SheetMesh::grid(cells, cells, [&](double u, double v) {
    const double x = half * (2 * u - 1), y = half * (2 * v - 1);
    return Vec3(x, y, height(x, y));
  });
}

ContactCase floor_case(std::mt19937_64& random, const MakeField& make) {
  RodProblem problem = hanging(random, uniform(random, 0.06, 0.25), uniform(random, 0.06, 0.25), uniform(random, 0.6, 0.9));
  const Height flat = [](double, double) { return 0.0; };
  return finished(std::move(problem), make(surface(4, 2, flat)), under(flat));
}

/// The hose falls onto a ball that rises above the chord's sag.
ContactCase sphere_case(std::mt19937_64& random, const MakeField&) {
  RodProblem problem = hanging(random, 0, uniform(random, -0.1, 0.1), uniform(random, 0.7, 0.95));
  const double radius = uniform(random, 0.05, 0.2), top = uniform(random, -0.12, -0.03);
  const Vec3 centre(uniform(random, -0.15, 0.15), uniform(random, -0.03, 0.03), top - radius);
  return finished(std::move(problem), std::make_shared<Ball>(centre, radius),
                  inside([=](const Vec3& p) { return (p - centre).norm() < radius; }));
}

ContactCase box_edge_case(std::mt19937_64& random, const MakeField& make) {
  RodProblem problem = hanging(random, 0, uniform(random, -0.15, 0), uniform(random, 0.6, 0.9));
  const Vec3 low(uniform(random, -0.3, -0.1), -0.4, -1), high(uniform(random, 0.05, 0.2), 0.4, uniform(random, -0.1, -0.03));
  return finished(std::move(problem), make(SheetMesh::box(low, high, 3)), inside([=](const Vec3& p) {
                    return (p.array() > low.array()).all() && (p.array() < high.array()).all();
                  }));
}

ContactCase groove_case(std::mt19937_64& random, const MakeField& make) {
  RodProblem problem = hanging(random, uniform(random, 0.1, 0.25), uniform(random, 0.1, 0.25), uniform(random, 0.6, 0.9));
  const double slope = std::tan(uniform(random, 0.3, 1.0)), middle = uniform(random, -0.05, 0.05);
  const Height groove = [=](double, double y) { return slope * std::abs(y - middle) - slope * 0.05; };
  SheetMesh mesh = SheetMesh::grid(4, 4, [&](double u, double v) {
    const double y = middle + (2 * v - 1);
    return Vec3(4 * u - 2, y, groove(0, y));
  });
  return finished(std::move(problem), make(mesh), under(groove));
}

/// How often a polyline passes a sheet with a square hole in its middle: through the hole, and beside it.
struct Passages {
  int through = 0, beside = 0;
};

template <class Place>
Passages passages(const Frame& sheet, double half, double size, int count, Place place) {
  Passages passed;
  for (int k = 0; k + 1 < count; ++k) {
    const Vec3 a = sheet.rotation.conjugate() * (place(k) - sheet.at);
    const Vec3 b = sheet.rotation.conjugate() * (place(k + 1) - sheet.at);
    if ((a.z() < 0) == (b.z() < 0)) continue;
    const Vec3 at = a + a.z() / (a.z() - b.z()) * (b - a);
    const double out = std::max(std::abs(at.x()), std::abs(at.y()));
    if (out < size) ++(out <= half ? passed.through : passed.beside);
  }
  return passed;
}

/// Eight by eight cells about the middle of the sheet, of which the middle two by two are the hole.
SheetMesh sheet_with_hole(const Frame& sheet, double half, double size) {
  const auto lattice = [=](int i) {
    return i == 4 ? 0.0 : std::copysign(half + (std::abs(i - 4) - 1) * (size - half) / 3, i - 4);
  };
  SheetMesh mesh;
  for (int i = 0; i <= 8; ++i)
    for (int j = 0; j <= 8; ++j) mesh.vertices.push_back(sheet.at + sheet.rotation * Vec3(lattice(i), lattice(j), 0));
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 8; ++j) {
      if ((i == 3 || i == 4) && (j == 3 || j == 4)) continue;
      const int a = i * 9 + j, b = a + 9;
      mesh.triangles.push_back({a, b, b + 1});
      mesh.triangles.push_back({a, b + 1, a + 1});
    }
  mesh.vertices[4 * 9 + 4] = mesh.vertices[0];  // the middle of the hole belongs to no triangle
  return mesh;
}

/// A thin sheet across the first guess, with a hole around the place where the guess passes.
ContactCase hole_case(std::mt19937_64& random, const MakeField& make) {
  const double size = 0.6;
  for (;;) {
    RodProblem problem = hanging(random, 0, uniform(random, -0.2, 0.2), uniform(random, 0.7, 0.95));
    const double radius = problem.rod.largest_radius();
    const std::vector<Frame> guess = first_guess(problem, cut_into_segments(problem, 40));
    const Frame& middle = guess[static_cast<int>(uniform(random, 12, 28))];
    const double half = radius * uniform(random, 1.6, 4), play = 0.7 * (half - 1.3 * radius);
    const Vec3 aside = uniform(random, -play, play) * middle.d1() + uniform(random, -play, play) * middle.d2();
    const Frame sheet = Frame::looking(middle.at + aside, near(middle.d3(), 0.3, random));
    const int n = static_cast<int>(guess.size());
    const Passages first = passages(sheet, half - radius, size, n, [&](int k) { return guess[k].at; });
    if (first.through != 1 || first.beside != 0) continue;  // the guess itself has to pass cleanly
    return finished(std::move(problem), make(sheet_with_hole(sheet, half, size)), [=](const Equilibrium& eq) {
      const auto samples = eq.sampled(0.002);
      const Passages passed = passages(sheet, half, size, static_cast<int>(samples.size()),
                                       [&](int k) { return samples[k].frame.at; });
      return passed.beside > 0 || passed.through % 2 == 0;
    });
  }
}

/// A wall beside a hose whose clamps make it bulge that way.
ContactCase wall_case(std::mt19937_64& random, const MakeField& make) {
  RodProblem problem;
  problem.rod = random_rod(random);
  problem.gravity = {0, 0, -9.81};
  const double chord = uniform(random, 0.5, 0.8), turn = uniform(random, 0.4, 1.0);
  clamp(problem, 0, {-chord / 2, 0, 0}, near({std::cos(turn), std::sin(turn), 0}, 0.2, random));
  clamp(problem, 1, {chord / 2, 0, 0}, near({std::cos(turn), -std::sin(turn), 0}, 0.2, random));
  const double y = uniform(random, 0.04, 0.12);
  const SheetMesh mesh = SheetMesh::grid(5, 5, [&](double u, double v) { return Vec3(3 * u - 1.5, y, 3 * v - 1.5); });
  return finished(std::move(problem), make(mesh), inside([=](const Vec3& p) { return p.y() > y; }));
}

ContactCase terrain_case(std::mt19937_64& random, const MakeField& make, int cells) {
  const double a = uniform(random, 0.01, 0.04), b = uniform(random, 0.005, 0.02);
  const double k = uniform(random, 8, 20), m = uniform(random, 15, 40), shift = uniform(random, 0, 2 * pi);
  const Height hills = [=](double x, double y) {
    return a * std::sin(k * x + shift) * std::cos(0.8 * k * y) + b * std::sin(m * (0.6 * x + 0.8 * y));
  };
  RodProblem problem = hanging(random, uniform(random, 0.12, 0.25), uniform(random, 0.12, 0.25), uniform(random, 0.6, 0.9));
  const double roughness = (a * k + b * m) * 3 / cells;  // the triangles lie this far off the smooth surface at most
  return finished(std::move(problem), make(surface(cells, 1.5, hills)),
                  under([=](double x, double y) { return hills(x, y) - roughness; }));
}

/// The first guess hangs deep through the ball.
ContactCase deep_start_case(std::mt19937_64& random, const MakeField&) {
  RodProblem problem = hanging(random, 0, uniform(random, -0.1, 0.1), uniform(random, 0.7, 0.9));
  const double radius = uniform(random, 0.05, 0.12);
  const Vec3 centre(uniform(random, -0.1, 0.1), uniform(random, -0.02, 0.02), uniform(random, -0.2, -0.15));
  return finished(std::move(problem), std::make_shared<Ball>(centre, radius),
                  inside([=](const Vec3& p) { return (p - centre).norm() < radius; }));
}

/// A hose clamped at one end that lies along a flat table: its far part slides without resistance.
ContactCase sliding_case(std::mt19937_64& random, const MakeField& make) {
  RodProblem problem;
  problem.rod = random_rod(random);
  problem.gravity = {0, 0, -9.81};
  clamp(problem, 0, {-0.4, 0, uniform(random, 0.03, 0.15)}, near(Vec3::UnitX(), 0.3, random));
  const Height flat = [](double, double) { return 0.0; };
  return finished(std::move(problem), make(surface(6, 2, flat)), under(flat));
}

/// Clamps on both sides of a ridge and below its top: the hose must lean on it.
ContactCase forced_case(std::mt19937_64& random, const MakeField& make) {
  RodProblem problem;
  problem.rod = random_rod(random);
  const double down = uniform(random, 0.02, 0.08), chord = uniform(random, 0.8, 0.93);
  clamp(problem, 0, {-chord / 2, 0, -down}, near(Vec3(1, 0, 0.5).normalized(), 0.15, random));
  clamp(problem, 1, {chord / 2, 0, -down}, near(Vec3(1, 0, -0.5).normalized(), 0.15, random));
  const double half = uniform(random, 0.05, 0.15), slope = uniform(random, 0.6, 1.5);
  const double top = uniform(random, 0.0, 0.05);
  problem.gravity = {0, 0, -9.81};
  const Height ridge = [=](double x, double) { return top - slope * std::max(0.0, std::abs(x) - half); };
  const SheetMesh mesh = SheetMesh::grid(3, 3, [&](double u, double v) {
    const double xs[4] = {-half - 0.3, -half, half, half + 0.3};
    const double x = xs[static_cast<int>(std::lround(3 * u))];
    return Vec3(x, 2 * v - 1, ridge(x, 0));
  });
  return finished(std::move(problem), make(mesh), inside([=](const Vec3& p) {
                    return std::abs(p.x()) < half && p.z() < top && p.z() > top - 0.05;
                  }));
}

ContactCase free_tip_case(std::mt19937_64& random, const MakeField& make) {
  RodProblem problem;
  problem.rod = random_rod(random);
  problem.gravity = {0, 0, -9.81};
  clamp(problem, 0, {-0.5, 0, uniform(random, 0.15, 0.5)}, near(Vec3::UnitX(), 0.5, random));
  const Height flat = [](double, double) { return 0.0; };
  return finished(std::move(problem), make(surface(5, 2, flat)), under(flat));
}

/// A hose that sags into the corner of a floor and two walls.
ContactCase corner_case(std::mt19937_64& random, const MakeField& make) {
  RodProblem problem;
  problem.rod = random_rod(random);
  problem.gravity = {0, 0, -9.81};
  clamp(problem, 0, {-0.35, -0.1, uniform(random, 0.08, 0.2)}, near(Vec3(1, 0.3, 0).normalized(), 0.4, random));
  clamp(problem, 1, {-0.1, -0.4, uniform(random, 0.08, 0.2)}, near(Vec3(-0.3, -1, 0).normalized(), 0.4, random));
  // Welded lattice of the corner's three sides, the corner at the origin, inside: x < 0, y < 0, z > 0.
  SheetMesh mesh;
  std::map<std::array<int, 3>, int> index;
  const auto vertex = [&](int i, int j, int k) {
    const auto [found, added] = index.insert({{i, j, k}, static_cast<int>(mesh.vertices.size())});
    if (added) mesh.vertices.push_back(Vec3(-0.5 * i, -0.5 * j, 0.5 * k));
    return found->second;
  };
  const auto square = [&](int a, int b, int c, int d) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  };
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      square(vertex(i, j, 0), vertex(i + 1, j, 0), vertex(i + 1, j + 1, 0), vertex(i, j + 1, 0));
      square(vertex(i, 0, j), vertex(i + 1, 0, j), vertex(i + 1, 0, j + 1), vertex(i, 0, j + 1));
      square(vertex(0, i, j), vertex(0, i + 1, j), vertex(0, i + 1, j + 1), vertex(0, i, j + 1));
    }
  return finished(std::move(problem), make(mesh),
                  inside([](const Vec3& p) { return p.x() > 0 || p.y() > 0 || p.z() < 0; }));
}

/// A preformed hose, an arc in its own plane, turned about its chord at random.
ContactCase preformed_case(std::mt19937_64& random, const MakeField& make) {
  ContactCase one = box_edge_case(random, make);
  const double curvature = uniform(random, -3, 3);
  one.problem.rod.shape = [=](double s) {
    const double turn = curvature * s;
    const double across = std::abs(turn) < 1e-6 ? 0.5 * turn * s : (1 - std::cos(turn)) / curvature;
    const double along = std::abs(turn) < 1e-6 ? s : std::sin(turn) / curvature;
    return Frame{Vec3(across, 0, along), exp_rotation(Vec3(0, turn, 0))};
  };
  return one;
}

/// A floor with an upright sheet on it, welded along their common line.
ContactCase upright_sheet_case(std::mt19937_64& random, const MakeField& make) {
  const double top = uniform(random, 0.02, 0.05), at = uniform(random, -0.05, 0.05);
  RodProblem problem = hanging(random, uniform(random, 0.12, 0.25), uniform(random, 0.12, 0.25), uniform(random, 0.6, 0.8));
  SheetMesh mesh;
  for (double y : {-1.0, 1.0})
    for (const Vec3& v : {Vec3(-1, y, 0), Vec3(at, y, 0), Vec3(1, y, 0), Vec3(at, y, top)}) mesh.vertices.push_back(v);
  for (const auto& [a, b] : {std::pair{0, 1}, {1, 2}, {1, 3}}) {
    mesh.triangles.push_back({a, b, b + 4});
    mesh.triangles.push_back({a, b + 4, a + 4});
  }
  const auto under_floor = under([](double, double) { return 0.0; });
  return finished(std::move(problem), make(mesh), [=](const Equilibrium& eq) {
    const auto samples = eq.sampled(0.002);
    for (std::size_t k = 0; k + 1 < samples.size(); ++k) {
      const Vec3 &a = samples[k].frame.at, &b = samples[k + 1].frame.at;
      if ((a.x() < at) == (b.x() < at)) continue;
      if ((a + (at - a.x()) / (b.x() - a.x()) * (b - a)).z() < top) return true;
    }
    return under_floor(eq);
  });
}

SheetMesh square_sheet(const Frame& sheet, double half) {
  return SheetMesh::grid(4, 4, [&](double u, double v) {
    return Vec3(sheet.at + sheet.rotation * Vec3(half * (2 * u - 1), half * (2 * v - 1), 0));
  });
}

/// A square sheet that the first guess crosses: across the hose (`cone` about its tangent), or along it when the cone is wide.
ContactCase crossed_sheet(RodProblem problem, std::mt19937_64& random, const MakeField& make, double cone) {
  const std::vector<Frame> guess = first_guess(problem, cut_into_segments(problem, 40));
  for (;;) {
    const int n = static_cast<int>(guess.size());
    const Frame& middle = guess[static_cast<int>(uniform(random, 6, n - 6))];
    const double half = uniform(random, 0.03, 0.15), play = 0.8 * half;
    const Frame across = Frame::looking(middle.at, near(middle.d3(), cone, random));
    const Frame sheet{middle.at + uniform(random, -play, play) * across.d1() + uniform(random, -play, play) * across.d2(),
                      across.rotation};
    const auto place = [&](int k) { return guess[k].at; };
    if (passages(sheet, 0, half, n, place).beside == 0) continue;
    // What is held must be free of the sheet.
    bool clear = true;
    for (const Hold& hold : problem.holds) {
      const Vec3 p = sheet.rotation.conjugate() * (hold.frame.at - sheet.at);
      const Vec3 out = (p.cwiseAbs() - Vec3(half, half, 0)).cwiseMax(0.0);
      clear = clear && out.norm() > 3 * problem.rod.largest_radius();
    }
    if (!clear) continue;
    return finished(std::move(problem), make(square_sheet(sheet, half)), [=](const Equilibrium& eq) {
      const auto samples = eq.sampled(0.001);
      return passages(sheet, 0, half, static_cast<int>(samples.size()), [&](int k) -> const Vec3& { return samples[k].frame.at; })
                 .beside > 0;
    });
  }
}

RodProblem slack_hose(std::mt19937_64& random) {
  return hanging(random, 0, uniform(random, -0.2, 0.2), uniform(random, 0.6, 0.9));
}

ContactCase sheet_across_case(std::mt19937_64& random, const MakeField& make) {
  return crossed_sheet(slack_hose(random), random, make, 0.6);
}

ContactCase sheet_along_case(std::mt19937_64& random, const MakeField& make) {
  return crossed_sheet(slack_hose(random), random, make, pi);
}

ContactCase sheet_at_free_end_case(std::mt19937_64& random, const MakeField& make) {
  RodProblem problem = slack_hose(random);
  problem.holds.pop_back();
  return crossed_sheet(std::move(problem), random, make, pi);
}

/// Three hoses of 0.4 to 0.6 m from clamps around a free branch point.
SystemProblem three_hoses(std::mt19937_64& random, double height) {
  SystemProblem system;
  BranchPoint branch;
  const double turned = uniform(random, 0, 2 * pi);
  for (int k = 0; k < 3; ++k) {
    RodProblem problem;
    const double length = uniform(random, 0.4, 0.6), radius = uniform(random, 0.005, 0.012);
    const double young = 2e6 * std::pow(10.0, uniform(random, 0, 1));
    problem.rod = Rod::uniform(length, Section::round(2 * radius, 0, Material::from_poisson(young, 0.49, 1100)), 30);
    problem.gravity = {0, 0, -9.81};
    const double angle = turned + 2 * pi * k / 3 + uniform(random, -0.2, 0.2);
    const Vec3 out(std::cos(angle), std::sin(angle), 0);
    clamp(problem, 0, uniform(random, 0.75, 0.9) * length * out + Vec3(0, 0, height + uniform(random, -0.03, 0.03)),
          near(-out, 0.3, random));
    system.rods.push_back(std::move(problem));
    branch.sections.push_back({k, length, Frame::looking(Vec3::Zero(), -out)});
  }
  branch.frame.at = {0, 0, height};
  system.branches.push_back(std::move(branch));
  return system;
}

HarnessCase finished(SystemProblem problem, std::shared_ptr<ContactField> field,
                     std::function<bool(const Equilibrium&)> tunnelled) {
  for (RodProblem& rod : problem.rods) rod.surroundings = field.get();
  return {std::move(problem), std::move(field), std::move(tunnelled)};
}

HarnessCase harness_on_floor(std::mt19937_64& random, const MakeField& make) {
  const Height flat = [](double, double) { return 0.0; };
  return finished(three_hoses(random, uniform(random, 0.06, 0.15)), make(surface(4, 2, flat)), under(flat));
}

HarnessCase harness_on_box(std::mt19937_64& random, const MakeField& make) {
  const Vec3 low(-0.3, -0.4, -1), high(uniform(random, 0.02, 0.2), uniform(random, 0.02, 0.2), uniform(random, -0.08, -0.03));
  return finished(three_hoses(random, 0), make(SheetMesh::box(low, high, 3)), inside([=](const Vec3& p) {
                    return (p.array() > low.array()).all() && (p.array() < high.array()).all();
                  }));
}

HarnessCase harness_on_hills(std::mt19937_64& random, const MakeField& make, int cells) {
  const double a = uniform(random, 0.01, 0.03), k = uniform(random, 8, 20), shift = uniform(random, 0, 2 * pi);
  const Height hills = [=](double x, double y) { return a * std::sin(k * x + shift) * std::cos(0.8 * k * y); };
  const double roughness = a * k * 3 / cells;
  return finished(three_hoses(random, uniform(random, 0.08, 0.15)), make(surface(cells, 1.5, hills)),
                  under([=](double x, double y) { return hills(x, y) - roughness; }));
}

}  // namespace

std::vector<ContactFamily> contact_families(int terrain_cells) {
  return {{"floor", floor_case},
          {"sphere", sphere_case},
          {"box edge", box_edge_case},
          {"V-groove", groove_case},
          {"hole in a thin sheet", hole_case},
          {"wall", wall_case},
          {"terrain", [=](std::mt19937_64& random, const MakeField& make) { return terrain_case(random, make, terrain_cells); }},
          {"start deep inside", deep_start_case},
          {"neutral sliding", sliding_case},
          {"clamps force contact", forced_case},
          {"free tip", free_tip_case},
          {"corner", corner_case}};
}

std::vector<ContactFamily> further_contact_families() {
  return {{"preformed, box edge", preformed_case}, {"sheets three at a line", upright_sheet_case}};
}

std::vector<ContactFamily> crossing_families() {
  return {{"start across a sheet", sheet_across_case},
          {"start through a sheet any way", sheet_along_case},
          {"free end through a sheet", sheet_at_free_end_case}};
}

std::vector<HarnessFamily> harness_families(int terrain_cells) {
  return {{"harness on a floor", harness_on_floor},
          {"harness on a box edge", harness_on_box},
          {"harness on hills",
           [=](std::mt19937_64& random, const MakeField& make) { return harness_on_hills(random, make, terrain_cells); }}};
}

}  // namespace tendril::test
