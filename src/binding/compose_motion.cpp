#include "binding/compose_motion.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "binding/card.h"
#include "binding/compose_tubes.h"

namespace tendril {
namespace {

using Region = Eigen::AlignedBox3d;

constexpr int most_in_a_row = 3;
constexpr double pale_share = 0.10;  // opacity of the robot where it began
constexpr Rgb pale{0.80f, 0.84f, 0.88f};

std::string time_text(double t) { return "t = " + plain_number(std::round(1e3 * t) / 1e3); }

Rgb mixed(const Rgb& full, double share) {
  const float s = static_cast<float>(share);
  return {pale.r + s * (full.r - pale.r), pale.g + s * (full.g - pale.g), pale.b + s * (full.b - pale.b)};
}

/// The values of all pictures on one scale.
void share_scale(std::vector<Picture>& pictures) {
  double low = INFINITY, high = -INFINITY;
  for (const Picture& picture : pictures)
    for (const PictureTube& tube : picture.tubes)
      for (const double value : tube.values)
        if (std::isfinite(value)) low = std::min(low, value), high = std::max(high, value);
  if (!(low <= high)) return;
  for (Picture& picture : pictures) {
    ColourScale& scale = picture.scale;
    if (scale.meaning == ColourMeaning::diverging) {
      const double span = std::max(std::abs(low), std::abs(high));
      scale.low = -span;
      scale.high = span;
    } else {
      scale.low = scale.low.value_or(low);
      scale.high = scale.high.value_or(high);
    }
  }
}

void share_fit(std::vector<Picture>& pictures) {
  Region all;
  for (const Picture& picture : pictures)
    if (picture.fit) all.extend(Region(picture.fit->low, picture.fit->high));
  if (all.isEmpty()) return;
  for (Picture& picture : pictures) picture.fit = PictureBox{all.min(), all.max()};
}

void check_frames(const std::vector<MotionFrame>& frames) {
  if (frames.empty()) throw UsageError("picture of a motion: there are no states to show");
}

}  // namespace

std::vector<MotionFrame> key_frames(const SceneMotion& motion, int count) {
  if (count < 1) throw UsageError("picture of a motion: got " + std::to_string(count) + " states, expected 1 or more");
  const int all = static_cast<int>(motion.equilibria.size());
  if (all == 0) throw UsageError("picture of a motion: it has no states to show: " + motion.message);
  std::vector<MotionFrame> frames;
  const int shown = std::min(count, all);
  for (int k = 0; k < shown; ++k) {
    const int i = shown == 1 ? all - 1 : static_cast<int>(std::lround(double(k) * (all - 1) / (shown - 1)));
    frames.push_back({motion.times[i], motion.equilibria[i]});
  }
  return frames;
}

std::vector<Picture> compose_frames(const Scene& scene, const std::vector<MotionFrame>& frames, const PictureWish& wish) {
  check_frames(frames);
  std::vector<Picture> pictures;
  for (const MotionFrame& frame : frames) {
    pictures.push_back(compose_picture(scene, frame.equilibrium.get(), wish));
    PictureCard& card = pictures.back().card;
    card.rows.insert(card.rows.begin(), {"time", time_text(frame.t), false});
  }
  share_fit(pictures);
  share_scale(pictures);
  return pictures;
}

Picture compose_strip(const Scene& scene, const std::vector<MotionFrame>& frames, const PictureWish& wish) {
  PictureWish own = wish;
  std::erase(own.views, "card");
  own.views.resize(std::min<std::size_t>(own.views.size(), 1));
  if (own.views.empty()) own.views = {"iso"};
  Picture page;
  page.width = wish.width;
  page.height = wish.height;
  page.panels = compose_frames(scene, frames, own);
  page.columns = page.panels.size() <= most_in_a_row ? 0 : static_cast<int>(page.panels.size() + 1) / 2;
  for (std::size_t k = 0; k < page.panels.size(); ++k)
    page.panels[k].card.title = (k == 0 && !wish.title.empty() ? wish.title + ", " : "") + time_text(frames[k].t);
  return page;
}

Picture compose_sweep(const Scene& scene, const std::vector<MotionFrame>& frames, const PictureWish& wish) {
  check_frames(frames);
  PictureWish own = wish;
  for (std::size_t k = 0; k + 1 < frames.size(); ++k) {
    PictureWish plain;
    plain.colour = RodColour::plain;
    plain.plain = mixed(wish.plain, double(k) / (frames.size() - 1));
    for (PictureTube& tube : compose_tubes(*frames[k].equilibrium, plain)) {
      tube.name += " at " + time_text(frames[k].t);
      own.extras.tubes.push_back(std::move(tube));
    }
  }
  Picture picture = compose_picture(scene, frames.back().equilibrium.get(), own);
  Picture first = compose_picture(scene, frames.front().equilibrium.get(), PictureWish{});
  for (PictureSurface& surface : first.surfaces) {
    const auto& bodies = frames.front().equilibrium->obstacles;
    const auto body = std::find_if(bodies.begin(), bodies.end(), [&](const PlacedObstacle& o) { return o.name == surface.name; });
    if (body == bodies.end() || !body->of_robot) continue;
    surface.name += " at " + time_text(frames.front().t);
    surface.style = SurfaceStyle::veil;
    surface.share = pale_share;
    surface.edges = false;
    picture.surfaces.push_back(std::move(surface));
  }
  if (picture.fit && first.fit) {
    const Region both = Region(picture.fit->low, picture.fit->high).merged(Region(first.fit->low, first.fit->high));
    picture.fit = PictureBox{both.min(), both.max()};
  }
  return picture;
}

}  // namespace tendril
