// Builds the tree from the top: a range of triangles is split in two where the surface area heuristic finds it best
// (sixteen bins along each axis), its larger parts again, until there are eight children.

#include <algorithm>
#include <array>
#include <optional>

#include "geometry/distance_tree.h"

namespace tendril {

namespace {

constexpr int leaf_size = 8, bins = 16;
// Below this depth ranges are halved, so that no arrangement of triangles makes the tree deep.
constexpr int balanced_depth = 24;
// Nodes of no more triangles than this have axes of their own.
constexpr int turned_size = 600;
constexpr float far = std::numeric_limits<float>::infinity();

struct Box {
  float low[4] = {far, far, far, 0}, high[4] = {-far, -far, -far, 0};
  void extend(const Box& o) {
    for (int k = 0; k < 4; ++k) {
      low[k] = std::min(low[k], o.low[k]);
      high[k] = std::max(high[k], o.high[k]);
    }
  }
  float area() const {
    const float x = high[0] - low[0], y = high[1] - low[1], z = high[2] - low[2];
    return x < 0 ? 0 : x * y + y * z + z * x;
  }
};

// The fourth place of `low` holds the triangle's number as bits.
struct Item {
  float low[3];
  int triangle;
  float high[4];
  float twice_middle(int k) const { return low[k] + high[k]; }
  void extend(Box& box) const {
    for (int k = 0; k < 3; ++k) {
      box.low[k] = std::min(box.low[k], low[k]);
      box.high[k] = std::max(box.high[k], high[k]);
    }
  }
};

struct Range {
  int begin, end;
  Box box, middles;  ///< middles: of twice the boxes' middles
  int count() const { return end - begin; }
};

}  // namespace

class TreeBuilder {
 public:
  explicit TreeBuilder(DistanceTree& tree) : tree_(tree), mesh_(tree.mesh_) {}

  void build() {
    const Eigen::AlignedBox3d box = mesh_.box();
    tree_.middle_ = box.center();
    tree_.scale_ = 0.5 * box.sizes().maxCoeff();
    items_.resize(mesh_.triangles.size());
    for (std::size_t t = 0; t < items_.size(); ++t) {
      Item& item = items_[t];
      item = {{far, far, far}, static_cast<int>(t), {-far, -far, -far, 0}};
      for (int v : mesh_.triangles[t])
        for (int k = 0; k < 3; ++k) {
          const float x = static_cast<float>(mesh_.vertices[v][k] - tree_.middle_[k]);
          item.low[k] = std::min(item.low[k], x);
          item.high[k] = std::max(item.high[k], x);
        }
    }
    tree_.nodes_.reserve(items_.size() / 24 + 1);
    tree_.leaves_.reserve(items_.size() / 4 + 1);
    node(measured(0, static_cast<int>(items_.size())), 0);
  }

 private:
  Range measured(int begin, int end) const {
    Range range{begin, end, {}, {}};
    for (int i = begin; i < end; ++i) {
      items_[i].extend(range.box);
      for (int k = 0; k < 3; ++k) {
        range.middles.low[k] = std::min(range.middles.low[k], items_[i].twice_middle(k));
        range.middles.high[k] = std::max(range.middles.high[k], items_[i].twice_middle(k));
      }
    }
    return range;
  }

  int node(const Range& whole, int depth) {
    std::array<Range, 8> parts;
    parts[0] = whole;
    int count = 1;
    while (count < 8) {
      int widest = -1;
      for (int i = 0; i < count; ++i)
        if (parts[i].count() > leaf_size && (widest < 0 || parts[i].box.area() > parts[widest].box.area())) widest = i;
      if (widest < 0) break;
      parts[count] = split(parts[widest], depth);
      ++count;
    }
    const int index = static_cast<int>(tree_.nodes_.size());
    tree_.nodes_.emplace_back();
    set_boxes(tree_.nodes_[index], whole, parts, count);
    for (int i = 0; i < count; ++i) {
      const int child = parts[i].count() > leaf_size ? node(parts[i], depth + 1) : leaf(parts[i]);
      tree_.nodes_[index].child[i] = child;
    }
    return index;
  }

  // Sets the axes and the children's boxes; an empty place is infinitely far away.
  void set_boxes(DistanceTree::Node& node, const Range& whole, const std::array<Range, 8>& parts, int count) const {
    const std::optional<Mat3> axes = whole.count() <= turned_size ? flat_axes(whole) : std::nullopt;
    for (int k = 0; k < 3; ++k)
      for (int j = 0; j < 4; ++j) node.axes[k][j] = j == 3 ? 0 : axes ? static_cast<float>((*axes)(k, j)) : k == j;
    for (int i = 0; i < 8; ++i) {
      const Box box = i >= count ? Box{} : axes ? turned_box(parts[i], *axes) : parts[i].box;
      for (int k = 0; k < 3; ++k) {
        node.low[k][i] = box.low[k];
        node.high[k][i] = box.high[k];
      }
      node.child[i] = 0;
    }
  }

  Vec3 area_vector(int item) const {
    const auto& t = mesh_.triangles[items_[item].triangle];
    const Vec3& corner = mesh_.vertices[t[0]];
    return (mesh_.vertices[t[1]] - corner).cross(mesh_.vertices[t[2]] - corner);
  }

  // Axes (as rows) of which the last is the mean normal of the triangles, either side counting as the outside; nothing
  // where they face all ways.
  std::optional<Mat3> flat_axes(const Range& range) const {
    Vec3 sum = Vec3::Zero();
    double whole = 0;
    for (int i = range.begin; i < range.end; ++i) {
      const Vec3 area = area_vector(i);
      sum += area.dot(sum) < 0 ? Vec3(-area) : area;
      whole += area.norm();
    }
    if (!(sum.norm() > 0.7 * whole)) return std::nullopt;
    Mat3 axes;
    const Vec3 normal = sum.normalized();
    int least;
    normal.cwiseAbs().minCoeff(&least);
    axes.row(2) = normal;
    axes.row(0) = normal.cross(Vec3::Unit(least)).normalized();
    axes.row(1) = normal.cross(Vec3(axes.row(0)));
    return axes;
  }

  Box turned_box(const Range& range, const Mat3& axes) const {
    Vec3 low = Vec3::Constant(far), high = -low;
    for (int i = range.begin; i < range.end; ++i)
      for (int v : mesh_.triangles[items_[i].triangle]) {
        const Vec3 at = axes * (mesh_.vertices[v] - tree_.middle_);
        low = low.cwiseMin(at);
        high = high.cwiseMax(at);
      }
    Box box;
    for (int k = 0; k < 3; ++k) {
      box.low[k] = static_cast<float>(low[k]);
      box.high[k] = static_cast<float>(high[k]);
    }
    return box;
  }

  int leaf(const Range& range) {
    const int index = static_cast<int>(tree_.leaves_.size());
    DistanceTree::Leaf& leaf = tree_.leaves_.emplace_back();
    for (int i = 0; i < 8; ++i) {
      const bool there = i < range.count();
      const int triangle = items_[range.begin + (there ? i : 0)].triangle;
      const auto& t = mesh_.triangles[triangle];
      leaf.triangle[i] = there ? triangle : -1;
      const Vec3& corner = mesh_.vertices[t[0]];
      const Vec3 side = mesh_.vertices[t[1]] - corner, other = mesh_.vertices[t[2]] - corner;
      const Vec3 across = side.cross(other);
      const double longest = std::max(side.squaredNorm(), other.squaredNorm()), size = across.norm();
      const double scale = size > 1e-12 * longest ? 1 / size : 0;
      for (int k = 0; k < 3; ++k) {
        leaf.corner[k][i] = static_cast<float>(corner[k] - tree_.middle_[k]);
        leaf.side[k][i] = static_cast<float>(side[k]);
        leaf.other[k][i] = static_cast<float>(other[k]);
        leaf.normal[k][i] = static_cast<float>(across[k] * scale);
      }
    }
    return ~index;
  }

  // Splits `range` in two: it keeps the first part, the second is returned.
  Range split(Range& range, int depth) {
    int best_axis = -1, best_bin = 0;
    if (depth < balanced_depth) best_plane(range, best_axis, best_bin);
    int middle = range.begin;
    if (best_axis >= 0) {
      const float low = range.middles.low[best_axis], per = bins_per_length(range, best_axis);
      const auto first = items_.begin();
      middle = static_cast<int>(std::partition(first + range.begin, first + range.end,
                                               [&](const Item& item) {
                                                 return bin_of(item.twice_middle(best_axis), low, per) <= best_bin;
                                               }) -
                                first);
    }
    if (middle == range.begin || middle == range.end) middle = halve(range);
    const Range second = measured(middle, range.end);
    range = measured(range.begin, middle);
    return second;
  }

  int halve(const Range& range) {
    int axis = 0;
    for (int k = 1; k < 3; ++k)
      if (range.middles.high[k] - range.middles.low[k] > range.middles.high[axis] - range.middles.low[axis]) axis = k;
    const int middle = range.begin + range.count() / 2;
    std::nth_element(items_.begin() + range.begin, items_.begin() + middle, items_.begin() + range.end,
                     [&](const Item& a, const Item& b) { return a.twice_middle(axis) < b.twice_middle(axis); });
    return middle;
  }

  static float bins_per_length(const Range& range, int axis) {
    const float length = range.middles.high[axis] - range.middles.low[axis];
    return length > 1e-30f ? bins * 0.9999f / length : 0;
  }
  static int bin_of(float middle, float low, float per) {
    return std::clamp(static_cast<int>((middle - low) * per), 0, bins - 1);
  }

  // Leaves axis at -1 where all middles coincide.
  void best_plane(const Range& range, int& best_axis, int& best_bin) const {
    std::array<std::array<Box, bins>, 3> boxes;
    std::array<std::array<int, bins>, 3> counts{};
    const float per[3] = {bins_per_length(range, 0), bins_per_length(range, 1), bins_per_length(range, 2)};
    for (int i = range.begin; i < range.end; ++i)
      for (int k = 0; k < 3; ++k) {
        const int bin = bin_of(items_[i].twice_middle(k), range.middles.low[k], per[k]);
        items_[i].extend(boxes[k][bin]);
        ++counts[k][bin];
      }
    float best_cost = far;
    for (int k = 0; k < 3; ++k) {
      if (per[k] == 0) continue;
      std::array<float, bins> above{};
      Box box;
      int count = 0;
      for (int bin = bins - 1; bin > 0; --bin) {
        box.extend(boxes[k][bin]);
        count += counts[k][bin];
        above[bin] = box.area() * static_cast<float>(leaves_for(count));
      }
      box = Box{};
      count = 0;
      for (int bin = 0; bin + 1 < bins; ++bin) {
        box.extend(boxes[k][bin]);
        count += counts[k][bin];
        const float cost = box.area() * static_cast<float>(leaves_for(count)) + above[bin + 1];
        if (count > 0 && count < range.count() && cost < best_cost) {
          best_cost = cost;
          best_axis = k;
          best_bin = bin;
        }
      }
    }
  }

  // The price of a range: leaves are read as a whole.
  static int leaves_for(int count) { return (count + leaf_size - 1) / leaf_size; }

  DistanceTree& tree_;
  const Mesh& mesh_;
  std::vector<Item> items_;
};

DistanceTree::DistanceTree(const Mesh& mesh) : mesh_(mesh) { TreeBuilder(*this).build(); }

}  // namespace tendril
