#include "harness/import_harness.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>
#include <numbers>

#include "base/error.h"
#include "base/installation.h"
#include "base/nearest_name.h"
#include "base/number_text.h"
#include "base/write_file.h"
#include "harness/harness_bundle.h"
#include "harness/line_frames.h"
#include "scene/formed_rod.h"

namespace tendril {
namespace {

constexpr int fewest_elements = 4, most_elements = 400;
constexpr double at_an_end = 1e-6;            // m
constexpr double shortest_element = 0.5e-3;   // m
constexpr double most_turn = 0.35;            // rad an element

class HarnessImport {
 public:
  HarnessImport(HarnessFile file, const HarnessImportOptions& options, Scene& scene, const RunContext& context)
      : options_(options), scene_(scene), context_(context) {
    found_.file = std::move(file);
  }
  ImportedHarness run();

 private:
  void check_options() const;
  void add_segments();
  void add_segment(const HarnessSegment& segment, ImportedSegment& made);
  Rod rod_of(const HarnessSegment& segment, const CentreLine& line, const Bundle& bundle, ImportedSegment& made);
  std::vector<double> vertices(const HarnessSegment& segment, const CentreLine& line) const;
  void add_clips(const HarnessSegment& segment, const LineFrames& frames, PlacedRod& rod, ImportedSegment& made);
  void add_nodes();
  void note(const std::string& text, const std::string& where);
  void tell_notes();

  struct End {
    PlacedRod* rod;
    bool finish;
    Frame frame;
  };

  HarnessImportOptions options_;
  Scene& scene_;
  const RunContext& context_;
  ImportedHarness found_;
  std::vector<std::vector<End>> ends_;                     ///< by node
  std::map<std::string, std::vector<std::string>> noted_;  ///< what was assumed, and where
};

void HarnessImport::check_options() const {
  if (!(options_.element >= 1e-4 && options_.element <= 10))
    throw UsageError("scene.import: 'element' is " + number_text(options_.element) + ", expected 0.0001 to 10 m");
}

void HarnessImport::note(const std::string& text, const std::string& where) { noted_[text].push_back(where); }

/// "text (Segment_1, Segment_2 and 5 more)".
void HarnessImport::tell_notes() {
  constexpr std::size_t named = 6;
  for (const auto& [text, places] : noted_) {
    std::string where;
    for (std::size_t k = 0; k < std::min(named, places.size()); ++k) where += (k ? ", " : "") + places[k];
    if (places.size() > named) where += " and " + std::to_string(places.size() - named) + " more";
    found_.notes.push_back(text + " (" + where + ")");
  }
  found_.notes.insert(found_.notes.end(), found_.file.skipped.begin(), found_.file.skipped.end());
}

void HarnessImport::add_segments() {
  ends_.resize(found_.file.nodes.size());
  found_.segments.resize(found_.file.segments.size());
  for (std::size_t k = 0; k < found_.segments.size(); ++k) {
    if (context_.stop()) throw UsageError("scene.import: " + found_.file.path + ": interrupted after " + std::to_string(k) + " segments");
    add_segment(found_.file.segments[k], found_.segments[k]);
    if (!found_.segments[k].left_out.empty()) note("left out: " + found_.segments[k].left_out, found_.file.segments[k].id);
  }
}

void HarnessImport::add_segment(const HarnessSegment& segment, ImportedSegment& made) {
  const CentreLine line(found_.file, segment);
  made.length = line.length();
  made.stated_length = segment.virtual_length;
  made.cut_off = line.cut_off;
  made.reading = line.reading();
  made.stated_outer = 2 * std::sqrt(segment.area / std::numbers::pi);
  made.drawn_bend_radius = line.min_bend_radius();
  made.left_out = line.complaint();
  if (!made.left_out.empty()) return;
  if (made.cut_off > 0) note("the drawn curve goes on beyond the nodes; taken is the part between them, which has the stated length", segment.id);

  const SegmentBundle wires = segment_bundle(found_.file, segment, options_.slip);
  if (!wires.note.empty()) note(wires.note, segment.id);
  if (!wires.known) {
    made.left_out = "neither wires nor a cross-section are stated";
    return;
  }
  if (wires.bundle.outer >= made.length) {
    made.left_out = "it is shorter than its bundle is thick";
    return;
  }
  const LineFrames frames(line);
  Rod rod = rod_of(segment, line, wires.bundle, made);
  if (options_.shape == HarnessShape::drawn) {
    FrameShape drawn{vertices(segment, line), {}};
    for (const double s : drawn.s) drawn.frames.push_back(frames.at(s));
    form(rod, drawn);
    rod.segments = static_cast<int>(drawn.s.size()) - 1;
  }
  made.rod = segment.id;
  PlacedRod& placed = scene_.add(PlacedRod(segment.id, std::move(rod), {}, {}));
  ends_[segment.start].push_back({&placed, false, frames.start()});
  ends_[segment.finish].push_back({&placed, true, frames.finish()});
  add_clips(segment, frames, placed, made);
}

Rod HarnessImport::rod_of(const HarnessSegment& segment, const CentreLine& line, const Bundle& bundle, ImportedSegment& made) {
  made.outer = bundle.outer;
  made.EI = bundle.section.EI1;
  made.EI_slipping = bundle.EI_slipping;
  made.EI_glued = bundle.EI_glued;
  made.min_bend_radius = std::max({bundle.min_bend_radius, found_.file.nodes[segment.start].min_bend_radius,
                                   found_.file.nodes[segment.finish].min_bend_radius});
  made.mass = bundle.section.mass * line.length();
  const int elements = std::clamp(static_cast<int>(std::ceil(line.length() / options_.element)), fewest_elements, most_elements);
  return Rod::uniform(line.length(), bundle.section, elements);
}

/// Vertices close enough that no element turns by more than `most_turn` or is longer than asked for.
std::vector<double> HarnessImport::vertices(const HarnessSegment& segment, const CentreLine& line) const {
  constexpr int fine = 64;  // places of each of the line's pieces
  std::vector<double> s = {0};
  double turned = 0;
  const std::vector<CentreLine::Place> places = line.places(fine);
  const double longest = std::min(options_.element, line.length() / fewest_elements);
  for (std::size_t k = 1; k + 1 < places.size(); ++k) {
    turned += (places[k].tangent - places[k - 1].tangent).norm();
    const double ahead = (places[k + 1].tangent - places[k].tangent).norm();
    const bool far = places[k + 1].s - s.back() > longest, bent = turned + ahead > most_turn;
    if (!(far || bent) || places[k].s - s.back() < shortest_element || line.length() - places[k].s < shortest_element) continue;
    s.push_back(places[k].s);
    turned = 0;
  }
  s.push_back(line.length());
  for (const HarnessFixing& fixing : segment.fixings)  // a vertex nearby gives way to that of the clip
    if (const double at = fixing.location * line.length(); at > at_an_end && at < line.length() - at_an_end) {
      std::erase_if(s, [&](double other) { return other > 0 && other < line.length() && std::abs(other - at) < shortest_element; });
      s.insert(std::lower_bound(s.begin(), s.end(), at), at);
    }
  return s;
}

void HarnessImport::add_clips(const HarnessSegment& segment, const LineFrames& frames, PlacedRod& rod, ImportedSegment& made) {
  if (options_.clips == HarnessClip::none) return;
  for (const HarnessFixing& fixing : segment.fixings) {
    Hold hold;
    hold.at = fixing.location * made.length;
    if (hold.at < at_an_end || hold.at > made.length - at_an_end) {
      note("a fixing at the very end of a segment is left out", segment.id);
      continue;
    }
    hold.frame = frames.at(hold.at);
    hold.orientation = options_.clips != HarnessClip::swivel;
    hold.slide = options_.clips == HarnessClip::slide;
    if (rod.hold_at(hold.at)) continue;  // two fixings at one place
    rod.hold(hold);
    ++made.clips;
    ++found_.clips;
  }
}

/// One segment ends there: held as it is drawn. Several: a branch point, free.
void HarnessImport::add_nodes() {
  for (std::size_t k = 0; k < ends_.size(); ++k) {
    const HarnessNode& node = found_.file.nodes[k];
    std::vector<BranchPlace> places;
    for (const End& end : ends_[k]) {
      const double at = end.finish ? end.rod->rod().length : 0;
      if (ends_[k].size() == 1) {
        Hold hold;
        hold.at = at;
        hold.frame = end.frame;
        end.rod->hold(hold);
        ++found_.held_ends;
        if (node.components.empty()) note("an end without a connector is held where it is drawn", node.id);
      } else {
        places.push_back({end.rod, at, Frame{node.at, Quat::Identity()}.inverse() * end.frame});
      }
    }
    if (places.empty()) continue;
    scene_.join(node.id, places, std::nullopt).frame = {node.at, Quat::Identity()};
    ++found_.branches;
  }
}

ImportedHarness HarnessImport::run() {
  check_options();
  add_segments();
  if (ends_.empty() || std::all_of(ends_.begin(), ends_.end(), [](const auto& ends) { return ends.empty(); }))
    throw UsageError("scene.import: " + found_.file.path + ": no segment can be taken; the first: " + found_.segments.front().left_out);
  add_nodes();
  tell_notes();
  return std::move(found_);
}

struct Reader {
  std::string_view suffix;
  HarnessFile (*parse)(std::string_view content, const std::string& path);
};
constexpr std::array readers = {Reader{".kbl", parse_kbl}, Reader{".vec", parse_vec}};

/// "builtin:t_harness" comes with the program.
std::string harness_path(const std::string& name) {
  constexpr std::string_view builtin = "builtin:";
  if (!name.starts_with(builtin)) return name;
  const std::vector<std::string> known = {"t_harness"};
  const std::string wanted = name.substr(builtin.size());
  if (std::find(known.begin(), known.end(), wanted) == known.end())
    throw UsageError("scene.import: there is no builtin harness " + unknown_name(wanted, "builtin harnesses", known));
  const std::string file = wanted + ".kbl", folder = part_folder(Part::assets);
  if (folder.empty())
    throw UsageError("scene.import: the file of '" + name + "' is missing (looked for " + part_places(Part::assets, file) + ")");
  return folder + "/" + file;
}

}  // namespace

std::vector<double> ImportedHarness::wire_lengths() const {
  std::vector<double> lengths;
  for (const HarnessWire& wire : file.wires) {
    double sum = 0;
    for (const int k : wire.segments) sum += segments[k].rod.empty() ? 0 : segments[k].length;
    lengths.push_back(sum);
  }
  return lengths;
}

ImportedHarness import_harness(HarnessFile file, const HarnessImportOptions& options, Scene& scene, const RunContext& context) {
  return HarnessImport(std::move(file), options, scene, context).run();
}

HarnessFile read_harness(const std::string& name) {
  const std::string path = harness_path(name);
  const std::size_t dot = path.find_last_of("./");
  std::string suffix = dot == path.npos || path[dot] == '/' ? "" : path.substr(dot);
  std::transform(suffix.begin(), suffix.end(), suffix.begin(), [](unsigned char c) { return std::tolower(c); });
  const auto reader = std::find_if(readers.begin(), readers.end(), [&](const Reader& r) { return suffix == r.suffix; });
  if (reader == readers.end()) {
    if (suffix == ".hmd")
      throw UsageError("scene.import: '" + name + "': what .hmd files hold is not published; export the harness as .kbl or .vec");
    std::string known;
    for (const Reader& r : readers) known += (known.empty() ? "" : ", ") + std::string(r.suffix);
    throw UsageError("scene.import: '" + name + "': " + (suffix.empty() ? "a name without a suffix" : "'" + suffix + "'") +
                     " is no harness file; expected " + known);
  }
  auto content = std::make_shared<const std::string>(read_file(path));
  HarnessFile file = reader->parse(*content, name);
  file.content = std::move(content);
  return file;
}

}  // namespace tendril
