#include "method/dress_pack/mesh_pair.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

namespace tendril::dress_pack {

using OrientedBox = DistanceTree::OrientedBox;

namespace {

Vec3 middle_of(const Mesh& mesh, int triangle) {
  const auto& t = mesh.triangles[triangle];
  return (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3;
}

}  // namespace

BoxTree::BoxTree(const Mesh& mesh) : mesh_(mesh), order_(mesh.triangles.size()) {
  struct Range {
    int first, count;
  };
  for (std::size_t k = 0; k < order_.size(); ++k) order_[k] = static_cast<int>(k);
  std::vector<Range> ranges = {{0, static_cast<int>(order_.size())}};
  nodes_.reserve(2 * order_.size());
  nodes_.push_back({});
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const auto [first, count] = ranges[k];
    if (count == 1) {
      nodes_[k] = {flat_box(order_[first]), -1, order_[first]};
      continue;
    }
    Eigen::AlignedBox3d middles;
    for (int i = first; i < first + count; ++i) middles.extend(middle_of(mesh, order_[i]));
    int axis;
    middles.sizes().maxCoeff(&axis);
    const int half = count / 2;
    std::nth_element(order_.begin() + first, order_.begin() + first + half, order_.begin() + first + count, [&](int a, int b) {
      const double at_a = middle_of(mesh, a)[axis], at_b = middle_of(mesh, b)[axis];
      return at_a < at_b || (at_a == at_b && a < b);
    });
    nodes_[k] = {box_of(first, count), static_cast<int>(nodes_.size()), -1};
    nodes_.resize(nodes_.size() + 2);
    ranges.push_back({first, half});
    ranges.push_back({first + half, count - half});
  }
}

/// Along the mesh's axes or the principal ones of the corners, whichever is smaller.
OrientedBox BoxTree::box_of(int first, int count) const {
  Eigen::AlignedBox3d box;
  for (int i = first; i < first + count; ++i)
    for (const int v : mesh_.triangles[order_[i]]) box.extend(mesh_.vertices[v]);
  const OrientedBox plain{box.center(), Mat3::Identity(), 0.5 * box.sizes()};
  Vec3 sum = Vec3::Zero();
  Mat3 products = Mat3::Zero();
  for (int i = first; i < first + count; ++i)
    for (const int v : mesh_.triangles[order_[i]]) {
      const Vec3 p = mesh_.vertices[v] - plain.middle;
      sum += p;
      products += p * p.transpose();
    }
  Eigen::SelfAdjointEigenSolver<Mat3> principal;
  principal.computeDirect(products - sum * sum.transpose() / (3.0 * count));
  const Mat3 axes = principal.eigenvectors();
  if (!((axes.transpose() * axes - Mat3::Identity()).norm() < 1e-9)) return plain;
  Eigen::AlignedBox3d turned;
  for (int i = first; i < first + count; ++i)
    for (const int v : mesh_.triangles[order_[i]]) turned.extend(Vec3(axes.transpose() * mesh_.vertices[v]));
  if (!(turned.sizes().norm() < plain.half.norm() * 2)) return plain;
  return {axes * turned.center(), axes, 0.5 * turned.sizes()};
}

/// Along the longest side; about the axes of the mesh where a triangle has no face.
OrientedBox BoxTree::flat_box(int triangle) const {
  const auto& t = mesh_.triangles[triangle];
  Mat3 corners, axes = Mat3::Identity();
  for (int c = 0; c < 3; ++c) corners.col(c) = mesh_.vertices[t[c]];
  int longest = 0;
  const auto side = [&](int k) { return Vec3(corners.col((k + 1) % 3) - corners.col(k)); };
  for (int k = 1; k < 3; ++k)
    if (side(k).squaredNorm() > side(longest).squaredNorm()) longest = k;
  const Vec3 along = side(longest).normalized();
  Vec3 across = side((longest + 1) % 3);
  const double length = across.norm();
  for (int pass = 0; pass < 2; ++pass) across -= across.dot(along) * along;  // twice: the first leaves what it rounds
  if (across.norm() > 1e-6 * length) {
    axes.col(0) = along;
    axes.col(1) = across.normalized();
    axes.col(2) = along.cross(Vec3(axes.col(1)));
  }
  const Mat3 own = axes.transpose() * corners;
  const Vec3 low = own.rowwise().minCoeff(), high = own.rowwise().maxCoeff();
  return {axes * (0.5 * (low + high)), axes, 0.5 * (high - low)};
}

namespace {

class Search {
 public:
  Search(const BoxTree& a, const TriangleSurface& b, const RelativePose& pose, double limit)
      : a_(a), b_(b.mesh()), tree_(b.tree()), pose_(pose), best_{{limit, Vec3::Zero(), Vec3::Zero()}, {}} {}

  void run() {
    stack_.push_back({0, DistanceTree::whole, 0});
    while (!stack_.empty() && best_.nearest.distance > 0) {
      const Task task = stack_.back();
      stack_.pop_back();
      if (task.at_least < best_.nearest.distance) look(task);
    }
  }

  void compare(int triangle, int other) {
    Vec3 a[3], b[3];
    for (int k = 0; k < 3; ++k) {
      a[k] = pose_ * a_.mesh().vertices[a_.mesh().triangles[triangle][k]];
      b[k] = b_.vertices[b_.triangles[other][k]];
    }
    const double from = std::min({direction_.dot(a[0]), direction_.dot(a[1]), direction_.dot(a[2])});
    const double to = std::max({direction_.dot(b[0]), direction_.dot(b[1]), direction_.dot(b[2])});
    if (from - to >= best_.nearest.distance) return;
    const TrianglePair pair = closest_of_triangles(a, b);
    if (!(pair.distance < best_.nearest.distance)) return;
    best_ = {pair, {triangle, other}};
    if (pair.distance > 0) direction_ = (pair.on_a - pair.on_b) / pair.distance;
  }

  const MeshPair& best() const { return best_; }

 private:
  struct Task {
    int node, part;
    float at_least;
  };

  void look(const Task& task) {
    const BoxTree::Node& node = a_.nodes()[task.node];
    const OrientedBox box{pose_ * node.box.middle, pose_.turn * node.box.axes, node.box.half};
    DistanceTree::Near near[8];
    const int count = tree_.near(task.part, box, direction_, best_.nearest.distance, near);
    if (task.part < 0) {
      if (node.child >= 0 && count > 0) split(node, task.part, near[count - 1].at_least);
      else for (int i = count - 1; i >= 0; --i)
        if (near[i].at_least < best_.nearest.distance) compare(node.triangle, near[i].part);
      return;
    }
    const double size = node.box.half.norm();  // the last on the stack is the next
    for (int i = 0; i < count; ++i) {
      if (node.child >= 0 && size > near[i].size) split(node, near[i].part, near[i].at_least);
      else stack_.push_back({task.node, near[i].part, near[i].at_least});
    }
  }

  void split(const BoxTree::Node& node, int part, float at_least) {
    stack_.push_back({node.child, part, at_least});
    stack_.push_back({node.child + 1, part, at_least});
  }

  const BoxTree& a_;
  const Mesh& b_;
  const DistanceTree& tree_;
  const RelativePose pose_;
  MeshPair best_;
  Vec3 direction_ = Vec3::Zero();  ///< from b to a, between the nearest points so far
  std::vector<Task> stack_;
};

}  // namespace

MeshPair closest_of_meshes(const BoxTree& a, const TriangleSurface& b, const RelativePose& pose, double limit, TriangleNumbers likely) {
  Search search(a, b, pose, limit);
  if (likely.a >= 0 && likely.b >= 0) search.compare(likely.a, likely.b);
  search.run();
  return search.best();
}

}  // namespace tendril::dress_pack
