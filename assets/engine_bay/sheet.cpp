#include "engine_bay/sheet.h"

#include <map>
#include <string>

#include "base/error.h"

namespace tendril::engine_bay {
namespace {

constexpr double block_share = 1.25;  // half side of a hole's square block over the hole's radius

// Grid lines along one axis: the rim, the blocks of all holes with their centres, long gaps divided.
std::vector<double> grid_lines(double length, const std::vector<Hole>& holes, int axis, const Detail& detail) {
  std::vector<double> at{0, length};
  for (const Hole& h : holes)
    for (const double side : {-1.0, 0.0, 1.0}) at.push_back(h.centre[axis] + side * block_share * h.radius);
  std::sort(at.begin(), at.end());
  at.erase(std::unique(at.begin(), at.end(), [](double a, double b) { return b - a < 1e-6; }), at.end());
  std::vector<double> lines{at.front()};
  for (std::size_t i = 1; i < at.size(); ++i) {
    const int n = detail.steps(at[i] - at[i - 1]);
    for (int k = 1; k <= n; ++k) lines.push_back(at[i - 1] + (at[i] - at[i - 1]) * k / n);
  }
  return lines;
}

struct Block {
  int left, right, bottom, top;  // grid lines
  const Hole* hole;
};

int line_at(const std::vector<double>& lines, double x) {
  return static_cast<int>(std::lower_bound(lines.begin(), lines.end(), x - 1e-4) - lines.begin());
}

std::vector<Block> blocks_of(const std::vector<Hole>& holes, const std::vector<double>& u, const std::vector<double>& v) {
  std::vector<Block> blocks;
  for (const Hole& h : holes) {
    const double a = block_share * h.radius;
    if (h.centre.x() - a < 0 || h.centre.y() - a < 0 || h.centre.x() + a > u.back() || h.centre.y() + a > v.back())
      throw UsageError("sheet: the hole at " + std::to_string(h.centre.x()) + ", " + std::to_string(h.centre.y()) +
                       " is too near to the rim");
    for (const Hole& other : holes)
      if (&other < &h && (other.centre - h.centre).cwiseAbs().maxCoeff() < a + block_share * other.radius - 1e-6)
        throw UsageError("sheet: the holes at " + std::to_string(h.centre.x()) + " and " +
                         std::to_string(other.centre.x()) + " are too near to each other");
    blocks.push_back({line_at(u, h.centre.x() - a), line_at(u, h.centre.x() + a), line_at(v, h.centre.y() - a),
                      line_at(v, h.centre.y() + a), &h});
  }
  return blocks;
}

class SheetMesh {
 public:
  SheetMesh(const std::vector<double>& u, const std::vector<double>& v) : u_(u), v_(v) {}

  std::uint32_t grid_point(int i, int j) {
    const auto [it, is_new] = index_.try_emplace({i, j}, static_cast<std::uint32_t>(mesh.points.size()));
    if (is_new) mesh.points.emplace_back(u_[i], v_[j], 0);
    return it->second;
  }

  void quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  }

  // Rings from the block's square rim to the round hole.
  void around_hole(const Block& block, const Detail& detail) {
    std::vector<std::uint32_t> rim;  // anticlockwise
    for (int i = block.left; i < block.right; ++i) rim.push_back(grid_point(i, block.bottom));
    for (int j = block.bottom; j < block.top; ++j) rim.push_back(grid_point(block.right, j));
    for (int i = block.right; i > block.left; --i) rim.push_back(grid_point(i, block.top));
    for (int j = block.top; j > block.bottom; --j) rim.push_back(grid_point(block.left, j));

    const Vec3 centre(block.hole->centre.x(), block.hole->centre.y(), 0);
    const int rings = detail.steps((block_share * std::sqrt(2.0) - 1) * block.hole->radius);
    std::vector<std::uint32_t> outer = rim, inner(rim.size());
    for (int k = 1; k <= rings; ++k) {
      for (std::size_t m = 0; m < rim.size(); ++m) {
        const Vec3 from = mesh.points[rim[m]];
        const Vec3 to = centre + block.hole->radius * (from - centre).normalized();
        inner[m] = static_cast<std::uint32_t>(mesh.points.size());
        mesh.points.push_back(from + (to - from) * (double(k) / rings));
      }
      for (std::size_t m = 0; m < rim.size(); ++m) {
        const std::size_t next = (m + 1) % rim.size();
        quad(outer[m], outer[next], inner[next], inner[m]);
      }
      outer = inner;
    }
  }

  Mesh mesh;

 private:
  const std::vector<double>&u_, &v_;
  std::map<std::pair<int, int>, std::uint32_t> index_;
};

}  // namespace

Mesh sheet(double width, double height, const std::vector<Hole>& holes, const Detail& detail) {
  const std::vector<double> u = grid_lines(width, holes, 0, detail), v = grid_lines(height, holes, 1, detail);
  const std::vector<Block> blocks = blocks_of(holes, u, v);
  const int nu = static_cast<int>(u.size()) - 1, nv = static_cast<int>(v.size()) - 1;
  std::vector<char> solid(static_cast<std::size_t>(nu) * nv, 1);
  for (const Block& b : blocks)
    for (int i = b.left; i < b.right; ++i)
      for (int j = b.bottom; j < b.top; ++j) solid[static_cast<std::size_t>(i) * nv + j] = 0;

  SheetMesh out(u, v);
  for (int i = 0; i < nu; ++i)
    for (int j = 0; j < nv; ++j)
      if (solid[static_cast<std::size_t>(i) * nv + j])
        out.quad(out.grid_point(i, j), out.grid_point(i + 1, j), out.grid_point(i + 1, j + 1), out.grid_point(i, j + 1));
  for (const Block& b : blocks) out.around_hole(b, detail);
  return std::move(out.mesh);
}

Mesh sheet(double width, double height, const std::vector<Hole>& holes, const Detail& detail,
           const std::function<Vec3(double, double)>& surface) {
  return mapped(sheet(width, height, holes, detail), [&](const Vec3& p) { return surface(p.x(), p.y()); });
}

std::vector<Hole> hole_field(const Vec2& low, const Vec2& high, int columns, int rows, double radius) {
  std::vector<Hole> holes;
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j)
      holes.push_back({{low.x() + (high.x() - low.x()) * (i + 0.5) / columns, low.y() + (high.y() - low.y()) * (j + 0.5) / rows},
                       radius});
  return holes;
}

double smooth_step(double a, double b, double x) {
  const double t = std::clamp((x - a) / (b - a), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

double embossed(const Vec2& low, const Vec2& high, double flank, double u, double v) {
  return smooth_step(low.x() - flank, low.x(), u) * smooth_step(high.x() + flank, high.x(), u) *
         smooth_step(low.y() - flank, low.y(), v) * smooth_step(high.y() + flank, high.y(), v);
}

}  // namespace tendril::engine_bay
