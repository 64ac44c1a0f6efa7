// Contact of all rods of a network with the surroundings: one ContactTerms a rod, together one further term of Newton's method.
#pragma once

#include <memory>

#include "statics/contact_terms.h"
#include "statics/rod_network.h"

namespace tendril {

class ContactNetwork final : public FurtherTerms {
 public:
  /// Rods without surroundings take no part. The network must outlive this.
  ContactNetwork(const RodNetwork& network, Element element, ClearanceRule clearance = ClearanceRule::judge);

  double assemble(const RodState& state, Stress stress, BlockSystem& system) override;
  double energy(const RodState& state) override;
  double allowed(const RodState& state, const std::vector<Vec6>& step, double share) override;
  bool stiffen(const RodState& state, const std::vector<Vec6>& step, double share) override;
  void stepped(const RodState& before, const std::vector<Vec6>& step, double share) override;

  /// A rod that takes part.
  struct Rod {
    int index;         ///< in the network
    double radius;     ///< m, the smallest along it
    double reference;  ///< force per length that the law's stiffness is made for, N/m
    std::unique_ptr<ContactTerms> terms;
  };
  const std::vector<Rod>& rods() const { return rods_; }
  /// Null for a rod that takes no part.
  ContactTerms* of_rod(int index);

  /// The law whose overlap is `softness` radii under the reference force, for every rod.
  void set_softness(double softness);

  /// Called for every rod: see contact_terms.h.
  void begin(const RodState& state);
  void set_exact(bool on);
  void set_early_end(bool on);
  void stand_at(const RodState& state);
  void update_shifts(const RodState& state, double most);
  void harden(double factor);
  void forget_forces();

  /// The rod that overlaps deepest, and where; in radii of that rod.
  struct Deepest {
    double radii = 0;
    const Rod* rod = nullptr;
    ContactTerms::Deepest place;
  };
  Deepest deepest_at(const RodState& state);

  /// The widest gap under a force, in radii.
  double widest_gap(const RodState& state);

  /// Where a rod's centre line first passes through a surface; null: nowhere. The set stands at the state asked for last.
  struct Crossing {
    const Rod* rod;
    double s;  ///< m
    Vec3 at;   ///< m
    int obstacle;
  };
  std::optional<Crossing> first_crossing(const RodState& state);

  /// How small a share of a rod's length `radii` of its radius is: for tolerances of steps.
  double smallest_share(double radii) const;

 private:
  const RodNetwork* network_;
  std::vector<Rod> rods_;
};

}  // namespace tendril
