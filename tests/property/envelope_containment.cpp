// What an envelope of finitely many outcomes contains of outcomes that it was not made from, and its volume by voxel:
// writes envelope_containment.md. Usage: envelope_containment [fresh outcomes] [file]
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <string>

#include "base/parallel.h"
#include "base/write_file.h"
#include "unit/method/containment_cases.h"

namespace {

using namespace tendril;
using namespace tendril::test;

constexpr std::uint64_t used_seed = 1, fresh_seed = 2;
constexpr int stations = 10;  // a segment: every 6 mm of a hose
constexpr int sizes[] = {500, 1000, 4000, 16000};

class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(RunContext::Clock::now() - begun_).count(); }

 private:
  RunContext::Clock::time_point begun_ = RunContext::Clock::now();
};

template <class... Values>
std::string text(const char* format, Values... values) {
  char line[512];
  std::snprintf(line, sizeof line, format, values...);
  return line;
}

/// How far each outcome reaches out, m, in increasing order.
std::vector<double> reaches(const Mesh& mesh, const Places& places, int outcomes) {
  const ReachTest test(mesh);
  std::vector<double> all(outcomes);
  const int workers = thread_count(0);
  run_workers(workers, [&](int worker) {
    for (int k = worker; k < outcomes; k += workers) all[k] = test.reach(places, k, stations);
  });
  std::sort(all.begin(), all.end());
  return all;
}

EnvelopeOutcomes first_of(const Places& places, int count) {
  EnvelopeOutcomes outcomes(places.rods);
  outcomes.add_frames(count, places);
  return outcomes;
}

int outside(const std::vector<double>& sorted) {
  return static_cast<int>(sorted.end() - std::upper_bound(sorted.begin(), sorted.end(), 0.0));
}

double quantile(std::vector<double>::const_iterator first, std::vector<double>::const_iterator last, double share) {
  return first == last ? 0 : first[static_cast<std::ptrdiff_t>(share * static_cast<double>(last - first - 1))];
}

std::string containment_row(const Places& used, int count, const Places& fresh) {
  EnvelopeBuilder builder;
  const Stopwatch building;
  const Envelope envelope = builder.build(first_of(used, count));
  const double built = building.seconds();
  const Stopwatch checking;
  const std::vector<double> own = reaches(envelope.mesh, used, count);
  const std::vector<double> others = reaches(envelope.mesh, fresh, fresh.outcomes());
  const int n = outside(others), total = fresh.outcomes();
  const auto begin = others.end() - n, end = others.end();
  const auto widened = [&](double share) { return 1e3 * std::max(0.0, quantile(others.begin(), end, share)); };
  std::string row = text("| %d | %.3f | %d (%.3f) | %d (%.2f %%) | %.2f | %.2f | %.2f | %.2f |", count, 1e3 * envelope.volume,
                         outside(own), 1e3 * own.back(), n, 100.0 * n / total, 1e3 * quantile(begin, end, 0.5),
                         1e3 * quantile(begin, end, 0.9), 1e3 * quantile(begin, end, 0.99), 1e3 * others.back());
  row += text(" %.2f | %.2f | %.2f | %.1f |\n", widened(0.99), widened(0.999), built, checking.seconds());
  std::fputs(row.c_str(), stdout);
  std::fflush(stdout);
  return row;
}

/// How the share outside and its extent depend on which outcomes the envelope happened to get.
std::string luck_row(int count, int draw, const Places& fresh) {
  int lost = 0;
  const std::uint64_t seed = 100 + draw;
  const Places used = solved_tee(count, seed, lost);
  const std::vector<double> others =
      reaches(EnvelopeBuilder().build(first_of(used, used.outcomes())).mesh, fresh, fresh.outcomes());
  const std::string row = text("| %d | %d | %.2f %% | %.2f |\n", static_cast<int>(seed), used.outcomes(),
                               100.0 * outside(others) / fresh.outcomes(), 1e3 * others.back());
  std::fputs(row.c_str(), stdout);
  return row;
}

std::string volume_table(const Places& used, int count) {
  const EnvelopeOutcomes outcomes = first_of(used, count);
  EnvelopeBuilder builder;
  EnvelopeOptions options;
  options.voxel = 0.5e-3;
  const double finest = builder.build(outcomes, options).volume;
  std::string table =
      text("| voxel mm | volume dm3 | above that at 0.5 mm, %.3f dm3 | margin mm | triangles | seconds |\n", 1e3 * finest) +
      "|---|---|---|---|---|---|\n";
  for (const double voxel : {8e-3, 4e-3, 2e-3, 1e-3}) {
    options.voxel = voxel;
    Envelope envelope;
    double seconds = INFINITY;
    for (int round = 0; round < 5; ++round) {
      builder.build(outcomes, options, {}, envelope);
      seconds = std::min(seconds, envelope.seconds);
    }
    table += text("| %.0f | %.3f | %.2f %% | %.3f | %zu | %.3f |\n", 1e3 * voxel, 1e3 * envelope.volume,
                  100 * (envelope.volume / finest - 1), 1e3 * envelope.margin, envelope.mesh.triangles.size(), seconds);
  }
  std::fputs(table.c_str(), stdout);
  return table;
}

std::string report(int fresh_count) {
  int lost_used = 0, lost_fresh = 0;
  const Stopwatch solving;
  const Places used = solved_tee(sizes[std::size(sizes) - 1], used_seed, lost_used);
  const Places fresh = solved_tee(fresh_count, fresh_seed, lost_fresh);
  const double solved = solving.seconds();
  std::string all = text(
      "# What an envelope contains of outcomes that it was not made from\n\n"
      "Written by `build/envelope_containment %d`. Three hoses that meet in a T, each 0.5 m long and 26 mm thick, 8 segments\n"
      "each; lengths uniform within 50 mm, connections uniform within a cone of 15 degrees: nine independent numbers. Envelopes\n"
      "of share 1 at 2 mm from the first outcomes of seed %d; %d fresh outcomes of seed %d, each solved. Outcomes that failed\n"
      "or jumped, left out of both: %d and %d. Solving them all took %.1f s.\n\n",
      fresh_count, static_cast<int>(used_seed), fresh.outcomes(), static_cast<int>(fresh_seed), lost_used, lost_fresh, solved);
  all +=
      "An outcome is outside when any point of its surface is. The surface is that of balls of the hose's radius about the\n"
      "curved centre line; they are judged by how deep their middles lie in the mesh, every 6 mm, so that no direction around\n"
      "the section is missed. An outcome reaches out by the radius less that depth: the mesh widened by as much contains it.\n\n"
      "## By the number of outcomes in the envelope\n\n"
      "Used outside: of the outcomes that the envelope is made from; in brackets the farthest that any of them reaches out, mm:\n"
      "below zero, all lie inside. Median to largest: how far the fresh ones that are outside reach out, mm. Holds 99 %, 99.9 "
      "%:\n"
      "by how many mm the envelope would have to be widened to contain that many of the fresh ones entirely. Seconds on two\n"
      "cores that other work shared.\n\n"
      "| outcomes | volume dm3 | used outside | fresh outside | median | 90 % | 99 % | largest | holds 99 % | holds 99.9 % "
      "| s to build, cold | s to check |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const int count : sizes) all += containment_row(used, std::min(count, used.outcomes()), fresh);
  all +=
      "\nOther 1000 outcomes in the envelope, against the same fresh ones:\n\n"
      "| seed | outcomes | fresh outside | largest mm |\n|---|---|---|---|\n";
  for (int draw = 0; draw < 5; ++draw) all += luck_row(1000, draw, fresh);
  all +=
      "\nA finite sample cannot contain every outcome that the tolerances allow. The outcomes being independent and alike, the\n"
      "chance that the next one is outside an envelope of n is the mean share, among n + 1, of those that the envelope of the n\n"
      "others would not contain: as long as single outcomes shape the envelope, the next one can, too. The volume still grows\n"
      "with every row. And what is said here of random outcomes is not said of the worst corner of all tolerances, which a\n"
      "random outcome next to never comes near. More outcomes, or a margin from the columns `holds`, buy coverage; neither is\n"
      "proof.\n\n"
      "## Volume by voxel\n\n"
      "Envelope of the first 1000 outcomes. Seconds: of the envelope alone, memory warm, the shortest of five. How far the\n"
      "surface is off, and how much of the volume no outcome fills: `build/bench_envelope`.\n\n";
  return all + volume_table(used, 1000);
}

}  // namespace

int main(int count, char** arguments) {
  const int fresh = count > 1 ? std::max(1, std::atoi(arguments[1])) : 10000;
  write_file(count > 2 ? arguments[2] : "tests/property/envelope_containment.md", report(fresh));
}
