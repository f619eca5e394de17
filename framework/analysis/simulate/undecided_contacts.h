#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/dynamics/equations/equations.h"

namespace pintle {

/// Warns where rigid bodies leave the forces undetermined: normal forces of which the motion determines only sums, and a contact that may
/// either open or stay pressed (Painlevé). Checked whenever contacts change what they do; the first case of each kind is kept. Theory:
/// docs/theory/impact.md.
class UndecidedContacts {
 public:
  explicit UndecidedContacts(const System&);
  /// At the start and after each accepted step.
  void see(const State&);
  void warn(std::vector<std::string>& warnings) const;

 private:
  enum class Doing : unsigned char { open, struck, sticks, slides_on, slides_back, without_friction };
  Doing doing(std::size_t contact, const State&) const;
  State decided(const State&) const;
  void look_for_shares(const State&);
  void look_for_two_motions(const State&);
  bool goes_both_ways(std::size_t contact, const State&, double direction);

  const System& system_;
  std::vector<std::size_t> rigid_;   ///< contacts
  std::vector<Doing> now_, before_;  ///< of each of them
  std::unique_ptr<Equations> eq_;    ///< created at the first check
  Eigen::VectorXd dy_;
  std::string shares_, two_motions_;
};

}  // namespace pintle
