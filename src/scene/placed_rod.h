// A rod in the world: its design, where it is held and what pulls on it.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/attachment.h"
#include "statics/problem.h"

namespace tendril {

/// One rod of a scene. Its holds and loads are checked as they are added, so that a message can point at the line that
/// contradicts; what only the whole shows (a rod held nowhere) is checked when the scene is solved.
class PlacedRod {
 public:
  /// `from`, `to`: full holds of the start and the finish; nothing: that end is free. Throws UsageError for a design or
  /// frames that make no sense.
  PlacedRod(std::string name, Rod rod, const std::optional<Frame>& from, const std::optional<Frame>& to);

  const std::string& name() const { return name_; }
  const Rod& rod() const { return rod_; }
  const std::vector<Hold>& holds() const { return holds_; }
  const std::vector<PointLoad>& loads() const { return loads_; }

  /// Arc length (m) of "start" or "finish". Throws UsageError for another word.
  double place(std::string_view end) const;

  /// Holds the section at `hold.at`. At a place that is held already: what the two holds both fix must agree, then the
  /// new one stands (so turns, position and orientation can be changed); a position hold and an orientation hold at one
  /// place become one hold. Throws UsageError for a place outside the rod, non-finite numbers, a hold of nothing, and
  /// a hold that contradicts the one already there, or is attached to a robot.
  void hold(const Hold& hold);

  /// The hold at arc length `at`, or null.
  const Hold* hold_at(double at) const;

  /// A hold that a link carries; `frame`: where it is now, in world axes. Throws UsageError as hold() does, and for a place that is
  /// held already.
  void attach(const Attachment& attachment, const Frame& frame);
  const std::vector<Attachment>& attachments() const { return attachments_; }
  /// What is attached at arc length `at`, or null.
  const Attachment* attachment_at(double at) const;
  /// Brings what is attached to `robot` to where `link_frame` (of a link's number, in world axes) has it.
  void follow(const std::string& robot, const std::function<Frame(int link)>& link_frame);

  /// Removes the hold at arc length `at`, attached or not. Throws UsageError when there is none.
  void release(double at);

  /// Adds a dead load. Throws UsageError for a place outside the rod or non-finite numbers.
  void load(const PointLoad& load);
  void unload() { loads_.clear(); }

  /// "its start", "its finish" or "0.25 m".
  std::string describe(double at) const;

 private:
  void check_place(const char* who, double at) const;
  std::vector<Hold>::iterator find(double at);
  void check_hold(const Hold& hold) const;

  std::string name_;
  Rod rod_;
  std::vector<Hold> holds_;
  std::vector<PointLoad> loads_;
  std::vector<Attachment> attachments_;
};

}  // namespace tendril
