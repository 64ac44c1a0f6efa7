#include "harness/write_kbl.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <set>

#include "base/error.h"
#include "base/write_file.h"
#include "harness/settled_curves.h"
#include "harness/xml_file.h"

namespace tendril {
namespace {

using Node = XmlFile::Node;

constexpr double mm = 1e-3, tolerance = 0.01e-3;  // m

std::string decimal(double value) {
  char text[48];
  std::snprintf(text, sizeof text, "%.6f", value);
  return text;
}

/// A text with pieces of it replaced, all places counted in the text as it was.
class Edits {
 public:
  explicit Edits(const std::string& content) : content_(content) {}

  void replace(std::size_t from, std::size_t to, std::string text) { edits_[from] = {to, std::move(text)}; }

  std::string applied() const {
    std::string out;
    std::size_t at = 0;
    for (const auto& [from, edit] : edits_) {
      if (from < at) continue;  // within what is gone
      out.append(content_, at, from - at).append(edit.second);
      at = edit.first;
    }
    return out.append(content_, at);
  }

 private:
  const std::string& content_;
  std::map<std::size_t, std::pair<std::size_t, std::string>> edits_;
};

class KblWriter {
 public:
  KblWriter(const ImportedHarness& harness, const SceneEquilibrium& settled)
      : harness_(harness), settled_(settled), content_(*harness.file.content), file_(content_, harness.file.path), edits_(content_) {}
  std::string run();

 private:
  std::size_t begin_of(Node node) const;
  std::size_t end_of(Node node) const;
  void set_text(Node node, const std::string& text);
  void set_vector(Node owner, const char* name, const Vec3& value);
  void set_segment(const HarnessSegment& segment, const ImportedSegment& imported);
  void set_length(Node segment, double length);
  void set_clips(Node segment, const SolvedRod& rod);
  void move_nodes();
  void drop_points();
  std::string curves_text(const std::vector<HarnessCurve>& curves, const std::string& indent);
  void add_points();

  const ImportedHarness& harness_;
  const SceneEquilibrium& settled_;
  const std::string& content_;
  XmlFile file_;
  Edits edits_;
  std::string new_points_;
  int points_ = 0, curves_ = 0;
  std::set<std::string_view> freed_;  ///< ids of points that replaced curves used
  std::set<const void*> replaced_;    ///< those curves
};

/// Where "<Name" begins. Offsets are those of UTF-8, which files in another encoding do not have.
std::size_t KblWriter::begin_of(Node node) const {
  const std::ptrdiff_t name = node.offset_debug();
  if (name < 1 || content_.compare(name - 1, 1 + std::string_view(node.name()).size(), "<" + std::string(node.name())) != 0)
    throw UsageError("harness:save: '" + harness_.file.path + "' cannot be written back: it is not encoded in UTF-8");
  return name - 1;
}

std::size_t KblWriter::end_of(Node node) const {
  const std::string tag = "</" + std::string(node.name()) + ">";
  const std::size_t end = content_.find(tag, begin_of(node));
  return end == content_.npos ? begin_of(node) : end + tag.size();
}

void KblWriter::set_text(Node node, const std::string& text) {
  if (!node) return;
  const std::size_t from = content_.find('>', begin_of(node)) + 1;
  edits_.replace(from, content_.find('<', from), text);
}

void KblWriter::set_vector(Node owner, const char* name, const Vec3& value) {
  int k = 0;
  for (Node child : owner.children(name))
    if (k < 3) set_text(child, decimal(value[k++]));
}

void KblWriter::set_length(Node segment, double length) {
  set_text(segment.child("Virtual_length").child("Value_component"), decimal(length));
}

/// Sliding clips stand where the rod has slipped to.
void KblWriter::set_clips(Node segment, const SolvedRod& rod) {
  const double length = rod.problem.rod.length;
  for (Node assignment : segment.children("Fixing_assignment")) {
    const Node location = assignment.child("Location");
    if (!location) continue;
    const double at = file_.number(location, XmlFile::trimmed(location.text().get())) * length;
    for (std::size_t h = 0; h < rod.problem.holds.size(); ++h) {
      const Hold& hold = rod.problem.holds[h];
      const double drawn_at = hold.cut_at >= 0 ? hold.cut_at : hold.at;
      if (hold.slide && std::abs(drawn_at - at) < 1e-6 * length && h < rod.equilibrium.reactions.size())
        set_text(location, decimal(rod.equilibrium.reactions[h].s / length));
    }
  }
}

std::string KblWriter::curves_text(const std::vector<HarnessCurve>& curves, const std::string& indent) {
  std::string text;
  for (const HarnessCurve& curve : curves) {
    std::string ids;
    for (const Vec3& p : curve.points) {
      const std::string id = "Cartesian_point_settled_" + std::to_string(++points_);
      ids += (ids.empty() ? "" : " ") + id;
      new_points_ += "<Cartesian_point id=\"" + id + "\">";
      for (int c = 0; c < 3; ++c) new_points_ += "<Coordinates>" + decimal(p[c] / mm) + "</Coordinates>";
      new_points_ += "</Cartesian_point>\n\t";
    }
    text += (text.empty() ? "" : indent) + "<Center_curve id=\"Center_curve_settled_" + std::to_string(++curves_) + "\">" + indent +
            "\t<Degree>" + std::to_string(curve.degree) + "</Degree>" + indent + "\t<Control_points>" + ids + "</Control_points>" + indent +
            "</Center_curve>";
  }
  return text;
}

void KblWriter::set_segment(const HarnessSegment& segment, const ImportedSegment& imported) {
  const SolvedRod& rod = settled_.rod(imported.rod);
  const Node node = file_.by_id(segment.id);
  const std::vector<HarnessCurve> curves = settled_curves(rod.equilibrium, imported.reading, tolerance);
  double length = 0;
  for (const HarnessCurve& curve : curves)
    for (const SplineSpan& span : spans_of(curve, imported.reading)) length += span.length();
  set_length(node, length / mm);
  set_vector(node, "Start_vector", rod.equilibrium.frame_at(0).d3());
  set_vector(node, "End_vector", rod.equilibrium.frame_at(rod.equilibrium.s.back()).d3());
  set_clips(node, rod);

  // The new curves stand where the first old one was; a segment without any gets them after its end node.
  const Node first = node.child("Center_curve"), before = first ? first : node.child("End_node");
  const std::size_t line = content_.rfind('\n', begin_of(before));
  const std::string indent = line == content_.npos ? "\n" : content_.substr(line, begin_of(before) - line);
  const std::string text = curves_text(curves, indent);
  if (!first) edits_.replace(end_of(before), end_of(before), indent + text);
  for (Node old : node.children("Center_curve")) {
    for (const std::string_view id : XmlFile::words(XmlFile::text(old, "Control_points"))) freed_.insert(id);
    replaced_.insert(old.internal_object());
    if (old == first) {
      edits_.replace(begin_of(old), end_of(old), text);
    } else {
      const std::size_t from = content_.find_last_not_of(" \t\r\n", begin_of(old) - 1) + 1;
      edits_.replace(from, end_of(old), "");
    }
  }
}

/// A branch point's own place; an end that is held stays where it was.
void KblWriter::move_nodes() {
  for (const HarnessNode& node : harness_.file.nodes) {
    const auto moved = std::find_if(settled_.branches.begin(), settled_.branches.end(),
                                    [&](const SolvedBranch& b) { return b.name == node.id; });
    if (moved == settled_.branches.end()) continue;
    const Node point = file_.by_id(XmlFile::text(file_.by_id(node.id), "Cartesian_point"));
    set_vector(point, "Coordinates", moved->frame.at / mm);
    freed_.erase(point.attribute("id").value());
  }
}

/// Points that nothing but replaced curves used.
void KblWriter::drop_points() {
  for (Node node = file_.root(); node;) {
    const std::string_view name = XmlFile::local_name(node);
    const bool replaced = replaced_.count(node.internal_object()) > 0;
    if (!replaced && (name == "Control_points" || (name == "Cartesian_point" && !node.attribute("id"))))
      for (const std::string_view id : XmlFile::words(node.text().get())) freed_.erase(id);
    if (Node child = replaced ? Node() : node.first_child()) {
      node = child;
      continue;
    }
    while (node && !node.next_sibling()) node = node.parent();
    node = node.next_sibling();
  }
  for (const std::string_view id : freed_)
    if (const Node point = file_.by_id(id)) {
      const std::size_t from = content_.find_last_not_of(" \t\r\n", begin_of(point) - 1) + 1;
      edits_.replace(from, end_of(point), "");
    }
}

void KblWriter::add_points() {
  const std::size_t root_end = content_.find('>', begin_of(file_.root())) + 1;
  edits_.replace(root_end, root_end, "\n\t" + new_points_.substr(0, new_points_.find_last_not_of(" \t\n") + 1));
}

std::string KblWriter::run() {
  for (std::size_t k = 0; k < harness_.segments.size(); ++k)
    if (!harness_.segments[k].rod.empty()) set_segment(harness_.file.segments[k], harness_.segments[k]);
  move_nodes();
  drop_points();
  add_points();
  return edits_.applied();
}

}  // namespace

std::string settled_kbl(const ImportedHarness& harness, const SceneEquilibrium& settled) {
  if (!harness.file.content || !harness.file.format.starts_with("KBL"))
    throw UsageError("harness:save: '" + harness.file.path + "' is no KBL file; only those can be written back");
  return KblWriter(harness, settled).run();
}

void save_kbl(const std::string& path, const ImportedHarness& harness, const SceneEquilibrium& settled) {
  write_file(path, settled_kbl(harness, settled));
}

}  // namespace tendril
