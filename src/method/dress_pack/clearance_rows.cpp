#include "method/dress_pack/clearance_rows.h"

#include <algorithm>
#include <cmath>

#include "base/number_text.h"

namespace tendril::dress_pack {
namespace {

constexpr double least_scale = 0.01;   // m: the softness of the penalty, or
constexpr double scale_share = 0.5;    // of what is wanted
constexpr double far_scales = 2.5;     // beyond it the penalty is next to nothing
constexpr double dense = 10;           // a tenth of a rod too near counts as a whole one
constexpr int apart = 4;               // points between rows on the slopes of a valley

Demand demand_for(double wanted) { return {0, std::max(least_scale, scale_share * wanted)}; }

}  // namespace

ClearanceRows::ClearanceRows(const PackStatics& statics, const PackDemands& demands, int states)
    : pack_(statics.pack()), demands_(demands), memory_(states), link_memory_(states) {
  if (!any()) return;
  bodies_ = std::make_unique<PackBodies>(pack_, Sides::of_meshes_too);
  gaps_ = std::make_unique<PackGaps>(*bodies_, statics.network(), Compared::clearance);
  if (demands_.robot_clearance >= 0) links_ = std::make_unique<RobotGaps>(*bodies_);
}

double ClearanceRows::penalty(const RodState& state, const JointVector& q, int k) {
  return any() && weight_ > 0 ? add(state, q, k, nullptr, nullptr) : 0;
}

double ClearanceRows::penalty(const RodState& state, const JointVector& q, int k, std::vector<Vec6>& by_node, JointVector& by_joint) {
  return any() && weight_ > 0 ? add(state, q, k, &by_node, &by_joint) : 0;
}

VertexShape ClearanceRows::shape_at(const RodState& state, int point) const {
  const int first = gaps_->first_node(gaps_->rod_of(point));
  return {{state.r.data() + first, state.r.size() - first}, {state.q.data() + first, state.q.size() - first}};
}

/// J^T force for a point (world axes) that is fastened to the link of a body.
void ClearanceRows::add_body_motion(int body, const Vec3& at, const Vec3& force, const JointVector& q, JointVector& by_joint) const {
  if (bodies_->fixed(body)) return;
  Jacobian of_link(6, pack_.robot->size());
  const Frame link = pack_.robot->jacobian(pack_.bodies[body].link, {q.data(), static_cast<std::size_t>(q.size())}, of_link);
  const Frame there = pack_.base * link;
  const Vec3 own = there.rotation.conjugate() * force, arm = there.rotation.conjugate() * (at - there.at);
  by_joint += of_link.topRows<3>().transpose() * own + of_link.bottomRows<3>().transpose() * arm.cross(own);
}

double ClearanceRows::add(const RodState& state, const JointVector& q, int k, std::vector<Vec6>* by_node, JointVector* by_joint) {
  double sum = 0;
  if (demands_.clearance >= 0) {
    const Demand demand = demand_for(rods_wanted());
    gaps_->place(state, q, places_);
    gaps_->visit_near(places_, rods_wanted() + far_scales * demand.scale, memory_[k], [&](int p, int b, const BodyDistance& found) {
      const ContactPoint& point = gaps_->point(p);
      const double length = pack_.rods[gaps_->rod_of(p)].rod.length, share = weight_ * dense * point.weight / length;
      const SoftExcess s = soft_excess(rods_wanted() - (found.distance - point.radius), demand);
      sum += share * 0.5 * s.value * s.value;
      if (!by_node || found.distance == 0) return;
      const Vec3 foot = places_.bodies[b].to_world(found.point);
      const Vec3 force = -share * s.value * s.slope / found.distance * (places_.points[p] - foot);
      const int node = gaps_->first_node_at(p);
      add_point_force(point, shape_at(state, p), force, (*by_node)[node], (*by_node)[node + 1]);
      add_body_motion(b, foot, -force, q, *by_joint);
    });
  }
  if (!links_) return sum;
  const Demand demand = demand_for(links_wanted());
  std::vector<LinkGap> near;
  links_->near(q, links_wanted() + far_scales * demand.scale, link_memory_[k], near);
  for (const LinkGap& gap : near) {
    const SoftExcess s = soft_excess(links_wanted() - gap.gap, demand);
    sum += weight_ * 0.5 * s.value * s.value;
    if (by_joint && gap.gap != 0)
      add_body_motion(gap.body, gap.on_link, -weight_ * s.value * s.slope / gap.gap * (gap.on_link - gap.on_other), q, *by_joint);
  }
  return sum;
}

JointVector ClearanceRows::slope_of(const PackStatics& statics, const RodState& state, const JointVector& q, int p, int body,
                                    const PackGaps::Lowest& lowest) const {
  std::vector<Vec6> by_node(statics.network().nodes(), Vec6::Zero());
  const Vec3 foot = places_.bodies[body].to_world(lowest.found.point), normal = (lowest.at - foot) / lowest.found.distance;
  const int node = gaps_->first_node(gaps_->rod_of(p)) + lowest.point.segment;
  add_point_force(lowest.point, shape_at(state, p), normal, by_node[node], by_node[node + 1]);
  Eigen::MatrixXd jacobian;
  pack_.jacobian(q, jacobian);
  JointVector slope = jacobian.transpose() * statics.pull_back(Eigen::VectorXd::Zero(6 * statics.attachments()), std::move(by_node));
  add_body_motion(body, foot, -normal, q, slope);
  return slope;
}

void ClearanceRows::near(const PackStatics& statics, const RodState& state, const JointVector& q, int k, double margin,
                         std::vector<ClearanceRow>& out) {
  out.clear();
  if (demands_.clearance >= 0) {
    struct Place {
      int point, body;
      double gap;
    };
    std::vector<Place> list;
    gaps_->place(state, q, places_);
    gaps_->visit_near(places_, rods_wanted() + margin, memory_[k], [&](int p, int b, const BodyDistance& found) {
      list.push_back({p, b, found.distance - gaps_->point(p).radius});
    });
    // In the order of bodies, then along the rods.
    for (std::size_t i = 0; i < list.size(); ++i) {
      const auto beside = [&](std::size_t j) { return j < list.size() && list[j].body == list[i].body && std::abs(list[j].point - list[i].point) == 1; };
      const bool valley = (!beside(i - 1) || list[i - 1].gap >= list[i].gap) && (!beside(i + 1) || list[i + 1].gap > list[i].gap);
      if (!valley && list[i].point % apart != 0) continue;
      PackGaps::Lowest lowest = gaps_->lowest_at(list[i].point, list[i].body, state, places_);
      if (lowest.found.distance == 0) continue;
      const int rod = gaps_->rod_of(list[i].point);
      out.push_back({lowest.gap, rods_wanted(), slope_of(statics, state, q, list[i].point, list[i].body, lowest), rod, -1, list[i].body,
                     lowest.point.s});
    }
  }
  if (!links_) return;
  std::vector<LinkGap> near;
  links_->near(q, links_wanted() + margin, link_memory_[k], near);
  for (const LinkGap& gap : near) {
    if (gap.gap == 0) continue;
    ClearanceRow row{gap.gap, links_wanted(), JointVector::Zero(q.size()), -1, pack_.bodies[gap.body].link, gap.other, 0};
    add_body_motion(gap.body, gap.on_link, (gap.on_link - gap.on_other) / gap.gap, q, row.slope);
    out.push_back(std::move(row));
  }
}

std::optional<ClearanceRow> ClearanceRows::worst(const RodState& state, const JointVector& q, int k) {
  std::optional<ClearanceRow> worst;
  const auto take = [&](ClearanceRow row) {
    if (!worst || row.wanted - row.gap > worst->wanted - worst->gap) worst = std::move(row);
  };
  if (demands_.clearance >= 0) {
    gaps_->place(state, q, places_);
    for (std::size_t rod = 0; rod < pack_.rods.size(); ++rod) {
      const double limit = rods_wanted() + pack_.rods[rod].rod.largest_radius();
      const PackGaps::Nearest near = gaps_->smallest(static_cast<int>(rod), state, places_, limit, memory_[k]);
      if (near.body >= 0) take({near.gap, rods_wanted(), {}, static_cast<int>(rod), -1, near.body, near.s});
    }
  }
  if (!links_) return worst;
  const LinkGap near = links_->smallest(q, links_wanted() + least_scale, link_memory_[k]);
  if (near.body >= 0) take({near.gap, links_wanted(), {}, -1, pack_.bodies[near.body].link, near.other, 0});
  return worst;
}

std::string ClearanceRows::text(const ClearanceRow& row) const {
  const std::string who = row.rod >= 0 ? pack_.rod_name(row.rod) : pack_.robot->links()[row.link].name;
  const double asked = row.rod >= 0 ? demands_.clearance : demands_.robot_clearance;
  const std::string body = bodies_->name(row.body);
  if (row.gap <= 0) return who + " overlaps " + body + " by " + number_text(std::round(-1e5 * row.gap) / 100) + " mm";
  return who + " comes within " + number_text(std::round(1e5 * row.gap) / 100) + " mm of " + body + ", " + number_text(1e3 * asked) +
         " mm are demanded";
}

}  // namespace tendril::dress_pack
