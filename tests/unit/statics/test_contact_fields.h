// Surroundings for the contact tests, written without any tree so that answers can be checked by eye.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "statics/contact_field.h"

namespace tendril::test {

/// The half-space below normal . x = level, as a one-sided closed solid.
class HalfSpace : public ContactField {
 public:
  HalfSpace(const Vec3& normal, double level) : normal_(normal.normalized()), level_(level) {}
  ClosestPoint closest(const Vec3& p, double limit) const override {
    ++calls;
    const double d = normal_.dot(p) - level_;
    if (d >= limit) return {limit, p, -1};
    return {d, p - d * normal_, 0};
  }
  void terms(const Vec3& p, double range, std::vector<DistanceTerm>& out) const override {
    ++calls;
    const double d = normal_.dot(p) - level_;
    if (d < range) out.push_back({1.0, d, normal_, Mat3::Zero(), 0});
  }
  std::optional<RayHit> ray(const Vec3& a, const Vec3& b) const override {
    const double da = normal_.dot(a) - level_, db = normal_.dot(b) - level_;
    if (da < 0 || db >= 0) return std::nullopt;
    const double t = da / (da - db);
    return RayHit{t, a + t * (b - a), normal_, 0};
  }
  mutable long calls = 0;

 private:
  Vec3 normal_;
  double level_;
};

/// A solid ball.
class Ball : public ContactField {
 public:
  Ball(const Vec3& centre, double radius) : centre_(centre), radius_(radius) {}
  ClosestPoint closest(const Vec3& p, double limit) const override {
    const double d = (p - centre_).norm() - radius_;
    if (d >= limit) return {limit, p, -1};
    return {d, centre_ + radius_ * (p - centre_).normalized(), 0};
  }
  void terms(const Vec3& p, double range, std::vector<DistanceTerm>& out) const override {
    const double l = (p - centre_).norm();
    if (l - radius_ >= range || l == 0) return;
    const Vec3 n = (p - centre_) / l;
    out.push_back({1.0, l - radius_, n, (Mat3::Identity() - n * n.transpose()) / l, 0});
  }
  std::optional<RayHit> ray(const Vec3& a, const Vec3& b) const override {
    const Vec3 u = b - a, o = a - centre_;
    const double A = u.squaredNorm(), B = o.dot(u), C = o.squaredNorm() - radius_ * radius_;
    const double root = B * B - A * C;
    if (C < 0 || root < 0 || A == 0) return std::nullopt;
    const double t = (-B - std::sqrt(root)) / A;
    if (t < 0 || t > 1) return std::nullopt;
    const Vec3 p = a + t * u;
    return RayHit{t, p, (p - centre_) / radius_, 0};
  }

 private:
  Vec3 centre_;
  double radius_;
};

/// A triangle mesh with the inclusion-exclusion weights of its faces, edges and vertices; every triangle is looked at.
class TriangleSheet : public ContactField {
 public:
  using Triangle = std::array<int, 3>;
  TriangleSheet(std::vector<Vec3> vertices, std::vector<Triangle> triangles)
      : vertices_(std::move(vertices)), triangles_(std::move(triangles)), faces_at_(vertices_.size(), 0) {
    for (const Triangle& t : triangles_)
      for (int k = 0; k < 3; ++k) {
        ++faces_at_[t[k]];
        ++faces_on_[std::minmax(t[k], t[(k + 1) % 3])];
      }
    vertex_weight_.resize(vertices_.size());
    for (std::size_t v = 0; v < vertices_.size(); ++v) vertex_weight_[v] = 1 - faces_at_[v];
    for (const auto& [edge, faces] : faces_on_) {
      vertex_weight_[edge.first] += faces - 1;
      vertex_weight_[edge.second] += faces - 1;
    }
  }

  static Vec3 closest_on_segment(const Vec3& p, const Vec3& a, const Vec3& b, bool* inside = nullptr) {
    const double t = (p - a).dot(b - a) / (b - a).squaredNorm();
    if (inside) *inside = t > 0 && t < 1;
    return a + std::clamp(t, 0.0, 1.0) * (b - a);
  }

  /// Closest point of a triangle: its plane when the foot lies inside, else the nearest of its edges.
  Vec3 closest_on_triangle(const Vec3& p, const Triangle& t, bool& inside) const {
    const Vec3 &a = vertices_[t[0]], &b = vertices_[t[1]], &c = vertices_[t[2]];
    const Vec3 n = (b - a).cross(c - a).normalized();
    const Vec3 foot = p - n.dot(p - a) * n;
    // A foot on a side, but for rounding, lies within: else two faces of one plane would feign a ridge between them.
    const double rounding = -1e-12 * (b - a).cross(c - a).norm();
    inside = n.dot((b - a).cross(foot - a)) > rounding && n.dot((c - b).cross(foot - b)) > rounding &&
             n.dot((a - c).cross(foot - c)) > rounding;
    if (inside) return foot;
    Vec3 best = closest_on_segment(p, a, b);
    for (const Vec3& q : {closest_on_segment(p, b, c), closest_on_segment(p, c, a)})
      if ((q - p).squaredNorm() < (best - p).squaredNorm()) best = q;
    return best;
  }

  ClosestPoint closest(const Vec3& p, double limit) const override {
    ClosestPoint best{limit, p, -1};
    for (const Triangle& t : triangles_) {
      bool inside;
      const Vec3 q = closest_on_triangle(p, t, inside);
      if ((q - p).norm() < best.distance) best = {(q - p).norm(), q, 0};
    }
    return best;
  }

  void terms(const Vec3& p, double range, std::vector<DistanceTerm>& out) const override {
    for (const Triangle& t : triangles_) {
      bool inside;
      const Vec3 q = closest_on_triangle(p, t, inside);
      const Mat3 hessian = inside ? Mat3::Zero() : edge_or_vertex_hessian(p, q, t);
      add(1, p, q, hessian, range, out);
    }
    for (const auto& [edge, faces] : faces_on_) {
      if (faces == 1) continue;
      bool inside;
      const Vec3 &a = vertices_[edge.first], &b = vertices_[edge.second];
      const Vec3 q = closest_on_segment(p, a, b, &inside);
      add(1 - faces, p, q, inside ? edge_hessian(p, q, a, b) : vertex_hessian(p, q), range, out);
    }
    for (std::size_t v = 0; v < vertices_.size(); ++v)
      if (vertex_weight_[v] != 0) add(vertex_weight_[v], p, vertices_[v], vertex_hessian(p, vertices_[v]), range, out);
  }

  std::optional<RayHit> ray(const Vec3& a, const Vec3& b) const override {
    std::optional<RayHit> first;
    for (const Triangle& t : triangles_) {
      const Vec3 &u = vertices_[t[0]], &v = vertices_[t[1]], &w = vertices_[t[2]];
      const Vec3 n = (v - u).cross(w - u);
      const double da = n.dot(a - u), db = n.dot(b - u);
      if ((da < 0) == (db < 0) || da == db) continue;
      const double share = da / (da - db);
      const Vec3 q = a + share * (b - a);
      if (n.dot((v - u).cross(q - u)) < 0 || n.dot((w - v).cross(q - v)) < 0 || n.dot((u - w).cross(q - w)) < 0) continue;
      if (!first || share < first->share) first = RayHit{share, q, (da < 0 ? -1.0 : 1.0) * n.normalized(), 0};
    }
    return first;
  }

  const std::vector<Vec3>& vertices() const { return vertices_; }
  const std::vector<Triangle>& triangles() const { return triangles_; }

 private:
  static Mat3 vertex_hessian(const Vec3& p, const Vec3& q) {
    const double d = (p - q).norm();
    const Vec3 n = (p - q) / d;
    return (Mat3::Identity() - n * n.transpose()) / d;
  }
  static Mat3 edge_hessian(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b) {
    const double d = (p - q).norm();
    const Vec3 t = ((p - q) / d).cross((b - a).normalized());
    return t * t.transpose() / d;
  }
  Mat3 edge_or_vertex_hessian(const Vec3& p, const Vec3& q, const Triangle& t) const {
    for (int k = 0; k < 3; ++k) {
      bool inside;
      const Vec3 &a = vertices_[t[k]], &b = vertices_[t[(k + 1) % 3]];
      if ((closest_on_segment(p, a, b, &inside) - q).norm() < 1e-12 && inside) return edge_hessian(p, q, a, b);
    }
    return vertex_hessian(p, q);
  }
  static void add(double weight, const Vec3& p, const Vec3& q, const Mat3& hessian, double range,
                  std::vector<DistanceTerm>& out) {
    const double d = (p - q).norm();
    if (d < range) out.push_back({weight, d, (p - q) / d, hessian, 0});
  }

  std::vector<Vec3> vertices_;
  std::vector<Triangle> triangles_;
  std::vector<int> faces_at_;
  std::map<std::pair<int, int>, int> faces_on_;
  std::vector<double> vertex_weight_;
};

/// A grid of `nu` x `nv` squares, two triangles each, lifted by `place(u, v)` with u, v in 0 ... 1.
template <class Place>
TriangleSheet grid_sheet(int nu, int nv, Place place) {
  std::vector<Vec3> vertices;
  std::vector<TriangleSheet::Triangle> triangles;
  for (int i = 0; i <= nu; ++i)
    for (int j = 0; j <= nv; ++j) vertices.push_back(place(double(i) / nu, double(j) / nv));
  for (int i = 0; i < nu; ++i)
    for (int j = 0; j < nv; ++j) {
      const int a = i * (nv + 1) + j, b = a + nv + 1;
      triangles.push_back({a, b, b + 1});
      triangles.push_back({a, b + 1, a + 1});
    }
  return {std::move(vertices), std::move(triangles)};
}

}  // namespace tendril::test
