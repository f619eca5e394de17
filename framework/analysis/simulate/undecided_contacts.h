#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/dynamics/equations/equations.h"

namespace pintle {

/// Where rigid bodies leave a question open: normal forces of which only sums follow from the motion, and a contact that may as well open
/// as be pressed (Painlevé). Asked where contacts have changed what they do; the first of each is kept. Theory: docs/theory/impact.md.
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
  std::unique_ptr<Equations> eq_;    ///< from the first question on
  Eigen::VectorXd dy_;
  std::string shares_, two_motions_;
};

}  // namespace pintle
